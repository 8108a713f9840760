// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/shadow.h"

#include "gpu/pass.h"
#include "shared/hemisphere.glsl"

#include <math.h>

enum { SIDE = 640 };
static const double RING_AT_NEAR = 50; // see projection.near_m
// Shadows that fall into view may come from this far outside, in radians: 190 km on Earth.
static const double OUTSIDE_RAD = 0.03;
// How much farther than a mesh's camera the map's may move: up to 0.6 heights, still among its
// finest cells. In flight map and sky view take more than all else.
static const double STAYS = 4;
// A place does not shade itself: its altitude in the map is not exactly that of the mesh.
static const double SELF_CELLS = 0.75;
// A quarter of the sun's radius: what it moves in 16 seconds of Earth's day.
static const double SUN_STEP_RAD = 1.2e-3;

static trl_result make_programs(struct terrain_shadow *s)
{
    const struct gpu_program_desc spread = {.vertex = "lib/fullscreen.vert",
                                            .fragment = "terrain/shadow_spread.frag"};
    const trl_result result =
        height_programs_init(s->surface, "terrain/shadow_height.frag", &s->heights);
    return result == TRL_OK ? gpu_program_init(s->gpu, &spread, &s->spread) : result;
}

static trl_result make_map(struct terrain_shadow *s, int i)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "terrain shadow";
    // Half floats step by metres: only where nothing better is filtered.
    desc.format = s->gpu->caps.has_float_linear ? GPU_FORMAT_RGBA32F : GPU_FORMAT_RGBA16F;
    desc.width = desc.height = SIDE;
    const trl_result result = gpu_texture_init(s->gpu, &desc, &s->maps[i]);
    if (result != TRL_OK) {
        return result;
    }
    const struct gpu_target_desc target = {
        .label = "terrain shadow", .color_count = 1, .colors = {{.texture = &s->maps[i]}}};
    return gpu_target_init(s->gpu, &target, &s->targets[i]);
}

trl_result terrain_shadow_init(const struct surface *surface, double sun_angular_radius_rad,
                               struct terrain_shadow *out)
{
    *out = (struct terrain_shadow){
        .gpu = surface->gpu, .surface = surface, .sun_angular_radius_rad = sun_angular_radius_rad};
    trl_result result = make_map(out, 0);
    result = result == TRL_OK ? make_map(out, 1) : result;
    result = result == TRL_OK ? make_programs(out) : result;
    if (result != TRL_OK) {
        terrain_shadow_finish(out);
    }
    return result;
}

void terrain_shadow_finish(struct terrain_shadow *shadow)
{
    height_programs_finish(&shadow->heights);
    gpu_program_finish(&shadow->spread);
    for (int i = 0; i < 2; i++) {
        gpu_target_finish(&shadow->targets[i]);
        gpu_texture_finish(&shadow->maps[i]);
    }
    *shadow = (struct terrain_shadow){0};
}

static void set_vec3(struct gpu_program *program, const char *name, struct vec3 v)
{
    const float values[3] = {(float)v.x, (float)v.y, (float)v.z};
    gpu_program_set_vec3(program, name, values);
}

static void set_map(const struct terrain_shadow *s, struct gpu_program *program)
{
    const float map[3] = {SIDE, (float)s->power, (float)s->extent};
    gpu_program_set_vec3(program, "u_map", map);
}

static trl_result draw_heights(struct terrain_shadow *s)
{
    const struct anchor *anchor = &s->projection.anchor;
    const struct surface_eye eye = projection_eye(&s->projection, s->surface, OUTSIDE_RAD);
    struct gpu_program *program = height_programs_bind(&s->heights, &eye, anchor);
    set_map(s, program);
    s->current = 0;
    const struct gpu_pass pass = {.target = &s->targets[0]};
    gpu_pass_begin(s->gpu, &pass);
    return gpu_draw_fullscreen(program, "terrain shadow heights");
}

static trl_result draw_spread(struct terrain_shadow *s, double step, bool is_last)
{
    const float spread[4] = {(float)step, is_last ? 1.0f : 0.0f, (float)s->surface->radius_m, 0};
    gpu_program_set_vec4(&s->spread, "u_spread", spread);
    gpu_program_set_texture(&s->spread, "u_previous", &s->maps[s->current]);
    s->current = 1 - s->current;
    const struct gpu_pass pass = {.target = &s->targets[s->current]};
    gpu_pass_begin(s->gpu, &pass);
    return gpu_draw_fullscreen(&s->spread, "terrain shadow");
}

// How far the highest peak throws its shadow on the lowest ground: there the ray has risen by the
// range of altitudes, s slope + s^2 / 2 R. The sun is lowest at the edge of what is in reach.
static double find_longest_shadow(const struct terrain_shadow *s)
{
    const double sine = vec3_dot(s->sun, s->projection.anchor.up);
    const double lowest = asin(fmax(-1, fmin(1, sine))) - s->projection.reach_rad;
    const double slope = tan(fmax(0, lowest));
    const double range = surface_max_altitude(s->surface) - surface_min_altitude(s->surface) + 1;
    const double radius = s->surface->radius_m;
    return radius * (sqrt(slope * slope + 2 * range / radius) - slope);
}

static trl_result draw_map(struct terrain_shadow *s)
{
    trl_result result = draw_heights(s);
    const double end = find_longest_shadow(s);
    set_map(s, &s->spread);
    set_vec3(&s->spread, "u_sun", anchor_local(&s->projection.anchor, s->sun));
    // From the cells near the camera on, doubling.
    double step = s->projection.near_m / RING_AT_NEAR;
    for (; step < end && result == TRL_OK; step *= 2) {
        result = draw_spread(s, step, false);
    }
    return result == TRL_OK ? draw_spread(s, SELF_CELLS, true) : result;
}

trl_result terrain_shadow_update(struct terrain_shadow *s, const struct camera *camera)
{
    const bool is_stale = projection_is_stale(&s->projection, s->surface, OUTSIDE_RAD, camera);
    const double turned = vec3_length(vec3_sub(camera->sun_direction, s->sun));
    if (!is_stale && turned < SUN_STEP_RAD) {
        return TRL_OK;
    }
    if (is_stale) {
        s->projection = projection_make(s->surface, camera);
        s->projection.threshold_m *= STAYS;
        s->extent = tan(fmin(s->projection.reach_rad + OUTSIDE_RAD, 3) / 2);
        s->power = projection_power(s->projection.near_m / s->surface->radius_m / 2 / s->extent,
                                    RING_AT_NEAR, SIDE / 2.0);
        const struct surface_bounds bounds =
            surface_bounds_around(s->surface, s->projection.anchor.up,
                                  fmin(s->projection.reach_rad + OUTSIDE_RAD, SHARED_PI));
        s->lowest_m = (double)bounds.min;
        s->highest_m = (double)bounds.max;
        s->made++;
    }
    s->sun = camera->sun_direction;
    s->drawn++;
    return draw_map(s);
}

const struct gpu_texture *terrain_shadow_map(const struct terrain_shadow *shadow)
{
    return &shadow->maps[shadow->current];
}

struct terrain_shadow_place terrain_shadow_place(const struct terrain_shadow *s,
                                                 const struct camera *camera)
{
    const struct anchor *anchor = &s->projection.anchor;
    const double radius = s->surface->radius_m;
    const struct vec3 offset =
        anchor_local(anchor, vec3_sub(camera->position_m, vec3_scale(anchor->up, radius)));
    struct terrain_shadow_place place = {
        .power = (float)s->power,
        .extent = (float)s->extent,
        .radius_m = (float)radius,
        .offset_m = {(float)offset.x, (float)offset.y, (float)offset.z}};
    anchor_local_from_planet(anchor, place.local_from_planet);
    return place;
}

void terrain_shadow_bind(const struct terrain_shadow *s, const struct camera *camera,
                         struct gpu_program *program)
{
    const struct terrain_shadow_place place = terrain_shadow_place(s, camera);
    const float map[4] = {(float)(1.0 - 1.0 / SIDE), place.power, place.extent, place.radius_m};
    gpu_program_set_vec4(program, "u_shadow", map);
    gpu_program_set_float(program, "u_shadow_sun", (float)s->sun_angular_radius_rad);
    set_vec3(program, "u_shadow_toward", anchor_local(&s->projection.anchor, s->sun));
    gpu_program_set_mat3(program, "u_shadow_from_planet", place.local_from_planet);
    gpu_program_set_vec3(program, "u_shadow_offset", place.offset_m);
    gpu_program_set_texture(program, "u_shadow_map", &s->maps[s->current]);
}
