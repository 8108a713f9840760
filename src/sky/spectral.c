// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The spectral model: all orders of scattering, solved once (scatter/), looked up per pixel.
//
//     slice      3D RGBA32F  azimuth x sun x view, the 4D table at the eye's altitude; inside the
//                            air only the first sun is there, the eye's own
//     scattered  3D RGBA32F  depth x azimuth x row, light that the air adds per metre
//     extinction 2D RGBA32F  depth x row, per metre
//     sunlight   2D RGBA32F  sun x altitude, direct light on the ground
//     skylight   2D RGBA32F  sun x altitude, irradiance of level ground by the sky
//     phase      2D RGBA32F  sine of half the angle, phase functions of peaked constituents
//
// Slice and scattered hold logarithms of XYZ in cd m^-2; the others four bands per unit irradiance
// of the star (scatter/bands.h).
#include "scatter/aerial.h"
#include "sky/ground_light.h"
#include "sky/pixels.h"
#include "spectrum/cie.h"

#include <math.h>
#include <stdio.h>

enum { PHASE_SAMPLES = 1024 };

struct spectral {
    const trl_context *ctx;
    struct gpu *gpu;
    struct atmosphere *atmosphere; // owned
    struct aerial aerial;
    struct sky_pixels pixels;
    struct gpu_program air, star, ground_bare, ground_surface;
    struct gpu_texture slice[1 + TABLE_MAX_PEAKED];
    struct gpu_texture scattered[1 + TABLE_MAX_PEAKED];
    struct gpu_texture extinction, sunlight, skylight, phase;
    float *texels;         // scratch of one slice
    double slice_radius_m; // what the slice was made for; 0: nothing yet
    double slice_sun_mu;   // NAN: all suns
    double aerial_radius_m, aerial_sun_mu;
    double highest_m; // altitude up to which light of the ground is tabulated
};

static const char *const SLICE_NAMES[] = {"u_slice0", "u_slice1", "u_slice2", "u_slice3"};
static const char *const SCATTERED_NAMES[] = {"u_scattered0", "u_scattered1", "u_scattered2",
                                              "u_scattered3"};

static trl_result make_texture(struct gpu *gpu, const char *label, uint32_t width, uint32_t height,
                               uint32_t depth, struct gpu_texture *out)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = label;
    desc.shape = depth > 1 ? GPU_SHAPE_3D : GPU_SHAPE_2D;
    desc.format = GPU_FORMAT_RGBA32F;
    desc.width = width;
    desc.height = height;
    desc.depth = depth;
    return gpu_texture_init(gpu, &desc, out);
}

static trl_result upload(struct gpu_texture *texture, const float *texels)
{
    const struct gpu_region region = gpu_texture_region(texture, 0);
    return gpu_texture_upload(texture, &region, texels);
}

static trl_result make_maps(struct spectral *sky)
{
    const struct table *table = &sky->atmosphere->table;
    trl_result result =
        make_texture(sky->gpu, "extinction", AERIAL_DEPTHS, AERIAL_ROWS, 1, &sky->extinction);
    for (int c = 0; c < table->channels && result == TRL_OK; c++) {
        result =
            make_texture(sky->gpu, "sky slice", (uint32_t)table->size.azimuths,
                         (uint32_t)table->size.suns, (uint32_t)table->size.views, &sky->slice[c]);
        if (result == TRL_OK) {
            result = make_texture(sky->gpu, "aerial perspective", AERIAL_DEPTHS, AERIAL_AZIMUTHS,
                                  AERIAL_ROWS, &sky->scattered[c]);
        }
    }
    if (result == TRL_OK) {
        result = make_texture(sky->gpu, "sunlight", GROUND_LIGHT_SUNS, GROUND_LIGHT_ALTITUDES, 1,
                              &sky->sunlight);
    }
    if (result == TRL_OK) {
        result =
            make_texture(sky->gpu, "skylight", (uint32_t)sky->atmosphere->solution.moments.suns,
                         GROUND_LIGHT_ALTITUDES, 1, &sky->skylight);
    }
    return result;
}

// The peaked constituents' phase functions over the sine of half the angle, which spreads the
// forward peak.
static trl_result make_phase(struct spectral *sky)
{
    const struct atmosphere *a = sky->atmosphere;
    trl_result result = make_texture(sky->gpu, "phase", PHASE_SAMPLES, 1, 1, &sky->phase);
    float *texels = mem_alloc(a->ctx, PHASE_SAMPLES * 4, sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    for (int s = 0; s < PHASE_SAMPLES; s++) {
        const double x = (double)s / (PHASE_SAMPLES - 1);
        for (int c = 0; c < a->peaked.count; c++) {
            const struct constituent *k =
                &a->optics->medium->constituents[a->peaked.constituent[c]];
            texels[4 * s + c] = (float)phase_value(&k->phase, 1 - 2 * x * x);
        }
    }
    result = result == TRL_OK ? upload(&sky->phase, texels) : result;
    mem_free(a->ctx, texels);
    return result;
}

struct variant {
    struct gpu_program *program;
    const char *fragment;
    const char *define;
};

static trl_result make_programs(struct spectral *sky)
{
    const struct variant variants[] = {
        {&sky->air, "sky/spectral/sky.frag", NULL},
        {&sky->star, "sky/spectral/sky.frag", "STAR"},
        {&sky->ground_bare, "sky/spectral/ground.frag", NULL},
        {&sky->ground_surface, "sky/spectral/ground.frag", "SURFACE"},
    };
    char peaked[32];
    snprintf(peaked, sizeof peaked, "PEAKED_COUNT %d", sky->atmosphere->peaked.count);
    trl_result result = TRL_OK;
    for (size_t i = 0; i < sizeof variants / sizeof *variants && result == TRL_OK; i++) {
        const char *const defines[] = {peaked, variants[i].define};
        const struct gpu_program_desc desc = {.vertex = "sky/layer.vert",
                                              .fragment = variants[i].fragment,
                                              .defines = defines,
                                              .define_count = variants[i].define ? 2 : 1};
        result = gpu_program_init(sky->gpu, &desc, variants[i].program);
    }
    return result;
}

static trl_result init(const struct sky_desc *desc, struct spectral *sky)
{
    const trl_context *ctx = sky->ctx;
    struct atmosphere_desc atmosphere = atmosphere_desc_default();
    atmosphere.wavelengths = desc->wavelengths;
    trl_result result = atmosphere_create(ctx, desc->medium, &atmosphere, &sky->atmosphere);
    if (result != TRL_OK) {
        return result;
    }
    const struct table_size n = sky->atmosphere->table.size;
    sky->texels =
        mem_alloc(ctx, (size_t)n.views * n.suns * n.azimuths * TEXEL_FLOATS, sizeof(float));
    result = sky->texels ? aerial_init(sky->atmosphere, &sky->aerial) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = sky_pixels_init(desc, sky->atmosphere->solution.sun.disc_rad, &sky->pixels);
    }
    if (result == TRL_OK) {
        result = make_programs(sky);
    }
    if (result == TRL_OK) {
        result = make_maps(sky);
    }
    return result == TRL_OK ? make_phase(sky) : result;
}

static void spectral_destroy(void **self)
{
    struct spectral *sky = *self;
    const trl_context *ctx = sky->ctx;
    sky_pixels_finish(&sky->pixels);
    gpu_program_finish(&sky->ground_bare);
    gpu_program_finish(&sky->ground_surface);
    gpu_program_finish(&sky->air);
    gpu_program_finish(&sky->star);
    for (int c = 0; c <= TABLE_MAX_PEAKED; c++) {
        gpu_texture_finish(&sky->slice[c]);
        gpu_texture_finish(&sky->scattered[c]);
    }
    gpu_texture_finish(&sky->extinction);
    gpu_texture_finish(&sky->sunlight);
    gpu_texture_finish(&sky->skylight);
    gpu_texture_finish(&sky->phase);
    mem_free(ctx, sky->texels);
    if (sky->atmosphere) {
        aerial_finish(&sky->aerial);
    }
    atmosphere_destroy(&sky->atmosphere);
    mem_free(ctx, sky);
    *self = NULL;
}

static trl_result spectral_create(const struct sky_desc *desc, void **self)
{
    const trl_context *ctx = desc->gpu->ctx;
    struct spectral *sky = mem_alloc(ctx, 1, sizeof *sky);
    *self = sky;
    if (!sky) {
        return TRL_ERROR_MEMORY;
    }
    sky->ctx = ctx;
    sky->gpu = desc->gpu;
    sky->highest_m = -1;
    const trl_result result = init(desc, sky);
    if (result != TRL_OK) {
        spectral_destroy(self);
    }
    return result;
}

// Light of the air spans many orders of magnitude from day to night, so its maps hold logarithms:
// between texels it then falls by factors, as it does in nature. What is darker than 1e-20 is
// nothing.
static trl_result upload_log(struct gpu_texture *texture, const struct gpu_region *region,
                             float *texels)
{
    const float darkest = 1e-20f;
    const size_t count = (size_t)region->width * region->height * region->depth * TEXEL_FLOATS;
    for (size_t k = 0; k < count; k++) {
        texels[k] = logf(texels[k] > darkest ? texels[k] : darkest);
    }
    return gpu_texture_upload(texture, region, texels);
}

// From inside the air all rays start under one sun, so the slice has one; from outside each ray
// enters the air under its own.
static trl_result update_slices(struct spectral *sky, double radius_m, double sun_mu)
{
    const struct atmosphere *a = sky->atmosphere;
    const bool is_outside = radius_m > a->optics->top_radius_m;
    const double at_m = is_outside ? a->optics->top_radius_m : radius_m;
    if (sky->slice_radius_m == at_m &&
        (is_outside ? isnan(sky->slice_sun_mu) : sky->slice_sun_mu == sun_mu)) {
        return TRL_OK;
    }
    trl_result result = TRL_OK;
    for (int c = 0; c < a->table.channels && result == TRL_OK; c++) {
        struct gpu_region region = gpu_texture_region(&sky->slice[c], 0);
        if (is_outside) {
            table_slice(&a->table, a->optics, c, at_m, sky->texels);
        } else {
            table_slice_at_sun(&a->table, a->optics, c, at_m, sun_mu, sky->texels);
            region.height = 1;
        }
        result = upload_log(&sky->slice[c], &region, sky->texels);
    }
    sky->slice_radius_m = result == TRL_OK ? at_m : 0;
    // Seen from inside at the very top and then from outside is not the same slice.
    sky->slice_sun_mu = is_outside ? (double)NAN : sun_mu;
    return result;
}

static trl_result update_aerial(struct spectral *sky, double radius_m, double sun_mu)
{
    if (sky->aerial_radius_m == radius_m && sky->aerial_sun_mu == sun_mu) {
        return TRL_OK;
    }
    aerial_update(&sky->aerial, radius_m, sun_mu);
    trl_result result = upload(&sky->extinction, sky->aerial.extinction);
    for (int c = 0; c < sky->atmosphere->table.channels && result == TRL_OK; c++) {
        const struct gpu_region region = gpu_texture_region(&sky->scattered[c], 0);
        result = upload_log(&sky->scattered[c], &region, sky->aerial.scattered[c]);
    }
    sky->aerial_radius_m = result == TRL_OK ? radius_m : 0;
    sky->aerial_sun_mu = sun_mu;
    return result;
}

static trl_result update_ground_light(struct spectral *sky, double highest_m)
{
    const double height_m =
        sky->atmosphere->optics->top_radius_m - sky->atmosphere->optics->ground_radius_m;
    const double wanted_m = fmin(fmax(highest_m, 100), height_m);
    if (sky->highest_m == wanted_m) {
        return TRL_OK;
    }
    const trl_context *ctx = sky->atmosphere->ctx;
    const size_t suns = (size_t)sky->atmosphere->solution.moments.suns;
    const size_t most = suns > GROUND_LIGHT_SUNS ? suns : GROUND_LIGHT_SUNS;
    float *texels = mem_alloc(ctx, most * GROUND_LIGHT_ALTITUDES * BAND_COUNT, sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    ground_light_of_star(sky->atmosphere, wanted_m, texels);
    trl_result result = upload(&sky->sunlight, texels);
    if (result == TRL_OK) {
        ground_light_of_sky(sky->atmosphere, wanted_m, texels);
        result = upload(&sky->skylight, texels);
    }
    mem_free(ctx, texels);
    sky->highest_m = result == TRL_OK ? wanted_m : -1;
    return result;
}

static trl_result spectral_prepare(void *self, const struct sky_view *view)
{
    struct spectral *sky = self;
    const struct camera *camera = view->camera;
    const double radius_m = sky_pixels_eye_radius(&sky->pixels, camera);
    const double sun_mu = vec3_dot(vec3_normalize(camera->position_m), camera->sun_direction);
    trl_result result = update_slices(sky, radius_m, sun_mu);
    if (result == TRL_OK) {
        result = update_aerial(sky, radius_m, sun_mu);
    }
    return result == TRL_OK ? update_ground_light(sky, view->highest_m) : result;
}

// Columns of the matrices of the bands, as the shader multiplies them.
static void set_colours(const struct spectral *sky, struct gpu_program *program)
{
    const struct bands *b = &sky->atmosphere->bands;
    float rgb_from_xyz[12] = {0};
    float rgb_from_bands[12];
    float bands_from_rgb[12];
    for (int k = 0; k < 3; k++) {
        for (int r = 0; r < BAND_COUNT; r++) {
            rgb_from_bands[4 * k + r] = b->rgb_from_bands[k][r];
            bands_from_rgb[4 * k + r] = b->bands_from_rgb[r][k];
        }
    }
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            rgb_from_xyz[4 * k + i] = (float)cie_rgb_from_xyz[k][i];
        }
    }
    gpu_program_set_vec4s(program, "u_rgb_from_xyz", rgb_from_xyz, 3);
    gpu_program_set_vec4s(program, "u_rgb_from_bands", rgb_from_bands, 3);
    gpu_program_set_vec4s(program, "u_bands_from_rgb", bands_from_rgb, 3);
    const lanes *albedo = &sky->atmosphere->optics->ground_albedo;
    sky_set_vec4(program, "u_ground_albedo", (double)(*albedo)[b->lane[0]],
                 (double)(*albedo)[b->lane[1]], (double)(*albedo)[b->lane[2]],
                 (double)(*albedo)[b->lane[3]]);
}

// Lights at night: white shows `white_cd_m2`.
static void set_lights(const struct spectral *sky, struct gpu_program *program, double white_cd_m2)
{
    const struct bands *b = &sky->atmosphere->bands;
    float bands_of_light[12];
    for (int k = 0; k < 3; k++) {
        double star_cd_m2 = 0; // what all bands together show
        for (int r = 0; r < BAND_COUNT; r++) {
            star_cd_m2 += (double)b->rgb_from_bands[k][r];
        }
        const double scale = star_cd_m2 > 0 ? white_cd_m2 / star_cd_m2 : 0;
        for (int r = 0; r < BAND_COUNT; r++) {
            bands_of_light[4 * k + r] = (float)(scale * (double)b->bands_from_rgb[r][k]);
        }
    }
    gpu_program_set_vec4s(program, "u_bands_of_light", bands_of_light, 3);
}

static void set_maps(const struct spectral *sky, struct gpu_program *program)
{
    const struct table *table = &sky->atmosphere->table;
    const float aerial_rows[2] = {AERIAL_GROUND_ROWS, AERIAL_ROWS};
    const float light_texel[2] = {1.0f / GROUND_LIGHT_SUNS, 1.0f / (float)sky->skylight.width};
    sky_set_vec3(
        program, "u_slice_texel",
        (struct vec3){1.0 / table->size.azimuths, 1.0 / table->size.suns, 1.0 / table->size.views});
    sky_set_vec3(program, "u_aerial_texel",
                 (struct vec3){1.0 / AERIAL_DEPTHS, 1.0 / AERIAL_AZIMUTHS, 1.0 / AERIAL_ROWS});
    gpu_program_set_vec2(program, "u_aerial_rows", aerial_rows);
    sky_set_vec4(program, "u_rows", sky->aerial.nearest_m, sky->aerial.farthest_m,
                 sky->aerial.horizon_mu, sky->aerial.highest_mu);
    sky_set_vec4(program, "u_ground_light", 0, sky->highest_m, SUNLIGHT_SOFT,
                 1.0 / GROUND_LIGHT_ALTITUDES);
    sky_set_vec4(program, "u_sun_grid", table->sun_centre, table->sun_width, table->sun_first,
                 table->sun_last);
    gpu_program_set_vec2(program, "u_light_texel", light_texel);
    for (int c = 0; c < table->channels; c++) {
        gpu_program_set_texture(program, SLICE_NAMES[c], &sky->slice[c]);
        gpu_program_set_texture(program, SCATTERED_NAMES[c], &sky->scattered[c]);
    }
    gpu_program_set_texture(program, "u_extinction", &sky->extinction);
    gpu_program_set_texture(program, "u_sunlight", &sky->sunlight);
    gpu_program_set_texture(program, "u_skylight", &sky->skylight);
    gpu_program_set_texture(program, "u_phase", &sky->phase);
}

// One kind of pixels.
static trl_result draw_kind(struct spectral *sky, struct gpu_program *program, enum sky_kind kind,
                            const struct sky_view *view)
{
    set_colours(sky, program);
    set_maps(sky, program);
    return sky_pixels_draw(&sky->pixels, program, kind, view);
}

static trl_result spectral_draw(void *self, const struct sky_view *view)
{
    struct spectral *sky = self;
    const bool is_bare = sky_view_is_bare(view);
    struct gpu_program *ground = is_bare ? &sky->ground_bare : &sky->ground_surface;
    if (!is_bare) {
        set_lights(sky, ground, view->surface.lights_cd_m2);
    }
    trl_result result = sky_pixels_sort(&sky->pixels, view);
    if (result == TRL_OK) {
        result = draw_kind(sky, &sky->air, SKY_KIND_AIR, view);
    }
    if (result == TRL_OK) {
        result = draw_kind(sky, &sky->star, SKY_KIND_STAR, view);
    }
    return result == TRL_OK ? draw_kind(sky, ground, SKY_KIND_GROUND, view) : result;
}

const struct sky_model sky_spectral = {.create = spectral_create,
                                       .destroy = spectral_destroy,
                                       .prepare = spectral_prepare,
                                       .draw = spectral_draw};
