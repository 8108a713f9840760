// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The sea with distance: waves that pixels do not resolve are roughness, so that it neither turns
// to glass nor shimmers.
#include "sea_scene.h"

#include "api/renderer.h"
#include "ocean/sea.h"

#include <math.h>

enum { WIDTH = 64, HEIGHT = 48, FINE = 2 };
static const double PI = 3.14159265358979323846;

struct setup {
    struct sea_scene s;
    trl_scene *scene;
    trl_renderer *renderer;
};

static int set_up(void **state)
{
    static struct setup setup;
    *state = &setup;
    sea_scene_begin(&setup.s);
    setup.scene = sea_scene_make(&setup.s, "\"wind_m_s\": 8, \"count\": 60", "", 200);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = setup.scene;
    desc.max_orders = 1; // solved at once
    assert_int_equal(trl_renderer_create(setup.s.ctx, &desc, &setup.renderer), TRL_OK);
    return 0;
}

static int tear_down(void **state)
{
    struct setup *setup = *state;
    trl_renderer_destroy(&setup->renderer);
    trl_scene_destroy(&setup->scene);
    sea_scene_end(&setup->s);
    return 0;
}

static trl_view find_view(double altitude_m, double pitch_deg, double fov_deg)
{
    trl_view view = trl_view_default();
    view.latitude_rad = 0.3;
    view.longitude_rad = 1;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = altitude_m;
    view.pitch_rad = pitch_deg * PI / 180;
    view.vertical_fov_rad = fov_deg * PI / 180;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 0.4;
    view.sun_longitude_or_azimuth_rad = view.heading_rad + 0.3;
    return view;
}

// Mean squares of the slopes that pixels show as normals, and that they have as roughness.
struct slopes {
    double shown, rough;
};

static struct slopes measure_slopes(trl_renderer *renderer, trl_view view)
{
    enum { TIMES = 6 };
    static float facets[4 * WIDTH * HEIGHT];
    struct slopes sum = {0, 0};
    size_t count = 0;
    for (int time = 0; time < TIMES; time++) {
        view.time_s = 1000 * time;
        assert_int_equal(trl_renderer_draw(renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
        const struct gpu_texture *texture = &renderer->frame.ground.facets.texture;
        const struct gpu_region all = gpu_texture_region(texture, 0);
        assert_int_equal(gpu_texture_read(texture, &all, facets), TRL_OK);
        const double up[3] = {cos(view.latitude_rad) * cos(view.longitude_rad),
                              cos(view.latitude_rad) * sin(view.longitude_rad),
                              sin(view.latitude_rad)};
        for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
            const float *n = facets + 4 * i;
            double along = 0, square = 0;
            for (int c = 0; c < 3; c++) {
                along += (double)n[c] * up[c];
                square += (double)n[c] * (double)n[c];
            }
            if (square > 0) {
                sum.shown += square / (along * along) - 1;
                sum.rough += (double)n[3];
                count++;
            }
        }
    }
    return (struct slopes){sum.shown / (double)count, sum.rough / (double)count};
}

static void the_mean_square_slope_is_kept_with_distance(void **state)
{
    const struct setup *setup = *state;
    const double wanted = sea_mean_square_slope(&setup->scene->ocean.waves);
    static const double altitudes_m[] = {2, 10, 50, 300, 2000, 1e5};
    double shown[6];
    for (size_t i = 0; i < sizeof altitudes_m / sizeof *altitudes_m; i++) {
        const struct slopes slopes =
            measure_slopes(setup->renderer, find_view(altitudes_m[i], -90, i < 5 ? 90 : 10));
        const double off = (slopes.shown + slopes.rough) / wanted - 1;
        printf("%g m: shown %.5f, rough %.5f, of %.5f: %+.1f %%\n", altitudes_m[i], slopes.shown,
               slopes.rough, wanted, 100 * off);
        shown[i] = slopes.shown;
        // Near pictures hold few waves: six pictures are off by up to 2 %. Sharp crests add next to
        // nothing: Q is above 0 for the longest waves only.
        assert_true(fabs(off) < 0.03);
    }
    // Or it would be kept where nothing is ever shown, or all.
    assert_true(shown[0] > 0.3 * wanted && shown[2] < 0.15 * wanted && shown[4] < 0.01 * wanted);
}

// Green, means over squares of as many pixels a side as the picture is finer.
static void draw(trl_renderer *renderer, const trl_view *view, size_t finer, float *green)
{
    static float radiance[4 * FINE * FINE * WIDTH * HEIGHT];
    const size_t width = finer * WIDTH, height = finer * HEIGHT;
    assert_int_equal(trl_renderer_draw(renderer, view, (uint32_t)width, (uint32_t)height, 0),
                     TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, radiance), TRL_OK);
    memset(green, 0, WIDTH * HEIGHT * sizeof *green);
    for (size_t i = 0; i < width * height; i++) {
        const size_t x = i % width / finer, y = i / width / finer;
        green[y * WIDTH + x] += radiance[4 * i + 1] / (float)(finer * finer);
    }
}

// Root mean square over some rows, over the mean.
static double find_difference(const float *a, const float *b, size_t first, size_t last)
{
    double squares = 0, sum = 0;
    for (size_t i = first * WIDTH; i < last * WIDTH; i++) {
        squares += pow((double)(a[i] - b[i]), 2);
        sum += (double)a[i];
    }
    return sqrt(squares * (double)((last - first) * WIDTH)) / sum;
}

// From 300 m, beside the glint, where light changes most with slope. Between 3 and 11 km pixels are
// 13 to 50 m wide: longer than all but a few waves.
static void the_far_sea_does_not_shimmer(void **state)
{
    enum { FIRST = 8, LAST = 24 };
    const struct setup *setup = *state;
    static float once[WIDTH * HEIGHT], fine[WIDTH * HEIGHT], moved[WIDTH * HEIGHT];
    trl_view view = find_view(300, -5, 12);
    draw(setup->renderer, &view, 1, once);
    draw(setup->renderer, &view, FINE, fine);
    view.longitude_rad += 0.3 / 6.371e6; // a fortieth of a pixel, and longer than short waves
    draw(setup->renderer, &view, 1, moved);
    const double by_size = find_difference(once, fine, FIRST, LAST);
    const double by_place = find_difference(once, moved, FIRST, LAST);
    printf("twice as fine: %.2f %%, 0.3 m to the side: %.3f %%\n", 100 * by_size, 100 * by_place);
    // Half as large pixels show waves of their own size, of a hundredth of all slopes; the move is
    // a fortieth of the least that is shown. Were all waves shown in all pixels: 1.7 times
    // the mean, both.
    assert_true(by_size < 0.08);
    assert_true(by_place < 0.004);
}

// Between waves the air reaches below level water, from where no picture shows it.
static void an_eye_in_a_trough_looks_from_level_water(void **state)
{
    const struct setup *setup = *state;
    static float level[WIDTH * HEIGHT], below[WIDTH * HEIGHT];
    trl_view view = find_view(0, -10, 40);
    const struct ground *ground = &setup->renderer->frame.ground;
    while (ground_wave_m(ground, view.latitude_rad, view.longitude_rad, view.time_s) > -0.3) {
        view.time_s += 0.5;
    }
    draw(setup->renderer, &view, 1, level);
    view.altitude_m = -0.2;
    draw(setup->renderer, &view, 1, below);
    assert_memory_equal(level, below, sizeof level);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_square_slope_is_kept_with_distance),
        cmocka_unit_test(the_far_sea_does_not_shimmer),
        cmocka_unit_test(an_eye_in_a_trough_looks_from_level_water),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
