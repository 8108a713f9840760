// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_WATER_H
#define REFERENCE_WATER_H
// A path tracer for light in a column of water between a flat surface and a Lambertian bed. It
// shares no code with the solver of src/ocean, not even the phase function, of which it uses the
// closed integral.

#include "base/context.h"

struct reference_water {
    double absorption_per_m;
    double clear_per_m;     // scattering by molecules that depolarise by 0.09
    double particles_per_m; // by particles of Fournier and Forand
    double particle_index;  // of these: relative refractive index, and
    double particle_slope;  // exponent of the number of sizes
    double index;           // refractive, of the water
    double depth_m;
    double bed_albedo;
};

struct reference_water_view {
    double eye_depth_m; // 0: above the water
    double sun_mu;      // cosine of the star's zenith angle in the air
    double view_mu;     // of the line of sight, in the eye's medium
    double azimuth_rad; // of the line of sight from the star's
};

// Radiance per irradiance of level water from above (sr^-1), and the standard errors.
struct reference_water_light {
    double star, sky;
    double star_error, sky_error;
};

// The same seed gives the same numbers on any number of threads. paths >= 2.
void reference_water_radiance(const struct reference_water *water,
                              const struct reference_water_view *view, uint64_t paths,
                              uint64_t seed, struct reference_water_light *out);

#endif // REFERENCE_WATER_H
