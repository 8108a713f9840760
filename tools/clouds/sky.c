// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky.h"

#include "scatter/atmosphere.h"
#include "scatter/query.h"

#include <math.h>

static const double pi = 3.14159265358979323846;
static const double altitude_m = 1750;
const double cloud_sky_suns_deg[CLOUD_SKY_SUNS] = {3, 6, 12, 25, 45, 70};

// Haze of g = 0.7 without its forward peak, which counts as the star's light (delta-M at l = 4).
static struct medium make_medium(void)
{
    const struct constituent air = {
        .scattering_per_m = {.kind = SPECTRUM_CONSTANT, .constant = 1.15e-5},
        .profile = {.kind = PROFILE_EXPONENTIAL, .scale_height_m = 8000},
        .phase = {.kind = PHASE_RAYLEIGH}};
    const struct constituent haze = {
        .scattering_per_m = {.kind = SPECTRUM_CONSTANT, .constant = 4e-5 * (1 - 0.168)},
        .absorption_per_m = {.kind = SPECTRUM_CONSTANT, .constant = 4e-6},
        .profile = {.kind = PROFILE_EXPONENTIAL, .scale_height_m = 1200},
        .phase = {.kind = PHASE_HENYEY_GREENSTEIN, .g = 0.64}};
    return (struct medium){.ground_radius_m = 6371e3,
                           .top_radius_m = 6431e3,
                           .ground_albedo = {.kind = SPECTRUM_CONSTANT, .constant = 0.1},
                           .star_irradiance = {.kind = SPECTRUM_CONSTANT, .constant = 1},
                           .constituent_count = 2,
                           .constituents = {air, haze}};
}

// Rings are dense about the horizon: mu = y |y|.
static double ring_y(int ring)
{
    return 2 * (ring + 0.5) / CLOUD_SKY_RINGS - 1;
}

struct sums {
    double above, below, flux, mean;
};

static struct sums find_radiance(struct query *query, double elevation_rad, double radius_m,
                                 double (*out)[CLOUD_SKY_AZIMUTHS])
{
    struct sums s = {0};
    for (int i = 0; i < CLOUD_SKY_RINGS * CLOUD_SKY_AZIMUTHS; i++) {
        const int ring = i / CLOUD_SKY_AZIMUTHS, k = i % CLOUD_SKY_AZIMUTHS;
        const double y = ring_y(ring), mu = y * fabs(y);
        const double azimuth = (k + 0.5) * pi / CLOUD_SKY_AZIMUTHS;
        const struct query_view view =
            query_view_make(radius_m, pi / 2 - elevation_rad, acos(mu), azimuth);
        lanes light;
        query_radiance(query, &view, &light);
        const double radiance = (double)light[0];
        const double weight =
            radiance * 4 * fabs(y) / CLOUD_SKY_RINGS * 2 * pi / CLOUD_SKY_AZIMUTHS;
        *(mu > 0 ? &s.above : &s.below) += weight * fabs(mu) / pi;
        s.flux += weight * sqrt(1 - mu * mu) * cos(azimuth);
        s.mean += weight / (4 * pi);
        out[ring][k] = radiance;
    }
    return s;
}

static void find_rest(struct query *query, double radius_m, int sun, struct cloud_sky *out)
{
    const struct sums s =
        find_radiance(query, cloud_sky_suns_deg[sun] * pi / 180, radius_m, out->rest[sun]);
    const double both = 0.5 * (s.above + s.below);
    for (int ring = 0; ring < CLOUD_SKY_RINGS; ring++) {
        const double y = ring_y(ring);
        for (int k = 0; k < CLOUD_SKY_AZIMUTHS; k++) {
            const double x = sqrt(1 - y * y * y * y) * cos((k + 0.5) * pi / CLOUD_SKY_AZIMUTHS);
            const double known = (y > 0 ? s.above : s.below) + 3 / (4 * pi) * s.flux * x;
            out->rest[sun][ring][k] = (out->rest[sun][ring][k] - known) / both;
        }
    }
    out->mean[sun] = s.mean / both - 1;
}

trl_result cloud_sky_make(const trl_context *ctx, struct cloud_sky *out)
{
    const struct medium medium = make_medium();
    struct atmosphere_desc desc = atmosphere_desc_default();
    desc.uses_cache = false;
    desc.wavelengths = 1;
    struct atmosphere *atmosphere = NULL;
    struct query *query = NULL;
    trl_result result = atmosphere_create(ctx, &medium, &desc, &atmosphere);
    if (result == TRL_OK) {
        result = query_create(ctx, &atmosphere->solution, &query);
    }
    for (int sun = 0; sun < CLOUD_SKY_SUNS && result == TRL_OK; sun++) {
        find_rest(query, medium.ground_radius_m + altitude_m, sun, out);
    }
    query_destroy(ctx, &query);
    atmosphere_destroy(&atmosphere);
    return result;
}

double cloud_sky_rest(const struct cloud_sky *sky, int sun, double mu, double x)
{
    const double y = copysign(sqrt(fabs(mu)), mu);
    const double cosine = x / sqrt(fmax(1 - mu * mu, 1e-9));
    const int ring = (int)fmin((y + 1) / 2 * CLOUD_SKY_RINGS, CLOUD_SKY_RINGS - 1);
    const double azimuth = acos(fmin(fmax(cosine, -1), 1)) / pi;
    const int k = (int)fmin(azimuth * CLOUD_SKY_AZIMUTHS, CLOUD_SKY_AZIMUTHS - 1);
    return sky->rest[sun][ring][k];
}
