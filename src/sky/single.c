// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The model of Schafhitzel, Falk and Ertl 2007: one scattering, tabulated once for all eyes and
// suns (scatter/single.h), looked up per pixel. Nothing is computed for a frame.
//
//     scattered  3D RGBA32F  view x sun x height, light from there to the ray's end: linear sRGB,
//                            one texture for each phase function, which is left out
//     depth      2D RGBA32F  view x height, optical depth to the top
//     light      2D RGBA32F  sun x height, direct light
//     medium     2D RGBA32F  height x (extinction, scattering of each channel), per m
//     phase      2D RGBA32F  sine of half the angle, the phase functions of the channels
//
// Depth, light and medium are in four bands per unit irradiance of the star (scatter/bands.h).
#include "scatter/single.h"
#include "sky/pixels.h"
#include "sky/sea_water.h"
#include "sky/single_spheres.h"

#include <math.h>
#include <stdio.h>

enum { PHASE_SAMPLES = 1024 };

struct single {
    const trl_context *ctx;
    struct gpu *gpu;
    struct optics *optics;       // owned
    struct single_tables tables; // its texels are freed once they are on the GPU
    struct sky_pixels pixels;
    struct gpu_program air, star, ground_bare, ground_surface, sea;
    struct sea_water water;
    struct gpu_texture scattered[SINGLE_CHANNELS];
    struct gpu_texture depth, light, medium, phase;
    struct single_spheres spheres; // when they are asked for
};

static const char *const SCATTERED_NAMES[] = {"u_scattered0", "u_scattered1", "u_scattered2",
                                              "u_scattered3"};

// Over the sine of half the angle, which spreads the forward peak.
static trl_result make_phase(struct single *sky)
{
    float *texels = mem_alloc(sky->ctx, PHASE_SAMPLES * 4, sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    for (int s = 0; s < PHASE_SAMPLES; s++) {
        const double x = (double)s / (PHASE_SAMPLES - 1);
        for (int c = 0; c < sky->tables.channels; c++) {
            texels[4 * s + c] = (float)single_phase(&sky->tables, c, 1 - 2 * x * x);
        }
    }
    const uint32_t size[3] = {PHASE_SAMPLES, 1, 1};
    const trl_result result = sky_make_map(sky->gpu, "phase", size, texels, &sky->phase);
    mem_free(sky->ctx, texels);
    return result;
}

static trl_result make_maps(struct single *sky)
{
    const struct single_tables *t = &sky->tables;
    const uint32_t all[3] = {SINGLE_VIEWS, SINGLE_SUNS, SINGLE_HEIGHTS};
    const uint32_t depth[3] = {SINGLE_DEPTH_VIEWS, SINGLE_HEIGHTS, 1};
    const uint32_t light[3] = {SINGLE_LIGHT_SUNS, SINGLE_HEIGHTS, 1};
    const uint32_t medium[3] = {SINGLE_MEDIUM_ALTITUDES, 1 + (uint32_t)t->channels, 1};
    trl_result result = TRL_OK;
    for (int c = 0; c < t->channels && result == TRL_OK; c++) {
        result =
            sky_make_map(sky->gpu, "single scattering", all, t->scattered[c], &sky->scattered[c]);
    }
    if (result == TRL_OK) {
        result = sky_make_map(sky->gpu, "optical depth", depth, t->depth, &sky->depth);
    }
    if (result == TRL_OK) {
        result = sky_make_map(sky->gpu, "star light", light, t->light, &sky->light);
    }
    if (result == TRL_OK) {
        result = sky_make_map(sky->gpu, "medium", medium, t->medium, &sky->medium);
    }
    return result == TRL_OK ? make_phase(sky) : result;
}

struct variant {
    struct gpu_program *program;
    const char *fragment;
    const char *define;
};

static trl_result make_programs(struct single *sky)
{
    const struct variant variants[] = {
        {&sky->air, "sky/single/sky.frag", NULL},
        {&sky->star, "sky/single/sky.frag", "STAR"},
        {&sky->ground_bare, "sky/single/ground.frag", NULL},
        {&sky->ground_surface, "sky/single/ground.frag", "SURFACE"},
        {&sky->sea, "sky/single/sea.frag", "SURFACE"},
    };
    const size_t count = sizeof variants / sizeof *variants - (sky->pixels.has_sea ? 0 : 1);
    char channels[32];
    snprintf(channels, sizeof channels, "CHANNEL_COUNT %d", sky->tables.channels);
    trl_result result = TRL_OK;
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        const char *const defines[] = {channels, variants[i].define, "SEA"};
        const bool has_sea = sky->pixels.has_sea && variants[i].program == &sky->ground_surface;
        const struct gpu_program_desc desc = {.vertex = "lib/layer.vert",
                                              .fragment = variants[i].fragment,
                                              .defines = defines,
                                              .define_count = has_sea              ? 3
                                                              : variants[i].define ? 2
                                                                                   : 1};
        result = gpu_program_init(sky->gpu, &desc, variants[i].program);
    }
    return result;
}

static trl_result init(const struct sky_desc *desc, struct single *sky)
{
    sky->optics = mem_alloc(sky->ctx, 1, sizeof *sky->optics);
    if (!sky->optics) {
        return TRL_ERROR_MEMORY;
    }
    optics_init_visible(OPTICS_PICTURES, desc->medium, (int)desc->wavelengths, sky->optics);
    trl_result result = single_tables_init(sky->ctx, sky->optics, &sky->tables);
    if (result == TRL_OK) {
        result = sky_pixels_init(desc, sky->tables.sun.disc_rad, &sky->pixels);
    }
    if (result == TRL_OK) {
        result = make_programs(sky);
    }
    if (result == TRL_OK) {
        result = make_maps(sky);
    }
    if (result == TRL_OK) {
        sea_water_init(desc, &sky->water);
        result = sea_water_prepare(&sky->water, sky->gpu, &sky->tables.bands);
    }
    single_tables_drop(sky->ctx, &sky->tables);
    return result;
}

static void single_destroy(void **self)
{
    struct single *sky = *self;
    const trl_context *ctx = sky->ctx;
    sky_pixels_finish(&sky->pixels);
    single_spheres_finish(&sky->spheres);
    gpu_program_finish(&sky->air);
    gpu_program_finish(&sky->star);
    gpu_program_finish(&sky->ground_bare);
    gpu_program_finish(&sky->ground_surface);
    gpu_program_finish(&sky->sea);
    sea_water_finish(&sky->water);
    for (int c = 0; c < SINGLE_CHANNELS; c++) {
        gpu_texture_finish(&sky->scattered[c]);
    }
    gpu_texture_finish(&sky->depth);
    gpu_texture_finish(&sky->light);
    gpu_texture_finish(&sky->medium);
    gpu_texture_finish(&sky->phase);
    single_tables_finish(ctx, &sky->tables);
    mem_free(ctx, sky->optics);
    mem_free(ctx, sky);
    *self = NULL;
}

static trl_result single_create(const struct sky_desc *desc, void **self)
{
    const trl_context *ctx = desc->gpu->ctx;
    struct single *sky = mem_alloc(ctx, 1, sizeof *sky);
    *self = sky;
    if (!sky) {
        return TRL_ERROR_MEMORY;
    }
    sky->ctx = ctx;
    sky->gpu = desc->gpu;
    const trl_result result = init(desc, sky);
    if (result != TRL_OK) {
        single_destroy(self);
    }
    return result;
}

static trl_result single_prepare(void *self, const struct sky_view *view)
{
    struct single *sky = self;
    return view->spheres.side == 0 ? TRL_OK
                                   : single_spheres_prepare(&sky->spheres, sky->gpu, &view->spheres,
                                                            sky->tables.channels);
}

// Bands of the light that the air adds; those of the ground's are sky_set_bands'.
static void set_added(const struct single *sky, struct gpu_program *program)
{
    const struct added_bands *added = &sky->tables.added;
    float rgb_from_added[12];
    float added_from_rgb[12];
    for (int k = 0; k < 3; k++) {
        for (int r = 0; r < BAND_COUNT; r++) {
            rgb_from_added[4 * k + r] = added->rgb_from_bands[k][r];
            added_from_rgb[4 * k + r] = added->bands_from_rgb[r][k];
        }
    }
    gpu_program_set_vec4s(program, "u_rgb_from_added", rgb_from_added, 3);
    gpu_program_set_vec4s(program, "u_added_from_rgb", added_from_rgb, 3);
}

static void set_maps(const struct single *sky, struct gpu_program *program)
{
    const struct single_tables *t = &sky->tables;
    const float depth_texels[2] = {SINGLE_DEPTH_VIEWS, SINGLE_HEIGHTS};
    sky_set_vec4(program, "u_sun_grid", t->sun_centre, t->sun_width, t->sun_first, t->sun_last);
    sky_set_vec4(program, "u_texels", SINGLE_HEIGHTS, SINGLE_SUNS, SINGLE_VIEWS,
                 SINGLE_GROUND_VIEWS);
    sky_set_vec4(program, "u_light_texels", SINGLE_LIGHT_SUNS, SINGLE_HEIGHTS,
                 SINGLE_MEDIUM_ALTITUDES, 1 + t->channels);
    gpu_program_set_vec2(program, "u_depth_texels", depth_texels);
    gpu_program_set_float(program, "u_light_soft", (float)SUNLIGHT_SOFT);
    for (int c = 0; c < t->channels; c++) {
        gpu_program_set_texture(program, SCATTERED_NAMES[c], &sky->scattered[c]);
    }
    gpu_program_set_texture(program, "u_optical_depth", &sky->depth);
    gpu_program_set_texture(program, "u_light", &sky->light);
    gpu_program_set_texture(program, "u_medium", &sky->medium);
    gpu_program_set_texture(program, "u_phase", &sky->phase);
}

static void set_uniforms(const struct single *sky, struct gpu_program *program,
                         const struct sky_view *view)
{
    sky_set_bands(program, &sky->tables.bands, sky->optics, view->surface.lights_cd_m2);
    set_added(sky, program);
    set_maps(sky, program);
}

static trl_result draw_kind(struct single *sky, struct gpu_program *program, enum sky_kind kind,
                            const struct sky_view *view)
{
    set_uniforms(sky, program, view);
    return sky_pixels_draw(&sky->pixels, program, kind, view);
}

static trl_result draw_sphere(struct single *sky, struct gpu_program *program,
                              const struct sky_view *view)
{
    set_uniforms(sky, program, view);
    return single_spheres_draw(&sky->spheres, &sky->pixels, program, view);
}

// Air and ground only: there is no star.
static trl_result draw_spheres(struct single *sky, const struct sky_view *view)
{
    const int how = view->spheres.has_integrals ? 1 : 0;
    const trl_result result = draw_sphere(sky, &sky->spheres.air[how], view);
    return result == TRL_OK ? draw_sphere(sky, &sky->spheres.ground[how], view) : result;
}

static trl_result single_draw(void *self, const struct sky_view *view)
{
    struct single *sky = self;
    if (view->spheres.side > 0) {
        return draw_spheres(sky, view);
    }
    struct gpu_program *ground = sky_view_is_bare(view) ? &sky->ground_bare : &sky->ground_surface;
    trl_result result = sky_pixels_sort(&sky->pixels, view);
    if (result == TRL_OK) {
        result = draw_kind(sky, &sky->air, SKY_KIND_AIR, view);
    }
    if (result == TRL_OK) {
        result = draw_kind(sky, &sky->star, SKY_KIND_STAR, view);
    }
    if (result == TRL_OK) {
        result = draw_kind(sky, ground, SKY_KIND_GROUND, view);
    }
    if (result == TRL_OK && sea_water_is_seen(&sky->water, view)) {
        result = sea_water_reflect(&sky->water, &sky->pixels, view);
        sea_water_set(&sky->water, view, &sky->sea);
        result = result == TRL_OK ? draw_kind(sky, &sky->sea, SKY_KIND_SEA, view) : result;
    }
    return result;
}

const struct sky_model sky_single = {.create = single_create,
                                     .destroy = single_destroy,
                                     .prepare = single_prepare,
                                     .draw = single_draw};
