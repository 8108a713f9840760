// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/shadow.h"

#include "gpu/pass.h"
#include "shared/hemisphere.glsl"

#include <math.h>

enum { SIDE = 512, STEPS = 26, HALVINGS = 4 };
static const double RING_AT_NEAR = 40; // see projection.near_m
// A quarter of the sun's radius: what it moves in 16 seconds of Earth's day.
static const double SUN_STEP_RAD = 1.2e-3;

static trl_result make_program(struct terrain_shadow *s, size_t elevations)
{
    struct surface_defines defines;
    surface_get_defines(s->surface, elevations, &defines);
    const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                          .fragment = "terrain/shadow.frag",
                                          .defines = defines.list,
                                          .define_count = defines.count};
    return gpu_program_init(s->gpu, &desc, &s->programs[elevations]);
}

trl_result terrain_shadow_init(const struct surface *surface, double sun_angular_radius_rad,
                               struct terrain_shadow *out)
{
    *out = (struct terrain_shadow){
        .gpu = surface->gpu, .surface = surface, .sun_angular_radius_rad = sun_angular_radius_rad};
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "terrain shadow";
    // Half floats would step by metres.
    desc.format = surface->gpu->caps.has_float_linear ? GPU_FORMAT_RG32F : GPU_FORMAT_RG16F;
    desc.width = desc.height = SIDE;
    trl_result result = gpu_texture_init(out->gpu, &desc, &out->map);
    if (result == TRL_OK) {
        const struct gpu_target_desc target = {
            .label = "terrain shadow", .color_count = 1, .colors = {{.texture = &out->map}}};
        result = gpu_target_init(out->gpu, &target, &out->target);
    }
    for (size_t i = 0; i <= surface->counts[SURFACE_ELEVATION] && result == TRL_OK; i++) {
        result = make_program(out, i);
    }
    if (result != TRL_OK) {
        terrain_shadow_finish(out);
    }
    return result;
}

void terrain_shadow_finish(struct terrain_shadow *shadow)
{
    for (size_t i = 0; i <= SURFACE_MAX_LAYERS; i++) {
        gpu_program_finish(&shadow->programs[i]);
    }
    gpu_target_finish(&shadow->target);
    gpu_texture_finish(&shadow->map);
    *shadow = (struct terrain_shadow){0};
}

static void set_vec3(struct gpu_program *program, const char *name, struct vec3 v)
{
    const float values[3] = {(float)v.x, (float)v.y, (float)v.z};
    gpu_program_set_vec3(program, name, values);
}

static trl_result draw_map(struct terrain_shadow *s)
{
    const struct anchor *anchor = &s->projection.anchor;
    // Peaks that cast shadows into the map may stand outside it.
    const double highest = surface_max_altitude(s->surface);
    // A shadow that falls into the map comes from at most 0.05 rad outside (300 km on Earth).
    struct gpu_program *program = &s->programs[surface_count_elevations(
        s->surface, anchor->up, s->projection.reach_rad + 0.05)];
    const float map[4] = {SIDE, (float)s->power, (float)s->extent,
                          (float)s->sun_angular_radius_rad};
    const float march[4] = {STEPS, (float)highest, (float)surface_min_altitude(s->surface),
                            HALVINGS};
    surface_bind(s->surface, anchor, program);
    gpu_program_set_vec4(program, "u_map", map);
    gpu_program_set_vec4(program, "u_march", march);
    set_vec3(program, "u_sun", anchor_local(anchor, s->sun));
    const struct gpu_pass pass = {.target = &s->target};
    gpu_pass_begin(s->gpu, &pass);
    return gpu_draw_fullscreen(program, "terrain shadow");
}

trl_result terrain_shadow_update(struct terrain_shadow *s, const struct camera *camera)
{
    const bool is_stale = projection_is_stale(&s->projection, camera);
    const double turned = vec3_length(vec3_sub(camera->sun_direction, s->sun));
    if (!is_stale && turned < SUN_STEP_RAD) {
        return TRL_OK;
    }
    if (is_stale) {
        s->projection = projection_make(s->surface, camera);
        s->extent = tan(s->projection.reach_rad / 2);
        s->power = projection_power(s->projection.near_m / s->surface->radius_m / 2 / s->extent,
                                    RING_AT_NEAR, SIDE / 2.0);
    }
    s->sun = camera->sun_direction;
    return draw_map(s);
}

void terrain_shadow_bind(const struct terrain_shadow *s, const struct camera *camera,
                         struct gpu_program *program)
{
    const struct anchor *anchor = &s->projection.anchor;
    const double radius = s->surface->radius_m;
    const struct vec3 offset = vec3_sub(camera->position_m, vec3_scale(anchor->up, radius));
    const float map[4] = {(float)(1.0 - 1.0 / SIDE), (float)s->power, (float)s->extent,
                          (float)radius};
    float local_from_planet[9];
    anchor_local_from_planet(anchor, local_from_planet);
    gpu_program_set_vec4(program, "u_shadow", map);
    gpu_program_set_mat3(program, "u_shadow_from_planet", local_from_planet);
    set_vec3(program, "u_shadow_offset", anchor_local(anchor, offset));
    gpu_program_set_texture(program, "u_shadow_map", &s->map);
}
