// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_COMMON_OPTIONS_H
#define CLI_COMMON_OPTIONS_H
// Options that mean the same in several commands.

#include "options.h"

struct option option_quiet(bool *target);

// Where text is written.
struct option option_output(const char **target);

// Of a path tracer: paths for each number, at least `least`, and where their random numbers start.
struct option option_paths(struct option_number *target, double least, const char *help);
struct option option_seed(struct option_number *target, const char *help);

#endif // CLI_COMMON_OPTIONS_H
