// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_AIRGLOW_H
#define SKY_AIRGLOW_H
// The faint light of the sky that is no single star, for an eye in the air: how it changes from the
// zenith to the horizon. docs/physics.md, section 22.

#include "sky/extinction.h"

struct airglow {
    double share;    // of the zenith's light that comes from a layer of the air
    double layer;    // square of the planet's radius over the layer's
    double depth[3]; // of the air straight up, in linear sRGB
};

// The extinction has been updated for the eye.
struct airglow airglow_find(double share, const struct extinction *extinction);

// Luminance relative to the zenith's at the cosine of a zenith angle, in linear sRGB; below the
// horizontal as along it.
void airglow_at(const struct airglow *airglow, double mu, double rgb[3]);

// Mean over the hemisphere, weighed by the cosine: what level ground gets.
void airglow_mean(const struct airglow *airglow, double rgb[3]);

#endif // SKY_AIRGLOW_H
