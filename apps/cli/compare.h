// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_COMPARE_H
#define CLI_COMPARE_H
// One picture of one view by several models of the sky: the models side by side, below them how the
// others differ from the first.

#include "shot.h"

#include <stdio.h>

enum { COMPARE_MAX_MODELS = 4 };

struct compare_models {
    trl_sky_model models[COMPARE_MAX_MODELS];
    int count;
};

// Words between commas, at least two, each once. EXIT_USAGE is reported.
enum exit_status compare_models_parse(const char *text, struct compare_models *out);

struct compare_desc {
    struct app *app;
    const trl_scene *scene;
    const trl_view *view;
    const char *view_name;
    struct compare_models models;
    trl_rayleigh_desc rayleigh;
    trl_mesher mesher;
    trl_projective_desc projective;
    double mesh_error_px;
    struct number_size size; // of each model's picture
    uint32_t samples;
    const char *output;
    bool is_exr; // radiance and shares without words, instead of pictures
};

// Draws all with the first one's exposure and writes the sheet. `summary`, unless NULL, gets a line
// for each model but the first. Errors are reported.
trl_result compare_write(const struct compare_desc *desc, FILE *summary);

// Size of the sheet.
struct number_size compare_sheet_size(const struct compare_desc *desc);

#endif // CLI_COMPARE_H
