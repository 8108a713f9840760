// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_IMAGE_FRAME_CHECK_H
#define TESTS_IMAGE_FRAME_CHECK_H
// A model's frames against the radiances that the CPU finds for the same pixels of a bare sphere.
// Reported per view: difference of the colours in linear sRGB, relative to the largest component of
// the CPU's. Failing views leave got, expected and difference as pictures in the working folder.

#include "scatter/bands.h"
#include "scatter/query.h"
#include <terrella/terrella.h>

#include <stdint.h>

struct frame_check {
    trl_context *ctx;
    const trl_scene *scene;
    trl_renderer *renderer;
    const char *name; // begins the names of the pictures of a failure
    uint32_t width, height;
    double median_limit;
    double most_limit; // one pixel in twenty may be worse
    // Colour of one direction by the CPU, in linear sRGB, cd/m2.
    void (*expect)(const void *model, const struct query_view *view, float rgb[3]);
    const void *model;
};

void frame_check_view(const struct frame_check *c, const char *name, const trl_view *view);

// The view of that name in the scene.
void frame_check_named(const struct frame_check *c, const char *name);

// "ground", "sunset", "twilight", "limb" and "full-disc" of the scene, and one from an aircraft.
void frame_check_all(const struct frame_check *c);

// Poles, underground, the top of the air, far outside, at every height of the star: no pixel that
// is no number. Red light may have negative blue.
void frame_check_finite(trl_renderer *renderer);

// Draws without exposure into `rgba` of width * height * 4 floats.
void frame_check_draw(trl_renderer *renderer, const trl_view *view, uint32_t width, uint32_t height,
                      float *rgba);

// The colour of a spectrum of radiances by all wavelengths.
void frame_check_colour(const struct band_fit *exact, const lanes *radiance, float rgb[3]);

int compare_floats(const void *a, const void *b);

#endif // TESTS_IMAGE_FRAME_CHECK_H
