// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_MESHER_OPTION_H
#define CLI_MESHER_OPTION_H
// --mesher, which has as many words as the library has meshers.

#include "options.h"

enum { MESHER_OPTION_WORDS = 16 };

struct mesher_option {
    int mesher; // a trl_mesher; -1 when it was not given
    const char *words[MESHER_OPTION_WORDS + 1];
};

// The words, and nothing given.
struct mesher_option mesher_option_default(void);

// The option, which writes to `target`. `help` says what the default is.
struct option mesher_option_make(struct mesher_option *target, const char *help);

// The mesher that was given, or the library's default.
trl_mesher mesher_option_get(const struct mesher_option *option);

#endif // CLI_MESHER_OPTION_H
