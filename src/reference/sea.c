// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/sea.h"

#include "reference/tracer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

// Of the directions that are drawn, these come from facets, the others from the cosine.
static const double facet_share = 0.7;

// Fresnel by the angles: sines and tangents of sum and difference.
static double reflect(double cosine, double index)
{
    const double in = acos(fmin(fmax(cosine, 0), 1));
    if (in < 1e-4) {
        return pow((index - 1) / (index + 1), 2);
    }
    const double out = asin(sin(in) / index);
    const double across = sin(in - out) / sin(in + out), along = tan(in - out) / tan(in + out);
    return 0.5 * (across * across + along * along);
}

// Smith 1967, exactly.
static double count_hidden(double mu, double mss)
{
    const double v = mu / sqrt(fmax(1 - mu * mu, 1e-14) * mss);
    return v > 6 ? 0 : 0.5 * (exp(-v * v) / (v * sqrt(pi)) - erfc(v));
}

// Density of the normals of facets, per sr.
static double normal_density(const struct reference_sea *sea, double mu)
{
    const double mu2 = mu * mu, mss = sea->mean_square_slope;
    return mu > 1e-3 ? exp(-(1 / mu2 - 1) / mss) / (pi * mss * mu2 * mu) : 0;
}

static lanes4 volume_between(const struct reference_sea *sea, const struct reference_facets *place,
                             struct vec3 light, const struct reference_rays *mus)
{
    if (!sea->volume) {
        return lanes4_set(0);
    }
    struct reference_rays rays = *mus;
    const double sines =
        sqrt((1 - rays.light_mu * rays.light_mu) * (1 - rays.view_mu * rays.view_mu));
    const double level = vec3_dot(light, place->view) - rays.light_mu * rays.view_mu;
    rays.azimuth_cosine = sines > 1e-9 ? fmin(fmax(-level / sines, -1), 1) : 1;
    return sea->volume(sea->user, place->depth_code, &rays, place->nm);
}

lanes4 reference_sea_value(const struct reference_sea *sea, const struct reference_facets *place,
                           struct vec3 light)
{
    const double light_mu = vec3_dot(place->up, light);
    const double view_mu = fmax(vec3_dot(place->up, place->view), 1e-4);
    if (light_mu <= 0) {
        return lanes4_set(0);
    }
    const struct vec3 facet = vec3_normalize(vec3_add(light, place->view));
    const double mu = vec3_dot(facet, place->up), mss = sea->mean_square_slope;
    const double seen = 1 / (1 + count_hidden(view_mu, mss) + count_hidden(light_mu, mss));
    // A facet's area is 1 / mu of the level one.
    const double glint = reflect(vec3_dot(facet, light), sea->index) * normal_density(sea, mu) /
                         fmax(mu, 1e-3) * seen / (4 * view_mu);
    const double through = (1 - reflect(view_mu, sea->index)) * (1 - reflect(light_mu, sea->index));
    return lanes4_set((1 - sea->white_share) * glint +
                      sea->white_share * sea->white_albedo * light_mu / pi) +
           volume_between(sea, place, light, &(struct reference_rays){light_mu, view_mu, 1}) *
               ((1 - sea->white_share) * through * light_mu / pi);
}

struct vec3 reference_sea_draw(const struct reference_sea *sea,
                               const struct reference_facets *place, struct random_stream *random)
{
    if (random_next(random) >= facet_share) {
        return reference_turn(place->up, sqrt(random_next(random)), 2 * pi * random_next(random));
    }
    const double slope = sqrt(-sea->mean_square_slope * log(fmax(random_next(random), 1e-300)));
    const struct vec3 facet =
        reference_turn(place->up, 1 / sqrt(1 + slope * slope), 2 * pi * random_next(random));
    const double twice = 2 * vec3_dot(facet, place->view);
    return vec3_normalize(vec3_sub(vec3_scale(facet, twice), place->view));
}

double reference_sea_density(const struct reference_sea *sea, const struct reference_facets *place,
                             struct vec3 light)
{
    const struct vec3 sum = vec3_add(light, place->view);
    const double length = vec3_length(sum);
    const double level = fmax(vec3_dot(place->up, light), 0) / pi;
    double density = (1 - facet_share) * level;
    for (int side = -1; side <= 1 && length > 1e-9; side += 2) {
        // Facets are drawn with the slopes alone, also those that face away from the view: they
        // mirror as if from behind.
        const struct vec3 facet = vec3_scale(sum, side / length);
        const double cosine = fabs(vec3_dot(facet, place->view));
        density += facet_share * normal_density(sea, vec3_dot(facet, place->up)) /
                   (4 * fmax(cosine, 1e-9));
    }
    return density;
}
