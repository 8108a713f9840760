// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_FRAME_H
#define FRAME_FRAME_H
// One frame: which passes, in which order, into which targets. Nothing is calculated here.
//
//     ground    -> position, depth, albedo, normal, lights      src/terrain
//     sky       -> radiance: ground lit, air, sun               src/sky
//     stars     -> radiance: what is beyond the air, added      src/sky/space.h
//     clouds    -> radiance: clouds mixed in                    clouds.h
//     edges     -> radiance: silhouettes made smooth            edges.h
//     exposure  -> EV100 and factor                             exposure.h
//     tone      -> picture                                      tone.h
//
//     radiance  RGBA32F  linear sRGB, cd m^-2, finite; may be negative outside the gamut
//     picture   RGBA8    sRGB codes
//
// Rows run from the bottom to the top, as GL has them.

#include "frame/clock.h"
#include "frame/clouds.h"
#include "frame/edges.h"
#include "frame/exposure.h"
#include "frame/ground.h"
#include "frame/sea.h"
#include "frame/tone.h"
#include "frame/under.h"
#include "scene/camera.h"
#include "scene/scene.h"
#include "sky/sky.h"
#include "sky/space.h"

struct frame_desc {
    const trl_context *ctx;
    const struct trl_scene *scene; // must outlive the frame
    trl_gl gl;
    uint32_t wavelengths, orders; // see struct sky_desc
    trl_sky_model sky_model;
    trl_air air;
    struct ground_meshing meshing;
    trl_rayleigh_desc rayleigh; // checked
    bool measures_time;
    bool waits_for_rasters;
};

struct frame {
    const trl_context *ctx;
    const struct trl_scene *scene;
    struct gpu *gpu;
    struct ground ground;
    double glow_m;                // height of the bright air at the horizon
    struct medium medium;         // the scene's, with the atmosphere that was changed to; a copy
    struct sky skies[SKY_MODELS]; // by trl_sky_model; made when first asked for
    struct space space;
    struct body_desc bodies[SCENE_MAX_BODIES]; // the scene's
    struct frame_sea sea;
    struct under under;
    trl_sky_model sky_model; // that frames are drawn with
    struct sky_spheres spheres;
    trl_air air;
    uint32_t wavelengths, orders;
    trl_rayleigh_desc rayleigh;
    struct clouds clouds;
    struct edges edges;
    struct exposure exposure;
    struct tone tone;
    struct frame_clock clock;
    struct gpu_texture radiance, kinds, picture; // of the size of the last frame, or none
    struct gpu_target radiance_target, picture_target;
    bool is_drawn; // the targets hold a whole frame
};

// Opens GL, solves or loads the atmosphere, loads rasters, builds programs. *out is zeroed on
// failure.
TRL_MUST_USE trl_result frame_init(const struct frame_desc *desc, struct frame *out);
void frame_finish(struct frame *frame);

// Draws with that model from now on; makes it when it is asked for first. A failure leaves the old
// one.
TRL_MUST_USE trl_result frame_set_sky_model(struct frame *frame, trl_sky_model model);

// Goes over to the atmosphere of another medium: constituents and height.
TRL_MUST_USE trl_result frame_change_atmosphere(struct frame *frame, const struct medium *medium);

// Whether frames show it, as fine as it gets.
bool frame_is_settled(const struct frame *frame);

struct frame_request {
    const trl_view *view; // every number checked
    uint32_t width, height;
    double elapsed_s; // 0: a single frame
};
TRL_MUST_USE trl_result frame_draw(struct frame *frame, const struct frame_request *request);

// Top row first.
TRL_MUST_USE trl_result frame_read_picture(struct frame *frame, uint8_t *rgba);
TRL_MUST_USE trl_result frame_read_radiance(struct frame *frame, float *rgba);

// What a view stands on.
struct camera_place frame_place(const struct frame *frame, const trl_view *view);

#endif // FRAME_FRAME_H
