// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_RELIEF_H
#define FRAME_RELIEF_H
// The ground of a scene as the path tracer asks for it: on the CPU, without OpenGL.

#include "frame/sea.h"
#include "reference/surface.h"
#include "scene/scene.h"
#include "terrain/ceiling.h"

struct relief {
    bool is_bare; // no rasters: the path tracer's own sphere
    struct surface surface;
    struct terrain_ceiling ceiling;
    double lights_cd_m2;
    struct frame_sea sea;
};

// Reads the rasters of a scene, which must outlive the relief. As surface_init_on_cpu.
TRL_MUST_USE trl_result relief_init(const trl_context *ctx, const struct trl_scene *scene,
                                    struct relief *out);
// The same without colours and lights: look() tells the normal only.
TRL_MUST_USE trl_result relief_init_heights(const trl_context *ctx, const struct trl_scene *scene,
                                            struct relief *out);
void relief_finish(struct relief *relief);

// As surface_water_depth_m.
double relief_water_depth_m(const struct relief *relief, double latitude_rad, double longitude_rad);
double relief_altitude_m(const struct relief *relief, double latitude_rad, double longitude_rad);

// The water around an eye; of this ocean, which must outlive it.
struct reference_under relief_under(const struct relief *relief, const struct ocean_desc *ocean,
                                    struct vec3 eye_m);

// Must not outlive the relief.
struct reference_surface relief_surface(const struct relief *relief);

#endif // FRAME_RELIEF_H
