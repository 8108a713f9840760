// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_PICTURE_H
#define REFERENCE_PICTURE_H
// A whole picture by the path tracer.

#include "base/camera.h"
#include "reference/tracer.h"

struct reference_picture {
    const struct camera *camera;
    uint32_t width, height;
    uint64_t paths; // a pixel; rounded up to what reference_picture_paths says
    uint64_t seed;
    int max_order;      // 0: all
    double pixel_width; // of the square that the paths of a pixel spread over, in pixels
};

// At least two for each group of wavelengths, and as many for each.
uint64_t reference_picture_paths(uint64_t wanted);

// What is written: linear sRGB in cd m^-2 and its standard error, alpha 1, top row first;
// width x height x 4 each.
struct reference_sheets {
    float *rgba, *error; // error may be NULL
};

// The numbers depend on the seed, not on the number of threads. TRL_OK, TRL_ERROR_MEMORY,
// TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result reference_picture_trace(const trl_context *ctx,
                                                const struct reference_scene *scene,
                                                const struct reference_picture *picture,
                                                const struct reference_sheets *sheets);

#endif // REFERENCE_PICTURE_H
