// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "cloud/march.h"

#include "shared/cloud.glsl"

#include <stdio.h>

static trl_result upload_noise(struct cloud_march *m)
{
    const struct cloud_volume *v = &m->field->volume;
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "noise of clouds";
    desc.shape = GPU_SHAPE_3D;
    desc.format = GPU_FORMAT_RG16F;
    desc.filter = GPU_FILTER_TRILINEAR;
    desc.wrap_x = desc.wrap_y = desc.wrap_z = GPU_WRAP_REPEAT;
    desc.width = desc.height = desc.depth = CLOUD_SIDE;
    desc.levels = CLOUD_LEVELS;
    float *texels =
        mem_alloc(m->gpu->ctx, (size_t)CLOUD_SIDE * CLOUD_SIDE * CLOUD_SIDE, 2 * sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    trl_result result = gpu_texture_init(m->gpu, &desc, &m->noise);
    for (uint32_t level = 0; level < CLOUD_LEVELS && result == TRL_OK; level++) {
        const struct gpu_region region = gpu_texture_region(&m->noise, level);
        const size_t count = 2 * (size_t)region.width * region.height * region.depth;
        for (size_t i = 0; i < count; i++) {
            texels[i] = (float)v->texels[level][i] / CLOUD_STEPS;
        }
        result = gpu_texture_upload(&m->noise, &region, texels);
    }
    mem_free(m->gpu->ctx, texels);
    return result;
}

// A channel for each.
static trl_result upload_maps(struct cloud_march *m)
{
    const struct cloud_field *field = m->field;
    const size_t channels = field->map_count > 1 ? 4 : 1;
    const uint32_t width = field->map_count > 0 ? field->maps[0].width : 1;
    const uint32_t height = field->map_count > 0 ? field->maps[0].height : 1;
    float *texels = mem_alloc(m->gpu->ctx, channels * width * height, sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t k = 0; k < field->map_count; k++) {
        for (size_t i = 0; i < (size_t)width * height; i++) {
            texels[channels * i + k] = field->maps[k].values[i];
        }
    }
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "map of clouds";
    desc.format = channels > 1 ? GPU_FORMAT_RGBA16F : GPU_FORMAT_R16F;
    desc.filter = GPU_FILTER_TRILINEAR;
    desc.wrap_x = GPU_WRAP_REPEAT;
    desc.width = width;
    desc.height = height;
    desc.levels = 0;
    desc.data = texels;
    const trl_result result = gpu_texture_init(m->gpu, &desc, &m->map);
    mem_free(m->gpu->ctx, texels);
    return result == TRL_OK ? gpu_texture_make_mips(&m->map) : result;
}

trl_result cloud_march_init(struct gpu *gpu, const struct cloud_field *field,
                            struct cloud_march *out)
{
    *out = (struct cloud_march){.gpu = gpu, .field = field};
    cloud_deck_init(gpu, &out->deck);
    cloud_shade_init(gpu, &out->shade);
    trl_result result = upload_noise(out);
    if (result == TRL_OK) {
        result = upload_maps(out);
    }
    if (result != TRL_OK) {
        cloud_march_finish(out);
    }
    return result;
}

static void finish_programs(struct cloud_march *m)
{
    gpu_program_finish(&m->march);
    gpu_program_finish(&m->moonlit);
    gpu_program_finish(&m->filter);
    gpu_program_finish(&m->sharpen);
    gpu_program_finish(&m->join);
    gpu_program_finish(&m->find_hidden);
    gpu_program_finish(&m->history.gather);
    m->is_made = false;
}

static void finish_targets(struct cloud_march *m)
{
    for (int i = 0; i < 2; i++) {
        cloud_rays_finish(&m->clouds[i]);
    }
    cloud_history_forget(&m->history);
    cloud_rays_finish(&m->joined);
    gpu_target_finish(&m->sharpened_target);
    gpu_target_finish(&m->hidden_target);
    gpu_texture_finish(&m->sharpened);
    gpu_texture_finish(&m->hidden);
    m->width = m->height = 0;
}

void cloud_march_finish(struct cloud_march *march)
{
    finish_targets(march);
    finish_programs(march);
    cloud_deck_finish(&march->deck);
    cloud_shade_finish(&march->shade);
    gpu_texture_finish(&march->noise);
    gpu_texture_finish(&march->map);
    *march = (struct cloud_march){0};
}

static trl_result make_program(struct gpu *gpu, const char *fragment, const char *const *defines,
                               struct gpu_program *out)
{
    struct gpu_program_desc desc = {
        .vertex = "lib/fullscreen.vert", .fragment = fragment, .defines = defines};
    while (defines[desc.define_count]) {
        desc.define_count++;
    }
    return gpu_program_init(gpu, &desc, out);
}

static trl_result make_programs(struct cloud_march *m, const struct cloud_view *view)
{
    const bool is_bare = view->position == NULL;
    const bool has_moon = view->air->bind_moon;
    if (m->is_made && m->is_bare == is_bare && m->has_march == view->air->has_march &&
        m->has_eclipse == view->air->has_eclipse && (m->has_moon || !has_moon) &&
        m->peaked_count == view->air->peaked_count) {
        return TRL_OK;
    }
    finish_programs(m);
    char peaked[32];
    snprintf(peaked, sizeof peaked, "PEAKED_COUNT %d", view->air->peaked_count);
    const char *const surface[] = {is_bare ? NULL : "SURFACE", NULL};
    const char *const filter[] = {"FILTER", is_bare ? NULL : "SURFACE", NULL};
    const char *const sharpen[] = {"SHARPEN", NULL};
    const char *const nothing[] = {NULL};
    const char *const moonlit[] = {peaked, "MOON", is_bare ? NULL : "SURFACE", NULL};
    const char *march[5] = {peaked};
    size_t count = 1;
    if (!is_bare) {
        march[count++] = "SURFACE";
    }
    if (view->air->has_march) {
        march[count++] = "MARCH";
    }
    if (view->air->has_eclipse) {
        march[count++] = "ECLIPSE";
    }
    trl_result result = make_program(m->gpu, "cloud/march.frag", march, &m->march);
    if (result == TRL_OK && has_moon) {
        result = make_program(m->gpu, "cloud/march.frag", moonlit, &m->moonlit);
    }
    if (result == TRL_OK) {
        result = make_program(m->gpu, "cloud/join.frag", filter, &m->filter);
    }
    if (result == TRL_OK) {
        result = make_program(m->gpu, "cloud/join.frag", sharpen, &m->sharpen);
    }
    if (result == TRL_OK) {
        result = make_program(m->gpu, "cloud/join.frag", surface, &m->join);
    }
    if (result == TRL_OK) {
        result = cloud_shade_make_programs(&m->shade, is_bare);
    }
    if (result == TRL_OK) {
        result = make_program(m->gpu, "cloud/hidden.frag", nothing, &m->find_hidden);
    }
    if (result == TRL_OK) {
        result = make_program(m->gpu, "cloud/gather.frag", surface, &m->history.gather);
    }
    m->is_bare = is_bare;
    m->has_march = view->air->has_march;
    m->has_eclipse = view->air->has_eclipse;
    m->has_moon = has_moon;
    m->peaked_count = view->air->peaked_count;
    m->is_made = result == TRL_OK;
    return result;
}

static trl_result fit_targets(struct cloud_march *m, const struct gpu_target *picture)
{
    if (m->width == picture->width && m->height == picture->height) {
        return TRL_OK;
    }
    finish_targets(m);
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.filter = GPU_FILTER_NEAREST;
    desc.format = GPU_FORMAT_RGBA32F;
    desc.width = (picture->width + 1) / 2;
    desc.height = (picture->height + 1) / 2;
    trl_result result = cloud_shade_resize(&m->shade, picture->width, picture->height);
    for (int i = 0; i < 2 && result == TRL_OK; i++) {
        result = cloud_rays_init(m->gpu, "clouds", desc.width, desc.height, &m->clouds[i]);
    }
    if (result == TRL_OK) {
        result = cloud_rays_init(m->gpu, "clouds joined", desc.width, desc.height, &m->joined);
    }
    desc.label = "clouds sharpened";
    if (result == TRL_OK) {
        result = gpu_target_init_texture(m->gpu, &desc, NULL, &m->sharpened, &m->sharpened_target);
    }
    desc.label = "hidden by clouds";
    desc.format = GPU_FORMAT_R8;
    desc.width = (picture->width + GPU_HIDE_SQUARE - 1) / GPU_HIDE_SQUARE;
    desc.height = (picture->height + GPU_HIDE_SQUARE - 1) / GPU_HIDE_SQUARE;
    if (result == TRL_OK) {
        result = gpu_target_init_texture(m->gpu, &desc, NULL, &m->hidden, &m->hidden_target);
    }
    if (result != TRL_OK) {
        finish_targets(m);
        return result;
    }
    m->width = picture->width;
    m->height = picture->height;
    return TRL_OK;
}

static void set_view(const struct cloud_view *view, struct gpu_program *program)
{
    const float picture[2] = {(float)view->target->width, (float)view->target->height};
    gpu_program_set_vec2(program, "u_picture", picture);
    if (view->position) {
        gpu_program_set_texture(program, "u_position", view->position);
    }
}

static trl_result prepare(struct cloud_march *m, const struct cloud_view *view)
{
    const trl_result result = make_programs(m, view);
    return result == TRL_OK ? fit_targets(m, view->target) : result;
}

// Whose light a pass is for.
static void bind_light(const struct cloud_view *view, bool is_moon, bool whole,
                       struct gpu_program *program)
{
    if (is_moon) {
        view->air->bind_moon(view->air->self, program);
    } else {
        view->air->bind(view->air->self, whole, program);
    }
}

static trl_result draw_deck(struct cloud_march *march, const struct cloud_view *view, bool is_moon)
{
    bind_light(view, is_moon, false, &march->deck.program);
    cloud_march_set_field(march, view->camera, &march->deck.program);
    return cloud_deck_draw(&march->deck);
}

trl_result cloud_march_deck(struct cloud_march *march, const struct cloud_view *view)
{
    trl_result result = prepare(march, view);
    if (result == TRL_OK) {
        result = cloud_deck_begin(&march->deck, march->field, view->camera);
    }
    return result == TRL_OK ? draw_deck(march, view, false) : result;
}

static void set_deck(const struct cloud_march *march, struct gpu_program *program)
{
    gpu_program_set_texture(program, "u_deck", &march->deck.map);
    gpu_program_set_vec4(program, "u_deck_map", march->deck.place);
}

trl_result cloud_march_shade(struct cloud_march *march, const struct cloud_view *view)
{
    struct cloud_shade *shade = &march->shade;
    set_view(view, &shade->sort);
    view->air->bind(view->air->self, false, &shade->sort);
    gpu_program_set_texture(&shade->sort, "u_hidden", &march->hidden);
    set_view(view, &shade->shade);
    bind_light(view, view->is_moonlit, false, &shade->shade);
    cloud_march_set_field(march, view->camera, &shade->shade);
    set_deck(march, &shade->shade);
    return cloud_shade_draw(shade);
}

// From pixels of 16 texels of the finest noise on less and less is spread, from 64 on nothing.
static float find_sharpness(const struct cloud_march *march, const struct cloud_view *view)
{
    const struct cloud_field *field = march->field;
    const double above_m = vec3_length(view->camera->position_m) - field->ground_radius_m -
                           cloud_field_highest_m(field);
    const double pixel_rad = 2 * view->camera->tan_half_fov_y / view->target->height;
    double scale_m = INFINITY;
    for (size_t i = 0; i < field->desc.layer_count; i++) {
        scale_m = fmin(scale_m, field->desc.layers[i].scale_m);
    }
    const double texels = above_m * pixel_rad / (scale_m / CLOUD_SIDE);
    return (float)fmax(0, fmin(1, (log(fmax(texels, 1)) / log(2) - 4) / 2));
}

// What cloud/parts.glsl asks for, to find where a pixel's ray ends.
static void set_ends(const struct cloud_march *march, const struct cloud_view *view,
                     struct gpu_program *program)
{
    view->air->bind(view->air->self, false, program);
    set_view(view, program);
    cloud_march_set_field(march, view->camera, program);
}

static void set_marched(const struct cloud_march *march, struct gpu_program *program)
{
    const struct cloud_rays *rays = &march->clouds[march->now];
    gpu_program_set_texture(program, "u_clouds", &rays->clouds);
    gpu_program_set_texture(program, "u_clouds_ends", &rays->ends);
}

static trl_result join_fours(struct cloud_march *march, const struct cloud_view *view)
{
    const struct gpu_pass filter = {.target = &march->joined.target};
    set_ends(march, view, &march->filter);
    set_marched(march, &march->filter);
    gpu_pass_begin(march->gpu, &filter);
    const trl_result result = gpu_draw_fullscreen(&march->filter, "clouds");
    if (result != TRL_OK) {
        return result;
    }
    const struct gpu_pass sharpen = {.target = &march->sharpened_target};
    gpu_program_set_texture(&march->sharpen, "u_joined", &march->joined.clouds);
    gpu_program_set_texture(&march->sharpen, "u_ends", &march->joined.ends);
    gpu_pass_begin(march->gpu, &sharpen);
    return gpu_draw_fullscreen(&march->sharpen, "clouds");
}

trl_result cloud_march_join(struct cloud_march *march, const struct cloud_view *view)
{
    const float sharpness = find_sharpness(march, view);
    const trl_result result = sharpness < 1 ? join_fours(march, view) : TRL_OK;
    if (result != TRL_OK) {
        return result;
    }
    const struct gpu_pass join = {.target = view->target,
                                  .state = {.blend = GPU_BLEND_PREMULTIPLIED}};
    set_ends(march, view, &march->join);
    set_marched(march, &march->join);
    gpu_program_set_texture(&march->join, "u_joined", &march->sharpened);
    gpu_program_set_texture(&march->join, "u_ends", &march->joined.ends);
    gpu_program_set_texture(&march->join, "u_hidden", &march->hidden);
    gpu_program_set_float(&march->join, "u_sharp", sharpness);
    gpu_pass_begin(march->gpu, &join);
    return gpu_draw_fullscreen(&march->join, "clouds");
}

static trl_result march_light(struct cloud_march *march, const struct cloud_view *view,
                              const float grid[3], const struct gpu_target *target, bool is_moon)
{
    struct gpu_program *program = is_moon ? &march->moonlit : &march->march;
    const struct gpu_pass clouds = {.target = target,
                                    .state.blend = is_moon ? GPU_BLEND_ADD : GPU_BLEND_NONE};
    bind_light(view, is_moon, true, program);
    cloud_march_set_field(march, view->camera, program);
    set_view(view, program);
    gpu_program_set_vec3(program, "u_grid", grid);
    gpu_program_set_float(program, "u_sharp", find_sharpness(march, view));
    set_deck(march, program);
    gpu_pass_begin(march->gpu, &clouds);
    return gpu_draw_fullscreen(program, "clouds");
}

// Marches all rays into the next texture, or a quarter of them into the history's. A moon's light
// is added, with a deck toward it, which is left to who lights ground by it.
static trl_result march_rays(struct cloud_march *march, const struct cloud_view *view,
                             const float grid[3], const struct gpu_target *target)
{
    trl_result result = march_light(march, view, grid, target, false);
    if (result == TRL_OK && view->air->bind_moon) {
        result = draw_deck(march, view, true);
        result = result == TRL_OK ? march_light(march, view, grid, target, true) : result;
        if (result == TRL_OK && !view->is_moonlit) {
            result = draw_deck(march, view, false);
        }
    }
    return result;
}

static trl_result accumulate(struct cloud_march *march, const struct cloud_view *view)
{
    struct cloud_history *history = &march->history;
    float grid[3];
    trl_result result = cloud_history_begin(march->gpu, history, &march->clouds[0], grid);
    if (result == TRL_OK) {
        result = march_rays(march, view, grid, &history->fresh.target);
    }
    if (result != TRL_OK) {
        return result;
    }
    const struct gpu_pass gather = {.target = &march->clouds[1 - march->now].target};
    set_ends(march, view, &history->gather);
    cloud_history_set(history, view->camera, grid, &march->clouds[march->now]);
    gpu_pass_begin(march->gpu, &gather);
    return gpu_draw_fullscreen(&history->gather, "clouds");
}

static trl_result find_hidden(struct cloud_march *march)
{
    const struct gpu_pass pass = {.target = &march->hidden_target};
    gpu_program_set_texture(&march->find_hidden, "u_clouds", &march->clouds[march->now].clouds);
    gpu_pass_begin(march->gpu, &pass);
    return gpu_draw_fullscreen(&march->find_hidden, "clouds");
}

trl_result cloud_march_draw(struct cloud_march *march, const struct cloud_view *view)
{
    trl_result result = TRL_OK;
    const struct cloud_moment moment = {view->camera, view->time_s,
                                        cloud_field_far_m(march->field, view->camera->position_m)};
    if (view->accumulates && cloud_history_holds(&march->history, &moment)) {
        result = accumulate(march, view);
    } else {
        result = march_rays(march, view, (const float[]){0, 0, 1},
                            &march->clouds[1 - march->now].target);
    }
    march->now = 1 - march->now;
    if (result != TRL_OK) {
        cloud_history_forget(&march->history);
        return result;
    }
    cloud_history_keep(&march->history, &moment);
    return find_hidden(march);
}
