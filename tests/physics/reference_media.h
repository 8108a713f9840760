// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_MEDIA_H
#define REFERENCE_MEDIA_H
// Media for tests, made by hand; nothing in them is allocated.

#include "scatter/medium.h"

static inline struct spectrum constant_spectrum(double value)
{
    return (struct spectrum){.kind = SPECTRUM_CONSTANT, .constant = value};
}

static inline struct constituent make_constituent(double scattering_per_m, double absorption_per_m,
                                                  struct profile profile, struct phase phase)
{
    return (struct constituent){.scattering_per_m = constant_spectrum(scattering_per_m),
                                .absorption_per_m = constant_spectrum(absorption_per_m),
                                .profile = profile,
                                .phase = phase};
}

static inline struct profile exponential_profile(double scale_height_m)
{
    return (struct profile){.kind = PROFILE_EXPONENTIAL, .scale_height_m = scale_height_m};
}

// Air without constituents: 60 km on 6360 km, a parallel beam of 1 W m^-2 nm^-1.
static inline struct medium empty_medium(double albedo)
{
    return (struct medium){.ground_radius_m = 6360e3,
                           .top_radius_m = 6420e3,
                           .ground_albedo = constant_spectrum(albedo),
                           .star_irradiance = constant_spectrum(1)};
}

// A shell of constant density with no other constituent.
static inline struct medium uniform_medium(double scattering_per_m, double absorption_per_m,
                                           double albedo)
{
    struct medium medium = empty_medium(albedo);
    medium.constituent_count = 1;
    medium.constituents[0] = make_constituent(scattering_per_m, absorption_per_m,
                                              (struct profile){.kind = PROFILE_UNIFORM},
                                              (struct phase){.kind = PHASE_ISOTROPIC});
    return medium;
}

// Much like Earth in the blue: air, haze, and a layer that absorbs.
static inline struct medium earth_like_medium(double albedo)
{
    struct medium medium = empty_medium(albedo);
    medium.constituent_count = 3;
    medium.constituents[0] = make_constituent(2.5e-5, 0, exponential_profile(8000),
                                              (struct phase){.kind = PHASE_RAYLEIGH});
    medium.constituents[1] =
        make_constituent(4e-5, 4e-6, exponential_profile(1200),
                         (struct phase){.kind = PHASE_HENYEY_GREENSTEIN, .g = 0.7});
    medium.constituents[2] = make_constituent(
        0, 2e-6, (struct profile){.kind = PROFILE_TENT, .centre_m = 25000, .half_width_m = 15000},
        (struct phase){.kind = PHASE_ISOTROPIC});
    return medium;
}

#endif // REFERENCE_MEDIA_H
