// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/mesh_check.h"
#include "api/check.h"
#include "api/ground.h"
#include "api/renderer.h"

enum { CHECK_CANARY = 0x54524731, MAX_STEP = 64 };

struct trl_mesh_check {
    struct mesh_check check;
};

trl_mesh_check_desc trl_mesh_check_desc_default(void)
{
    return (trl_mesh_check_desc){
        .canary = CHECK_CANARY, .width = 1024, .height = 576, .step = 4, .has_edges = true};
}

static trl_result check_desc(const trl_ground *ground, const trl_renderer *renderer,
                             const trl_mesh_check_desc *desc)
{
    const trl_context *ctx = ground->ctx;
    TRL_REQUIRE(ctx, renderer != NULL);
    TRL_REQUIRE(ctx, desc != NULL);
    TRL_REQUIRE(ctx, desc->canary == CHECK_CANARY);
    TRL_REQUIRE(ctx, desc->view != NULL);
    TRL_REQUIRE(ctx, desc->step >= 1 && desc->step <= MAX_STEP);
    trl_result result = check_size(ctx, desc->width, desc->height);
    if (result == TRL_OK) {
        result = check_view(ctx, desc->view, ground->scene);
    }
    if (result == TRL_OK && renderer->frame.ground.is_bare) {
        result = trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                          "a scene without surface layers has no mesh to check");
    }
    return result;
}

static trl_result make_check(trl_ground *ground, trl_renderer *renderer,
                             const trl_mesh_check_desc *desc, struct mesh_check *out)
{
    struct camera camera;
    trl_result result =
        ground_camera(ground, desc->view, (double)desc->width / desc->height, &camera);
    if (result == TRL_OK) {
        result = gpu_make_current(renderer->frame.gpu);
    }
    if (result != TRL_OK) {
        return result;
    }
    struct ground *drawn = &renderer->frame.ground;
    const struct mesh_check_desc check = {.ctx = ground->ctx,
                                          .gpu = renderer->frame.gpu,
                                          .mesher = drawn->meshers[drawn->mesher],
                                          .truth = ground_caster(ground, &camera, desc->height),
                                          .width = desc->width,
                                          .height = desc->height,
                                          .step = desc->step};
    if (desc->has_edges) {
        uint32_t size[2];
        mesh_check_size(&check, size);
        result = ground_cast(ground, &check.truth, size);
        if (result == TRL_OK) {
            result = mesh_truth_find_edges(&ground->truth, &check.truth);
        }
    }
    return result == TRL_OK ? mesh_check_init(&check, desc->has_edges ? &ground->truth : NULL, out)
                            : result;
}

trl_result trl_mesh_check_create(trl_ground *ground, trl_renderer *renderer,
                                 const trl_mesh_check_desc *desc, trl_mesh_check **out)
{
    if (!ground) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ground->ctx, out != NULL);
    *out = NULL;
    trl_result result = check_desc(ground, renderer, desc);
    if (result != TRL_OK) {
        return result;
    }
    trl_mesh_check *check = mem_alloc(ground->ctx, 1, sizeof *check);
    if (!check) {
        return TRL_ERROR_MEMORY;
    }
    result = make_check(ground, renderer, desc, &check->check);
    if (result != TRL_OK) {
        mem_free(ground->ctx, check);
        return result;
    }
    *out = check;
    return TRL_OK;
}

void trl_mesh_check_destroy(trl_mesh_check **check)
{
    if (!check || !*check) {
        return;
    }
    const trl_context *ctx = (*check)->check.ctx;
    mesh_check_finish(&(*check)->check);
    mem_free(ctx, *check);
    *check = NULL;
}

trl_mesh_error trl_mesh_check_error(const trl_mesh_check *check)
{
    if (!check) {
        return (trl_mesh_error){0};
    }
    const struct mesh_error *e = &check->check.error;
    return (trl_mesh_error){.places = e->places,
                            .shift_rms_px = e->shift_rms,
                            .shift_max_px = e->shift_max,
                            .edges = e->edges,
                            .edge_rms_px = e->edge_rms,
                            .edge_max_px = e->edge_max,
                            .lost_edges = e->lost_edges,
                            .holes = e->holes,
                            .new_cpu_ms = e->new_cpu_ms,
                            .cpu_ms = e->cpu_ms};
}

trl_result trl_mesh_check_change(const trl_mesh_check *before, const trl_mesh_check *after,
                                 trl_mesh_change *out)
{
    if (!before || !after || !out) {
        return TRL_ERROR_INVALID;
    }
    struct mesh_change change;
    const trl_result result = mesh_check_change(&before->check, &after->check, &change);
    *out = (trl_mesh_change){change.places, change.rms, change.highest};
    return result;
}
