// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/water.h"

#include "reference/random.h"

#include <math.h>

// Particles scatter much into angles so small that it makes no difference, but which would make
// the noise of a path that meets the star's beam endless. Below this angle light counts as not
// scattered.
static const double SMALLEST_RAD = 0.05;

enum { BATCHES = 64, ANGLES = 4096 };

struct tracer {
    const struct reference_water *w;
    double particles_per_m; // without what is scattered below the smallest angle
    double extinction_per_m;
    double least_share; // of that
    // Angles of equal shares of the particles' scattering beyond the smallest.
    double angle[ANGLES + 1];
    double toward_star[3]; // in the water
    double beam;           // irradiance of a plane that faces the refracted star
};

// Power law sizes: Fournier and Jonasz 1999. Part of what is scattered that is so by less than
// `angle`.
static double cumulative(const struct reference_water *w, double angle)
{
    const double nu = 0.5 * (3 - w->particle_slope);
    const double sine = sin(0.5 * angle), s2 = sine * sine;
    const double over = w->particle_index - 1;
    const double d180 = 4 / (3 * over * over), d = d180 * s2;
    if (d <= 0) {
        return 0;
    }
    if (fabs(d - 1) < 1e-5) {
        return 0.5 * (cumulative(w, angle * (1 - 1e-4)) + cumulative(w, angle * (1 + 1e-4)));
    }
    const double a = 1 - pow(d, nu + 1) - (1 - pow(d, nu)) * s2;
    const double b = (1 - pow(d180, nu)) / (8 * (d180 - 1) * pow(d180, nu));
    return a / ((1 - d) * pow(d, nu)) + b * cos(angle) * sin(angle) * sin(angle);
}

static void find_angles(struct tracer *t)
{
    for (int i = 0; i <= ANGLES; i++) {
        const double wanted = t->least_share + (1 - t->least_share) * i / ANGLES;
        double low = log(SMALLEST_RAD), high = log(M_PI);
        for (int round = 0; round < 50; round++) {
            const double middle = 0.5 * (low + high);
            if (cumulative(t->w, exp(middle)) < wanted) {
                low = middle;
            } else {
                high = middle;
            }
        }
        t->angle[i] = exp(0.5 * (low + high));
    }
}

// Density per sr of particles' scattering: as it is sampled.
static double particles_density(const struct tracer *t, double cosine)
{
    const double angle = acos(fmin(fmax(cosine, -1), 1));
    if (angle <= t->angle[0]) {
        return 0;
    }
    int low = 0, high = ANGLES;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (t->angle[middle] <= angle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const double ring = 2 * M_PI * (cos(t->angle[low]) - cos(t->angle[high]));
    return 1.0 / ANGLES / ring;
}

static double clear_density(double cosine)
{
    const double ratio = (1 - 0.09) / (1 + 0.09);
    return 3 / (4 * M_PI) * (1 + ratio * cosine * cosine) / (3 + ratio);
}

static double sample_cosine(const struct tracer *t, struct random_stream *random)
{
    const double scattering = t->w->clear_per_m + t->particles_per_m;
    if (random_next(random) * scattering < t->w->clear_per_m) {
        const double ratio = (1 - 0.09) / (1 + 0.09);
        for (;;) {
            const double x = 2 * random_next(random) - 1;
            if (random_next(random) * (1 + ratio) < 1 + ratio * x * x) {
                return x;
            }
        }
    }
    // Even in the cosine within a share, as particles_density has it.
    const int i = (int)(random_next(random) * ANGLES);
    const double a = cos(t->angle[i]), b = cos(t->angle[i + 1]);
    return a + (b - a) * random_next(random);
}

static void turn(double direction[3], double cosine, double azimuth)
{
    const double x = direction[0], y = direction[1], z = direction[2];
    const double sine = sqrt(fmax(1 - cosine * cosine, 0));
    const double level = sqrt(x * x + y * y);
    double across[3] = {1, 0, 0}, other[3] = {0, 1, 0};
    if (level > 1e-9) {
        across[0] = -y / level;
        across[1] = x / level;
        other[0] = -z * x / level;
        other[1] = -z * y / level;
        other[2] = level;
    }
    for (int k = 0; k < 3; k++) {
        direction[k] =
            direction[k] * cosine + sine * (across[k] * cos(azimuth) + other[k] * sin(azimuth));
    }
}

// Fresnel, unpolarised, by the angles on both sides; from the water.
static double reflectance_from_below(double mu, double index)
{
    const double sine = index * sqrt(fmax(1 - mu * mu, 0));
    if (sine >= 1) {
        return 1;
    }
    const double inside = acos(mu), outside = asin(sine);
    if (inside < 1e-6) {
        return pow((index - 1) / (index + 1), 2);
    }
    const double s = sin(inside - outside) / sin(inside + outside);
    const double p = tan(inside - outside) / tan(inside + outside);
    return 0.5 * (s * s + p * p);
}

static double reflectance_from_above(double mu, double index)
{
    const double sine = sqrt(fmax(1 - mu * mu, 0)) / index;
    return reflectance_from_below(sqrt(1 - sine * sine), index);
}

struct path {
    double depth_m, direction[3], weight; // direction of travel: against the light
    double star, sky;
};

static double star_left(const struct tracer *t, double depth_m)
{
    return t->beam * exp(-t->extinction_per_m * depth_m / t->toward_star[2]);
}

// Goes to the next event; false when the path is at its end.
static bool advance(const struct tracer *t, struct path *p, struct random_stream *random)
{
    const struct reference_water *w = t->w;
    const double way_m = -log(random_next(random)) / t->extinction_per_m;
    const double reached_m = p->depth_m - p->direction[2] * way_m;
    if (reached_m < 0) {
        p->depth_m = 0;
        const double back = reflectance_from_below(p->direction[2], w->index);
        p->sky += p->weight * (1 - back) * w->index * w->index / M_PI;
        p->weight *= back;
        p->direction[2] = -p->direction[2];
    } else if (reached_m > w->depth_m) {
        p->depth_m = w->depth_m;
        p->weight *= w->bed_albedo;
        p->star += p->weight / M_PI * t->toward_star[2] * star_left(t, w->depth_m);
        const double mu = sqrt(random_next(random)), sine = sqrt(1 - mu * mu);
        const double azimuth = 2 * M_PI * random_next(random);
        p->direction[0] = sine * cos(azimuth);
        p->direction[1] = sine * sin(azimuth);
        p->direction[2] = mu;
    } else {
        p->depth_m = reached_m;
        const double scattering = w->clear_per_m + t->particles_per_m;
        p->weight *= scattering / t->extinction_per_m;
        const double cosine = p->direction[0] * t->toward_star[0] +
                              p->direction[1] * t->toward_star[1] +
                              p->direction[2] * t->toward_star[2];
        const double density = (w->clear_per_m * clear_density(cosine) +
                                t->particles_per_m * particles_density(t, cosine)) /
                               scattering;
        p->star += p->weight * density * star_left(t, reached_m);
        turn(p->direction, sample_cosine(t, random), 2 * M_PI * random_next(random));
    }
    if (p->weight < 0.05) { // roulette
        p->weight = random_next(random) < 0.5 ? 2 * p->weight : 0;
    }
    return p->weight > 0;
}

static void trace(const struct tracer *t, const struct reference_water_view *view,
                  struct random_stream random, struct path *p)
{
    const double index = t->w->index;
    *p = (struct path){.depth_m = view->eye_depth_m, .weight = 1};
    double mu = view->view_mu;
    if (view->eye_depth_m <= 0) {
        p->weight = (1 - reflectance_from_above(-mu, index)) / (index * index);
        mu = -sqrt(1 - (1 - mu * mu) / (index * index));
    }
    const double sine = sqrt(fmax(1 - mu * mu, 0));
    p->direction[0] = sine * cos(view->azimuth_rad);
    p->direction[1] = sine * sin(view->azimuth_rad);
    p->direction[2] = mu;
    while (advance(t, p, &random)) {
    }
}

static struct tracer make_tracer(const struct reference_water *w, double sun_mu)
{
    struct tracer t = {.w = w, .least_share = cumulative(w, SMALLEST_RAD)};
    t.particles_per_m = w->particles_per_m * (1 - t.least_share);
    t.extinction_per_m = w->absorption_per_m + w->clear_per_m + t.particles_per_m;
    const double sine = sqrt(fmax(1 - sun_mu * sun_mu, 0)) / w->index;
    t.toward_star[0] = sine;
    t.toward_star[2] = sqrt(1 - sine * sine);
    t.beam = (1 - reflectance_from_above(sun_mu, w->index)) / t.toward_star[2];
    find_angles(&t);
    return t;
}

void reference_water_radiance(const struct reference_water *water,
                              const struct reference_water_view *view, uint64_t paths,
                              uint64_t seed, struct reference_water_light *out)
{
    const struct tracer t = make_tracer(water, view->sun_mu);
    double star[BATCHES] = {0}, star2[BATCHES] = {0}, sky[BATCHES] = {0}, sky2[BATCHES] = {0};
#pragma omp parallel for schedule(dynamic)
    for (int batch = 0; batch < BATCHES; batch++) {
        for (uint64_t n = (uint64_t)batch; n < paths; n += BATCHES) {
            struct path p;
            trace(&t, view, random_stream_for(seed, 0, n), &p);
            star[batch] += p.star;
            star2[batch] += p.star * p.star;
            sky[batch] += p.sky;
            sky2[batch] += p.sky * p.sky;
        }
    }
    double sum[4] = {0};
    for (int batch = 0; batch < BATCHES; batch++) {
        sum[0] += star[batch];
        sum[1] += star2[batch];
        sum[2] += sky[batch];
        sum[3] += sky2[batch];
    }
    const double n = (double)paths;
    out->star = sum[0] / n;
    out->sky = sum[2] / n;
    out->star_error = sqrt(fmax(sum[1] / n - out->star * out->star, 0) / (n - 1));
    out->sky_error = sqrt(fmax(sum[3] / n - out->sky * out->sky, 0) / (n - 1));
}
