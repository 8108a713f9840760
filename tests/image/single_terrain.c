// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The two look-ups of the model single before terrain, S(P_v) - T S(P_g), and the samples that
// stand for them on short ways, against direct integration of the same stretch of air. Terrain is
// black and stands in a made-up position buffer: each column of the picture is a distance, each row
// a ray in the plane of the star, where the table has no error of its own.
#include "scatter/bands.h"
#include "scene/scene.h"
#include "sky/sky.h"
#include <terrella/context.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COLUMNS = 8, ROWS = 48, PIXELS = COLUMNS * ROWS };

static const double DISTANCE_M[COLUMNS] = {30, 300, 1e3, 3e3, 1e4, 3e4, 8e4, 2e5};

// Samples of short ways are in four bands, whose matrix is made for the sky: 2.4 % of the colour of
// a plain's air. Long ways lose light in the likeliest bands of a colour: 1 %. The rest is the
// difference of two table values.
static const double MEDIAN_LIMIT = 0.03;
static const double MOST_LIMIT = 0.06;

struct fixture {
    trl_context *ctx;
    trl_scene *scene;
    struct gpu *gpu;
    struct sky sky;
    struct gpu_texture position, albedo, normal, lights, radiance, kinds;
    struct gpu_target target;
    struct optics optics;
    struct ray_rules rules;
    struct sunlight sun;
    struct band_fit exact;
    struct transport_scratch *scratch;
    struct ray ray;
    float texels[PIXELS * 4], expected[PIXELS * 3];
};

static void make_texture(struct fixture *f, enum gpu_format format, struct gpu_texture *out)
{
    const float zeros[PIXELS * 4] = {0};
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.format = format;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = COLUMNS;
    desc.height = ROWS;
    desc.data = format == GPU_FORMAT_DEPTH32F ? NULL : zeros;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, out), TRL_OK);
}

static int set_up(void **state)
{
    struct fixture *f = aligned_alloc(64, (sizeof *f + 63) / 64 * 64);
    memset(f, 0, sizeof *f);
    trl_context_desc context = trl_context_desc_default();
    context.log = trl_log_stderr;
    context.cache_dir = "";
    assert_int_equal(trl_context_create(&context, &f->ctx), TRL_OK);
    assert_int_equal(trl_scene_load(f->ctx, SINGLE_FRAME_SCENE, &f->scene), TRL_OK);
    assert_int_equal(gpu_create_headless(f->ctx, &f->gpu), TRL_OK);
    const struct sky_desc desc = {.gpu = f->gpu, .medium = &f->scene->medium, .wavelengths = LANES};
    assert_int_equal(sky_init(&desc, TRL_SKY_SINGLE, &f->sky), TRL_OK);
    make_texture(f, GPU_FORMAT_RGBA32F, &f->position);
    make_texture(f, GPU_FORMAT_RGBA8, &f->albedo);
    make_texture(f, GPU_FORMAT_RGBA16F, &f->normal);
    make_texture(f, GPU_FORMAT_RGBA8, &f->lights);
    make_texture(f, GPU_FORMAT_RGBA32F, &f->radiance);
    make_texture(f, GPU_FORMAT_DEPTH32F, &f->kinds);
    const struct gpu_target_desc target = {
        .color_count = 1, .colors[0].texture = &f->radiance, .depth.texture = &f->kinds};
    assert_int_equal(gpu_target_init(f->gpu, &target, &f->target), TRL_OK);
    optics_init_visible(OPTICS_PICTURES, &f->scene->medium, LANES, &f->optics);
    ray_rules_init(&f->rules);
    assert_int_equal(sunlight_reserve(f->ctx, &f->optics, &f->sun), TRL_OK);
    assert_int_equal(sunlight_fill(f->ctx, &f->rules, &f->sun), TRL_OK);
    assert_int_equal(transport_scratch_create(f->ctx, 1, 1, &f->scratch), TRL_OK);
    band_fit_init(&f->exact, &f->optics);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    transport_scratch_destroy(f->ctx, &f->scratch);
    sunlight_finish(f->ctx, &f->sun);
    gpu_target_finish(&f->target);
    struct gpu_texture *textures[] = {&f->position, &f->albedo,   &f->normal,
                                      &f->lights,   &f->radiance, &f->kinds};
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++) {
        gpu_texture_finish(textures[i]);
    }
    sky_finish(&f->sky);
    gpu_destroy(&f->gpu);
    trl_scene_destroy(&f->scene);
    trl_context_destroy(&f->ctx);
    free(f);
    return 0;
}

// Light scattered once between the eye and `distance_m`, as a colour.
static void integrate(struct fixture *f, const struct camera *camera, struct vec3 direction,
                      double distance_m, float *rgb)
{
    const struct vec3 up = vec3_normalize(camera->position_m);
    const double nu = vec3_dot(direction, camera->sun_direction);
    const struct ray_desc desc = {.radius_m = vec3_length(camera->position_m),
                                  .mu = vec3_dot(up, direction),
                                  .nodes_per_shell = 200,
                                  .end_m = distance_m};
    ray_init(&f->ray, &f->optics, &f->rules, &desc);
    const float sun_mu = (float)vec3_dot(up, camera->sun_direction);
    const float single_nu = (float)nu;
    const struct transport_family family = {1, &sun_mu, &single_nu};
    struct transport_channels channels;
    float phase[MEDIUM_MAX_CONSTITUENTS];
    for (int i = 0; i < f->optics.constituent_count; i++) {
        phase[i] = (float)phase_value(&f->optics.medium->constituents[i].phase, nu);
        channels.channel[i] = 0;
        channels.phase[i] = &phase[i];
    }
    lanes radiance = {0};
    lanes *const out[1] = {&radiance};
    transport_add_single(&f->sun, &f->ray, &family, &channels, out, f->scratch);
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < LANES; i++) {
            sum += f->exact.rgb_from_lanes[k][i] * (double)radiance[i];
        }
        rgb[k] = (float)sum;
    }
}

// A camera at the equator that looks along the plane of the star; its rows fan out over 60 degrees.
static struct camera make_camera(const struct fixture *f, double altitude_m, double pitch_deg,
                                 double sun_elevation_deg)
{
    const double pitch = pitch_deg * M_PI / 180;
    const double sun = sun_elevation_deg * M_PI / 180;
    return (struct camera){.position_m = {f->optics.ground_radius_m + altitude_m, 0, 0},
                           .right = {0, 0, -1},
                           .up = {cos(pitch), -sin(pitch), 0},
                           .forward = {sin(pitch), cos(pitch), 0},
                           .tan_half_fov_x = 1e-5,
                           .tan_half_fov_y = tan(M_PI / 6),
                           .sun_direction = {sin(sun), cos(sun), 0}};
}

// Terrain at the column's distance, where that is in the lowest 9 km.
static void place_terrain(struct fixture *f, const struct camera *camera)
{
    for (int p = 0; p < PIXELS; p++) {
        const double y = 2 * (p / COLUMNS + 0.5) / ROWS - 1;
        const struct vec3 direction = vec3_normalize(camera_ray(camera, 0, y));
        double distance_m = DISTANCE_M[p % COLUMNS];
        double begin_m;
        double end_m;
        bool hits_ground;
        const double r = vec3_length(camera->position_m);
        ray_clip(&f->optics, r, vec3_dot(vec3_normalize(camera->position_m), direction), &begin_m,
                 &end_m, &hits_ground);
        if (r > f->optics.top_radius_m) {
            distance_m = end_m - distance_m / 10; // from outside, near where it would hit
        }
        const struct vec3 at = vec3_add(camera->position_m, vec3_scale(direction, distance_m));
        const double altitude_m = vec3_length(at) - f->optics.ground_radius_m;
        const bool is_there =
            altitude_m > 0 && altitude_m < 9000 && distance_m > begin_m && distance_m < end_m;
        float *texel = &f->texels[4 * p];
        texel[0] = (float)(direction.x * distance_m);
        texel[1] = (float)(direction.y * distance_m);
        texel[2] = (float)(direction.z * distance_m);
        texel[3] = is_there ? (float)altitude_m : -1e9f;
        if (is_there) {
            integrate(f, camera, direction, distance_m, &f->expected[3 * p]);
        }
    }
    const struct gpu_region all = gpu_texture_region(&f->position, 0);
    assert_int_equal(gpu_texture_upload(&f->position, &all, f->texels), TRL_OK);
}

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

static void check(struct fixture *f, const struct camera *camera, const char *name)
{
    place_terrain(f, camera);
    float place[PIXELS * 4];
    memcpy(place, f->texels, sizeof place);
    const struct sky_view view = {.camera = camera,
                                  .highest_m = 9000,
                                  .surface = {.position = &f->position,
                                              .albedo = &f->albedo,
                                              .normal = &f->normal,
                                              .lights = &f->lights},
                                  .target = &f->target};
    assert_int_equal(sky_prepare(&f->sky, &view), TRL_OK);
    assert_int_equal(sky_draw(&f->sky, &view), TRL_OK);
    const struct gpu_region all = gpu_texture_region(&f->radiance, 0);
    assert_int_equal(gpu_texture_read(&f->radiance, &all, f->texels), TRL_OK);
    float errors[PIXELS];
    size_t count = 0;
    for (int p = 0; p < PIXELS; p++) {
        float largest = 0;
        float worst = 0;
        for (int k = 0; k < 3 && place[4 * p + 3] > -1e8f; k++) {
            largest = fmaxf(largest, f->expected[3 * p + k]);
            worst = fmaxf(worst, fabsf(f->texels[4 * p + k] - f->expected[3 * p + k]));
        }
        if (largest > 1e-2f) {
            errors[count++] = worst / largest;
        }
    }
    assert_true(count > 4); // of the distances, few lie in terrain as seen from far above
    qsort(errors, count, sizeof *errors, compare_floats);
    const double median = (double)errors[count / 2];
    const double most = (double)errors[count - 1 - count / 20];
    printf("%-24s %4zu pixels: median %.2f %%, 95 of 100 below %.2f %%, worst %.2f %%\n", name,
           count, 100 * median, 100 * most, 100 * (double)errors[count - 1]);
    assert_true(median < MEDIAN_LIMIT);
    assert_true(most < MOST_LIMIT);
}

static void air_before_terrain_by_day(void **state)
{
    struct fixture *f = *state;
    const struct {
        double altitude_m, pitch_deg;
        const char *name;
    } eyes[] = {{2, 5, "plain"},
                {3000, -5, "mountain"},
                {11000, -25, "aircraft"},
                {60000, -45, "balloon"},
                {400000, -50, "orbit"}};
    for (size_t i = 0; i < sizeof eyes / sizeof *eyes; i++) {
        const struct camera camera = make_camera(f, eyes[i].altitude_m, eyes[i].pitch_deg, 40);
        check(f, &camera, eyes[i].name);
    }
}

static void air_before_terrain_at_sunset(void **state)
{
    struct fixture *f = *state;
    const struct camera low = make_camera(f, 2000, -5, 3);
    check(f, &low, "mountain at sunset");
    const struct camera high = make_camera(f, 11000, -25, 3);
    check(f, &high, "aircraft at sunset");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(air_before_terrain_by_day),
        cmocka_unit_test(air_before_terrain_at_sunset),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
