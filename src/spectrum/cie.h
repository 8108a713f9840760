// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SPECTRUM_CIE_H
#define SPECTRUM_CIE_H
// From spectra to what an eye sees: CIE 1931 2-degree observer and linear sRGB.

// The range in which the observer's functions are not 0, nm.
#define CIE_FIRST_NM 360.0
#define CIE_LAST_NM 830.0

// Luminous efficacy of 555 nm light, lm/W: 683 per the SI at 540 THz, raised to the peak of ybar.
#define CIE_LUMENS_PER_WATT 683.002

struct cie_xyz {
    double x, y, z;
};

struct cie_rgb {
    double r, g, b; // linear sRGB primaries
};

// xbar, ybar, zbar at one wavelength, linear between the 5 nm values, 0 outside 360..830 nm.
struct cie_xyz cie_observer(double nm);

// The observer's integral over [from_nm, to_nm] in nm: exact for the linear interpolant. What a
// band's mean radiance has to be multiplied with.
struct cie_xyz cie_observer_integral(double from_nm, double to_nm);

// Row-major matrix from XYZ to linear sRGB (IEC 61966-2-1), from its primaries and white D65.
extern const double cie_rgb_from_xyz[3][3];

struct cie_rgb cie_rgb_of_xyz(struct cie_xyz xyz);

// The Y of a linear sRGB colour.
double cie_luminance(struct cie_rgb rgb);

#endif // SPECTRUM_CIE_H
