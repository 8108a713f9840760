// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The field of clouds on the GPU is that of the CPU.
#include "../frame/fixture.h"

#include "cloud/march.h"

#include <math.h>

static const double RADIUS_M = 6371000;

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

static void the_gpu_s_field_is_the_cpu_s(void **state)
{
    struct fixture *f = *state;
    const struct cloud_desc desc = {
        .layer_count = 1, .seed = 5, .layers = {{CLOUD_CUMULUS, 900, 2600, 0.5, 0.04, 8000, 20}}};
    struct cloud_field field;
    struct cloud_march march;
    assert_int_equal(cloud_field_init(f->ctx, &desc, RADIUS_M, &field), TRL_OK);
    cloud_field_set_time(&field, 1e5);
    assert_int_equal(cloud_march_init(f->gpu, &field, &march), TRL_OK);
    struct drawn d = make_drawn(f);
    const struct camera camera = {
        .position_m = vec3_scale(vec3_normalize((struct vec3){0.5, -0.4, 0.7}), RADIUS_M + 1234)};
    int clouds = 0;
    for (int i = 0; i < 400; i++) {
        const double angle = 2.4 * i;
        const double reach_m = 15.0 * i;
        const double level = 0.0235 * i - 2.4;
        const struct vec3 offset = {reach_m * cos(angle), reach_m * sin(angle), 2.0 * i - 200};
        const float place[4] = {(float)offset.x, (float)offset.y, (float)offset.z, (float)level};
        const struct vec3 exact = {(double)place[0], (double)place[1], (double)place[2]};
        set_eye(&d.program, camera.position_m);
        cloud_march_set_field(&march, &camera, &d.program);
        gpu_program_set_vec4(&d.program, "u_place", place);
        const struct gpu_pass pass = {.target = &d.target};
        gpu_pass_begin(f->gpu, &pass);
        assert_int_equal(gpu_draw_fullscreen(&d.program, "point"), TRL_OK);
        float got[4];
        const struct gpu_region region = gpu_texture_region(&d.texture, 0);
        assert_int_equal(gpu_texture_read(&d.texture, &region, got), TRL_OK);
        const struct vec3 position = vec3_add(camera.position_m, exact);
        const double wanted = cloud_field_extinction(&field, 0, position, (double)place[3]);
        clouds += wanted > 1e-4;
        // Weights of filters may have 8 bits: 1/256 of the noise's steps between texels (0.1),
        // over an edge of 0.12, of a coefficient of 0.04; and half a metre of height in floats.
        if (fabs((double)got[0] - wanted) > 4e-4 + 0.01 * wanted) {
            fail_msg("at %g m, level %.2f: %.6f on the GPU, %.6f on the CPU", reach_m, level,
                     (double)got[0], wanted);
        }
    }
    assert_true(clouds > 20); // of 400 places
    finish_drawn(&d);
    cloud_march_finish(&march);
    cloud_field_finish(&field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_gpu_s_field_is_the_cpu_s)};
    return cmocka_run_group_tests(tests, fixture_set_up_gpu, fixture_tear_down);
}
