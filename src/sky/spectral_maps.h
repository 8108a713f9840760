// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SPECTRAL_MAPS_H
#define SKY_SPECTRAL_MAPS_H
// What the spectral model looks up: textures made of a solved atmosphere for one eye and star.
//
//     slice      3D RGBA32F  azimuth x sun x view, the 4D table at the eye's altitude; inside the
//                            air only the first sun is there, the eye's own
//     scattered  3D RGBA32F  depth x azimuth x row, light that the air adds per metre; from
//                            outside azimuth x depth x row
//     extinction 2D RGBA32F  depth x row, per metre
//     bounce     2D RGBA32F  depth x row, what the ground sends by way of the air (aerial.h)
//     sunlight   2D RGBA32F  sun x altitude, direct light on the ground
//     skylight   2D RGBA32F  sun x altitude, irradiance of level ground by the sky
//     rising     2D RGBA32F  sun x altitude, light that rises there over the mean ground
//     evenness   2D RGBA32F  sun x altitude, of both of these (ground_light.h)
//     slope      2D RGBA32F  sun x altitude, of light toward the star (ground_light.h)
//     air_albedo 2D RGBA32F  1 x altitude, what the air above sends back of that
//     phase      2D RGBA32F  sine of half the angle, phase functions of peaked constituents
//     source     3D RGBA32F  as scattered, of each cell alone (aerial.h), for march.h
//
// Slice, scattered and source hold logarithms of XYZ in cd m^-2; the others four bands per unit
// irradiance of the star (scatter/bands.h).

#include "gpu/program.h"
#include "scatter/aerial.h"

struct spectral_maps {
    struct gpu *gpu;
    struct atmosphere *atmosphere; // owned, unless:
    bool is_guest;                 // the atmosphere is that of other maps, which outlive these
    struct aerial aerial;
    struct gpu_texture slice[1 + TABLE_MAX_PEAKED];
    struct gpu_texture scattered[1 + TABLE_MAX_PEAKED];
    struct gpu_texture extinction, bounce, sunlight, skylight, rising, evenness, slope;
    struct gpu_texture air_albedo, phase;
    struct gpu_texture source[AERIAL_SOURCES]; // where it was asked for
    float *texels;                             // scratch of one slice
    double slice_radius_m;                     // what the slice was made for; 0: nothing yet
    double slice_sun_mu;                       // NAN: all suns
    double aerial_radius_m, aerial_sun_mu;
    double highest_m; // altitude up to which light of the ground is tabulated
};

// Takes the atmosphere, also on failure. TRL_ERROR_GPU, TRL_ERROR_MEMORY, TRL_ERROR_UNSUPPORTED (no
// filtered float textures).
TRL_MUST_USE trl_result spectral_maps_init(struct gpu *gpu, struct atmosphere *atmosphere,
                                           struct spectral_maps *out);
// The same for another star in the same atmosphere.
TRL_MUST_USE trl_result spectral_maps_init_beside(const struct spectral_maps *others,
                                                  struct spectral_maps *out);
void spectral_maps_finish(struct spectral_maps *maps);

// From the next update on there is a source. Does nothing the second time.
TRL_MUST_USE trl_result spectral_maps_add_source(struct spectral_maps *maps);

// The eye and star that the maps are made for.
struct spectral_eye {
    double radius_m;
    double sun_mu;
    double highest_m; // altitude of the highest ground
};

// Makes what has changed.
TRL_MUST_USE trl_result spectral_maps_update(struct spectral_maps *maps,
                                             const struct spectral_eye *eye);

// Phase functions of peaked constituents are applied per pixel: those of another medium of the same
// constituents can be shown at once. Exact for the first order; the others keep the old ones until
// the medium is solved.
TRL_MUST_USE trl_result spectral_maps_set_phases(struct spectral_maps *maps,
                                                 const struct medium *medium);

// Hands them to a program of shaders/sky/spectral/, all but the sources.
void spectral_maps_bind(const struct spectral_maps *maps, struct gpu_program *program);

#endif // SKY_SPECTRAL_MAPS_H
