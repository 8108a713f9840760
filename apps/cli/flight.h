// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_FLIGHT_H
#define CLI_FLIGHT_H
// A flight through views of a scene, frame by frame, into numbered pictures or a video.

#include "film.h"
#include "view_options.h"

struct flight_arguments {
    const char *to; // names of views between commas; NULL: no flight
    struct option_number seconds, fps;
};

// Their options, for the table of a command.
enum { FLIGHT_OPTIONS = 3 };
void flight_make_options(struct flight_arguments *arguments, struct option out[FLIGHT_OPTIONS]);

// EXIT_USAGE (reported) when there are options of a flight without one.
enum exit_status flight_check(const struct flight_arguments *arguments);

struct flight_desc {
    struct app *app;
    const trl_scene *scene;
    trl_renderer *renderer; // of that scene
    const struct flight_arguments *arguments;
    const struct view_choice *choice; // where it starts; sun and exposure of all its views
    struct film *film;
    uint32_t samples; // drawn samples x samples as large and averaged
};

// Frames of the flight, per second and in all.
double flight_fps(const struct flight_arguments *arguments);
uint32_t flight_frame_count(const struct flight_arguments *arguments);

// Draws all frames into the film. Failures are reported.
enum exit_status flight_draw(const struct flight_desc *desc);

#endif // CLI_FLIGHT_H
