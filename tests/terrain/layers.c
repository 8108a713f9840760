// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What rasters become: altitudes on the CPU, bounds, the sea, gaps, poles, errors, pictures.
#include "fixture.h"
#include "terrain/ceiling.h"
#include "terrain/look.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEGREE = 3.14159265358979323846 / 180;
static const struct raster_place GLOBE = {-180, 90, 1, 360, 180};
static const struct raster_place INSET = {10, 50, 0.1, 100, 100};

static double smooth_height(double latitude, double longitude)
{
    return 1000 * cos(latitude * DEGREE) * cos(longitude * DEGREE);
}

static double noisy_height(double latitude, double longitude)
{
    return 500 + 400 * sin(latitude * 91) * cos(longitude * 57);
}

static double inset_height(double latitude, double longitude)
{
    const double to_middle = hypot(latitude - 45, longitude - 15);
    return to_middle < 1 ? NAN : 3000;
}

static double west_is_water(double latitude, double longitude)
{
    (void)latitude;
    return longitude < 0 ? 255 : 0;
}

static double grey(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 188;
}

static double altitude(const struct surface *s, double latitude, double longitude)
{
    return surface_altitude(s, vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE));
}

static struct surface_desc describe(const struct surface_layer_desc *layers, size_t count)
{
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = 6.4e6;
    desc.layers = layers;
    desc.layer_count = count;
    return desc;
}

static void test_altitude_follows_scale_and_offset(void **state)
{
    struct fixture *f = *state;
    char path[128];
    fixture_write_heights(f, "smooth", &GLOBE, smooth_height, path);
    const struct surface_layer_desc layer = {
        .kind = SURFACE_ELEVATION, .path = path, .scale = 2, .offset_m = 100};
    const struct surface_desc desc = describe(&layer, 1);
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    for (int i = 0; i < 500; i++) {
        const double latitude = -85 + i * 0.34;
        const double longitude = -180 + fmod(i * 77.7, 360);
        // Stored as whole units of 2 m, smoothed by the cubic: 1/18 of the bend each way,
        // 2000 m (1 degree)^2 = 0.6 m.
        assert_close(altitude(&s, latitude, longitude),
                     100 + 2 * smooth_height(latitude, longitude), 2);
    }
    surface_finish(&s);
}

static void test_poles_have_one_height_and_the_antimeridian_no_step(void **state)
{
    struct fixture *f = *state;
    char path[128];
    fixture_write_heights(f, "noisy", &GLOBE, noisy_height, path);
    const struct surface_layer_desc layer = {.kind = SURFACE_ELEVATION, .path = path, .scale = 1};
    const struct surface_desc desc = describe(&layer, 1);
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    for (int i = 0; i < 36; i++) {
        // The last row is level; only the rows over it, across the pole, mix in: rounding to 1 m.
        assert_close(altitude(&s, 89.99999, i * 10), altitude(&s, 89.99999, 0), 2);
        assert_close(altitude(&s, -89.99999, i * 10), altitude(&s, -89.99999, 0), 2);
        const double latitude = -85 + i * 4.7;
        // 2e-6 degrees apart on slopes of some 100 m a degree.
        assert_close(altitude(&s, latitude, 179.999999), altitude(&s, latitude, -179.999999), 1e-2);
    }
    surface_finish(&s);
}

static void test_insets_lie_over_and_their_gaps_show_what_is_below(void **state)
{
    struct fixture *f = *state;
    char globe[128];
    char inset[128];
    fixture_write_heights(f, "smooth", &GLOBE, smooth_height, globe);
    fixture_write_heights(f, "inset", &INSET, inset_height, inset);
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = globe, .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = inset, .scale = 1, .feather_rad = 2 * DEGREE}};
    const struct surface_desc desc = describe(layers, 2);
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    assert_close(altitude(&s, 47.5, 15), 3000, 1e-6);
    assert_close(altitude(&s, 45, 9.99), smooth_height(45, 9.99), 1.5);
    assert_close(altitude(&s, 45, 10.01), smooth_height(45, 10), 2);
    // Half way through the feather, half of each.
    assert_close(altitude(&s, 44, 11), (3000 + smooth_height(44, 11)) / 2, 2);
    surface_finish(&s);
}

// From 3000 m at the rim of a hole of 1 degree's radius to what is below, over half a degree.
static void test_gaps_have_no_cliffs(void **state)
{
    struct fixture *f = *state;
    char globe[128];
    char inset[128];
    fixture_write_heights(f, "smooth", &GLOBE, smooth_height, globe);
    fixture_write_heights(f, "inset", &INSET, inset_height, inset);
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = globe, .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = inset, .scale = 1, .feather_rad = 0.5 * DEGREE}};
    const struct surface_desc desc = describe(layers, 2);
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    // Rounded to a metre in the layer below.
    assert_close(altitude(&s, 45, 15), smooth_height(45, 15), 1.5);
    // What fills the gap is known the more coarsely the farther its rim is: 1 + r / 2 texels.
    const struct terrain_layer *layer = &s.layers[SURFACE_ELEVATION][1];
    assert_close(layer_coarser(layer, 49.5, 20), 0, 0);
    assert_close(layer_coarser(layer, 49.5, 49.5), log2(1 + 0.5 * 10), 0.15);
    assert_close(layer_coarser(layer, 49.5, 44.5), log2(1 + 0.5 * 5), 0.15);
    double before = altitude(&s, 46.5, 15);
    assert_close(before, 3000, 1e-6); // no good height is touched
    for (double latitude = 46.5; latitude > 45.4; latitude -= 0.02) {
        const double now = altitude(&s, latitude, 15);
        // 2300 m over half a degree, at the smooth step's steepest: 1.5 times 92 m in a fiftieth;
        // the cubic overshoots a little where it begins and ends.
        assert_true(now < before + 10 && now > before - 180);
        before = now;
    }
    surface_finish(&s);
}

static void test_bounds_hold_every_altitude(void **state)
{
    struct fixture *f = *state;
    char globe[128];
    char inset[128];
    fixture_write_heights(f, "noisy", &GLOBE, noisy_height, globe);
    fixture_write_heights(f, "inset", &INSET, inset_height, inset);
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = globe, .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = inset, .scale = 1}};
    const struct surface_desc desc = describe(layers, 2);
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    srand(3);
    for (int i = 0; i < 5000; i++) {
        const double latitude = asin(2.0 * rand() / RAND_MAX - 1) / DEGREE;
        const double longitude = 360.0 * rand() / RAND_MAX - 180;
        const struct vec3 at = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
        const double angle = 0.2 * rand() / RAND_MAX;
        const struct surface_bounds b = surface_bounds_around(&s, at, angle);
        const double north = fmin(latitude + angle / DEGREE, 90);
        assert_true((double)b.min <= altitude(&s, latitude, longitude));
        assert_true((double)b.max >= altitude(&s, latitude, longitude));
        assert_true((double)b.max >= altitude(&s, north, longitude));
        assert_true((double)b.min >= surface_min_altitude(&s));
        assert_true((double)b.max <= surface_max_altitude(&s));
    }
    // They are of use: the inset's mountains are not everywhere.
    assert_true(surface_max_altitude(&s) >= 3000);
    const struct vec3 away = vec3_from_lat_lon(-30 * DEGREE, -100 * DEGREE);
    assert_true(surface_bounds_around(&s, away, 0.1).max < 1500);
    surface_finish(&s);
}

static void test_water_is_level_and_dry_land_may_be_low(void **state)
{
    struct fixture *f = *state;
    char globe[128];
    char mask[128];
    fixture_write_heights(f, "smooth", &GLOBE, smooth_height, globe);
    fixture_write_bytes(f, "mask", &GLOBE, west_is_water, mask);
    // Water may come after the heights that it levels.
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = globe, .scale = 1},
        {.kind = SURFACE_WATER, .path = mask}};
    const struct surface_desc desc = describe(layers, 2);
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    assert_close(altitude(&s, 10, -120), 0, 1e-9);
    assert_close(altitude(&s, 10, -30), smooth_height(10, -30), 1.5); // a lake stays up
    assert_close(altitude(&s, 10, 120), smooth_height(10, 120), 1.5); // and low land low
    surface_finish(&s);
}

static void expect_failure(struct fixture *f, const struct surface_desc *desc, trl_result wanted,
                           const char *said)
{
    struct surface s;
    f->last_error[0] = 0;
    assert_int_equal(surface_init(f->gpu, desc, &s), wanted);
    assert_non_null(strstr(f->last_error, said));
    assert_false(surface_has_layers(&s));
}

static void test_errors_name_the_file(void **state)
{
    struct fixture *f = *state;
    char path[128];
    fixture_write_heights(f, "smooth", &GLOBE, smooth_height, path);
    struct surface_layer_desc layer = {.kind = SURFACE_ELEVATION, .path = path, .scale = 1};
    struct surface_desc desc = describe(&layer, 1);
    desc.is_strict = true;
    layer.scale = 0;
    expect_failure(f, &desc, TRL_ERROR_INVALID, "smooth.tif");
    layer.path = "/nonexistent/nowhere.tif";
    layer.scale = 1;
    expect_failure(f, &desc, TRL_ERROR_IO, "nowhere.tif");
    struct surface_layer_desc many[SURFACE_MAX_LAYERS + 1];
    for (size_t i = 0; i <= SURFACE_MAX_LAYERS; i++) {
        many[i] = (struct surface_layer_desc){.kind = SURFACE_ELEVATION, .path = path, .scale = 1};
    }
    desc = describe(many, SURFACE_MAX_LAYERS + 1);
    desc.is_strict = true;
    expect_failure(f, &desc, TRL_ERROR_INVALID, "elevation layers");
}

static void test_a_missing_optional_layer_is_passed_over(void **state)
{
    struct fixture *f = *state;
    const struct surface_layer_desc layer = {
        .kind = SURFACE_LIGHTS, .path = "/nonexistent/lights.tif", .is_optional = true};
    const struct surface_desc desc = describe(&layer, 1);
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    assert_false(surface_has_layers(&s));
    assert_close(altitude(&s, 10, 20), 0, 0);
    surface_finish(&s);
}

static void test_pixels_hold_colour_water_normal_and_lights(void **state)
{
    struct fixture *f = *state;
    char paths[4][128];
    fixture_write_heights(f, "smooth", &GLOBE, smooth_height, paths[0]);
    fixture_write_bytes(f, "mask", &GLOBE, west_is_water, paths[1]);
    fixture_write_bytes(f, "grey", &GLOBE, grey, paths[2]);
    const struct surface_layer_desc layers[4] = {
        {.kind = SURFACE_ELEVATION, .path = paths[0], .scale = 50},
        {.kind = SURFACE_WATER, .path = paths[1]},
        {.kind = SURFACE_COLOUR, .path = paths[2]},
        {.kind = SURFACE_LIGHTS, .path = paths[1]}};
    struct surface_desc desc = describe(layers, 4);
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    const struct camera_place place = {.latitude = 30,
                                       .longitude = -40,
                                       .radius_m = desc.radius_m,
                                       .altitude_m = 1e5,
                                       .pitch = -90,
                                       .fov = 20};
    const struct camera camera = fixture_camera(&place);
    const struct composed c = fixture_compose_middle(f, &s, &camera);
    for (int i = 0; i < 3; i++) {
        // sRGB 188 is linear 0.503, whose root is 0.709: one step of rounding.
        assert_in_range(c.albedo_water[i], 180, 182);
        assert_int_equal(c.lights[i], 255);
    }
    assert_int_equal(c.albedo_water[3], 255);
    // h = 50 * 1000 cos(latitude) cos(longitude) = 50 km times the direction's x. Its slope at the
    // pixel: the part of 50 km * x-axis that is tangent, over the radius.
    const struct vec3 up = vec3_normalize(camera.position_m);
    const struct vec3 x = {50000, 0, 0};
    const struct vec3 gradient =
        vec3_scale(vec3_sub(x, vec3_scale(up, vec3_dot(up, x))), 1 / desc.radius_m);
    const struct vec3 n = vec3_normalize(vec3_sub(up, gradient));
    // Heights in whole units of 50 m over a degree (112 km): 5e-4 of slope.
    assert_close((double)c.normal_sun[0], n.x, 1e-3);
    assert_close((double)c.normal_sun[1], n.y, 1e-3);
    assert_close((double)c.normal_sun[2], n.z, 1e-3);
    assert_close((double)c.normal_sun[3], 1, 1e-6);
    surface_finish(&s);
}

// Half of the sphere is grey with snow over a half of that.
static void test_snow_lies_over_colours_where_its_mask_says(void **state)
{
    struct fixture *f = *state;
    char picture[128], mask[128];
    fixture_write_bytes(f, "grey", &GLOBE, grey, picture);
    fixture_write_bytes(f, "snow", &GLOBE, west_is_water, mask);
    const struct surface_layer_desc layers[] = {
        {.kind = SURFACE_COLOUR, .path = picture},
        {.kind = SURFACE_COLOUR, .path = mask, .is_cover = true, .cover_rgb = {0.9f, 0.8f, 0.7f}}};
    const struct surface_desc desc = describe(layers, 2);
    struct surface drawn, held;
    assert_int_equal(surface_init(f->gpu, &desc, &drawn), TRL_OK);
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &held), TRL_OK);
    for (int i = 0; i < 2; i++) {
        const bool is_snow = i == 0;
        const struct camera_place place = {.latitude = 30,
                                           .longitude = is_snow ? -40 : 40,
                                           .radius_m = desc.radius_m,
                                           .altitude_m = 1e5,
                                           .pitch = -90,
                                           .fov = 20};
        const struct camera camera = fixture_camera(&place);
        const struct composed c = fixture_compose_middle(f, &drawn, &camera);
        double rgb[3] = {0};
        assert_true(surface_picture(&held, SURFACE_COLOUR, camera.position_m, rgb));
        for (int k = 0; k < 3; k++) {
            const double albedo = is_snow ? (double)layers[1].cover_rgb[k] : 0.5029; // sRGB 188
            // A step of the root is 1/255.
            assert_close(pow(c.albedo_water[k] / 255.0, 2), albedo, 0.009);
            assert_close(rgb[k], albedo, 0.005);
        }
    }
    surface_finish(&drawn);
    surface_finish(&held);
}

static double flat_height(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 0;
}

// How far the normal at the picture's middle leans from the vertical there, along planet axes.
static struct vec3 lean(const struct composed *c, double latitude)
{
    const struct vec3 n = {(double)c->normal_sun[0], (double)c->normal_sun[1],
                           (double)c->normal_sun[2]};
    return vec3_sub(n, vec3_from_lat_lon(latitude * DEGREE, 10 * DEGREE));
}

static void test_detail_stays_in_its_place_and_is_gone_from_afar(void **state)
{
    struct fixture *f = *state;
    char path[128];
    fixture_write_heights(f, "flat", &GLOBE, flat_height, path);
    const struct surface_layer_desc layer = {.kind = SURFACE_ELEVATION, .path = path, .scale = 1};
    struct surface_desc desc = describe(&layer, 1);
    desc.detail = (struct surface_detail){.roughness = 1, .albedo_variation = 0.2, .smallest_m = 1};
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    // Relief of texels of 111 km makes hills.
    const double ground = surface_altitude(&s, vec3_from_lat_lon(40 * DEGREE, 10 * DEGREE));
    struct camera_place place = {.latitude = 40,
                                 .longitude = 10,
                                 .radius_m = desc.radius_m,
                                 .altitude_m = ground + 1000,
                                 .pitch = -90,
                                 .fov = 20};
    struct camera camera = fixture_camera(&place);
    struct composed c = fixture_compose_middle(f, &s, &camera);
    const struct vec3 above = lean(&c, 40);
    // Even ground leans by a thousandth or so for each octave above 10 m.
    if (!(vec3_length(above) > 0.001 && vec3_length(above) < 0.5)) {
        fail_msg("leans by %.4f", vec3_length(above));
    }
    const int albedo = c.albedo_water[0];
    assert_int_not_equal(albedo, lrint(255 * sqrt(0.3)));
    // The same place from 100 m south, 6 degrees off the vertical.
    place.latitude -= 100 / (desc.radius_m + ground) / DEGREE;
    place.pitch = -atan2(1000, 100) / DEGREE;
    camera = fixture_camera(&place);
    c = fixture_compose_middle(f, &s, &camera);
    // Pixels of 2 m have their middles displaced by centimetres, and on slopes of a third are some
    // percent longer or shorter, which is as much of the waves that begin to be seen. What is at
    // another place differs by more than itself.
    const double moved = vec3_length(vec3_sub(lean(&c, 40), above)) / vec3_length(above);
    if (!(moved < 0.2)) {
        fail_msg("leans by another %.3f", moved);
    }
    assert_in_range(c.albedo_water[0], albedo - 1, albedo + 1);
    // From where a pixel is as large as the longest waves, two texels of 111 km.
    place = (struct camera_place){.latitude = 40,
                                  .longitude = 10,
                                  .radius_m = desc.radius_m,
                                  .altitude_m = 2e8,
                                  .pitch = -90,
                                  .fov = 20};
    camera = fixture_camera(&place);
    c = fixture_compose_middle(f, &s, &camera);
    // A pixel's middle is half a pixel off: 0.03 of the radius; its normal is its own vertical.
    const struct vec3 n = {(double)c.normal_sun[0], (double)c.normal_sun[1],
                           (double)c.normal_sun[2]};
    const struct vec3 ray = fixture_ray(&camera, PICTURE_SIDE / 2, PICTURE_SIDE / 2);
    const double along = -vec3_dot(ray, camera.position_m);
    const struct vec3 nearest = vec3_add(camera.position_m, vec3_scale(ray, along));
    const double half = sqrt(desc.radius_m * desc.radius_m - vec3_dot(nearest, nearest));
    const struct vec3 hit = vec3_normalize(vec3_sub(nearest, vec3_scale(ray, half)));
    // The mesh's chords: cells of a degree or two.
    assert_true(vec3_length(vec3_sub(n, hit)) < 2e-3);
    assert_in_range(c.albedo_water[0], lrint(255 * sqrt(0.3)) - 1, lrint(255 * sqrt(0.3)) + 1);
    surface_finish(&s);
}

static double hash_of(int i)
{
    return fmod(fabs(sin(i * 12.9898) * 43758.5453), 1);
}

// Without a GPU: the same heights, pictures that can be asked for, and a ceiling above everything.
static void test_surfaces_are_the_same_without_a_gpu(void **state)
{
    struct fixture *f = *state;
    char noisy[128], inset[128], picture[128], mask[128];
    fixture_write_heights(f, "noisy", &GLOBE, noisy_height, noisy);
    fixture_write_heights(f, "inset", &INSET, inset_height, inset);
    fixture_write_bytes(f, "picture", &INSET, grey, picture);
    fixture_write_bytes(f, "mask", &GLOBE, west_is_water, mask);
    const struct surface_layer_desc layers[] = {
        {.kind = SURFACE_ELEVATION, .path = noisy, .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = inset, .scale = 1, .feather_rad = 0.5 * DEGREE},
        {.kind = SURFACE_WATER, .path = mask},
        {.kind = SURFACE_COLOUR, .path = picture}};
    const struct surface_desc desc = describe(layers, 4);
    struct surface with, without;
    assert_int_equal(surface_init(f->gpu, &desc, &with), TRL_OK);
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &without), TRL_OK);
    struct terrain_ceiling ceiling;
    assert_int_equal(terrain_ceiling_init(&without, &ceiling), TRL_OK);
    for (int i = 0; i < 20000; i++) {
        const double latitude = -90 + 180 * hash_of(3 * i), longitude = -180 + 360 * hash_of(7 * i);
        const struct vec3 at = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
        const double height = surface_altitude(&without, at);
        assert_close(height, surface_altitude(&with, at), 0);
        // From another place that is within reach of it.
        const double reach = pow(10, -4 * hash_of(11 * i));
        const struct vec3 aside = {hash_of(5 * i) - 0.5, hash_of(13 * i) - 0.5,
                                   hash_of(17 * i) - 0.5};
        const struct vec3 near = vec3_normalize(vec3_add(at, vec3_scale(aside, 1.1 * reach)));
        const double angle = acos(fmin(vec3_dot(near, at), 1)) + 1e-7;
        assert_true(terrain_ceiling_m(&ceiling, near, angle) >= height);
    }
    // Tight where there is something to be tight about: outside of the inset's 3000 m.
    const struct vec3 far = vec3_from_lat_lon(-20 * DEGREE, 60 * DEGREE);
    assert_true(terrain_ceiling_m(&ceiling, far, 5 * DEGREE) < 1500);
    double rgb[3] = {0.1, 0.2, 0.3};
    assert_false(surface_picture(&without, SURFACE_COLOUR, far, rgb));
    assert_close(rgb[1], 0.2, 1e-12);
    const struct vec3 middle = vec3_from_lat_lon(45 * DEGREE, 15 * DEGREE);
    assert_true(surface_picture(&without, SURFACE_COLOUR, middle, rgb));
    assert_close(rgb[1], 0.5029, 0.004); // sRGB 188; a step of the root is 1/255
    terrain_ceiling_finish(&ceiling);
    surface_finish(&without);
    surface_finish(&with);
}

// A slope of 1000 m cos(latitude) cos(longitude), on a sphere of 6400 km.
static void test_normals_lean_as_the_heights_do(void **state)
{
    struct fixture *f = *state;
    char path[128];
    fixture_write_heights(f, "smooth", &GLOBE, smooth_height, path);
    const struct surface_layer_desc layer = {.kind = SURFACE_ELEVATION, .path = path, .scale = 100};
    const struct surface_desc desc = describe(&layer, 1);
    struct surface s;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
    for (int i = 0; i < 200; i++) {
        const double latitude = -80 + 160 * hash_of(3 * i), longitude = -180 + 360 * hash_of(7 * i);
        const struct vec3 up = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
        const struct vec3 normal = surface_normal(&s, up);
        // The heights are 1e5 m times the x of the direction: their gradient is along x.
        const double r = s.radius_m + surface_altitude(&s, up);
        const struct vec3 slope =
            vec3_scale(vec3_sub((struct vec3){1, 0, 0}, vec3_scale(up, up.x)), 1e5 / r);
        const struct vec3 expected = vec3_normalize(vec3_sub(up, slope));
        // Whole units of 100 m on texels of 112 km.
        assert_close(vec3_length(vec3_sub(normal, expected)), 0, 2e-3);
    }
    surface_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_altitude_follows_scale_and_offset),
        cmocka_unit_test(test_poles_have_one_height_and_the_antimeridian_no_step),
        cmocka_unit_test(test_insets_lie_over_and_their_gaps_show_what_is_below),
        cmocka_unit_test(test_gaps_have_no_cliffs),
        cmocka_unit_test(test_bounds_hold_every_altitude),
        cmocka_unit_test(test_water_is_level_and_dry_land_may_be_low),
        cmocka_unit_test(test_errors_name_the_file),
        cmocka_unit_test(test_a_missing_optional_layer_is_passed_over),
        cmocka_unit_test(test_pixels_hold_colour_water_normal_and_lights),
        cmocka_unit_test(test_snow_lies_over_colours_where_its_mask_says),
        cmocka_unit_test(test_detail_stays_in_its_place_and_is_gone_from_afar),
        cmocka_unit_test(test_surfaces_are_the_same_without_a_gpu),
        cmocka_unit_test(test_normals_lean_as_the_heights_do),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
