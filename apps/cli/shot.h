// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_SHOT_H
#define CLI_SHOT_H
// One view drawn by one model: the picture, and the light that it was made of.

#include "app.h"

struct shot {
    uint32_t width, height;
    uint8_t *picture; // owned; 8-bit sRGB, RGBA, rows from the top
    float *radiance;  // owned; linear sRGB primaries in cd m^-2, RGBA, rows from the top
    double ev100;     // with which it was exposed, without the view's bias
};

struct shot_desc {
    trl_renderer *renderer;
    const trl_view *view;
    trl_sky_model model;
    struct number_size size;
    uint32_t samples; // drawn samples x samples as large and averaged
};

// Draws and reads. On failure, which is reported, the shot is empty.
trl_result shot_take(const struct shot_desc *desc, struct shot *out);
void shot_finish(struct shot *shot);

#endif // CLI_SHOT_H
