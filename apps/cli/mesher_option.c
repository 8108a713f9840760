// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "mesher_option.h"

struct mesher_option mesher_option_default(void)
{
    struct mesher_option option = {.mesher = -1};
    for (int i = 0; i < MESHER_OPTION_WORDS && trl_mesher_name((trl_mesher)i); i++) {
        option.words[i] = trl_mesher_name((trl_mesher)i);
    }
    return option;
}

struct option mesher_option_make(struct mesher_option *target, const char *help)
{
    return (struct option){.name = "mesher",
                           .kind = OPTION_CHOICE,
                           .target.choice = &target->mesher,
                           .choices = target->words,
                           .metavar = "NAME",
                           .help = help};
}

trl_mesher mesher_option_get(const struct mesher_option *option)
{
    return option->mesher < 0 ? trl_renderer_desc_default().mesher : (trl_mesher)option->mesher;
}
