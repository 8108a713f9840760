// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_MESHER_OPTION_H
#define CLI_MESHER_OPTION_H
// --mesher, which has as many words as the library has meshers, --grid and --mesh-error.

#include "options.h"

enum { MESHER_OPTION_WORDS = 16 };

struct mesher_option {
    int mesher; // a trl_mesher; -1 when it was not given
    const char *words[MESHER_OPTION_WORDS + 1];
    struct number_size grid;       // of the projective mesher; width 0 when it was not given
    struct option_number error_px; // of the quadtree mesher
};

// The words, and nothing given.
struct mesher_option mesher_option_default(void);

// The option, which writes to `target`. `help` says what the default is.
struct option mesher_option_make(struct mesher_option *target, const char *help);

struct option mesher_option_make_grid(struct mesher_option *target);
struct option mesher_option_make_error(struct mesher_option *target);

// Whether the grid can be, and both options go with the mesher; EXIT_USAGE is reported. `command`
// begins the message.
enum exit_status mesher_option_check(const struct mesher_option *option, const char *command);

// The mesher that was given, or the library's default; the projective mesher's options.
trl_mesher mesher_option_get(const struct mesher_option *option);
trl_projective_desc mesher_option_get_projective(const struct mesher_option *option);
double mesher_option_get_error_px(const struct mesher_option *option);

#endif // CLI_MESHER_OPTION_H
