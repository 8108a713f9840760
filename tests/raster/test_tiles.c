// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Pyramids of tiles and their cache, on files that the tests make: what tiles hold, what stays
// within the budget, what happens to broken files, and that nothing hangs.
#include "fixture.h"
#include "raster/tile_cache.h"

#include <cpl_string.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// A globe of height = width / 2, in tiles of 256.
struct ramp {
    int width;
    GDALDataType type;
    int bands;
    int overviews; // how many, each half the last
    int nodata;    // value; 0: none
};

// Means over any rectangle of pixels are the value at its middle, so every level is known.
static double ramp_at(const struct ramp *r, double x, double y)
{
    return r->type == GDT_Byte ? 10 + 200 * x / r->width : 8 * x - 3 * y;
}

static const char *make_ramp(struct fixture *f, const struct ramp *r)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%d-%d.tif", f->folder, r->width, r->overviews);
    char **options = CSLAddString(CSLAddString(NULL, "TILED=YES"), "COMPRESS=DEFLATE");
    options = CSLAddString(options, "ZLEVEL=1");
    const int height = r->width / 2;
    const GDALDatasetH dataset = GDALCreate(GDALGetDriverByName("GTiff"), path, r->width, height,
                                            r->bands, r->type, options);
    CSLDestroy(options);
    assert_non_null(dataset);
    double *values = malloc((size_t)r->width * (size_t)height * sizeof *values);
    for (int i = 0; i < r->width * height; i++) {
        values[i] = ramp_at(r, i % r->width + 0.5, i / r->width + 0.5);
    }
    for (int band = 1; band <= r->bands; band++) {
        const GDALRasterBandH to = GDALGetRasterBand(dataset, band);
        if (r->nodata) {
            GDALSetRasterNoDataValue(to, r->nodata);
            for (int i = 0; i < r->width * height; i++) {
                values[i] = i % r->width < 300 ? r->nodata : values[i];
            }
        }
        assert_int_equal(GDALRasterIO(to, GF_Write, 0, 0, r->width, height, values, r->width,
                                      height, GDT_Float64, 0, 0),
                         CE_None);
    }
    free(values);
    int factors[] = {2, 4, 8, 16};
    if (r->overviews) {
        assert_int_equal(
            GDALBuildOverviews(dataset, "AVERAGE", r->overviews, factors, 0, NULL, NULL, NULL),
            CE_None);
    }
    GDALClose(dataset);
    return path;
}

static const struct ramp HEIGHTS = {.width = 2100, .type = GDT_Int16, .bands = 1, .overviews = 3};

static void open_pyramid(struct fixture *f, const struct ramp *r, enum pyramid_format format,
                         struct pyramid *out)
{
    struct raster raster;
    assert_int_equal(raster_open(f->ctx, make_ramp(f, r), &raster), TRL_OK);
    const struct pyramid_desc desc = {&raster, format, true, true, true};
    assert_int_equal(pyramid_init(f->ctx, &desc, out), TRL_OK);
    raster_finish(&raster);
}

// What a level has at a texel beyond its borders: around the circle, and over the poles.
static double level_value(const struct ramp *r, const struct pyramid *p, uint32_t level, int x,
                          int y)
{
    const int width = (int)p->levels[level].width, height = (int)p->levels[level].height;
    if (y < 0 || y >= height) {
        y = y < 0 ? -1 - y : 2 * height - 1 - y;
        x += width / 2;
    }
    x = (x % width + width) % width;
    return ramp_at(r, (x + 0.5) * r->width / width, (y + 0.5) * (r->width / 2) / height);
}

static void check_tile(struct pyramid_reader *reader, const struct ramp *r, uint32_t level,
                       uint32_t column, uint32_t row)
{
    static int16_t texels[PYRAMID_TEXELS];
    const struct pyramid *p = reader->pyramid;
    const struct pyramid_tile tile = {level, column, row};
    assert_true(pyramid_has_tile(p, &tile));
    memset(texels, 0x55, sizeof texels);
    assert_int_equal(pyramid_read(reader, &tile, texels), TRL_OK);
    const int height = (int)p->levels[level].height;
    const int width = (int)p->levels[level].width;
    for (int j = 0; j < PYRAMID_SIDE; j++) {
        for (int i = 0; i < PYRAMID_SIDE; i++) {
            const int x = (int)column * PYRAMID_TILE - PYRAMID_BORDER + i;
            const int y = (int)row * PYRAMID_TILE - PYRAMID_BORDER + j;
            if (y >= height + PYRAMID_BORDER || x >= width + PYRAMID_BORDER) {
                continue; // outside of what is ever looked at
            }
            const double wanted = level_value(r, p, level, x, y);
            // Rounded to integers at each of up to `level` reductions.
            assert_true(fabs(texels[j * PYRAMID_SIDE + i] - wanted) <= 0.51 + 0.5 * level);
        }
    }
}

static void check_all_tiles(struct fixture *f, const struct ramp *r)
{
    struct pyramid pyramid;
    open_pyramid(f, r, PYRAMID_INT16, &pyramid);
    struct pyramid_reader reader;
    assert_int_equal(pyramid_reader_init(f->ctx, &pyramid, &reader), TRL_OK);
    for (uint32_t level = 0; level < pyramid.level_count; level++) {
        for (uint32_t y = 0; y < pyramid.levels[level].rows; y++) {
            for (uint32_t x = 0; x < pyramid.levels[level].columns; x++) {
                check_tile(&reader, r, level, x, y);
            }
        }
    }
    pyramid_reader_finish(&reader);
    pyramid_finish(&pyramid);
}

static void tiles_hold_their_texels_and_their_neighbours(void **state)
{
    check_all_tiles(*state, &HEIGHTS);
    struct ramp r = HEIGHTS;
    r.overviews = 0;
    check_all_tiles(*state, &r);
}

// 2101 texels halve to 1051, 526, 263, 132: what GDAL makes of overviews, and no neat twos.
static void odd_sizes_are_rounded_up(void **state)
{
    struct fixture *f = *state;
    struct ramp r = HEIGHTS;
    r.width = 2102;
    struct pyramid p;
    open_pyramid(f, &r, PYRAMID_INT16, &p);
    assert_int_equal(p.level_count, 5);
    const uint32_t widths[5] = {2102, 1051, 526, 263, 132};
    for (uint32_t i = 0; i < 5; i++) {
        assert_int_equal(p.levels[i].width, widths[i]);
        assert_int_equal(p.levels[i].columns, (widths[i] + 255) / 256);
        assert_true(i == 0 || i > 3 ||
                    raster_has_overview(&p.raster, widths[i], p.levels[i].height));
        // A parent has all of its child's tiles.
        assert_true(i == 0 || p.levels[i].columns == (p.levels[i - 1].columns + 1) / 2);
    }
    assert_int_equal(p.base_level, 2); // the first of at most 1024
    pyramid_finish(&p);
}

static void void_texels_do_not_count_in_means(void **state)
{
    struct fixture *f = *state;
    struct ramp r = HEIGHTS;
    r.nodata = -9999;
    r.overviews = 0;
    struct pyramid p;
    open_pyramid(f, &r, PYRAMID_INT16, &p);
    const uint32_t top = p.level_count - 1;
    const int16_t *texels = p.whole[top];
    const uint32_t width = p.levels[top].width;
    for (uint32_t i = 0; i < width * p.levels[top].height; i++) {
        const double first = (i % width) * (double)r.width / width;
        const double size = (double)r.width / width;
        if (first + size <= 300) {
            assert_int_equal(texels[i], -9999);
        } else {
            // Where a part is void the mean is that of the rest: at most half a texel aside.
            const double here = level_value(&r, &p, top, (int)(i % width), (int)(i / width));
            assert_true(fabs(texels[i] - here) <= 3 + (first < 300 ? 4 * size : 0));
        }
    }
    pyramid_finish(&p);
}

static void colours_are_tiles_too(void **state)
{
    struct fixture *f = *state;
    const struct ramp r = {.width = 1400, .type = GDT_Byte, .bands = 3, .overviews = 0};
    struct pyramid p;
    open_pyramid(f, &r, PYRAMID_RGBA8, &p);
    struct pyramid_reader reader;
    assert_int_equal(pyramid_reader_init(f->ctx, &p, &reader), TRL_OK);
    uint8_t *texels = malloc(4 * PYRAMID_TEXELS);
    for (uint32_t level = 0; level < p.level_count; level++) {
        assert_int_equal(pyramid_read(&reader, &(struct pyramid_tile){level, 0, 0}, texels),
                         TRL_OK);
        const uint8_t *pixel = texels + 4 * (10 * PYRAMID_SIDE + 60);
        const double wanted = level_value(&r, &p, level, 57, 7);
        assert_true(fabs(pixel[0] - wanted) <= 1.5 && pixel[0] == pixel[2] && pixel[3] == 255);
    }
    free(texels);
    pyramid_reader_finish(&reader);
    pyramid_finish(&p);
}

enum { TILE_BYTES = 2 * PYRAMID_TEXELS };

static void open_cache(struct fixture *f, const struct pyramid *p, size_t tiles, uint32_t threads,
                       struct tile_cache **out)
{
    const struct tile_cache_desc desc = {.max_bytes = tiles * TILE_BYTES, .threads = threads};
    assert_int_equal(tile_cache_create(f->ctx, &desc, out), TRL_OK);
    uint32_t index = 9;
    assert_int_equal(tile_cache_add(*out, &(struct tile_source){.pyramid = p}, &index), TRL_OK);
    assert_int_equal(index, 0);
}

static struct tile_key key_of(uint32_t level, uint32_t x, uint32_t y)
{
    return (struct tile_key){0, {level, x, y}};
}

static enum tile_state want(struct tile_cache *cache, uint32_t x, uint32_t y,
                            struct tile_view *view)
{
    const struct tile_key key = key_of(0, x, y);
    return tile_cache_want(cache, &key, 1, view);
}

static double middle_of(const struct tile_view *view)
{
    return ((const int16_t *)
                view->texels)[(PYRAMID_BORDER + 128) * PYRAMID_SIDE + PYRAMID_BORDER + 128];
}

// A file of 45 tiles through a cache of 8, four at a time.
static void a_raster_larger_than_the_budget_goes_through(void **state)
{
    struct fixture *f = *state;
    struct pyramid p;
    open_pyramid(f, &HEIGHTS, PYRAMID_INT16, &p);
    struct tile_cache *cache = NULL;
    open_cache(f, &p, 8, 2, &cache);
    const uint32_t columns = p.levels[0].columns, rows = p.levels[0].rows;
    assert_true(columns * rows == 45);
    for (uint32_t y = 0; y + 1 < rows; y++) {
        for (uint32_t x = 0; x + 1 < columns; x++) {
            struct tile_view views[4];
            tile_cache_begin(cache);
            for (uint32_t i = 0; i < 4; i++) {
                (void)want(cache, x + i % 2, y + i / 2, &views[i]);
            }
            assert_int_equal(tile_cache_wait(cache), TRL_OK);
            for (uint32_t i = 0; i < 4; i++) {
                const uint32_t column = x + i % 2, row = y + i / 2;
                assert_int_equal(want(cache, column, row, &views[i]), TILE_READY);
                const bool is_inside = row * 256 + 128 < p.levels[0].height;
                const double wanted = ramp_at(&HEIGHTS, column * 256 + 128.5, row * 256 + 128.5);
                assert_true(!is_inside || column == columns - 1 ||
                            fabs(middle_of(&views[i]) - wanted) <= 0.51);
            }
        }
    }
    const struct tile_cache_stats stats = tile_cache_stats(cache);
    assert_true(stats.most_bytes <= 8 * TILE_BYTES && stats.bytes <= 8 * TILE_BYTES);
    assert_true(stats.loaded >= 45 && stats.evicted == stats.loaded - stats.bytes / TILE_BYTES);
    assert_int_equal(stats.failed + stats.crowded_out, 0);
    assert_true(stats.read_s > 0);
    tile_cache_destroy(&cache);
    pyramid_finish(&p);
}

static void what_a_frame_uses_is_not_evicted(void **state)
{
    struct fixture *f = *state;
    struct pyramid p;
    open_pyramid(f, &HEIGHTS, PYRAMID_INT16, &p);
    struct tile_cache *cache = NULL;
    open_cache(f, &p, 3, 2, &cache);
    struct tile_view views[3], more;
    tile_cache_begin(cache);
    for (uint32_t i = 0; i < 3; i++) {
        (void)want(cache, i, 0, &views[i]);
    }
    assert_int_equal(tile_cache_wait(cache), TRL_OK);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(want(cache, i, 0, &views[i]), TILE_READY);
    }
    // There is no room for a fourth: it is given up, and the three stay.
    (void)want(cache, 4, 0, &more);
    assert_int_equal(tile_cache_wait(cache), TRL_OK);
    assert_int_equal(tile_cache_missing(cache), 0);
    for (uint32_t i = 0; i < 3; i++) {
        assert_true(fabs(middle_of(&views[i]) - ramp_at(&HEIGHTS, i * 256 + 128.5, 128.5)) <= 0.51);
    }
    assert_int_equal(tile_cache_stats(cache).crowded_out, 1);
    // In the next frame the one that was used longest ago goes.
    tile_cache_begin(cache);
    assert_int_equal(want(cache, 0, 0, &views[0]), TILE_READY);
    assert_int_equal(want(cache, 2, 0, &views[2]), TILE_READY);
    (void)want(cache, 4, 0, &more);
    assert_int_equal(tile_cache_wait(cache), TRL_OK);
    assert_int_equal(want(cache, 4, 0, &more), TILE_READY);
    assert_int_equal(want(cache, 0, 0, &views[0]), TILE_READY);
    struct tile_view gone;
    const struct tile_key key = key_of(0, 1, 0);
    assert_false(tile_cache_hold(cache, &key, false, &gone));
    tile_cache_destroy(&cache);
    pyramid_finish(&p);
}

// Stops loaders where the test wants it, and writes down in which order they came.
struct gate {
    pthread_mutex_t lock;
    pthread_cond_t opened;
    bool is_open;
    uint32_t order[64];
    size_t count;
};

static trl_result pass_gate(const void *user, struct pyramid_reader *reader,
                            const struct tile_load *load)
{
    struct gate *gate = *(struct gate *const *)user;
    const struct pyramid_tile *tile = &load->tile;
    (void)reader;
    *load->range = (struct tile_range){(float)tile->x, (float)tile->y};
    pthread_mutex_lock(&gate->lock);
    gate->order[gate->count++] = tile->x;
    while (!gate->is_open) {
        pthread_cond_wait(&gate->opened, &gate->lock);
    }
    pthread_mutex_unlock(&gate->lock);
    return TRL_OK;
}

static void open_gate(struct gate *gate)
{
    pthread_mutex_lock(&gate->lock);
    gate->is_open = true;
    pthread_cond_broadcast(&gate->opened);
    pthread_mutex_unlock(&gate->lock);
}

static size_t count_passed(struct gate *gate)
{
    pthread_mutex_lock(&gate->lock);
    const size_t count = gate->count;
    pthread_mutex_unlock(&gate->lock);
    return count;
}

// One loader, which stands at the gate with tile 0.
static void open_gated(struct fixture *f, const struct pyramid *p, struct gate **gate,
                       struct tile_cache **cache)
{
    assert_int_equal(
        tile_cache_create(
            f->ctx, &(struct tile_cache_desc){.max_bytes = 20 * TILE_BYTES, .threads = 1}, cache),
        TRL_OK);
    uint32_t index = 0;
    const struct tile_source source = {p, pass_gate, gate};
    assert_int_equal(tile_cache_add(*cache, &source, &index), TRL_OK);
    tile_cache_begin(*cache);
    struct tile_view view;
    assert_int_equal(want(*cache, 0, 0, &view), TILE_WAITING);
    while (count_passed(*gate) == 0) {
        usleep(1000);
    }
}

static void larger_priorities_are_read_first(void **state)
{
    struct fixture *f = *state;
    struct pyramid p;
    open_pyramid(f, &HEIGHTS, PYRAMID_INT16, &p);
    struct gate gate = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, false, {0}, 0};
    struct gate *pointer = &gate;
    struct tile_cache *cache = NULL;
    open_gated(f, &p, &pointer, &cache);
    static const float PRIORITIES[5] = {3, 1, 5, 4, 2};
    static const uint32_t ORDER[6] = {0, 3, 4, 1, 5, 2};
    struct tile_view view;
    for (uint32_t i = 0; i < 5; i++) {
        const struct tile_key key = key_of(0, i + 1, 0);
        assert_int_equal(tile_cache_want(cache, &key, PRIORITIES[i], &view), TILE_WAITING);
    }
    open_gate(&gate);
    assert_int_equal(tile_cache_wait(cache), TRL_OK);
    assert_int_equal(gate.count, 6);
    assert_memory_equal(gate.order, ORDER, sizeof ORDER);
    assert_int_equal(want(cache, 3, 0, &view), TILE_READY);
    assert_true(view.range.min == 3 && view.range.max == 0);
    tile_cache_destroy(&cache);
    pyramid_finish(&p);
}

static void what_the_next_frame_does_not_want_is_dropped(void **state)
{
    struct fixture *f = *state;
    struct pyramid p;
    open_pyramid(f, &HEIGHTS, PYRAMID_INT16, &p);
    struct gate gate = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, false, {0}, 0};
    struct gate *pointer = &gate;
    struct tile_cache *cache = NULL;
    open_gated(f, &p, &pointer, &cache);
    struct tile_view view;
    (void)want(cache, 1, 0, &view);
    (void)want(cache, 2, 0, &view);
    assert_int_equal(tile_cache_missing(cache), 3);
    tile_cache_begin(cache);
    assert_int_equal(tile_cache_missing(cache), 0);
    (void)want(cache, 2, 0, &view);
    const struct tile_key ahead = key_of(0, 5, 0);
    tile_cache_hint(cache, &ahead, 0.1f);
    assert_int_equal(tile_cache_missing(cache), 1); // hints are not waited for
    open_gate(&gate);
    assert_int_equal(tile_cache_wait(cache), TRL_OK);
    assert_int_equal(want(cache, 2, 0, &view), TILE_READY);
    while (count_passed(&gate) < 3) {
        usleep(1000);
    }
    static const uint32_t ORDER[3] = {0, 2, 5};
    assert_memory_equal(gate.order, ORDER, sizeof ORDER);
    tile_cache_destroy(&cache);
    pyramid_finish(&p);
}

// The last third of the file is cut off: its tiles fail, one line says so, the others are there.
static void a_truncated_file_is_reported_once(void **state)
{
    struct fixture *f = *state;
    struct ramp r = HEIGHTS;
    r.overviews = 0; // whose tiles would be what is cut off
    struct pyramid p;
    open_pyramid(f, &r, PYRAMID_INT16, &p);
    char path[128];
    snprintf(path, sizeof path, "%s", p.raster.path);
    FILE *file = fopen(path, "rb");
    fseek(file, 0, SEEK_END);
    const long size = ftell(file);
    fclose(file);
    assert_int_equal(truncate(path, size * 2 / 3), 0);
    struct tile_cache *cache = NULL;
    open_cache(f, &p, 60, 2, &cache);
    f->errors = 0;
    for (int pass = 0; pass < 2; pass++) {
        tile_cache_begin(cache);
        struct tile_view view;
        for (uint32_t i = 0; i < 45; i++) {
            (void)want(cache, i % 9, i / 9, &view);
        }
        assert_int_equal(tile_cache_wait(cache), TRL_OK);
        assert_int_equal(want(cache, 0, 0, &view), TILE_READY);
        assert_int_equal(want(cache, 8, 4, &view), TILE_FAILED);
        assert_null(view.texels);
    }
    tile_cache_begin(cache);
    assert_int_equal(f->errors, 1);
    assert_non_null(strstr(f->last, path));
    assert_non_null(strstr(f->last, "coarser texels stand in"));
    const struct tile_cache_stats stats = tile_cache_stats(cache);
    assert_true(stats.failed >= 5 && stats.loaded + stats.failed == 45);
    tile_cache_destroy(&cache);
    pyramid_finish(&p);
}

static void a_cache_is_destroyed_while_it_reads(void **state)
{
    struct fixture *f = *state;
    struct pyramid p;
    open_pyramid(f, &HEIGHTS, PYRAMID_INT16, &p);
    for (int round = 0; round < 5; round++) {
        struct tile_cache *cache = NULL;
        open_cache(f, &p, 60, 4, &cache);
        tile_cache_begin(cache);
        struct tile_view view;
        for (uint32_t i = 0; i < 45; i++) {
            (void)want(cache, i % 9, i / 9, &view);
        }
        tile_cache_destroy(&cache);
        assert_null(cache);
    }
    pyramid_finish(&p);
}

struct walker {
    struct tile_cache *cache;
    uint32_t seed;
    int wrong;
};

// Holds tiles in any order, as several threads that trace rays do.
static void *walk(void *user)
{
    struct walker *w = user;
    for (int i = 0; i < 200; i++) {
        w->seed = w->seed * 1664525u + 1013904223u;
        const struct tile_key key = key_of(0, (w->seed >> 8) % 8, (w->seed >> 16) % 4);
        struct tile_view view;
        if (!tile_cache_hold(w->cache, &key, true, &view)) {
            w->wrong++;
            continue;
        }
        const double wanted = ramp_at(&HEIGHTS, key.tile.x * 256 + 128.5, key.tile.y * 256 + 128.5);
        w->wrong += fabs(middle_of(&view) - wanted) > 0.51;
        tile_cache_release(w->cache, &key);
    }
    return NULL;
}

static void threads_hold_tiles_of_a_small_cache(void **state)
{
    struct fixture *f = *state;
    struct pyramid p;
    open_pyramid(f, &HEIGHTS, PYRAMID_INT16, &p);
    struct tile_cache *cache = NULL;
    open_cache(f, &p, 10, 2, &cache);
    pthread_t threads[4];
    struct walker walkers[4];
    for (uint32_t i = 0; i < 4; i++) {
        walkers[i] = (struct walker){cache, i + 1, 0};
        assert_int_equal(pthread_create(&threads[i], NULL, walk, &walkers[i]), 0);
    }
    for (int i = 0; i < 4; i++) {
        pthread_join(threads[i], NULL);
        assert_int_equal(walkers[i].wrong, 0);
    }
    assert_true(tile_cache_stats(cache).most_bytes <= 10 * TILE_BYTES);
    tile_cache_destroy(&cache);
    pyramid_finish(&p);
}

static bool stop_at_once(void *user, const char *stage, double fraction)
{
    (void)user;
    (void)stage;
    (void)fraction;
    return false;
}

static void waiting_can_be_cancelled(void **state)
{
    struct fixture *f = *state;
    struct pyramid p;
    open_pyramid(f, &HEIGHTS, PYRAMID_INT16, &p);
    trl_context_desc desc = trl_context_desc_default();
    desc.progress = stop_at_once;
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    struct tile_cache *cache = NULL;
    assert_int_equal(
        tile_cache_create(
            ctx, &(struct tile_cache_desc){.max_bytes = 60 * TILE_BYTES, .threads = 1}, &cache),
        TRL_OK);
    uint32_t index;
    assert_int_equal(tile_cache_add(cache, &(struct tile_source){.pyramid = &p}, &index), TRL_OK);
    tile_cache_begin(cache);
    struct tile_view view;
    (void)want(cache, 0, 0, &view);
    assert_int_equal(tile_cache_wait(cache), TRL_ERROR_CANCELLED);
    tile_cache_destroy(&cache);
    trl_context_destroy(&ctx);
    pyramid_finish(&p);
}

// Without overviews and too large to go through for each coarse tile: said once.
static void a_large_file_without_overviews_is_told_of(void **state)
{
    struct fixture *f = *state;
    struct ramp r = {.width = 8400, .type = GDT_Byte, .bands = 1, .overviews = 0};
    struct pyramid p;
    open_pyramid(f, &r, PYRAMID_UINT8, &p);
    assert_int_equal(f->warnings, 1);
    assert_non_null(strstr(f->warning, "without overviews"));
    assert_int_equal(p.base_level, 2); // 2100: tiles of level 1 average four pixels each
    pyramid_finish(&p);
    r.overviews = 3;
    open_pyramid(f, &r, PYRAMID_UINT8, &p);
    assert_int_equal(f->warnings, 1);
    assert_int_equal(p.base_level, 4);
    pyramid_finish(&p);
}

static trl_result read_one_tile(trl_context *ctx, const struct raster *raster)
{
    struct pyramid p = {0};
    struct tile_cache *cache = NULL;
    struct raster mine = *raster;
    mine.ctx = ctx;
    const struct pyramid_desc desc = {&mine, PYRAMID_INT16, true, true, true};
    trl_result result = pyramid_init(ctx, &desc, &p);
    if (result == TRL_OK) {
        result = tile_cache_create(
            ctx, &(struct tile_cache_desc){.max_bytes = 9 * TILE_BYTES, .threads = 1}, &cache);
    }
    if (result == TRL_OK) {
        uint32_t index;
        result = tile_cache_add(cache, &(struct tile_source){.pyramid = &p}, &index);
        struct tile_view view;
        tile_cache_begin(cache);
        (void)want(cache, 0, 0, &view);
        const trl_result waited = tile_cache_wait(cache);
        assert_int_equal(waited, TRL_OK);
        result = want(cache, 0, 0, &view) == TILE_READY ? result : TRL_ERROR_MEMORY;
    }
    tile_cache_destroy(&cache);
    pyramid_finish(&p);
    return result;
}

// Each allocation in turn fails; nothing is left behind (the sanitised build looks for leaks).
static void every_failed_allocation_is_survived(void **state)
{
    struct fixture *f = *state;
    struct raster raster;
    assert_int_equal(raster_open(f->ctx, make_ramp(f, &HEIGHTS), &raster), TRL_OK);
    int left = 1 << 20;
    trl_context *ctx = make_counting_context(&left);
    trl_result result = TRL_ERROR_MEMORY;
    int allowed = 0;
    for (; result != TRL_OK && allowed < 40; allowed++) {
        left = allowed;
        result = read_one_tile(ctx, &raster);
        assert_true(result == TRL_OK || result == TRL_ERROR_MEMORY);
    }
    assert_true(result == TRL_OK && allowed > 8);
    trl_context_destroy(&ctx);
    raster_finish(&raster);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(tiles_hold_their_texels_and_their_neighbours),
        TEST(odd_sizes_are_rounded_up),
        TEST(void_texels_do_not_count_in_means),
        TEST(colours_are_tiles_too),
        TEST(a_raster_larger_than_the_budget_goes_through),
        TEST(what_a_frame_uses_is_not_evicted),
        TEST(larger_priorities_are_read_first),
        TEST(what_the_next_frame_does_not_want_is_dropped),
        TEST(a_truncated_file_is_reported_once),
        TEST(a_cache_is_destroyed_while_it_reads),
        TEST(threads_hold_tiles_of_a_small_cache),
        TEST(waiting_can_be_cancelled),
        TEST(a_large_file_without_overviews_is_told_of),
        TEST(every_failed_allocation_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
