// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef VIEWER_PACE_H
#define VIEWER_PACE_H
// At which part of the window's size a frame is drawn, so that moving stays fluent on slow
// machines: a few fixed steps while moving, all pixels when still. No window and no OpenGL here.

#include <stdint.h>

struct pace {
    int step;        // index of the scale while moving
    int good_frames; // in a row that would have allowed a finer one
};

// Part of the window's width and height for the next moving frame.
double pace_scale(const struct pace *pace);

// Learns from the time that a moving frame took.
void pace_learn(struct pace *pace, double frame_s);

// A side of the window at a scale; at least 1.
uint32_t pace_pixels(uint32_t side, double scale);

#endif // VIEWER_PACE_H
