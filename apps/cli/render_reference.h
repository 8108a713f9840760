// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_RENDER_REFERENCE_H
#define CLI_RENDER_REFERENCE_H
// A picture by the path tracer instead of OpenGL.

#include "app.h"

struct traced_arguments {
    bool is_wanted;
    struct option_number orders; // of the spectral sky too
    struct option_number paths, seed;
    const char *error; // where the standard errors go; NULL: nowhere
};

// Their options, for the table of a command.
enum { TRACED_OPTIONS = 5 };
void traced_make_options(struct traced_arguments *arguments, struct option out[TRACED_OPTIONS]);

// EXIT_USAGE (reported) when they contradict each other.
enum exit_status traced_check(const struct traced_arguments *arguments);

// Of light; 0: all.
uint32_t traced_max_orders(const struct traced_arguments *arguments);

// What is drawn, and where it goes.
struct traced_picture {
    const trl_scene *scene;
    const trl_view *view;
    struct number_size size;
    const char *output;
    bool is_exr; // else PNG
};

// Traces it and writes it.
TRL_MUST_USE trl_result traced_draw(struct app *app, const struct traced_arguments *arguments,
                                    const struct traced_picture *picture);

#endif // CLI_RENDER_REFERENCE_H
