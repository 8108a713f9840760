// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_DEPTH_H
#define TERRAIN_DEPTH_H
// Depth of the ground's mesh, from a centimetre before the camera to the horizon. With clip control
// one range does: reversed depth, z = near / distance in [0, 1], keeps a float's relative precision
// everywhere. Without it window depth has even steps of 6e-8, and the ground is drawn in two
// ranges, as in PGM (Section 6): the far one first, then, over a cleared depth, the near one. The
// shaders' side is shaders/terrain/depth.glsl.
//
//     struct depth_ranges ranges = depth_ranges_make(surface, camera);
//     for (int i = 0; i < ranges.count; i++) {
//         depth_range_begin(&ranges, i, target, cull);
//         depth_range_bind(&ranges.of[i], program);
//         … draw what reaches from ranges.of[i].near_m to .far_m along the view axis
//     }

#include "base/camera.h"
#include "gpu/pass.h"
#include "terrain/surface.h"

// Along the view axis. Clip z is scale * distance + offset_m, w is the distance.
struct depth_range {
    double near_m, far_m; // far may be infinite
    double scale, offset_m;
};

struct depth_ranges {
    struct gpu *gpu;
    int count; // 1 or 2, in the order of drawing
    struct depth_range of[2];
};

struct depth_ranges depth_ranges_make(const struct surface *surface, const struct camera *camera);

// Begins the pass of range `index` of the mesh; the first clears `target` to "no ground".
void depth_range_begin(const struct depth_ranges *ranges, int index,
                       const struct gpu_target *target, enum gpu_cull cull);

// Sets what shaders/terrain/depth.glsl needs.
void depth_range_bind(const struct depth_range *range, struct gpu_program *program);

// Whether a ball may be seen in a range: its centre's distance along the view axis, its radius.
static inline bool depth_range_holds(const struct depth_range *range, double along_m,
                                     double radius_m)
{
    return along_m + radius_m > range->near_m && along_m - radius_m < range->far_m;
}

#endif // TERRAIN_DEPTH_H
