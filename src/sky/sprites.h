// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SPRITES_H
#define SKY_SPRITES_H
// Points of light, added to a picture in one draw. The light of each is spread over a few pixels by
// a kernel whose samples sum to 1 wherever the point is between them (quadratic B-spline), so it
// keeps its light in any size of picture and does not flicker as it moves. Hidden by the planet and
// terrain through the kinds of pixels.

#include "base/camera.h"
#include "gpu/pass.h"
#include "spectrum/cie.h"

// What is drawn of one, as star.vert reads it.
struct sprite {
    float centre_px[2]; // from the lower left corner
    float light[3];     // linear sRGB, cd m^-2 if all of it were in one pixel
    float halo;         // share that goes into the wide part of the spread
};

struct sprites {
    const trl_context *ctx;
    struct gpu *gpu;
    size_t count, capacity;
    struct sprite *sprites; // owned, of one frame
    struct gpu_program program;
    struct gpu_mesh mesh;
};

// TRL_ERROR_MEMORY, TRL_ERROR_GPU.
TRL_MUST_USE trl_result sprites_init(struct gpu *gpu, size_t capacity, struct sprites *out);
void sprites_finish(struct sprites *sprites);

// The picture, in any axes.
struct sprite_frame {
    struct vec3 right, up, forward;
    double tan_half_x, tan_half_y; // of the picture
    double margin_x, margin_y;     // how far outside points still reach in, relative to half of it
    double width_px, height_px;
};
struct sprite_frame sprite_frame_make(const struct camera *camera, const struct gpu_target *target);

// Where a point is in it.
struct sprite_place {
    double along; // cosine of the angle to the axis
    float centre_px[2];
};

// False when nothing of it can be seen.
bool sprite_find(const struct sprite_frame *frame, struct vec3 direction, struct sprite_place *out);

// Adds a point of that illuminance, lx in linear sRGB. Not more than the capacity.
void sprites_add(struct sprites *sprites, const struct sprite_frame *frame,
                 const struct sprite_place *place, struct cie_rgb light_lx);

// Draws what was added, and forgets it. The target has the kinds of sort.frag as its depth.
TRL_MUST_USE trl_result sprites_draw(struct sprites *sprites, const struct gpu_target *target);

#endif // SKY_SPRITES_H
