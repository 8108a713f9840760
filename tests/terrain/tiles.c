// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Rasters that do not fit are held in tiles, and nobody sees it: heights, colours and meshes are
// those of the same rasters held whole, in a part of the memory.
#include "fixture.h"
#include "terrain/look.h"
#include "terrain/stream.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double DEGREE = 3.14159265358979323846 / 180;
static const double RADIUS_M = 2e6;
// 18 tiles of level 0, and 25.
static const struct raster_place GLOBE = {-180, 90, 0.25, 1440, 720};
static const struct raster_place LARGE_GLOBE = {-180, 90, 1.0 / 7, 2520, 1260}; // 50
static const struct raster_place INSET = {20, 12, 0.01, 1100, 1100};
static const double WHOLE = 1e9, TILED = 1e6; // allowed bytes; the least that tiles get is more

static double hills(double latitude, double longitude)
{
    return 1500 + 900 * sin(latitude * 0.7) * cos(longitude * 0.9) +
           200 * sin(latitude * 4) * sin(longitude * 5);
}

// With a hole of two degrees.
static double fine_hills(double latitude, double longitude)
{
    return hypot(latitude - 5, longitude - 27) < 1 ? (double)NAN : hills(latitude, longitude) + 400;
}

static double stripes(double latitude, double longitude)
{
    return 128 + 100 * sin(latitude * 3) * sin(longitude * 4);
}

static double south_is_water(double latitude, double longitude)
{
    (void)longitude;
    return latitude < -40 ? 255 : 0;
}

struct files {
    char globe[128], inset[128], colour[128], water[128];
    struct surface_layer_desc layers[4];
};

static void write_files(const struct fixture *f, const struct raster_place *globe,
                        struct files *files)
{
    fixture_write_heights(f, "globe", globe, hills, files->globe);
    fixture_write_heights(f, "inset", &INSET, fine_hills, files->inset);
    fixture_write_bytes(f, "colour", globe, stripes, files->colour);
    fixture_write_bytes(f, "water", &GLOBE, south_is_water, files->water);
    const struct surface_layer_desc layers[4] = {
        // Half below the sea level where there is water.
        {.kind = SURFACE_ELEVATION, .path = files->globe, .scale = 2, .offset_m = -3000},
        {.kind = SURFACE_ELEVATION, .path = files->inset, .scale = 1, .feather_rad = 0.5 * DEGREE},
        {.kind = SURFACE_COLOUR, .path = files->colour},
        {.kind = SURFACE_WATER, .path = files->water}};
    memcpy(files->layers, layers, sizeof layers);
}

static struct surface_desc describe(const struct files *files, double max_bytes)
{
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = RADIUS_M;
    desc.layers = files->layers;
    desc.layer_count = 4;
    desc.is_strict = true;
    desc.max_bytes = max_bytes;
    return desc;
}

static struct vec3 place(int i, double south, double north)
{
    const double latitude = south + (north - south) * fmod(i * 0.618033988749895, 1);
    return vec3_from_lat_lon(latitude * DEGREE, (-180 + 360 * fmod(i * 0.7548776662, 1)) * DEGREE);
}

static void heights_and_colours_are_those_of_whole_rasters(void **state)
{
    const struct fixture *f = *state;
    struct files files;
    write_files(f, &GLOBE, &files);
    const struct surface_desc whole_desc = describe(&files, WHOLE);
    const struct surface_desc tiled_desc = describe(&files, TILED);
    struct surface whole, tiled;
    assert_int_equal(surface_init_on_cpu(f->ctx, &whole_desc, &whole), TRL_OK);
    assert_int_equal(surface_init_on_cpu(f->ctx, &tiled_desc, &tiled), TRL_OK);
    assert_null(whole.stream);
    assert_non_null(tiled.stream);
    assert_int_equal(tiled.stream->layer_count, 4);
    for (int i = 0; i < 1500; i++) {
        // Around the poles texels are averaged in another way, from the coarse level.
        const struct vec3 d =
            i % 3 == 0 ? vec3_from_lat_lon((3 + i * 0.004) * DEGREE, (22 + i * 0.006) * DEGREE)
                       : place(i, -86, 86);
        const double to_hole = acos(vec3_dot(d, vec3_from_lat_lon(5 * DEGREE, 27 * DEGREE)));
        // In the gap stand heights of a coarse level, filled, instead of fine ones: bends of half
        // a degree.
        const double tolerance = to_hole < 1.1 * DEGREE ? 60 : 1e-6;
        assert_close(surface_altitude(&tiled, d), surface_altitude(&whole, d), tolerance);
        double a[3] = {0}, b[3] = {0};
        assert_true(surface_picture(&whole, SURFACE_COLOUR, d, a));
        assert_true(surface_picture(&tiled, SURFACE_COLOUR, d, b));
        assert_close(a[1], b[1], 1e-9);
        assert_close(surface_half_texel_m(&tiled, d, 0), surface_half_texel_m(&whole, d, 0), 1e-6);
    }
    surface_finish(&whole);
    surface_finish(&tiled);
}

static void snow_is_that_of_whole_rasters(void **state)
{
    const struct fixture *f = *state;
    struct files files;
    write_files(f, &GLOBE, &files);
    files.layers[2].is_cover = true;
    files.layers[2].cover_rgb[1] = 0.8f;
    const struct surface_desc whole_desc = describe(&files, WHOLE);
    const struct surface_desc tiled_desc = describe(&files, TILED);
    struct surface whole, tiled;
    assert_int_equal(surface_init_on_cpu(f->ctx, &whole_desc, &whole), TRL_OK);
    assert_int_equal(surface_init_on_cpu(f->ctx, &tiled_desc, &tiled), TRL_OK);
    for (int i = 0; i < 300; i++) {
        const struct vec3 d = place(i, -86, 86);
        double a[3] = {0.1, 0.1, 0.1}, b[3] = {0.1, 0.1, 0.1};
        assert_true(surface_picture(&whole, SURFACE_COLOUR, d, a));
        assert_true(surface_picture(&tiled, SURFACE_COLOUR, d, b));
        assert_close(a[1], b[1], 1e-9);
        assert_true(a[1] >= 0.0999 && a[1] < 0.804); // between what is below and snow
    }
    surface_finish(&whole);
    surface_finish(&tiled);
}

static void bounds_hold_what_tiles_have(void **state)
{
    const struct fixture *f = *state;
    struct files files;
    write_files(f, &GLOBE, &files);
    const struct surface_desc desc = describe(&files, TILED);
    struct surface tiled;
    assert_int_equal(surface_init(f->gpu, &desc, &tiled), TRL_OK);
    const struct camera camera =
        fixture_camera(&(struct camera_place){20, 40, RADIUS_M, 30000, 0, -40, 60});
    assert_int_equal(surface_update(&tiled, &camera, 0.01), TRL_OK);
    for (int i = 0; i < 500; i++) {
        const struct vec3 d = place(i, -90, 90);
        const struct surface_bounds b = surface_bounds_around(&tiled, d, 0.01);
        const double altitude = surface_altitude(&tiled, d);
        assert_true(altitude >= (double)b.min && altitude <= (double)b.max);
        assert_true(surface_min_altitude(&tiled) <= (double)b.min);
    }
    surface_finish(&tiled);
}

static const struct camera_place VIEWS[] = {
    {10, 30, 2e6, 9e5, 0, -90, 50},      // all of it
    {5, 33, 2e6, 2500, 250, -3, 60},     // over the inset, toward its hole
    {12, 180, 2e6, 20000, 90, -20, 60},  // across the antimeridian
    {-50, -20, 2e6, 8000, 180, -15, 60}, // water
};
enum { VIEW_COUNT = sizeof VIEWS / sizeof *VIEWS };

static double pixel_of(const struct camera *camera)
{
    return 2 * camera->tan_half_fov_y / PICTURE_SIDE;
}

static void expect_same_middle(const struct fixture *f, struct surface *whole,
                               struct surface *tiled, const struct camera *camera)
{
    const struct composed a = fixture_compose_middle(f, whole, camera);
    const struct composed b = fixture_compose_middle(f, tiled, camera);
    for (int c = 0; c < 4; c++) {
        // Means of square roots differ from roots of means, by less than two codes here.
        assert_close(a.albedo_water[c], b.albedo_water[c], 2);
        // Half floats, and levels of detail whose means are rounded elsewhere.
        assert_close((double)a.normal_sun[c], (double)b.normal_sun[c], 0.02);
    }
}

// Ground in the middle of the picture, as distance from the camera.
static double middle_distance(const struct fixture *f, struct mesher *mesher,
                              const struct camera *camera)
{
    struct picture picture;
    fixture_picture_init(f, &picture);
    fixture_picture_draw(&picture, mesher, camera);
    const float *p = picture.pixels + 4 * (PICTURE_SIDE / 2 * PICTURE_SIDE + PICTURE_SIDE / 2);
    const double distance = sqrt((double)(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
    fixture_picture_finish(f, &picture);
    return distance;
}

static void views_are_those_of_whole_rasters(void **state)
{
    const struct fixture *f = *state;
    struct files files;
    write_files(f, &GLOBE, &files);
    const struct surface_desc whole_desc = describe(&files, WHOLE);
    const struct surface_desc tiled_desc = describe(&files, TILED);
    struct surface whole, tiled;
    assert_int_equal(surface_init(f->gpu, &whole_desc, &whole), TRL_OK);
    assert_int_equal(surface_init(f->gpu, &tiled_desc, &tiled), TRL_OK);
    for (size_t i = 0; i < VIEW_COUNT; i++) {
        const struct camera camera = fixture_camera(&VIEWS[i]);
        assert_int_equal(surface_update(&tiled, &camera, pixel_of(&camera)), TRL_OK);
        assert_true(surface_is_settled(&tiled));
        expect_same_middle(f, &whole, &tiled, &camera);
    }
    // All views together needed fewer tiles than there are.
    const struct tile_cache_stats stats = tile_cache_stats(tiled.stream->cache);
    assert_true(stats.loaded > 20 && stats.failed == 0);
    surface_finish(&whole);
    surface_finish(&tiled);
}

static void check_mesh_of_tiles(const struct fixture *f, const struct files *files,
                                trl_mesher mesher)
{
    const struct surface_desc whole_desc = describe(files, WHOLE);
    struct surface_desc tiled_desc = describe(files, TILED);
    tiled_desc.waits = false;
    struct surface whole, tiled;
    struct mesher *on_whole, *on_tiled;
    assert_int_equal(surface_init(f->gpu, &whole_desc, &whole), TRL_OK);
    assert_int_equal(surface_init(f->gpu, &tiled_desc, &tiled), TRL_OK);
    assert_int_equal(mesher_create(&whole, mesher, &on_whole), TRL_OK);
    assert_int_equal(mesher_create(&tiled, mesher, &on_tiled), TRL_OK);
    const struct camera camera = fixture_camera(&VIEWS[2]);
    (void)middle_distance(f, on_tiled, &camera); // of the coarsest level
    for (int i = 0; i < 5000 && (i == 0 || !surface_is_settled(&tiled)); i++) {
        usleep(2000);
        assert_int_equal(surface_update(&tiled, &camera, pixel_of(&camera)), TRL_OK);
    }
    const double wanted = middle_distance(f, on_whole, &camera);
    // Meshes have other cells where bounds are wider: half a pixel at most.
    assert_close(middle_distance(f, on_tiled, &camera), wanted,
                 wanted * 0.5 * pixel_of(&camera) + 1);
    mesher_destroy(&on_whole);
    mesher_destroy(&on_tiled);
    surface_finish(&whole);
    surface_finish(&tiled);
}

// Finding what a mesh is made of must not read the ground finely everywhere: a view over two
// degrees of the planet shows 28 tiles of all levels, and 75 were read where each square of the
// mesh asked for the finest.
static void meshes_read_only_what_they_show(void **state)
{
    const struct fixture *f = *state;
    struct files files;
    write_files(f, &LARGE_GLOBE, &files);
    for (int m = 0; trl_mesher_name((trl_mesher)m) != NULL; m++) {
        if (m == TRL_MESHER_TESSELLATED && !f->gpu->caps.has_tessellation) {
            continue;
        }
        const struct surface_desc desc = describe(&files, TILED);
        struct surface tiled;
        struct mesher *mesher;
        assert_int_equal(surface_init(f->gpu, &desc, &tiled), TRL_OK);
        assert_int_equal(mesher_create(&tiled, (trl_mesher)m, &mesher), TRL_OK);
        const struct camera_place place = {10, -60, RADIUS_M, 2000, 90, -60, 40};
        const struct camera camera = fixture_camera(&place);
        assert_int_equal(surface_update(&tiled, &camera, pixel_of(&camera)), TRL_OK);
        (void)middle_distance(f, mesher, &camera);
        const uint64_t loaded = tile_cache_stats(tiled.stream->cache).loaded;
        printf("%s: %u tiles\n", trl_mesher_name((trl_mesher)m), (unsigned)loaded);
        assert_true(loaded > 0 && loaded <= 40);
        mesher_destroy(&mesher);
        surface_finish(&tiled);
    }
}

// Meshes are made of what tiles there are, and anew of what comes.
static void meshes_follow_what_comes(void **state)
{
    const struct fixture *f = *state;
    struct files files;
    write_files(f, &GLOBE, &files);
    for (int m = 0; trl_mesher_name((trl_mesher)m) != NULL; m++) {
        if (m != TRL_MESHER_TESSELLATED || f->gpu->caps.has_tessellation) {
            check_mesh_of_tiles(f, &files, (trl_mesher)m);
        }
    }
}

static void a_surface_that_does_not_wait_comes_to_the_same(void **state)
{
    const struct fixture *f = *state;
    struct files files;
    write_files(f, &GLOBE, &files);
    struct surface_desc desc = describe(&files, TILED);
    struct surface waiting, tiled;
    assert_int_equal(surface_init(f->gpu, &desc, &waiting), TRL_OK);
    desc.waits = false;
    assert_int_equal(surface_init(f->gpu, &desc, &tiled), TRL_OK);
    const struct camera camera = fixture_camera(&VIEWS[2]);
    assert_int_equal(surface_update(&waiting, &camera, pixel_of(&camera)), TRL_OK);
    // At once there is something to draw with, though not all.
    assert_int_equal(surface_update(&tiled, &camera, pixel_of(&camera)), TRL_OK);
    assert_false(surface_is_settled(&tiled));
    (void)fixture_compose_middle(f, &tiled, &camera);
    const uint64_t first = surface_revision(&tiled);
    for (int i = 0; i < 5000 && !surface_is_settled(&tiled); i++) {
        usleep(2000);
        assert_int_equal(surface_update(&tiled, &camera, pixel_of(&camera)), TRL_OK);
    }
    assert_true(surface_is_settled(&tiled));
    assert_true(surface_revision(&tiled) > first);
    expect_same_middle(f, &waiting, &tiled, &camera);
    surface_finish(&waiting);
    surface_finish(&tiled);
}

// One step of the camera, and more is read than it shows: what twelve such steps lead to.
static void tiles_ahead_of_the_camera_are_read(void **state)
{
    const struct fixture *f = *state;
    struct files files;
    write_files(f, &LARGE_GLOBE, &files);
    struct surface_desc desc = describe(&files, TILED);
    desc.waits = false;
    struct surface tiled;
    assert_int_equal(surface_init(f->gpu, &desc, &tiled), TRL_OK);
    struct camera_place place = {10, -60, RADIUS_M, 20000, 90, -20, 60};
    const struct camera here = fixture_camera(&place);
    for (int i = 0; i < 5000 && (i == 0 || !surface_is_settled(&tiled)); i++) {
        usleep(2000);
        assert_int_equal(surface_update(&tiled, &here, pixel_of(&here)), TRL_OK);
    }
    const uint64_t before = tile_cache_stats(tiled.stream->cache).loaded;
    place.longitude += 0.25; // 8.6 km
    const struct camera there = fixture_camera(&place);
    assert_int_equal(surface_update(&tiled, &there, pixel_of(&there)), TRL_OK);
    const uint64_t shown = tiled.stream->missing;
    uint64_t loaded = 0;
    for (int i = 0; i < 1000 && loaded <= shown; i++) {
        usleep(5000);
        loaded = tile_cache_stats(tiled.stream->cache).loaded - before;
    }
    assert_true(loaded > shown);
    surface_finish(&tiled);
}

static void a_flight_stays_within_the_budget(void **state)
{
    const struct fixture *f = *state;
    struct files files;
    write_files(f, &LARGE_GLOBE, &files);
    struct surface_desc desc = describe(&files, TILED);
    struct surface tiled;
    assert_int_equal(surface_init(f->gpu, &desc, &tiled), TRL_OK);
    for (int i = 0; i < 24; i++) {
        const struct camera camera = fixture_camera(
            &(struct camera_place){30 * sin(i * 0.4), i * 15, RADIUS_M, 15000, 90, -20, 60});
        assert_int_equal(surface_update(&tiled, &camera, pixel_of(&camera)), TRL_OK);
        assert_true(surface_is_settled(&tiled));
    }
    const struct tile_cache_stats stats = tile_cache_stats(tiled.stream->cache);
    // 32 MB, the least, of which the cache has half.
    assert_true(stats.most_bytes <= 16000000);
    assert_true(stats.evicted > 0);
    surface_finish(&tiled);
}

static void what_is_cut_off_is_drawn_coarsely(void **state)
{
    struct fixture *f = *state;
    struct files files;
    write_files(f, &GLOBE, &files);
    struct surface_desc desc = describe(&files, TILED);
    desc.layer_count = 1;
    struct surface tiled;
    assert_int_equal(surface_init(f->gpu, &desc, &tiled), TRL_OK);
    // The southern half goes away after the coarse level was read.
    assert_int_equal(truncate(files.globe, 1440 * 720), 0);
    const struct camera camera =
        fixture_camera(&(struct camera_place){-60, 30, RADIUS_M, 20000, 0, -60, 60});
    f->last_error[0] = 0;
    assert_int_equal(surface_update(&tiled, &camera, pixel_of(&camera)), TRL_OK);
    assert_int_equal(surface_update(&tiled, &camera, pixel_of(&camera)), TRL_OK);
    assert_true(surface_is_settled(&tiled));
    assert_non_null(strstr(f->last_error, "globe.tif"));
    assert_non_null(strstr(f->last_error, "coarser texels stand in"));
    f->last_error[0] = 0;
    // As far as the coarse level, of 0.7 degrees, knows it: the finest hills are lost.
    const double wanted = -3000 + 2 * hills(-60, 30);
    assert_close(surface_altitude(&tiled, vec3_from_lat_lon(-60 * DEGREE, 30 * DEGREE)), wanted,
                 400);
    (void)fixture_compose_middle(f, &tiled, &camera);
    assert_int_equal(surface_update(&tiled, &camera, pixel_of(&camera)), TRL_OK);
    assert_int_equal(f->last_error[0], 0); // once
    surface_finish(&tiled);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, fixture_set_up, fixture_tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(heights_and_colours_are_those_of_whole_rasters),
        TEST(snow_is_that_of_whole_rasters),
        TEST(bounds_hold_what_tiles_have),
        TEST(views_are_those_of_whole_rasters),
        TEST(meshes_read_only_what_they_show),
        TEST(meshes_follow_what_comes),
        TEST(a_surface_that_does_not_wait_comes_to_the_same),
        TEST(tiles_ahead_of_the_camera_are_read),
        TEST(a_flight_stays_within_the_budget),
        TEST(what_is_cut_off_is_drawn_coarsely),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
