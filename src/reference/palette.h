// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_PALETTE_H
#define REFERENCE_PALETTE_H
// The wavelengths of a picture and what they look like: the range that an eye sees, cut into bins
// that weigh alike in the star's light (the sum of CIE 1931's x, y and z).

#include "reference/lanes.h"
#include "scatter/medium.h"

// Bins of a group are spread over all wavelengths: a path carries one group.
enum { PALETTE_GROUPS = 16, PALETTE_BINS = PALETTE_GROUPS * REFERENCE_LANES };

struct palette {
    double nm[PALETTE_BINS]; // centroids, ascending
    // Linear sRGB in cd m^-2 of radiance per unit irradiance of the star (sr^-1) in the bin: exact,
    // from the star's spectrum and CIE 1931.
    double rgb[PALETTE_BINS][3];
    // Albedo of a surface that is (1, 0, 0), (0, 1, 0), (0, 0, 1) in linear sRGB in the star's own
    // light: of all such spectra those that change least from bin to bin. Their sum is 1.
    double albedo_of_colour[3][PALETTE_BINS];
    double luminance; // of radiance that is the star's irradiance per sr, cd m^-2
};

void palette_make(const struct medium *medium, struct palette *palette);

// The bin in a lane of a group.
static inline int palette_bin(int group, int lane)
{
    return group + PALETTE_GROUPS * lane;
}

#endif // REFERENCE_PALETTE_H
