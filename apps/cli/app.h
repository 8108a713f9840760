// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_APP_H
#define CLI_APP_H
// What every command that works with the library needs: a context that logs and shows progress, and
// an end when the user presses Ctrl-C.

#include "data_options.h"
#include "progress.h"
#include <terrella/terrella.h>

struct app {
    trl_context *ctx;
    struct progress progress;
    bool holds_errors;
    char held_error[512]; // the last one
};

// What differs between commands.
struct app_desc {
    bool is_quiet;
    bool is_uncached;               // neither reads nor keeps solved tables
    bool holds_errors;              // errors go to held_error instead of standard error
    const struct data_choice *data; // NULL: none given
};

// Makes the context and arms Ctrl-C. `app` must stay where it is until app_finish. EXIT_FAILED is
// reported.
enum exit_status app_init(struct app *app, const struct app_desc *desc);
void app_finish(struct app *app);

// The path of a scene that ships with the program, in the source tree that it was built from or
// where it was installed. NULL when it is in neither; else free() it.
char *app_find_scene(const char *file);

#endif // CLI_APP_H
