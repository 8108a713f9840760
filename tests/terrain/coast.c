// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Where water ends: between the texels of a mask, and beside pictures that show the sea.
#include "fixture.h"
#include "shared/sea.glsl"
#include "terrain/look.h"

#include <math.h>
#include <stdio.h>

static const double DEGREE = 0.017453292519943295;
static const double R = 6.4e6;

enum { ELEVATION, WATER, COLOUR, LAYERS };

// The sea west of Greenwich, with a steep rock in it that only heights know; land east of it, with
// a lake in the hills of its north, a depression in its south, and a bay that only heights know, as
// level as those which tell no depths have the sea.
static bool is_island(double latitude, double longitude)
{
    return longitude > -62 && longitude < -58 && latitude > -2 && latitude < 2;
}

static bool is_lake(double latitude, double longitude)
{
    return longitude > 40 && longitude < 60 && latitude > 20 && latitude < 40;
}

static double find_height(double latitude, double longitude)
{
    if (fabs(longitude + 20) < 1.5 && fabs(latitude) < 1.5) {
        return 300;
    }
    if (longitude < 0 && !is_island(latitude, longitude)) {
        return -10;
    }
    if (fabs(latitude - 5) < 1 && longitude < 1) {
        return 0;
    }
    return latitude > 10 ? 500 : latitude < -30 ? -50 : 100;
}

static double find_water(double latitude, double longitude)
{
    const bool is_sea = longitude < 0 && !is_island(latitude, longitude);
    return is_sea || is_lake(latitude, longitude) ? 255 : 0;
}

// A picture that is too coarse for the island, and shows it nearly as the sea.
static double find_colour(double latitude, double longitude)
{
    return is_island(latitude, longitude) ? 60 : longitude < 0 ? 20 : 200;
}

static struct surface_desc describe(const struct fixture *f, char paths[LAYERS][128],
                                    struct surface_layer_desc layers[LAYERS])
{
    static const enum surface_kind KINDS[LAYERS] = {SURFACE_ELEVATION, SURFACE_WATER,
                                                    SURFACE_COLOUR};
    const struct raster_place fine = {-180, 90, 0.5, 720, 360}, coarse = {-180, 90, 2, 180, 90};
    fixture_write_heights(f, "heights", &fine, find_height, paths[ELEVATION]);
    fixture_write_bytes(f, "water", &coarse, find_water, paths[WATER]);
    fixture_write_bytes(f, "colour", &coarse, find_colour, paths[COLOUR]);
    for (int i = 0; i < LAYERS; i++) {
        layers[i] = (struct surface_layer_desc){.kind = KINDS[i], .path = paths[i], .scale = 1};
    }
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = LAYERS;
    desc.layers = layers;
    desc.is_strict = true;
    desc.depth = (struct surface_depth){.is_told = true, .everywhere_m = -1};
    return desc;
}

// Latitude, longitude, and the part that is water.
static const double PLACES[][3] = {
    {0, -40, 1},   // open sea
    {0, -20, 0},   // the rock in it
    {0, -0.97, 1}, // a mask's texel ends half way between its middle and the land's
    {0, 0.6, 0},   // heights have begun to rise
    {0, 30, 0},    // dry land
    {-50, 30, 0},  // below sea level, and dry
    {-50, 1.5, 0}, // the same beside the sea
    {30, 50, 1},   // a lake's middle
    {30, 40.6, 1}, // its texels end at 40 degrees
    {30, 39.4, 0},
};

// One place as the CPU knows it, and as it is drawn from above.
struct both {
    double water, depth_code;
    struct composed drawn;
};

struct coasts {
    const struct fixture *f;
    struct surface on_cpu, on_gpu;
};

static void coasts_init(const struct fixture *f, struct coasts *out)
{
    char paths[LAYERS][128];
    struct surface_layer_desc layers[LAYERS];
    const struct surface_desc desc = describe(f, paths, layers);
    out->f = f;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &out->on_cpu), TRL_OK);
    assert_int_equal(surface_init(f->gpu, &desc, &out->on_gpu), TRL_OK);
}

static void coasts_finish(struct coasts *coasts)
{
    surface_finish(&coasts->on_gpu);
    surface_finish(&coasts->on_cpu);
}

// `place`: latitude and longitude.
static struct both coasts_at(const struct coasts *coasts, const double *place, double altitude_m)
{
    struct both both;
    const struct vec3 up = vec3_from_lat_lon(place[0] * DEGREE, place[1] * DEGREE);
    both.water = surface_water(&coasts->on_cpu, up, &both.depth_code);
    const struct camera_place above = {place[0], place[1], R, altitude_m, 0, -90, 20};
    const struct camera camera = fixture_camera(&above);
    both.drawn = fixture_compose_middle(coasts->f, &coasts->on_gpu, &camera);
    return both;
}

static void water_ends_where_mask_and_heights_say(void **state)
{
    struct coasts coasts;
    coasts_init(*state, &coasts);
    for (size_t i = 0; i < sizeof PLACES / sizeof PLACES[0]; i++) {
        const double *p = PLACES[i];
        const struct both c = coasts_at(&coasts, p, 2000);
        assert_close(c.water, p[2], 0);
        assert_close(c.drawn.albedo_water[3] / 255.0, p[2], 0.01);
    }
    coasts_finish(&coasts);
}

// Latitude, longitude, depth in m.
static const double DEPTHS[][3] = {
    {5, 0.5, 10}, // a bay in what the mask has as land
    {5, -0.5, 10},     {0, -40, 10},
    {30, 40.03, 22.4}, // 3351 m from a lake's shore, by Dean's profile
    {30, 40.1, 49.96}, // 11 170 m
    {30, 50, 200},     // nobody knows
};

static void water_shelves_toward_its_shore(void **state)
{
    struct coasts coasts;
    coasts_init(*state, &coasts);
    for (size_t i = 0; i < sizeof DEPTHS / sizeof DEPTHS[0]; i++) {
        const double *p = DEPTHS[i];
        const struct both c = coasts_at(&coasts, p, 600);
        const double known_m = sea_code_depth(c.depth_code);
        const double drawn_m = sea_code_depth(c.drawn.lights[3] / 255.0);
        printf("at %g, %g: %.2f m, drawn %.2f m\n", p[0], p[1], known_m, drawn_m);
        assert_close(known_m, p[2], 0.05);
        assert_close(drawn_m, p[2], 0.1 * p[2]); // GPUs know places to 1 / 256 of a texel
    }
    coasts_finish(&coasts);
}

// Heights as coarse as the mask, at a latitude where slopes are looked at over twice as many
// texels: they feel land before the mean of what is around does, and no shoal may lie there.
static void no_shoal_lies_off_the_shore(void **state)
{
    const struct fixture *f = *state;
    char paths[LAYERS][128];
    struct surface_layer_desc layers[LAYERS];
    const struct surface_desc desc = describe(f, paths, layers);
    const struct raster_place fine = {-180, 90, 0.5, 720, 360};
    fixture_write_bytes(f, "fine", &fine, find_water, paths[WATER]);
    struct coasts coasts = {.f = f};
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &coasts.on_cpu), TRL_OK);
    assert_int_equal(surface_init(f->gpu, &desc, &coasts.on_gpu), TRL_OK);
    for (int k = 0; k < 8; k++) {
        const double place[2] = {60, -0.8 + 0.05 * k};
        const struct both c = coasts_at(&coasts, place, 600);
        assert_close(sea_code_depth(c.depth_code), 10, 0.1);
        assert_close(sea_code_depth(c.drawn.lights[3] / 255.0), 10, 0.5);
    }
    coasts_finish(&coasts);
}

// A coast that runs askew through the texels, of a map whose mask knows nothing: land to the
// north-east, a bed to the south-west. 1 where the line is, in degrees from it.
static double from_askew(double latitude, double longitude)
{
    return 0.6 * longitude + 0.8 * (latitude - 3.3);
}

static double find_bed(double latitude, double longitude)
{
    return 2000 * from_askew(latitude, longitude);
}

static double find_no_water(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 0;
}

static double find_mean_water(const struct coasts *coasts, double from_deg)
{
    double sum = 0, code;
    for (int k = 0; k < 40; k++) {
        // Along the line, over ten texels.
        const double along = 0.125 * k, latitude = 3.3 + 0.8 * from_deg - 0.6 * along;
        const struct vec3 up =
            vec3_from_lat_lon(latitude * DEGREE, (0.6 * from_deg + 0.8 * along) * DEGREE);
        sum += surface_water(&coasts->on_cpu, up, &code);
        assert_close(surface_altitude(&coasts->on_cpu, up), fmax(2000 * from_deg, 0), 1);
    }
    return sum / 40;
}

static void a_bed_has_its_own_shore(void **state)
{
    const struct fixture *f = *state;
    char paths[LAYERS][128];
    struct surface_layer_desc layers[LAYERS];
    struct surface_desc desc = describe(f, paths, layers);
    const struct raster_place fine = {-180, 90, 0.5, 720, 360}, coarse = {-180, 90, 2, 180, 90};
    fixture_write_heights(f, "bed", &fine, find_bed, paths[ELEVATION]);
    fixture_write_bytes(f, "dry", &coarse, find_no_water, paths[WATER]);
    layers[ELEVATION].has_bed = true;
    struct coasts coasts = {.f = f};
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &coasts.on_cpu), TRL_OK);
    assert_int_equal(surface_init(f->gpu, &desc, &coasts.on_gpu), TRL_OK);
    // A hundredth of a texel on either side of the line, everywhere along it.
    assert_close(find_mean_water(&coasts, -0.005), 1, 0);
    assert_close(find_mean_water(&coasts, 0.005), 0, 0);
    const double places[][3] = {
        {3.3 - 0.04, -0.03, 100}, {3.3 - 0.008, -0.006, 20}, {3.38, 0.06, 0}};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const struct both c = coasts_at(&coasts, places[i], 600);
        const bool is_sea = places[i][2] > 0;
        assert_close(c.water, is_sea, 0);
        assert_close(c.drawn.albedo_water[3] / 255.0, is_sea, 0.01);
        if (is_sea) {
            assert_close(sea_code_depth(c.depth_code), places[i][2], 1);
            assert_close(sea_code_depth(c.drawn.lights[3] / 255.0), places[i][2], 3);
        }
    }
    assert_close(surface_min_altitude(&coasts.on_cpu), 0, 0);
    coasts_finish(&coasts);
}

// Detail goes on below the data, up to a lake's shore.
static void made_up_relief_ends_at_a_lake(void **state)
{
    const struct fixture *f = *state;
    char paths[LAYERS][128];
    struct surface_layer_desc layers[LAYERS];
    struct surface_desc desc = describe(f, paths, layers);
    desc.detail = (struct surface_detail){.roughness = 1, .smallest_m = 1000};
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    double most = 0;
    for (int k = 0; k < 50; k++) {
        const double beside = 30 + 0.1 * k, within = 50 + 0.1 * k;
        const struct vec3 land = vec3_from_lat_lon(30 * DEGREE, beside * DEGREE);
        most = fmax(most, fabs(surface_altitude(&s, land) - 500));
        // A ten thousandth of what is left of relief, for its tone.
        const struct vec3 lake = vec3_from_lat_lon(30 * DEGREE, within * DEGREE);
        assert_close(surface_altitude(&s, lake), 500, 0.5);
    }
    assert_true(most > 20);
    surface_finish(&s);
}

// Along lines over a lake's shore, how often water begins or ends: made-up detail winds the shore,
// and leaves an island here and there, but does not tear it into specks.
static void made_up_shores_hold_together(void **state)
{
    const struct fixture *f = *state;
    char paths[LAYERS][128];
    struct surface_layer_desc layers[LAYERS];
    struct surface_desc desc = describe(f, paths, layers);
    desc.detail = (struct surface_detail){.roughness = 1, .smallest_m = 100};
    struct surface s;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
    enum { LINES = 24, STEPS = 1000 };
    int crossings = 0;
    double code, places[LINES], mean = 0, spread = 0;
    for (int line = 0; line < LINES; line++) {
        places[line] = 0;
        for (int k = 0, was = 0; k < STEPS; k++) {
            const double latitude = 24 + 0.5 * line, longitude = 39 + 2.0 * k / STEPS;
            const struct vec3 up = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
            const int is = surface_water(&s, up, &code) > 0.5;
            crossings += is != was;
            was = is;
            places[line] += is;
        }
        mean += places[line] / LINES;
    }
    for (int line = 0; line < LINES; line++) {
        spread += (places[line] - mean) * (places[line] - mean) / LINES;
    }
    const double winding = sqrt(spread) / STEPS; // of a mask's texel
    printf("%.2f crossings a line, shore off by %.3f texels\n", 1.0 * crossings / LINES, winding);
    assert_true(crossings < 3 * LINES);
    assert_true(winding > 0.007);
    surface_finish(&s);
}

// A low shore before high ground: the cubic falls below the sea between them, and rises through it
// where made-up detail decides whether water is.
static double find_low_shore(double latitude, double longitude)
{
    (void)latitude;
    return longitude < 0 ? -10 : longitude < 0.5 ? 13 : 300;
}

static double find_sea(double latitude, double longitude)
{
    (void)latitude;
    return longitude < 0 ? 255 : 0;
}

static double find_rise(const struct surface *s, double latitude)
{
    double low = 0.02, high = 0.25; // longitudes
    for (int k = 0; k < 40; k++) {
        const double middle = 0.5 * (low + high);
        const struct vec3 up = vec3_from_lat_lon(latitude * DEGREE, middle * DEGREE);
        *(surface_altitude_of_data(s, up) < 0 ? &low : &high) = middle;
    }
    return low;
}

// Relief has no size at sea level, but the shore's detail goes on over it.
static void no_notch_lies_at_sea_level(void **state)
{
    const struct fixture *f = *state;
    char paths[LAYERS][128];
    struct surface_layer_desc layers[LAYERS];
    struct surface_desc desc = describe(f, paths, layers);
    const struct raster_place fine = {-180, 90, 0.5, 720, 360};
    fixture_write_heights(f, "low", &fine, find_low_shore, paths[ELEVATION]);
    fixture_write_bytes(f, "sea", &fine, find_sea, paths[WATER]);
    desc.detail = (struct surface_detail){.roughness = 1, .smallest_m = 100};
    struct coasts coasts = {.f = f};
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &coasts.on_cpu), TRL_OK);
    assert_int_equal(surface_init(f->gpu, &desc, &coasts.on_gpu), TRL_OK);
    int count = 0;
    for (double latitude = 1; latitude < 60 && count < 4; latitude += 0.07) {
        const double place[2] = {latitude, find_rise(&coasts.on_cpu, latitude)};
        const struct vec3 up = vec3_from_lat_lon(latitude * DEGREE, (place[1] + 0.02) * DEGREE);
        double code; // of water 2 km on
        if (surface_water(&coasts.on_cpu, up, &code) > 0.99) {
            const struct both c = coasts_at(&coasts, place, 600);
            printf("at %g, %g: %g, drawn %g\n", place[0], place[1], c.water,
                   c.drawn.albedo_water[3] / 255.0);
            assert_close(c.drawn.albedo_water[3] / 255.0, 1, 0.01);
            count++;
        }
    }
    assert_int_equal(count, 4);
    coasts_finish(&coasts);
}

static double find_red(const struct surface *s, double latitude, double longitude)
{
    double rgb[3] = {0};
    const struct vec3 up = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
    assert_true(surface_picture(s, SURFACE_COLOUR, up, rgb));
    return rgb[0];
}

static void land_is_not_painted_as_the_sea_beside_it(void **state)
{
    const struct fixture *f = *state;
    char paths[LAYERS][128];
    struct surface_layer_desc layers[LAYERS];
    struct surface_desc desc = describe(f, paths, layers);
    struct surface s;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
    // 200 and 20 of 255, linear; a byte of roots is 0.005.
    const double land = 0.578, sea = 0.007;
    assert_close(find_red(&s, 0, 20), land, 0.005);
    assert_close(find_red(&s, 0, -1), land, 0.005);
    assert_close(find_red(&s, 0, -5), land, 0.005);
    assert_close(find_red(&s, 0, -40), sea, 0.005);
    assert_close(find_red(&s, 0, -60), land, 0.005);
    assert_close(find_red(&s, 30, 50), land, 0.005);
    surface_finish(&s);
    // Without an ocean the picture is all that shows the sea.
    desc.depth.is_told = false;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
    assert_close(find_red(&s, 0, -1), sea, 0.005);
    surface_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(water_ends_where_mask_and_heights_say),
        cmocka_unit_test(water_shelves_toward_its_shore),
        cmocka_unit_test(no_shoal_lies_off_the_shore),
        cmocka_unit_test(a_bed_has_its_own_shore),
        cmocka_unit_test(made_up_relief_ends_at_a_lake),
        cmocka_unit_test(made_up_shores_hold_together),
        cmocka_unit_test(no_notch_lies_at_sea_level),
        cmocka_unit_test(land_is_not_painted_as_the_sea_beside_it),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
