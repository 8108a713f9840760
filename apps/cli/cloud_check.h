// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_CLOUD_CHECK_H
#define CLI_CLOUD_CHECK_H
// Drawn clouds against traced ones: a field of cumulus over a bare sphere at noon, at sunset and
// against the sun, luminance pixel by pixel.

#include "cloud_judge.h"
#include "shot.h"

enum { CLOUD_LOOKS = 4, CLOUD_WIDTH = 32, CLOUD_HEIGHT = 18 };
#define CLOUD_COVER 0.5 // of the field
enum { CLOUD_PIXELS = CLOUD_WIDTH * CLOUD_HEIGHT };

// "noon, from 3 km"
const char *cloud_look_name(int look);

// A look, drawn in CLOUD_FINER times as many rows and columns, and traced twice, with half of the
// paths each. Owner: whoever made it.
enum { CLOUD_FINER = 4 };
struct cloud_check {
    trl_view view;
    struct shot drawn;
    float halves[2][CLOUD_PIXELS * 4]; // linear sRGB, cd m^-2
    float errors[2][CLOUD_PIXELS * 4]; // their standard errors
};

// `renderer` shows the scene. Failures are reported.
trl_result cloud_check_make(const struct app *app, const trl_scene *scene, trl_renderer *renderer,
                            int look, uint64_t paths, struct cloud_check *out);
void cloud_check_finish(struct cloud_check *check);

// Both halves together, as validate_sheet has it: CLOUD_PIXELS * 4 each.
void cloud_check_join(const struct cloud_check *check, float *radiance, float *error);

struct cloud_figures cloud_check_judge(const struct cloud_check *check);

#endif // CLI_CLOUD_CHECK_H
