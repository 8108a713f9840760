// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/eclipse.h"

#include <math.h>

// Radius of the body's penumbra at a place so far behind it.
static double penumbra_m(const struct camera_body *body, double behind_m, double disc_rad)
{
    return body->radius_m + behind_m * tan(disc_rad);
}

static double across_m(struct vec3 from_body, struct vec3 sun)
{
    return vec3_length(vec3_sub(from_body, vec3_scale(sun, vec3_dot(from_body, sun))));
}

static bool reaches(const struct sky_pixels *pixels, const struct camera *camera,
                    const struct camera_body *body)
{
    const double top_m = pixels->top_radius_m;
    const double before_m = vec3_dot(body->position_m, camera->sun_direction);
    const struct vec3 eye = vec3_sub(camera->position_m, body->position_m);
    const double eye_behind_m = -vec3_dot(eye, camera->sun_direction);
    const bool planet =
        before_m > top_m && across_m(body->position_m, camera->sun_direction) <
                                top_m + penumbra_m(body, before_m + top_m, pixels->disc_rad);
    return planet ||
           (eye_behind_m > body->radius_m && across_m(eye, camera->sun_direction) <
                                                 penumbra_m(body, eye_behind_m, pixels->disc_rad));
}

int sky_eclipse_find(const struct sky_pixels *pixels, const struct camera *camera)
{
    int found = -1;
    double nearest_m = HUGE_VAL;
    for (unsigned i = 0; i < camera->body_count; i++) {
        const struct camera_body *body = &camera->bodies[i];
        const double off_m = across_m(body->position_m, camera->sun_direction);
        if (reaches(pixels, camera, body) && off_m < nearest_m) {
            nearest_m = off_m;
            found = (int)i;
        }
    }
    return found;
}

// The place where the shadow's axis meets the ground, or passes it nearest.
struct axis {
    struct vec3 up; // unit, from the planet's centre
    struct vec3 u;  // unit, across: see scatter/umbra.h
    struct umbra_shadow shadow;
};

static struct axis find_axis(const struct sky_pixels *pixels, const struct camera *camera)
{
    const struct camera_body *body = &camera->bodies[sky_eclipse_find(pixels, camera)];
    const struct vec3 sun = camera->sun_direction;
    const double before_m = vec3_dot(body->position_m, sun);
    const struct vec3 across = vec3_sub(body->position_m, vec3_scale(sun, before_m));
    const double ground_m = pixels->ground_radius_m;
    const double off_m = vec3_length(across);
    const double toward_m = off_m < ground_m ? sqrt((ground_m - off_m) * (ground_m + off_m)) : 0;
    struct axis axis = {
        .up = vec3_normalize(vec3_add(across, vec3_scale(sun, toward_m))),
        .shadow = {.radius_m = body->radius_m,
                   .along_m = before_m - toward_m,
                   .star_rad = pixels->disc_rad,
                   .star_mu = toward_m / ground_m},
    };
    // Away from the zenith; if the star is there, all ways across are alike.
    const struct vec3 level = vec3_sub(vec3_scale(sun, vec3_dot(sun, axis.up)), axis.up);
    const struct vec3 any = fabs(sun.x) < 0.7 ? (struct vec3){1, 0, 0} : (struct vec3){0, 1, 0};
    axis.u =
        vec3_length(level) > 1e-6 ? vec3_normalize(level) : vec3_normalize(vec3_cross(sun, any));
    return axis;
}

void sky_eclipse_finish(struct sky_eclipse *eclipse)
{
    if (eclipse->gpu) {
        gpu_texture_finish(&eclipse->air);
        gpu_texture_finish(&eclipse->ground);
        mem_free(eclipse->gpu->ctx, eclipse->kernel);
        mem_free(eclipse->gpu->ctx, eclipse->map);
    }
    *eclipse = (struct sky_eclipse){0};
}

static trl_result begin(const struct sky_pixels *pixels, const struct atmosphere *atmosphere,
                        struct sky_eclipse *eclipse)
{
    const trl_context *ctx = pixels->gpu->ctx;
    eclipse->gpu = pixels->gpu;
    eclipse->kernel = mem_alloc(ctx, 1, sizeof *eclipse->kernel);
    eclipse->map = mem_alloc(ctx, 1, sizeof *eclipse->map);
    if (!eclipse->kernel || !eclipse->map) {
        return TRL_ERROR_MEMORY;
    }
    umbra_kernel_init(atmosphere->optics, atmosphere->bands.lane, eclipse->kernel);
    const uint32_t air[3] = {UMBRA_US, UMBRA_VS, UMBRA_ALTITUDES};
    const uint32_t ground[3] = {UMBRA_US, UMBRA_VS, 1};
    const trl_result result = sky_make_map(eclipse->gpu, "umbra", air, NULL, &eclipse->air);
    return result == TRL_OK ? sky_make_map(eclipse->gpu, "umbra", ground, NULL, &eclipse->ground)
                            : result;
}

static trl_result upload(struct sky_eclipse *eclipse)
{
    const struct gpu_region air = gpu_texture_region(&eclipse->air, 0);
    const struct gpu_region ground = gpu_texture_region(&eclipse->ground, 0);
    const trl_result result = gpu_texture_upload(&eclipse->air, &air, eclipse->map->air);
    return result == TRL_OK ? gpu_texture_upload(&eclipse->ground, &ground, eclipse->map->ground)
                            : result;
}

// A map serves for other places of the eye, and while the shadow hardly changes: its edges by a
// thousandth of the body's radius, the star's height by 0.1 degrees.
static bool is_same(const struct umbra_shadow *a, const struct umbra_shadow *b)
{
    return a->radius_m == b->radius_m && a->star_rad == b->star_rad &&
           fabs(a->along_m - b->along_m) * a->star_rad < 1e-3 * a->radius_m &&
           fabs(a->star_mu - b->star_mu) < 2e-3;
}

trl_result sky_eclipse_update(const struct sky_pixels *pixels, const struct camera *camera,
                              const struct atmosphere *atmosphere, struct sky_eclipse *eclipse)
{
    if (sky_eclipse_find(pixels, camera) < 0) {
        return TRL_OK;
    }
    struct axis axis = find_axis(pixels, camera);
    axis.shadow.orders = eclipse->orders;
    eclipse->corona = atmosphere->medium.star_corona;
    eclipse->place_m = vec3_scale(axis.up, pixels->ground_radius_m);
    if (eclipse->kernel && is_same(&eclipse->shadow, &axis.shadow)) {
        return TRL_OK;
    }
    trl_result result = eclipse->kernel ? TRL_OK : begin(pixels, atmosphere, eclipse);
    if (result == TRL_OK) {
        result = umbra_map_make(eclipse->gpu->ctx, eclipse->kernel, &axis.shadow,
                                &atmosphere->bands, eclipse->map);
    }
    if (result == TRL_OK) {
        result = upload(eclipse);
    }
    if (result == TRL_OK) {
        eclipse->shadow = axis.shadow;
    } else {
        sky_eclipse_finish(eclipse);
    }
    return result;
}

double sky_eclipse_width(const struct sky_eclipse *eclipse, const struct camera *camera)
{
    const struct umbra_shadow *shadow = &eclipse->shadow;
    const double half_m = fabs(shadow->radius_m - shadow->along_m * shadow->star_rad);
    const double away_m = vec3_length(vec3_sub(camera->position_m, eclipse->place_m));
    return 2 * half_m / fmax(away_m, half_m);
}

void sky_eclipse_set(const struct sky_pixels *pixels, const struct sky_eclipse *eclipse,
                     const struct camera *camera, struct gpu_program *program)
{
    const struct camera_body *body = &camera->bodies[sky_eclipse_find(pixels, camera)];
    const struct axis axis = find_axis(pixels, camera);
    const struct vec3 sun = camera->sun_direction;
    const struct vec3 from_eye = vec3_sub(body->position_m, camera->position_m);
    const double toward_m = vec3_dot(from_eye, sun);
    const struct vec3 across = vec3_sub(from_eye, vec3_scale(sun, toward_m));
    const double away_m = fmax(vec3_length(from_eye), body->radius_m);
    const struct vec3 direction = vec3_normalize(from_eye);
    sky_set_vec4(program, "u_body", across.x, across.y, across.z, body->radius_m);
    sky_set_vec4(program, "u_body_rays", direction.x, direction.y, direction.z,
                 body->radius_m / away_m);
    sky_set_vec3(program, "u_eclipse",
                 (struct vec3){toward_m, pixels->disc_rad, eclipse->map->scale_m});
    sky_set_vec3(program, "u_umbra_u", axis.u);
    gpu_program_set_float(program, "u_corona", (float)eclipse->corona);
    gpu_program_set_texture(program, "u_umbra_air", &eclipse->air);
    gpu_program_set_texture(program, "u_umbra_ground", &eclipse->ground);
}
