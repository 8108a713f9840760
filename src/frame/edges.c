// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/edges.h"

#include <math.h>

static trl_result make_program(struct gpu *gpu, const char *vertex, const char *fragment,
                               bool has_surface, struct gpu_program *out)
{
    const char *const defines[] = {"SURFACE"};
    const struct gpu_program_desc desc = {.vertex = vertex,
                                          .fragment = fragment,
                                          .defines = defines,
                                          .define_count = has_surface ? 1 : 0};
    return gpu_program_init(gpu, &desc, out);
}

trl_result edges_init(struct gpu *gpu, struct edges *out)
{
    *out = (struct edges){.gpu = gpu};
    trl_result result =
        make_program(gpu, "lib/layer.vert", "frame/edges_copy.frag", false, &out->copy);
    for (int i = 0; i < 2 && result == TRL_OK; i++) {
        result = make_program(gpu, "lib/layer.vert", "frame/edges_mark.frag", i, &out->mark[i]);
        if (result == TRL_OK) {
            result =
                make_program(gpu, "lib/layer.vert", "frame/edges_blend.frag", i, &out->blend[i]);
        }
    }
    if (result != TRL_OK) {
        edges_finish(out);
    }
    return result;
}

void edges_finish(struct edges *edges)
{
    edges_forget(edges);
    for (int i = 0; i < 2; i++) {
        gpu_program_finish(&edges->mark[i]);
        gpu_program_finish(&edges->blend[i]);
    }
    gpu_program_finish(&edges->copy);
    *edges = (struct edges){0};
}

void edges_forget(struct edges *edges)
{
    gpu_target_finish(&edges->target);
    gpu_texture_finish(&edges->blended);
}

trl_result edges_resize(struct edges *edges, const struct gpu_texture *depth)
{
    edges_forget(edges);
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "edges";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = depth->width;
    desc.height = depth->height;
    return gpu_target_init_texture(edges->gpu, &desc, depth, &edges->blended, &edges->target);
}

static void set_ground(const struct edges_source *source, struct gpu_program *program)
{
    const struct sky_view *view = source->view;
    if (sky_view_is_bare(view)) {
        const struct sky_pixels sphere = {.ground_radius_m = source->ground_radius_m,
                                          .top_radius_m = source->top_radius_m};
        sky_pixels_set_view(&sphere, program, view);
    } else {
        gpu_program_set_texture(program, "u_position", view->surface.position);
    }
    const float size[2] = {(float)view->target->width, (float)view->target->height};
    gpu_program_set_vec2(program, "u_size", size);
    gpu_program_set_float(program, "u_depth", 0.5f);
}

// From all where a pixel at the horizon is no wider than the glow, to nothing at twice that.
static double find_strength(const struct edges_source *source)
{
    const struct camera *camera = source->view->camera;
    const double r = vec3_length(camera->position_m);
    const double ground = source->ground_radius_m;
    const double distance_m = sqrt(fmax(0, (r - ground) * (r + ground)));
    const double pixel_m = distance_m * 2 * camera->tan_half_fov_y / source->view->target->height;
    return source->glow_m > 0 ? fmax(0, fmin(1, 2 - pixel_m / source->glow_m)) : 1;
}

static trl_result draw(const struct edges *edges, const struct gpu_pass *pass,
                       struct gpu_program *program)
{
    gpu_pass_begin(edges->gpu, pass);
    return gpu_draw_fullscreen(program, "edges");
}

trl_result edges_draw(struct edges *edges, const struct edges_source *source)
{
    const struct sky_view *view = source->view;
    struct gpu_program *mark = &edges->mark[!sky_view_is_bare(view)];
    struct gpu_program *blend = &edges->blend[!sky_view_is_bare(view)];
    const struct gpu_pass marks = {.target = view->target,
                                   .state = {.writes_depth = true, .hides_color = true}};
    const struct gpu_pass apart = {.target = &edges->target, .state.depth = GPU_DEPTH_FARTHER};
    const struct gpu_pass back = {.target = view->target, .state.depth = GPU_DEPTH_FARTHER};
    set_ground(source, mark);
    trl_result result = draw(edges, &marks, mark);
    if (result == TRL_OK) {
        set_ground(source, blend);
        gpu_program_set_texture(blend, "u_radiance", source->radiance);
        gpu_program_set_float(blend, "u_strength", (float)find_strength(source));
        result = draw(edges, &apart, blend);
    }
    if (result == TRL_OK) {
        gpu_program_set_float(&edges->copy, "u_depth", 0.5f);
        gpu_program_set_texture(&edges->copy, "u_blended", &edges->blended);
        result = draw(edges, &back, &edges->copy);
    }
    return result;
}
