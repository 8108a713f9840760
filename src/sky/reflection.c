// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/reflection.h"

enum {
    SQUARE = 4, // pixels a side of the next larger square
    LEVELS = 4, // sizes of squares
    LAND_WIDTH = 4,
    LAND_ROWS = 32 // of rectangles with the land's mean, in the picture
};

static void finish_targets(struct reflection *r)
{
    gpu_target_finish(&r->nearest_target);
    gpu_target_finish(&r->near_target);
    gpu_target_finish(&r->land_target);
    gpu_target_finish(&r->single_target);
    gpu_target_finish(&r->target);
    gpu_texture_finish(&r->nearest);
    gpu_texture_finish(&r->near);
    gpu_texture_finish(&r->land);
    gpu_texture_finish(&r->single);
    gpu_texture_finish(&r->weight);
    gpu_texture_finish(&r->texture);
    r->width = r->height = 0;
}

static void finish_programs(struct reflection *r)
{
    gpu_program_finish(&r->from_surface);
    gpu_program_finish(&r->from_nearest);
    gpu_program_finish(&r->seen);
    gpu_condition_finish(&r->has_land);
    gpu_program_finish(&r->land_of);
    gpu_program_finish(&r->follow);
    gpu_program_finish(&r->filter);
}

void reflection_finish(struct reflection *reflection)
{
    finish_targets(reflection);
    finish_programs(reflection);
    *reflection = (struct reflection){0};
}

static trl_result fit_programs(struct reflection *r, struct gpu *gpu)
{
    if (r->filter.name) {
        return TRL_OK;
    }
    static const char *const surface[] = {"SURFACE"}, *const seen[] = {"SEEN"};
    struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                    .fragment = "sky/reflection_near.frag",
                                    .defines = surface};
    finish_programs(r); // what an attempt that failed has left
    trl_result result = gpu_program_init(gpu, &desc, &r->from_nearest);
    desc.define_count = 1;
    if (result == TRL_OK) {
        result = gpu_program_init(gpu, &desc, &r->from_surface);
    }
    desc.defines = seen;
    if (result == TRL_OK) {
        result = gpu_program_init(gpu, &desc, &r->seen);
    }
    if (result == TRL_OK) {
        result = gpu_condition_init(gpu, &r->has_land);
    }
    desc.fragment = "sky/reflection_land.frag";
    desc.define_count = 0;
    if (result == TRL_OK) {
        result = gpu_program_init(gpu, &desc, &r->land_of);
    }
    desc.fragment = "sky/reflection.frag";
    if (result == TRL_OK) {
        result = gpu_program_init(gpu, &desc, &r->follow);
    }
    desc.fragment = "sky/reflection_filter.frag";
    return result == TRL_OK ? gpu_program_init(gpu, &desc, &r->filter) : result;
}

static trl_result make_target(struct gpu *gpu, struct gpu_texture *textures[2],
                              struct gpu_texture_desc *desc, struct gpu_target *target)
{
    struct gpu_target_desc colors = {.label = desc->label};
    trl_result result = TRL_OK;
    for (int i = 0; i < 2 && textures[i] && result == TRL_OK; i++) {
        colors.colors[colors.color_count++].texture = textures[i];
        result = gpu_texture_init(gpu, desc, textures[i]);
        desc->format = GPU_FORMAT_R32F; // of a second one
    }
    return result == TRL_OK ? gpu_target_init(gpu, &colors, target) : result;
}

static uint32_t count_squares(uint32_t pixels)
{
    return (pixels + SQUARE - 1) / SQUARE;
}

// Where squares of 4^level pixels are in `near`: sky/reflection.frag knows it too. The larger ones
// lie in a row above the pixels.
static struct gpu_rect find_squares(const struct reflection *r, int level)
{
    struct gpu_rect rect = {0, 0, r->width, r->height};
    for (int i = 0; i < level; i++) {
        rect.x += i > 0 ? rect.width : 0;
        rect.y = r->height;
        rect.width = count_squares(rect.width);
        rect.height = count_squares(rect.height);
    }
    return rect;
}

static trl_result make_near(struct reflection *r, struct gpu *gpu)
{
    const struct gpu_rect last = find_squares(r, LEVELS - 1);
    struct gpu_texture *nearest[2] = {&r->nearest}, *near[2] = {&r->near};
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "nearest land";
    desc.format = GPU_FORMAT_R32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = count_squares(r->width);
    desc.height = count_squares(r->height);
    const trl_result result = make_target(gpu, nearest, &desc, &r->nearest_target);
    desc.height += r->height;
    desc.width = last.x + last.width > r->width ? last.x + last.width : r->width;
    return result == TRL_OK ? make_target(gpu, near, &desc, &r->near_target) : result;
}

static uint32_t find_land_height(const struct reflection *r)
{
    return (r->height + LAND_ROWS - 1) / LAND_ROWS;
}

static trl_result make_mirrored(struct reflection *r, struct gpu *gpu)
{
    struct gpu_texture *land[2] = {&r->land}, *single[2] = {&r->single, &r->weight},
                       *texture[2] = {&r->texture};
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "radiance of land";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = (r->width + LAND_WIDTH - 1) / LAND_WIDTH;
    desc.height = (r->height + find_land_height(r) - 1) / find_land_height(r);
    trl_result result = make_target(gpu, land, &desc, &r->land_target);
    desc.label = "reflection";
    desc.width = (r->width + 1) / 2;
    desc.height = (r->height + 1) / 2;
    desc.format = GPU_FORMAT_RGBA32F;
    if (result == TRL_OK) {
        result = make_target(gpu, single, &desc, &r->single_target);
    }
    desc.format = GPU_FORMAT_RGBA32F;
    return result == TRL_OK ? make_target(gpu, texture, &desc, &r->target) : result;
}

static trl_result fit_targets(struct reflection *r, struct gpu *gpu, const struct gpu_target *shown)
{
    if (r->width == shown->width && r->height == shown->height) {
        return TRL_OK;
    }
    finish_targets(r);
    r->width = shown->width;
    r->height = shown->height;
    trl_result result = make_near(r, gpu);
    if (result == TRL_OK) {
        result = make_mirrored(r, gpu);
    }
    if (result != TRL_OK) {
        finish_targets(r);
    }
    return result;
}

// What a pass finds the nearest land of: squares of a texture, of which each texel takes `side` a
// side.
struct squares {
    const struct gpu_texture *texture;
    struct gpu_rect rect;
    uint32_t side;
};

static trl_result draw_squares(struct gpu_program *program, const struct squares *from,
                               const struct gpu_target *target, struct gpu_rect rect)
{
    const float square[3] = {(float)rect.x, (float)rect.y, (float)from->side};
    const struct gpu_pass pass = {.target = target, .viewport = rect};
    if (from->texture) {
        const float source[4] = {(float)from->rect.x, (float)from->rect.y, (float)from->rect.width,
                                 (float)from->rect.height};
        gpu_program_set_texture(program, "u_nearest", from->texture);
        gpu_program_set_vec4(program, "u_source", source);
    }
    gpu_program_set_vec3(program, "u_square", square);
    gpu_pass_begin(program->gpu, &pass);
    return gpu_draw_fullscreen(program, "nearest land");
}

// Pixels from the surface; squares of 4 from those, in a texture of their own, since `near` is
// read; the others from these.
static trl_result draw_nearest(struct reflection *r, const struct sky_view *view)
{
    const struct squares surface = {.side = 1};
    const struct squares pixels = {&r->near, find_squares(r, 0), SQUARE};
    const struct gpu_rect fours = {0, 0, r->nearest.width, r->nearest.height};
    gpu_program_set_texture(&r->from_surface, "u_position", view->surface.position);
    gpu_program_set_texture(&r->from_surface, "u_kinds", view->surface.kinds);
    gpu_program_set_texture(&r->from_surface, "u_albedo", view->surface.albedo);
    sky_set_vec3(&r->from_surface, "u_forward", view->camera->forward);
    trl_result result =
        draw_squares(&r->from_surface, &surface, &r->near_target, find_squares(r, 0));
    if (result == TRL_OK) {
        result = draw_squares(&r->from_nearest, &pixels, &r->nearest_target, fours);
    }
    struct squares from = {&r->nearest, fours, 1};
    for (int level = 1; level < LEVELS && result == TRL_OK; level++) {
        result = draw_squares(&r->from_nearest, &from, &r->near_target, find_squares(r, level));
        from.side *= SQUARE;
    }
    return result;
}

// Counts the largest squares that have land. What is drawn is not looked at.
static trl_result look_for_land(struct reflection *r)
{
    const struct squares largest = {&r->near, find_squares(r, LEVELS - 1), 1};
    const struct gpu_rect rect = {0, 0, largest.rect.width, largest.rect.height};
    gpu_condition_count(&r->has_land);
    const trl_result result = draw_squares(&r->seen, &largest, &r->nearest_target, rect);
    gpu_condition_counted(&r->has_land);
    return result;
}

static trl_result draw_land(struct reflection *r, const struct sky_view *view)
{
    const float picture[4] = {(float)r->width, (float)r->height, LAND_WIDTH,
                              (float)find_land_height(r)};
    const struct gpu_pass pass = {.target = &r->land_target};
    gpu_program_set_texture(&r->land_of, "u_radiance", view->target->colors[0].texture);
    gpu_program_set_texture(&r->land_of, "u_near", &r->near);
    gpu_program_set_vec4(&r->land_of, "u_picture", picture);
    gpu_pass_begin(r->land_of.gpu, &pass);
    return gpu_draw_fullscreen(&r->land_of, "radiance of land");
}

static trl_result draw_mirrored(struct reflection *r, const struct sky_pixels *pixels,
                                const struct sky_view *view, const float sea[3])
{
    struct gpu_program *program = &r->follow;
    sky_pixels_set_view(pixels, program, view);
    gpu_program_set_texture(program, "u_position", view->surface.position);
    gpu_program_set_texture(program, "u_albedo", view->surface.albedo);
    gpu_program_set_texture(program, "u_radiance", view->target->colors[0].texture);
    const float rectangle[2] = {LAND_WIDTH, (float)find_land_height(r)};
    gpu_program_set_texture(program, "u_near", &r->near);
    gpu_program_set_texture(program, "u_land", &r->land);
    gpu_program_set_vec2(program, "u_rectangle", rectangle);
    gpu_program_set_texture(program, "u_facets", view->surface.facets);
    gpu_program_set_vec3(program, "u_sea", sea);
    const struct gpu_pass pass = {.target = &r->single_target};
    gpu_pass_begin(pixels->gpu, &pass);
    return gpu_draw_fullscreen(program, "mirrored terrain");
}

static trl_result draw_filtered(struct reflection *r, const struct sky_pixels *pixels,
                                const struct sky_view *view)
{
    struct gpu_program *program = &r->filter;
    sky_pixels_set_view(pixels, program, view);
    gpu_program_set_texture(program, "u_reflection", &r->single);
    gpu_program_set_texture(program, "u_weight", &r->weight);
    gpu_program_set_texture(program, "u_facets", view->surface.facets);
    const struct gpu_pass pass = {.target = &r->target};
    gpu_pass_begin(pixels->gpu, &pass);
    return gpu_draw_fullscreen(program, "mirrored terrain by all facets");
}

static trl_result draw_land_mirrored(struct reflection *r, const struct sky_pixels *pixels,
                                     const struct sky_view *view, const float sea[3])
{
    trl_result result = draw_land(r, view);
    if (result == TRL_OK) {
        result = draw_mirrored(r, pixels, view, sea);
    }
    return result == TRL_OK ? draw_filtered(r, pixels, view) : result;
}

// As where no pixel has water.
static void draw_nothing(struct reflection *r, struct gpu *gpu)
{
    const struct gpu_pass pass = {
        .target = &r->target, .clears_color = true, .color = {0, 0, 0, -1}};
    gpu_pass_begin(gpu, &pass);
}

trl_result reflection_draw(struct reflection *reflection, const struct sky_pixels *pixels,
                           const struct sky_view *view, const float sea[3])
{
    trl_result result = fit_programs(reflection, pixels->gpu);
    if (result == TRL_OK) {
        result = fit_targets(reflection, pixels->gpu, view->target);
    }
    if (result != TRL_OK) {
        return result;
    }
    draw_nothing(reflection, pixels->gpu);
    gpu_condition_begin(view->surface.has_water);
    result = draw_nearest(reflection, view);
    if (result == TRL_OK) {
        result = look_for_land(reflection);
    }
    gpu_condition_end(view->surface.has_water);
    gpu_condition_begin(&reflection->has_land);
    result = result == TRL_OK ? draw_land_mirrored(reflection, pixels, view, sea) : result;
    gpu_condition_end(&reflection->has_land);
    return result;
}
