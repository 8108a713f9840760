// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_VIEW_OPTIONS_H
#define CLI_VIEW_OPTIONS_H
// The options with which a picture's camera, sun and exposure are chosen: a view of the scene, and
// what replaces parts of it. Shared by the commands that draw.

#include "data_options.h"
#include "mesher_option.h"
#include "rayleigh_options.h"
#include <terrella/renderer.h>

// What was given; start from view_choice_default().
struct view_choice {
    const char *name; // NULL: the scene's first view
    struct option_number latitude_deg, longitude_deg, altitude_m, height_m;
    struct option_number heading_deg, pitch_deg, roll_deg, fov_deg;
    struct option_number sun_elevation_deg, sun_azimuth_deg;
    struct option_number subsolar_latitude_deg, subsolar_longitude_deg;
    struct option_number ev100, bias_ev;
    int tone;      // index of the word; -1: as in the view
    int air;       // a trl_air
    int sky_model; // a trl_sky_model; TRL_SKY_MODEL_OF_SCENE when it was not given
    struct mesher_option mesher;
    struct rayleigh_choice rayleigh;
    struct data_choice data;
};

struct view_choice view_choice_default(void);

// A command that draws one scene.
struct view_command {
    const char *name, *about, *examples; // see option_spec
    struct option_section own;           // its own options; those of a view follow
    const char **scene;                  // becomes the file given
    struct view_choice *choice;          // becomes what was given of a view
};
enum options_outcome view_command_read(const struct view_command *command, int argc, char **argv);

// The scene's view of that name with what was given on the command line. EXIT_USAGE (reported) when
// there is no such view or the options contradict each other.
enum exit_status view_choice_apply(const struct view_choice *choice, const trl_scene *scene,
                                   trl_view *out);

#endif // CLI_VIEW_OPTIONS_H
