// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/airglow.h"

#include <math.h>

// Of the layer, m: Garstang's, as in Patat 2003, Appendix C. Nearly the same for 90 km.
static const double LAYER_M = 130e3;

struct airglow airglow_find(double share, const struct extinction *extinction)
{
    const struct optics *o = extinction->optics;
    const double ratio = o->ground_radius_m / (o->ground_radius_m + LAYER_M);
    const lanes star = extinction_sample(extinction, &o->medium->star_irradiance);
    const lanes left = star * extinction_at(extinction, 1);
    const struct cie_rgb above = extinction_colour(extinction, &star);
    const struct cie_rgb below = extinction_colour(extinction, &left);
    const double before[3] = {above.r, above.g, above.b}, after[3] = {below.r, below.g, below.b};
    struct airglow airglow = {.share = share, .layer = ratio * ratio};
    for (int i = 0; i < 3; i++) {
        const bool has_light = before[i] > 0 && after[i] > 0;
        airglow.depth[i] = has_light ? fmax(-log(after[i] / before[i]), 0) : 0;
    }
    return airglow;
}

void airglow_at(const struct airglow *airglow, double mu, double rgb[3])
{
    const double clamped = fmax(mu, 0);
    const double path = 1 / sqrt(1 - airglow->layer * (1 - clamped * clamped));
    for (int i = 0; i < 3; i++) {
        rgb[i] = airglow->share > 0
                     ? (1 + airglow->share * (path - 1)) * exp(-airglow->depth[i] * (path - 1))
                     : 1;
    }
}

void airglow_mean(const struct airglow *airglow, double rgb[3])
{
    enum { PARTS = 64 };
    for (int i = 0; i < 3; i++) {
        rgb[i] = 0;
    }
    for (int k = 0; k < PARTS; k++) {
        double at[3];
        // The square of the cosine is uniform.
        airglow_at(airglow, sqrt((k + 0.5) / PARTS), at);
        for (int i = 0; i < 3; i++) {
            rgb[i] += at[i] / PARTS;
        }
    }
}
