// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SPECTRUM_STARLIGHT_H
#define SPECTRUM_STARLIGHT_H
// What catalogues of stars say, as light.

// Illuminance above the air, lx, of a star of that V magnitude: 2.54e-6 lx at 0 (Allen,
// Astrophysical Quantities, 1976, Section 15).
double starlight_illuminance_lx(double magnitude);

// Temperature in K of the black body that has that colour index B-V: Ballesteros 2012, EPL 97,
// 34008, Eq. 14. Indices outside [-0.4, 5] count as there.
double starlight_temperature_K(double colour_index);

#endif // SPECTRUM_STARLIGHT_H
