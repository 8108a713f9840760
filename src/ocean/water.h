// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_WATER_H
#define OCEAN_WATER_H
// Inherent optical properties of natural water, each from its source. docs/physics.md, *Light in
// the water*.

#include "ocean/ocean.h"

// Of the water with all that is in it, at one wavelength.
struct water_optics {
    double absorption_per_m;
    double clear_per_m;     // scattering by the liquid: Einstein-Smoluchowski
    double particles_per_m; // scattering by particles: Fournier and Forand
    double backscatter;     // part of what particles scatter that goes back
};

struct water_optics water_optics_at(const struct ocean_water *water, double nm);
double water_refractive_index(const struct ocean_water *water, double nm);

// 1 + WATER_ANISOTROPY cos^2 is the phase function of the liquid: its molecules depolarise by 0.09
// (Morel 1974, in Optical Aspects of Oceanography), so (1 - 0.09) / (1 + 0.09).
#define WATER_ANISOTROPY 0.835

#endif // OCEAN_WATER_H
