// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_DEVELOP_H
#define FRAME_DEVELOP_H
// Exposure and tone without OpenGL: the same picture as exposure.h and tone.h make, but for
// rounding.

#include <terrella/scene.h>

// Linear sRGB in cd m^-2, top row first, 4 floats a pixel.
struct develop_source {
    const float *radiance;
    uint32_t width, height;
    double wall_cd_m2; // luminance of a white wall that faces the star
};

// EV100 that the meter finds.
double develop_meter(const struct develop_source *source);

// Writes width x height x 4 bytes of sRGB, top row first, alpha 255, with the view's exposure and
// curve.
void develop_picture(const struct develop_source *source, const trl_view *view, uint8_t *rgba);

#endif // FRAME_DEVELOP_H
