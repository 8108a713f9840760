// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "progress.h"

#include "interrupt.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static const double terminal_interval_s = 0.1;
static const double plain_interval_s = 10.0; // also how long work may be without a word
static const double estimate_after_s = 1.0;  // earlier guesses of the time left are poor

double progress_clock_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void progress_begin(struct progress *progress, bool is_quiet)
{
    const double now = progress_clock_s();
    *progress = (struct progress){.is_quiet = is_quiet,
                                  .is_terminal = isatty(STDERR_FILENO) == 1,
                                  .started_s = now,
                                  .stage_started_s = now,
                                  .last_shown_s = now};
}

void progress_clear(struct progress *progress)
{
    if (progress->is_line_shown) {
        fprintf(stderr, "\r\033[K");
        progress->is_line_shown = false;
    }
}

static void print_line(struct progress *progress, double fraction, double now)
{
    const double spent_s = now - progress->stage_started_s;
    char left[40] = "";
    if (spent_s > estimate_after_s && fraction > 0.0 && fraction < 1.0) {
        snprintf(left, sizeof left, ", %.0f s left", ceil(spent_s * (1.0 - fraction) / fraction));
    }
    progress_clear(progress);
    fprintf(stderr, "terrella: %s: %.0f %%%s%s", progress->stage, 100.0 * fraction, left,
            progress->is_terminal ? "" : "\n");
    fflush(stderr);
    progress->is_line_shown = progress->is_terminal;
}

void progress_set_part(struct progress *progress, const char *name, double begin, double end)
{
    progress->is_part = end > 0;
    progress->part_begin = begin;
    progress->part_end = end;
    if (progress->is_part) {
        snprintf(progress->stage, sizeof progress->stage, "%s", name);
        progress->stage_started_s = progress->started_s;
    } else {
        progress->stage[0] = '\0';
    }
}

bool progress_report(void *user, const char *stage, double fraction)
{
    struct progress *progress = user;
    if (progress->is_part) {
        stage = progress->stage;
        fraction = progress->part_begin + (progress->part_end - progress->part_begin) * fraction;
    }
    if (interrupt_is_pending()) {
        return false;
    }
    const double now = progress_clock_s();
    if (strncmp(stage, progress->stage, sizeof progress->stage - 1) != 0) {
        snprintf(progress->stage, sizeof progress->stage, "%s", stage);
        progress->stage_started_s = now;
    }
    const double interval_s = progress->is_terminal ? terminal_interval_s : plain_interval_s;
    if (!progress->is_quiet && now - progress->last_shown_s >= interval_s) {
        progress->last_shown_s = now;
        print_line(progress, fraction, now);
    }
    return true;
}
