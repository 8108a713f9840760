// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Open water in the frame: a globe of black water without air, whose glint has a closed form.
#include "fixture.h"
#include "shared/sea.glsl"
#include <terrella/image.h>
#include <terrella/renderer.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAP_WIDTH = 16, MAP_HEIGHT = 8, SIZE = 33 };

static const double PI = 3.14159265358979323846;
static const double MSS = 0.04;

struct setup {
    struct fixture *f;
    char folder[64];
};

static const char scene_format[] =
    "{\"terrella\": 1, \"name\": \"sea\","
    " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.27},"
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.3},"
    " \"surface\": {\"layers\": [{\"elevation\": \"black.png\"}, {\"colour\": \"%s.png\"},"
    "  {\"water\": \"white.png\"}]}%s}";

#define BLACK_WATER                                                                                \
    "\"water\": {\"absorption_per_m\": 1000, \"scattering_per_m\": 0, \"refractive_index\": 1.34," \
    " \"chlorophyll_mg_m3\": 0, \"dissolved_per_m_440\": 0}, \"bed\": {\"depth_m\": 100}"

// The middle pixel from 1000 km, looking straight down, for a few suns; green.
enum { SUNS = 3 };
static void look_down(const struct setup *s, const char *picture, const char *ocean,
                      const double elevations_deg[SUNS], double greens[SUNS])
{
    char text[1024];
    const int length = snprintf(text, sizeof text, scene_format, picture, ocean);
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    assert_int_equal(trl_scene_parse(s->f->ctx, text, (size_t)length, "sea", s->folder, &scene),
                     TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    assert_int_equal(trl_renderer_create(s->f->ctx, &desc, &renderer), TRL_OK);
    trl_view view = trl_view_default();
    view.latitude_rad = 0.3;
    view.longitude_rad = 1;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = 1e6;
    view.pitch_rad = -PI / 2;
    view.vertical_fov_rad = 0.02;
    view.sun_mode = TRL_SUN_LOCAL;
    for (int i = 0; i < SUNS; i++) {
        static float radiance[4 * SIZE * SIZE];
        view.sun_latitude_or_elevation_rad = elevations_deg[i] * PI / 180;
        assert_int_equal(trl_renderer_draw(renderer, &view, SIZE, SIZE, 0), TRL_OK);
        assert_int_equal(trl_renderer_read_radiance(renderer, radiance), TRL_OK);
        greens[i] = (double)radiance[4 * (SIZE * SIZE / 2) + 1];
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
}

static int write_map(const struct setup *s, const char *name, uint8_t value)
{
    static uint8_t rgba[4 * MAP_WIDTH * MAP_HEIGHT];
    memset(rgba, value, sizeof rgba);
    char path[128];
    snprintf(path, sizeof path, "%s/%s", s->folder, name);
    return trl_image_write_png(s->f->ctx, path, MAP_WIDTH, MAP_HEIGHT, rgba) == TRL_OK ? 0 : 1;
}

static int set_up(void **state)
{
    void *f = NULL;
    struct setup *s = calloc(1, sizeof *s);
    *state = s;
    if (!s || fixture_set_up_gpu(&f)) {
        return 1;
    }
    s->f = f;
    snprintf(s->folder, sizeof s->folder, "/tmp/terrella-sea-XXXXXX");
    return !mkdtemp(s->folder) || write_map(s, "black.png", 0) || write_map(s, "white.png", 255);
}

static int tear_down(void **state)
{
    struct setup *s = *state;
    char path[128];
    snprintf(path, sizeof path, "%s/black.png", s->folder);
    unlink(path);
    snprintf(path, sizeof path, "%s/white.png", s->folder);
    unlink(path);
    rmdir(s->folder);
    void *f = s->f;
    free(s);
    return fixture_tear_down(&f);
}

static const double ELEVATIONS_DEG[SUNS] = {90, 70, 50};

static void the_glint_is_that_of_the_slopes(void **state)
{
    // Ground is white where there is no ocean, which tells the star's light, and water level.
    double ground[SUNS], glint[SUNS];
    look_down(*state, "white", "", ELEVATIONS_DEG, ground);
    look_down(
        *state, "white",
        ", \"ocean\": {\"waves\": {\"mean_square_slope\": 0.04, \"whitecaps\": 0}, " BLACK_WATER
        "}",
        ELEVATIONS_DEG, glint);
    for (size_t i = 0; i < SUNS; i++) {
        const double elevation = ELEVATIONS_DEG[i] * PI / 180;
        const double tilt = (PI / 2 - elevation) / 2;
        const double slope2 = tan(tilt) * tan(tilt);
        // Cox and Munk 1954: nothing is hidden at these angles (Smith's factors are above 0.9999).
        const double wanted = ground[0] * PI * fresnel_reflectance(cos(tilt), 1.34) *
                              exp(-slope2 / MSS) / (PI * MSS) / (4 * pow(cos(tilt), 4));
        printf("sun at %g deg: %g, closed form %g\n", ELEVATIONS_DEG[i], glint[i], wanted);
        // Waves that pixels of 600 m leave unseen have the slopes of all within a hundredth; the
        // tail falls by 2 % a tenth of a degree.
        assert_true(fabs(glint[i] / wanted - 1) < (i < 2 ? 0.015 : 0.04));
        assert_true(fabs(ground[i] / ground[0] - sin(elevation)) < 0.005);
    }
}

static void shallow_water_shows_its_bed(void **state)
{
    const char *const format = ", \"ocean\": {\"waves\": {\"mean_square_slope\": 0.001, "
                               "\"whitecaps\": 0}, \"bed\": {\"albedo\": 0.5, \"depth_m\": %g}}";
    const double depths_m[] = {1, 40};
    double before = INFINITY;
    for (size_t i = 0; i < 2; i++) {
        char ocean[256];
        double greens[SUNS];
        snprintf(ocean, sizeof ocean, format, depths_m[i]);
        look_down(*state, "white", ocean, (const double[]){50, 30, -30},
                  greens); // beside the glint
        assert_true(greens[0] > greens[1] && greens[1] > 0 && greens[2] < 1e-6 * greens[1]);
        assert_true(greens[0] < 0.9 * before);
        before = greens[0];
    }
}

#define AIR                                                                                        \
    "\"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"air\","                 \
    " \"scattering_per_m\": 1.3e-5, \"profile\": {\"exponential\": {\"scale_height_m\": "          \
    "8000}}, \"phase\": \"rayleigh\"}]}"

// What pictures have where the sea is does not light the air above it.
static void the_air_over_the_sea_does_not_know_its_picture(void **state)
{
    const char *const air = ", " AIR ", \"ocean\": {\"waves\": {\"count\": 4}}";
    double greens[2][SUNS];
    for (int i = 0; i < 2; i++) {
        look_down(*state, i ? "white" : "black", air, ELEVATIONS_DEG, greens[i]);
    }
    for (int i = 0; i < SUNS; i++) {
        printf("over black %g, over white %g\n", greens[0][i], greens[1][i]);
        assert_true(fabs(greens[1][i] / greens[0][i] - 1) < 1e-3);
    }
}

// From a height, toward the star and down, with each of these suns in turn: the last picture.
static void look_on(const struct setup *s, double altitude_m, const double *elevations_deg,
                    size_t suns, float *radiance)
{
    char text[1024];
    const int length = snprintf(text, sizeof text, scene_format, "white",
                                ", " AIR ", \"ocean\": {\"waves\": {\"count\": 4}}");
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    assert_int_equal(trl_scene_parse(s->f->ctx, text, (size_t)length, "sea", s->folder, &scene),
                     TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    desc.max_orders = 1; // solved at once
    assert_int_equal(trl_renderer_create(s->f->ctx, &desc, &renderer), TRL_OK);
    trl_view view = trl_view_default();
    view.longitude_rad = 1;
    view.altitude_m = altitude_m;
    view.pitch_rad = -0.6;
    view.vertical_fov_rad = 1;
    view.sun_mode = TRL_SUN_LOCAL;
    for (size_t i = 0; i < suns; i++) {
        view.sun_latitude_or_elevation_rad = elevations_deg[i] * PI / 180;
        assert_int_equal(trl_renderer_draw(renderer, &view, SIZE, SIZE, 0), TRL_OK);
    }
    assert_int_equal(trl_renderer_read_radiance(renderer, radiance), TRL_OK);
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
}

// What is mirrored is made for the suns that a view has, when it has them.
static void the_sea_mirrors_the_sky_under_every_sun(void **state)
{
    static float first[4 * SIZE * SIZE], later[4 * SIZE * SIZE];
    static const double suns_deg[] = {50, 4};
    static const double altitudes_m[] = {10, 1e6};
    for (size_t i = 0; i < sizeof altitudes_m / sizeof *altitudes_m; i++) {
        look_on(*state, altitudes_m[i], suns_deg, 2, later);
        look_on(*state, altitudes_m[i], suns_deg + 1, 1, first);
        assert_memory_equal(first, later, sizeof first);
    }
}

// From 30 m, toward the star: how much pixels differ, over their mean.
static double find_contrast(const struct setup *s, trl_sky_model model, double *mean)
{
    char text[1024];
    const int length =
        snprintf(text, sizeof text, scene_format, "white",
                 ", \"ocean\": {\"waves\": {\"wind_m_s\": 7, \"whitecaps\": 0}, " BLACK_WATER "}");
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    assert_int_equal(trl_scene_parse(s->f->ctx, text, (size_t)length, "sea", s->folder, &scene),
                     TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    desc.sky_model = model;
    assert_int_equal(trl_renderer_create(s->f->ctx, &desc, &renderer), TRL_OK);
    trl_view view = trl_view_default();
    view.longitude_rad = 1;
    view.altitude_m = 30;
    view.pitch_rad = -PI / 4;
    view.vertical_fov_rad = 0.5;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = PI / 4;
    view.sun_longitude_or_azimuth_rad = view.heading_rad;
    static float radiance[4 * SIZE * SIZE];
    assert_int_equal(trl_renderer_draw(renderer, &view, SIZE, SIZE, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, radiance), TRL_OK);
    double sum = 0, squares = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double green = (double)radiance[4 * i + 1];
        sum += green / (SIZE * SIZE);
        squares += green * green / (SIZE * SIZE);
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    *mean = sum;
    return sqrt(fmax(squares / (sum * sum) - 1, 0));
}

static void every_model_has_the_same_waves(void **state)
{
    double means[3];
    for (int model = 0; model < 3; model++) {
        const double contrast = find_contrast(*state, (trl_sky_model)model, &means[model]);
        printf("model %d: contrast %.3f, mean %g\n", model, contrast, means[model]);
        // Of a mean surface the glint falls by a third to the corners, a contrast of 0.1.
        assert_true(contrast > 0.5);
        assert_true(fabs(means[model] / means[0] - 1) < 0.05);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_glint_is_that_of_the_slopes),
        cmocka_unit_test(shallow_water_shows_its_bed),
        cmocka_unit_test(the_air_over_the_sea_does_not_know_its_picture),
        cmocka_unit_test(the_sea_mirrors_the_sky_under_every_sun),
        cmocka_unit_test(every_model_has_the_same_waves),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
