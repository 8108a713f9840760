// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_DATA_OPTIONS_H
#define CLI_DATA_OPTIONS_H
// The options about where rasters may come from and what they may take; of every command that reads
// scenes.

#include "options.h"

#define DATA_OPTIONS_HEADING "Data"
enum { DATA_OPTIONS = 2 };

struct data_choice {
    bool allows_remote;
    struct option_number memory_mb;
};

void data_options_make(struct data_choice *choice, struct option out[DATA_OPTIONS]);

#endif // CLI_DATA_OPTIONS_H
