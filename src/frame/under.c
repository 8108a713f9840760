// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/under.h"

#include "shared/sea.glsl"
#include "shared/sky_map.glsl"

#include <math.h>
#include <stdio.h>

// Half of the way over which the bed's slope is found.
static const double SLOPE_M = 100;
// An eye in the surface is so deep at least.
static const double LEAST_DEPTH_M = 0.01;

void under_init(struct gpu *gpu, const struct trl_scene *scene, const struct frame_sea *sea,
                struct ground *ground, struct under *out)
{
    *out = (struct under){.gpu = gpu,
                          .scene = scene,
                          .sea = sea,
                          .ground = ground,
                          .columns = {.ctx = gpu->ctx, .ocean = &scene->ocean}};
}

void under_forget(struct under *under)
{
    gpu_program_finish(&under->program);
    gpu_texture_finish(&under->light);
    gpu_texture_finish(&under->scatter);
    under->bands = NULL;
}

void under_finish(struct under *under)
{
    if (under->gpu) {
        under_forget(under);
        under_columns_finish(&under->columns);
        mem_free(under->gpu->ctx, under->maps);
    }
    *under = (struct under){0};
}

static double depth_at(const struct under *under, struct vec3 place)
{
    const struct vec3 up = vec3_normalize(place);
    return ground_water_depth_m(under->ground, asin(fmax(-1, fmin(1, up.z))), atan2(up.y, up.x));
}

// From differences of depth east and north; of all water alike there is none.
static struct vec3 find_slope(const struct under *under, struct vec3 place)
{
    const struct vec3 up = vec3_normalize(place);
    const struct vec3 pole = fabs(up.z) < 0.999 ? (struct vec3){0, 0, 1} : (struct vec3){1, 0, 0};
    const struct vec3 east = vec3_normalize(vec3_cross(pole, up)), north = vec3_cross(up, east);
    const struct vec3 axes[2] = {east, north};
    struct vec3 slope = {0, 0, 0};
    for (int i = 0; i < 2; i++) {
        const struct vec3 way = vec3_scale(axes[i], SLOPE_M);
        const double change =
            depth_at(under, vec3_add(place, way)) - depth_at(under, vec3_sub(place, way));
        slope = vec3_add(slope, vec3_scale(axes[i], change / (2 * SLOPE_M)));
    }
    return slope;
}

bool under_find(const struct under *under, const struct sky *sky, const struct camera *camera,
                double time_s, struct under_eye *out)
{
    const struct vec3 up = vec3_normalize(camera->position_m);
    const double latitude_rad = asin(fmax(-1, fmin(1, up.z)));
    const double longitude_rad = atan2(up.y, up.x);
    const double level_m = under->scene->medium.ground_radius_m +
                           ground_altitude_m(under->ground, latitude_rad, longitude_rad);
    *out = (struct under_eye){.depth_m = level_m - vec3_length(camera->position_m)};
    // No wave is higher than this.
    if (!under->scene->ocean.is_there || !sky->model->get_air || out->depth_m < -50) {
        return false;
    }
    out->bed_m = ground_water_depth_m(under->ground, latitude_rad, longitude_rad);
    if (!(out->bed_m > 0)) {
        return false;
    }
    out->depth_m += ground_wave_m(under->ground, latitude_rad, longitude_rad, time_s);
    if (!(out->depth_m > 0)) {
        return false;
    }
    out->depth_m = fmin(fmax(out->depth_m, LEAST_DEPTH_M), 0.999 * out->bed_m);
    out->slope = find_slope(under, camera->position_m);
    return true;
}

static trl_result make_program(struct under *under, const struct sky_air *air)
{
    if (under->program.name) {
        return TRL_OK;
    }
    char peaked[32];
    snprintf(peaked, sizeof peaked, "PEAKED_COUNT %d", air->peaked_count);
    const char *const defines[] = {peaked, "WAVES"};
    const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                          .fragment = "sky/spectral/under.frag",
                                          .defines = defines,
                                          .define_count = under->ground->has_waves ? 2 : 1};
    return gpu_program_init(under->gpu, &desc, &under->program);
}

static trl_result upload(struct under *under, const char *label, uint32_t width, uint32_t height,
                         const float *texels, struct gpu_texture *out)
{
    gpu_texture_finish(out);
    return sky_make_map(under->gpu, label, (const uint32_t[]){width, height, 1}, texels, out);
}

static trl_result make_maps(struct under *under, const struct bands *bands,
                            const struct under_place *place)
{
    const struct under_place *old = &under->place;
    if (under->bands == bands && place->eye_depth_m == old->eye_depth_m &&
        place->depth_m == old->depth_m && place->sun_mu == old->sun_mu) {
        return TRL_OK;
    }
    const trl_context *ctx = under->gpu->ctx;
    under->bands = NULL;
    under->maps = under->maps ? under->maps : mem_alloc(ctx, 1, sizeof *under->maps);
    trl_result result = under->maps ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = under_columns_find(&under->columns, place->depth_m);
    }
    if (result == TRL_OK) {
        under_light_fill(&under->columns, place, under->sea->volume, bands, under->maps);
        result = upload(under, "light in the water", UNDER_COLUMNS, UNDER_ROWS,
                        &under->maps->light[0][0][0], &under->light);
    }
    if (result == TRL_OK) {
        result = upload(under, "scattering in the water", UNDER_ANGLES, UNDER_SCATTER_ROWS,
                        under->maps->scatter[0][0], &under->scatter);
    }
    if (result == TRL_OK) {
        under->bands = bands;
        under->place = *place;
    }
    return result;
}

// Toward the refracted middle of the star's visible part, and what enters of its light.
static void set_star(struct under *under, const struct camera *camera)
{
    const struct sky_sea *sea = &under->sea->sea;
    const struct vec3 up = vec3_normalize(camera->position_m), sun = camera->sun_direction;
    const double level = under->place.sun_mu, mu = vec3_dot(sun, up);
    const struct vec3 along = vec3_sub(sun, vec3_scale(up, mu));
    const double sine = sqrt(fmax(1 - level * level, 0)) / under->columns.of[0]->index;
    const double length = fmax(vec3_length(along), 1e-9);
    const struct vec3 star =
        vec3_add(vec3_scale(along, sine / length), vec3_scale(up, sqrt(1 - sine * sine)));
    double mirror_mu;
    const double entered = 1 - sea_surface_reflectance(sea, fmax(level, 1e-3), &mirror_mu);
    sky_set_vec4(&under->program, "u_under_star", star.x, star.y, star.z, entered);
}

static void set_uniforms(struct under *under, const struct camera *camera,
                         const struct under_eye *eye)
{
    struct gpu_program *program = &under->program;
    const struct under_light_maps *maps = under->maps;
    const struct sky_sea *sea = &under->sea->sea;
    const double radius = under->scene->medium.star_angular_radius_rad;
    const double bend = sea->index - 1;
    sky_set_vec4(program, "u_under", eye->depth_m, eye->bed_m, fmax(sea->mean_square_slope, 1e-6),
                 sea->index);
    sky_set_vec3(program, "u_under_slope", eye->slope);
    // Facets that turn by a slope turn the refracted ray by (index - 1) of it in the air.
    gpu_program_set_float(program, "u_under_disc",
                          (float)fmax(radius * radius / (2 * bend * bend), 1e-6));
    set_star(under, camera);
    gpu_program_set_vec4(program, "u_under_peak", maps->peak);
    gpu_program_set_vec4(program, "u_under_bed", maps->bed);
    gpu_program_set_vec4(program, "u_under_bed_star", maps->bed_star);
    gpu_program_set_vec4(program, "u_under_bed_sky", maps->bed_sky);
    gpu_program_set_texture(program, "u_under_light", &under->light);
    gpu_program_set_texture(program, "u_under_scatter", &under->scatter);
}

trl_result under_draw(struct under *under, const struct sky *sky, const struct sky_view *view,
                      const struct under_eye *eye, double time_s)
{
    const struct camera *camera = view->camera;
    const struct sky_air air = sky_get_air(sky, view);
    const double sun_mu = vec3_dot(vec3_normalize(camera->position_m), camera->sun_direction);
    const double disc = sin(under->scene->medium.star_angular_radius_rad);
    const struct under_place place = {eye->depth_m, eye->bed_m, visible_height(sun_mu, disc)};
    struct wave_texture *waves = &under->ground->facets.waves;
    trl_result result = make_program(under, &air);
    if (result == TRL_OK) {
        result = make_maps(under, air.bands, &place);
    }
    if (result == TRL_OK && under->ground->has_waves) {
        result = wave_texture_update(waves, camera->position_m, time_s);
    }
    if (result != TRL_OK) {
        return result;
    }
    air.bind(air.self, view, true, &under->program);
    set_uniforms(under, camera, eye);
    if (under->ground->has_waves) {
        wave_texture_bind(waves, &under->program);
    }
    const struct gpu_pass pass = {.target = view->target};
    gpu_pass_begin(under->gpu, &pass);
    return gpu_draw_fullscreen(&under->program, "under water");
}
