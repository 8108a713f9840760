// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/sky.h"

#include "sky/ground_light.h"
#include "spectrum/cie.h"

#include <math.h>
#include <stdio.h>

enum { PHASE_SAMPLES = 1024 };

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

static trl_result make_maps(struct sky *sky)
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
static trl_result make_phase(struct sky *sky)
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

static trl_result make_programs(struct sky *sky)
{
    const struct variant variants[] = {
        {&sky->bare.sort, "sky/sort.frag", NULL},
        {&sky->surface.sort, "sky/sort.frag", "SURFACE"},
        {&sky->air, "sky/sky.frag", NULL},
        {&sky->star, "sky/sky.frag", "STAR"},
        {&sky->bare.ground, "sky/ground.frag", NULL},
        {&sky->surface.ground, "sky/ground.frag", "SURFACE"},
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

trl_result sky_init(struct gpu *gpu, const struct atmosphere *atmosphere, struct sky *out)
{
    *out = (struct sky){.gpu = gpu, .atmosphere = atmosphere, .highest_m = -1};
    const struct table_size n = atmosphere->table.size;
    out->texels = mem_alloc(atmosphere->ctx, (size_t)n.views * n.suns * n.azimuths * TEXEL_FLOATS,
                            sizeof(float));
    trl_result result = out->texels ? aerial_init(atmosphere, &out->aerial) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = make_programs(out);
    }
    if (result == TRL_OK) {
        result = make_maps(out);
    }
    if (result == TRL_OK) {
        result = make_phase(out);
    }
    if (result != TRL_OK) {
        sky_finish(out);
    }
    return result;
}

void sky_finish(struct sky *sky)
{
    if (!sky->gpu) {
        return;
    }
    gpu_program_finish(&sky->bare.sort);
    gpu_program_finish(&sky->bare.ground);
    gpu_program_finish(&sky->surface.sort);
    gpu_program_finish(&sky->surface.ground);
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
    mem_free(sky->atmosphere->ctx, sky->texels);
    aerial_finish(&sky->aerial);
    *sky = (struct sky){0};
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

// The eye as the tables know it: never below the reference sphere.
static double eye_radius(const struct sky *sky, const struct camera *camera)
{
    return fmax(vec3_length(camera->position_m),
                sky->atmosphere->optics->ground_radius_m + AERIAL_MIN_ALTITUDE_M);
}

// From inside the air all rays start under one sun, so the slice has one; from outside each ray
// enters the air under its own.
static trl_result update_slices(struct sky *sky, double radius_m, double sun_mu)
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

static trl_result update_aerial(struct sky *sky, double radius_m, double sun_mu)
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

static trl_result update_ground_light(struct sky *sky, double highest_m)
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

trl_result sky_prepare(struct sky *sky, const struct camera *camera, double highest_m)
{
    const double radius_m = eye_radius(sky, camera);
    const double sun_mu = vec3_dot(vec3_normalize(camera->position_m), camera->sun_direction);
    trl_result result = update_slices(sky, radius_m, sun_mu);
    if (result == TRL_OK) {
        result = update_aerial(sky, radius_m, sun_mu);
    }
    return result == TRL_OK ? update_ground_light(sky, highest_m) : result;
}

static void set_vec3(struct gpu_program *program, const char *name, struct vec3 v)
{
    const float values[3] = {(float)v.x, (float)v.y, (float)v.z};
    gpu_program_set_vec3(program, name, values);
}

static void set_vec4(struct gpu_program *program, const char *name, double x, double y, double z,
                     double w)
{
    const float values[4] = {(float)x, (float)y, (float)z, (float)w};
    gpu_program_set_vec4(program, name, values);
}

static void set_view(const struct sky *sky, struct gpu_program *program,
                     const struct camera *camera, const struct gpu_target *target)
{
    const struct optics *optics = sky->atmosphere->optics;
    const double ground = optics->ground_radius_m;
    const double top = optics->top_radius_m;
    const double radius_m = eye_radius(sky, camera);
    const struct vec3 up = vec3_normalize(camera->position_m);
    set_vec3(program, "u_eye_up", up);
    set_vec3(program, "u_sun", camera->sun_direction);
    set_vec3(program, "u_forward", camera->forward);
    set_vec3(program, "u_right", vec3_scale(camera->right, camera->tan_half_fov_x));
    set_vec3(program, "u_up", vec3_scale(camera->up, camera->tan_half_fov_y));
    set_vec4(program, "u_eye", radius_m, radius_m - ground, vec3_dot(up, camera->sun_direction),
             radius_m > top);
    set_vec4(program, "u_planet", ground, top - ground, sqrt((top - ground) * (top + ground)), 0);
    set_vec4(program, "u_rows", sky->aerial.nearest_m, sky->aerial.farthest_m,
             sky->aerial.horizon_mu, sky->aerial.highest_mu);
    const double disc_rad = sky->atmosphere->solution.sun.disc_rad;
    set_vec4(program, "u_disc", cos(disc_rad), sin(disc_rad),
             2 * camera->tan_half_fov_y / target->height, 1.0 / GROUND_LIGHT_SUNS);
    set_vec4(program, "u_ground_light", 0, sky->highest_m, SUNLIGHT_SOFT,
             1.0 / GROUND_LIGHT_ALTITUDES);
}

// Columns of the matrices of the bands, as the shader multiplies them.
static void set_colours(const struct sky *sky, struct gpu_program *program)
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
    set_vec4(program, "u_ground_albedo", (double)(*albedo)[b->lane[0]],
             (double)(*albedo)[b->lane[1]], (double)(*albedo)[b->lane[2]],
             (double)(*albedo)[b->lane[3]]);
}

// Lights at night: white shows `white_cd_m2`.
static void set_lights(const struct sky *sky, struct gpu_program *program, double white_cd_m2)
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

static void set_maps(const struct sky *sky, struct gpu_program *program)
{
    const struct table *table = &sky->atmosphere->table;
    const float aerial_rows[2] = {AERIAL_GROUND_ROWS, AERIAL_ROWS};
    set_vec3(
        program, "u_slice_texel",
        (struct vec3){1.0 / table->size.azimuths, 1.0 / table->size.suns, 1.0 / table->size.views});
    set_vec3(program, "u_aerial_texel",
             (struct vec3){1.0 / AERIAL_DEPTHS, 1.0 / AERIAL_AZIMUTHS, 1.0 / AERIAL_ROWS});
    gpu_program_set_vec2(program, "u_aerial_rows", aerial_rows);
    set_vec4(program, "u_sun_grid", table->sun_centre, table->sun_width, table->sun_first,
             table->sun_last);
    gpu_program_set_float(program, "u_skylight_texel", 1.0f / (float)sky->skylight.width);
    for (int c = 0; c < table->channels; c++) {
        gpu_program_set_texture(program, SLICE_NAMES[c], &sky->slice[c]);
        gpu_program_set_texture(program, SCATTERED_NAMES[c], &sky->scattered[c]);
    }
    gpu_program_set_texture(program, "u_extinction", &sky->extinction);
    gpu_program_set_texture(program, "u_sunlight", &sky->sunlight);
    gpu_program_set_texture(program, "u_skylight", &sky->skylight);
    gpu_program_set_texture(program, "u_phase", &sky->phase);
}

// Pixels in which the star's disc may show. From far off the axis the disc looks longer: outward it
// reaches from the tangent of the angle to that of the angle and the disc's.
static struct gpu_rect find_star(const struct sky *sky, const struct camera *camera,
                                 const struct gpu_target *target)
{
    const double pixel_rad = 2 * camera->tan_half_fov_y / target->height;
    const double disc_rad = sky->atmosphere->solution.sun.disc_rad + pixel_rad;
    const double along = vec3_dot(camera->sun_direction, camera->forward);
    const double off_rad = acos(fmax(-1, fmin(1, along)));
    if (off_rad - disc_rad > M_PI / 2) {
        return (struct gpu_rect){0};
    }
    if (off_rad + disc_rad > 0.49 * M_PI) {
        return (struct gpu_rect){0, 0, target->width, target->height};
    }
    const double reach = tan(off_rad + disc_rad) - tan(off_rad);
    const double x = vec3_dot(camera->sun_direction, camera->right) / along;
    const double y = vec3_dot(camera->sun_direction, camera->up) / along;
    const double half_width = 0.5 * target->width / camera->tan_half_fov_x; // pixels
    const double half_height = 0.5 * target->height / camera->tan_half_fov_y;
    const double left = fmax(0, 0.5 * target->width + (x - reach) * half_width - 1);
    const double right = fmin(target->width, 0.5 * target->width + (x + reach) * half_width + 1);
    const double low = fmax(0, 0.5 * target->height + (y - reach) * half_height - 1);
    const double high = fmin(target->height, 0.5 * target->height + (y + reach) * half_height + 1);
    if (left >= right || low >= high) {
        return (struct gpu_rect){0};
    }
    return (struct gpu_rect){(uint32_t)left, (uint32_t)low, (uint32_t)ceil(right) - (uint32_t)left,
                             (uint32_t)ceil(high) - (uint32_t)low};
}

// One kind of pixels, by a depth between those of sort.frag and which side of it they are on.
static trl_result draw_kind(struct sky *sky, struct gpu_program *program, double depth,
                            const struct gpu_pass *pass)
{
    set_colours(sky, program);
    set_maps(sky, program);
    gpu_program_set_float(program, "u_depth", (float)depth);
    gpu_pass_begin(sky->gpu, pass);
    return gpu_draw_fullscreen(program, "sky");
}

static trl_result draw_air(struct sky *sky, const struct camera *camera,
                           const struct gpu_target *target)
{
    struct gpu_pass pass = {.target = target, .state.depth = GPU_DEPTH_NEARER};
    set_view(sky, &sky->air, camera, target);
    trl_result result = draw_kind(sky, &sky->air, 0.25, &pass);
    pass.scissor = find_star(sky, camera, target);
    if (result == TRL_OK && pass.scissor.width > 0) {
        set_view(sky, &sky->star, camera, target);
        result = draw_kind(sky, &sky->star, 0.75, &pass);
    }
    return result;
}

trl_result sky_draw(struct sky *sky, const struct camera *camera, const struct sky_surface *surface,
                    const struct gpu_target *target)
{
    const bool is_bare = !surface || !surface->position;
    struct sky_ground *programs = is_bare ? &sky->bare : &sky->surface;
    if (!is_bare) {
        gpu_program_set_texture(&programs->sort, "u_position", surface->position);
        gpu_program_set_texture(&programs->ground, "u_position", surface->position);
        gpu_program_set_texture(&programs->ground, "u_albedo", surface->albedo);
        gpu_program_set_texture(&programs->ground, "u_normal", surface->normal);
        gpu_program_set_texture(&programs->ground, "u_lights", surface->lights);
        set_lights(sky, &programs->ground, surface->lights_cd_m2);
    }
    const struct gpu_pass sort = {.target = target,
                                  .state = {.writes_depth = true, .hides_color = true},
                                  .clears_color = true,
                                  .color = {0, 0, 0, 1}};
    set_view(sky, &programs->sort, camera, target);
    trl_result result = draw_kind(sky, &programs->sort, 0.5, &sort);
    if (result == TRL_OK) {
        result = draw_air(sky, camera, target);
    }
    if (result == TRL_OK) {
        const struct gpu_pass pass = {.target = target, .state.depth = GPU_DEPTH_FARTHER};
        set_view(sky, &programs->ground, camera, target);
        result = draw_kind(sky, &programs->ground, 0.75, &pass);
    }
    return result;
}
