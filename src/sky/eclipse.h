// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_ECLIPSE_H
#define SKY_ECLIPSE_H
// The body whose shadow falls on what is seen, if any: most views have none, and are drawn by
// programs that know of none.

#include "gpu/texture.h"
#include "scatter/atmosphere.h"
#include "scatter/umbra.h"
#include "sky/pixels.h"

// Index in the camera's bodies, or -1: of bodies whose penumbra touches the planet's air or covers
// the eye, that which is nearest to the line from the planet's centre to the star.
int sky_eclipse_find(const struct sky_pixels *pixels, const struct camera *camera);

// What is left of scattered light around the shadow that was last seen.
//
//     air     3D RGBA32F  u x v x altitude, shares of XYZ, as in scatter/umbra.h
//     ground  2D RGBA32F  u x v, shares of the sky's light on the ground, in the bands
struct sky_eclipse {
    struct gpu *gpu;
    struct umbra_kernel *kernel; // NULL before the first shadow
    struct umbra_map *map;
    struct umbra_shadow shadow; // that the map is of
    int orders;                 // that light may have, set by the owner; 0: all
    double corona;              // times the Sun's
    struct vec3 place_m;        // where its axis meets the ground, or passes it nearest
    struct gpu_texture air, ground;
};

void sky_eclipse_finish(struct sky_eclipse *eclipse);

// Of the body that sky_eclipse_find has found; nothing where it finds none or the shadow is the
// last one. `eclipse` is zero before the first time; the atmosphere is the same until
// sky_eclipse_finish.
// TRL_ERROR_GPU, TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result sky_eclipse_update(const struct sky_pixels *pixels,
                                           const struct camera *camera,
                                           const struct atmosphere *atmosphere,
                                           struct sky_eclipse *eclipse);

// The angle under which the eye sees the width of the umbra, or of the antumbra.
double sky_eclipse_width(const struct sky_eclipse *eclipse, const struct camera *camera);

// The uniforms of sky/eclipse.glsl.
void sky_eclipse_set(const struct sky_pixels *pixels, const struct sky_eclipse *eclipse,
                     const struct camera *camera, struct gpu_program *program);

#endif // SKY_ECLIPSE_H
