// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/sky_view.h"

#include "gpu/pass.h"

#include <math.h>

enum { SIDE = 320, LIGHT_SIDE = 160 };
static const double FIRST_CELLS = 0.5; // nearer, the pixel's own slope counts
// Terrain lower than 3 degrees hides less than cos^2 says: a 360th of the light.
static const double LEAST_ELEVATION_RAD = 0.0524;
// Heights are means over this part of the distance.
static const double LOG2_WIDTH = -3.5;

static trl_result make_texture(struct gpu *gpu, enum gpu_format format, uint32_t side,
                               struct gpu_texture *out)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "sky view";
    desc.format = format;
    desc.width = desc.height = side;
    desc.levels = format == GPU_FORMAT_RGBA8 ? 1 : 0;
    desc.filter = format == GPU_FORMAT_RGBA8 ? GPU_FILTER_LINEAR : GPU_FILTER_TRILINEAR;
    return gpu_texture_init(gpu, &desc, out);
}

// Eight azimuths.
static trl_result make_azimuths(struct gpu *gpu, uint32_t side, struct gpu_texture textures[2],
                                struct gpu_target *out)
{
    trl_result result = make_texture(gpu, GPU_FORMAT_RGBA8, side, &textures[0]);
    result = result == TRL_OK ? make_texture(gpu, GPU_FORMAT_RGBA8, side, &textures[1]) : result;
    const struct gpu_target_desc desc = {
        .label = "sky view",
        .color_count = 2,
        .colors = {{.texture = &textures[0]}, {.texture = &textures[1]}}};
    return result == TRL_OK ? gpu_target_init(gpu, &desc, out) : result;
}

static trl_result make_maps(struct terrain_sky_view *v)
{
    const enum gpu_format format =
        v->gpu->caps.has_float_linear ? GPU_FORMAT_RG32F : GPU_FORMAT_RG16F;
    const struct gpu_target_desc desc = {
        .label = "sky view ground", .color_count = 1, .colors = {{.texture = &v->ground}}};
    trl_result result = make_texture(v->gpu, format, SIDE, &v->ground);
    result = result == TRL_OK ? gpu_target_init(v->gpu, &desc, &v->ground_target) : result;
    if (result == TRL_OK) {
        result = make_azimuths(v->gpu, SIDE, v->horizons, &v->horizons_target);
    }
    return result == TRL_OK ? make_azimuths(v->gpu, LIGHT_SIDE, v->lights, &v->lights_target)
                            : result;
}

static trl_result make_programs(struct terrain_sky_view *v)
{
    const struct {
        struct gpu_program *program;
        const char *fragment;
    } programs[] = {{&v->reduce, "terrain/sky_view_heights.frag"},
                    {&v->find, "terrain/sky_view_horizon.frag"},
                    {&v->light, "terrain/sky_view_light.frag"},
                    {&v->apply, "terrain/sky_view.frag"}};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < sizeof programs / sizeof *programs && result == TRL_OK; i++) {
        const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                              .fragment = programs[i].fragment};
        result = gpu_program_init(v->gpu, &desc, programs[i].program);
    }
    return result;
}

trl_result terrain_sky_view_init(const struct terrain_shadow *shadow, struct terrain_sky_view *out)
{
    *out = (struct terrain_sky_view){.gpu = shadow->gpu, .shadow = shadow};
    trl_result result = make_maps(out);
    result = result == TRL_OK ? make_programs(out) : result;
    if (result != TRL_OK) {
        terrain_sky_view_finish(out);
    }
    return result;
}

void terrain_sky_view_finish(struct terrain_sky_view *view)
{
    gpu_program_finish(&view->reduce);
    gpu_program_finish(&view->find);
    gpu_program_finish(&view->light);
    gpu_program_finish(&view->apply);
    gpu_target_finish(&view->ground_target);
    gpu_target_finish(&view->horizons_target);
    gpu_target_finish(&view->lights_target);
    gpu_texture_finish(&view->ground);
    for (int i = 0; i < 2; i++) {
        gpu_texture_finish(&view->horizons[i]);
        gpu_texture_finish(&view->lights[i]);
    }
    *view = (struct terrain_sky_view){0};
}

static void set_map(const struct terrain_sky_view *v, int side, struct gpu_program *program)
{
    const float map[3] = {(float)side, (float)v->shadow->power, (float)v->shadow->extent};
    gpu_program_set_vec3(program, "u_map", map);
}

static trl_result draw_ground(struct terrain_sky_view *v)
{
    const struct terrain_shadow *s = v->shadow;
    const struct gpu_texture *shadows = terrain_shadow_map(s);
    const float texel[4] = {1.0f / (float)shadows->width, (float)s->surface->radius_m,
                            (float)s->sun_angular_radius_rad, 0};
    const struct vec3 sun = anchor_local(&s->projection.anchor, s->sun);
    const float toward[3] = {(float)sun.x, (float)sun.y, (float)sun.z};
    set_map(v, SIDE, &v->reduce);
    gpu_program_set_texture(&v->reduce, "u_shadows", shadows);
    gpu_program_set_vec4(&v->reduce, "u_texel", texel);
    gpu_program_set_vec3(&v->reduce, "u_sun", toward);
    const struct gpu_pass pass = {.target = &v->ground_target};
    gpu_pass_begin(v->gpu, &pass);
    const trl_result result = gpu_draw_fullscreen(&v->reduce, "sky view ground");
    return result == TRL_OK ? gpu_texture_make_mips(&v->ground) : result;
}

static trl_result draw_azimuths(const struct terrain_sky_view *v, struct gpu_program *program,
                                const struct gpu_target *target)
{
    const struct terrain_shadow *s = v->shadow;
    const double range = s->highest_m - s->lowest_m;
    const float reach[4] = {(float)(FIRST_CELLS * target->width / SIDE),
                            (float)(fmax(range, 1) / LEAST_ELEVATION_RAD),
                            (float)s->surface->radius_m, (float)LOG2_WIDTH};
    set_map(v, (int)target->width, program);
    gpu_program_set_float(program, "u_ground_side", SIDE);
    gpu_program_set_texture(program, "u_ground", &v->ground);
    gpu_program_set_vec4(program, "u_reach", reach);
    const struct gpu_pass pass = {.target = target};
    gpu_pass_begin(v->gpu, &pass);
    return gpu_draw_fullscreen(program, "sky view azimuths");
}

trl_result terrain_sky_view_update(struct terrain_sky_view *view)
{
    const struct terrain_shadow *shadow = view->shadow;
    if (view->drawn == shadow->drawn) {
        return TRL_OK;
    }
    trl_result result = draw_ground(view);
    if (result == TRL_OK && view->made != shadow->made) {
        result = draw_azimuths(view, &view->find, &view->horizons_target);
    }
    if (result == TRL_OK) {
        result = draw_azimuths(view, &view->light, &view->lights_target);
    }
    if (result == TRL_OK) {
        view->made = shadow->made;
        view->drawn = shadow->drawn;
    }
    return result;
}

trl_result terrain_sky_view_draw(struct terrain_sky_view *view,
                                 const struct terrain_sky_view_inputs *in,
                                 const struct gpu_target *target)
{
    struct gpu_program *program = &view->apply;
    const struct terrain_shadow_place place = terrain_shadow_place(view->shadow, in->camera);
    const float map[4] = {(float)(1.0 - 1.0 / SIDE), place.power, place.extent, place.radius_m};
    gpu_program_set_vec4(program, "u_view", map);
    gpu_program_set_mat3(program, "u_view_from_planet", place.local_from_planet);
    gpu_program_set_vec3(program, "u_view_offset", place.offset_m);
    gpu_program_set_texture(program, "u_position", in->position);
    gpu_program_set_texture(program, "u_normal", in->normal);
    gpu_program_set_texture(program, "u_albedo", in->albedo);
    gpu_program_set_texture(program, "u_horizon0", &view->horizons[0]);
    gpu_program_set_texture(program, "u_horizon1", &view->horizons[1]);
    gpu_program_set_texture(program, "u_light0", &view->lights[0]);
    gpu_program_set_texture(program, "u_light1", &view->lights[1]);
    gpu_program_set_float(program, "u_light_scale", (float)(1.0 - 1.0 / LIGHT_SIDE));
    const struct gpu_pass pass = {.target = target,
                                  .state = {.depth = GPU_DEPTH_FARTHER, .blend = GPU_BLEND_ADD}};
    gpu_pass_begin(view->gpu, &pass);
    return gpu_draw_fullscreen(program, "sky view");
}
