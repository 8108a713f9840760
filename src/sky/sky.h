// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SKY_H
#define SKY_SKY_H
// The sky pass: for every pixel either lit ground behind air, or sky with the star's disc. Pixels
// are first sorted into ground, air and space, and each kind is drawn by a program of its own with
// a depth test: a software rasteriser runs both sides of a branch.
//
//     in   surface buffers (frame/ground.h), or none for a bare sphere
//     in   slice      3D RGBA32F  azimuth x sun x view, the 4D table at the eye's altitude; inside
//                                 the air only the first sun is there, the eye's own
//     in   scattered  3D RGBA32F  depth x azimuth x row, light that the air adds per metre
//     in   extinction 2D RGBA32F  depth x row, per metre
//     in   sunlight   2D RGBA32F  sun x altitude, direct light on the ground
//     in   skylight   2D RGBA32F  sun x altitude, irradiance of level ground by the sky
//     in   phase      2D RGBA32F  sine of half the angle, phase functions of peaked constituents
//     out  radiance   RGBA32F     linear sRGB, cd m^-2
//     out  kinds      DEPTH32F    scratch; see sort.frag
//
// Slice and scattered hold logarithms of XYZ in cd m^-2; the others four bands per unit irradiance
// of the star (scatter/bands.h).

#include "base/camera.h"
#include "gpu/pass.h"
#include "scatter/aerial.h"

struct sky_surface {
    const struct gpu_texture *position; // NULL: bare sphere, and the others too
    const struct gpu_texture *albedo, *normal, *lights;
    double lights_cd_m2; // luminance of white lights
};

// What differs between a bare sphere and a surface.
struct sky_ground {
    struct gpu_program sort, ground;
};

struct sky {
    struct gpu *gpu;
    const struct atmosphere *atmosphere;
    struct aerial aerial;
    struct sky_ground bare, surface;
    struct gpu_program air, star; // star: where the disc may be
    struct gpu_texture slice[1 + TABLE_MAX_PEAKED];
    struct gpu_texture scattered[1 + TABLE_MAX_PEAKED];
    struct gpu_texture extinction, sunlight, skylight, phase;
    float *texels;         // scratch of one slice
    double slice_radius_m; // what the slice was made for; 0: nothing yet
    double slice_sun_mu;   // NAN: all suns
    double aerial_radius_m, aerial_sun_mu;
    double highest_m; // altitude up to which light of the ground is tabulated
};

// The atmosphere must outlive the sky. TRL_ERROR_GPU, TRL_ERROR_MEMORY, TRL_ERROR_UNSUPPORTED (no
// filtered float textures).
TRL_MUST_USE trl_result sky_init(struct gpu *gpu, const struct atmosphere *atmosphere,
                                 struct sky *out);
void sky_finish(struct sky *sky);

// Makes the maps of this eye and sun; nothing when neither has changed. `highest_m`: altitude of
// the highest ground.
TRL_MUST_USE trl_result sky_prepare(struct sky *sky, const struct camera *camera, double highest_m);

// Draws all pixels of the target, which has a depth texture that nobody else uses meanwhile.
TRL_MUST_USE trl_result sky_draw(struct sky *sky, const struct camera *camera,
                                 const struct sky_surface *surface,
                                 const struct gpu_target *target);

#endif // SKY_SKY_H
