// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_VALIDATE_MAP_H
#define CLI_VALIDATE_MAP_H
// Traced pictures against drawn ones.

#include "canvas.h"
#include "validate.h"

// Radiance in linear sRGB, cd m^-2, RGBA, rows from the top. `error`: standard errors, or NULL.
struct validate_sheet {
    uint32_t width, height;
    const float *radiance, *error;
};

// Ends of the colours' steps, as shares of the traced luminance: smaller ones have the first.
enum { VALIDATE_MAP_STEPS = 5 };
extern const double validate_map_steps[VALIDATE_MAP_STEPS];
// Of a difference in step `step`, 0 to VALIDATE_MAP_STEPS; its sign chooses the hue.
struct canvas_color validate_map_color(int step, bool is_brighter);

// A traced picture and drawn ones, whose sides are whole multiples of its own.
struct validate_map {
    const struct validate_sheet *traced, *drawn;
    const struct validate_sheet *base; // by the model that all means are relative to
    double white_cd_m2;
};

// The map of what is drawn against what is traced, and the mean over all pixels without edges. A
// difference below three standard errors of its pixel counts as none, and what both show black is
// left out: 4000 times darker than white.
void validate_map_draw(const struct validate_map *map, uint8_t *rgba,
                       struct validate_pictures *out);

void validate_map_profile(const struct validate_sheet *sheet, struct validate_profile *out);

#endif // CLI_VALIDATE_MAP_H
