// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "pace.h"

#include <math.h>
#include <stdbool.h>

static const double scales[] = {1.0, 0.71, 0.5, 0.35, 0.25};
enum { SCALE_COUNT = sizeof scales / sizeof scales[0], GOOD_FRAMES_WANTED = 10 };

static const double slow_s = 1.0 / 18.0; // more than this stutters
static const double aim_s = 1.0 / 25.0;  // what a finer step must be expected to keep

double pace_scale(const struct pace *pace)
{
    return scales[pace->step];
}

void pace_learn(struct pace *pace, double frame_s)
{
    if (frame_s > slow_s) {
        pace->good_frames = 0;
        pace->step = pace->step + 1 < SCALE_COUNT ? pace->step + 1 : pace->step;
        return;
    }
    if (pace->step == 0) {
        return;
    }
    // Time goes with the pixels at worst.
    const double ratio = scales[pace->step - 1] / scales[pace->step];
    const bool is_good = frame_s * ratio * ratio < aim_s;
    pace->good_frames = is_good ? pace->good_frames + 1 : 0;
    if (pace->good_frames == GOOD_FRAMES_WANTED) {
        pace->good_frames = 0;
        pace->step--;
    }
}

uint32_t pace_pixels(uint32_t side, double scale)
{
    const double pixels = floor((double)side * scale + 0.5);
    return pixels < 1.0 ? 1 : (uint32_t)pixels;
}
