// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_REPORT_H
#define CLI_REPORT_H
// How the program ends and what it says when it fails: one line on standard error, once.

#include <terrella/base.h>

enum exit_status {
    EXIT_OK = 0, // what was asked for is done
    EXIT_FAILED =
        1,         // the world failed: a file, memory, the GL driver; or a scene or raster is wrong
    EXIT_USAGE = 2 // the command line is wrong
};

// Prints "terrella: error: …" and returns the status given.
__attribute__((format(printf, 2, 3))) enum exit_status report_error(enum exit_status status,
                                                                    const char *format, ...);

// The status for a failed call of the library, which has said what is wrong through the log.
enum exit_status report_result(trl_result result);

// Of `count` names the one that a mistyped word most likely means, or NULL when none is near.
const char *report_nearest(const char *word, const char *const *names, size_t count);

#endif // CLI_REPORT_H
