// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_BODY_LIGHT_H
#define SKY_BODY_LIGHT_H
// How bodies without air reflect the light of their star: docs/physics.md, section 24.

#include "base/camera.h"
#include "spectrum/spectrum.h"

// Where the light of a disc comes from at each phase. In all of them the geometric albedo is that
// of the fully lit disc.
enum body_law {
    BODY_LOMMEL_SEELIGER = 0, // dark regolith that scatters once: the full disc is flat
    BODY_LAMBERT,             // bright and matt: clouds, ice
    BODY_LUNAR // Lommel-Seeliger's disc with the Moon's measured brightness at each phase
};

// Light of the whole disc relative to when it is fully lit, at a phase angle from 0 to pi (between
// star and observer, seen from the body).
double body_phase(enum body_law law, double phase_angle_rad);

// What the law's radiance is multiplied with so that the disc sums to body_phase: 1 but for
// BODY_LUNAR.
double body_phase_scale(enum body_law law, double phase_angle_rad);

// What is known of a body's surface.
struct body_desc {
    const struct spectrum *geometric_albedo;
    enum body_law law;
};

// A body as a camera sees it.
struct body_sight {
    struct vec3 direction; // unit, to its centre
    double sine;           // of its angular radius
    double phase_angle_rad;
};
struct body_sight body_see(const struct camera *camera, const struct camera_body *body);

// Irradiance that the whole body sends to an eye, above the air, relative to that of the star at
// the planet, for a geometric albedo of 1.
double body_share(enum body_law law, const struct body_sight *sight);

#endif // SKY_BODY_LIGHT_H
