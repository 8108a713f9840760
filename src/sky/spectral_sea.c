// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/spectral_sea.h"

#include "shared/sea.glsl"
#include "shared/sky_map.glsl"

#include <math.h>
#include <stdio.h>
#include <string.h>

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
    memset(sea->has_sun, 0, sizeof sea->has_sun);
    sea_water_drop(&sea->water); // its bands are the atmosphere's
}

void spectral_sea_finish(struct spectral_sea *sea)
{
    spectral_sea_drop(sea);
    sea_water_finish(&sea->water);
    *sea = (struct spectral_sea){0};
}

// Waves are no higher.
static const double WAVES_M = 50;

// The suns of the table between which a view sees water under a light.
struct suns {
    int first, last;
};

static struct suns find_suns(const struct atmosphere *a, const struct sky_view *view,
                             struct vec3 light)
{
    const struct table *t = &a->table;
    const struct vec3 eye_m = view->camera->position_m;
    const double mu = vec3_dot(vec3_normalize(eye_m), light);
    const double angle = acos(fmin(fmax(mu, -1), 1));
    const double reach =
        sky_reach_rad(a->optics->ground_radius_m, vec3_length(eye_m), view->highest_m + WAVES_M);
    const double lowest = sky_map_sun(cos(fmin(angle + reach, M_PI)), t->sun_centre, t->sun_width,
                                      t->sun_first, t->sun_last);
    const double highest = sky_map_sun(cos(fmax(angle - reach, 0)), t->sun_centre, t->sun_width,
                                       t->sun_first, t->sun_last);
    return (struct suns){.first = table_cell_at(lowest, t->size.suns).below,
                         .last = table_cell_at(highest, t->size.suns).below + 1};
}

static trl_result fill_suns(struct spectral_sea *sea, const struct atmosphere *a, int first,
                            int count)
{
    const struct gpu_region region = {
        .y = (uint32_t)first,
        .width = sea->mirror.width,
        .height = (uint32_t)count,
        .depth = sea->mirror.depth,
    };
    const size_t texels = (size_t)region.width * region.height * region.depth;
    float *light = mem_alloc(a->ctx, texels * BAND_COUNT, sizeof *light);
    trl_result result =
        light ? sea_mirror_make(a, sea->water.sea, first, count, light) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = gpu_texture_upload(&sea->mirror, &region, light);
    }
    mem_free(a->ctx, light);
    for (int i = 0; i < count && result == TRL_OK; i++) {
        sea->has_sun[first + i] = true;
    }
    return result;
}

// From the ground two of the table's suns are looked up, from far away all: a sun takes as long as
// the rest of a small picture.
static trl_result fit_mirror(struct spectral_sea *sea, const struct atmosphere *a,
                             const struct suns *suns)
{
    const uint32_t size[3] = {SEA_LEVELS * SEA_MIRROR_AZIMUTHS, (uint32_t)a->table.size.suns,
                              SEA_MIRROR_VIEWS};
    trl_result result = TRL_OK;
    if (!sea->mirror.name) {
        result = sky_make_map(sea->gpu, "mirrored sky", size, NULL, &sea->mirror);
    }
    for (int i = suns->first; i <= suns->last && result == TRL_OK; i++) {
        const int first = i;
        while (i <= suns->last && !sea->has_sun[i]) {
            i++;
        }
        result = i > first ? fill_suns(sea, a, first, i - first) : TRL_OK;
    }
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
                                const struct sky_view *view, struct vec3 light, unsigned shades)
{
    if (!sea_water_is_seen(&sea->water, view)) {
        return TRL_OK;
    }
    trl_result result = sea_water_prepare(&sea->water, sea->gpu, &maps->atmosphere->bands);
    if (result == TRL_OK) {
        const struct suns suns = find_suns(maps->atmosphere, view, light);
        result = fit_mirror(sea, maps->atmosphere, &suns);
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
