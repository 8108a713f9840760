// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_ECLIPSE_H
#define SKY_ECLIPSE_H
// The body whose shadow falls on what is seen, if any: most views have none, and are drawn by
// programs that know of none.

#include "scatter/optics.h"
#include "sky/pixels.h"

// Index in the camera's bodies, or -1: of bodies whose penumbra touches the planet's air or covers
// the eye, that which is nearest to the line from the planet's centre to the star.
int sky_eclipse_find(const struct sky_pixels *pixels, const struct camera *camera);

// Standard deviation, m, of how far across scattered light has come: see physics.md section 23.
double sky_eclipse_spread(const struct optics *optics);

// The uniforms of sky/eclipse.glsl.
void sky_eclipse_set(const struct sky_pixels *pixels, struct gpu_program *program,
                     const struct camera *camera, double spread_m);

#endif // SKY_ECLIPSE_H
