// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_CLOUDS_H
#define FRAME_CLOUDS_H
// The scene's clouds in the frame: hands them the air of the model of the sky. A model without such
// air draws none, which is told once.

#include "cloud/march.h"
#include "scene/scene.h"
#include "sky/sky.h"

struct clouds {
    const trl_context *ctx;
    struct gpu *gpu;
    const struct trl_scene *scene; // must outlive it
    struct cloud_field *field;     // owned; NULL: no model has asked for them, or there are none
    struct cloud_march march;
    bool is_told;
    bool accumulates; // over frames, see cloud/history.h
    double time_s;    // of the frame
};

void clouds_init(struct gpu *gpu, const struct trl_scene *scene, struct clouds *out);
// When frames will be drawn with that model: loads and computes what it needs of the clouds, if it
// draws any. TRL_ERROR_IO, TRL_ERROR_INVALID (the map); as cloud_march_init.
TRL_MUST_USE trl_result clouds_make(struct clouds *clouds, const struct sky *sky);
void clouds_finish(struct clouds *clouds);

// There are some, and the model can.
bool clouds_are_drawn(const struct clouds *clouds, const struct sky *sky);

// Before the model prepares: what the view has of clouds.
void clouds_announce(struct clouds *clouds, const struct sky *sky, double time_s,
                     struct sky_view *view);
// As those of cloud/march.h, in the same order; what they hide is then in the view.
TRL_MUST_USE trl_result clouds_find_deck(struct clouds *clouds, const struct sky *sky,
                                         const struct sky_view *view);
TRL_MUST_USE trl_result clouds_draw(struct clouds *clouds, const struct sky *sky,
                                    struct sky_view *view);
TRL_MUST_USE trl_result clouds_shade(struct clouds *clouds, const struct sky *sky,
                                     const struct sky_view *view);
TRL_MUST_USE trl_result clouds_join(struct clouds *clouds, const struct sky *sky,
                                    const struct sky_view *view);

#endif // FRAME_CLOUDS_H
