// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_RAYLEIGH_OPTIONS_H
#define CLI_RAYLEIGH_OPTIONS_H
// How the sky model rayleigh works, on the command line: what is given replaces parts of what the
// scene says. Shared by the commands that can use the model.

#include "app.h"
#include "options.h"
#include <terrella/scene.h>

// What was given; start from rayleigh_choice_default().
struct rayleigh_choice {
    struct option_number samples, wavelengths, height_scale;
    int optical_depth;  // a trl_rayleigh_depth; -1: as in the scene
    int out_scattering; // 0: on, 1: off; -1: as in the scene
};

struct rayleigh_choice rayleigh_choice_default(void);

enum { RAYLEIGH_OPTIONS = 5 };
void rayleigh_options_make(struct rayleigh_choice *choice, struct option out[RAYLEIGH_OPTIONS]);

#define RAYLEIGH_OPTIONS_HEADING "Sky model rayleigh"

// EXIT_USAGE (reported) for an even number of samples.
enum exit_status rayleigh_choice_check(const struct rayleigh_choice *choice);

// The scene's options with what was given.
trl_rayleigh_desc rayleigh_choice_resolve(const struct rayleigh_choice *choice,
                                          const trl_scene *scene);

#endif // CLI_RAYLEIGH_OPTIONS_H
