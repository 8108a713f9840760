// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_LOOK_H
#define TERRAIN_LOOK_H
// What the ground looks like at a point, on the CPU: for surfaces without a GPU. Pictures are laid
// over each other as terrain/surface.frag does it, at their finest level.

#include "terrain/surface.h"

// Linear sRGB of the pictures of a kind over `below`, which is kept where there are none. False
// if no picture reaches there.
bool surface_picture(const struct surface *surface, enum surface_kind kind, struct vec3 direction,
                     double rgb[3]);

// Linear sRGB of the biomes of invented ground over `rgb`. False if there are none.
bool surface_biomes(const struct surface *surface, struct vec3 direction, double rgb[3]);

// Part of a place that is open water by the masks, and its depth by shared/sea.glsl, where the
// surface tells depths; masks in tiles at the level that is held.
double surface_water(const struct surface *surface, struct vec3 direction, double *depth_code);

// Part of a place that is open water as masks have it between their texels, or where invented
// ground lies below the sea by its map; and how large a texel of that is: 0 where there is neither.
double surface_open_water(const struct surface *surface, struct vec3 direction);
double surface_mask_texel_rad(const struct surface *surface);

// Unit normal of the composed heights.
struct vec3 surface_normal(const struct surface *surface, struct vec3 direction);

// Half the height of a texel, in m on the sphere, of the finest elevation layer that reaches within
// `reach_rad` of a direction; without one a hundredth of the radius.
double surface_half_texel_m(const struct surface *surface, struct vec3 direction, double reach_rad);

// Of open water there, m; 0: none. What is deeper than SEA_DEEP_M of shared/sea.glsl counts as
// that, but where all water is as deep.
double surface_water_depth_m(const struct surface *surface, struct vec3 direction);

#endif // TERRAIN_LOOK_H
