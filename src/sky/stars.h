// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_STARS_H
#define SKY_STARS_H
// Stars of a catalogue, added to a picture of the sky. Each is a point: its light is spread over a
// few pixels by a kernel whose samples sum to 1 wherever the point is between them (quadratic
// B-spline), so a star keeps its light in any size of picture and does not flicker as it moves.
// The CPU finds where each star is, what the air leaves of it and its colour, from all wavelengths;
// one draw adds all of them. Hidden by the planet, bodies, and terrain through the kinds of pixels.

#include "base/camera.h"
#include "gpu/pass.h"
#include "sky/catalogue.h"
#include "sky/extinction.h"

struct stars {
    const trl_context *ctx;
    struct gpu *gpu;
    size_t count;
    struct star *stars;          // owned
    struct star_sprite *sprites; // owned, scratch of one frame
    struct vec3 pole, node;      // of the planet, ICRS; see stars_turn
    double node_right_ascension_rad;
    struct gpu_program program;
    struct gpu_mesh mesh;
};

struct stars_desc {
    struct gpu *gpu;
    const struct extinction *extinction;                   // for its wavelengths
    const struct catalogue *catalogue;                     // may be freed afterwards
    double pole_right_ascension_rad, pole_declination_rad; // of the planet's north pole
};

TRL_MUST_USE trl_result stars_init(const struct stars_desc *desc, struct stars *out);
void stars_finish(struct stars *stars);

// The planet's axes in the ICRS when the prime meridian has been turned to that right ascension
// (for a pole like Earth's; else see docs/physics.md).
struct stars_axes {
    struct vec3 x, y, z;
};
struct stars_axes stars_turn(const struct stars *stars, double sidereal_rad);

struct stars_view {
    const struct camera *camera;
    double sidereal_rad;
    const struct extinction *extinction; // updated for the camera
    const struct gpu_target *target;     // radiance, with the kinds of sort.frag as its depth
};

// Adds the stars to the target.
TRL_MUST_USE trl_result stars_draw(struct stars *stars, const struct stars_view *view);

#endif // SKY_STARS_H
