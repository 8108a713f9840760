// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A scene with rasters in the frame: a globe whose northern half is a plateau, green in the north
// and red in the south; and scenes whose rasters are not there.
#include "fixture.h"
#include <terrella/image.h>
#include <terrella/renderer.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAP_WIDTH = 64, MAP_HEIGHT = 32, WIDTH = 64, HEIGHT = 48 };

static const double PI = 3.14159265358979323846;

struct setup {
    struct fixture *f;
    char folder[64];
    trl_scene *scene;
    trl_renderer *renderer;
};

static const char scene_format[] =
    "{\"terrella\": 1, \"name\": \"halves\","
    " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.27},"
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.3},"
    " \"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"air\","
    "  \"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 1e-6,"
    "   \"exponent\": -4}}, \"profile\": {\"exponential\": {\"scale_height_m\": 8000}},"
    "  \"phase\": \"rayleigh\"}]},"
    " \"surface\": {\"layers\": [{\"elevation\": \"relief.png\", \"scale\": 30},"
    "  {\"colour\": \"%s\", \"optional\": %s},"
    "  {\"lights\": \"lights.png\", \"radiance_cd_m2\": 3}]}}";

static trl_scene *parse(struct fixture *f, const char *folder, const char *colour,
                        const char *is_optional)
{
    char text[1024];
    const int length = snprintf(text, sizeof text, scene_format, colour, is_optional);
    trl_scene *scene = NULL;
    assert_int_equal(trl_scene_parse(f->ctx, text, (size_t)length, "halves", folder, &scene),
                     TRL_OK);
    return scene;
}

static trl_result create(struct fixture *f, const trl_scene *scene, trl_renderer **out)
{
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    return trl_renderer_create(f->ctx, &desc, out);
}

static int write_map(const struct setup *s, const char *name, const uint8_t north[3],
                     const uint8_t south[3])
{
    static uint8_t rgba[4 * MAP_WIDTH * MAP_HEIGHT];
    for (size_t i = 0; i < (size_t)MAP_WIDTH * MAP_HEIGHT; i++) {
        memcpy(rgba + 4 * i, i < MAP_WIDTH * MAP_HEIGHT / 2 ? north : south, 3);
    }
    char path[128];
    snprintf(path, sizeof path, "%s/%s", s->folder, name);
    return trl_image_write_png(s->f->ctx, path, MAP_WIDTH, MAP_HEIGHT, rgba) == TRL_OK ? 0 : 1;
}

static int set_up(void **state)
{
    static const uint8_t high[3] = {100, 100, 100}, low[3] = {0, 0, 0};
    static const uint8_t green[3] = {20, 200, 20}, red[3] = {200, 20, 20};
    static const uint8_t white[3] = {255, 255, 255};
    void *f = NULL;
    struct setup *s = calloc(1, sizeof *s);
    *state = s;
    if (!s || fixture_set_up(&f)) {
        return 1;
    }
    s->f = f;
    snprintf(s->folder, sizeof s->folder, "/tmp/terrella-ground-XXXXXX");
    if (!mkdtemp(s->folder) || write_map(s, "relief.png", high, low) ||
        write_map(s, "colour.png", green, red) || write_map(s, "lights.png", low, white)) {
        return 1;
    }
    s->scene = parse(s->f, s->folder, "colour.png", "false");
    const trl_result result = create(s->f, s->scene, &s->renderer);
    fixture_skip_without_gl(s->f, result);
    return result == TRL_OK ? 0 : 1;
}

static int tear_down(void **state)
{
    struct setup *s = *state;
    trl_renderer_destroy(&s->renderer);
    trl_scene_destroy(&s->scene);
    char path[128];
    snprintf(path, sizeof path, "%s/relief.png", s->folder);
    unlink(path);
    snprintf(path, sizeof path, "%s/colour.png", s->folder);
    unlink(path);
    snprintf(path, sizeof path, "%s/lights.png", s->folder);
    unlink(path);
    rmdir(s->folder);
    void *f = s->f;
    free(s);
    return fixture_tear_down(&f);
}

static void altitudes_are_those_of_the_raster(void **state)
{
    const struct setup *s = *state;
    // In the middle of each half; the reconstruction between texels reaches two of 5.6 degrees.
    assert_true(fabs(trl_renderer_ground_altitude_m(s->renderer, 0.8, 1) - 3000) < 1);
    assert_true(fabs(trl_renderer_ground_altitude_m(s->renderer, -0.8, 1)) < 1);
}

static void cameras_stand_on_the_raster(void **state)
{
    const struct setup *s = *state;
    trl_view view = trl_view_default(), resolved;
    view.latitude_rad = 0.8;
    view.altitude_mode = TRL_ALTITUDE_GROUND;
    view.altitude_m = 10;
    assert_int_equal(trl_renderer_resolve(s->renderer, &view, &resolved), TRL_OK);
    assert_true(fabs(resolved.altitude_m - 3010) < 1);
    view.altitude_mode = TRL_ALTITUDE_SPHERE; // inside the plateau
    assert_int_equal(trl_renderer_resolve(s->renderer, &view, &resolved), TRL_OK);
    assert_true(resolved.altitude_m > 2999 && resolved.altitude_m < 3002);
}

// Mean radiance looking straight down from 1000 km.
static void look_down(const struct setup *s, double latitude_rad, double sun_elevation_rad,
                      double mean[3])
{
    trl_view view = trl_view_default();
    view.latitude_rad = latitude_rad;
    view.longitude_rad = 1;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = 1e6;
    view.pitch_rad = -PI / 2;
    view.vertical_fov_rad = 0.2;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = sun_elevation_rad;
    static float radiance[4 * WIDTH * HEIGHT];
    assert_int_equal(trl_renderer_draw(s->renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(s->renderer, radiance), TRL_OK);
    for (size_t c = 0; c < 3; c++) {
        mean[c] = 0;
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
            mean[c] += (double)radiance[4 * i + c] / (WIDTH * HEIGHT);
        }
    }
}

static void colours_are_those_of_the_raster(void **state)
{
    // sRGB 200 is 0.58 of the light, 20 is 0.007. Thin air adds a hundredth or two, and the few
    // wavelengths of the pictures let a tenth of such a saturated colour cross over.
    double north[3], south[3];
    look_down(*state, 0.8, 1.2, north);
    look_down(*state, -0.8, 1.2, south);
    assert_true(north[1] > 5 * north[0] && north[1] > 5 * north[2]);
    assert_true(south[0] > 5 * south[1] && south[0] > 5 * south[2]);
}

static void lights_at_night_are_as_bright_as_the_scene_says(void **state)
{
    double north[3], south[3];
    look_down(*state, 0.8, -1.2, north);
    look_down(*state, -0.8, -1.2, south);
    for (size_t c = 0; c < 3; c++) {
        // Thin air takes a hundredth. White of four bands is a few hundredths off in a component.
        assert_true(fabs(south[c] - 3) < 0.15);
        assert_true(north[c] < 1e-3);
    }
}

// A place of a flight down to the plateau's edge.
static void draw_flying(trl_renderer *renderer, int frame, float *radiance)
{
    trl_view view = trl_view_default();
    view.latitude_rad = -0.02 * frame;
    view.longitude_rad = 1 + 0.01 * frame;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = 4e5 / (1 + 3 * frame);
    view.pitch_rad = -0.3;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 0.5;
    assert_int_equal(trl_renderer_draw(renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, radiance), TRL_OK);
}

// As if it had been there from the start. Borders of the quadtree's squares depend on the way there
// by a float's last digits (decision 031), so a pixel at a silhouette may differ.
static void meshers_are_changed_in_flight(void **state)
{
    const struct setup *s = *state;
    static float flown[4 * WIDTH * HEIGHT], alone[4 * WIDTH * HEIGHT];
    int kinds = 0;
    while (trl_mesher_name((trl_mesher)kinds)) {
        kinds++;
    }
    trl_renderer *other = NULL; // makes each mesher for the one frame it is asked for
    assert_int_equal(create(s->f, s->scene, &other), TRL_OK);
    for (int frame = 0; frame < 2 * kinds; frame++) {
        const trl_mesher mesher = (trl_mesher)(frame % kinds);
        const trl_result changed = trl_renderer_set_mesher(s->renderer, mesher);
        if (mesher == TRL_MESHER_TESSELLATED && changed == TRL_ERROR_UNSUPPORTED) {
            s->f->errors--; // not on this GPU, as was told
            continue;
        }
        assert_int_equal(changed, TRL_OK);
        draw_flying(s->renderer, frame, flown);
        if (frame < kinds) {
            continue;
        }
        assert_int_equal(trl_renderer_set_mesher(other, mesher), TRL_OK);
        draw_flying(other, frame, alone);
        int different = 0;
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
            const float a = flown[4 * i + 1], b = alone[4 * i + 1];
            different += !(fabsf(a - b) <= 0.02f * fmaxf(fabsf(a), fabsf(b)));
        }
        if (different > 0) {
            printf("%s, frame %d: %d pixels\n", trl_mesher_name(mesher), frame, different);
        }
        assert_true(different <= WIDTH * HEIGHT / 200);
    }
    trl_renderer_destroy(&other);
    assert_int_equal(trl_renderer_set_mesher(s->renderer, trl_renderer_desc_default().mesher),
                     TRL_OK);
}

static void a_missing_raster_is_one_line_unless_it_is_optional(void **state)
{
    const struct setup *s = *state;
    trl_renderer *renderer = NULL;
    trl_scene *scene = parse(s->f, s->folder, "nowhere.png", "false");
    fixture_expect_error(s->f, create(s->f, scene, &renderer), TRL_ERROR_IO, TRL_LOG_ITEM_RASTER);
    assert_non_null(strstr(s->f->last_error, "nowhere.png"));
    assert_null(renderer);
    trl_scene_destroy(&scene);
    scene = parse(s->f, s->folder, "nowhere.png", "true");
    assert_int_equal(create(s->f, scene, &renderer), TRL_OK);
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(altitudes_are_those_of_the_raster),
        cmocka_unit_test(cameras_stand_on_the_raster),
        cmocka_unit_test(colours_are_those_of_the_raster),
        cmocka_unit_test(lights_at_night_are_as_bright_as_the_scene_says),
        cmocka_unit_test(meshers_are_changed_in_flight),
        cmocka_unit_test(a_missing_raster_is_one_line_unless_it_is_optional),
    };
    return cmocka_run_group_tests_name("ground", tests, set_up, tear_down);
}
