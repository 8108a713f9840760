// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_BODIES_H
#define SKY_BODIES_H
// Moons and other planets, added to a picture: discs with their phase, behind the air. Of a disc of
// few pixels a point is made (sprites.h), so that it keeps its light. The planet's shadow on
// bodies, theirs on each other, and which of two is nearer are left out.

#include "sky/body_light.h"
#include "sky/extinction.h"
#include "sky/sprites.h"

struct body {
    lanes reflected; // the star's irradiance times the geometric albedo, W m^-2 nm^-1
    enum body_law law;
    // Light of the disc, fully lit, relative to its solid angle over pi, behind the air:
    // EXTINCTION_ROWS x 1, RGBA32F, linear sRGB, lx.
    struct gpu_texture light;
    unsigned version; // of the extinction that it was made for; 0: none
};

struct bodies {
    struct gpu *gpu;
    const struct extinction *extinction;
    size_t count;
    struct body bodies[CAMERA_MAX_BODIES]; // in the scene's order
    struct gpu_program program;            // made when first asked for
};

struct bodies_desc {
    struct gpu *gpu;
    const struct extinction *extinction; // must outlive them; with the medium of the star
    size_t count;
    const struct body_desc *bodies; // needed during init only
};

void bodies_init(const struct bodies_desc *desc, struct bodies *out);
void bodies_finish(struct bodies *bodies);

struct bodies_view {
    const struct camera *camera;
    const struct gpu_target *target; // radiance, with the kinds of sort.frag as its depth
};

// Adds discs to the target. The extinction has been updated for the camera.
TRL_MUST_USE trl_result bodies_draw(struct bodies *bodies, const struct bodies_view *view);

// Adds the others to the points; at most `count`.
void bodies_add(const struct bodies *bodies, const struct bodies_view *view,
                struct sprites *sprites);

#endif // SKY_BODIES_H
