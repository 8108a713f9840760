// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/sea_water.h"

#include "shared/sea.glsl"
#include "sky/sea_volume.h"

#include <math.h>

void sea_water_init(const struct sky_desc *desc, struct sea_water *out)
{
    *out = (struct sea_water){.sea = desc->sea && desc->sea->is_there ? desc->sea : NULL,
                              .disc_slope = sea_disc_slope(desc->medium->star_angular_radius_rad)};
}

void sea_water_drop(struct sea_water *water)
{
    gpu_texture_finish(&water->texture);
    gpu_texture_finish(&water->volume);
}

void sea_water_finish(struct sea_water *water)
{
    sea_water_drop(water);
    reflection_finish(&water->reflection);
    *water = (struct sea_water){0};
}

bool sea_water_is_seen(const struct sea_water *water, const struct sky_view *view)
{
    return water->sea && !sky_view_is_bare(view);
}

enum { VIEWS = 64 };

static void fill(const struct sky_sea *sea, float *surface)
{
    for (int i = 0; i < SEA_LEVELS * VIEWS; i++) {
        const struct sky_sea rough = sea_at_level(sea, i / VIEWS);
        const double root = fmax((double)(i % VIEWS) / (VIEWS - 1), 0.02);
        double mirror_mu;
        surface[i * BAND_COUNT] = (float)sea_surface_reflectance(&rough, root * root, &mirror_mu);
        surface[i * BAND_COUNT + 1] = (float)mirror_mu;
    }
}

trl_result sea_water_prepare(struct sea_water *water, struct gpu *gpu, const struct bands *bands)
{
    if (!water->sea || water->texture.name) {
        return TRL_OK;
    }
    float texels[SEA_LEVELS * VIEWS * BAND_COUNT] = {0};
    fill(water->sea, texels);
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "surface of water";
    desc.format = GPU_FORMAT_RGBA16F;
    desc.width = VIEWS;
    desc.height = SEA_LEVELS;
    desc.data = texels;
    trl_result result = sea_volume_make(gpu, water->sea->volume, bands, &water->volume);
    result = result == TRL_OK ? gpu_texture_init(gpu, &desc, &water->texture) : result;
    if (result != TRL_OK) {
        sea_water_drop(water);
    }
    return result;
}

// Ground that does not rise above the water is mirrored by none.
static bool has_reflection(const struct sky_view *view)
{
    return view->highest_m > 0.1;
}

static void find_surface(const struct sea_water *water, float surface[3])
{
    const struct sky_sea *s = water->sea;
    surface[0] = (float)fmax(s->mean_square_slope + water->disc_slope, 1e-6);
    surface[1] = (float)s->index;
    surface[2] = (float)water->disc_slope;
}

trl_result sea_water_reflect(struct sea_water *water, const struct sky_pixels *pixels,
                             const struct sky_view *view)
{
    if (!has_reflection(view)) {
        return TRL_OK;
    }
    float surface[3];
    find_surface(water, surface);
    return reflection_draw(&water->reflection, pixels, view, surface);
}

void sea_water_set(const struct sea_water *water, const struct sky_view *view,
                   struct gpu_program *program)
{
    float surface[3];
    find_surface(water, surface);
    const float critical = (float)water->sea->volume->critical;
    const float volume[4] = {critical, (float)(SKY_SEA_ANGLES - 1) / (1 - critical),
                             sqrtf(1 - critical * critical), 1.0f / SKY_SEA_DEPTHS};
    gpu_program_set_texture(program, "u_water", &water->texture);
    gpu_program_set_texture(program, "u_sea_volume", &water->volume);
    gpu_program_set_vec4(program, "u_sea_volume_map", volume);
    gpu_program_set_float(program, "u_shadowed", view->is_added == view->moon.is_main ? 1 : 0);
    gpu_program_set_float(program, "u_sea_texel", 1.0f / VIEWS);
    gpu_program_set_texture(program, "u_facets", view->surface.facets);
    gpu_program_set_vec3(program, "u_sea", surface);
    // Of the light that is added later only the sky's is left out: terrain is mirrored once.
    const bool is_mirrored = has_reflection(view) && water->reflection.texture.name;
    const float share[2] = {is_mirrored ? 1 : 0, is_mirrored && !view->is_added ? 1 : 0};
    gpu_program_set_vec2(program, "u_reflected", share);
    gpu_program_set_texture(program, "u_reflection",
                            is_mirrored ? &water->reflection.texture : view->surface.albedo);
}
