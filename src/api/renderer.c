// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "api/renderer.h"
#include "api/check.h"
#include "api/rayleigh.h"
#include "scatter/atmosphere.h"
#include "scatter/medium_edit.h"
#include "terrain/projective.h"
#include "terrain/stream.h"
#include <terrella/renderer.h>

#include <math.h>

enum { RENDERER_CANARY = 0x54524431 };

trl_renderer_desc trl_renderer_desc_default(void)
{
    return (trl_renderer_desc){.canary = RENDERER_CANARY,
                               .gl = TRL_GL_HEADLESS,
                               .wavelengths = 16,
                               .sky_model = TRL_SKY_MODEL_OF_SCENE,
                               .air = TRL_AIR_MARCH,
                               .mesher = TRL_MESHER_QUADTREE,
                               .projective = projective_desc_default(),
                               .mesh_error_px = MESHER_ERROR_PX,
                               .waits_for_rasters = true};
}

static trl_result create_frame(trl_context *ctx, const trl_renderer_desc *desc, trl_renderer **out)
{
    trl_renderer *renderer = mem_alloc(ctx, 1, sizeof *renderer);
    if (!renderer) {
        return TRL_ERROR_MEMORY;
    }
    renderer->ctx = ctx;
    const struct frame_desc frame = {
        .ctx = ctx,
        .scene = desc->scene,
        .gl = desc->gl,
        .wavelengths = desc->spectrum == TRL_SPECTRUM_RGB ? ATMOSPHERE_RGB : desc->wavelengths,
        .orders = desc->max_orders,
        .sky_model = desc->sky_model == TRL_SKY_MODEL_OF_SCENE ? desc->scene->sky_model
                                                               : (trl_sky_model)desc->sky_model,
        .rayleigh = desc->rayleigh ? *desc->rayleigh : desc->scene->rayleigh,
        .air = desc->air,
        .meshing = {desc->mesher, desc->projective, desc->mesh_error_px},
        .measures_time = desc->measures_time,
        .waits_for_rasters = desc->waits_for_rasters};
    const trl_result result = frame_init(&frame, &renderer->frame);
    if (result != TRL_OK) {
        mem_free(ctx, renderer);
        return result;
    }
    *out = renderer;
    return TRL_OK;
}

trl_result trl_renderer_create(trl_context *ctx, const trl_renderer_desc *desc, trl_renderer **out)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, out != NULL);
    *out = NULL;
    TRL_REQUIRE(ctx, desc != NULL);
    TRL_REQUIRE(ctx, desc->canary == RENDERER_CANARY);
    TRL_REQUIRE(ctx, desc->scene != NULL);
    TRL_REQUIRE(ctx, desc->gl == TRL_GL_HEADLESS || desc->gl == TRL_GL_CURRENT);
    TRL_REQUIRE(ctx, desc->wavelengths >= 1 && desc->wavelengths <= TRL_RENDERER_MAX_WAVELENGTHS);
    TRL_REQUIRE(ctx, desc->spectrum == TRL_SPECTRUM_FULL || desc->spectrum == TRL_SPECTRUM_RGB);
    TRL_REQUIRE(ctx, desc->max_orders <= TRL_SKY_MAX_ORDERS);
    TRL_REQUIRE(ctx, trl_air_name(desc->air) != NULL);
    TRL_REQUIRE(ctx, trl_mesher_name(desc->mesher) != NULL);
    TRL_REQUIRE(ctx, projective_desc_is_good(&desc->projective));
    TRL_REQUIRE(ctx, desc->mesh_error_px >= TRL_MESH_ERROR_MIN_PX &&
                         desc->mesh_error_px <= TRL_MESH_ERROR_MAX_PX);
    const trl_result result = desc->rayleigh ? check_rayleigh(ctx, desc->rayleigh) : TRL_OK;
    return result == TRL_OK ? create_frame(ctx, desc, out) : result;
}

void trl_renderer_destroy(trl_renderer **renderer)
{
    if (!renderer || !*renderer) {
        return;
    }
    const trl_context *ctx = (*renderer)->ctx;
    frame_finish(&(*renderer)->frame);
    mem_free(ctx, *renderer);
    *renderer = NULL;
}

trl_result trl_renderer_draw(trl_renderer *renderer, const trl_view *view, uint32_t width,
                             uint32_t height, double elapsed_s)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, view != NULL);
    TRL_REQUIRE(renderer->ctx, isfinite(elapsed_s) && elapsed_s >= 0);
    trl_result result = check_size(renderer->ctx, width, height);
    if (result == TRL_OK) {
        result = check_view(renderer->ctx, view, renderer->frame.scene);
    }
    const struct frame_request request = {view, width, height, elapsed_s};
    return result == TRL_OK ? frame_draw(&renderer->frame, &request) : result;
}

static trl_result require_picture(const trl_renderer *renderer)
{
    return renderer->frame.is_drawn ? TRL_OK
                                    : trl_fail(renderer->ctx, TRL_ERROR_INVALID,
                                               TRL_LOG_ITEM_ARGUMENT, "nothing has been drawn yet");
}

trl_result trl_renderer_present(trl_renderer *renderer, uint32_t x, uint32_t y, uint32_t width,
                                uint32_t height)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    const uint32_t most = TRL_RENDERER_MAX_SIDE;
    const bool is_headless = renderer->frame.gpu->egl_context != NULL;
    TRL_REQUIRE(renderer->ctx, !is_headless); // it has no window
    TRL_REQUIRE(renderer->ctx, x <= most && y <= most);
    TRL_REQUIRE(renderer->ctx, width >= 1 && width <= most && height >= 1 && height <= most);
    const trl_result result = require_picture(renderer);
    const struct gpu_rect rect = {x, y, width, height};
    struct frame *frame = &renderer->frame;
    return result == TRL_OK ? tone_present(&frame->tone, &frame->picture, rect) : result;
}

trl_result trl_renderer_read_rgba8(trl_renderer *renderer, uint8_t *rgba)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, rgba != NULL);
    const trl_result result = require_picture(renderer);
    return result == TRL_OK ? frame_read_picture(&renderer->frame, rgba) : result;
}

trl_result trl_renderer_read_radiance(trl_renderer *renderer, float *rgba)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, rgba != NULL);
    const trl_result result = require_picture(renderer);
    return result == TRL_OK ? frame_read_radiance(&renderer->frame, rgba) : result;
}

void trl_renderer_wait(trl_renderer *renderer)
{
    if (renderer && gpu_make_current(renderer->frame.gpu) == TRL_OK) {
        gpu_wait(renderer->frame.gpu);
    }
}

trl_result trl_renderer_exposure(trl_renderer *renderer, double *ev100)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, ev100 != NULL);
    trl_result result = require_picture(renderer);
    if (result == TRL_OK) {
        result = gpu_make_current(renderer->frame.gpu);
    }
    return result == TRL_OK ? exposure_read(&renderer->frame.exposure, ev100) : result;
}

trl_result trl_renderer_set_sky_model(trl_renderer *renderer, trl_sky_model model)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    const trl_result result = gpu_make_current(renderer->frame.gpu);
    return result == TRL_OK ? frame_set_sky_model(&renderer->frame, model) : result;
}

trl_result trl_renderer_set_single_drawing(trl_renderer *renderer, trl_single_drawing drawing,
                                           uint32_t side, uint32_t steps)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    struct frame *frame = &renderer->frame;
    const bool has_integrals = drawing == TRL_SINGLE_VERTICES;
    TRL_REQUIRE(renderer->ctx, (unsigned)drawing <= TRL_SINGLE_VERTICES);
    if (drawing == TRL_SINGLE_PIXELS) {
        frame->spheres = (struct sky_spheres){0};
        return TRL_OK;
    }
    TRL_REQUIRE(renderer->ctx, side >= 3 && side <= TRL_SINGLE_MAX_SIDE);
    TRL_REQUIRE(renderer->ctx, !has_integrals || (steps >= 1 && steps <= TRL_SINGLE_MAX_STEPS));
    if (!frame->ground.is_bare) {
        return trl_fail(
            renderer->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
            "the model \"single\" draws spheres only for scenes without surface layers");
    }
    frame->spheres = (struct sky_spheres){side, has_integrals, steps};
    return TRL_OK;
}

trl_sky_model trl_renderer_sky_model(const trl_renderer *renderer)
{
    return renderer ? renderer->frame.sky_model : TRL_SKY_SPECTRAL;
}

static trl_result change_constituent(const trl_context *ctx, struct medium *medium,
                                     const trl_constituent_change *change)
{
    TRL_REQUIRE(ctx, change->constituent < medium->constituent_count);
    TRL_REQUIRE(ctx, change->amount >= 0 && change->amount <= 1e6);
    struct constituent *constituent = &medium->constituents[change->constituent];
    constituent_scale(constituent, change->amount);
    if (!isnan(change->asymmetry)) {
        TRL_REQUIRE(ctx, fabs(change->asymmetry) < 0.9999);
        if (!constituent_set_asymmetry(constituent, change->asymmetry)) {
            return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                            "the phase function of %s has no asymmetry to change",
                            constituent->name);
        }
    }
    return TRL_OK;
}

// Coefficients are bounded where eyes see, as a scene's are when it is read.
static trl_result check_changed(const trl_context *ctx, const struct medium *medium)
{
    trl_result result = TRL_OK;
    for (double nm = 360; nm <= 830 && result == TRL_OK; nm += 10) {
        result = medium_check(ctx, medium, nm);
    }
    return result;
}

trl_result trl_renderer_change_atmosphere(trl_renderer *renderer, const trl_scene *scene,
                                          const trl_constituent_change *changes, size_t count)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    const trl_context *ctx = renderer->ctx;
    struct frame *frame = &renderer->frame;
    TRL_REQUIRE(ctx, scene != NULL);
    TRL_REQUIRE(ctx, changes != NULL || count == 0);
    struct medium medium;
    trl_result result = medium_copy_atmosphere(ctx, &frame->scene->medium, &scene->medium, &medium);
    if (result != TRL_OK) {
        return result;
    }
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        result = change_constituent(ctx, &medium, &changes[i]);
    }
    if (result == TRL_OK) {
        result = check_changed(ctx, &medium);
    }
    if (result == TRL_OK) {
        result = gpu_make_current(frame->gpu);
    }
    if (result == TRL_OK) {
        result = frame_change_atmosphere(frame, &medium);
    }
    medium_finish(ctx, &medium);
    return result;
}

bool trl_renderer_is_settled(const trl_renderer *renderer)
{
    return !renderer || frame_is_settled(&renderer->frame);
}

void trl_renderer_tile_stats(const trl_renderer *renderer, trl_tile_stats *out)
{
    if (!out) {
        return;
    }
    *out = (trl_tile_stats){0};
    const struct stream *stream = renderer ? renderer->frame.ground.surface.stream : NULL;
    if (!stream) {
        return;
    }
    const struct tile_cache_stats stats = tile_cache_stats(stream->cache);
    *out = (trl_tile_stats){.rasters = stream->layer_count,
                            .loaded = stats.loaded,
                            .failed = stats.failed,
                            .missing = stream->missing,
                            .held_mb = stream_bytes(stream) / 1e6,
                            .most_mb = (double)stats.most_bytes / 1e6,
                            .read_s = stats.read_s};
}

trl_result trl_renderer_accumulate_clouds(trl_renderer *renderer, bool accumulates)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    renderer->frame.clouds.accumulates = accumulates;
    return TRL_OK;
}

const char *trl_air_name(trl_air air)
{
    static const char *const names[] = {[TRL_AIR_TABLE] = "table", [TRL_AIR_MARCH] = "march"};
    return (unsigned)air < sizeof names / sizeof *names ? names[air] : NULL;
}

trl_result trl_renderer_set_air(trl_renderer *renderer, trl_air air)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, trl_air_name(air) != NULL);
    renderer->frame.air = air;
    return TRL_OK;
}

trl_air trl_renderer_air(const trl_renderer *renderer)
{
    return renderer ? renderer->frame.air : TRL_AIR_MARCH;
}

const char *trl_mesher_name(trl_mesher mesher)
{
    return mesher_name(mesher);
}

trl_result trl_renderer_set_mesher(trl_renderer *renderer, trl_mesher mesher)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, trl_mesher_name(mesher) != NULL);
    const trl_result result = gpu_make_current(renderer->frame.gpu);
    return result == TRL_OK ? ground_set_mesher(&renderer->frame.ground, mesher) : result;
}

trl_result trl_renderer_set_projective(trl_renderer *renderer, const trl_projective_desc *desc)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, desc != NULL);
    TRL_REQUIRE(renderer->ctx, projective_desc_is_good(desc)); // sides even and in range
    const trl_result result = gpu_make_current(renderer->frame.gpu);
    return result == TRL_OK ? ground_set_projective(&renderer->frame.ground, desc) : result;
}

trl_result trl_renderer_set_hemisphere(trl_renderer *renderer, uint32_t cells)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, hemisphere_cells_are_good(cells)); // in range, whole steps
    const trl_result result = gpu_make_current(renderer->frame.gpu);
    return result == TRL_OK ? ground_set_hemisphere(&renderer->frame.ground, cells) : result;
}

trl_result trl_renderer_set_mesh_error(trl_renderer *renderer, double error_px)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx,
                error_px >= TRL_MESH_ERROR_MIN_PX && error_px <= TRL_MESH_ERROR_MAX_PX);
    ground_set_mesh_error(&renderer->frame.ground, error_px);
    return TRL_OK;
}

trl_mesher trl_renderer_mesher(const trl_renderer *renderer)
{
    return renderer ? renderer->frame.ground.mesher : trl_renderer_desc_default().mesher;
}

trl_result trl_renderer_mesh_stats(const trl_renderer *renderer, trl_mesh_stats *out)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, out != NULL);
    const struct mesher_stats stats = ground_mesher_stats(&renderer->frame.ground);
    *out = (trl_mesh_stats){stats.triangles, stats.draws, stats.bytes};
    return TRL_OK;
}

double trl_renderer_ground_altitude_m(const trl_renderer *renderer, double latitude_rad,
                                      double longitude_rad)
{
    if (!renderer || !isfinite(latitude_rad) || !isfinite(longitude_rad)) {
        return 0;
    }
    return ground_altitude_m(&renderer->frame.ground, latitude_rad, longitude_rad);
}

trl_result trl_renderer_resolve(const trl_renderer *renderer, const trl_view *view, trl_view *out)
{
    if (!renderer) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(renderer->ctx, view != NULL);
    TRL_REQUIRE(renderer->ctx, out != NULL);
    const struct frame *frame = &renderer->frame;
    trl_result result = check_view(renderer->ctx, view, frame->scene);
    if (result != TRL_OK) {
        return result;
    }
    const struct camera_place place = frame_place(frame, view);
    result = camera_check(renderer->ctx, view, &place);
    if (result == TRL_OK) {
        *out = camera_view_resolve(view, &place);
    }
    return result;
}

size_t trl_renderer_timings(const trl_renderer *renderer, trl_timing *rows, size_t capacity)
{
    if (!renderer) {
        return 0;
    }
    const struct frame_clock *clock = &renderer->frame.clock;
    for (size_t i = 0; i < capacity && i < clock->count; i++) {
        rows[i] = clock->rows[i];
    }
    return clock->count;
}
