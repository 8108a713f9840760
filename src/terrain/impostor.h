// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_IMPOSTOR_H
#define TERRAIN_IMPOSTOR_H
// What stands for the planet where its relief is far below a pixel (PGM, Section 4): no mesh, but a
// ray for each of the few pixels, to a sphere through the height that it finds.

#include "gpu/target.h"
#include "terrain/height_programs.h"
#include "terrain/sampling_camera.h"

struct impostor {
    const struct surface *surface;
    struct height_programs programs;
};

// Whether nobody would see that it is one, and it is cheaper than `pixels` pixels.
bool impostor_is_enough(const struct impostor *impostor, const struct sampling_camera *sampling,
                        double pixel_rad, double pixels);

// TRL_ERROR_GPU; TRL_ERROR_MEMORY. Must not outlive the surface.
TRL_MUST_USE trl_result impostor_init(const struct surface *surface, struct impostor *out);
void impostor_finish(struct impostor *impostor);

struct impostor_view {
    const struct camera *camera;
    const struct sampling_camera *sampling; // made for it
};

// As mesher_draw.
TRL_MUST_USE trl_result impostor_draw(struct impostor *impostor, const struct impostor_view *view,
                                      const struct gpu_target *target);

#endif // TERRAIN_IMPOSTOR_H
