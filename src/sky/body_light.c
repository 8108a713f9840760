// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/body_light.h"

#include <math.h>

// Up to here the Moon has been measured; thinner crescents follow the law of the disc.
static const double LUNAR_LAST_RAD = 150 * M_PI / 180;

// The integral of Lommel-Seeliger's law over the lit part of a sphere in view.
static double integrate_lommel_seeliger(double angle_rad)
{
    if (angle_rad < 1e-6) {
        return 1;
    }
    const double half = 0.5 * angle_rad;
    // Near new the difference cancels; its series begins with x^2 / 6, x = pi - angle.
    const double x = M_PI - angle_rad;
    if (x < 1e-3) {
        return x * x / 6;
    }
    return 1 - sin(half) * tan(half) * log(1 / tan(0.5 * half));
}

static double integrate_lambert(double angle_rad)
{
    return (sin(angle_rad) + (M_PI - angle_rad) * cos(angle_rad)) / M_PI;
}

// Magnitudes below the full Moon: Krisciunas and Schaefer 1991, PASP 103, Eq. 9, after Allen.
static double measure_moon(double angle_rad)
{
    const double deg = angle_rad * 180 / M_PI;
    return pow(10, -0.4 * (0.026 * deg + 4e-9 * deg * deg * deg * deg));
}

double body_phase_scale(enum body_law law, double phase_angle_rad)
{
    if (law != BODY_LUNAR) {
        return 1;
    }
    const double measured = fmin(phase_angle_rad, LUNAR_LAST_RAD);
    return measure_moon(measured) / integrate_lommel_seeliger(measured);
}

double body_phase(enum body_law law, double phase_angle_rad)
{
    const double angle_rad = fmin(fmax(phase_angle_rad, 0), M_PI);
    switch (law) {
    case BODY_LAMBERT:
        return integrate_lambert(angle_rad);
    case BODY_LOMMEL_SEELIGER:
    case BODY_LUNAR:
        break;
    }
    return integrate_lommel_seeliger(angle_rad) * body_phase_scale(law, angle_rad);
}

struct body_sight body_see(const struct camera *camera, const struct camera_body *body)
{
    const struct vec3 way_m = vec3_sub(body->position_m, camera->position_m);
    const struct vec3 direction = vec3_normalize(way_m);
    const double across = vec3_length(vec3_cross(direction, camera->sun_direction));
    return (struct body_sight){.direction = direction,
                               .sine = fmin(body->radius_m / vec3_length(way_m), 1),
                               .phase_angle_rad =
                                   atan2(across, -vec3_dot(direction, camera->sun_direction))};
}

double body_share(enum body_law law, const struct body_sight *sight)
{
    return sight->sine * sight->sine * body_phase(law, sight->phase_angle_rad);
}
