// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_WATER_H
#define TRL_WATER_H

/// @file
/// Light in the water of a scene's ocean as numbers: what leaves it, and what an eye in it sees.
///
///     trl_water_desc desc = trl_water_desc_default();
///     trl_water_query query = {.depth_m = 4, .view_zenith_rad = 2.5, .wavelength_nm = 550};
///     trl_water_light light;
///     trl_water_radiance(ctx, scene, &desc, &query, 1, &light);

#include <terrella/scene.h>

TRL_BEGIN

/// A flat surface above, a Lambertian bed of the scene's albedo below.
typedef struct trl_water_query {
    double depth_m;        ///< of the water, >= 0; INFINITY has no bed
    double eye_depth_m;    ///< of the eye, [0, depth_m]; 0: above the water
    double sun_zenith_rad; ///< of the star's centre, in the air, [0, pi/2)
    double
        view_zenith_rad; ///< of the line of sight, in the eye's medium; above the water (pi/2, pi],
                         ///< below [0, pi]; not level
    double azimuth_rad;  ///< of the line of sight from the star's azimuth
    double wavelength_nm; ///< [1, 1e7]
} trl_water_query;

typedef struct trl_water_desc {
    uint32_t canary;     ///< set by trl_water_desc_default(); never touch
    bool uses_reference; ///< default false. true: by paths of light instead, to judge by; slow
    uint64_t paths;      ///< of these for each query, [2, 1e12]; default 100000
    uint64_t seed;       ///< same seed, same numbers, on any number of threads
} trl_water_desc;

/// Above the water: what leaves it, without what its surface mirrors. Below: what reaches the eye,
/// with the sky as seen through the surface and without the disc of the star.
typedef struct trl_water_light {
    double star_per_sr; ///< radiance by the star, per irradiance of level water by it, from above
    double sky_per_sr;  ///< the same by a sky that has the same radiance everywhere
    double star_error;  ///< standard errors of the paths' noise, 0 without
    double sky_error;
    double
        star_irradiance; ///< of level water at the reference radius, behind the air, W m^-2 nm^-1
    double sky_irradiance;
    double radiance; ///< of both together, W m^-2 sr^-1 nm^-1
} trl_water_light;

/// A desc with every default set. Threads: any.
TRL_API trl_water_desc trl_water_desc_default(void);

/// All orders of scattering at exactly the wavelengths of the queries. Blocks for seconds, uses
/// every core.
/// @param desc         NULL: the default
/// @param[out] lights  `count` of them
/// @return TRL_OK; TRL_ERROR_INVALID (a query out of range, its index in the log; a field of the
///         desc; a scene without ocean); TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED
TRL_API TRL_MUST_USE trl_result trl_water_radiance(trl_context *ctx, const trl_scene *scene,
                                                   const trl_water_desc *desc,
                                                   const trl_water_query *queries, size_t count,
                                                   trl_water_light *lights);

/// What a trl_water_light tells as a colour: linear sRGB in the star's own light, pi times the
/// radiance per irradiance of level water from above, so that a white wall is 1, 1, 1. Colours that
/// no screen has are below 0.
typedef struct trl_water_colour {
    double star_rgb[3];
    double sky_rgb[3];
} trl_water_colour;

/// Colours as pictures have them, from the tables that they are drawn with; by paths of light at 41
/// wavelengths where the desc says so. The wavelengths of the queries do not count. Uses every
/// core.
/// @param desc          NULL: the default
/// @param[out] colours  `count` of them
/// @return as trl_water_radiance
TRL_API TRL_MUST_USE trl_result trl_water_colours(trl_context *ctx, const trl_scene *scene,
                                                  const trl_water_desc *desc,
                                                  const trl_water_query *queries, size_t count,
                                                  trl_water_colour *colours);

/// What a table of 16 wavelengths over depth, view and star takes, and how far what is read from it
/// is from solving for the very query: over 36 places between its entries at three wavelengths.
typedef struct trl_water_table_stats {
    double make_s;
    size_t bytes;
    double mean_error, largest_error; ///< relative
    double under_make_s;              ///< of the light around eyes under water, over a bed in 10 m
    size_t under_bytes;
} trl_water_table_stats;

/// Makes the tables anew. Uses every core.
/// @return TRL_OK; TRL_ERROR_INVALID (an argument; a scene without ocean); TRL_ERROR_MEMORY
TRL_API TRL_MUST_USE trl_result trl_water_table_measure(trl_context *ctx, const trl_scene *scene,
                                                        trl_water_table_stats *out);

TRL_END
#endif // TRL_WATER_H
