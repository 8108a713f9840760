// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/depth.h"

#include "terrain/mesher.h"

#include <math.h>

// Ground nearer than this part of the height above it is steeper than acos 0.1 = 84 degrees, or
// seen at the corner of a wide picture.
static const double NEAR_OF_HEIGHT = 0.1;
static const double LEAST_NEAR_M = 5e-4;
// The near range reaches a little into the far one: the same triangles, clipped by each at another
// plane, would leave pixels between them.
static const double OVERLAP = 1.02;

// Clip z is w at the near plane and, where depth runs to -1 (no clip control), -w at the far one.
static struct depth_range make_range(double near_m, double far_m, bool has_clip_control)
{
    const double at_far = has_clip_control ? 0 : -1;
    struct depth_range range = {near_m, far_m, at_far, 0};
    // scale + offset / near = 1; scale + offset / far = at_far
    range.offset_m = (1 - at_far) / (1 / near_m - 1 / far_m);
    range.scale = 1 - range.offset_m / near_m;
    if (isinf(far_m)) {
        range.scale = at_far; // without rounding
    }
    return range;
}

// How far the highest ground can be seen over the lowest.
static double find_reach_m(const struct surface *surface, double distance_m)
{
    const double low = surface->radius_m + surface_min_altitude(surface);
    const double high = surface->radius_m + surface_max_altitude(surface);
    return sqrt(fmax(0, (distance_m - low) * (distance_m + low))) +
           sqrt(fmax(0, (high - low) * (high + low)));
}

struct depth_ranges depth_ranges_make(const struct surface *surface, const struct camera *camera)
{
    const double distance = vec3_length(camera->position_m);
    const double height =
        distance - surface->radius_m - surface_altitude(surface, camera->position_m);
    const double near = fmax(LEAST_NEAR_M, NEAR_OF_HEIGHT * height);
    struct depth_ranges ranges = {.gpu = surface->gpu};
    const bool has_clip_control = surface->gpu->caps.has_clip_control;
    if (has_clip_control) {
        ranges.of[ranges.count++] = make_range(near, INFINITY, true);
        return ranges;
    }
    // Each range is then as much too coarse at its far end as the other.
    const double middle = sqrt(near * fmax(near, find_reach_m(surface, distance)));
    ranges.of[ranges.count++] = make_range(middle, INFINITY, false);
    ranges.of[ranges.count++] = make_range(near, OVERLAP * middle, false);
    return ranges;
}

void depth_range_begin(const struct depth_ranges *ranges, int index,
                       const struct gpu_target *target, enum gpu_cull cull)
{
    const struct gpu_pass pass = {
        .target = target,
        .state = {.depth = GPU_DEPTH_NEARER, .writes_depth = true, .cull = cull},
        .clears_color = index == 0,
        .color = {0, 0, 0, MESHER_NO_SURFACE},
        .clears_depth = true,
        .depth = ranges->gpu->caps.has_clip_control ? 0 : -1};
    gpu_pass_begin(ranges->gpu, &pass);
}

void depth_range_bind(const struct depth_range *range, struct gpu_program *program)
{
    const float values[4] = {(float)range->scale, (float)range->offset_m, 0, 0};
    gpu_program_set_vec4(program, "u_depth_range", values);
}
