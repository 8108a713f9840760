// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_SEA_H
#define OCEAN_SEA_H
// The sea as what lights it sees: how rough it is, how much of it is white. docs/physics.md, *The
// sea*.

#include "ocean/ocean.h"
#include "shared/sea.glsl"

// Mean square slope of all waves, along and across together: Cox and Munk 1954 for a clean surface.
double sea_mean_square_slope(const struct ocean_waves *waves);

// Part of the surface that is white: Monahan and O'Muircheartaigh 1980, J. Phys. Oceanogr. 10.
double sea_whitecap_share(const struct ocean_waves *waves);

// Of the whitecaps in a pixel what is dense foam: with its albedo 0.22 (Koepke 1984).
#define SEA_FOAM_DENSITY 0.4

// Where foam begins and how wide the ramp is, over the deviation of what presses crests together
// (sea_foam of shared/sea.glsl): whitecaps cover `share`, with foam of that density.
struct sea_foam_ramp {
    double first, width;
};
struct sea_foam_ramp sea_foam_find(double share);

// Foam of waves that break because water is shallow: its ramps by the steps of sea_surf_step, the
// last of them that of the open sea. `height_m`: significant height in deep water.
struct sea_surf {
    double broken_m; // depth
    struct sea_foam_ramp ramps[SEA_SURF_STEPS + 1];
};
struct sea_surf sea_surf_find(const struct ocean_waves *waves, double height_m);

// Albedo of what is white, streaks and patches that dissolve included: Koepke 1984, Appl. Opt. 23.
#define SEA_WHITECAP_ALBEDO 0.22

// Reflectance of a smooth boundary for light that comes from everywhere alike, from above.
double sea_diffuse_reflectance(double index);

#endif // OCEAN_SEA_H
