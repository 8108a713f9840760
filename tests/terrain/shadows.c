// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A ridge along a meridian on a level planet: how far its shadow falls, and where it does not.
#include "fixture.h"

#include <math.h>

static const double R = 6371000;
static const double DEGREE = 3.14159265358979323846 / 180;
static const double CREST_M = 500;
static const double HALF_WIDTH_DEG = 0.01;
static const double SUN_RADIUS_RAD = 0.00465;

// A roof with its crest on a column of texels, at longitude 0.
static double ridge_height(double latitude, double longitude)
{
    (void)latitude;
    return fmax(0, CREST_M * (1 - fabs(longitude) / HALF_WIDTH_DEG));
}

struct scene {
    struct surface surface;
    struct mesher *mesher;
    struct terrain_shadow shadow;
    struct terrain_compose compose;
    struct picture picture;
    struct gpu_texture albedo, normal;
    struct gpu_target target;
    float *visible; // w of the normal target
};

static struct gpu_texture make_texture(struct fixture *f, enum gpu_format format)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.width = desc.height = PICTURE_SIDE;
    desc.filter = GPU_FILTER_NEAREST;
    desc.format = format;
    struct gpu_texture texture;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
    return texture;
}

static void make_scene(struct fixture *f, struct scene *s)
{
    char path[128];
    const struct raster_place place = {-1.0005, 0.5, 0.001, 2001, 1000};
    fixture_write_heights(f, "ridge", &place, ridge_height, path);
    const struct surface_layer_desc layer = {.kind = SURFACE_ELEVATION, .path = path, .scale = 1};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layers = &layer;
    desc.layer_count = 1;
    assert_int_equal(surface_init(f->gpu, &desc, &s->surface), TRL_OK);
    assert_int_equal(mesher_create(&s->surface, TRL_MESHER_HEMISPHERE, &s->mesher), TRL_OK);
    assert_int_equal(terrain_shadow_init(&s->surface, SUN_RADIUS_RAD, &s->shadow), TRL_OK);
    assert_int_equal(terrain_compose_init(&s->surface, &s->compose), TRL_OK);
    fixture_picture_init(f, &s->picture);
    s->albedo = make_texture(f, GPU_FORMAT_RGBA8);
    s->normal = make_texture(f, GPU_FORMAT_RGBA32F);
    // Without the lights, which are not looked at.
    const struct gpu_target_desc target = {
        .color_count = 2, .colors = {{.texture = &s->albedo}, {.texture = &s->normal}}};
    assert_int_equal(gpu_target_init(f->gpu, &target, &s->target), TRL_OK);
    s->visible = mem_alloc(f->ctx, (size_t)PICTURE_SIDE * PICTURE_SIDE, 4 * sizeof(float));
    assert_non_null(s->visible);
}

static void destroy_scene(struct fixture *f, struct scene *s)
{
    mem_free(f->ctx, s->visible);
    gpu_target_finish(&s->target);
    gpu_texture_finish(&s->albedo);
    gpu_texture_finish(&s->normal);
    fixture_picture_finish(f, &s->picture);
    terrain_compose_finish(&s->compose);
    terrain_shadow_finish(&s->shadow);
    mesher_destroy(&s->mesher);
    surface_finish(&s->surface);
}

// A camera that looks down at the ridge's west side, with the sun in the east.
static struct camera draw_scene(struct scene *s, double elevation_deg, double width_m)
{
    const double high = 4000;
    const struct camera_place place = {.latitude = 0,
                                       .longitude = -0.5 * width_m / R / DEGREE,
                                       .radius_m = R,
                                       .altitude_m = high,
                                       .pitch = -90,
                                       .fov = 2 * atan(0.75 * width_m / high) / DEGREE};
    struct camera camera = fixture_camera(&place);
    const double e = elevation_deg * DEGREE;
    // As seen at the foot of the crest, longitude 0.
    camera.sun_direction = (struct vec3){sin(e), cos(e), 0};
    fixture_picture_draw(&s->picture, s->mesher, &camera);
    assert_int_equal(terrain_shadow_update(&s->shadow, &camera), TRL_OK);
    const struct terrain_compose_inputs inputs = {
        .camera = &camera, .position = &s->picture.position, .shadow = &s->shadow};
    assert_int_equal(terrain_compose_draw(&s->compose, &inputs, &s->target), TRL_OK);
    const struct gpu_region all = gpu_texture_region(&s->normal, 0);
    assert_int_equal(gpu_texture_read(&s->normal, &all, s->visible), TRL_OK);
    return camera;
}

// Distance west of the crest at which half the sun is seen, along the middle row.
static double measure_shadow(const struct scene *s, const struct camera *camera)
{
    const int row = PICTURE_SIDE / 2;
    double before_m = 0;
    double before = 0;
    for (int x = PICTURE_SIDE - 1; x >= 0; x--) {
        const float *p = s->picture.pixels + 4 * (row * PICTURE_SIDE + x);
        const struct vec3 at = {camera->position_m.x + (double)p[0],
                                camera->position_m.y + (double)p[1], 0};
        const double west = -atan2(at.y, at.x) * R;
        const double seen = (double)s->visible[4 * (row * PICTURE_SIDE + x) + 3];
        // Beyond the roof itself.
        if (west > HALF_WIDTH_DEG * DEGREE * R && seen >= 0.5 && before < 0.5) {
            return before_m + (west - before_m) * (0.5 - before) / fmax(seen - before, 1e-6);
        }
        before_m = west;
        before = seen;
    }
    return -1;
}

static void test_shadow_is_as_long_as_the_sun_is_low(void **state)
{
    struct fixture *f = *state;
    struct scene s;
    make_scene(f, &s);
    const double elevations[] = {2, 4, 8};
    for (int i = 0; i < 3; i++) {
        const double e = elevations[i] * DEGREE;
        // The ray over the crest meets the sphere where (R + h) cos e' = R cos(e' + a), with e' its
        // elevation at the end and the sun's direction e at longitude 0: a = e - e' and
        // (R + h) cos e = R cos(e - a).
        const double truth = R * (e - acos((R + CREST_M) / R * cos(e)));
        const struct camera camera = draw_scene(&s, elevations[i], 1.3 * truth);
        const double got = measure_shadow(&s, &camera);
        // h / tan(e) but for the curve, which is 5 % at 2 degrees.
        assert_close(truth, CREST_M / tan(e), 0.06 * truth);
        // A map cell at the ridge, 10 km from the camera, is 400 m long; linear between cells, a
        // roof of 0.45 is cut by 0.45 * 400 / 4 = 45 m at most, never raised. A pixel is 1.2 %.
        const double cut = 45 / tan(e - truth / R);
        assert_true(got < 1.015 * truth);
        assert_true(got > 0.985 * truth - cut);
    }
    destroy_scene(f, &s);
}

static void test_sunny_sides_and_high_suns_are_lit(void **state)
{
    struct fixture *f = *state;
    struct scene s;
    make_scene(f, &s);
    // The roof's slope is 24 degrees: no shadow from a sun at 50.
    draw_scene(&s, 50, 3000);
    for (int i = 0; i < PICTURE_SIDE * PICTURE_SIDE; i++) {
        assert_true(s.visible[4 * i + 3] > 0.99f);
    }
    // East of the crest the sun of 8 degrees is in full view.
    const struct camera camera = draw_scene(&s, 8, 3000);
    int lit = 0;
    for (int i = 0; i < PICTURE_SIDE * PICTURE_SIDE; i++) {
        const float *p = s.picture.pixels + 4 * i;
        if (camera.position_m.y + (double)p[1] > 100) {
            assert_true(s.visible[4 * i + 3] > 0.99f);
            lit++;
        }
    }
    assert_true(lit > 100);
    destroy_scene(f, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shadow_is_as_long_as_the_sun_is_low),
        cmocka_unit_test(test_sunny_sides_and_high_suns_are_lit),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
