// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// From where light comes that is scattered: sums along rays in all directions.
#include "scatter/umbra.h"

#include "shared/shared.glsl"

#include <math.h>

enum { DIRECTIONS = 24, STEPS = 80 }; // up, and as many down; along each

// Of what reaches a place.
static const float LEAST_SHARE = 3e-4f;

// Coefficients in the bands at an altitude, per m, by similarity: what is scattered forward counts
// as not scattered.
struct layer {
    umbra_bands scattering, extinction;
};

static struct layer find_layer(const struct umbra_kernel *kernel, double altitude_m,
                               enum umbra_beam beam)
{
    const struct optics *o = kernel->optics;
    struct layer layer = {0};
    for (int c = 0; c < o->constituent_count; c++) {
        const double density = profile_density(&o->medium->constituents[c].profile, altitude_m);
        const double kept = 1 - o->forward_share[c];
        const double forward = beam == UMBRA_SIMILAR ? o->moment[c][1] / o->moment[c][0] : 0;
        for (int k = 0; k < BAND_COUNT; k++) {
            const double scattering =
                (double)o->scattering_per_m[c][kernel->lane[k]] * kept * density;
            layer.scattering[k] += (float)(scattering * (1 - forward));
            layer.extinction[k] +=
                (float)((double)o->extinction_per_m[c][kernel->lane[k]] * density -
                        scattering * forward);
        }
    }
    return layer;
}

// The node that is nearest to a coordinate.
static int nearest_node(double coordinate, int count)
{
    const double x = fmin(fmax(coordinate, 0), count - 1);
    const int index = (int)fmin(floor(x), count - 2);
    return index + ((float)(x - index) > 0.5f);
}

static int find_ring(const struct umbra_kernel *kernel, double distance_m)
{
    const double nearest_m = kernel->ring_m[1];
    return nearest_node(distance_m < nearest_m ? distance_m / nearest_m
                                               : 1 + 2 * log2(distance_m / nearest_m),
                        UMBRA_RINGS);
}

static int find_altitude(const struct umbra_kernel *kernel, double altitude_m)
{
    const double top_m = kernel->altitude_m[UMBRA_ALTITUDES - 1];
    return nearest_node(sqrt(fmax(altitude_m, 0) / top_m) * (UMBRA_ALTITUDES - 1), UMBRA_ALTITUDES);
}

// A direction: cosine of its zenith angle, share of the sphere around.
struct direction {
    double mu, share;
};

struct place {
    double altitude_m, ring_m;
};

static struct place find_place(double ground_m, double eye_m, double mu, double distance_m)
{
    const double rise_m = eye_m + distance_m * mu;
    const double aside_m = distance_m * sqrt(1 - mu * mu);
    return (struct place){hypot(rise_m, aside_m) - ground_m, ground_m * atan2(aside_m, rise_m)};
}

// Adds the light that reaches one altitude from one direction: to the rows of the altitudes, and
// that of the ground, if it is met.
static void add_direction(const struct umbra_kernel *kernel, double altitude_m,
                          struct direction direction, umbra_bands (*air)[UMBRA_RINGS],
                          umbra_bands *ground)
{
    const double ground_m = kernel->optics->ground_radius_m;
    const double eye_m = ground_m + altitude_m;
    double begin_m = 0;
    double end_m = 0;
    bool hits_ground = false;
    if (!ray_clip(kernel->optics, eye_m, direction.mu, &begin_m, &end_m, &hits_ground)) {
        return;
    }
    umbra_bands depth = {0};
    for (int i = 0; i < STEPS; i++) {
        const double near = (double)i / STEPS;
        const double far = (double)(i + 1) / STEPS;
        const double step_m = end_m * (far * far - near * near);
        const double distance_m = 0.5 * end_m * (far * far + near * near);
        const struct place place = find_place(ground_m, eye_m, direction.mu, distance_m);
        const struct layer layer = find_layer(kernel, place.altitude_m, UMBRA_SIMILAR);
        umbra_bands weight;
        for (int k = 0; k < BAND_COUNT; k++) {
            const float part = layer.extinction[k] * (float)step_m;
            // Mean transmittance over the step, from its begin.
            const float mean = part > 1e-4f ? -expm1f(-part) / part : 1;
            weight[k] = expf(-depth[k]) * mean * layer.scattering[k] * (float)step_m;
        }
        weight *= (float)direction.share;
        depth += layer.extinction * (float)step_m;
        air[find_altitude(kernel, place.altitude_m)][find_ring(kernel, place.ring_m)] += weight;
    }
    if (hits_ground && ground) {
        umbra_bands weight;
        for (int k = 0; k < BAND_COUNT; k++) {
            weight[k] = expf(-depth[k]) * (float)direction.share;
        }
        const struct place place = find_place(ground_m, eye_m, direction.mu, end_m);
        ground[find_ring(kernel, place.ring_m)] += weight;
    }
}

// Takes away what adds little, so that sums skip it.
static void prune(umbra_bands *rings, int count)
{
    umbra_bands sum = {0};
    for (int i = 0; i < count; i++) {
        sum += rings[i];
    }
    for (int i = 0; i < count; i++) {
        bool is_little = true;
        for (int k = 0; k < BAND_COUNT; k++) {
            is_little = is_little && rings[i][k] < LEAST_SHARE * sum[k];
        }
        if (is_little) {
            rings[i] = (umbra_bands){0};
        }
    }
}

static void fill_nodes(struct umbra_kernel *kernel)
{
    const struct optics *o = kernel->optics;
    const double top_m = o->top_radius_m - o->ground_radius_m;
    for (int i = 0; i < UMBRA_ALTITUDES; i++) {
        const double x = (double)i / (UMBRA_ALTITUDES - 1);
        kernel->altitude_m[i] = top_m * x * x;
    }
    // To where a level ray from the ground leaves the air.
    const double farthest_m = o->ground_radius_m * acos(o->ground_radius_m / o->top_radius_m);
    kernel->ring_m[0] = 0;
    for (int i = 1; i < UMBRA_RINGS; i++) {
        kernel->ring_m[i] = farthest_m * exp2(0.5 * (i + 1 - UMBRA_RINGS));
    }
}

void umbra_kernel_init(const struct optics *optics, const int lane[BAND_COUNT],
                       struct umbra_kernel *kernel)
{
    *kernel = (struct umbra_kernel){.optics = optics};
    for (int k = 0; k < BAND_COUNT; k++) {
        kernel->lane[k] = lane[k];
        kernel->ground_albedo[k] = optics->ground_albedo[lane[k]];
    }
    fill_nodes(kernel);
    struct gauss rule;
    gauss_init(&rule, DIRECTIONS);
    for (int j = 0; j < DIRECTIONS; j++) {
        // Dense about the horizontal, from where most of the far light comes.
        const double mu = rule.node[j] * rule.node[j];
        const double share = rule.weight[j] * rule.node[j]; // half the sphere's, 2 x dx / 2
        for (int i = 0; i < UMBRA_ALTITUDES; i++) {
            add_direction(kernel, kernel->altitude_m[i], (struct direction){mu, share},
                          kernel->air_air[i], kernel->air_ground[i]);
            add_direction(kernel, kernel->altitude_m[i], (struct direction){-mu, share},
                          kernel->air_air[i], kernel->air_ground[i]);
        }
        // Irradiance: the integral of radiance times cosine over 4 pi times the share.
        const double cosine = 4 * SHARED_PI * mu * share;
        add_direction(kernel, 0, (struct direction){mu, cosine}, kernel->ground_air, NULL);
    }
    for (int i = 0; i < UMBRA_ALTITUDES; i++) {
        prune(kernel->air_air[i][0], UMBRA_ALTITUDES * UMBRA_RINGS);
        prune(kernel->air_ground[i], UMBRA_RINGS);
    }
    prune(kernel->ground_air[0], UMBRA_ALTITUDES * UMBRA_RINGS);
}

umbra_bands umbra_kernel_direct(const struct umbra_kernel *kernel, double altitude_m, double mu,
                                enum umbra_beam beam)
{
    const double ground_m = kernel->optics->ground_radius_m;
    double begin_m = 0;
    double end_m = 0;
    bool hits_ground = false;
    umbra_bands depth = {0};
    if (ray_clip(kernel->optics, ground_m + altitude_m, mu, &begin_m, &end_m, &hits_ground)) {
        for (int i = 0; i < STEPS; i++) {
            const double near = (double)i / STEPS;
            const double far = (double)(i + 1) / STEPS;
            const double middle_m = 0.5 * end_m * (far * far + near * near);
            const struct place place = find_place(ground_m, ground_m + altitude_m, mu, middle_m);
            depth += find_layer(kernel, place.altitude_m, beam).extinction *
                     (float)(end_m * (far * far - near * near));
        }
    }
    umbra_bands left;
    for (int k = 0; k < BAND_COUNT; k++) {
        left[k] = expf(-depth[k]);
    }
    return left;
}
