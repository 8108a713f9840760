// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/spectral_maps.h"

#include "sky/ground_light.h"
#include "sky/pixels.h"

#include <math.h>

enum { PHASE_SAMPLES = 1024 };

static const char *const SLICE_NAMES[] = {"u_slice0", "u_slice1", "u_slice2", "u_slice3"};
static const char *const SCATTERED_NAMES[] = {"u_scattered0", "u_scattered1", "u_scattered2",
                                              "u_scattered3"};

static trl_result make_texture(struct gpu *gpu, const char *label, uint32_t width, uint32_t height,
                               uint32_t depth, struct gpu_texture *out)
{
    return sky_make_map(gpu, label, (const uint32_t[]){width, height, depth}, NULL, out);
}

static trl_result upload(struct gpu_texture *texture, const float *texels)
{
    const struct gpu_region region = gpu_texture_region(texture, 0);
    return gpu_texture_upload(texture, &region, texels);
}

static trl_result make_maps(struct spectral_maps *maps)
{
    const struct table *table = &maps->atmosphere->table;
    trl_result result =
        make_texture(maps->gpu, "extinction", AERIAL_LONG, AERIAL_ROWS, 1, &maps->extinction);
    if (result == TRL_OK) {
        result = make_texture(maps->gpu, "bounce", AERIAL_LONG, AERIAL_ROWS, 1, &maps->bounce);
    }
    for (int c = 0; c < table->channels && result == TRL_OK; c++) {
        result =
            make_texture(maps->gpu, "sky slice", (uint32_t)table->size.azimuths,
                         (uint32_t)table->size.suns, (uint32_t)table->size.views, &maps->slice[c]);
        if (result == TRL_OK) {
            result = make_texture(maps->gpu, "aerial perspective", AERIAL_LONG, AERIAL_SHORT,
                                  AERIAL_ROWS, &maps->scattered[c]);
        }
    }
    if (result == TRL_OK) {
        result = make_texture(maps->gpu, "sunlight", GROUND_LIGHT_SUNS, GROUND_LIGHT_ALTITUDES, 1,
                              &maps->sunlight);
    }
    if (result == TRL_OK) {
        result =
            make_texture(maps->gpu, "skylight", (uint32_t)maps->atmosphere->solution.moments.suns,
                         GROUND_LIGHT_ALTITUDES, 1, &maps->skylight);
    }
    if (result == TRL_OK) {
        result = make_texture(maps->gpu, "rising light", maps->skylight.width,
                              GROUND_LIGHT_ALTITUDES, 1, &maps->rising);
    }
    if (result == TRL_OK) {
        result = make_texture(maps->gpu, "evenness of light", maps->skylight.width,
                              GROUND_LIGHT_ALTITUDES, 1, &maps->evenness);
    }
    if (result == TRL_OK) {
        result = make_texture(maps->gpu, "slope of the sky", maps->skylight.width,
                              GROUND_LIGHT_ALTITUDES, 1, &maps->slope);
    }
    if (result == TRL_OK) {
        result = make_texture(maps->gpu, "albedo of the air", 1, GROUND_LIGHT_ALTITUDES, 1,
                              &maps->air_albedo);
    }
    if (result == TRL_OK) {
        result = make_texture(maps->gpu, "phase", PHASE_SAMPLES, 1, 1, &maps->phase);
    }
    return result;
}

// The peaked constituents' phase functions over the sine of half the angle, which spreads the
// forward peak.
trl_result spectral_maps_set_phases(struct spectral_maps *maps, const struct medium *medium)
{
    const struct atmosphere *a = maps->atmosphere;
    float *texels = mem_alloc(a->ctx, PHASE_SAMPLES * 4, sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    for (int s = 0; s < PHASE_SAMPLES; s++) {
        const double x = (double)s / (PHASE_SAMPLES - 1);
        for (int c = 0; c < a->peaked.count; c++) {
            const struct constituent *k = &medium->constituents[a->peaked.constituent[c]];
            texels[4 * s + c] = (float)phase_value(&k->phase, 1 - 2 * x * x);
        }
    }
    const trl_result result = upload(&maps->phase, texels);
    mem_free(a->ctx, texels);
    return result;
}

static trl_result init(struct atmosphere *atmosphere, struct spectral_maps *out)
{
    const struct table_size n = atmosphere->table.size;
    out->texels = mem_alloc(atmosphere->ctx, (size_t)n.views * n.suns * n.azimuths * TEXEL_FLOATS,
                            sizeof(float));
    trl_result result = out->texels ? aerial_init(atmosphere, &out->aerial) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = make_maps(out);
    }
    if (result == TRL_OK) {
        result = spectral_maps_set_phases(out, atmosphere->optics->medium);
    }
    if (result != TRL_OK) {
        spectral_maps_finish(out);
    }
    return result;
}

trl_result spectral_maps_init(struct gpu *gpu, struct atmosphere *atmosphere,
                              struct spectral_maps *out)
{
    *out = (struct spectral_maps){.gpu = gpu, .atmosphere = atmosphere, .highest_m = -1};
    return init(atmosphere, out);
}

trl_result spectral_maps_init_beside(const struct spectral_maps *others, struct spectral_maps *out)
{
    *out = (struct spectral_maps){
        .gpu = others->gpu, .atmosphere = others->atmosphere, .is_guest = true, .highest_m = -1};
    return init(others->atmosphere, out);
}

void spectral_maps_finish(struct spectral_maps *maps)
{
    if (!maps->atmosphere) {
        return;
    }
    for (int c = 0; c <= TABLE_MAX_PEAKED; c++) {
        gpu_texture_finish(&maps->slice[c]);
        gpu_texture_finish(&maps->scattered[c]);
    }
    for (int c = 0; c < AERIAL_SOURCES; c++) {
        gpu_texture_finish(&maps->source[c]);
    }
    gpu_texture_finish(&maps->extinction);
    gpu_texture_finish(&maps->bounce);
    gpu_texture_finish(&maps->sunlight);
    gpu_texture_finish(&maps->skylight);
    gpu_texture_finish(&maps->rising);
    gpu_texture_finish(&maps->evenness);
    gpu_texture_finish(&maps->slope);
    gpu_texture_finish(&maps->air_albedo);
    gpu_texture_finish(&maps->phase);
    mem_free(maps->atmosphere->ctx, maps->texels);
    aerial_finish(&maps->aerial);
    if (!maps->is_guest) {
        atmosphere_destroy(&maps->atmosphere);
    }
    *maps = (struct spectral_maps){0};
}

trl_result spectral_maps_add_source(struct spectral_maps *maps)
{
    if (maps->source[AERIAL_MULTIPLE].name) {
        return TRL_OK;
    }
    trl_result result = aerial_add_source(&maps->aerial);
    for (int c = 0; c < AERIAL_SOURCES && result == TRL_OK; c++) {
        if (maps->aerial.source[c] && !maps->source[c].name) {
            result = make_texture(maps->gpu, "air source", AERIAL_LONG, AERIAL_SHORT, AERIAL_ROWS,
                                  &maps->source[c]);
        }
    }
    maps->aerial_radius_m = 0; // made anew by the next update
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
static trl_result update_slices(struct spectral_maps *maps, double radius_m, double sun_mu)
{
    const struct atmosphere *a = maps->atmosphere;
    const bool is_outside = radius_m > a->optics->top_radius_m;
    const double at_m = is_outside ? a->optics->top_radius_m : radius_m;
    if (maps->slice_radius_m == at_m &&
        (is_outside ? isnan(maps->slice_sun_mu) : maps->slice_sun_mu == sun_mu)) {
        return TRL_OK;
    }
    trl_result result = TRL_OK;
    for (int c = 0; c < a->table.channels && result == TRL_OK; c++) {
        struct gpu_region region = gpu_texture_region(&maps->slice[c], 0);
        if (is_outside) {
            table_slice(&a->table, a->optics, c, at_m, maps->texels);
        } else {
            table_slice_at_sun(&a->table, a->optics, c, at_m, sun_mu, maps->texels);
            region.height = 1;
        }
        result = upload_log(&maps->slice[c], &region, maps->texels);
    }
    maps->slice_radius_m = result == TRL_OK ? at_m : 0;
    // Seen from inside at the very top and then from outside is not the same slice.
    maps->slice_sun_mu = is_outside ? (double)NAN : sun_mu;
    return result;
}

static trl_result update_aerial(struct spectral_maps *maps, double radius_m, double sun_mu)
{
    if (maps->aerial_radius_m == radius_m && maps->aerial_sun_mu == sun_mu) {
        return TRL_OK;
    }
    aerial_update(&maps->aerial, radius_m, sun_mu);
    trl_result result = upload(&maps->extinction, maps->aerial.extinction);
    if (result == TRL_OK) {
        result = upload(&maps->bounce, maps->aerial.bounce);
    }
    for (int c = 0; c < maps->atmosphere->table.channels && result == TRL_OK; c++) {
        const struct gpu_region region = gpu_texture_region(&maps->scattered[c], 0);
        result = upload_log(&maps->scattered[c], &region, maps->aerial.scattered[c]);
    }
    for (int c = 0; c < AERIAL_SOURCES && result == TRL_OK; c++) {
        if (maps->source[c].name) {
            const struct gpu_region region = gpu_texture_region(&maps->source[c], 0);
            result = upload_log(&maps->source[c], &region, maps->aerial.source[c]);
        }
    }
    maps->aerial_radius_m = result == TRL_OK ? radius_m : 0;
    maps->aerial_sun_mu = sun_mu;
    return result;
}

static trl_result update_ground_light(struct spectral_maps *maps, double highest_m)
{
    const double height_m =
        maps->atmosphere->optics->top_radius_m - maps->atmosphere->optics->ground_radius_m;
    const double wanted_m = fmin(fmax(highest_m, 100), height_m);
    if (maps->highest_m == wanted_m) {
        return TRL_OK;
    }
    const trl_context *ctx = maps->atmosphere->ctx;
    const size_t suns = (size_t)maps->atmosphere->solution.moments.suns;
    const size_t most = suns > GROUND_LIGHT_SUNS ? suns : GROUND_LIGHT_SUNS;
    float *texels = mem_alloc(ctx, most * GROUND_LIGHT_ALTITUDES * BAND_COUNT, sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    ground_light_of_star(maps->atmosphere, wanted_m, texels);
    trl_result result = upload(&maps->sunlight, texels);
    if (result == TRL_OK) {
        ground_light_of_sky(maps->atmosphere, wanted_m, texels);
        result = upload(&maps->skylight, texels);
    }
    if (result == TRL_OK) {
        ground_light_from_below(maps->atmosphere, wanted_m, texels);
        result = upload(&maps->rising, texels);
    }
    if (result == TRL_OK) {
        ground_light_evenness(maps->atmosphere, wanted_m, texels);
        result = upload(&maps->evenness, texels);
    }
    if (result == TRL_OK) {
        ground_light_slope(maps->atmosphere, wanted_m, texels);
        result = upload(&maps->slope, texels);
    }
    if (result == TRL_OK) {
        for (int row = 0; row < GROUND_LIGHT_ALTITUDES; row++) {
            aerial_air_albedo(&maps->aerial, wanted_m * row / (GROUND_LIGHT_ALTITUDES - 1),
                              texels + (size_t)row * BAND_COUNT);
        }
        result = upload(&maps->air_albedo, texels);
    }
    mem_free(ctx, texels);
    maps->highest_m = result == TRL_OK ? wanted_m : -1;
    return result;
}

trl_result spectral_maps_update(struct spectral_maps *maps, const struct spectral_eye *eye)
{
    trl_result result = update_slices(maps, eye->radius_m, eye->sun_mu);
    if (result == TRL_OK) {
        result = update_aerial(maps, eye->radius_m, eye->sun_mu);
    }
    return result == TRL_OK ? update_ground_light(maps, eye->highest_m) : result;
}

void spectral_maps_bind(const struct spectral_maps *maps, struct gpu_program *program)
{
    const struct table *table = &maps->atmosphere->table;
    const float aerial_rows[3] = {AERIAL_GROUND_ROWS, AERIAL_ROWS, (float)maps->aerial.opaque_m};
    const float light_texel[2] = {1.0f / GROUND_LIGHT_SUNS, 1.0f / (float)maps->skylight.width};
    sky_set_vec3(
        program, "u_slice_texel",
        (struct vec3){1.0 / table->size.azimuths, 1.0 / table->size.suns, 1.0 / table->size.views});
    sky_set_vec3(program, "u_aerial_texel",
                 (struct vec3){1.0 / AERIAL_LONG, 1.0 / AERIAL_SHORT, 1.0 / AERIAL_ROWS});
    gpu_program_set_vec3(program, "u_aerial_rows", aerial_rows);
    sky_set_vec4(program, "u_rows", maps->aerial.nearest_m, maps->aerial.farthest_m,
                 maps->aerial.horizon_mu, maps->aerial.highest_mu);
    sky_set_vec4(program, "u_ground_light", 0, maps->highest_m, SUNLIGHT_SOFT,
                 1.0 / GROUND_LIGHT_ALTITUDES);
    sky_set_vec4(program, "u_sun_grid", table->sun_centre, table->sun_width, table->sun_first,
                 table->sun_last);
    gpu_program_set_vec2(program, "u_light_texel", light_texel);
    for (int c = 0; c < table->channels; c++) {
        gpu_program_set_texture(program, SLICE_NAMES[c], &maps->slice[c]);
        gpu_program_set_texture(program, SCATTERED_NAMES[c], &maps->scattered[c]);
    }
    gpu_program_set_texture(program, "u_extinction", &maps->extinction);
    gpu_program_set_texture(program, "u_bounce", &maps->bounce);
    gpu_program_set_texture(program, "u_air_albedo", &maps->air_albedo);
    gpu_program_set_texture(program, "u_rising", &maps->rising);
    gpu_program_set_texture(program, "u_evenness", &maps->evenness);
    gpu_program_set_texture(program, "u_slope", &maps->slope);
    gpu_program_set_texture(program, "u_sunlight", &maps->sunlight);
    gpu_program_set_texture(program, "u_skylight", &maps->skylight);
    gpu_program_set_texture(program, "u_phase", &maps->phase);
}
