// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The field of clouds on the GPU is that of the CPU.
#include "../frame/fixture.h"

#include "cloud/march.h"
#include "map.h"

#include <math.h>
#include <unistd.h>

static const double RADIUS_M = 6371000;
static const double EAST_DEG = -60; // of the cameras is what lies east of that

struct drawn {
    struct gpu_texture texture;
    struct gpu_target target;
    struct gpu_program program;
};

static struct drawn make_drawn(struct fixture *f)
{
    struct drawn d;
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = desc.height = 1;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &d.texture), TRL_OK);
    const struct gpu_target_desc target = {
        .label = "point", .color_count = 1, .colors[0].texture = &d.texture};
    assert_int_equal(gpu_target_init(f->gpu, &target, &d.target), TRL_OK);
    const struct gpu_program_desc program = {.vertex = "lib/fullscreen.vert",
                                             .fragment = "field_test.frag"};
    assert_int_equal(gpu_program_init(f->gpu, &program, &d.program), TRL_OK);
    return d;
}

static void finish_drawn(struct drawn *d)
{
    gpu_program_finish(&d->program);
    gpu_target_finish(&d->target);
    gpu_texture_finish(&d->texture);
}

// What sky/ray.glsl has of the eye and the planet.
static void set_eye(struct gpu_program *program, struct vec3 position_m)
{
    const double r = vec3_length(position_m);
    const struct vec3 up = vec3_normalize(position_m);
    const float eye_up[3] = {(float)up.x, (float)up.y, (float)up.z};
    const float eye[4] = {(float)r, (float)(r - RADIUS_M), 0, 0};
    const float planet[4] = {(float)RADIUS_M, 1e5f, 1e6f, 0};
    gpu_program_set_vec3(program, "u_eye_up", eye_up);
    gpu_program_set_vec4(program, "u_eye", eye);
    gpu_program_set_vec4(program, "u_planet", planet);
}

// At a place that is `i` steps out on a spiral around the eye: relative to it, m.
static void find_place(const struct cloud_layer *layer, const struct camera *camera, int i,
                       float out[3])
{
    const double angle = 2.4 * i;
    const double reach_m = 15.0 * i;
    const struct vec3 up = vec3_normalize(camera->position_m);
    const struct vec3 east = vec3_normalize((struct vec3){-up.y, up.x, 0});
    const double thick_m = layer->top_m - layer->base_m;
    const struct vec3 offset =
        vec3_add(vec3_scale(up, 0.4 * thick_m * sin(1.7 * i)),
                 vec3_add(vec3_scale(east, reach_m * cos(angle)),
                          vec3_scale(vec3_cross(up, east), reach_m * sin(angle))));
    out[0] = (float)offset.x;
    out[1] = (float)offset.y;
    out[2] = (float)offset.z;
}

static struct camera make_camera(const struct cloud_layer *layer)
{
    const double middle_m = 0.6 * layer->base_m + 0.4 * layer->top_m;
    const struct vec3 up = vec3_normalize((struct vec3){0.5, -0.4, 0.7});
    return (struct camera){.position_m = vec3_scale(up, RADIUS_M + middle_m), .sun_direction = up};
}

// What field_test.frag has to say.
static void draw_point(struct fixture *f, struct cloud_march *march, struct drawn *d,
                       const struct camera *camera, const float place[4], float out[4])
{
    const float sun[3] = {(float)camera->sun_direction.x, (float)camera->sun_direction.y,
                          (float)camera->sun_direction.z};
    set_eye(&d->program, camera->position_m);
    cloud_march_set_field(march, camera, &d->program);
    gpu_program_set_vec4(&d->program, "u_place", place);
    gpu_program_set_vec3(&d->program, "u_sun", sun);
    const struct gpu_pass pass = {.target = &d->target};
    gpu_pass_begin(f->gpu, &pass);
    assert_int_equal(gpu_draw_fullscreen(&d->program, "point"), TRL_OK);
    const struct gpu_region region = gpu_texture_region(&d->texture, 0);
    assert_int_equal(gpu_texture_read(&d->texture, &region, out), TRL_OK);
}

// Returns whether it is in cloud.
static bool compare_place(struct fixture *f, struct cloud_march *march, struct drawn *d,
                          size_t layer_index, int i)
{
    const struct cloud_layer *layer = &march->field->desc.layers[layer_index];
    const struct camera camera = make_camera(layer);
    float place[4], got[4];
    find_place(layer, &camera, i, place);
    place[3] = (float)(0.0235 * i - 2.4);
    gpu_program_set_int(&d->program, "u_layer", (int32_t)layer_index);
    draw_point(f, march, d, &camera, place, got);
    const struct vec3 exact = {(double)place[0], (double)place[1], (double)place[2]};
    const struct vec3 position = vec3_add(camera.position_m, exact);
    const double wanted =
        cloud_field_extinction(march->field, layer_index, position, (double)place[3]);
    // Weights of filters may have 8 bits: 1/256 of the noise's steps between texels (0.1),
    // over an edge of 0.12; and half a metre of height in floats.
    if (fabs((double)got[0] - wanted) > 0.01 * layer->extinction_per_m + 0.01 * wanted) {
        fail_msg("type %d at %g m, level %.2f: %.7f on the GPU, %.7f on the CPU", layer->type,
                 vec3_length(exact), (double)place[3], (double)got[0], wanted);
    }
    return wanted > 0.0025 * layer->extinction_per_m;
}

static void the_gpu_s_field_is_the_cpu_s(void **state)
{
    struct fixture *f = *state;
    static const struct cloud_layer LAYERS[] = {
        {CLOUD_CUMULUS, 900, 2600, 0.5, 0.04, 8000, 20, 0, 0.9, CLOUD_EVERYWHERE},
        {CLOUD_CIRRUS, 8500, 9500, 0.5, 1e-3, 40000, 20, 6000, 0.9, CLOUD_EVERYWHERE},
        {CLOUD_FOG, 0, 400, 0.7, 0.02, 5000, 0, 0, 0.2, {0.1, 0.7, 0.3}}};
    for (size_t n = 0; n < sizeof LAYERS / sizeof *LAYERS; n++) {
        // The place is in the bands of the cyclone.
        const struct cloud_desc desc = {.layer_count = 1,
                                        .seed = 5,
                                        .systems_m = n == 2 ? 5e5 : 0,
                                        .layers = {LAYERS[n]},
                                        .cyclone_count = n == 0 ? 0 : 1,
                                        .cyclones = {{0.8, -0.7, 5e5, 2e4}}};
        struct cloud_field field;
        struct cloud_march march;
        assert_int_equal(cloud_field_init(f->ctx, &desc, RADIUS_M, &field), TRL_OK);
        cloud_field_set_time(&field, 1e5);
        assert_int_equal(cloud_march_init(f->gpu, &field, &march), TRL_OK);
        struct drawn d = make_drawn(f);
        int clouds = 0;
        for (int i = 0; i < 400; i += n == 0 ? 1 : 2) {
            clouds += compare_place(f, &march, &d, 0, i);
        }
        assert_true(clouds > 10); // or nothing has been compared
        finish_drawn(&d);
        cloud_march_finish(&march);
        cloud_field_finish(&field);
    }
}

// A map with a band for each layer: clouds of the first in the west, of the second in the east,
// where the eye is (39 degrees west).
static void write_bands(const char *path)
{
    enum { WIDE = 64, HIGH = 32, BANDS = 2 };
    static uint8_t rows[BANDS][WIDE * HIGH];
    for (int i = 0; i < WIDE * HIGH; i++) {
        const double longitude = (i % WIDE + 0.5) * 360 / WIDE - 180;
        rows[0][i] = longitude < EAST_DEG ? 255 : 0;
        rows[1][i] = 255 - rows[0][i];
    }
    write_map(path, &(struct map_desc){WIDE, HIGH, BANDS, rows[0], false});
}

static void bands_of_a_map_are_of_the_layers(void **state)
{
    struct fixture *f = *state;
    char path[] = "/tmp/terrella-bands-XXXXXX";
    assert_true(close(mkstemp(path)) == 0);
    write_bands(path);
    const struct cloud_layer cumulus = {CLOUD_CUMULUS, 900, 2600, 0.6, 0.04,
                                        8000,          0,   0,    0.9, CLOUD_EVERYWHERE};
    const struct cloud_desc desc = {
        .layer_count = 2, .seed = 5, .map_path = path, .layers = {cumulus, cumulus}};
    struct cloud_field field;
    struct cloud_march march;
    assert_int_equal(cloud_field_init(f->ctx, &desc, RADIUS_M, &field), TRL_OK);
    assert_int_equal(field.map_count, 2);
    for (int layer = 0; layer < 2; layer++) {
        for (int side = -1; side <= 1; side += 2) {
            const struct vec3 there = vec3_from_lat_lon(0.3, EAST_DEG * 0.0174532925 + 0.5 * side);
            const double cover = cloud_field_cover(&field, (size_t)layer, vec3_scale(there, 6.4e6));
            assert_true((cover > 0.1) == ((side < 0) == (layer == 0)));
        }
    }
    assert_int_equal(cloud_march_init(f->gpu, &field, &march), TRL_OK);
    struct drawn d = make_drawn(f);
    int clouds[2] = {0, 0};
    for (int i = 0; i < 200; i++) {
        clouds[i % 2] += compare_place(f, &march, &d, (size_t)i % 2, i);
    }
    print_message("%d and %d places in clouds\n", clouds[0], clouds[1]);
    assert_true(clouds[0] == 0 && clouds[1] > 10);
    finish_drawn(&d);
    cloud_march_finish(&march);
    cloud_field_finish(&field);
    unlink(path);
}

// Of places in cloud, what comes through to them from the star, in the mean: wide pixels find twice
// as much, since they have the mean of depths; with the mean of clouds and gaps it was 2.6 times.
static void clouds_are_as_deep_from_afar(void **state)
{
    struct fixture *f = *state;
    const struct cloud_desc desc = {
        .layer_count = 1,
        .seed = 5,
        .layers = {{CLOUD_CUMULUS, 900, 2600, 0.5, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE}}};
    struct cloud_field field;
    struct cloud_march march;
    assert_int_equal(cloud_field_init(f->ctx, &desc, RADIUS_M, &field), TRL_OK);
    assert_int_equal(cloud_march_init(f->gpu, &field, &march), TRL_OK);
    struct drawn d = make_drawn(f);
    const struct camera camera = make_camera(&desc.layers[0]);
    static const float WIDTHS_M[2] = {1, 200};
    double through[2] = {0, 0};
    for (int i = 0; i < 400; i++) {
        float place[4] = {0, 0, 0, -2.4f}, got[4];
        find_place(&desc.layers[0], &camera, i, place);
        for (int k = 0; k < 2; k++) {
            // Levels are rounded as over four pixels of the march.
            const float width[2] = {WIDTHS_M[k], 0.125f + 0.25f * (float)(i % 4)};
            gpu_program_set_vec2(&d.program, "u_width", width);
            draw_point(f, &march, &d, &camera, place, got);
            through[k] += got[0] > 0.01f ? exp(-0.4 * (double)got[2]) : 0;
        }
    }
    print_message("%.3f comes through from near, %.3f from afar\n", through[0], through[1]);
    if (!(through[0] > 1 && through[1] < 2.3 * through[0] && through[1] > through[0])) {
        fail_msg("%.3f comes through from near, %.3f from afar", through[0], through[1]);
    }
    finish_drawn(&d);
    cloud_march_finish(&march);
    cloud_field_finish(&field);
}

// Optical depth toward a star on a part of the way, m.
static double find_depth(const struct cloud_field *field, struct vec3 place, struct vec3 sun,
                         const double way_m[2])
{
    static const double STEP_M = 20;
    double sum = 0;
    for (double at_m = way_m[0] + 0.5 * STEP_M; at_m < way_m[1]; at_m += STEP_M) {
        sum += STEP_M * cloud_field_extinction(field, 0, vec3_add(place, vec3_scale(sun, at_m)), 0);
    }
    return sum;
}

// From places at a star of 4 degrees: what is beyond the growing distances (0.3125 tiles), as far
// as 0.6875. Six looks find of each way whether it is closed: they miss 0.07 of the light in the
// mean, where one mean for all would miss 0.40.
static void under_low_stars_farther_clouds_are_found(void **state)
{
    struct fixture *f = *state;
    const struct cloud_desc desc = {
        .layer_count = 1,
        .seed = 5,
        .layers = {{CLOUD_CUMULUS, 900, 2600, 0.5, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE}}};
    static const double WAY_M[2] = {0.3125 * 8000, 0.6875 * 8000};
    enum { PLACES = 400 };
    struct cloud_field field;
    struct cloud_march march;
    assert_int_equal(cloud_field_init(f->ctx, &desc, RADIUS_M, &field), TRL_OK);
    assert_int_equal(cloud_march_init(f->gpu, &field, &march), TRL_OK);
    struct drawn d = make_drawn(f);
    struct camera camera = make_camera(&desc.layers[0]);
    const struct vec3 up = camera.sun_direction;
    const struct vec3 east = vec3_normalize((struct vec3){-up.y, up.x, 0});
    camera.sun_direction = vec3_add(vec3_scale(up, sin(0.07)), vec3_scale(east, cos(0.07)));
    double through[PLACES], mean = 0, missed = 0, spread = 0;
    for (int i = 0; i < PLACES; i++) {
        const float width[2] = {1, 0.125f + 0.25f * (float)(i % 4)};
        float place[4] = {0, 0, 0, -2.4f}, got[4];
        find_place(&desc.layers[0], &camera, 5 * i, place);
        gpu_program_set_vec2(&d.program, "u_width", width);
        draw_point(f, &march, &d, &camera, place, got);
        const struct vec3 exact = {(double)place[0], (double)place[1], (double)place[2]};
        through[i] = exp(
            -find_depth(&field, vec3_add(camera.position_m, exact), camera.sun_direction, WAY_M));
        mean += through[i] / PLACES;
        missed += fabs(exp(-(double)got[3]) - through[i]) / PLACES;
    }
    for (int i = 0; i < PLACES; i++) {
        spread += fabs(through[i] - mean) / PLACES;
    }
    print_message("%.3f comes through, %.3f is missed, by their mean %.3f\n", mean, missed, spread);
    assert_true(missed < 0.3 * spread);
    finish_drawn(&d);
    cloud_march_finish(&march);
    cloud_field_finish(&field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_gpu_s_field_is_the_cpu_s),
                                       cmocka_unit_test(bands_of_a_map_are_of_the_layers),
                                       cmocka_unit_test(clouds_are_as_deep_from_afar),
                                       cmocka_unit_test(under_low_stars_farther_clouds_are_found)};
    return cmocka_run_group_tests(tests, fixture_set_up_gpu, fixture_tear_down);
}
