// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_ATMOSPHERE_H
#define TRL_ATMOSPHERE_H

#include <terrella/scene.h>

TRL_BEGIN

/// One question about the sky of a scene.
typedef struct trl_sky_query {
    double altitude_m;      ///< of the observer above the reference sphere, >= 0; may be above the atmosphere
    double sun_zenith_rad;  ///< of the star's centre, [0, pi]
    double view_zenith_rad; ///< [0, pi]; above pi/2 looks down
    double azimuth_rad;     ///< of the view from the star's azimuth
    double wavelength_nm;   ///< > 0
} trl_sky_query;

/// Spectral radiance in W m^-2 sr^-1 nm^-1 that arrives at the observer from each direction asked for: all
/// orders of scattering, light reflected by the Lambertian ground where the ray meets it, no solar disc.
/// The transport is solved at exactly the wavelengths of the queries. Blocks for seconds; uses every core.
/// @param[out] radiance  `count` values, finite
/// @return TRL_OK; TRL_ERROR_INVALID (a query out of range, its index in the log); TRL_ERROR_MEMORY;
///         TRL_ERROR_CANCELLED
TRL_API TRL_MUST_USE trl_result trl_sky_radiance(trl_context *ctx, const trl_scene *scene,
                                                 const trl_sky_query *queries, size_t count,
                                                 double *radiance);

TRL_END
#endif // TRL_ATMOSPHERE_H
