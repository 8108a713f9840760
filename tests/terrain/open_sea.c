// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Open sea is drawn by a shorter way, and looks as it does by the whole one.
#include "terrain/open_sea.h"
#include "fixture.h"
#include "gpu/hide.h"
#include "shared/sea.glsl"
#include "terrain/kinds.h"

#include <stdio.h>
#include <stdlib.h>

static const double R = 6.4e6;
enum { SIDE = PICTURE_SIDE, COLORS = 4, SQUARES = SIDE / GPU_HIDE_SQUARE };
enum { ELEVATION, WATER, COLOUR, LAYERS };

// A sea between land in the east and a rock; depths from the heights below it.
static bool is_land(double latitude, double longitude)
{
    return longitude > 0 || (fabs(longitude + 20) < 1.5 && fabs(latitude) < 1.5);
}

static double find_height(double latitude, double longitude)
{
    return is_land(latitude, longitude) ? 300 : 10 * longitude;
}

static double find_water(double latitude, double longitude)
{
    return is_land(latitude, longitude) ? 0 : 255;
}

static double find_colour(double latitude, double longitude)
{
    return 128 + 100 * sin(latitude) * cos(longitude);
}

// What there is no shorter way for.
enum stop { NO_STOP, BED, CHANGED_MASK };
static void make_surface(const struct fixture *f, enum stop stop, struct surface *out)
{
    static const enum surface_kind KINDS[LAYERS] = {SURFACE_ELEVATION, SURFACE_WATER,
                                                    SURFACE_COLOUR};
    const struct raster_place place = {-180, 90, 0.5, 720, 360};
    char paths[LAYERS][128];
    struct surface_layer_desc layers[LAYERS];
    fixture_write_heights(f, "heights", &place, find_height, paths[ELEVATION]);
    fixture_write_bytes(f, "water", &place, find_water, paths[WATER]);
    fixture_write_bytes(f, "colour", &place, find_colour, paths[COLOUR]);
    for (int i = 0; i < LAYERS; i++) {
        layers[i] = (struct surface_layer_desc){.kind = KINDS[i], .path = paths[i], .scale = 1};
    }
    layers[ELEVATION].has_bed = stop == BED;
    layers[WATER].mode = stop == CHANGED_MASK ? 3 : 0;
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = LAYERS;
    desc.layers = layers;
    desc.is_strict = true;
    desc.detail =
        (struct surface_detail){.roughness = 1, .albedo_variation = 0.2, .smallest_m = 10};
    desc.depth = (struct surface_depth){.is_told = true, .everywhere_m = -1};
    assert_int_equal(surface_init(f->gpu, &desc, out), TRL_OK);
}

// Everything that a picture of the ground is drawn with, and its pixels.
struct stage {
    struct mesher *mesher;
    struct terrain_shadow shadow;
    struct terrain_compose compose;
    struct terrain_kinds kinds;
    struct terrain_open_sea open_sea;
    struct gpu_hide hide;
    struct picture picture;
    struct gpu_texture colors[COLORS];
    struct gpu_target target, kinds_target;
};

static void stage_init(const struct fixture *f, const struct surface *s, struct stage *out)
{
    static const enum gpu_format FORMATS[COLORS] = {GPU_FORMAT_RGBA8, GPU_FORMAT_RGBA32F,
                                                    GPU_FORMAT_RGBA8, GPU_FORMAT_RGBA8};
    const struct hemisphere_desc grid = {FIXTURE_CELLS, false};
    assert_int_equal(hemisphere_create_of(s, &grid, &out->mesher), TRL_OK);
    assert_int_equal(terrain_shadow_init(s, 0.0047, &out->shadow), TRL_OK);
    assert_int_equal(terrain_compose_init(s, &out->compose), TRL_OK);
    assert_int_equal(terrain_kinds_init(f->gpu, &out->kinds), TRL_OK);
    assert_int_equal(terrain_open_sea_init(s, &out->open_sea), TRL_OK);
    assert_int_equal(gpu_hide_init(f->gpu, &out->hide), TRL_OK);
    fixture_picture_init(f, &out->picture);
    assert_int_equal(terrain_open_sea_resize(&out->open_sea, &out->picture.depth), TRL_OK);
    struct gpu_target_desc target = {.color_count = COLORS, .depth.texture = &out->picture.depth};
    const struct gpu_target_desc kinds = {.depth.texture = &out->picture.depth};
    for (int i = 0; i < COLORS; i++) {
        struct gpu_texture_desc desc = gpu_texture_desc_default();
        desc.width = desc.height = SIDE;
        desc.filter = GPU_FILTER_NEAREST;
        desc.format = FORMATS[i];
        assert_int_equal(gpu_texture_init(f->gpu, &desc, &out->colors[i]), TRL_OK);
        target.colors[i].texture = &out->colors[i];
    }
    assert_int_equal(gpu_target_init(f->gpu, &target, &out->target), TRL_OK);
    assert_int_equal(gpu_target_init(f->gpu, &kinds, &out->kinds_target), TRL_OK);
}

static void stage_finish(const struct fixture *f, struct stage *stage)
{
    gpu_target_finish(&stage->kinds_target);
    gpu_target_finish(&stage->target);
    for (int i = 0; i < COLORS; i++) {
        gpu_texture_finish(&stage->colors[i]);
    }
    fixture_picture_finish(f, &stage->picture);
    gpu_hide_finish(&stage->hide);
    terrain_open_sea_finish(&stage->open_sea);
    terrain_kinds_finish(&stage->kinds);
    terrain_compose_finish(&stage->compose);
    terrain_shadow_finish(&stage->shadow);
    mesher_destroy(&stage->mesher);
}

struct pixels {
    uint8_t albedo[4 * SIDE * SIDE], lights[4 * SIDE * SIDE], region[4 * SIDE * SIDE];
    float normal[4 * SIDE * SIDE];
    uint8_t squares[4 * SQUARES * SQUARES];
};

static void read_pixels(const struct stage *stage, struct pixels *out)
{
    const struct gpu_region all = gpu_texture_region(&stage->colors[0], 0);
    void *const pixels[COLORS] = {out->albedo, out->normal, out->lights, out->region};
    for (int i = 0; i < COLORS; i++) {
        assert_int_equal(gpu_texture_read(&stage->colors[i], &all, pixels[i]), TRL_OK);
    }
}

// As frame/ground.c does it. False: no open sea is looked for.
static bool draw(struct stage *stage, const struct camera *camera, bool by_shorter_way,
                 struct pixels *out)
{
    const struct gpu_texture *open = NULL;
    struct terrain_compose_inputs inputs = {.camera = camera,
                                            .position = &stage->picture.position,
                                            .shadow = &stage->shadow,
                                            .region_m = 20000};
    fixture_picture_draw(&stage->picture, stage->mesher, camera);
    assert_int_equal(terrain_shadow_update(&stage->shadow, camera), TRL_OK);
    assert_int_equal(terrain_kinds_draw(&stage->kinds, inputs.position, &stage->kinds_target),
                     TRL_OK);
    assert_int_equal(terrain_open_sea_find(&stage->open_sea, &inputs, &open), TRL_OK);
    if (open && by_shorter_way) {
        const struct gpu_region all = {0, 0, 0, 0, SQUARES, SQUARES, 1};
        inputs.has_open = true;
        assert_int_equal(
            gpu_hide_draw(&stage->hide, open, TERRAIN_OPEN_DEPTH, &stage->kinds_target), TRL_OK);
        assert_int_equal(gpu_texture_read(open, &all, out->squares), TRL_OK);
    }
    assert_int_equal(terrain_compose_draw(&stage->compose, &inputs, &stage->target), TRL_OK);
    read_pixels(stage, out);
    return open;
}

static int find_apart(const uint8_t *a, const uint8_t *b, int count)
{
    int most = 0;
    for (int c = 0; c < count; c++) {
        most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
    }
    return most;
}

// The part of the picture that is drawn by the shorter way. What the water hides of the ground's
// own colour is nobody's.
static double compare(const struct pixels *whole, const struct pixels *shorter)
{
    int open = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int square = (i / SIDE / GPU_HIDE_SQUARE) * SQUARES + i % SIDE / GPU_HIDE_SQUARE;
        const bool is_open = shorter->squares[square] > 0;
        const uint8_t *a = whole->albedo + 4 * i, *b = shorter->albedo + 4 * i;
        open += is_open;
        assert_true(a[3] == b[3] && (!is_open || a[3] == 255));
        assert_true(is_open || find_apart(a, b, 3) == 0);
        assert_true(find_apart(whole->lights + 4 * i, shorter->lights + 4 * i, 4) <= is_open);
        assert_true(find_apart(whole->region + 4 * i, shorter->region + 4 * i, 4) <= is_open);
        for (int c = 0; c < 4; c++) {
            assert_close((double)whole->normal[4 * i + c], (double)shorter->normal[4 * i + c],
                         1e-6);
        }
    }
    return 1.0 * open / (SIDE * SIDE);
}

// From space, with land on both sides; over the coast; far out, level.
static const struct {
    struct camera_place place;
    double least, most; // part of the picture that is open sea
} VIEWS[] = {{{0, -10, 6.4e6, 2e6, 0, -90, 70}, 0.2, 0.8},
             {{0, -3, 6.4e6, 2e5, 90, -30, 60}, 0.05, 0.6},
             {{0, -40, 6.4e6, 1e4, 30, -5, 50}, 0.3, 0.7}};

static void open_sea_looks_as_by_the_whole_way(void **state)
{
    static struct pixels whole, shorter;
    const struct fixture *f = *state;
    struct surface s;
    struct stage stage = {0};
    make_surface(f, NO_STOP, &s);
    stage_init(f, &s, &stage);
    for (size_t i = 0; i < sizeof VIEWS / sizeof VIEWS[0]; i++) {
        const struct camera camera = fixture_camera(&VIEWS[i].place);
        assert_true(draw(&stage, &camera, false, &whole));
        assert_true(draw(&stage, &camera, true, &shorter));
        const double part = compare(&whole, &shorter);
        printf("view %zu: %.3f of the picture\n", i, part);
        assert_true(part > VIEWS[i].least && part < VIEWS[i].most);
    }
    stage_finish(f, &stage);
    surface_finish(&s);
}

static void beds_and_changed_masks_have_no_shorter_way(void **state)
{
    static struct pixels pixels;
    const struct fixture *f = *state;
    for (int stop = BED; stop <= CHANGED_MASK; stop++) {
        struct surface s;
        struct stage stage = {0};
        make_surface(f, (enum stop)stop, &s);
        stage_init(f, &s, &stage);
        const struct camera camera = fixture_camera(&VIEWS[0].place);
        assert_false(draw(&stage, &camera, true, &pixels));
        stage_finish(f, &stage);
        surface_finish(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(open_sea_looks_as_by_the_whole_way),
        cmocka_unit_test(beds_and_changed_masks_have_no_shorter_way)};
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
