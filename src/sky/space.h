// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SPACE_H
#define SKY_SPACE_H
// What is beyond the air, added to a picture after a model of the sky has drawn it: bodies, stars
// and the faint light between them. Works the same for every model.

#include "sky/bodies.h"
#include "sky/sky.h"
#include "sky/stars.h"

struct space {
    struct gpu *gpu;
    double ground_radius_m;
    struct extinction extinction;
    struct stars stars;
    struct bodies bodies;
    struct sprites sprites; // of stars and bodies; none: not made
    double background_cd_m2, airglow_share;
    float ground_albedo[3]; // linear sRGB, of a bare sphere
    struct gpu_program background, ground_bare, ground_surface;
};

struct space_desc {
    struct gpu *gpu;
    const struct medium *medium; // must outlive it
    const char *catalogue_path;  // NULL: no stars
    double limit_magnitude;
    double pole_right_ascension_rad, pole_declination_rad;
    double background_cd_m2; // at the zenith
    double airglow_share;    // of it
    float ground_albedo[3];
    size_t body_count;
    const struct body_desc *bodies; // needed during init only
};

// TRL_ERROR_IO, TRL_ERROR_INVALID (the catalogue), TRL_ERROR_MEMORY, TRL_ERROR_GPU.
TRL_MUST_USE trl_result space_init(const struct space_desc *desc, struct space *out);
void space_finish(struct space *space);

// After a change of the medium in its place.
void space_change(struct space *space);

// Adds to a target that a model of the sky has drawn.
TRL_MUST_USE trl_result space_draw(struct space *space, const struct sky_view *view,
                                   double sidereal_rad);

#endif // SKY_SPACE_H
