// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUD_HISTORY_H
#define CLOUD_HISTORY_H
// Clouds over several frames: each marches a quarter of the rays, in turn, and takes the others
// from the frame before (shaders/cloud/gather.frag). After four frames without a move they are
// those of a whole march. docs/physics.md, section 29.

#include "base/camera.h"
#include "cloud/rays.h"
#include "gpu/program.h"

struct cloud_history {
    struct gpu_program gather; // made with the march's
    struct cloud_rays fresh;
    bool is_kept; // the frame before is known:
    struct camera camera;
    double time_s;
    unsigned turn; // which quarter comes next
};

// When, and how far the nearest layer is.
struct cloud_moment {
    const struct camera *camera;
    double time_s, far_m;
};

// Whether the frame before can serve: it is known, and nothing has jumped since.
bool cloud_history_holds(const struct cloud_history *history, const struct cloud_moment *moment);
void cloud_history_keep(struct cloud_history *history, const struct cloud_moment *moment);
// With its targets; as after finish.
void cloud_history_forget(struct cloud_history *history);

// Room for a quarter of `whole`, and which one comes: u_grid.
TRL_MUST_USE trl_result cloud_history_begin(struct gpu *gpu, struct cloud_history *history,
                                            const struct cloud_rays *whole, float grid[3]);
// The uniforms of gather.frag but those of the view.
void cloud_history_set(struct cloud_history *history, const struct camera *camera,
                       const float grid[3], const struct cloud_rays *past);

#endif // CLOUD_HISTORY_H
