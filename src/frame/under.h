// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_UNDER_H
#define FRAME_UNDER_H
// Pictures of eyes under water (shaders/sky/spectral/under.frag): the surface from below, the bed,
// and the light of the water before them. Nothing of it is made before an eye goes under.

#include "frame/ground.h"
#include "frame/sea.h"
#include "frame/under_light.h"
#include "gpu/program.h"
#include "gpu/texture.h"

struct under {
    struct gpu *gpu;
    const struct trl_scene *scene;
    const struct frame_sea *sea;
    struct ground *ground;
    struct under_columns columns;
    struct under_light_maps *maps; // owned
    struct gpu_program program;
    struct gpu_texture light, scatter;
    const struct bands *bands; // of the textures, and what else they are made for:
    struct under_place place;
};

// All that it points to must outlive it.
void under_init(struct gpu *gpu, const struct trl_scene *scene, const struct frame_sea *sea,
                struct ground *ground, struct under *out);
void under_finish(struct under *under);
// The sky's bands are others, or of another sky.
void under_forget(struct under *under);

// Where the eye is: how deep, how deep the bed is there, and how that slopes.
struct under_eye {
    double depth_m, bed_m;
    struct vec3 slope; // by how much it is deeper for a way in a direction
};
// False where the camera is not under water, or this sky has nothing to draw it with.
bool under_find(const struct under *under, const struct sky *sky, const struct camera *camera,
                double time_s, struct under_eye *out);

// After the sky was prepared for the view. Draws all pixels.
// TRL_ERROR_MEMORY, TRL_ERROR_GPU.
TRL_MUST_USE trl_result under_draw(struct under *under, const struct sky *sky,
                                   const struct sky_view *view, const struct under_eye *eye,
                                   double time_s);

#endif // FRAME_UNDER_H
