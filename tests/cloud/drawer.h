// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_CLOUD_DRAWER_H
#define TESTS_CLOUD_DRAWER_H
// Small pictures of clouds over a bare sphere with thin air.

#include "../frame/fixture.h"
#include <terrella/renderer.h>

enum { WIDTH = 48, HEIGHT = 32, FLOATS = 4 * WIDTH * HEIGHT };
static const double DEGREE = 3.14159265358979323846 / 180;

#define LAYERS(text) ", \"clouds\": {\"layers\": [" text "]}"

// Northward, with the star 40 degrees high there.
trl_view look(double altitude_m, double pitch_deg);

// A scene with that text of clouds, and what draws it.
struct drawer {
    trl_scene *scene;
    trl_renderer *renderer;
};

struct drawer make_drawer(struct fixture *f, const char *clouds);
// Of a whole scene.
struct drawer make_scene_drawer(struct fixture *f, const char *text);
void finish_drawer(struct drawer *d);

// Radiance, top row first, of WIDTH x HEIGHT pixels or as many times that each way; free() it.
float *draw(const struct drawer *d, const trl_view *view);
float *draw_larger(const struct drawer *d, const trl_view *view, int times);

#endif // TESTS_CLOUD_DRAWER_H
