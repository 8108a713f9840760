// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_BANDS_H
#define SCATTER_BANDS_H
// Four of the solver's wavelengths stand for all of them on the GPU: one texture holds four
// channels. Light of single wavelengths multiplies exactly (albedo, attenuation), which colours do
// not; the colour comes last, by a matrix fitted so that the four reproduce what all wavelengths
// give. docs/decisions/003-four-bands.md

#include "scatter/solver.h"

enum { BAND_COUNT = 4 };

struct bands {
    float xyz_from_lanes[3][LANES]; // exact: CIE 1931 in cd m^-2 of radiance per unit irradiance of
                                    // the star
    int lane[BAND_COUNT];           // in the optics, ascending
    double nm[BAND_COUNT];
    // Linear sRGB in cd m^-2 of radiance per unit irradiance of the star (sr^-1) in the bands.
    float rgb_from_bands[3][BAND_COUNT];
    // Albedo in the bands of a surface that has this linear sRGB colour in the star's own light.
    float bands_from_rgb[BAND_COUNT][3];
    double rms_error; // of the fit: RMS difference in linear sRGB relative to the luminance
};

// Collects spectra that have to be reproduced, then chooses.
struct band_fit {
    const struct optics *optics;
    double xyz_from_lanes[3][LANES]; // the exact matrix, from the star's fine spectrum and CIE 1931
    double rgb_from_lanes[3][LANES]; // the same in linear sRGB
    double star_luminance;           // of the star's light as it comes, cd m^-2 (sr^-1)
    double gram[LANES][LANES];       // weighted products of the spectra seen
};

void band_fit_init(struct band_fit *fit, const struct optics *optics);
// Adds a spectrum of radiance per unit irradiance; spectra count alike, whatever their brightness,
// unless they are too dark to be seen.
void band_fit_add(struct band_fit *fit, const lanes *spectrum);
// Adds surfaces of many colours in this light, bare and behind air.
void band_fit_add_surfaces(struct band_fit *fit, const lanes *light);
// Adds what the GPU multiplies: light of the star and of the sky, on surfaces of many colours,
// behind air.
void band_fit_add_products(struct band_fit *fit, const struct solution *solution);
// Tries every choice of four wavelengths: least squares of each through the Gram matrix.
void band_fit_choose(const struct band_fit *fit, struct bands *out);
// The same four wavelengths for two kinds of light: `fit` of the ground's, `added` of what the air
// adds, which has a matrix of its own.
struct added_bands {
    float rgb_from_bands[3][BAND_COUNT];
    // The likeliest bands of a colour; the matrix above gives the colour back.
    float bands_from_rgb[BAND_COUNT][3];
    double rms_error;
};
void band_fit_choose_both(const struct band_fit *fit, const struct band_fit *added,
                          struct bands *out, struct added_bands *added_out);

// Colour in cd m^-2 (X, Y, Z, 0) of radiance per unit irradiance of the star, times `scale`.
void bands_xyz(const struct bands *bands, const lanes *radiance, float scale, float *texel);

#endif // SCATTER_BANDS_H
