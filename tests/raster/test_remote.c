// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Rasters behind a network, served on the loopback by range_server.py, which counts: only when
// allowed, only the named file, and only the parts that are needed. The argument is the server.
#include "fixture.h"
#include "raster/gdal.h"
#include "raster/remote.h"
#include "raster/tile_cache.h"

#include <cpl_string.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define HOST "127.0.0.1"
static const char *server_path;

static void start_server(struct fixture *f)
{
    int in[2], out[2];
    assert_int_equal(pipe(in) + pipe(out), 0);
    f->server = fork();
    assert_true(f->server >= 0);
    if (f->server == 0) {
        dup2(in[0], 0);
        dup2(out[1], 1);
        close(in[1]);
        close(out[0]);
        execlp("python3", "python3", server_path, f->folder, (char *)NULL);
        _exit(127);
    }
    close(in[0]);
    close(out[1]);
    f->to_server = in[1];
    FILE *told = fdopen(out[0], "r");
    assert_int_equal(fscanf(told, "%d", &f->port), 1);
    fclose(told);
}

static int set_up_served(void **state, bool allows_remote)
{
    if (set_up_allowed(state, allows_remote) != 0) {
        return -1;
    }
    setenv("no_proxy", HOST, 1);
    setenv("GDAL_HTTP_RETRY_DELAY", "0.05", 1);
    start_server(*state);
    return 0;
}

static int set_up_allowing(void **state)
{
    return set_up_served(state, true);
}

static int set_up_refusing(void **state)
{
    return set_up_served(state, false);
}

static int tear_down_server(void **state)
{
    const struct fixture *f = *state;
    close(f->to_server);
    int status = 0;
    waitpid(f->server, &status, 0);
    return tear_down(state);
}

// Noise, which no codec makes smaller: bytes served tell how many texels were.
static void write_globe(const struct fixture *f, const char *name, int width, bool is_cloud)
{
    char path[128];
    const int height = width / 2;
    const GDALDatasetH memory =
        GDALCreate(GDALGetDriverByName("MEM"), "", width, height, 1, GDT_Int16, NULL);
    double transform[6] = {-180, 360.0 / width, 0, 90, 0, -360.0 / width};
    assert_int_equal(GDALSetGeoTransform(memory, transform), CE_None);
    const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    assert_int_equal(OSRImportFromEPSG(srs, 4326), OGRERR_NONE);
    assert_int_equal(GDALSetSpatialRef(memory, srs), CE_None);
    OSRDestroySpatialReference(srs);
    int16_t *row = malloc((size_t)width * sizeof *row);
    uint32_t seed = 1;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            seed = seed * 1664525u + 1013904223u;
            row[x] = (int16_t)(seed >> 16);
        }
        assert_int_equal(GDALRasterIO(GDALGetRasterBand(memory, 1), GF_Write, 0, y, width, 1, row,
                                      width, 1, GDT_Int16, 0, 0),
                         CE_None);
    }
    free(row);
    snprintf(path, sizeof path, "%s/%s", f->folder, name);
    char **options = is_cloud ? CSLAddString(NULL, "RESAMPLING=AVERAGE") : NULL;
    const GDALDatasetH file = GDALCreateCopy(GDALGetDriverByName(is_cloud ? "COG" : "GTiff"), path,
                                             memory, FALSE, options, NULL, NULL);
    assert_non_null(file);
    CSLDestroy(options);
    GDALClose(file);
    GDALClose(memory);
}

// Bytes served so far; every request must have been for one file.
static size_t count_served(const struct fixture *f, const char *only)
{
    char path[128], line[512], wanted[128];
    snprintf(path, sizeof path, "%s/served", f->folder);
    snprintf(wanted, sizeof wanted, "/%s\n", only);
    FILE *file = fopen(path, "r");
    size_t total = 0;
    while (file && fgets(line, sizeof line, file)) {
        assert_string_equal(strchr(line, ' ') + 1, wanted);
        total += strtoul(line, NULL, 10);
    }
    if (file) {
        fclose(file);
    }
    return total;
}

static size_t file_bytes(const struct fixture *f, const char *name)
{
    char path[128];
    struct stat info;
    snprintf(path, sizeof path, "%s/%s", f->folder, name);
    assert_int_equal(stat(path, &info), 0);
    return (size_t)info.st_size;
}

static const char *url_of(const struct fixture *f, const char *name)
{
    static char url[128];
    snprintf(url, sizeof url, "http://" HOST ":%d/%s", f->port, name);
    return url;
}

static void nothing_is_fetched_unless_allowed(void **state)
{
    struct fixture *f = *state;
    write_globe(f, "globe.tif", 512, true);
    struct raster raster;
    char vsi[160];
    snprintf(vsi, sizeof vsi, "/vsicurl/%s", url_of(f, "globe.tif"));
    const char *const paths[] = {url_of(f, "globe.tif"), vsi, "s3://bucket/globe.tif",
                                 "/vsis3/bucket/globe.tif"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        f->errors = 0;
        assert_int_equal(raster_open(f->ctx, paths[i], &raster), TRL_ERROR_INVALID);
        assert_int_equal(f->errors, 1);
        assert_non_null(strstr(f->last, "local files only"));
    }
    assert_int_equal(count_served(f, ""), 0);
}

// Whatever else a file makes GDAL open: it reaches no server, except where a remote raster is read.
static void gdal_reaches_a_network_for_remote_rasters_only(void **state)
{
    struct fixture *f = *state;
    write_globe(f, "globe.tif", 256, false);
    char vsi[160];
    snprintf(vsi, sizeof vsi, "/vsicurl/%s", url_of(f, "globe.tif"));
    struct gdal_catcher outer, inner;
    gdal_catch_begin(&outer, f->ctx);
    gdal_catch_begin(&inner, f->ctx);
    gdal_catch_end(&inner);
    remote_begin(false);
    assert_null(GDALOpen(vsi, GA_ReadOnly));
    remote_end(false);
    assert_int_equal(count_served(f, ""), 0);
    remote_begin(true);
    const GDALDatasetH opened = GDALOpen(vsi, GA_ReadOnly);
    remote_end(true);
    assert_non_null(opened);
    GDALClose(opened);
    gdal_catch_end(&outer);
    assert_true(count_served(f, "globe.tif") > 0);
}

static void other_virtual_files_stay_refused(void **state)
{
    struct fixture *f = *state;
    struct raster raster;
    const char *const paths[] = {"/vsizip/a.zip/a.tif",  "/vsimem/a.tif",
                                 "/vsistdin/",           "/vsicurl_streaming/http://" HOST "/a.tif",
                                 "ftp://" HOST "/a.tif", "/vsisubfile/0_9,a.tif"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        assert_int_equal(raster_open(f->ctx, paths[i], &raster), TRL_ERROR_INVALID);
    }
}

static void put_text(const struct fixture *f, const char *name, const char *format)
{
    char path[160], text[512], url[128];
    snprintf(path, sizeof path, "%s/%s", f->folder, name);
    snprintf(url, sizeof url, "%s", url_of(f, "globe.tif"));
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    snprintf(text, sizeof text, format, url);
    fputs(text, file);
    fclose(file);
}

// Refuses to open a local file, in one line that says why.
static void expect_not_opened(struct fixture *f, const char *name, const char *why)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", f->folder, name);
    struct raster raster;
    f->errors = 0;
    assert_int_equal(raster_open(f->ctx, path, &raster), TRL_ERROR_INVALID);
    assert_int_equal(f->errors, 1);
    assert_non_null(strstr(f->last, why));
}

// A local raster may come from a stranger: neither what it says itself nor what lies beside it
// makes the program ask a server.
static void local_files_lead_to_no_network(void **state)
{
    struct fixture *f = *state;
    static const char VRT[] =
        "<VRTDataset rasterXSize=\"256\" rasterYSize=\"128\"><VRTRasterBand dataType=\"Int16\" "
        "band=\"1\"><SimpleSource><SourceFilename>/vsicurl/%s</SourceFilename><SourceBand>1"
        "</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
    static const char WMS[] =
        "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>%s</ServerUrl></Service><DataWindow>"
        "<UpperLeftX>-180</UpperLeftX><UpperLeftY>90</UpperLeftY><LowerRightX>180</LowerRightX>"
        "<LowerRightY>-90</LowerRightY><SizeX>256</SizeX><SizeY>128</SizeY></DataWindow>"
        "</GDAL_WMS>";
    static const char PAM[] =
        "<PAMDataset><Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">/vsicurl/%s</MDI>"
        "</Metadata></PAMDataset>";
    write_globe(f, "globe.tif", 256, false);
    write_globe(f, "local.tif", 512, false);
    put_text(f, "local.tif.aux.xml", PAM);
    expect_not_opened(f, "local.tif", "names another file as its overviews");
    put_text(f, "local.tif.aux.xml", "<PAMDataset/>");
    static const char *const NAMES[] = {"local.tif.ovr", "local.tif.OVR", "local.tif.msk"};
    for (size_t i = 0; i < sizeof NAMES / sizeof *NAMES; i++) {
        char path[160];
        snprintf(path, sizeof path, "%s/%s", f->folder, NAMES[i]);
        put_text(f, NAMES[i], VRT);
        expect_not_opened(f, "local.tif", NAMES[i]);
        put_text(f, NAMES[i], WMS);
        expect_not_opened(f, "local.tif", NAMES[i]);
        assert_int_equal(unlink(path), 0);
    }
    // Overviews beside it are read, if they lead nowhere.
    write_globe(f, "local.tif.ovr", 256, false);
    put_text(f, "local.tif.ovr.aux.xml", PAM);
    expect_not_opened(f, "local.tif", "local.tif.ovr");
    put_text(f, "local.tif.ovr.aux.xml", "<PAMDataset/>");
    char path[128];
    struct raster raster;
    snprintf(path, sizeof path, "%s/local.tif", f->folder);
    assert_int_equal(raster_open(f->ctx, path, &raster), TRL_OK);
    assert_true(raster_has_overview(&raster, 256, 128));
    raster_finish(&raster);
    assert_int_equal(count_served(f, ""), 0);
}

static void open_remote(struct fixture *f, const char *name, struct pyramid *out)
{
    struct raster raster;
    assert_int_equal(raster_open(f->ctx, url_of(f, name), &raster), TRL_OK);
    assert_true(raster.is_remote && raster.is_whole_circle);
    const struct pyramid_desc desc = {&raster, PYRAMID_INT16, true, true, true};
    assert_int_equal(pyramid_init(f->ctx, &desc, out), TRL_OK);
    raster_finish(&raster);
}

// A file of 22 MB, of which the whole globe and one place at full resolution are looked at.
static void of_a_cloud_file_only_parts_are_fetched(void **state)
{
    struct fixture *f = *state;
    write_globe(f, "cloud.tif", 4096, true);
    const size_t size = file_bytes(f, "cloud.tif");
    struct pyramid p;
    open_remote(f, "cloud.tif", &p);
    const size_t opened = count_served(f, "cloud.tif");
    struct tile_cache *cache = NULL;
    assert_int_equal(
        tile_cache_create(f->ctx, &(struct tile_cache_desc){.max_bytes = 1 << 24, .threads = 2},
                          &cache),
        TRL_OK);
    uint32_t index = 0;
    assert_int_equal(tile_cache_add(cache, &(struct tile_source){.pyramid = &p}, &index), TRL_OK);
    tile_cache_begin(cache);
    for (uint32_t level = 0; level < p.level_count; level++) {
        const struct tile_key key = {index, {level, 4 >> level, 4 >> level}};
        struct tile_view view;
        (void)tile_cache_want(cache, &key, (float)level, &view);
    }
    assert_int_equal(tile_cache_wait(cache), TRL_OK);
    assert_int_equal(tile_cache_stats(cache).loaded, p.level_count);
    assert_int_equal(f->errors, 0);
    const size_t all = count_served(f, "cloud.tif");
    print_message("%zu bytes of %zu to open, %zu with one place at every level\n", opened, size,
                  all);
    // 1024 x 512 texels of 2 bytes are held from the start: a twentieth of the file.
    assert_true(opened > 1024 * 512 * 2 && opened < size / 12);
    // Blocks of 512 x 512: at most four of each of two levels beside that, another fifth.
    assert_true(all < size / 3);
    tile_cache_destroy(&cache);
    pyramid_finish(&p);
}

static void set_fault(const struct fixture *f, const char *fault)
{
    char path[128];
    snprintf(path, sizeof path, "%s/fault", f->folder);
    if (!fault) {
        assert_int_equal(unlink(path), 0);
        return;
    }
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(fault, file);
    fclose(file);
}

static size_t count_requests(const struct fixture *f)
{
    char path[128], line[512];
    snprintf(path, sizeof path, "%s/served", f->folder);
    FILE *file = fopen(path, "r");
    size_t count = 0;
    while (file && fgets(line, sizeof line, file)) {
        count++;
    }
    if (file) {
        fclose(file);
    }
    return count;
}

enum { COLUMNS = 8, ROWS = 4, TILES = COLUMNS * ROWS };

// A globe whose finest level has so many tiles, and a cache for it.
struct globe {
    struct pyramid pyramid;
    struct tile_cache *cache;
    uint32_t source;
};

static void open_globe(struct fixture *f, uint32_t threads, struct globe *out)
{
    write_globe(f, "cloud.tif", COLUMNS * PYRAMID_TILE, true);
    open_remote(f, "cloud.tif", &out->pyramid);
    const struct tile_cache_desc desc = {.max_bytes = 1 << 26, .threads = threads, .retry_s = 0.05};
    assert_int_equal(tile_cache_create(f->ctx, &desc, &out->cache), TRL_OK);
    assert_int_equal(
        tile_cache_add(out->cache, &(struct tile_source){.pyramid = &out->pyramid}, &out->source),
        TRL_OK);
}

static void close_globe(struct globe *globe)
{
    tile_cache_destroy(&globe->cache);
    pyramid_finish(&globe->pyramid);
}

// As a frame that waits does: all tiles of the finest level. How many are there.
static size_t want_all(struct globe *globe)
{
    size_t ready = 0;
    struct tile_view view;
    tile_cache_retry(globe->cache);
    for (int round = 0; round < 2; round++) {
        tile_cache_begin(globe->cache);
        for (uint32_t i = 0; i < TILES; i++) {
            const struct tile_key key = {globe->source, {0, i % COLUMNS, i / COLUMNS}};
            const enum tile_state state = tile_cache_want(globe->cache, &key, 1, &view);
            ready += round == 1 && state == TILE_READY;
            assert_true(round == 0 || state == TILE_READY || state == TILE_FAILED);
        }
        assert_int_equal(tile_cache_wait(globe->cache), TRL_OK);
    }
    return ready;
}

// Without a limit each tile would be asked for twice, with a pause before the second time.
static void a_server_that_fails_is_given_up_and_asked_again_later(void **state)
{
    struct fixture *f = *state;
    struct globe globe;
    open_globe(f, 4, &globe);
    set_fault(f, "500 0");
    const size_t before = count_requests(f);
    assert_true(want_all(&globe) < 8); // what came with other bytes
    assert_int_equal(f->errors, 1);
    assert_non_null(strstr(f->last, "cloud.tif"));
    assert_non_null(strstr(f->last, "its server did not send"));
    assert_non_null(strstr(f->last, "coarser texels stand in"));
    assert_int_equal(f->warnings, 1);
    assert_non_null(strstr(f->warning, "no more is fetched"));
    // 8 failures, and three more threads that are at one; each asks for two blocks, twice.
    assert_true(count_requests(f) - before <= 11 * 4);
    // What is held whole is there as before.
    const struct tile_key coarse = {globe.source, {globe.pyramid.base_level, 1, 0}};
    struct tile_view view;
    assert_true(tile_cache_hold(globe.cache, &coarse, true, &view));
    tile_cache_release(globe.cache, &coarse);
    usleep(300000); // more than 4 * retry_s
    set_fault(f, NULL);
    assert_int_equal(want_all(&globe), TILES);
    assert_int_equal(f->errors + f->warnings, 2); // told once
    close_globe(&globe);
}

// The user's own limits count: one second for a request, no second try.
static void a_server_that_says_nothing_is_given_up(void **state)
{
    struct fixture *f = *state;
    struct globe globe;
    open_globe(f, 8, &globe);
    setenv("GDAL_HTTP_TIMEOUT", "1", 1);
    setenv("GDAL_HTTP_MAX_RETRY", "0", 1);
    set_fault(f, "stall 0");
    assert_true(want_all(&globe) < 8);
    assert_int_equal(f->errors, 1);
    assert_non_null(strstr(f->last, "cloud.tif"));
    assert_int_equal(f->warnings, 1);
    close_globe(&globe);
    unsetenv("GDAL_HTTP_TIMEOUT");
    unsetenv("GDAL_HTTP_MAX_RETRY");
}

// All of it would have to be fetched to show it from afar.
static void a_large_file_without_overviews_is_refused(void **state)
{
    struct fixture *f = *state;
    char path[128];
    snprintf(path, sizeof path, "%s/plain.tif", f->folder);
    char **options = CSLAddString(CSLAddString(NULL, "SPARSE_OK=YES"), "TILED=YES");
    const GDALDatasetH file =
        GDALCreate(GDALGetDriverByName("GTiff"), path, 16384, 8192, 1, GDT_Int16, options);
    CSLDestroy(options);
    GDALClose(file);
    struct raster raster;
    struct pyramid p;
    assert_int_equal(raster_open(f->ctx, url_of(f, "plain.tif"), &raster), TRL_OK);
    const struct pyramid_desc desc = {&raster, PYRAMID_INT16, true, true, true};
    assert_int_equal(pyramid_init(f->ctx, &desc, &p), TRL_ERROR_INVALID);
    assert_int_equal(f->errors, 1);
    assert_non_null(strstr(f->last, "gdal_translate -of COG"));
    raster_finish(&raster);
}

static void what_is_not_there_is_one_error(void **state)
{
    struct fixture *f = *state;
    struct raster raster;
    assert_int_equal(raster_open(f->ctx, url_of(f, "missing.tif"), &raster), TRL_ERROR_IO);
    assert_int_equal(f->errors, 1);
    assert_non_null(strstr(f->last, "missing.tif"));
    assert_int_equal(count_served(f, "missing.tif"), 0);
    // Nobody listens at this port.
    f->errors = 0;
    assert_int_equal(raster_open(f->ctx, "http://" HOST ":1/a.tif", &raster), TRL_ERROR_IO);
    assert_int_equal(f->errors, 1);
}

#define SERVED(name) cmocka_unit_test_setup_teardown(name, set_up_allowing, tear_down_server)

int main(int argc, char **argv)
{
    server_path = argc > 1 ? argv[1] : "range_server.py";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(nothing_is_fetched_unless_allowed, set_up_refusing,
                                        tear_down_server),
        cmocka_unit_test_setup_teardown(local_files_lead_to_no_network, set_up_refusing,
                                        tear_down_server),
        SERVED(gdal_reaches_a_network_for_remote_rasters_only),
        SERVED(other_virtual_files_stay_refused),
        SERVED(of_a_cloud_file_only_parts_are_fetched),
        SERVED(a_server_that_fails_is_given_up_and_asked_again_later),
        SERVED(a_server_that_says_nothing_is_given_up),
        SERVED(a_large_file_without_overviews_is_refused),
        SERVED(what_is_not_there_is_one_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
