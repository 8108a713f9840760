// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SEA_H
#define SKY_SEA_H
// The sea as models of the sky light it, and the light of the air that it mirrors.

#include "scatter/atmosphere.h"

// Depths of the table: codes of shared/sea.glsl, from the deep to the shore.
enum { SKY_SEA_DEPTHS = 64 };

// What comes out of the water: spectra of pi times the radiance that leaves upward per irradiance,
// without the loss of the radiance at the surface (1 - Fresnel of the view), and what colour they
// have as linear sRGB relative to white in the star's light. Between its wavelengths a spectrum
// runs straight, beyond them it is even. Angles are cosines of refracted rays, evenly from
// `critical`, that of grazing ones, to 1. Rows: for each order m of azimuth all stars, per
// irradiance that has entered the water, the coefficient of cos(m azimuth) over the power m of both
// rays' sines; then the even sky, per irradiance from above.
enum { SKY_SEA_ANGLES = 12, SKY_SEA_ORDERS = 3 };
enum { SKY_SEA_ROWS = SKY_SEA_ORDERS * SKY_SEA_ANGLES + 1, SKY_SEA_WAVELENGTHS = 16 };
struct sky_sea_volume {
    double critical;
    double nm[SKY_SEA_WAVELENGTHS];
    double rgb_from_spectrum[3][SKY_SEA_WAVELENGTHS];
    // [view][row][depth][wavelength]
    float spectrum[SKY_SEA_ANGLES][SKY_SEA_ROWS][SKY_SEA_DEPTHS][SKY_SEA_WAVELENGTHS];
};

struct sky_sea {
    bool is_there;
    double mean_square_slope; // of what the surface buffers do not show as normals
    double index;             // refractive, at the middle of what is seen
    double white_share;       // of the surface, with that albedo
    double white_albedo;
    const struct sky_sea_volume *volume; // must outlive the sea; NULL where it is not there
};

// Reflectance of the surface from above for a ray with that cosine, over the facets that it sees,
// and the cosine of the zenith angle where they mirror, in the mean weighed by their reflectance.
double sea_surface_reflectance(const struct sky_sea *sea, double mu, double *mirror_mu);

// The same sea with the mean square slope of a level of shared/sea.glsl.
struct sky_sea sea_at_level(const struct sky_sea *sea, int level);

// Mirrored light: [view][sun][level][azimuth][BAND_COUNT], logarithms of bands per unit irradiance
// of the star, means over the facets that a view sees weighed by their reflectance. Views are
// uniform in the root of their cosine, suns as in the 4D table, azimuths of the mirrored ray from
// the star's in the sine of their half: dense where the aureole is.
enum { SEA_MIRROR_VIEWS = 24, SEA_MIRROR_AZIMUTHS = 16 };
// Of the table's suns so many, from one on. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result sea_mirror_make(const struct atmosphere *atmosphere,
                                        const struct sky_sea *sea, int first, int count,
                                        float *texels);

#endif // SKY_SEA_H
