// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/open_sea.h"

#include "gpu/hide.h"
#include "shared/blend.glsl"

#include <math.h>

// Cubic heights and linear masks have something of a shore as far as two texels off; two such
// lengths, since a texel of a mean may lie half beside.
static const double SHORE_TEXELS = 4;

trl_result terrain_open_sea_init(const struct surface *surface, struct terrain_open_sea *out)
{
    *out = (struct terrain_open_sea){.gpu = surface->gpu, .surface = surface};
    struct surface_defines defines;
    surface_get_defines(surface, 0, &defines);
    defines.count -= noise_is_there(&surface->noise) ? 1 : 0; // it is the last
    const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                          .fragment = "terrain/open_sea.frag",
                                          .defines = defines.list,
                                          .define_count = defines.count};
    return gpu_program_init(surface->gpu, &desc, &out->program);
}

static void finish_squares(struct terrain_open_sea *open)
{
    gpu_target_finish(&open->target);
    gpu_texture_finish(&open->squares);
}

void terrain_open_sea_finish(struct terrain_open_sea *open)
{
    finish_squares(open);
    gpu_program_finish(&open->program);
    *open = (struct terrain_open_sea){0};
}

trl_result terrain_open_sea_resize(struct terrain_open_sea *open, const struct gpu_texture *depth)
{
    finish_squares(open);
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "open sea";
    desc.format = GPU_FORMAT_R8;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = (depth->width + GPU_HIDE_SQUARE - 1) / GPU_HIDE_SQUARE;
    desc.height = (depth->height + GPU_HIDE_SQUARE - 1) / GPU_HIDE_SQUARE;
    return gpu_target_init_texture(open->gpu, &desc, NULL, &open->squares, &open->target);
}

// That of the coarsest heights and masks in view, m; 0: there is bed among them, or no mask, or
// what is laid over.
static double find_shores_m(const struct surface *surface,
                            const struct surface_selection *selection)
{
    static const enum surface_kind KINDS[] = {SURFACE_ELEVATION, SURFACE_WATER};
    double shores_m = 0;
    bool is_simple = selection->counts[SURFACE_WATER] > 0 && surface->counts[SURFACE_NORMAL] == 0;
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k++) {
        for (size_t i = 0; i < selection->counts[KINDS[k]]; i++) {
            const struct terrain_layer *layer =
                &surface->layers[KINDS[k]][selection->indices[KINDS[k]][i]];
            const double texel_m = layer_finest_frame(layer)->texel_height * surface->radius_m;
            shores_m = fmax(shores_m, SHORE_TEXELS * texel_m);
            is_simple = is_simple && layer->mode == BLEND_OVER && !layer->heights.has_bed;
        }
    }
    return is_simple ? shores_m : 0;
}

trl_result terrain_open_sea_find(struct terrain_open_sea *open,
                                 const struct terrain_compose_inputs *inputs,
                                 const struct gpu_texture **out)
{
    const struct terrain_compose_scope scope = terrain_compose_find_scope(open->surface, inputs);
    const double shores_m = find_shores_m(open->surface, &scope.selection);
    *out = NULL;
    if (open->surface->is_invented || !scope.has_noise || shores_m == 0) {
        return TRL_OK;
    }
    terrain_compose_bind_scope(open->surface, inputs, &scope, &open->program);
    gpu_program_set_float(&open->program, "u_shores", (float)log2(shores_m));
    const struct gpu_pass pass = {.target = &open->target};
    gpu_pass_begin(open->gpu, &pass);
    const trl_result result = gpu_draw_fullscreen(&open->program, "open sea");
    *out = result == TRL_OK ? &open->squares : NULL;
    return result;
}
