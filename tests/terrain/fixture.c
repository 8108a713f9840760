// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "fixture.h"

#include "raster/gdal.h"

#include <gdal.h>
#include <math.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double DEGREE = 3.14159265358979323846 / 180;

static void keep_error(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct fixture *f = user;
    (void)item;
    if (level <= TRL_LOG_WARN) {
        snprintf(f->last_error, sizeof f->last_error, "%s", message);
    }
}

int fixture_set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    assert_non_null(f);
    trl_context_desc desc = trl_context_desc_default();
    desc.log = keep_error;
    desc.log_user = f;
    assert_int_equal(trl_context_create(&desc, &f->ctx), TRL_OK);
    const trl_result result = gpu_create_headless(f->ctx, &f->gpu);
    if (result != TRL_OK) {
        const char *required = getenv("TRL_REQUIRE_GPU");
        puts(f->last_error);
        exit(required && strcmp(required, "1") == 0 ? 1 : 77);
    }
    snprintf(f->folder, sizeof f->folder, "/tmp/terrella-terrain-XXXXXX");
    assert_non_null(mkdtemp(f->folder));
    gdal_register();
    *state = f;
    return 0;
}

int fixture_tear_down(void **state)
{
    struct fixture *f = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", f->folder);
    const int removed = system(command);
    const size_t live = f->gpu->live_objects;
    gpu_destroy(&f->gpu);
    trl_context_destroy(&f->ctx);
    free(f);
    return removed == 0 && live == 0 ? 0 : 1;
}

struct surface_desc fixture_invent(uint32_t seed)
{
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = 6e6;
    desc.noise = (struct noise_desc){.seed = seed,
                                     .form = NOISE_ERODED,
                                     .octaves = NOISE_MAX_OCTAVES,
                                     .wavelength_m = 147000,
                                     .mountain_m = 20000,
                                     .gully_m = 10000,
                                     .lacunarity = 2,
                                     .hurst = 1,
                                     .smallest_m = 0.2,
                                     .level_roughness = 0.25};
    desc.continents = (struct continents_desc){.seed = seed,
                                               .radius_m = 6e6,
                                               .wavelength_m = 6e6,
                                               .height_m = 5000,
                                               .amplitude_m = 2500,
                                               .form = NOISE_ERODED};
    return desc;
}

struct writer {
    const char *path;
    const struct raster_place *place;
    double (*values)(double latitude, double longitude);
    GDALDataType type;
    int bands;
};

static void write_raster(const struct writer *w)
{
    const struct raster_place *p = w->place;
    const GDALDatasetH file = GDALCreate(GDALGetDriverByName("GTiff"), w->path, (int)p->width,
                                         (int)p->height, w->bands, w->type, NULL);
    assert_non_null(file);
    double transform[6] = {p->west, p->texel, 0, p->north, 0, -p->texel};
    assert_int_equal(GDALSetGeoTransform(file, transform), CE_None);
    const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    assert_int_equal(OSRImportFromEPSG(srs, 4326), OGRERR_NONE);
    assert_int_equal(GDALSetSpatialRef(file, srs), CE_None);
    OSRDestroySpatialReference(srs);
    double *row = malloc(p->width * sizeof *row);
    assert_non_null(row);
    for (int band = 1; band <= w->bands; band++) {
        const GDALRasterBandH b = GDALGetRasterBand(file, band);
        if (w->type != GDT_Byte) {
            GDALSetRasterNoDataValue(b, -32768);
        }
        for (uint32_t y = 0; y < p->height; y++) {
            for (uint32_t x = 0; x < p->width; x++) {
                const double v =
                    w->values(p->north - (y + 0.5) * p->texel, p->west + (x + 0.5) * p->texel);
                row[x] = isnan(v) ? -32768 : v;
            }
            assert_int_equal(GDALRasterIO(b, GF_Write, 0, (int)y, (int)p->width, 1, row,
                                          (int)p->width, 1, GDT_Float64, 0, 0),
                             CE_None);
        }
    }
    free(row);
    GDALClose(file);
}

void fixture_write_heights(const struct fixture *f, const char *name,
                           const struct raster_place *place,
                           double (*heights)(double latitude, double longitude), char *path)
{
    snprintf(path, 128, "%s/%s.tif", f->folder, name);
    // Whole globes as integers, as they come; insets as floats.
    const bool is_globe = place->texel * place->width >= 360;
    write_raster(&(struct writer){path, place, heights, is_globe ? GDT_Int16 : GDT_Float32, 1});
}

void fixture_write_bytes(const struct fixture *f, const char *name,
                         const struct raster_place *place,
                         double (*values)(double latitude, double longitude), char *path)
{
    snprintf(path, 128, "%s/%s.tif", f->folder, name);
    write_raster(&(struct writer){path, place, values, GDT_Byte, 3});
}

struct camera fixture_camera(const struct camera_place *p)
{
    const struct vec3 up = vec3_from_lat_lon(p->latitude * DEGREE, p->longitude * DEGREE);
    const struct vec3 east = {-sin(p->longitude * DEGREE), cos(p->longitude * DEGREE), 0};
    const struct vec3 north = vec3_cross(up, east);
    const double heading = p->heading * DEGREE;
    const double pitch = p->pitch * DEGREE;
    const struct vec3 ahead =
        vec3_add(vec3_scale(east, sin(heading)), vec3_scale(north, cos(heading)));
    const struct vec3 right =
        vec3_add(vec3_scale(east, cos(heading)), vec3_scale(north, -sin(heading)));
    const struct vec3 forward = vec3_add(vec3_scale(ahead, cos(pitch)), vec3_scale(up, sin(pitch)));
    const double half = tan(p->fov * DEGREE / 2);
    return (struct camera){.position_m = vec3_scale(up, p->radius_m + p->altitude_m),
                           .right = right,
                           .up = vec3_cross(right, forward),
                           .forward = forward,
                           .tan_half_fov_x = half,
                           .tan_half_fov_y = half,
                           .sun_direction = up};
}

void fixture_picture_init(const struct fixture *f, struct picture *out)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.width = desc.height = PICTURE_SIDE;
    desc.filter = GPU_FILTER_NEAREST;
    desc.format = GPU_FORMAT_RGBA32F;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &out->position), TRL_OK);
    desc.format = GPU_FORMAT_DEPTH32F;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &out->depth), TRL_OK);
    const struct gpu_target_desc target = {.color_count = 1,
                                           .colors = {{.texture = &out->position}},
                                           .depth = {.texture = &out->depth}};
    assert_int_equal(gpu_target_init(f->gpu, &target, &out->target), TRL_OK);
    out->pixels = mem_alloc(f->ctx, (size_t)PICTURE_SIDE * PICTURE_SIDE, 4 * sizeof(float));
    assert_non_null(out->pixels);
}

void fixture_picture_draw(struct picture *picture, struct mesher *mesher,
                          const struct camera *camera)
{
    assert_int_equal(mesher_update(mesher, camera), TRL_OK);
    assert_int_equal(mesher_draw(mesher, &picture->target), TRL_OK);
    const struct gpu_region all = gpu_texture_region(&picture->position, 0);
    assert_int_equal(gpu_texture_read(&picture->position, &all, picture->pixels), TRL_OK);
}

void fixture_picture_finish(const struct fixture *f, struct picture *picture)
{
    gpu_target_finish(&picture->target);
    gpu_texture_finish(&picture->position);
    gpu_texture_finish(&picture->depth);
    mem_free(f->ctx, picture->pixels);
}

// Reads a region of the three targets where the pointers are not NULL.
struct composed_region {
    struct gpu_region region;
    void *pixels[3];
};

static void compose_region(const struct fixture *f, const struct surface *s,
                           const struct camera *camera, const struct composed_region *out)
{
    struct mesher *mesher;
    struct terrain_shadow shadow;
    struct terrain_compose compose;
    struct picture picture;
    struct gpu_texture colors[3];
    static const enum gpu_format FORMATS[3] = {GPU_FORMAT_RGBA8, GPU_FORMAT_RGBA32F,
                                               GPU_FORMAT_RGBA8};
    const struct hemisphere_desc grid = {FIXTURE_CELLS, false};
    assert_int_equal(hemisphere_create_of(s, &grid, &mesher), TRL_OK);
    assert_int_equal(terrain_shadow_init(s, 0.0047, &shadow), TRL_OK);
    assert_int_equal(terrain_compose_init(s, &compose), TRL_OK);
    fixture_picture_init(f, &picture);
    struct gpu_target_desc target_desc = {.color_count = 3};
    for (int i = 0; i < 3; i++) {
        struct gpu_texture_desc desc = gpu_texture_desc_default();
        desc.width = desc.height = PICTURE_SIDE;
        desc.filter = GPU_FILTER_NEAREST;
        desc.format = FORMATS[i];
        assert_int_equal(gpu_texture_init(f->gpu, &desc, &colors[i]), TRL_OK);
        target_desc.colors[i].texture = &colors[i];
    }
    struct gpu_target target;
    assert_int_equal(gpu_target_init(f->gpu, &target_desc, &target), TRL_OK);
    fixture_picture_draw(&picture, mesher, camera);
    assert_int_equal(terrain_shadow_update(&shadow, camera), TRL_OK);
    const struct terrain_compose_inputs inputs = {
        .camera = camera, .position = &picture.position, .shadow = &shadow};
    assert_int_equal(terrain_compose_draw(&compose, &inputs, &target), TRL_OK);
    for (int i = 0; i < 3; i++) {
        if (out->pixels[i]) {
            assert_int_equal(gpu_texture_read(&colors[i], &out->region, out->pixels[i]), TRL_OK);
        }
    }
    gpu_target_finish(&target);
    for (int i = 0; i < 3; i++) {
        gpu_texture_finish(&colors[i]);
    }
    fixture_picture_finish(f, &picture);
    terrain_compose_finish(&compose);
    terrain_shadow_finish(&shadow);
    mesher_destroy(&mesher);
}

struct composed fixture_compose_middle(const struct fixture *f, const struct surface *s,
                                       const struct camera *camera)
{
    struct composed c;
    const struct composed_region middle = {
        .region = {0, PICTURE_SIDE / 2, PICTURE_SIDE / 2, 0, 1, 1, 1},
        .pixels = {c.albedo_water, c.normal_sun, c.lights}};
    compose_region(f, s, camera, &middle);
    return c;
}

struct composed_picture fixture_compose(const struct fixture *f, const struct surface *s,
                                        const struct camera *camera)
{
    const size_t count = (size_t)PICTURE_SIDE * PICTURE_SIDE;
    const struct composed_picture p = {mem_alloc(f->ctx, count, 4),
                                       mem_alloc(f->ctx, count, 4 * sizeof(float))};
    assert_non_null(p.albedo_water);
    assert_non_null(p.normal_sun);
    const struct composed_region all = {.region = {0, 0, 0, 0, PICTURE_SIDE, PICTURE_SIDE, 1},
                                        .pixels = {p.albedo_water, p.normal_sun, NULL}};
    compose_region(f, s, camera, &all);
    return p;
}

struct vec3 fixture_ray(const struct camera *camera, int x, int y)
{
    return vec3_normalize(
        camera_ray(camera, 2 * (x + 0.5) / PICTURE_SIDE - 1, 2 * (y + 0.5) / PICTURE_SIDE - 1));
}
