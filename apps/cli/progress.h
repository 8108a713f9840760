// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H
// The line that says how far the work is: on a terminal at once and in place, elsewhere only when
// the work is long, as ordinary lines far apart.

#include <terrella/context.h>

struct progress {
    bool is_quiet;
    bool is_terminal;
    bool is_line_shown; // the cursor stands behind a progress line
    double started_s;   // of the whole work
    double stage_started_s;
    double last_shown_s;
    char stage[80];
    bool is_part; // what is reported is a part of a larger work
    double part_begin, part_end;
};

// Seconds of a clock that only goes forward.
double progress_clock_s(void);

void progress_begin(struct progress *progress, bool is_quiet);

// A trl_progress_fn; `user` is the struct progress. False once the program was asked to stop.
bool progress_report(void *user, const char *stage, double fraction);

// From now on what calls report is the part of the whole work between two fractions, under this
// name; `begin` = `end` = 0 ends that.
void progress_set_part(struct progress *progress, const char *name, double begin, double end);

// Removes the line, so that something else can be printed.
void progress_clear(struct progress *progress);

#endif // CLI_PROGRESS_H
