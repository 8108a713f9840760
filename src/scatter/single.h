// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_SINGLE_H
#define SCATTER_SINGLE_H
// The tables of the model `single` (Schafhitzel, Falk and Ertl 2007): light scattered once, from a
// point along a ray to its far end, over the point's altitude and the zenith angles of the star and
// of the ray. There is no azimuth: the star is taken in the plane of ray and zenith, on the ray's
// side. Phase functions are left out and applied per pixel, with the true angle.
//
// Constituents with the same phase function share a channel. What is only added is a colour, from
// all wavelengths; what is multiplied is in four bands (bands.h) per unit irradiance of the star.
// docs/decisions/021-two-look-ups-in-colour.md

#include "scatter/bands.h"

enum {
    SINGLE_HEIGHTS = 128,
    SINGLE_SUNS = 128,
    SINGLE_VIEWS = 128,
    SINGLE_GROUND_VIEWS = 48, // of these: rays that meet the ground; their texels are means per m
    SINGLE_CHANNELS = 4,      // at most
    SINGLE_DEPTH_VIEWS = 256, // all of them miss the ground
    SINGLE_LIGHT_SUNS = 256,
    SINGLE_MEDIUM_ALTITUDES = 512
};

struct single_tables {
    const struct optics *optics; // the caller's
    struct ray_rules *rules;
    struct sunlight sun;
    struct bands bands;
    struct added_bands added;
    lanes rgb_from_lanes[3]; // exact, in cd m^-2 of radiance per unit irradiance
    int channels;
    int channel[MEDIUM_MAX_CONSTITUENTS];   // of each constituent; -1: it does not scatter
    double weight[MEDIUM_MAX_CONSTITUENTS]; // of its phase function in its channel; sum 1 in each
    double sun_centre, sun_width, sun_first, sun_last; // see sky_map_sun
    // By single_map.glsl. Four floats a texel:
    float *scattered[SINGLE_CHANNELS]; // [height][sun][view]: linear sRGB, cd m^-2, and 0, without
                                       // the phase function (cd m^-2 sr)
    float *depth;  // [height][view]: optical depth to the top, rays that miss the ground; bands
    float *light;  // [height][sun]: direct light, by sky_map_sunlight; bands
    float *medium; // [1 + channels][altitude]: extinction, then scattering, per m; bands
};

// Computes all. Blocks for about half a second. TRL_ERROR_MEMORY, TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result single_tables_init(const trl_context *ctx, const struct optics *optics,
                                           struct single_tables *out);
// Frees the texels; what remains tells how to look them up.
void single_tables_drop(const trl_context *ctx, struct single_tables *tables);
void single_tables_finish(const trl_context *ctx, struct single_tables *tables);

// The phase function of a channel in sr^-1: the mean of its constituents', by how much they
// scatter.
double single_phase(const struct single_tables *tables, int channel, double nu);

#endif // SCATTER_SINGLE_H
