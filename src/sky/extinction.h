// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_EXTINCTION_H
#define SKY_EXTINCTION_H
// What the air leaves of the light of things beyond it, by wavelength, for one eye and any zenith
// angle; and the colour of what is left. Air in spherical shells does not know azimuths, so one row
// of optical depths serves the whole sky. No model of the sky is needed. Refraction is left out.

#include "scatter/ray.h"
#include "spectrum/cie.h"

enum { EXTINCTION_ROWS = 192 };

struct extinction {
    const trl_context *ctx;
    struct optics *optics;           // owned
    struct ray_rules *rules;         // owned
    struct ray *ray;                 // owned, scratch
    lanes *depth;                    // [EXTINCTION_ROWS], owned
    double xyz_from_lanes[3][LANES]; // lx of irradiance in W m^-2 nm^-1
    double radius_m;                 // of the eye; 0: nothing yet
    unsigned version;                // another one whenever the rows have changed
    double horizon_mu, highest_mu;   // of the rows: mu = horizon + (highest - horizon) x^2
};

// The medium must outlive it. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result extinction_init(const trl_context *ctx, const struct medium *medium,
                                        struct extinction *out);
// After a change of the medium in its place.
void extinction_change(struct extinction *extinction);
void extinction_finish(struct extinction *extinction);

// Makes the rows for an eye at this distance from the centre; nothing when it has not moved.
void extinction_update(struct extinction *extinction, double radius_m);

// Whether the reference sphere hides what is at that zenith angle.
bool extinction_is_hidden(const struct extinction *extinction, double mu);

// Transmittance from the eye to space. Below the horizon as along it.
lanes extinction_at(const struct extinction *extinction, double mu);

// Values of a spectrum at the wavelengths.
lanes extinction_sample(const struct extinction *extinction, const struct spectrum *spectrum);

// Illuminance as linear sRGB, lx, of irradiance in W m^-2 nm^-1.
struct cie_rgb extinction_colour(const struct extinction *extinction, const lanes *irradiance);

#endif // SKY_EXTINCTION_H
