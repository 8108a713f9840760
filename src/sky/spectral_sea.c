// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/spectral_sea.h"

#include "shared/sea.glsl"

#include <stdio.h>

void spectral_sea_init(const struct sky_desc *desc, struct spectral_sea *out)
{
    *out = (struct spectral_sea){.gpu = desc->gpu};
    sea_water_init(desc, &out->water);
}

void spectral_sea_drop(struct spectral_sea *sea)
{
    for (int i = 0; i < SEA_PROGRAMS; i++) {
        gpu_program_finish(&sea->programs[i]);
        sea->has_program[i] = false;
    }
    gpu_texture_finish(&sea->mirror);
    sea_water_drop(&sea->water); // its bands are the atmosphere's
    sea->has_mirror = false;
}

void spectral_sea_finish(struct spectral_sea *sea)
{
    spectral_sea_drop(sea);
    sea_water_finish(&sea->water);
    *sea = (struct spectral_sea){0};
}

static trl_result make_mirror(struct spectral_sea *sea, const struct atmosphere *a)
{
    const uint32_t size[3] = {SEA_LEVELS * SEA_MIRROR_AZIMUTHS, (uint32_t)a->table.size.suns,
                              SEA_MIRROR_VIEWS};
    float *texels =
        mem_alloc(a->ctx, (size_t)size[0] * size[1] * size[2] * BAND_COUNT, sizeof *texels);
    trl_result result = texels ? sea_mirror_make(a, sea->water.sea, texels) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = sky_make_map(sea->gpu, "mirrored sky", size, texels, &sea->mirror);
    }
    mem_free(a->ctx, texels);
    sea->has_mirror = result == TRL_OK;
    return result;
}

static trl_result make_program(struct spectral_sea *sea, const struct atmosphere *a,
                               unsigned shades)
{
    char peaked[32];
    snprintf(peaked, sizeof peaked, "PEAKED_COUNT %d", a->peaked.count);
    // What is added leaves the picture's alpha, as moonlight does.
    const char *defines[5] = {peaked, "SURFACE", "MOON"};
    size_t count = 3;
    if (shades & SEA_ECLIPSED) {
        defines[count++] = "ECLIPSE";
    }
    if (shades & SEA_CLOUDED) {
        defines[count++] = "CLOUDS";
    }
    const struct gpu_program_desc desc = {.vertex = "lib/layer.vert",
                                          .fragment = "sky/spectral/sea.frag",
                                          .defines = defines,
                                          .define_count = count};
    struct gpu_program *program = &sea->programs[shades];
    gpu_program_finish(program); // what an attempt that failed has left
    const trl_result result = gpu_program_init(sea->gpu, &desc, program);
    sea->has_program[shades] = result == TRL_OK;
    return result;
}

trl_result spectral_sea_prepare(struct spectral_sea *sea, const struct spectral_maps *maps,
                                const struct sky_view *view, unsigned shades)
{
    if (!sea_water_is_seen(&sea->water, view)) {
        return TRL_OK;
    }
    trl_result result = sea_water_prepare(&sea->water, sea->gpu, &maps->atmosphere->bands);
    if (result == TRL_OK && !sea->has_mirror) {
        result = make_mirror(sea, maps->atmosphere);
    }
    return result == TRL_OK && !sea->has_program[shades]
               ? make_program(sea, maps->atmosphere, shades)
               : result;
}

void spectral_sea_set(const struct spectral_sea *sea, const struct sky_view *view,
                      struct gpu_program *program)
{
    const float texel[2] = {1.0f / SEA_MIRROR_AZIMUTHS, 1.0f / SEA_MIRROR_VIEWS};
    sea_water_set(&sea->water, view, program);
    gpu_program_set_texture(program, "u_mirror", &sea->mirror);
    gpu_program_set_vec2(program, "u_mirror_texel", texel);
}
