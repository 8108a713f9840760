// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_ATMOSPHERE_H
#define TRL_ATMOSPHERE_H

#include <terrella/scene.h>

TRL_BEGIN

/// One question about the sky of a scene.
typedef struct trl_sky_query {
    double altitude_m;      ///< of the observer above the reference sphere, >= 0; may be above the
                            ///< atmosphere
    double sun_zenith_rad;  ///< of the star's centre, [0, pi]
    double view_zenith_rad; ///< [0, pi]; above pi/2 looks down
    double azimuth_rad;     ///< of the view from the star's azimuth
    double wavelength_nm;   ///< > 0
} trl_sky_query;

typedef struct trl_sky_desc {
    uint32_t canary;     ///< set by trl_sky_desc_default(); never touch
    trl_sky_model model; ///< default TRL_SKY_SPECTRAL
    uint32_t max_orders; ///< scatterings and reflections by the ground that light may have, at most
                         ///< TRL_SKY_MAX_ORDERS; 0 (default): all that the model has, which is 1
                         ///< for TRL_SKY_SINGLE
    uint64_t paths;      ///< TRL_SKY_REFERENCE: for each query, [2, 1e12]; default 10000
    uint64_t seed;       ///< TRL_SKY_REFERENCE: same seed, same numbers, on any number of threads
    const trl_rayleigh_desc *rayleigh; ///< TRL_SKY_RAYLEIGH; NULL (default): as the scene asks
} trl_sky_desc;

enum { TRL_SKY_MAX_ORDERS = 1000 };

/// A desc with every default set. Threads: any.
TRL_API trl_sky_desc trl_sky_desc_default(void);

/// Spectral radiance in W m^-2 sr^-1 nm^-1 that arrives at the observer from each direction asked
/// for: scattered light, light reflected by the Lambertian ground where the ray meets it, no solar
/// disc. The transport is solved at exactly the wavelengths of the queries. Blocks for seconds;
/// uses every core; tells progress.
/// @param desc                 NULL: the default
/// @param[out] radiance        `count` values, finite
/// @param[out] standard_error  `count` values in the same unit, of the path tracer's noise; 0 for
///                             the models that have none. May be NULL
/// @return TRL_OK; TRL_ERROR_INVALID (a query out of range, its index in the log; a field of the
///         desc); TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED
TRL_API TRL_MUST_USE trl_result trl_sky_radiance(trl_context *ctx, const trl_scene *scene,
                                                 const trl_sky_desc *desc,
                                                 const trl_sky_query *queries, size_t count,
                                                 double *radiance, double *standard_error);

/// How far the columns that TRL_SKY_RAYLEIGH reads from its texture or its fit are off, relative to
/// exact integration: over phi in [pi/2, pi] and heights from the sphere to the air's top, 200 x
/// 200 points (Santana 2017, Section 8.1).
typedef struct trl_rayleigh_errors {
    double mean, largest;
} trl_rayleigh_errors;

/// @param desc  NULL: as the scene asks
/// @return TRL_OK; TRL_ERROR_INVALID (a field of the desc, named in the log); TRL_ERROR_MEMORY
TRL_API TRL_MUST_USE trl_result trl_rayleigh_errors_read(trl_context *ctx, const trl_scene *scene,
                                                         const trl_rayleigh_desc *desc,
                                                         trl_rayleigh_errors *out);

/// The light transport of one scene, solved for pictures: moments of all orders and the 4D table.
/// A renderer makes its own; this is for programs that want to know what it costs, or to fill the
/// cache. Owner: caller. Lifetime: destroy before its scene and context. Threads: immutable.
typedef struct trl_atmosphere trl_atmosphere;

typedef struct trl_atmosphere_desc {
    uint32_t canary;       ///< set by trl_atmosphere_desc_default(); never touch
    uint32_t wavelengths;  ///< for the solver, 1 to 16
    trl_spectrum spectrum; ///< default TRL_SPECTRUM_FULL; TRL_SPECTRUM_RGB has three wavelengths
    uint32_t max_orders;   ///< as in trl_renderer_desc; 0 (default): all
    bool uses_cache;       ///< take from the context's cache folder, and keep there
} trl_atmosphere_desc;

/// What an atmosphere took and holds.
typedef struct trl_atmosphere_stats {
    double solve_s; ///< all orders of scattering; 0 when from the cache
    double table_s; ///< the 4D table, after that; 0 when from the cache
    double load_s;  ///< from the cache; 0 when computed
    int orders;     ///< of scattering, as asked for; for all of them, steps of the iteration
    size_t solution_bytes;
    size_t table_bytes;
    bool is_from_cache;
    double band_nm[4];       ///< the wavelengths that stand for all on the GPU
    double band_error_share; ///< RMS colour difference that this makes, relative to the luminance
} trl_atmosphere_stats;

/// 16 wavelengths, with the cache. Threads: any.
TRL_API trl_atmosphere_desc trl_atmosphere_desc_default(void);

/// Solves, or takes from the cache. Blocks for about a second; uses every core; tells progress.
/// @param[out] out  new object, or NULL on failure
/// @return TRL_OK; TRL_ERROR_INVALID (an argument); TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED
TRL_API TRL_MUST_USE trl_result trl_atmosphere_create(trl_context *ctx, const trl_scene *scene,
                                                      const trl_atmosphere_desc *desc,
                                                      trl_atmosphere **out);

/// Frees *atmosphere and sets it to NULL.
TRL_API void trl_atmosphere_destroy(trl_atmosphere **atmosphere);

/// Copies the figures. Neither argument may be NULL.
TRL_API void trl_atmosphere_read_stats(const trl_atmosphere *atmosphere, trl_atmosphere_stats *out);

TRL_END
#endif // TRL_ATMOSPHERE_H
