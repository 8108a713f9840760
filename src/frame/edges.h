// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_EDGES_H
#define FRAME_EDGES_H
// Smooth silhouettes: the horizon, and ridges before what is far behind them. A pixel is drawn
// through its middle; here those at an edge become the mean of both sides, by how much of each they
// show. Works on radiance, so a pixel is what a camera's would be. From so far away that the air
// over the horizon shines within less than a pixel, the next pixel knows nothing of it, and the
// horizon is left as it is.
//
// Pixels at edges are marked in the depth of the radiance's target (nobody needs the kinds of
// pixels any more), blended into a texture apart and copied back: everything else is left alone.

#include "sky/pixels.h"

struct edges {
    struct gpu *gpu;
    struct gpu_program mark[2], blend[2]; // of the bare sphere, of surface buffers
    struct gpu_program copy;
    struct gpu_texture blended; // RGBA32F, defined at edges only
    struct gpu_target target;   // it, with the depth of the radiance's
};

TRL_MUST_USE trl_result edges_init(struct gpu *gpu, struct edges *out);
void edges_finish(struct edges *edges);

// For pictures of the size of `depth`, the one of their target; before the first of them.
TRL_MUST_USE trl_result edges_resize(struct edges *edges, const struct gpu_texture *depth);
// Before `depth` is unmade.
void edges_forget(struct edges *edges);

struct edges_source {
    const struct sky_view *view;
    const struct gpu_texture *radiance; // of the view's target
    double ground_radius_m, top_radius_m;
    double glow_m; // height of the air that shines above the horizon; 0: none
};

// When everything is in the view's target.
TRL_MUST_USE trl_result edges_draw(struct edges *edges, const struct edges_source *source);

#endif // FRAME_EDGES_H
