// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/projection.h"

#include "shared/shared.glsl"

#include <math.h>

// The mesh is data made once: a camera that stays within these sees no vertex move.
static const double THRESHOLD_OF_HEIGHT = 0.15;
static const double MIN_THRESHOLD_M = 10;
static const double NEAR_TEXELS = 3;
// Noise goes on below; a grid that followed it would have nothing left for the distance. With 400 m
// the ground in front of a camera 200 m high was the worst of its picture.
static const double NOISE_TEXEL_M = 130;
static const double MAX_POWER = 4; // beyond, far rings lie too far apart

double projection_lift(double distance_m, double ground_m, double peak_m)
{
    const double d = distance_m;
    const double r = ground_m;
    const double h = sqrt(fmax(0, (d - r) * (d + r)));
    const double s = sqrt(fmax(0, (peak_m - r) * (peak_m + r)));
    // Eq. 3 with R^2 + d^2 - (h + s)^2 = 2 (r^2 - h s), which does not cancel.
    return (r * r - h * s) / (r * (h + s));
}

bool projection_is_stale(const struct projection *p, const struct surface *surface, double more_rad,
                         const struct camera *camera)
{
    return !p->is_made ||
           surface_has_changed(surface, p->revision, p->anchor.up, p->reach_rad + more_rad) ||
           projection_moved(p, camera) > 1;
}

double projection_moved(const struct projection *p, const struct camera *camera)
{
    return vec3_length(vec3_sub(camera->position_m, p->position_m)) / p->threshold_m;
}

struct surface_eye projection_eye(const struct projection *p, const struct surface *surface,
                                  double more_rad)
{
    return (struct surface_eye){.up = p->anchor.up,
                                .reach_rad = p->reach_rad + more_rad,
                                .height_rad = p->height_m / surface->radius_m};
}

// Height in metres of a texel of the finest elevations in reach.
static double find_texel(const struct surface *surface, const struct projection *p)
{
    const struct surface_eye eye = projection_eye(p, surface, 0);
    const struct surface_selection seen = surface_select(surface, &eye);
    double finest = p->reach_rad;
    for (size_t i = 0; i < seen.counts[SURFACE_ELEVATION]; i++) {
        const size_t index = seen.indices[SURFACE_ELEVATION][i];
        const struct terrain_layer *layer = &surface->layers[SURFACE_ELEVATION][index];
        finest = fmin(finest, layer_finest_frame(layer)->texel_height);
    }
    if (noise_is_there(&surface->noise)) {
        finest = fmin(finest, NOISE_TEXEL_M / surface->radius_m);
    }
    return finest * surface->radius_m;
}

struct projection projection_make(const struct surface *surface, const struct camera *camera)
{
    const double distance = vec3_length(camera->position_m);
    const double ground = surface->radius_m + surface_altitude(surface, camera->position_m);
    struct projection p = {.is_made = true,
                           .revision = surface_revision(surface),
                           .position_m = camera->position_m,
                           .anchor = anchor_below(camera->position_m),
                           .height_m = fmax(distance - ground, 0.1)};
    p.threshold_m = fmax(MIN_THRESHOLD_M, THRESHOLD_OF_HEIGHT * p.height_m);
    double low = surface_min_altitude(surface);
    double high = surface_max_altitude(surface);
    // The highest mountain of the planet may be out of reach; then so is what only it could show.
    for (int i = 0; i < 3; i++) {
        const double r = surface->radius_m + low;
        const double lift = projection_lift(fmax(distance, r) + p.threshold_m, r,
                                            fmax(surface->radius_m + high, r));
        p.solid_m = r;
        p.max_altitude_m = high;
        // The ground point may move by the threshold, as seen from the centre.
        p.reach_rad = atan2(1, lift) + p.threshold_m / distance;
        const struct surface_bounds b =
            surface_bounds_around(surface, p.anchor.up, fmin(p.reach_rad, SHARED_PI));
        low = fmax(low, (double)b.min);
        high = fmin(high, (double)b.max);
    }
    p.near_m = fmax(p.height_m, NEAR_TEXELS * find_texel(surface, &p));
    p.lift = cos(p.reach_rad) / sin(p.reach_rad);
    return p;
}

double projection_power(double near, double ring, double rings)
{
    return fmax(1, fmin(MAX_POWER, log(near) / log(ring / rings)));
}
