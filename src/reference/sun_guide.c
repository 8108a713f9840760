// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/sun_guide.h"

#include <math.h>

enum { ALTITUDES = 64, COSINES = 128 };
static const double negligible_depth = 40;

// Squares crowd the altitudes toward the ground and the cosines toward the shadow's edge.
static double altitude_of(const struct sun_guide *guide, int i)
{
    const double x = (double)i / (ALTITUDES - 1);
    return guide->thickness_m * x * x;
}

static double cosine_of(const struct sun_guide *guide, int i)
{
    const double x = (double)i / (COSINES - 1);
    return guide->lowest_mu + (1 - guide->lowest_mu) * x * x;
}

static double mean_transmittance(const struct reference_air *air,
                                 const struct reference_optics *optics,
                                 const struct reference_ray *ray)
{
    lanes4 depth = {0};
    struct reference_walk walk = reference_walk_begin(air, ray);
    for (struct reference_piece piece; reference_walk_next(&walk, &piece);) {
        struct reference_columns columns;
        reference_air_columns(air, ray, &piece, piece.end_m, &columns);
        depth += reference_optics_extinction(optics, &columns);
        if (lanes4_min(&depth, optics->count) > negligible_depth) {
            return 0;
        }
    }
    const lanes4 exponent = -depth;
    const lanes4 passed = lanes4_exp(&exponent, optics->count);
    return lanes4_sum(&passed) / optics->count;
}

trl_result sun_guide_init(const trl_context *ctx, const struct reference_air *air,
                          const struct reference_optics *optics, struct sun_guide *guide)
{
    const double ground = air->bottom_radius_m, top = air->top_radius_m;
    *guide = (struct sun_guide){.lowest_mu = -sqrt((top - ground) * (top + ground)) / top,
                                .thickness_m = top - ground};
    guide->transmittance = mem_alloc(ctx, ALTITUDES * COSINES, sizeof(double));
    if (!guide->transmittance) {
        return TRL_ERROR_MEMORY;
    }
    for (int i = 0; i < ALTITUDES; ++i) {
        const double radius = ground + altitude_of(guide, i);
        for (int k = 0; k < COSINES; ++k) {
            const struct reference_ray ray = reference_air_ray(air, radius, cosine_of(guide, k));
            guide->transmittance[i * COSINES + k] =
                ray.hits_bottom ? 0 : mean_transmittance(air, optics, &ray);
        }
    }
    return TRL_OK;
}

void sun_guide_finish(const trl_context *ctx, struct sun_guide *guide)
{
    mem_free(ctx, guide->transmittance);
    *guide = (struct sun_guide){0};
}

double sun_guide_at(const struct sun_guide *guide, double altitude_m, double mu_sun)
{
    if (mu_sun < guide->lowest_mu) {
        return 0;
    }
    const double x = sqrt(fmax(0, altitude_m) / guide->thickness_m) * (ALTITUDES - 1);
    const double y = sqrt((mu_sun - guide->lowest_mu) / (1 - guide->lowest_mu)) * (COSINES - 1);
    const int i = x < ALTITUDES - 1 ? (int)x : ALTITUDES - 2;
    const int k = y < COSINES - 1 ? (int)y : COSINES - 2;
    const double *at = guide->transmittance + i * COSINES + k;
    const double tx = fmin(x - i, 1), ty = fmin(y - k, 1);
    return (1 - tx) * ((1 - ty) * at[0] + ty * at[1]) +
           tx * ((1 - ty) * at[COSINES] + ty * at[COSINES + 1]);
}
