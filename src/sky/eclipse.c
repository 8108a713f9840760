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
    double nearest_m = INFINITY;
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

// Mean altitude of what scatters at the wavelength nearest to 550 nm, and its optical depth.
static double mean_altitude(const struct optics *o, double *depth)
{
    enum { PARTS = 1000 };
    int lane = 0;
    for (int i = 1; i < o->wavelength_count; i++) {
        if (fabs(o->wavelength_nm[i] - 550) < fabs(o->wavelength_nm[lane] - 550)) {
            lane = i;
        }
    }
    const double step_m = (o->top_radius_m - o->ground_radius_m) / PARTS;
    double moment = 0;
    *depth = 0;
    for (int i = 0; i < PARTS; i++) {
        const double altitude_m = (i + 0.5) * step_m;
        for (int c = 0; c < o->constituent_count; c++) {
            const double part = (double)o->scattering_per_m[c][lane] * step_m *
                                profile_density(&o->medium->constituents[c].profile, altitude_m);
            *depth += part;
            moment += part * altitude_m;
        }
    }
    return *depth > 0 ? moment / *depth : 0;
}

double sky_eclipse_spread(const struct optics *optics)
{
    double depth = 0;
    const double altitude_m = mean_altitude(optics, &depth);
    const double farthest_m = sqrt(2 * optics->ground_radius_m * altitude_m);
    return depth > 0 ? fmin(altitude_m / fmin(depth, 1), farthest_m) : 0;
}

void sky_eclipse_set(const struct sky_pixels *pixels, struct gpu_program *program,
                     const struct camera *camera, double spread_m)
{
    const struct camera_body *body = &camera->bodies[sky_eclipse_find(pixels, camera)];
    const struct vec3 sun = camera->sun_direction;
    const struct vec3 from_eye = vec3_sub(body->position_m, camera->position_m);
    const double toward_m = vec3_dot(from_eye, sun);
    const struct vec3 across = vec3_sub(from_eye, vec3_scale(sun, toward_m));
    const double away_m = fmax(vec3_length(from_eye), body->radius_m);
    const struct vec3 direction = vec3_normalize(from_eye);
    sky_set_vec4(program, "u_body", across.x, across.y, across.z, body->radius_m);
    sky_set_vec4(program, "u_body_rays", direction.x, direction.y, direction.z,
                 body->radius_m / away_m);
    sky_set_vec3(program, "u_shadow", (struct vec3){toward_m, pixels->disc_rad, spread_m});
}
