// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Contexts come and go, capabilities can be hidden, timers time.
#include "fixture.h"
#include "gpu/timer.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void contexts_come_and_go_together(void **state)
{
    struct fixture *f = *state;
    for (int i = 0; i < 3; i++) {
        struct gpu *a = NULL, *b = NULL;
        assert_int_equal(gpu_create_headless(f->ctx, &a), TRL_OK);
        assert_int_equal(gpu_create_headless(f->ctx, &b), TRL_OK);
        gpu_destroy(&a);
        assert_null(a);
        gpu_destroy(&a); // of nothing
        assert_int_equal(gpu_make_current(b), TRL_OK);
        glFinish();
        assert_int_equal(gpu_check(b, "after the other one went"), TRL_OK);
        gpu_destroy(&b);
    }
    assert_int_equal(gpu_make_current(f->gpu), TRL_OK);
}

static void a_wrapped_context_outlives_its_wrapper(void **state)
{
    struct fixture *f = *state;
    glEnable(GL_TEXTURE_2D_ARRAY); // an error that is not ours
    struct gpu *wrapped = NULL;
    assert_int_equal(gpu_create_current(f->ctx, &wrapped), TRL_OK);
    assert_string_equal(wrapped->caps.renderer, f->gpu->caps.renderer);
    assert_int_equal(wrapped->caps.version, f->gpu->caps.version);
    const struct gpu_target window = gpu_target_window(wrapped, 320, 200);
    assert_int_equal(window.name, 0);
    gpu_destroy(&wrapped);
    const struct gpu_pass pass = {
        .target = &f->target, .clears_color = true, .color = {6, 0, 0, 0}};
    gpu_pass_begin(f->gpu, &pass);
    assert_true(fixture_read(&f->color, 0, 0).rgba[0] == 6);
}

static void objects_left_behind_are_told(void **state)
{
    struct fixture *f = *state;
    struct gpu *gpu = NULL;
    assert_int_equal(gpu_create_headless(f->ctx, &gpu), TRL_OK);
    struct gpu_texture texture;
    const struct gpu_texture_desc desc = gpu_texture_desc_default();
    assert_int_equal(gpu_texture_init(gpu, &desc, &texture), TRL_OK);
    f->warnings = 0;
    gpu_destroy(&gpu);
    assert_int_equal(f->warnings, 1);
    assert_int_equal(gpu_make_current(f->gpu), TRL_OK);
}

static void finished_objects_can_be_finished_again(void **state)
{
    struct fixture *f = *state;
    struct gpu_texture texture = {0};
    struct gpu_target target = {0};
    struct gpu_program program = {0};
    struct gpu_mesh mesh = {0};
    struct gpu_buffer buffer = {0};
    struct gpu_timer timer = {0};
    const size_t before = f->gpu->live_objects;
    const struct gpu_texture_desc desc = gpu_texture_desc_default();
    const struct gpu_target_desc target_desc = {.color_count = 1,
                                                .colors = {{.texture = &texture}}};
    const struct gpu_program_desc program_desc = {
        "lib/fullscreen.vert", "constant.frag", NULL, NULL, NULL, 0};
    const struct gpu_mesh_desc mesh_desc = {.vertex_count = 3};
    for (int i = 0; i < 20; i++) {
        assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
        assert_int_equal(gpu_target_init(f->gpu, &target_desc, &target), TRL_OK);
        assert_int_equal(gpu_program_init(f->gpu, &program_desc, &program), TRL_OK);
        assert_int_equal(gpu_mesh_init(f->gpu, &mesh_desc, &mesh), TRL_OK);
        assert_int_equal(gpu_buffer_init(f->gpu, NULL, 16, &buffer), TRL_OK);
        assert_int_equal(gpu_timer_init(f->gpu, &timer), TRL_OK);
        assert_int_equal(f->gpu->live_objects, before + 6);
        for (int twice = 0; twice < 2; twice++) {
            gpu_target_finish(&target);
            gpu_texture_finish(&texture);
            gpu_program_finish(&program);
            gpu_mesh_finish(&mesh);
            gpu_buffer_finish(&buffer);
            gpu_timer_finish(&timer);
        }
        assert_int_equal(f->gpu->live_objects, before);
    }
}

static void hidden_capabilities_are_missing(void **state)
{
    struct fixture *f = *state;
    const struct gpu_desc desc = {.hidden_caps = ~UINT32_C(0)};
    struct gpu *gpu = NULL;
    assert_int_equal(gpu_create_headless_with(f->ctx, &desc, &gpu), TRL_OK);
    assert_false(gpu->caps.has_clip_control || gpu->caps.has_timer_query ||
                 gpu->caps.has_tessellation || gpu->caps.has_float_linear || gpu->caps.has_debug ||
                 gpu->caps.has_norm16);
    assert_true(gpu->caps.max_anisotropy == 1);
    struct gpu_timer timer;
    assert_int_equal(gpu_timer_init(gpu, &timer), TRL_OK);
    gpu_timer_begin(&timer, "nothing");
    gpu_timer_end(&timer);
    struct gpu_timer_row row;
    assert_int_equal(gpu_timer_collect(&timer, &row, 1), 0);
    gpu_timer_finish(&timer);
    gpu_destroy(&gpu);
    assert_int_equal(gpu_make_current(f->gpu), TRL_OK);
}

static void limits_are_those_of_the_standard_or_more(void **state)
{
    const struct fixture *f = *state;
    const struct gpu_caps *caps = &f->gpu->caps;
    assert_true(caps->version >= (caps->is_es ? 30 : 33));
    // OpenGL 3.3, table 6.39: 1024, 256, 256; ES 3.0, table 6.28: 2048, 256, 256.
    assert_true(caps->max_texture_size >= 1024);
    assert_true(caps->max_3d_size >= 256);
    assert_true(caps->max_array_layers >= 256);
    assert_true(strlen(caps->vendor) > 0 && strlen(caps->renderer) > 0);
    assert_int_equal(caps->is_software, strstr(caps->renderer, "llvmpipe") != NULL);
}

static void timers_give_a_row_for_each_scope(void **state)
{
    struct fixture *f = *state;
    struct gpu_timer timer;
    assert_int_equal(gpu_timer_init(f->gpu, &timer), TRL_OK);
    for (int round = 0; round < 2; round++) {
        gpu_timer_begin(&timer, "first");
        gpu_pass_begin(f->gpu, &(struct gpu_pass){.target = &f->target, .clears_color = true});
        gpu_timer_begin(&timer, "second"); // ends the first
        gpu_pass_begin(f->gpu, &(struct gpu_pass){.target = &f->target, .clears_color = true});
        gpu_timer_end(&timer);
        gpu_timer_end(&timer);
        struct gpu_timer_row rows[4];
        const size_t count = gpu_timer_collect(&timer, rows, 4);
        if (!f->gpu->caps.has_timer_query) {
            assert_int_equal(count, 0);
            continue;
        }
        assert_int_equal(count, 2);
        assert_string_equal(rows[0].name, "first");
        assert_string_equal(rows[1].name, "second");
        // A clear of 16 texels takes some time, and no minute, on any machine.
        assert_true(rows[0].ms >= 0 && rows[0].ms < 60e3 && rows[1].ms >= 0 && rows[1].ms < 60e3);
    }
    for (int i = 0; i < GPU_TIMER_MAX_SCOPES + 2; i++) {
        gpu_timer_begin(&timer, "many");
    }
    struct gpu_timer_row rows[GPU_TIMER_MAX_SCOPES + 2];
    assert_int_equal(gpu_timer_collect(&timer, rows, GPU_TIMER_MAX_SCOPES + 2),
                     f->gpu->caps.has_timer_query ? GPU_TIMER_MAX_SCOPES : 0);
    gpu_timer_begin(NULL, "none");
    gpu_timer_end(NULL);
    assert_int_equal(gpu_timer_collect(NULL, rows, 1), 0);
    gpu_timer_finish(&timer);
}

static void gl_errors_are_reported_once(void **state)
{
    struct fixture *f = *state;
    glEnable(GL_TEXTURE_2D_ARRAY); // no capability of that name
    fixture_expect_error(f, gpu_check(f->gpu, "test"), TRL_ERROR_GPU, TRL_LOG_ITEM_GPU_OBJECT);
    assert_non_null(strstr(f->last_error, "test: GL says invalid enum"));
    assert_int_equal(gpu_check(f->gpu, "test"), TRL_OK);
}

// An allocator that gives out a number of blocks and then no more.
struct budget {
    int blocks_left;
    int blocks_out;
};

static void *budget_allocate(void *user, size_t bytes)
{
    struct budget *budget = user;
    if (budget->blocks_left == 0) {
        return NULL;
    }
    budget->blocks_left--;
    budget->blocks_out++;
    return malloc(bytes);
}

static void *budget_reallocate(void *user, void *block, size_t bytes)
{
    (void)user;
    return realloc(block, bytes);
}

static void budget_release(void *user, void *block)
{
    struct budget *budget = user;
    budget->blocks_out -= block != NULL;
    free(block);
}

static trl_result make_everything(trl_context *ctx)
{
    const struct gpu_program_desc program_desc = {.vertex = "lib/fullscreen.vert",
                                                  .fragment = "uniforms.frag",
                                                  .defines = (const char *const[]){"SCALE 2"},
                                                  .define_count = 1};
    const struct gpu_texture_desc texture_desc = gpu_texture_desc_default();
    struct gpu *gpu = NULL;
    struct gpu_texture texture = {0};
    struct gpu_program program = {0};
    uint8_t texel[4];
    trl_result result = gpu_create_headless(ctx, &gpu);
    if (result == TRL_OK) {
        result = gpu_texture_init(gpu, &texture_desc, &texture);
    }
    if (result == TRL_OK) {
        const struct gpu_region all = gpu_texture_region(&texture, 0);
        result = gpu_texture_read(&texture, &all, texel);
    }
    if (result == TRL_OK) {
        result = gpu_program_init(gpu, &program_desc, &program);
    }
    gpu_program_finish(&program);
    gpu_texture_finish(&texture);
    assert_true(!gpu || gpu->live_objects == 0);
    gpu_destroy(&gpu);
    return result;
}

static void every_failed_allocation_is_survived(void **state)
{
    struct fixture *f = *state;
    trl_result result = TRL_ERROR_MEMORY;
    for (int n = 0; result != TRL_OK; n++) {
        assert_true(n < 200); // far more than there are
        struct budget budget = {.blocks_left = INT32_MAX};
        trl_context_desc desc = trl_context_desc_default();
        desc.allocator =
            (trl_allocator){budget_allocate, budget_reallocate, budget_release, &budget};
        trl_context *ctx = NULL;
        assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
        budget.blocks_left = n;
        result = make_everything(ctx);
        assert_true(result == TRL_OK || result == TRL_ERROR_MEMORY);
        trl_context_destroy(&ctx);
        assert_int_equal(budget.blocks_out, 0);
    }
    assert_int_equal(gpu_make_current(f->gpu), TRL_OK);
}

static double read_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

// Also when nothing was drawn before it, and when it holds no work at all.
static void the_first_scope_of_a_context_lasts_no_longer_than_it_did(void **state)
{
    struct fixture *f = *state;
    const struct gpu_desc desc = gpu_desc_default();
    struct gpu *gpu = NULL;
    assert_int_equal(gpu_create_headless_with(f->ctx, &desc, &gpu), TRL_OK);
    const double begun_ms = read_ms();
    struct gpu_timer timer;
    assert_int_equal(gpu_timer_init(gpu, &timer), TRL_OK);
    gpu_timer_begin(&timer, "nothing");
    gpu_timer_begin(&timer, "clear");
    const struct gpu_texture_desc texture_desc = gpu_texture_desc_default();
    struct gpu_texture texture;
    assert_int_equal(gpu_texture_init(gpu, &texture_desc, &texture), TRL_OK);
    const struct gpu_target_desc target_desc = {.color_count = 1, .colors[0].texture = &texture};
    struct gpu_target target;
    assert_int_equal(gpu_target_init(gpu, &target_desc, &target), TRL_OK);
    gpu_pass_begin(gpu, &(struct gpu_pass){.target = &target, .clears_color = true});
    struct gpu_timer_row rows[2];
    const size_t count = gpu_timer_collect(&timer, rows, 2);
    const double spent_ms = read_ms() - begun_ms;
    assert_int_equal(count, gpu->caps.has_timer_query ? 2 : 0);
    for (size_t i = 0; i < count; i++) {
        assert_true(rows[i].ms >= 0 && rows[i].ms <= spent_ms);
    }
    gpu_timer_finish(&timer);
    gpu_target_finish(&target);
    gpu_texture_finish(&texture);
    gpu_destroy(&gpu);
    assert_int_equal(gpu_make_current(f->gpu), TRL_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contexts_come_and_go_together),
        cmocka_unit_test(a_wrapped_context_outlives_its_wrapper),
        cmocka_unit_test(objects_left_behind_are_told),
        cmocka_unit_test(finished_objects_can_be_finished_again),
        cmocka_unit_test(hidden_capabilities_are_missing),
        cmocka_unit_test(limits_are_those_of_the_standard_or_more),
        cmocka_unit_test(timers_give_a_row_for_each_scope),
        cmocka_unit_test(the_first_scope_of_a_context_lasts_no_longer_than_it_did),
        cmocka_unit_test(gl_errors_are_reported_once),
        cmocka_unit_test(every_failed_allocation_is_survived),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
