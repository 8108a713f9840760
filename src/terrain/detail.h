// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_DETAIL_H
#define TERRAIN_DETAIL_H
// Made-up relief and colour below the resolution of the data: a fractal noise fixed to the planet.
// It bends normals and varies albedo; heights are left alone. Fades in where the data end, and out
// where a pixel is larger, so that what is seen from afar is the data only.

#include "gpu/program.h"
#include "gpu/texture.h"
#include "terrain/anchor.h"

// All 0: none.
struct detail_desc {
    double roughness;        // its slopes are those of the data times this; 1 is as natural
    double albedo_variation; // standard deviation relative to the albedo, nearly
    double smallest_m;       // its shortest wavelength, > 0
};

// One tile of noise is laid in several sizes.
enum { DETAIL_MAX_SIZES = 6 };

// Owner: whoever made it. Must not outlive its gpu.
struct detail {
    struct detail_desc desc;
    int size_count; // 0: no detail
    double tile_m[DETAIL_MAX_SIZES];
    struct gpu_texture noise; // RGBA8, 3D: gradient and value from -1 to 1
};

// `coarsest_m`: the largest texel of the data. TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result detail_init(struct gpu *gpu, const struct detail_desc *desc,
                                    double coarsest_m, struct detail *out);
void detail_finish(struct detail *detail);

// Whether pixels of this size on the ground show any of it.
bool detail_is_seen(const struct detail *detail, double footprint_m);

// Hands it to a program that includes terrain/detail.glsl and knows places relative to a camera
// along an anchor's axes.
void detail_bind(const struct detail *detail, const struct anchor *anchor, struct vec3 camera_m,
                 struct gpu_program *program);

#endif // TERRAIN_DETAIL_H
