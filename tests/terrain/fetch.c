// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How far wind has blown over water, by masks whose shores are known.
#include "ocean/fetch.h"

#include "fixture.h"

#include <stdio.h>

static const double DEGREE = 0.017453292519943295;
static const double R = 6.4e6, MOST_M = 3e5, TEXEL_DEG = 0.02;

// A sea east of 1 degree E, and west of it a lake 0.1 degrees wide, long from south to north.
static double find_water(double latitude, double longitude)
{
    (void)latitude;
    return longitude > 1 || (longitude > 0 && longitude < 0.1) ? 255 : 0;
}

static double find_level(double latitude, double longitude)
{
    return latitude * longitude > 1e9 ? 1 : 0;
}

static void open_seas(const struct fixture *f, struct surface *out)
{
    char heights[128], mask[128];
    const struct raster_place place = {-2, 3, TEXEL_DEG, 300, 300}, coarse = {-2, 3, 1, 6, 6};
    fixture_write_bytes(f, "seas", &place, find_water, mask);
    fixture_write_heights(f, "level", &coarse, find_level, heights);
    const struct surface_layer_desc layers[] = {
        {.kind = SURFACE_ELEVATION, .path = heights, .scale = 1},
        {.kind = SURFACE_WATER, .path = mask}};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = 2;
    desc.layers = layers;
    desc.depth = (struct surface_depth){.is_told = true, .everywhere_m = -1};
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, out), TRL_OK);
}

static double find_fetch(const struct surface *s, double wind_from_deg, double longitude,
                         double height_m)
{
    const struct ocean_waves waves = {.wind_from_rad = wind_from_deg * DEGREE, .fetch_m = MOST_M};
    const struct vec3 up = vec3_from_lat_lon(0.3 * DEGREE, longitude * DEGREE);
    return fetch_find_m(s, &waves, vec3_scale(up, R + height_m));
}

// Of a straight shore as far away as that: each course is longer by 1 / cos, and counts by cos^2.
static double slant(double way_m)
{
    double cosines = 0, squares = 0;
    for (int k = -3; k <= 3; k++) {
        cosines += cos(15 * k * DEGREE);
        squares += cos(15 * k * DEGREE) * cos(15 * k * DEGREE);
    }
    return way_m * cosines / squares;
}

static void fetch_ends_at_the_shore(void **state)
{
    struct surface s;
    open_seas(*state, &s);
    const double degree_m = DEGREE * R;
    // From the west across the lake, and 20 km off the sea's shore; onshore, the scene's own.
    const double lake_m = find_fetch(&s, 270, 0.05, 2), off_m = find_fetch(&s, 270, 1.18, 2);
    const double open_m = find_fetch(&s, 90, 1.18, 2);
    printf("lake %.0f m, off the shore %.0f m, toward it %.0f m\n", lake_m, off_m, open_m);
    assert_close(lake_m, slant(0.05 * degree_m), 0.1 * lake_m);
    assert_close(off_m, slant(0.18 * degree_m), 0.1 * off_m);
    assert_close(open_m, MOST_M, 0.01 * MOST_M);
    // From on high all seas are alike.
    assert_close(find_fetch(&s, 270, 0.05, 4e5), MOST_M, 1e-4 * MOST_M);
    // Beside the lake its waves are those that are seen; far from all water nothing is.
    assert_true(find_fetch(&s, 270, -0.01, 2) < slant(0.1 * degree_m));
    // An eye that moves sees no step.
    double before = find_fetch(&s, 270, 0.02, 2);
    for (double longitude = 0.0201; longitude < 0.08; longitude += 1e-4) {
        const double fetch_m = find_fetch(&s, 270, longitude, 2);
        assert_close(fetch_m, before, 150);
        before = fetch_m;
    }
    surface_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fetch_ends_at_the_shore)};
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
