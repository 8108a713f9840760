// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Layers that blend in all modes, exaggerated: heights by every mesher, by the bounds and by rays;
// shadows; pictures and masks. The CPU's values against formulas, the GPU's against the CPU's.
#include "planet.h"

#include "shared/blend.glsl"
#include "terrain/look.h"

#include <math.h>
#include <stdio.h>

static const double R = 1e6;
static const double DEGREE = 3.14159265358979323846 / 180;
static const double EXAGGERATION = 3;

// High land: what a factor is off by counts there.
static double land(double latitude, double longitude)
{
    return 1400 + 90 * sin(latitude / 7) * cos(longitude / 6);
}

static double ice(double latitude, double longitude)
{
    return 40 + 25 * sin(latitude / 2) * sin(longitude / 3);
}

static double factor(double latitude, double longitude)
{
    return 1.2 + 0.15 * cos(latitude / 3) * sin(longitude / 2);
}

static double peaks(double latitude, double longitude)
{
    return 1700 + 150 * sin(latitude / 1.5) * sin(longitude / 1.7);
}

static double beds(double latitude, double longitude)
{
    return 1400 + 150 * cos(latitude / 1.6) * sin(longitude / 1.9);
}

enum { GLOBE, ADDED, FACTOR, HIGHER, LOWER, LAYERS };

// Degrees; ice, factors and peaks over each other, and beds elsewhere: four are seen at a time.
static const struct raster_place PLACES[LAYERS] = {[GLOBE] = {-180, 90, 0.5, 720, 360},
                                                   [ADDED] = {10, 60, 0.1, 300, 300},
                                                   [FACTOR] = {15, 55, 0.1, 300, 250},
                                                   [HIGHER] = {20, 50, 0.1, 300, 200},
                                                   [LOWER] = {-160, 30, 0.1, 300, 300}};
static const double MODES[LAYERS] = {BLEND_OVER, BLEND_ADD, BLEND_MULTIPLY, BLEND_MAX, BLEND_MIN};
static planet_heights *const HEIGHTS[LAYERS] = {land, ice, factor, peaks, beds};

static bool is_on(int layer, double latitude, double longitude, double margin)
{
    const struct raster_place *p = &PLACES[layer];
    return longitude > p->west + margin && longitude < p->west + p->texel * p->width - margin &&
           latitude < p->north - margin && latitude > p->north - p->texel * p->height + margin;
}

// What the layers make of each other, where none of them is in its feather.
static double expected(double latitude, double longitude)
{
    double h = land(latitude, longitude);
    h += is_on(ADDED, latitude, longitude, 0) ? ice(latitude, longitude) : 0;
    h *= is_on(FACTOR, latitude, longitude, 0) ? factor(latitude, longitude) : 1;
    h = is_on(HIGHER, latitude, longitude, 0) ? fmax(h, peaks(latitude, longitude)) : h;
    h = is_on(LOWER, latitude, longitude, 0) ? fmin(h, beds(latitude, longitude)) : h;
    return EXAGGERATION * h;
}

static bool is_in_feather(double latitude, double longitude)
{
    bool is_in = false;
    for (int i = ADDED; i < LAYERS; i++) {
        is_in =
            is_in || (is_on(i, latitude, longitude, -0.1) && !is_on(i, latitude, longitude, 2.1));
    }
    return is_in;
}

static void make_planet(struct fixture *f, struct planet *out)
{
    char paths[LAYERS][128];
    struct surface_layer_desc layers[LAYERS];
    for (int i = 0; i < LAYERS; i++) {
        char name[16];
        snprintf(name, sizeof name, "blend%d", i);
        fixture_write_heights(f, name, &PLACES[i], HEIGHTS[i], paths[i]);
        // Peaks and beds are exaggerated as all heights are.
        layers[i] = (struct surface_layer_desc){.kind = SURFACE_ELEVATION,
                                                .path = paths[i],
                                                .scale = 1,
                                                .mode = MODES[i],
                                                .feather_rad = 2 * DEGREE};
    }
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = LAYERS;
    desc.layers = layers;
    desc.exaggeration = EXAGGERATION;
    desc.is_strict = true;
    *out = (struct planet){.f = f};
    assert_int_equal(surface_init(f->gpu, &desc, &out->relief.surface), TRL_OK);
    assert_int_equal(terrain_ceiling_init(&out->relief.surface, &out->relief.ceiling), TRL_OK);
    out->truth = relief_surface(&out->relief);
}

static double hash_of(int i)
{
    return fmod(fabs(sin(i * 12.9898) * 43758.5453), 1);
}

// Also that bounds and ceilings hold what is there, feathers included.
static void heights_are_what_the_modes_say(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    const struct surface *s = &p.relief.surface;
    int looked_at = 0;
    for (int i = 0; i < 20000; i++) {
        const bool is_low = i % 4 == 0;
        const double latitude = (is_low ? -5 : 25) + 40 * hash_of(3 * i);
        const double longitude = (is_low ? -170 : 5) + 50 * hash_of(7 * i);
        const struct vec3 up = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
        const double height = surface_altitude(s, up);
        if (!is_in_feather(latitude, longitude)) {
            looked_at++;
            // Whole metres of the globe, times 1.35 and the exaggeration; two surfaces that cross
            // between texels are blended after they are sampled.
            assert_close(height, expected(latitude, longitude), 0.6 * 1.35 * EXAGGERATION);
        }
        const double reach = pow(10, -1 - 3 * hash_of(11 * i));
        const struct vec3 aside = {hash_of(5 * i) - 0.5, hash_of(13 * i) - 0.5,
                                   hash_of(17 * i) - 0.5};
        const struct vec3 near = vec3_normalize(vec3_add(up, vec3_scale(aside, reach)));
        const double angle = acos(fmin(vec3_dot(near, up), 1)) + 1e-7;
        const struct surface_bounds b = surface_bounds_around(s, near, angle);
        assert_true((double)b.min <= height && height <= (double)b.max);
        assert_true(terrain_ceiling_m(&p.relief.ceiling, near, angle) >= height);
    }
    assert_true(looked_at > 8000);
    planet_destroy(&p);
}

// Land on both sides of the sphere, and a factor that turns part of it over, so that the lowest
// land becomes the highest.
static double two_sided(double latitude, double longitude)
{
    return 2000 * sin(latitude / 9) * cos(longitude / 8) - 1200;
}

static double turning(double latitude, double longitude)
{
    return 0.2 + 1.2 * sin(latitude / 0.7) * cos(longitude / 0.9);
}

static void check_bounds(const struct surface *s)
{
    struct terrain_ceiling ceiling;
    assert_int_equal(terrain_ceiling_init(s, &ceiling), TRL_OK);
    for (int i = 0; i < 2000; i++) {
        const double latitude = 28 + 30 * hash_of(3 * i), longitude = 12 + 30 * hash_of(7 * i);
        const struct vec3 up = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
        const double height = surface_altitude(s, up);
        const double reach = pow(10, -1 - 6 * hash_of(11 * i));
        const struct vec3 aside = {hash_of(5 * i) - 0.5, hash_of(13 * i) - 0.5,
                                   hash_of(17 * i) - 0.5};
        const struct vec3 near = vec3_normalize(vec3_add(up, vec3_scale(aside, reach)));
        const double angle = 2 * asin(vec3_length(vec3_sub(near, up)) / 2) + 1e-9;
        const struct surface_bounds b = surface_bounds_around(s, near, angle);
        if (!((double)b.min <= height && height <= (double)b.max)) {
            fail_msg("%.2f outside of %.2f to %.2f", height, (double)b.min, (double)b.max);
        }
        const double high = terrain_ceiling_m(&ceiling, near, angle);
        if (!(high >= height)) {
            fail_msg("reach %g: ceiling %.2f below %.2f", angle, high, height);
        }
    }
    terrain_ceiling_finish(&ceiling);
}

static void no_ground_is_above_its_ceiling(void **state)
{
    static const struct {
        double mode, scale;
        planet_heights *region;
    } CASES[] = {{BLEND_MULTIPLY, 1, factor},
                 {BLEND_MULTIPLY, 1, turning},
                 {BLEND_ADD, 1000, turning},
                 {BLEND_MAX, 1000, turning},
                 {BLEND_MIN, 1000, turning}};
    struct fixture *f = *state;
    char globe[128], region[128];
    fixture_write_heights(f, "globe", &PLACES[GLOBE], two_sided, globe);
    for (int i = 0; i < 10; i++) {
        fixture_write_heights(f, "region", &PLACES[ADDED], CASES[i / 2].region, region);
        const struct surface_layer_desc layers[2] = {
            {.kind = SURFACE_ELEVATION, .path = globe, .scale = 1},
            {.kind = SURFACE_ELEVATION,
             .path = region,
             .scale = CASES[i / 2].scale,
             .mode = CASES[i / 2].mode,
             .feather_rad = DEGREE}};
        struct surface_desc desc = surface_desc_default();
        desc.radius_m = R;
        desc.layer_count = 2;
        desc.layers = layers;
        desc.exaggeration = EXAGGERATION;
        desc.detail = (struct surface_detail){.roughness = 0.02 * (i % 2), .smallest_m = 1000};
        struct surface s;
        assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
        check_bounds(&s);
        surface_finish(&s);
    }
}

static void every_mesher_draws_them(void **state)
{
    // From a feather over all modes but the least, and 2 m above ground that is multiplied.
    static const struct camera_place views[] = {
        {.latitude = 48, .longitude = 18, .heading = 100, .pitch = -10, .fov = 50},
        {.latitude = 52.4, .longitude = 30, .heading = 200, .pitch = -2, .fov = 50}};
    static const double heights[] = {8e3, 2};
    struct planet p;
    make_planet(*state, &p);
    for (int kind = 0; mesher_name((trl_mesher)kind); kind++) {
        if (kind == TRL_MESHER_TESSELLATED || !planet_use(&p, (trl_mesher)kind)) {
            continue; // the first one's grid
        }
        for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
            const struct camera camera = planet_camera(&p, views[i], heights[i]);
            const struct mesh_error e = planet_check(&p, &camera, 400, 10);
            printf("%s from %g m: shift %.3f (%.2f), silhouettes %.3f (%.2f) of %u, %u lost, %u "
                   "holes of %u\n",
                   mesher_name((trl_mesher)kind), heights[i], e.shift_rms, e.shift_max, e.edge_rms,
                   e.edge_max, e.edges, e.lost_edges, e.holes, e.places);
            assert_true(e.places > 500);
            assert_true(e.shift_rms < 0.5);
            assert_true(e.edge_rms < 0.5);
            assert_int_equal(e.holes, 0);
        }
    }
    planet_destroy(&p);
}

// Sea in the west; the second mask knows water in the north.
static double in_the_west(double latitude, double longitude)
{
    (void)latitude;
    return longitude < 0 ? 255 : 0;
}

static double in_the_north(double latitude, double longitude)
{
    (void)longitude;
    return latitude > 0 ? 255 : 0;
}

static double below_the_sea(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return -100;
}

// Where masks together say water, ground is raised to the sea; held whole and in tiles.
static void masks_level_the_sea_together(void **state)
{
    const struct fixture *f = *state;
    // In the west's north and south, in the east's: 1 is the sea.
    static const int IS_SEA[LAYERS][4] = {[GLOBE] = {1, 0, 1, 0},
                                          [ADDED] = {1, 1, 1, 0},
                                          [FACTOR] = {1, 0, 0, 0},
                                          [HIGHER] = {1, 1, 1, 0},
                                          [LOWER] = {1, 0, 0, 0}};
    char paths[3][128];
    fixture_write_heights(f, "bed", &PLACES[GLOBE], below_the_sea, paths[0]);
    fixture_write_bytes(f, "west", &PLACES[GLOBE], in_the_west, paths[1]);
    fixture_write_bytes(f, "north", &PLACES[GLOBE], in_the_north, paths[2]);
    for (int i = 0; i < 2 * LAYERS; i++) {
        const struct surface_layer_desc layers[3] = {
            {.kind = SURFACE_ELEVATION, .path = paths[0], .scale = 1},
            {.kind = SURFACE_WATER, .path = paths[1]},
            {.kind = SURFACE_WATER, .path = paths[2], .mode = MODES[i / 2]}};
        struct surface_desc desc = surface_desc_default();
        desc.radius_m = R;
        desc.layer_count = 3;
        desc.layers = layers;
        desc.max_bytes = i % 2 ? 1 : desc.max_bytes;
        struct surface s;
        assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
        for (int k = 0; k < 4; k++) {
            const struct vec3 up =
                vec3_from_lat_lon((k % 2 ? -30 : 30) * DEGREE, (k / 2 ? 50 : -50) * DEGREE);
            assert_close(surface_altitude(&s, up), IS_SEA[i / 2][k] ? 0 : -100, 1e-6);
        }
        surface_finish(&s);
    }
}

static double dark(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 120;
}

static double bright(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 180;
}

// Linear parts of white of the pictures, parts of 1 of the masks: dark, and bright over it.
static double mix(double mode, double below, double value)
{
    switch ((int)mode) {
    case 1:
        return fmin(below + value, 1);
    case 2:
        return below * value;
    case 3:
        return fmax(below, value);
    case 4:
        return fmin(below, value);
    default:
        return value;
    }
}

static double linear_of(double code)
{
    return pow((code / 255 + 0.055) / 1.055, 2.4);
}

enum { PIXELS = PICTURE_SIDE * PICTURE_SIDE };

// A surface as it is drawn: its textures are albedo and water, normals and the part of the sun that
// is seen, lights.
struct view {
    struct surface surface;
    struct mesher *mesher;
    struct terrain_shadow shadow;
    struct terrain_compose compose;
    struct picture picture;
    struct gpu_texture colors[3];
    struct gpu_target target;
};

static void make_view(const struct fixture *f, const struct surface_desc *desc, struct view *v)
{
    static const enum gpu_format FORMATS[3] = {GPU_FORMAT_RGBA8, GPU_FORMAT_RGBA32F,
                                               GPU_FORMAT_RGBA8};
    struct gpu_texture_desc texture = gpu_texture_desc_default();
    struct gpu_target_desc target = {.color_count = 3};
    assert_int_equal(surface_init(f->gpu, desc, &v->surface), TRL_OK);
    assert_int_equal(mesher_create(&v->surface, TRL_MESHER_QUADTREE, &v->mesher), TRL_OK);
    assert_int_equal(terrain_shadow_init(&v->surface, 0.0047, &v->shadow), TRL_OK);
    assert_int_equal(terrain_compose_init(&v->surface, &v->compose), TRL_OK);
    fixture_picture_init(f, &v->picture);
    texture.width = texture.height = PICTURE_SIDE;
    texture.filter = GPU_FILTER_NEAREST;
    for (int i = 0; i < 3; i++) {
        texture.format = FORMATS[i];
        assert_int_equal(gpu_texture_init(f->gpu, &texture, &v->colors[i]), TRL_OK);
        target.colors[i].texture = &v->colors[i];
    }
    assert_int_equal(gpu_target_init(f->gpu, &target, &v->target), TRL_OK);
}

static void draw_view(struct view *v, const struct camera *camera)
{
    fixture_picture_draw(&v->picture, v->mesher, camera);
    assert_int_equal(terrain_shadow_update(&v->shadow, camera), TRL_OK);
    const struct terrain_compose_inputs inputs = {
        .camera = camera, .position = &v->picture.position, .shadow = &v->shadow};
    assert_int_equal(terrain_compose_draw(&v->compose, &inputs, &v->target), TRL_OK);
}

static void destroy_view(const struct fixture *f, struct view *v)
{
    gpu_target_finish(&v->target);
    for (int i = 0; i < 3; i++) {
        gpu_texture_finish(&v->colors[i]);
    }
    fixture_picture_finish(f, &v->picture);
    terrain_compose_finish(&v->compose);
    terrain_shadow_finish(&v->shadow);
    mesher_destroy(&v->mesher);
    surface_finish(&v->surface);
}

// One pair of surfaces, whose modes are changed in place: programs are made once.
static void check_pictures(struct view *drawn, struct surface *held, double mode)
{
    static const enum surface_kind KINDS[3] = {SURFACE_COLOUR, SURFACE_LIGHTS, SURFACE_WATER};
    const struct camera_place place = {45, 25, R, 1e5, 0, -90, 20};
    const struct camera camera = fixture_camera(&place);
    const struct gpu_region middle = {0, PICTURE_SIDE / 2, PICTURE_SIDE / 2, 0, 1, 1, 1};
    const double colour = mix(mode, linear_of(120), linear_of(180));
    const double water = mix(mode, 120.0 / 255, 180.0 / 255);
    double rgb[3] = {0.3, 0.3, 0.3}, glow[3] = {0}, code;
    uint8_t albedo_water[4], lights[4];
    for (int k = 0; k < 3; k++) {
        drawn->surface.layers[KINDS[k]][1].mode = held->layers[KINDS[k]][1].mode = mode;
    }
    draw_view(drawn, &camera);
    assert_int_equal(gpu_texture_read(&drawn->colors[0], &middle, albedo_water), TRL_OK);
    assert_int_equal(gpu_texture_read(&drawn->colors[2], &middle, lights), TRL_OK);
    assert_true(surface_picture(held, SURFACE_COLOUR, camera.position_m, rgb));
    assert_true(surface_picture(held, SURFACE_LIGHTS, camera.position_m, glow));
    // A step of a byte of the root, once of each picture and once of the target.
    assert_close(rgb[1], colour, 0.01);
    assert_close(glow[1], colour, 0.01);
    assert_close(pow(albedo_water[1] / 255.0, 2), colour, 0.015);
    assert_close(pow(lights[1] / 255.0, 2), colour, 0.015);
    assert_close(surface_water(held, camera.position_m, &code), water, 1e-3);
    assert_close(albedo_water[3] / 255.0, water, 0.01);
}

static void pictures_and_masks_blend_as_they_say(void **state)
{
    const struct fixture *f = *state;
    char paths[2][128];
    fixture_write_bytes(f, "dark", &PLACES[GLOBE], dark, paths[0]);
    fixture_write_bytes(f, "bright", &PLACES[ADDED], bright, paths[1]);
    const struct surface_layer_desc layers[6] = {
        {.kind = SURFACE_COLOUR, .path = paths[0]},
        {.kind = SURFACE_COLOUR, .path = paths[1], .mode = BLEND_ADD},
        {.kind = SURFACE_LIGHTS, .path = paths[0]},
        {.kind = SURFACE_LIGHTS, .path = paths[1]},
        {.kind = SURFACE_WATER, .path = paths[0]},
        {.kind = SURFACE_WATER, .path = paths[1]}};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = 6;
    desc.layers = layers;
    desc.depth = (struct surface_depth){.is_told = true, .everywhere_m = 50};
    desc.is_strict = true;
    struct view drawn;
    struct surface held;
    make_view(f, &desc, &drawn);
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &held), TRL_OK);
    for (int i = 0; i < LAYERS; i++) {
        check_pictures(&drawn, &held, MODES[i]);
    }
    surface_finish(&held);
    destroy_view(f, &drawn);
}

// A roof of 500 m, or one of 500 / 6 m that a factor of 2 and the exaggeration raise to that.
static double ridge(double latitude, double longitude)
{
    (void)latitude;
    return fmax(0, 500 * (1 - fabs(longitude - 25) / 0.2));
}

static double low_ridge(double latitude, double longitude)
{
    return ridge(latitude, longitude) / 6;
}

static double twice(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 2;
}

static void draw_ridge(const struct fixture *f, const struct surface_desc *desc, float *normal_sun)
{
    const struct camera_place place = {45, 24.7, R, 3e4, 0, -90, 60};
    struct camera camera = fixture_camera(&place);
    // In the east, 5 degrees high.
    camera.sun_direction = vec3_from_lat_lon(0, (24.7 + 90) * DEGREE);
    camera.sun_direction = vec3_normalize(vec3_add(
        camera.sun_direction, vec3_scale(vec3_normalize(camera.position_m), tan(5 * DEGREE))));
    struct view v;
    make_view(f, desc, &v);
    draw_view(&v, &camera);
    const struct gpu_region all = gpu_texture_region(&v.colors[1], 0);
    assert_int_equal(gpu_texture_read(&v.colors[1], &all, normal_sun), TRL_OK);
    destroy_view(f, &v);
}

static void what_is_raised_has_its_shadow_and_normals(void **state)
{
    const struct fixture *f = *state;
    char paths[3][128];
    const struct raster_place place = {20, 50, 0.05, 200, 200};
    fixture_write_heights(f, "ridge", &place, ridge, paths[0]);
    fixture_write_heights(f, "low", &place, low_ridge, paths[1]);
    fixture_write_heights(f, "twice", &place, twice, paths[2]);
    const struct surface_layer_desc layers[3] = {
        {.kind = SURFACE_ELEVATION, .path = paths[0], .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = paths[1], .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = paths[2], .scale = 1, .mode = BLEND_MULTIPLY}};
    static float plain[4 * PIXELS], raised[4 * PIXELS];
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = 1;
    desc.layers = layers;
    draw_ridge(f, &desc, plain);
    desc.layer_count = 2;
    desc.layers = layers + 1;
    desc.exaggeration = EXAGGERATION;
    draw_ridge(f, &desc, raised);
    int shaded = 0, lit = 0;
    for (int i = 0; i < PIXELS; i++) {
        const float *a = plain + 4 * i, *b = raised + 4 * i;
        for (int k = 0; k < 4; k++) {
            assert_close((double)b[k], (double)a[k], k < 3 ? 1e-4 : 0.02);
        }
        shaded += a[3] < 0.5f;
        lit += a[3] > 0.99f;
    }
    assert_true(shaded > PIXELS / 50 && lit > PIXELS / 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heights_are_what_the_modes_say),
        cmocka_unit_test(no_ground_is_above_its_ceiling),
        cmocka_unit_test(every_mesher_draws_them),
        cmocka_unit_test(what_is_raised_has_its_shadow_and_normals),
        cmocka_unit_test(pictures_and_masks_blend_as_they_say),
        cmocka_unit_test(masks_level_the_sea_together),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
