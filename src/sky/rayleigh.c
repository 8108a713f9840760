// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Santana 2017: light scattered once in one gas, by a few samples per pixel and wavelength. Nothing
// depends on the eye or the star but uniforms, and nothing needs a float target.
//
//     depth      2D RG16F   x over the angle, y over the altitude: the inverse air mass as the sum
//                           of a half float and what that leaves (shaders/shared/rayleigh.glsl)
#include "scatter/rayleigh.h"
#include "sky/pixels.h"
#include "sky/sea_water.h"

#include <stdio.h>

struct rayleigh_sky {
    const trl_context *ctx;
    struct rayleigh model;                            // its medium is not looked at while drawing
    float spectrum[4 * TRL_RAYLEIGH_MAX_WAVELENGTHS]; // u_spectrum and u_matter of air.glsl
    float matter[4 * TRL_RAYLEIGH_MAX_WAVELENGTHS];
    struct sky_pixels pixels;
    struct gpu_program air, disc, ground_bare, ground_surface, sea;
    struct sea_water water;
    struct gpu_texture depth; // none with the fit
};

// The nearest number with eleven binary digits, which a half float has.
static float round_to_half(float value)
{
    int exponent = 0;
    const float digits = frexpf(value, &exponent);
    return ldexpf(roundf(ldexpf(digits, 11)), exponent - 11);
}

static trl_result upload_depth(struct rayleigh_sky *sky)
{
    enum { TEXELS = RAYLEIGH_MAP_WIDTH * RAYLEIGH_MAP_HEIGHT };
    float *texels = mem_alloc(sky->ctx, (size_t)TEXELS * 2, sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    for (int i = 0; i < TEXELS; i++) {
        const float value = sky->model.depth.map[i / RAYLEIGH_MAP_WIDTH][i % RAYLEIGH_MAP_WIDTH];
        texels[2 * i] = round_to_half(value);
        texels[2 * i + 1] = value - texels[2 * i];
    }
    const struct gpu_region region = gpu_texture_region(&sky->depth, 0);
    const trl_result result = gpu_texture_upload(&sky->depth, &region, texels);
    mem_free(sky->ctx, texels);
    return result;
}

static trl_result make_depth(struct rayleigh_sky *sky, struct gpu *gpu)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "optical depth";
    desc.format = GPU_FORMAT_RG16F;
    desc.width = RAYLEIGH_MAP_WIDTH;
    desc.height = RAYLEIGH_MAP_HEIGHT;
    const trl_result result = gpu_texture_init(gpu, &desc, &sky->depth);
    return result == TRL_OK ? upload_depth(sky) : result;
}

struct variant {
    struct gpu_program *program;
    const char *fragment;
    const char *define;
};

static trl_result make_programs(struct rayleigh_sky *sky, struct gpu *gpu)
{
    const struct variant variants[] = {
        {&sky->air, "sky/rayleigh/sky.frag", NULL},
        {&sky->disc, "sky/rayleigh/sky.frag", "STAR"},
        {&sky->ground_bare, "sky/rayleigh/ground.frag", NULL},
        {&sky->ground_surface, "sky/rayleigh/ground.frag", "SURFACE"},
        {&sky->sea, "sky/rayleigh/sea.frag", "SURFACE"},
    };
    const size_t variant_count = sizeof variants / sizeof *variants - (sky->pixels.has_sea ? 0 : 1);
    const trl_rayleigh_desc *options = &sky->model.desc;
    char samples[32];
    char wavelengths[32];
    char heights[32];
    snprintf(samples, sizeof samples, "SAMPLES %u", (unsigned)options->samples);
    snprintf(wavelengths, sizeof wavelengths, "WAVELENGTHS %u", (unsigned)options->wavelengths);
    snprintf(heights, sizeof heights, "FIT_HEIGHTS %u", (unsigned)options->fit_heights);
    trl_result result = TRL_OK;
    for (size_t i = 0; i < variant_count && result == TRL_OK; i++) {
        const char *defines[6] = {samples, wavelengths};
        size_t count = 2;
        if (options->optical_depth == TRL_RAYLEIGH_FIT) {
            defines[count++] = heights;
        }
        if (!options->has_out_scattering) {
            defines[count++] = "SIMPLE";
        }
        if (variants[i].define) {
            defines[count++] = variants[i].define;
        }
        if (sky->pixels.has_sea && variants[i].program == &sky->ground_surface) {
            defines[count++] = "SEA";
        }
        const struct gpu_program_desc desc = {.vertex = "lib/layer.vert",
                                              .fragment = variants[i].fragment,
                                              .defines = defines,
                                              .define_count = count};
        result = gpu_program_init(gpu, &desc, variants[i].program);
    }
    return result;
}

// Columns, colours and coefficients. What the model cannot show is told.
static void learn_medium(struct rayleigh_sky *sky, const struct medium *medium,
                         const trl_rayleigh_desc *desc)
{
    const trl_rayleigh_desc options = *desc; // may be the model's own
    struct rayleigh_star star;
    rayleigh_init(&sky->model, medium, &options);
    rayleigh_star_init(&sky->model, &star);
    for (uint32_t k = 0; k < options.wavelengths; k++) {
        const struct rayleigh_coefficients c = rayleigh_at(&sky->model, star.nm[k]);
        for (int i = 0; i < 3; i++) {
            sky->spectrum[4 * k + i] = (float)(star.rgb[k][i] * star.luminance);
        }
        sky->spectrum[4 * k + 3] = (float)c.extinction_per_m;
        sky->matter[4 * k] = (float)c.scattering_per_m;
        sky->matter[4 * k + 1] = (float)spectrum_at(&medium->ground_albedo, star.nm[k]);
    }
    for (size_t i = 0; i < medium->constituent_count; i++) {
        if (!(sky->model.gas.share[i] > 0)) {
            trl_log(sky->ctx, TRL_LOG_INFO, TRL_LOG_ITEM_SOLVER,
                    "sky model rayleigh: \"%s\" is left out", medium->constituents[i].name);
        }
    }
}

static trl_result init(const struct sky_desc *desc, struct rayleigh_sky *sky)
{
    learn_medium(sky, desc->medium, desc->rayleigh);
    const double disc_rad = fmax(desc->medium->star_angular_radius_rad, RAYLEIGH_SMALLEST_DISC_RAD);
    trl_result result = sky_pixels_init(desc, disc_rad, &sky->pixels);
    const RayleighAir *air = &sky->model.depth.air;
    sky->pixels.top_radius_m = air->ground_m + air->height_m; // as high as it is shown
    if (result == TRL_OK) {
        result = make_programs(sky, desc->gpu);
    }
    if (result == TRL_OK) {
        sea_water_init(desc, &sky->water);
        result = sea_water_prepare(&sky->water, desc->gpu, NULL);
    }
    const bool has_map = desc->rayleigh->optical_depth == TRL_RAYLEIGH_TEXTURE;
    return result == TRL_OK && has_map ? make_depth(sky, desc->gpu) : result;
}

static void rayleigh_destroy(void **self)
{
    struct rayleigh_sky *sky = *self;
    sky_pixels_finish(&sky->pixels);
    gpu_program_finish(&sky->air);
    gpu_program_finish(&sky->disc);
    gpu_program_finish(&sky->ground_bare);
    gpu_program_finish(&sky->ground_surface);
    gpu_program_finish(&sky->sea);
    sea_water_finish(&sky->water);
    gpu_texture_finish(&sky->depth);
    mem_free(sky->ctx, sky);
    *self = NULL;
}

static trl_result rayleigh_create(const struct sky_desc *desc, void **self)
{
    struct rayleigh_sky *sky = mem_alloc(desc->gpu->ctx, 1, sizeof *sky);
    *self = sky;
    if (!sky) {
        return TRL_ERROR_MEMORY;
    }
    sky->ctx = desc->gpu->ctx;
    const trl_result result = init(desc, sky);
    if (result != TRL_OK) {
        rayleigh_destroy(self);
    }
    return result;
}

// To another medium: everything that is known of it is computed again, programs stay.
static trl_result rayleigh_change(void *self, const struct medium *medium)
{
    struct rayleigh_sky *sky = self;
    learn_medium(sky, medium, &sky->model.desc);
    return sky->model.depth.kind == TRL_RAYLEIGH_TEXTURE ? upload_depth(sky) : TRL_OK;
}

static trl_result rayleigh_prepare(void *self, const struct sky_view *view)
{
    (void)self;
    (void)view;
    return TRL_OK;
}

static void set_matter(const struct rayleigh_sky *sky, struct gpu_program *program)
{
    const size_t wavelengths = sky->model.desc.wavelengths;
    const struct rayleigh_depth *depth = &sky->model.depth;
    const RayleighAir *air = &depth->air;
    gpu_program_set_vec4s(program, "u_spectrum", sky->spectrum, wavelengths);
    gpu_program_set_vec4s(program, "u_matter", sky->matter, wavelengths);
    sky_set_vec4(program, "u_air", air->ground_m, air->height_m, air->scale_m, air->softness);
    if (depth->kind == TRL_RAYLEIGH_TEXTURE) {
        const float texel[2] = {1.0f / RAYLEIGH_MAP_WIDTH, 1.0f / RAYLEIGH_MAP_HEIGHT};
        gpu_program_set_vec2(program, "u_columns_texel", texel);
        gpu_program_set_texture(program, "u_columns", &sky->depth);
        return;
    }
    float fit[8 * TRL_RAYLEIGH_MAX_HEIGHTS];
    for (int i = 0; i < depth->fit_heights; i++) {
        const RayleighFit *f = &depth->fit[i];
        const double c[8] = {f->c0, f->c1, f->c2, f->c3, f->c4, f->c5, f->c6, f->c7};
        for (int j = 0; j < 8; j++) {
            fit[8 * i + j] = (float)c[j];
        }
    }
    gpu_program_set_vec4s(program, "u_fit", fit, 2 * (size_t)depth->fit_heights);
}

// Lights at night go through the same air: as much of each primary as of the star's light.
static void set_night(const struct rayleigh_sky *sky, struct gpu_program *program,
                      double white_cd_m2)
{
    double star[3] = {0, 0, 0};
    for (uint32_t k = 0; k < sky->model.desc.wavelengths; k++) {
        for (int i = 0; i < 3; i++) {
            star[i] += (double)sky->spectrum[4 * k + i];
        }
    }
    double night[3];
    for (int i = 0; i < 3; i++) {
        night[i] = star[i] > 0 ? white_cd_m2 / star[i] : 0;
    }
    sky_set_vec3(program, "u_night_light", (struct vec3){night[0], night[1], night[2]});
}

static trl_result draw_kind(struct rayleigh_sky *sky, struct gpu_program *program,
                            enum sky_kind kind, const struct sky_view *view)
{
    set_matter(sky, program);
    return sky_pixels_draw(&sky->pixels, program, kind, view);
}

static trl_result rayleigh_draw(void *self, const struct sky_view *view)
{
    struct rayleigh_sky *sky = self;
    const bool is_bare = sky_view_is_bare(view);
    struct gpu_program *ground = is_bare ? &sky->ground_bare : &sky->ground_surface;
    if (!is_bare) {
        set_night(sky, ground, view->surface.lights_cd_m2);
    }
    trl_result result = sky_pixels_sort(&sky->pixels, view);
    if (result == TRL_OK) {
        result = draw_kind(sky, &sky->air, SKY_KIND_AIR, view);
    }
    if (result == TRL_OK) {
        result = draw_kind(sky, &sky->disc, SKY_KIND_STAR, view);
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

const struct sky_model sky_rayleigh = {.create = rayleigh_create,
                                       .destroy = rayleigh_destroy,
                                       .prepare = rayleigh_prepare,
                                       .draw = rayleigh_draw,
                                       .change = rayleigh_change};
