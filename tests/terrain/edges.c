// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Silhouettes in small pictures against the same pictures drawn eight times as fine.
#include "fixture.h"

#include "scene/scene.h"
#include <terrella/terrella.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 160, HEIGHT = 120, FINER = 8 };
static const double DEGREE = 3.14159265358979323846 / 180;

// Cones in rows, some before others.
static double hill_height(double latitude, double longitude)
{
    const double x = fmod(fabs(latitude) + 0.037, 0.11) - 0.055;
    const double y = fmod(fabs(longitude), 0.2) - 0.1;
    return fmax(0, 3000 * (1 - hypot(x / 0.07, y / 0.05)));
}

struct world {
    trl_scene *scene;
    trl_renderer *renderer;
};

// With next to no air: light ground before a black sky.
static void make_world(struct fixture *f, bool has_hills, struct world *out)
{
    char path[128];
    const struct raster_place place = {-1, 1, 0.002, 1000, 1000};
    fixture_write_heights(f, "hills", &place, hill_height, path);
    char text[1024];
    snprintf(text, sizeof text,
             "{\"terrella\": 1, \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": "
             "0.27},"
             " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.3},"
             " \"atmosphere\": {\"height_m\": 60000, \"constituents\": ["
             "  {\"scattering_per_m\": 1e-12, \"phase\": \"rayleigh\","
             "   \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}}]}%s}",
             has_hills ? ", \"surface\": {\"layers\": [{\"elevation\": \"hills.tif\"}]}" : "");
    assert_int_equal(trl_scene_parse(f->ctx, text, strlen(text), "hills", f->folder, &out->scene),
                     TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = out->scene;
    desc.mesher = TRL_MESHER_HEMISPHERE; // has one mesh whatever the picture's size
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &out->renderer), TRL_OK);
}

static void destroy_world(struct world *w)
{
    trl_renderer_destroy(&w->renderer);
    trl_scene_destroy(&w->scene);
}

static float *draw(const struct world *w, const trl_view *view, int finer)
{
    const uint32_t width = (uint32_t)(WIDTH * finer);
    const uint32_t height = (uint32_t)(HEIGHT * finer);
    float *rgba = malloc(sizeof(float) * 4 * width * height);
    assert_non_null(rgba);
    assert_int_equal(trl_renderer_draw(w->renderer, view, width, height, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(w->renderer, rgba), TRL_OK);
    return rgba;
}

// Root mean square of what green is wrong by, relative to the brightest, over pixels that show more
// than one thing.
static double edge_error(const struct world *w, const trl_view *view)
{
    float *rough = draw(w, view, 1);
    float *fine = draw(w, view, FINER);
    double brightest = 0;
    double sum = 0;
    int count = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            double mean = 0;
            double least = INFINITY;
            double most = 0;
            for (int i = 0; i < FINER * FINER; i++) {
                const int row = y * FINER + i / FINER;
                const int column = x * FINER + i % FINER;
                const double green = (double)fine[4 * (row * WIDTH * FINER + column) + 1];
                mean += green / (FINER * FINER);
                least = fmin(least, green);
                most = fmax(most, green);
            }
            brightest = fmax(brightest, most);
            if (least < 0.5 * most) {
                const double error = (double)rough[4 * (y * WIDTH + x) + 1] - mean;
                sum += error * error;
                count++;
            }
        }
    }
    free(rough);
    free(fine);
    assert_true(count > WIDTH / 2);
    printf("%d pixels at edges: %.3f\n", count, sqrt(sum / count) / brightest);
    return sqrt(sum / count) / brightest;
}

static trl_view make_view(double altitude_m, double pitch_deg, double roll_deg)
{
    trl_view view = trl_view_default();
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = altitude_m;
    view.longitude_rad = 0.01;
    view.pitch_rad = pitch_deg * DEGREE;
    view.roll_rad = roll_deg * DEGREE;
    view.heading_rad = 90 * DEGREE;
    view.vertical_fov_rad = 30 * DEGREE;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 70 * DEGREE;
    return view;
}

// Drawn through their middles alone, pixels at an edge are wrong by 1 / sqrt(12) = 0.29.
static void the_horizon_of_the_bare_sphere_has_no_steps(void **state)
{
    struct fixture *f = *state;
    struct world w;
    make_world(f, false, &w);
    const double rolls[] = {1.5, 20, 88};
    for (int i = 0; i < 3; i++) {
        const trl_view view = make_view(300, 0, rolls[i]);
        assert_true(edge_error(&w, &view) < 0.06);
    }
    trl_view view = make_view(2e7, -90, 0); // a whole disc: all directions
    assert_true(edge_error(&w, &view) < 0.1);
    destroy_world(&w);
}

static void hills_before_hills_have_no_steps(void **state)
{
    struct fixture *f = *state;
    struct world w;
    make_world(f, true, &w);
    const trl_view view = make_view(2500, 0, 3);
    // Peaks are smaller than the steps that tell of them.
    assert_true(edge_error(&w, &view) < 0.15);
    destroy_world(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_horizon_of_the_bare_sphere_has_no_steps),
        cmocka_unit_test(hills_before_hills_have_no_steps),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
