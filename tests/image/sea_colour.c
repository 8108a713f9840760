// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The colour of deep and of shallow water behind air, drawn in four bands, against the path
// tracer's at 64 wavelengths.
#include <terrella/terrella.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { SIZE = 8, PIXELS = SIZE * SIZE };
static const double PI = 3.14159265358979323846;

static const char scene_format[] =
    "{\"terrella\": 1, \"name\": \"sea\","
    " \"star\": {\"spectral_irradiance\": [[360, 1.1], [450, 1.9], [550, 1.85], [700, 1.4]]},"
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.1},"
    " \"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"air\","
    "  \"scattering_per_m\": [[360, 6.6e-5], [400, 4.3e-5], [450, 2.6e-5], [500, 1.7e-5],"
    "   [550, 1.15e-5], [600, 8.1e-6], [700, 4.3e-6], [830, 2.2e-6]],"
    "  \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}, \"phase\": \"rayleigh\"}]},"
    " \"surface\": {\"layers\": [{\"elevation\": \"black.png\"}, {\"water\": \"white.png\"}]},"
    " \"ocean\": {\"waves\": {\"mean_square_slope\": 0.001, \"whitecaps\": 0},"
    "  \"water\": {%s}, \"bed\": {\"albedo\": 0.4, \"depth_m\": %g}}}";

static void write_map(trl_context *ctx, const char *folder, const char *name, uint8_t value)
{
    uint8_t rgba[4 * 8 * 4];
    char path[128];
    memset(rgba, value, sizeof rgba);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_int_equal(trl_image_write_png(ctx, path, 8, 4, rgba), TRL_OK);
}

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
    char folder[] = "/tmp/terrella-colour-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    desc.cache_dir = "";
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    write_map(ctx, folder, "black.png", 0);
    write_map(ctx, folder, "white.png", 255);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[2048];
        const int length =
            snprintf(text, sizeof text, scene_format, waters[cases[i].water], cases[i].depth_m);
        trl_scene *scene = NULL;
        double drawn[3], traced[3], error[3];
        assert_int_equal(trl_scene_parse(ctx, text, (size_t)length, "sea", folder, &scene), TRL_OK);
        look(ctx, scene, drawn, traced, error);
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
    snprintf(path, sizeof path, "%s/black.png", folder);
    unlink(path);
    snprintf(path, sizeof path, "%s/white.png", folder);
    unlink(path);
    rmdir(folder);
    trl_context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drawn_water_has_the_colour_of_the_paths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
