// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/moonlight.h"

#include "spectrum/cie.h"

#include <math.h>
#include <stdio.h>

// Of the star's light: a code of a picture in its middle tones is 1.2 % of the luminance
// (docs/physics.md, sections 15 and 24), and half of one cannot be seen.
static const double SMALLEST_SHARE = 0.005;

// Of the light of the stars alone, which is 5e-4 lx: what is dimmer cannot be seen either.
static const double SMALLEST_LX = 2.5e-6;

void moonlight_init(const struct sky_desc *desc, struct spectral_sea *sea, struct moonlight *out)
{
    *out = (struct moonlight){.gpu = desc->gpu, .sea = sea, .body_count = desc->body_count};
    for (size_t i = 0; i < desc->body_count; i++) {
        out->bodies[i] = desc->bodies[i];
    }
}

void moonlight_finish(struct moonlight *moonlight)
{
    moonlight_drop(moonlight);
    *moonlight = (struct moonlight){0};
}

void moonlight_drop(struct moonlight *moonlight)
{
    gpu_program_finish(&moonlight->air);
    gpu_program_finish(&moonlight->ground_bare);
    gpu_program_finish(&moonlight->ground_surface);
    moonlight->has_programs = false;
    spectral_maps_finish(&moonlight->maps);
}

// Irradiance of level ground by star and sky, per unit irradiance of the star.
static lanes light_ground(const struct atmosphere *a, double zenith_rad)
{
    const double mu = cos(fmin(fmax(zenith_rad, 0), M_PI));
    lanes star;
    sunlight_ground_at(&a->solution.sun, mu, &star);
    return star + moments_irradiance(&a->solution.moments, mu);
}

// Of irradiance per unit irradiance of the star.
static double illuminance_lx(const struct atmosphere *a, lanes light)
{
    double sum = 0;
    for (int k = 0; k < LANES; k++) {
        sum += (double)a->bands.xyz_from_lanes[1][k] * (double)light[k];
    }
    return sum;
}

// Irradiance that the body sends, per unit irradiance of the star.
static double reflect(const struct body_desc *body, const struct body_sight *sight, double nm)
{
    return spectrum_at(body->geometric_albedo, nm) * body_share(body->law, sight);
}

static lanes reflect_lanes(const struct atmosphere *a, const struct body_desc *body,
                           const struct body_sight *sight)
{
    lanes light;
    for (int k = 0; k < LANES; k++) {
        light[k] = (float)reflect(body, sight, a->optics->wavelength_nm[k]);
    }
    return light;
}

static double angle_between(struct vec3 a, struct vec3 b)
{
    return acos(fmin(fmax(vec3_dot(a, b), -1), 1));
}

// What a view shows of the planet.
struct scope {
    const struct atmosphere *atmosphere;
    struct camera foot; // of the eye, on the reference sphere
    struct vec3 up;
    double air_rad, ground_rad; // reach of what is seen
};

static struct scope find_scope(const struct atmosphere *a, const struct camera *camera,
                               double highest_m)
{
    const struct optics *o = a->optics;
    struct scope scope = {
        .atmosphere = a, .foot = *camera, .up = vec3_normalize(camera->position_m)};
    const double eye_m = vec3_length(camera->position_m);
    scope.foot.position_m = vec3_scale(scope.up, o->ground_radius_m);
    scope.air_rad = sky_reach_rad(o->ground_radius_m, eye_m, o->top_radius_m - o->ground_radius_m);
    scope.ground_rad = sky_reach_rad(o->ground_radius_m, eye_m, highest_m);
    return scope;
}

static bool is_main(const struct scope *scope, const struct body_desc *body,
                    const struct body_sight *sight)
{
    const struct atmosphere *a = scope->atmosphere;
    const double star_rad = angle_between(scope->up, scope->foot.sun_direction);
    const double body_rad = angle_between(scope->up, sight->direction);
    const lanes light = light_ground(a, body_rad) * reflect_lanes(a, body, sight);
    return star_rad - scope->ground_rad - a->solution.sun.disc_rad > M_PI / 2 &&
           illuminance_lx(a, light) > illuminance_lx(a, light_ground(a, star_rad));
}

struct sky_moon moonlight_find(const struct moonlight *moonlight, const struct atmosphere *a,
                               const struct camera *camera, double highest_m)
{
    if (camera->body_count == 0) {
        return (struct sky_moon){0};
    }
    const struct scope scope = find_scope(a, camera, highest_m);
    const double star_rad = angle_between(scope.up, camera->sun_direction);
    const double star_lx = illuminance_lx(a, light_ground(a, star_rad + scope.air_rad));
    double most_lx = fmax(SMALLEST_SHARE * star_lx, SMALLEST_LX);
    struct sky_moon moon = {0};
    for (unsigned i = 0; i < camera->body_count; i++) {
        const struct body_sight sight = body_see(&scope.foot, &camera->bodies[i]);
        const struct body_desc *body = &moonlight->bodies[camera->bodies[i].index];
        const double body_rad = angle_between(scope.up, sight.direction);
        const lanes light =
            light_ground(a, body_rad - scope.air_rad) * reflect_lanes(a, body, &sight);
        const double lx = illuminance_lx(a, light);
        if (lx > most_lx) {
            most_lx = lx;
            moon = (struct sky_moon){.is_there = true,
                                     .is_main = is_main(&scope, body, &sight),
                                     .index = camera->bodies[i].index,
                                     .sight = sight};
        }
    }
    return moon;
}

static trl_result make_program(const struct moonlight *moonlight, const char *fragment,
                               const char *define, struct gpu_program *out)
{
    char peaked[32];
    snprintf(peaked, sizeof peaked, "PEAKED_COUNT %d", moonlight->maps.atmosphere->peaked.count);
    const char *defines[5] = {peaked, "MOON"};
    size_t count = 2;
    if (define) {
        defines[count++] = define;
    }
    if (define && moonlight->sea->water.sea) {
        defines[count++] = "SEA";
    }
    if (moonlight->has_clouds) {
        defines[count++] = "CLOUDS";
    }
    const struct gpu_program_desc desc = {.vertex = "lib/layer.vert",
                                          .fragment = fragment,
                                          .defines = defines,
                                          .define_count = count};
    gpu_program_finish(out); // what an attempt that failed has left
    return gpu_program_init(moonlight->gpu, &desc, out);
}

static trl_result make_programs(struct moonlight *m)
{
    trl_result result = make_program(m, "sky/spectral/sky.frag", NULL, &m->air);
    if (result == TRL_OK) {
        result = make_program(m, "sky/spectral/ground.frag", NULL, &m->ground_bare);
    }
    if (result == TRL_OK) {
        result = make_program(m, "sky/spectral/ground.frag", "SURFACE", &m->ground_surface);
    }
    m->has_programs = result == TRL_OK;
    return result;
}

trl_result moonlight_prepare(struct moonlight *moonlight, const struct spectral_maps *star,
                             const struct sky_view *view)
{
    if (!view->moon.is_there) {
        return TRL_OK;
    }
    trl_result result = TRL_OK;
    if (!moonlight->maps.atmosphere) {
        result = spectral_maps_init_beside(star, &moonlight->maps);
    }
    const bool has_clouds = view->cloud_shade != NULL;
    if (result == TRL_OK && (!moonlight->has_programs || moonlight->has_clouds != has_clouds)) {
        moonlight->has_clouds = has_clouds;
        result = make_programs(moonlight);
    }
    const struct vec3 up = vec3_normalize(view->camera->position_m);
    const struct spectral_eye eye = {
        .radius_m = fmax(vec3_length(view->camera->position_m),
                         star->atmosphere->optics->ground_radius_m + SKY_MIN_ALTITUDE_M),
        .sun_mu = vec3_dot(up, view->moon.sight.direction),
        .highest_m = fmax(view->highest_m, view->cloud_top_m)};
    return result == TRL_OK ? spectral_maps_update(&moonlight->maps, &eye) : result;
}

static struct cie_rgb find_colour(const struct atmosphere *a, const lanes *light)
{
    double xyz[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < LANES; k++) {
            xyz[i] += (double)a->bands.xyz_from_lanes[i][k] * (double)(*light)[k];
        }
    }
    return cie_rgb_of_xyz((struct cie_xyz){xyz[0], xyz[1], xyz[2]});
}

// The air's light is known as a colour, so its other spectrum has to be factors on primaries: those
// of the light of the whole sky. Where the star has next to nothing of a primary, that of the
// luminance.
static void find_factors(const struct atmosphere *a, const lanes *reflected, double zenith_rad,
                         double factors[3])
{
    const lanes star = moments_irradiance(&a->solution.moments, cos(zenith_rad));
    const lanes moon = star * *reflected;
    const struct cie_rgb by_star = find_colour(a, &star);
    const struct cie_rgb by_moon = find_colour(a, &moon);
    const double star_lx = illuminance_lx(a, star);
    const double luminance = star_lx > 0 ? illuminance_lx(a, moon) / star_lx : 0;
    const double ratios[3] = {by_moon.r / by_star.r, by_moon.g / by_star.g, by_moon.b / by_star.b};
    const double parts[3] = {by_star.r / star_lx, by_star.g / star_lx, by_star.b / star_lx};
    for (int i = 0; i < 3; i++) {
        factors[i] = star_lx > 0 && parts[i] > 0.02 ? fmax(ratios[i], 0) : luminance;
    }
}

// Colours and maps; `view` as if the moon were the star.
static void set_light(const struct moonlight *moonlight, struct gpu_program *program,
                      const struct sky_view *view)
{
    const struct atmosphere *a = moonlight->maps.atmosphere;
    const struct body_desc *body = &moonlight->bodies[view->moon.index];
    const struct body_sight *sight = &view->moon.sight;
    const lanes reflected = reflect_lanes(a, body, sight);
    const struct vec3 up = vec3_normalize(view->camera->position_m);
    struct bands bands = a->bands;
    double factors[3];
    find_factors(a, &reflected, angle_between(up, sight->direction), factors);
    for (int k = 0; k < 3; k++) {
        for (int r = 0; r < BAND_COUNT; r++) {
            bands.rgb_from_bands[k][r] *= (float)reflect(body, sight, bands.nm[r]);
        }
    }
    sky_set_bands(program, &bands, a->optics, 0);
    sky_set_primaries(program, factors);
    gpu_program_set_float(program, "u_shadowed", view->moon.is_main ? 1 : 0);
    spectral_maps_bind(&moonlight->maps, program);
}

// The view as if the moon were the star.
struct moonlit {
    struct camera camera;
    struct sky_view view;
};

static void light_by_moon(const struct sky_view *view, struct moonlit *out)
{
    out->camera = *view->camera;
    out->camera.sun_direction = view->moon.sight.direction;
    out->view = *view;
    out->view.camera = &out->camera;
    out->view.is_added = true;
}

void moonlight_bind(const struct moonlight *moonlight, const struct sky_pixels *pixels,
                    const struct sky_view *view, struct gpu_program *program)
{
    struct moonlit moonlit;
    light_by_moon(view, &moonlit);
    sky_pixels_set_view(pixels, program, &moonlit.view);
    set_light(moonlight, program, &moonlit.view);
}

static trl_result draw_kind(struct moonlight *moonlight, const struct sky_pixels *pixels,
                            enum sky_kind kind, const struct sky_view *view)
{
    struct gpu_program *program = &moonlight->air;
    if (kind == SKY_KIND_SEA) {
        program = &moonlight->sea->programs[moonlight->has_clouds ? SEA_CLOUDED : 0];
        spectral_sea_set(moonlight->sea, view, program);
    }
    if (kind == SKY_KIND_GROUND) {
        program = sky_view_is_bare(view) ? &moonlight->ground_bare : &moonlight->ground_surface;
    }
    set_light(moonlight, program, view);
    if (moonlight->has_clouds && kind != SKY_KIND_AIR) {
        gpu_program_set_texture(program, "u_cloud_shade", view->cloud_shade);
        sky_pixels_set_deck(program, view);
    }
    return sky_pixels_draw(pixels, program, kind, view);
}

trl_result moonlight_draw(struct moonlight *moonlight, const struct sky_pixels *pixels,
                          const struct sky_view *view)
{
    if (!view->moon.is_there) {
        return TRL_OK;
    }
    struct moonlit moonlit;
    light_by_moon(view, &moonlit);
    trl_result result = draw_kind(moonlight, pixels, SKY_KIND_AIR, &moonlit.view);
    if (result == TRL_OK) {
        result = draw_kind(moonlight, pixels, SKY_KIND_GROUND, &moonlit.view);
    }
    return result == TRL_OK && sea_water_is_seen(&moonlight->sea->water, view)
               ? draw_kind(moonlight, pixels, SKY_KIND_SEA, &moonlit.view)
               : result;
}
