// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_HEIGHT_PROGRAMS_H
#define TERRAIN_HEIGHT_PROGRAMS_H
// A fragment pass that asks for heights, as one program for each number of elevation layers that it
// looks at: what is out of sight costs nothing.

#include "terrain/surface.h"

struct height_programs {
    const struct surface *surface;
    struct gpu_program of[SURFACE_SEEN_LAYERS + 1];
};

// `fragment` includes terrain/layers.glsl. TRL_ERROR_GPU; TRL_ERROR_MEMORY. Must not outlive the
// surface.
TRL_MUST_USE trl_result height_programs_init(const struct surface *surface, const char *fragment,
                                             struct height_programs *out);
void height_programs_finish(struct height_programs *programs);

// The program for what is seen from `eye`, with the layers as they lie around the anchor.
struct gpu_program *height_programs_bind(struct height_programs *programs,
                                         const struct surface_eye *eye,
                                         const struct anchor *anchor);

#endif // TERRAIN_HEIGHT_PROGRAMS_H
