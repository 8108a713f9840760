// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/compose.h"

#include "gpu/pass.h"
#include "shared/sea.glsl"
#include "shared/shore.glsl"
#include "terrain/kinds.h"

#include <math.h>

// A layer that covers fewer pixels than this is left out.
static const double LEAST_PIXELS = 3;
// Steeper than any ground.
static const float NO_SLOPE = 1e9f;

// Whether footprints that see no noise have the means of all masks, which need no shore.
static bool has_mean_shores(const struct surface *surface)
{
    const struct terrain_noise *noise = &surface->noise;
    bool has_means = noise_is_there(noise);
    for (size_t i = 0; i < surface->counts[SURFACE_WATER] && has_means; i++) {
        const double texel_m =
            layer_finest_frame(&surface->layers[SURFACE_WATER][i])->texel_height *
            surface->radius_m;
        has_means = SHORE_MEAN_TEXELS * texel_m <= noise_unseen_m(noise);
    }
    return has_means;
}

static trl_result make_program(struct terrain_compose *compose, bool has_noise, size_t elevations)
{
    const struct surface *surface = compose->surface;
    struct surface_defines defines;
    surface_get_defines(surface, elevations, &defines);
    defines.count -= noise_is_there(&surface->noise) && !has_noise ? 1 : 0; // it is the last
    if (has_noise && surface->biomes.count > 0) {
        defines.list[defines.count++] = "HAS_BIOMES";
    }
    if (!has_noise && has_mean_shores(surface)) {
        defines.list[defines.count++] = "HAS_MEAN_SHORES";
    }
    const struct gpu_program_desc desc = {.vertex = "lib/layer.vert",
                                          .fragment = "terrain/surface.frag",
                                          .defines = defines.list,
                                          .define_count = defines.count};
    return gpu_program_init(compose->gpu, &desc, &compose->programs[has_noise][elevations]);
}

trl_result terrain_compose_init(const struct surface *surface, struct terrain_compose *out)
{
    *out = (struct terrain_compose){.gpu = surface->gpu, .surface = surface};
    trl_result result = TRL_OK;
    for (size_t i = 0; i <= surface_count_seen(surface, SURFACE_ELEVATION) && result == TRL_OK;
         i++) {
        result = surface->is_invented ? TRL_OK : make_program(out, false, i);
        if (result == TRL_OK && noise_is_there(&surface->noise)) {
            result = make_program(out, true, i);
        }
    }
    if (result != TRL_OK) {
        terrain_compose_finish(out);
    }
    return result;
}

void terrain_compose_finish(struct terrain_compose *compose)
{
    for (size_t i = 0; i <= SURFACE_SEEN_LAYERS; i++) {
        gpu_program_finish(&compose->programs[0][i]);
        gpu_program_finish(&compose->programs[1][i]);
    }
    *compose = (struct terrain_compose){0};
}

static double find_pixel_rad(const struct terrain_compose_inputs *in)
{
    return 2 * in->camera->tan_half_fov_y / in->position->height;
}

static struct surface_selection select_layers(const struct surface *surface,
                                              const struct terrain_compose_inputs *in)
{
    const struct projection *p = &in->shadow->projection;
    const double distance_m = vec3_length(in->camera->position_m);
    struct surface_eye eye = projection_eye(p, surface, 0);
    // Of this very place: that of the projection may be some way off.
    eye.up = vec3_scale(in->camera->position_m, 1 / distance_m);
    eye.solid_m = fmin(p->solid_m, distance_m);
    eye.horizon_rad = acos(eye.solid_m / distance_m);
    eye.least_rad = LEAST_PIXELS * find_pixel_rad(in);
    return surface_select(surface, &eye);
}

// Once for each kind: what a picture lacks must not be a riddle.
static void tell_left_out(struct terrain_compose *compose, const struct surface_selection *seen)
{
    static const char *const names[SURFACE_KIND_COUNT] = {[SURFACE_ELEVATION] = "elevation",
                                                          [SURFACE_COLOUR] = "colour",
                                                          [SURFACE_WATER] = "water",
                                                          [SURFACE_NORMAL] = "normals",
                                                          [SURFACE_LIGHTS] = "lights"};
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        if (seen->left_out[k] > 0 && !compose->has_told[k]) {
            compose->has_told[k] = true;
            trl_log(compose->gpu->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_RASTER,
                    "%zu layers of %s are in view, of which a picture shows %zu: the largest in it",
                    seen->counts[k] + seen->left_out[k], names[k], seen->counts[k]);
        }
    }
}

static void bind_rock(const struct surface_rock *rock, struct gpu_program *program)
{
    const bool is_there = rock->slopes[1] > 0;
    const float colour[4] = {rock->albedo[0], rock->albedo[1], rock->albedo[2], (float)rock->tint};
    const float slopes[4] = {is_there ? (float)rock->slopes[0] : NO_SLOPE,
                             is_there ? (float)rock->slopes[1] : 2 * NO_SLOPE,
                             is_there ? 1.0f : 0.0f, 0};
    gpu_program_set_vec4(program, "u_rock", colour);
    gpu_program_set_vec4(program, "u_rock_slopes", slopes);
}

struct terrain_compose_scope terrain_compose_find_scope(const struct surface *surface,
                                                        const struct terrain_compose_inputs *in)
{
    const double nearest_m =
        vec3_length(in->camera->position_m) - surface->radius_m - surface->max_altitude_m;
    return (struct terrain_compose_scope){
        .selection = select_layers(surface, in),
        .has_noise =
            surface->is_invented || noise_is_seen(&surface->noise, nearest_m * find_pixel_rad(in))};
}

void terrain_compose_bind_scope(const struct surface *surface,
                                const struct terrain_compose_inputs *in,
                                const struct terrain_compose_scope *scope,
                                struct gpu_program *program)
{
    const struct anchor anchor = anchor_below(in->camera->position_m);
    float local_from_planet[9];
    anchor_local_from_planet(&anchor, local_from_planet);
    const float view[4] = {(float)vec3_length(in->camera->position_m), (float)find_pixel_rad(in)};
    surface_bind(surface, &scope->selection, &anchor, program);
    gpu_program_set_texture(program, "u_position", in->position);
    gpu_program_set_mat3(program, "u_local_from_planet", local_from_planet);
    gpu_program_set_vec4(program, "u_view", view);
}

static void bind(const struct surface *surface, const struct terrain_compose_inputs *in,
                 const struct terrain_compose_scope *scope, struct gpu_program *program)
{
    terrain_compose_bind_scope(surface, in, scope, program);
    terrain_shadow_bind(in->shadow, in->camera, program);
    biomes_bind(&surface->biomes, program);
    bind_rock(&surface->rock, program);
    gpu_program_set_vec3(program, "u_default_albedo", surface->default_albedo);
    if (surface->depth.is_told) {
        const double depth_m = surface->depth.everywhere_m;
        gpu_program_set_float(program, "u_sea_depth",
                              depth_m < 0 ? -1 : (float)sea_depth_code(depth_m));
        gpu_program_set_vec3(program, "u_sea_albedo", in->sea_albedo);
    }
    gpu_program_set_float(program, "u_region", (float)log2(fmax(in->region_m, 1e-3)));
}

trl_result terrain_compose_draw(struct terrain_compose *compose,
                                const struct terrain_compose_inputs *in,
                                const struct gpu_target *target)
{
    const struct terrain_compose_scope scope = terrain_compose_find_scope(compose->surface, in);
    tell_left_out(compose, &scope.selection);
    struct gpu_program *program =
        &compose->programs[scope.has_noise][scope.selection.counts[SURFACE_ELEVATION]];
    bind(compose->surface, in, &scope, program);
    gpu_program_set_float(program, "u_depth", TERRAIN_GROUND_DEPTH);
    struct gpu_pass pass = {
        .target = target, .state = {.depth = GPU_DEPTH_FARTHER}, .clears_color = true};
    gpu_pass_begin(compose->gpu, &pass);
    trl_result result = gpu_draw_fullscreen(program, "terrain surface");
    if (result == TRL_OK && in->has_open) {
        // Level, with neither heights nor relief.
        program = &compose->programs[false][0];
        bind(compose->surface, in, &scope, program);
        gpu_program_set_float(program, "u_depth", TERRAIN_OPEN_DEPTH);
        pass.state.depth = GPU_DEPTH_EQUAL;
        pass.clears_color = false;
        gpu_pass_begin(compose->gpu, &pass);
        result = gpu_draw_fullscreen(program, "open sea");
    }
    return result;
}
