// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Shadows in the air: what a wall takes out of the light of the air, against brute force; that
// there is nothing to see without a wall; and the edge of a shadow in the mean over a segment.
#include "fixture.h"

#include "scatter/atmosphere.h"
#include "scene/scene.h"
#include "shared/penumbra.glsl"
#include <terrella/terrella.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 512, HEIGHT = 384 };
static const double R = 6371000;
static const double DEGREE = 3.14159265358979323846 / 180;
static const double CREST_M = 2400;
static const double HALF_WIDTH_DEG = 0.08;
static const double DISC_RAD = 0.0047;

// A ridge along the meridian 0.
static double ridge_height(double latitude, double longitude)
{
    (void)latitude;
    return fmax(0, CREST_M * (1 - fabs(longitude) / HALF_WIDTH_DEG));
}

static double plain_height(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 0;
}

struct world {
    trl_scene *scene;
    trl_renderer *renderer;
    struct atmosphere *atmosphere;
};

// Earth's air, hazy, over heights.
static void make_world(struct fixture *f, double (*heights)(double, double), struct world *out)
{
    char path[128];
    const struct raster_place place = {-2, 1, 0.002, 1500, 1000};
    fixture_write_heights(f, "heights", &place, heights, path);
    static const char text[] =
        "{\"terrella\": 1, \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": "
        "0.2693},"
        " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.1},"
        " \"atmosphere\": {\"height_m\": 60000, \"constituents\": ["
        "  {\"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 1.15e-5,"
        "    \"exponent\": -4}}, \"phase\": \"rayleigh\","
        "   \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}},"
        "  {\"scattering_per_m\": 4e-5, \"phase\": {\"henyey_greenstein\": {\"g\": 0.7}},"
        "   \"profile\": {\"exponential\": {\"scale_height_m\": 1500}}}]},"
        " \"surface\": {\"layers\": [{\"elevation\": \"heights.tif\"}]}}";
    assert_int_equal(trl_scene_parse(f->ctx, text, strlen(text), "air", f->folder, &out->scene),
                     TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = out->scene;
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &out->renderer), TRL_OK);
    const struct atmosphere_desc atmosphere = atmosphere_desc_default();
    assert_int_equal(atmosphere_create(f->ctx, &out->scene->medium, &atmosphere, &out->atmosphere),
                     TRL_OK);
}

static void destroy_world(struct world *w)
{
    atmosphere_destroy(&w->atmosphere);
    trl_renderer_destroy(&w->renderer);
    trl_scene_destroy(&w->scene);
}

// West of the ridge, with the sun low in the east behind it, looking along it.
static trl_view make_view(double heading_deg, double pitch_deg)
{
    trl_view view = trl_view_default();
    view.latitude_rad = 0;
    view.longitude_rad = -0.15 * DEGREE;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = 900; // 600 m below the edge of the shadow
    view.heading_rad = heading_deg * DEGREE;
    view.pitch_rad = pitch_deg * DEGREE;
    view.vertical_fov_rad = 40 * DEGREE;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 3 * DEGREE;
    view.sun_longitude_or_azimuth_rad = 90 * DEGREE;
    return view;
}

// The same as the renderer sees it.
static struct camera find_camera(const trl_view *view)
{
    const struct camera_place place = {.longitude = view->longitude_rad / DEGREE,
                                       .radius_m = R,
                                       .altitude_m = view->altitude_m,
                                       .heading = view->heading_rad / DEGREE,
                                       .pitch = view->pitch_rad / DEGREE,
                                       .fov = view->vertical_fov_rad / DEGREE};
    struct camera camera = fixture_camera(&place);
    camera.tan_half_fov_x *= (double)WIDTH / HEIGHT;
    const double e = view->sun_latitude_or_elevation_rad; // to the east
    const double lon = view->longitude_rad;
    camera.sun_direction = vec3_add(vec3_scale((struct vec3){cos(lon), sin(lon), 0}, sin(e)),
                                    vec3_scale((struct vec3){-sin(lon), cos(lon), 0}, cos(e)));
    return camera;
}

struct size {
    int width, height;
};

static float *draw_size(const struct world *w, const trl_view *view, trl_air air, struct size size)
{
    float *rgba = malloc(sizeof(float) * 4 * (size_t)size.width * (size_t)size.height);
    assert_non_null(rgba);
    assert_int_equal(trl_renderer_set_air(w->renderer, air), TRL_OK);
    assert_int_equal(trl_renderer_air(w->renderer), air);
    assert_int_equal(
        trl_renderer_draw(w->renderer, view, (uint32_t)size.width, (uint32_t)size.height, 0),
        TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(w->renderer, rgba), TRL_OK);
    return rgba;
}

static float *draw(const struct world *w, const trl_view *view, trl_air air)
{
    return draw_size(w, view, air, (struct size){WIDTH, HEIGHT});
}

// Part of a uniform disc above a straight edge, which its middle is `height` radii above.
static double disc_above(double height)
{
    const double y = fmax(-1, fmin(1, height));
    return 0.5 + (asin(y) + y * sqrt(1 - y * y)) / M_PI;
}

// What the ridge leaves of the star at a point, seen as a wall in the plane of the meridian 0.
static double ridge_leaves(struct vec3 p, struct vec3 sun)
{
    if (p.y >= 0) {
        return 1;
    }
    const double t = -p.y / sun.y; // to the plane
    const struct vec3 over = vec3_add(p, vec3_scale(sun, t));
    if (fabs(asin(over.z / vec3_length(over))) > 0.99 * DEGREE) {
        return 1; // past the end of the heights
    }
    return disc_above((vec3_length(over) - R - CREST_M) / (t * DISC_RAD));
}

// Light of the first order that does not arrive because of the ridge, per unit irradiance of the
// star: a plain sum over many points.
static lanes missing_light(const struct world *w, const struct camera *camera, struct vec3 ray)
{
    const struct optics *o = w->atmosphere->optics;
    const struct sunlight *sunlight = &w->atmosphere->solution.sun;
    const double nu = vec3_dot(ray, camera->sun_direction);
    const int steps = 4000;
    const double step_m = 60; // 240 km: above the shadow, or through the ground
    lanes depth = {0};
    lanes missing = {0};
    for (int i = 0; i < steps; i++) {
        const struct vec3 p = vec3_add(camera->position_m, vec3_scale(ray, (i + 0.5) * step_m));
        const double r = vec3_length(p);
        const double latitude_deg = asin(p.z / r) / DEGREE;
        const double ridge_m =
            fabs(latitude_deg) < 1 ? ridge_height(latitude_deg, atan2(p.y, p.x) / DEGREE) : 0;
        if (r < R + ridge_m || r > o->top_radius_m) {
            break;
        }
        lanes extinction = {0};
        lanes scattering = {0};
        for (int k = 0; k < o->constituent_count; k++) {
            const struct constituent *c = &o->medium->constituents[k];
            const double density = profile_density(&c->profile, r - R);
            extinction += o->extinction_per_m[k] * (float)density;
            scattering += o->scattering_per_m[k] * (float)(density * phase_value(&c->phase, nu));
        }
        lanes light;
        sunlight_at(sunlight, r, vec3_dot(p, camera->sun_direction) / r, &light);
        const double hidden = 1 - ridge_leaves(p, camera->sun_direction);
        missing += lanes_exp_negative(-depth - extinction * (float)(0.5 * step_m)) * scattering *
                   light * (float)(hidden * step_m);
        depth += extinction * (float)step_m;
    }
    return missing;
}

static void a_ridge_takes_the_light_that_brute_force_finds_missing(void **state)
{
    struct fixture *f = *state;
    struct world w;
    make_world(f, ridge_height, &w);
    struct band_fit fit;
    band_fit_init(&fit, w.atmosphere->optics);
    const double headings[] = {0, 40, 200};
    const double pitches[] = {8, 12, 0};
    double worst = 0;
    double most = 0;
    for (int v = 0; v < 3; v++) {
        const trl_view view = make_view(headings[v], pitches[v]);
        float *table = draw(&w, &view, TRL_AIR_TABLE);
        float *march = draw(&w, &view, TRL_AIR_MARCH);
        const struct camera camera = find_camera(&view);
        for (int y = 20; y < HEIGHT; y += 37) {
            for (int x = 25; x < WIDTH; x += 91) {
                const struct vec3 ray = vec3_normalize(
                    camera_ray(&camera, 2 * (x + 0.5) / WIDTH - 1, 1 - 2 * (y + 0.5) / HEIGHT));
                const lanes missing = missing_light(&w, &camera, ray);
                for (int k = 0; k < 3; k++) {
                    double wanted = 0;
                    for (int i = 0; i < LANES; i++) {
                        wanted += fit.rgb_from_lanes[k][i] * (double)missing[i];
                    }
                    const size_t at = 4 * (size_t)(y * WIDTH + x) + (size_t)k;
                    const double whole = (double)table[at];
                    const double got = whole - (double)march[at];
                    worst = fmax(worst, fabs(got - wanted) / whole);
                    most = fmax(most, wanted / whole);
                }
            }
        }
        free(table);
        free(march);
    }
    printf("up to %.1f %% are missing, at most %.2f %% wrongly\n", 100 * most, 100 * worst);
    // Steps of the march are some kilometres long, its grid is of 8 pixels.
    assert_true(most > 0.4);
    assert_true(worst < 0.04);
    destroy_world(&w);
}

static void without_terrain_in_the_way_marching_changes_nothing(void **state)
{
    struct fixture *f = *state;
    struct world w;
    make_world(f, plain_height, &w);
    const double elevations[] = {40, 2};
    for (int v = 0; v < 2; v++) {
        trl_view view = make_view(70, 0);
        view.sun_latitude_or_elevation_rad = elevations[v] * DEGREE;
        float *table = draw(&w, &view, TRL_AIR_TABLE);
        float *march = draw(&w, &view, TRL_AIR_MARCH);
        for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) {
            assert_true(isfinite(march[i]));
            assert_true(fabsf(march[i] - table[i]) <= 1e-6f * fabsf(table[i]));
        }
        free(table);
        free(march);
    }
    // A setting sun: the level ground's own shadow is in the tables already.
    trl_view view = make_view(70, 0);
    view.sun_latitude_or_elevation_rad = -3 * DEGREE;
    float *table = draw(&w, &view, TRL_AIR_TABLE);
    float *march = draw(&w, &view, TRL_AIR_MARCH);
    double worst = 0;
    for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) {
        worst = fmax(worst, fabs((double)march[i] / (double)table[i] - 1));
    }
    printf("below the horizon: %.2f %%\n", 100 * worst);
    // The map finds it by interpolation: some metres of hundreds.
    assert_true(worst < 0.01);
    free(table);
    free(march);
    destroy_world(&w);
}

// The sun is higher than the slopes are steep, so there is no shadow. Rays of the march's grid see
// the plain beyond the ridge and go through it.
static void a_ridge_in_full_light_takes_nothing_however_coarse_the_picture(void **state)
{
    struct fixture *f = *state;
    struct world w;
    make_world(f, ridge_height, &w);
    trl_view view = make_view(90, -4);
    view.altitude_m = 4000;
    view.vertical_fov_rad = 16 * DEGREE;
    view.sun_latitude_or_elevation_rad = 40 * DEGREE;
    const struct size sizes[] = {{64, 48}, {320, 240}};
    for (int s = 0; s < 2; s++) {
        float *table = draw_size(&w, &view, TRL_AIR_TABLE, sizes[s]);
        float *march = draw_size(&w, &view, TRL_AIR_MARCH, sizes[s]);
        double worst = 0;
        for (int i = 0; i < 4 * sizes[s].width * sizes[s].height; i++) {
            worst = fmax(worst, fabs((double)march[i] / (double)table[i] - 1));
        }
        printf("%d x %d: %.2f %%\n", sizes[s].width, sizes[s].height, 100 * worst);
        // Rounding, and crests that the shadow map's cells cut.
        assert_true(worst < 0.001);
        free(table);
        free(march);
    }
    destroy_world(&w);
}

static void the_mean_over_a_segment_is_that_of_its_points(void **state)
{
    (void)state;
    const double ends[] = {-30, -2, -1, -0.6, -0.1, 0, 0.3, 0.9, 1, 1.7, 40};
    const int count = sizeof ends / sizeof *ends;
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            double sum = 0;
            const int points = 20000;
            for (int k = 0; k < points; k++) {
                sum += penumbra_visible(ends[i] + (ends[j] - ends[i]) * (k + 0.5) / points);
            }
            assert_close(penumbra_mean(ends[i], ends[j]), sum / points, 1e-5);
        }
    }
    assert_true(penumbra_mean(1, 7) == 1);
    // Against a disc behind a straight edge: never off by more than a twentieth.
    for (double t = -1.2; t < 1.2; t += 0.01) {
        assert_close(penumbra_visible(t), disc_above(t), 0.05);
    }
}

static void the_way_can_be_chosen_by_its_name_and_nothing_else(void **state)
{
    struct fixture *f = *state;
    struct world w;
    make_world(f, plain_height, &w);
    assert_string_equal(trl_air_name(TRL_AIR_MARCH), "march");
    assert_null(trl_air_name((trl_air)2));
    assert_int_equal(trl_renderer_air(w.renderer), TRL_AIR_MARCH);
    assert_int_equal(trl_renderer_set_air(w.renderer, (trl_air)2), TRL_ERROR_INVALID);
    assert_int_equal(trl_renderer_air(w.renderer), TRL_AIR_MARCH);
    destroy_world(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_over_a_segment_is_that_of_its_points),
        cmocka_unit_test(without_terrain_in_the_way_marching_changes_nothing),
        cmocka_unit_test(a_ridge_in_full_light_takes_nothing_however_coarse_the_picture),
        cmocka_unit_test(a_ridge_takes_the_light_that_brute_force_finds_missing),
        cmocka_unit_test(the_way_can_be_chosen_by_its_name_and_nothing_else),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
