// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_STARS_H
#define SKY_STARS_H
// Stars of a catalogue, as points of light (sprites.h): where each is, what the air leaves of it,
// and its colour, from all wavelengths. Hidden by the planet, bodies, and terrain.

#include "sky/catalogue.h"
#include "sky/extinction.h"
#include "sky/sprites.h"

struct stars {
    const trl_context *ctx;
    size_t count;
    struct star *stars;     // owned
    struct vec3 pole, node; // of the planet, ICRS; see stars_turn
    double node_right_ascension_rad;
};

struct stars_desc {
    const trl_context *ctx;
    const struct extinction *extinction;                   // for its wavelengths
    const struct catalogue *catalogue;                     // may be freed afterwards
    double pole_right_ascension_rad, pole_declination_rad; // of the planet's north pole
};

// TRL_ERROR_MEMORY.
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
    const struct gpu_target *target;     // of the sprites
};

// Adds those that can be seen, at most `count`.
void stars_add(const struct stars *stars, const struct stars_view *view, struct sprites *sprites);

#endif // SKY_STARS_H
