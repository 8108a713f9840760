// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/spectral_sea.h"

#include "shared/sea.glsl"

#include <math.h>
#include <stdio.h>

void spectral_sea_init(const struct sky_desc *desc, struct spectral_sea *out)
{
    const bool is_there = desc->sea && desc->sea->is_there;
    *out =
        (struct spectral_sea){.gpu = desc->gpu,
                              .sea = is_there ? desc->sea : NULL,
                              .disc_slope = sea_disc_slope(desc->medium->star_angular_radius_rad)};
}

void spectral_sea_drop(struct spectral_sea *sea)
{
    for (int i = 0; i < 2; i++) {
        gpu_program_finish(&sea->programs[i]);
        sea->has_program[i] = false;
    }
    gpu_texture_finish(&sea->mirror);
    gpu_texture_finish(&sea->water);
    sea->has_textures = false;
}

void spectral_sea_finish(struct spectral_sea *sea)
{
    spectral_sea_drop(sea);
    *sea = (struct spectral_sea){0};
}

bool spectral_sea_is_seen(const struct spectral_sea *sea, const struct sky_view *view)
{
    return sea->sea && !sky_view_is_bare(view);
}

static void fill_water(const struct sky_sea *sea, const struct bands *bands, float *texels)
{
    for (int i = 0; i < SKY_SEA_DEPTHS; i++) {
        for (int b = 0; b < BAND_COUNT; b++) {
            float sum = 0;
            for (int k = 0; k < 3; k++) {
                sum += bands->bands_from_rgb[b][k] * sea->water[i][k];
            }
            texels[i * BAND_COUNT + b] = fmaxf(sum, 0);
        }
    }
    float *reflectance = texels + SKY_SEA_DEPTHS * BAND_COUNT;
    for (int i = 0; i < SKY_SEA_DEPTHS; i++) {
        const double root = fmax((double)i / (SKY_SEA_DEPTHS - 1), 0.02);
        reflectance[i * BAND_COUNT] = (float)sea_surface_reflectance(sea, root * root);
    }
}

static trl_result make_textures(struct spectral_sea *sea, const struct spectral_maps *maps)
{
    const struct atmosphere *a = maps->atmosphere;
    const uint32_t mirror[3] = {SEA_MIRROR_AZIMUTHS, (uint32_t)a->table.size.suns,
                                SEA_MIRROR_VIEWS};
    const uint32_t water[3] = {SKY_SEA_DEPTHS, 2, 1};
    float water_texels[2 * SKY_SEA_DEPTHS * BAND_COUNT] = {0};
    float *texels =
        mem_alloc(a->ctx, (size_t)mirror[0] * mirror[1] * mirror[2] * BAND_COUNT, sizeof *texels);
    trl_result result = texels ? sea_mirror_make(a, sea->sea, texels) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = sky_make_map(sea->gpu, "mirrored sky", mirror, texels, &sea->mirror);
    }
    mem_free(a->ctx, texels);
    if (result == TRL_OK) {
        fill_water(sea->sea, &a->bands, water_texels);
        result = sky_make_map(sea->gpu, "water", water, water_texels, &sea->water);
    }
    sea->has_textures = result == TRL_OK;
    return result;
}

static trl_result make_program(struct spectral_sea *sea, const struct spectral_maps *maps,
                               bool has_eclipse)
{
    char peaked[32];
    snprintf(peaked, sizeof peaked, "PEAKED_COUNT %d", maps->atmosphere->peaked.count);
    const char *const defines[] = {peaked, "SURFACE", "ECLIPSE"};
    const struct gpu_program_desc desc = {.vertex = "sky/layer.vert",
                                          .fragment = "sky/spectral/sea.frag",
                                          .defines = defines,
                                          .define_count = has_eclipse ? 3 : 2};
    struct gpu_program *program = &sea->programs[has_eclipse];
    gpu_program_finish(program); // what an attempt that failed has left
    const trl_result result = gpu_program_init(sea->gpu, &desc, program);
    sea->has_program[has_eclipse] = result == TRL_OK;
    return result;
}

trl_result spectral_sea_prepare(struct spectral_sea *sea, const struct spectral_maps *maps,
                                const struct sky_view *view, bool has_eclipse)
{
    if (!spectral_sea_is_seen(sea, view)) {
        return TRL_OK;
    }
    const trl_result result = sea->has_textures ? TRL_OK : make_textures(sea, maps);
    return result == TRL_OK && !sea->has_program[has_eclipse] ? make_program(sea, maps, has_eclipse)
                                                              : result;
}

void spectral_sea_set(const struct spectral_sea *sea, struct gpu_program *program, bool is_shadowed)
{
    const struct sky_sea *s = sea->sea;
    gpu_program_set_texture(program, "u_mirror", &sea->mirror);
    gpu_program_set_texture(program, "u_water", &sea->water);
    gpu_program_set_float(program, "u_shadowed", is_shadowed ? 1 : 0);
    sky_set_vec4(program, "u_sea", fmax(s->mean_square_slope + sea->disc_slope, 1e-6), s->index,
                 s->white_share, s->white_albedo);
    sky_set_vec3(
        program, "u_sea_texel",
        (struct vec3){1.0 / SEA_MIRROR_AZIMUTHS, 1.0 / SEA_MIRROR_VIEWS, 1.0 / SKY_SEA_DEPTHS});
}
