// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "common_options.h"

static const double paths_max = 1e12;
static const double seed_max = 9007199254740992; // whole numbers end there

struct option option_quiet(bool *target)
{
    return (struct option){.name = "quiet",
                           .letter = 'q',
                           .kind = OPTION_FLAG,
                           .target.flag = target,
                           .help = "No progress line."};
}

struct option option_output(const char **target)
{
    return (struct option){.name = "output",
                           .letter = 'o',
                           .kind = OPTION_TEXT,
                           .target.text = target,
                           .metavar = "FILE",
                           .help = "Where to write. Default: standard output."};
}

struct option option_paths(struct option_number *target, double least, const char *help)
{
    return (struct option){.name = "paths",
                           .kind = OPTION_NUMBER,
                           .target.number = target,
                           .metavar = "N",
                           .range = {least, paths_max},
                           .is_whole = true,
                           .help = help};
}

struct option option_seed(struct option_number *target, const char *help)
{
    return (struct option){.name = "seed",
                           .kind = OPTION_NUMBER,
                           .target.number = target,
                           .metavar = "N",
                           .range = {0, seed_max},
                           .is_whole = true,
                           .help = help};
}
