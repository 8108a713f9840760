// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "cloud_check.h"

#include "difference.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

struct look {
    const char *name;
    double altitude_m, heading_deg, pitch_deg, sun_elevation_deg, sun_azimuth_deg;
};
static const struct look looks[CLOUD_LOOKS] = {
    {"noon, from 3 km", 3000, 170, -12, 65, 40},
    {"noon, from below", 2, 170, 25, 65, 40},
    {"sunset, from 3 km", 3000, 170, -8, 4, 260},
    {"against the sun, from 3 km", 3000, 250, -8, 25, 255}};

const char *cloud_look_name(int look)
{
    return looks[look].name;
}

static trl_view view_of(const struct look *look)
{
    const double rad = pi / 180;
    trl_view view = trl_view_default();
    view.latitude_rad = 0;
    view.longitude_rad = 0;
    view.altitude_m = look->altitude_m;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.heading_rad = look->heading_deg * rad;
    view.pitch_rad = look->pitch_deg * rad;
    view.vertical_fov_rad = 60 * rad;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = look->sun_elevation_deg * rad;
    view.sun_longitude_or_azimuth_rad = look->sun_azimuth_deg * rad;
    return view;
}

trl_result cloud_check_make(const struct app *app, const trl_scene *scene, trl_renderer *renderer,
                            int look, uint64_t paths, struct cloud_check *out)
{
    *out = (struct cloud_check){.view = view_of(&looks[look])};
    const struct shot_desc desc = {.renderer = renderer,
                                   .view = &out->view,
                                   .model = TRL_SKY_SPECTRAL,
                                   .size = {CLOUD_WIDTH * CLOUD_FINER, CLOUD_HEIGHT * CLOUD_FINER},
                                   .samples = 2};
    trl_reference_desc reference = trl_reference_desc_default();
    reference.scene = scene;
    reference.paths = paths / 2;
    trl_result result = shot_take(&desc, &out->drawn);
    for (int half = 0; half < 2 && result == TRL_OK; half++) {
        reference.seed = (uint64_t)half;
        result = trl_reference_render(app->ctx, &reference, &out->view, CLOUD_WIDTH, CLOUD_HEIGHT,
                                      out->halves[half], out->errors[half]);
    }
    return result;
}

void cloud_check_finish(struct cloud_check *check)
{
    shot_finish(&check->drawn);
}

// Half the difference of both halves about a pixel. What the few paths of one pixel tell of
// themselves is too small where they missed the strong ones.
static float find_noise(const struct cloud_check *check, int x, int y, int channel)
{
    float sum = 0, count = 0;
    for (int k = 0; k < 9; k++) {
        const int column = x + k % 3 - 1, row = y + k / 3 - 1;
        if (column >= 0 && column < CLOUD_WIDTH && row >= 0 && row < CLOUD_HEIGHT) {
            const int i = 4 * (row * CLOUD_WIDTH + column) + channel;
            const float half = 0.5f * (check->halves[0][i] - check->halves[1][i]);
            sum += half * half;
            count++;
        }
    }
    return sqrtf(sum / count);
}

void cloud_check_join(const struct cloud_check *check, float *radiance, float *error)
{
    for (int i = 0; i < CLOUD_PIXELS * 4; i++) {
        const int pixel = i / 4;
        radiance[i] = 0.5f * (check->halves[0][i] + check->halves[1][i]);
        error[i] = find_noise(check, pixel % CLOUD_WIDTH, pixel / CLOUD_WIDTH, i % 4);
    }
}

// What is drawn in a pixel of the traced picture.
static double drawn_luminance(const struct cloud_check *c, size_t pixel)
{
    double sum = 0;
    for (size_t i = 0; i < CLOUD_FINER * CLOUD_FINER; i++) {
        const size_t x = pixel % CLOUD_WIDTH * CLOUD_FINER + i % CLOUD_FINER;
        const size_t y = pixel / CLOUD_WIDTH * CLOUD_FINER + i / CLOUD_FINER;
        sum += difference_luminance(c->drawn.radiance + 4 * (y * c->drawn.width + x));
    }
    return sum / (CLOUD_FINER * CLOUD_FINER);
}

// Errors of the primaries of a pixel come from the same paths: together at most their sum.
static struct cloud_pixel find_pixel(const struct cloud_check *c, size_t i)
{
    struct cloud_pixel pixel = {.drawn = drawn_luminance(c, i)};
    double errors[2];
    for (int half = 0; half < 2; half++) {
        pixel.halves[half] = difference_luminance(c->halves[half] + 4 * i);
        errors[half] = difference_luminance(c->errors[half] + 4 * i);
    }
    pixel.error = 0.5 * hypot(errors[0], errors[1]);
    return pixel;
}

struct cloud_figures cloud_check_judge(const struct cloud_check *check)
{
    struct cloud_pixel pixels[CLOUD_PIXELS];
    for (size_t i = 0; i < CLOUD_PIXELS; i++) {
        pixels[i] = find_pixel(check, i);
    }
    return cloud_judge(pixels, CLOUD_PIXELS);
}
