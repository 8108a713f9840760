// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What a pass sets is what is drawn with, whatever was drawn before.
#include "fixture.h"

#include "gpu/condition.h"

#include <epoxy/gl.h>
#include <math.h>

struct instance {
    float depth, weight;
};

static struct gpu_program make_program(struct fixture *f, const char *vertex, const char *fragment)
{
    const struct gpu_program_desc desc = {.vertex = vertex, .fragment = fragment};
    struct gpu_program program;
    assert_int_equal(gpu_program_init(f->gpu, &desc, &program), TRL_OK);
    return program;
}

// A square over the whole view, counter-clockwise, drawn once for each instance.
static struct gpu_mesh make_square(struct fixture *f, const struct instance *instances,
                                   uint32_t count)
{
    static const float corners[8] = {-1, -1, 1, -1, 1, 1, -1, 1};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const struct gpu_mesh_desc desc = {
        .label = "square",
        .vertex_count = 4,
        .vertex_stride = 2 * sizeof(float),
        .vertices = corners,
        .index_count = 6,
        .indices = indices,
        .instance_stride = sizeof(struct instance),
        .attribute_count = 2,
        .attributes = {{.location = 0, .components = 2},
                       {.location = 1, .components = 2, .is_per_instance = true}}};
    struct gpu_mesh mesh;
    assert_int_equal(gpu_mesh_init(f->gpu, &desc, &mesh), TRL_OK);
    assert_int_equal(gpu_mesh_update_instances(&mesh, instances, count), TRL_OK);
    return mesh;
}

static float red_at(struct fixture *f, uint32_t x, uint32_t y)
{
    return fixture_read(&f->color, x, y).rgba[0];
}

// Draws the instances in a pass over cleared colour 0.25 and returns the red that remains.
static float draw(struct fixture *f, struct gpu_state state, const struct instance *instances,
                  uint32_t count)
{
    struct gpu_program program = make_program(f, "square.vert", "weight.frag");
    struct gpu_mesh mesh = make_square(f, instances, count);
    const struct gpu_pass pass = {.target = &f->target,
                                  .state = state,
                                  .clears_color = true,
                                  .color = {0.25f, 0, 0, 0},
                                  .clears_depth = true};
    gpu_pass_begin(f->gpu, &pass);
    assert_int_equal(gpu_draw_mesh(&program, &mesh, count, "draw"), TRL_OK);
    gpu_mesh_finish(&mesh);
    gpu_program_finish(&program);
    return red_at(f, 1, 1);
}

// 1e-7 and 2e-7 are apart in reversed depth near 0; with clip control absent, depths stand around
// 0.5 in steps of 6e-8, which still tells 1e-6 from 2e-6.
static void reversed_depth_keeps_the_nearer(void **state)
{
    struct fixture *f = *state;
    const float unit = f->gpu->caps.has_clip_control ? 1e-20f : 1e-6f;
    const struct instance near_first[] = {{2 * unit, 1}, {unit, 2}};
    const struct instance far_first[] = {{unit, 2}, {2 * unit, 1}};
    const struct gpu_state nearer = {.depth = GPU_DEPTH_NEARER, .writes_depth = true};
    assert_true(draw(f, nearer, near_first, 2) == 1);
    assert_true(draw(f, nearer, far_first, 2) == 1);
    const struct gpu_state not_written = {.depth = GPU_DEPTH_NEARER};
    assert_true(draw(f, not_written, near_first, 2) == 2);
    const struct gpu_state farther = {.depth = GPU_DEPTH_FARTHER, .writes_depth = true};
    assert_true(draw(f, farther, near_first, 2) == 0.25f); // nothing lies before what was cleared
}

static void the_sky_is_drawn_where_nothing_is(void **state)
{
    struct fixture *f = *state;
    struct gpu_program sky = make_program(f, "lib/fullscreen.vert", "constant.frag");
    struct gpu_program ground = make_program(f, "square.vert", "weight.frag");
    const struct instance instance = {0.5f, 1};
    struct gpu_mesh mesh = make_square(f, &instance, 1);
    const float color[4] = {9, 9, 9, 9};
    gpu_program_set_vec4(&sky, "u_color", color);
    const struct gpu_pass left = {.target = &f->target,
                                  .state = {.depth = GPU_DEPTH_NEARER, .writes_depth = true},
                                  .viewport = {0, 0, 2, 4},
                                  .clears_color = true,
                                  .clears_depth = true};
    gpu_pass_begin(f->gpu, &left);
    assert_int_equal(gpu_draw_mesh(&ground, &mesh, 1, "ground"), TRL_OK);
    const struct gpu_pass all = {.target = &f->target, .state = {.depth = GPU_DEPTH_EQUAL}};
    gpu_pass_begin(f->gpu, &all);
    assert_int_equal(gpu_draw_fullscreen(&sky, "sky"), TRL_OK);
    assert_true(red_at(f, 1, 3) == 1);
    assert_true(red_at(f, 2, 3) == 9);
    if (!f->gpu->caps.is_es) {
        const struct gpu_region texel = {0, 0, 0, 0, 1, 1, 1};
        float depth = 0;
        assert_int_equal(gpu_texture_read(&f->depth, &texel, &depth), TRL_OK);
        assert_true(depth == (f->gpu->caps.has_clip_control ? 0.5f : 0.75f));
    }
    gpu_mesh_finish(&mesh);
    gpu_program_finish(&sky);
    gpu_program_finish(&ground);
}

static void blending_culling_and_masks_do_as_they_say(void **state)
{
    struct fixture *f = *state;
    const struct instance instances[] = {{0.5f, 2}, {0.5f, 4}}; // alpha is 0.5
    assert_true(draw(f, (struct gpu_state){0}, instances, 2) == 4);
    assert_true(draw(f, (struct gpu_state){.blend = GPU_BLEND_ADD}, instances, 2) == 6.25f);
    assert_true(draw(f, (struct gpu_state){.blend = GPU_BLEND_ALPHA}, instances, 2) == 2.5625f);
    assert_true(draw(f, (struct gpu_state){.blend = GPU_BLEND_PREMULTIPLIED}, instances, 2) ==
                5.0625f);
    assert_true(draw(f, (struct gpu_state){.cull = GPU_CULL_BACK}, instances, 2) == 4);
    assert_true(draw(f, (struct gpu_state){.cull = GPU_CULL_FRONT}, instances, 2) == 0.25f);
    assert_true(draw(f, (struct gpu_state){.hides_color = true}, instances, 2) == 0.25f);
}

static void nothing_is_left_over_from_elsewhere(void **state)
{
    struct fixture *f = *state;
    const struct instance instance = {0.5f, 2};
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 0, 0);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_NEVER, 0, 0);
    glEnable(GL_RASTERIZER_DISCARD);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glDepthRangef(1, 0);
    glFrontFace(GL_CW);
    glPixelStorei(GL_PACK_ALIGNMENT, 8);
    glPixelStorei(GL_PACK_ROW_LENGTH, 100);
    assert_true(draw(f, (struct gpu_state){.cull = GPU_CULL_BACK}, &instance, 1) == 2);
}

static void scissors_limit_clears_and_draws(void **state)
{
    struct fixture *f = *state;
    struct gpu_pass pass = {.target = &f->target, .clears_color = true, .color = {1, 0, 0, 0}};
    gpu_pass_begin(f->gpu, &pass);
    pass.color[0] = 2;
    pass.scissor = (struct gpu_rect){1, 1, 2, 1};
    gpu_pass_begin(f->gpu, &pass);
    assert_true(red_at(f, 1, 1) == 2 && red_at(f, 2, 1) == 2);
    assert_true(red_at(f, 0, 1) == 1 && red_at(f, 3, 1) == 1 && red_at(f, 1, 2) == 1);
}

static void several_colors_are_written_at_once(void **state)
{
    struct fixture *f = *state;
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.format = GPU_FORMAT_RGBA16F;
    desc.width = desc.height = 4;
    struct gpu_texture second;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &second), TRL_OK);
    const struct gpu_target_desc target_desc = {
        .color_count = 2, .colors = {{.texture = &f->color}, {.texture = &second}}};
    struct gpu_target target;
    assert_int_equal(gpu_target_init(f->gpu, &target_desc, &target), TRL_OK);
    struct gpu_program program = make_program(f, "lib/fullscreen.vert", "two_colors.frag");
    gpu_pass_begin(f->gpu, &(struct gpu_pass){.target = &target});
    assert_int_equal(gpu_draw_fullscreen(&program, "two"), TRL_OK);
    assert_true(fixture_read(&f->color, 0, 0).rgba[3] == 4);
    assert_true(fixture_read(&second, 3, 3).rgba[0] == 5);
    gpu_program_finish(&program);
    gpu_target_finish(&target);
    gpu_texture_finish(&second);
}

static void each_slice_of_a_volume_is_drawn_by_itself(void **state)
{
    struct fixture *f = *state;
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.shape = GPU_SHAPE_3D;
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.depth = 3;
    struct gpu_texture volume;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &volume), TRL_OK);
    const struct gpu_target_desc target_desc = {.color_count = 1, .colors = {{.texture = &volume}}};
    struct gpu_target target;
    assert_int_equal(gpu_target_init(f->gpu, &target_desc, &target), TRL_OK);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(gpu_target_set_layer(&target, 0, i), TRL_OK);
        gpu_pass_begin(f->gpu, &(struct gpu_pass){.target = &target,
                                                  .clears_color = true,
                                                  .color = {(float)i + 1, 0, 0, 1}});
    }
    float got[3][4];
    const struct gpu_region all = gpu_texture_region(&volume, 0);
    assert_int_equal(gpu_texture_read(&volume, &all, got), TRL_OK);
    assert_true(got[0][0] == 1 && got[1][0] == 2 && got[2][0] == 3);
    fixture_expect_error(f, gpu_target_set_layer(&target, 0, 3), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    gpu_target_finish(&target);
    gpu_texture_finish(&volume);
}

static void srgb_targets_take_linear_values(void **state)
{
    struct fixture *f = *state;
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.format = GPU_FORMAT_SRGB8_A8;
    struct gpu_texture texture;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
    const struct gpu_target_desc target_desc = {.color_count = 1,
                                                .colors = {{.texture = &texture}}};
    struct gpu_target target;
    assert_int_equal(gpu_target_init(f->gpu, &target_desc, &target), TRL_OK);
    struct gpu_program program = make_program(f, "lib/fullscreen.vert", "constant.frag");
    const float grey[4] = {0.2140411f, 0, 0, 1}; // IEC 61966-2-1: 0.5 encoded
    gpu_program_set_vec4(&program, "u_color", grey);
    gpu_pass_begin(f->gpu, &(struct gpu_pass){.target = &target});
    assert_int_equal(gpu_draw_fullscreen(&program, "grey"), TRL_OK);
    uint8_t rgba[4] = {0};
    assert_int_equal(gpu_target_read_rgba8(&target, (struct gpu_rect){0, 0, 1, 1}, rgba), TRL_OK);
    assert_in_range(rgba[0], 127, 128); // 127.5 may go either way
    fixture_expect_error(f, gpu_target_read_rgba8(&target, (struct gpu_rect){0, 0, 2, 1}, rgba),
                         TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT);
    gpu_program_finish(&program);
    gpu_target_finish(&target);
    gpu_texture_finish(&texture);
}

static void wrong_targets_and_meshes_are_refused(void **state)
{
    struct fixture *f = *state;
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    struct gpu_texture small;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &small), TRL_OK);
    struct gpu_target target;
    struct gpu_target_desc target_desc = {.color_count = 2,
                                          .colors = {{.texture = &f->color}, {.texture = &small}}};
    fixture_expect_error(f, gpu_target_init(f->gpu, &target_desc, &target), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    target_desc = (struct gpu_target_desc){0};
    fixture_expect_error(f, gpu_target_init(f->gpu, &target_desc, &target), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    target_desc.depth.texture = &small;
    fixture_expect_error(f, gpu_target_init(f->gpu, &target_desc, &target), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    const uint32_t index = 3;
    struct gpu_mesh mesh;
    struct gpu_mesh_desc mesh_desc = {.vertex_count = 3, .index_count = 1, .indices = &index};
    fixture_expect_error(f, gpu_mesh_init(f->gpu, &mesh_desc, &mesh), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    mesh_desc = (struct gpu_mesh_desc){.vertex_count = 3,
                                       .vertex_stride = 8,
                                       .attribute_count = 1,
                                       .attributes = {{.components = 3}}};
    fixture_expect_error(f, gpu_mesh_init(f->gpu, &mesh_desc, &mesh), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    gpu_texture_finish(&small);
}

static void patches_are_tessellated_or_refused(void **state)
{
    struct fixture *f = *state;
    const struct gpu_program_desc desc = {.vertex = "patch.vert",
                                          .tess_control = "patch.tesc",
                                          .tess_evaluate = "patch.tese",
                                          .fragment = "constant.frag"};
    struct gpu_program program;
    const trl_result result = gpu_program_init(f->gpu, &desc, &program);
    if (!f->gpu->caps.has_tessellation) {
        fixture_expect_error(f, result, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_SHADER);
        return;
    }
    assert_int_equal(result, TRL_OK);
    const struct gpu_mesh_desc mesh_desc = {
        .primitive = GPU_PRIMITIVE_PATCHES, .patch_vertices = 3, .vertex_count = 3};
    struct gpu_mesh mesh;
    assert_int_equal(gpu_mesh_init(f->gpu, &mesh_desc, &mesh), TRL_OK);
    const float color[4] = {3, 0, 0, 1};
    gpu_program_set_vec4(&program, "u_color", color);
    gpu_pass_begin(f->gpu, &(struct gpu_pass){.target = &f->target, .clears_color = true});
    assert_int_equal(gpu_draw_mesh(&program, &mesh, 1, "patches"), TRL_OK);
    assert_true(red_at(f, 2, 2) == 3);
    fixture_expect_error(
        f, gpu_draw_mesh_range(&program, &mesh, (struct gpu_draw_range){1, 3, 1}, "range"),
        TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT);
    gpu_mesh_finish(&mesh);
    gpu_program_finish(&program);
}

// Red after a pass, its clear included, that waits on whether a square at that depth was seen.
static float draw_after(struct fixture *f, struct gpu_condition *condition, float depth)
{
    const struct instance instance = {depth, 1};
    struct gpu_program program = make_program(f, "square.vert", "weight.frag");
    struct gpu_mesh mesh = make_square(f, &instance, 1);
    const struct gpu_pass counted = {.target = &f->target,
                                     .state = {.depth = GPU_DEPTH_NEARER},
                                     .clears_color = true,
                                     .clears_depth = true,
                                     .depth = 0.5f};
    const struct gpu_pass second = {
        .target = &f->target, .clears_color = true, .color = {0.25f, 0, 0, 0}};
    gpu_condition_count(condition);
    gpu_pass_begin(f->gpu, &counted);
    assert_int_equal(gpu_draw_mesh(&program, &mesh, 1, "counted"), TRL_OK);
    gpu_condition_counted(condition);
    gpu_condition_begin(condition);
    gpu_pass_begin(f->gpu, &second);
    gpu_condition_end(condition);
    gpu_mesh_finish(&mesh);
    gpu_program_finish(&program);
    return red_at(f, 1, 1);
}

static void draws_are_left_out_when_no_pixel_was_seen(void **state)
{
    struct fixture *f = *state;
    struct gpu_condition condition;
    assert_int_equal(gpu_condition_init(f->gpu, &condition), TRL_OK);
    gpu_condition_begin(&condition); // has counted nothing yet: all is drawn
    gpu_condition_end(&condition);
    gpu_condition_begin(NULL);
    gpu_condition_end(NULL);
    for (int twice = 0; twice < 2; twice++) {
        assert_true(draw_after(f, &condition, 0.75f) == 0.25f);
        // What was cleared before; OpenGL ES draws always.
        assert_true(draw_after(f, &condition, 0.25f) == (f->gpu->caps.is_es ? 0.25f : 0));
    }
    gpu_condition_finish(&condition);
    gpu_condition_finish(&condition);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reversed_depth_keeps_the_nearer),
        cmocka_unit_test(the_sky_is_drawn_where_nothing_is),
        cmocka_unit_test(blending_culling_and_masks_do_as_they_say),
        cmocka_unit_test(nothing_is_left_over_from_elsewhere),
        cmocka_unit_test(scissors_limit_clears_and_draws),
        cmocka_unit_test(several_colors_are_written_at_once),
        cmocka_unit_test(each_slice_of_a_volume_is_drawn_by_itself),
        cmocka_unit_test(srgb_targets_take_linear_values),
        cmocka_unit_test(wrong_targets_and_meshes_are_refused),
        cmocka_unit_test(patches_are_tessellated_or_refused),
        cmocka_unit_test(draws_are_left_out_when_no_pixel_was_seen),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
