// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The colour of deep and of shallow water behind air, drawn in four bands, against the path
// tracer's at 64 wavelengths.
#include "sea_scene.h"

#include <math.h>

enum { SIZE = 8, PIXELS = SIZE * SIZE };
static const double PI = 3.14159265358979323846;

static void average(const float *radiance, double rgb[3])
{
    for (int c = 0; c < 3; c++) {
        rgb[c] = 0;
        for (int i = 0; i < PIXELS; i++) {
            rgb[c] += (double)radiance[4 * i + c] / PIXELS;
        }
    }
}

static void look(trl_context *ctx, const trl_scene *scene, double drawn[3], double traced[3],
                 double error[3])
{
    static float radiance[4 * PIXELS], errors[4 * PIXELS];
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    trl_renderer *renderer = NULL;
    assert_int_equal(trl_renderer_create(ctx, &desc, &renderer), TRL_OK);
    trl_view view = trl_view_default();
    view.latitude_rad = 0.3;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = 500;
    view.pitch_rad = -1.2;
    view.vertical_fov_rad = 0.05;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 0.7;
    view.sun_longitude_or_azimuth_rad = PI / 2;
    assert_int_equal(trl_renderer_draw(renderer, &view, SIZE, SIZE, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, radiance), TRL_OK);
    trl_renderer_destroy(&renderer);
    average(radiance, drawn);
    trl_reference_desc reference = trl_reference_desc_default();
    reference.scene = scene;
    reference.paths = 640;
    assert_int_equal(trl_reference_render(ctx, &reference, &view, SIZE, SIZE, radiance, errors),
                     TRL_OK);
    average(radiance, traced);
    for (int c = 0; c < 3; c++) {
        double sum = 0;
        for (int i = 0; i < PIXELS; i++) {
            sum += pow((double)errors[4 * i + c] / PIXELS, 2);
        }
        error[c] = sqrt(sum);
    }
}

static void drawn_water_has_the_colour_of_the_paths(void **state)
{
    (void)state;
    static const char *const waters[] = {
        "\"chlorophyll_mg_m3\": 0.1, \"dissolved_per_m_440\": 0.01",
        "\"chlorophyll_mg_m3\": 1, \"mud_g_m3\": 10"};
    static const struct {
        int water;
        double depth_m;
    } cases[] = {{0, 4}, {0, 40}, {1, 10}};
    struct sea_scene s;
    sea_scene_begin(&s);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double drawn[3], traced[3], error[3];
        trl_scene *scene = sea_scene_make(&s, "\"wind_m_s\": 0, \"mean_square_slope\": 0.001",
                                          waters[cases[i].water], cases[i].depth_m);
        look(s.ctx, scene, drawn, traced, error);
        trl_scene_destroy(&scene);
        for (int c = 0; c < 3; c++) {
            const double off = drawn[c] / traced[c] - 1, noise = error[c] / traced[c];
            printf("water %d, %g m, %c: drawn %g, traced %g: %+.2f %% +- %.2f %%\n", cases[i].water,
                   cases[i].depth_m, "rgb"[c], drawn[c], traced[c], 100 * off, 100 * noise);
            // What is hardly there may be off by a hundredth of what is.
            const double brightest = fmax(traced[1], traced[2]);
            assert_true(error[c] < 0.01 * brightest);
            assert_true(fabs(drawn[c] - traced[c]) <
                        fmax(0.03 * traced[c], 0.01 * brightest) + 2 * error[c]);
        }
    }
    sea_scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drawn_water_has_the_colour_of_the_paths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
