// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_VALIDATE_H
#define CLI_VALIDATE_H
// The models of the sky against the path tracer: what is asked, what was answered, how it is
// judged. docs/testing.md says what the numbers mean.

#include "app.h"
#include "bench_machine.h"
#include "cloud_check.h"
#include "judge.h"
#include "shot.h"

#include <stdio.h>

enum {
    VALIDATE_MODELS = 3, // that are judged: all before TRL_SKY_REFERENCE
    VALIDATE_DIRECTIONS = 6,
    VALIDATE_WAVELENGTHS = 3,
    VALIDATE_VALUES = VALIDATE_DIRECTIONS * VALIDATE_WAVELENGTHS,
    VALIDATE_PLACES = 3, // ground, 10 km, orbit
    VALIDATE_SUNS = 5,
    VALIDATE_CASES = VALIDATE_PLACES * VALIDATE_SUNS,
    VALIDATE_ROWS = 128, // of a picture, at most
    VALIDATE_MAX_SCENES = OPTIONS_MAX_POSITIONALS
};

// Rows of a picture, from the top: what its middle third shows in the mean.
struct validate_profile {
    int rows;                                              // 0: there is none
    double luminance[VALIDATE_ROWS], error[VALIDATE_ROWS]; // cd m^-2
};

// As they stand on the page; owned texts, NULL where there is none.
struct validate_pictures {
    char *picture, *map; // "data:image/png;base64,…"
    struct validate_profile profile;
    double mean, mean_noise; // signed difference of luminance, pixel by pixel, and standard error
};

struct validate_answer {
    bool is_there; // the model has an answer for this scene
    double radiance[VALIDATE_VALUES];
    struct judgement judgement;
    double frame_ms; // of one picture; 0: none was drawn
    struct validate_pictures pictures;
};

// One view: an observer under one sun.
struct validate_case {
    const char *place; // "ground"
    double altitude_m, sun_elevation_deg;
    trl_sky_query queries[VALIDATE_VALUES]; // direction by direction, wavelengths fastest
    int count;                              // of the queries in use
    double reference[VALIDATE_VALUES], error[VALIDATE_VALUES]; // and its standard error
    double paths[VALIDATE_VALUES];                             // so far
    double traced_s, traced_paths;                             // wall clock, and for how many
    struct validate_pictures traced;                           // without a map
    uint32_t traced_width;                                     // of the picture, in pixels
    double traced_pixel_paths;
    double pitch_rad, vertical_fov_rad; // of the pictures
    struct validate_answer answers[VALIDATE_MODELS];
};

struct validate_scene {
    const char *path;
    trl_scene *scene; // owned; without its surface
    struct validate_case cases[VALIDATE_CASES];
    int case_count;
    double solve_s[VALIDATE_MODELS];    // for all numbers of a model
    char refusal[VALIDATE_MODELS][200]; // why a model has no answer
};

// Clouds are compared where the scenes are those that ship, and there are pictures. Owned texts.
struct validate_cloud_look {
    char *drawn, *traced, *map;
    struct cloud_figures figures;
};

struct validate_clouds {
    uint64_t paths; // of a pixel; 0: none were compared
    struct validate_cloud_look looks[CLOUD_LOOKS];
};

struct validate {
    struct app *app;
    struct bench_machine machine;
    bool is_quick;
    bool wants_pictures;
    double paths;    // of each value; 0: as many as there is time for
    double budget_s; // of the whole run
    struct validate_scene scenes[VALIDATE_MAX_SCENES];
    int scene_count;
    bool is_shipped; // the scenes are
    struct validate_clouds clouds;
    double spent_s;
    uint64_t rounds; // of tracing so far: each has a seed of its own
};

// Loads, without the surface: all models then see the sphere that the path tracer sees. Errors are
// reported.
enum exit_status validate_load(struct validate *v, const char *path);
void validate_finish(struct validate *v);

// The scenes that ship with the program.
enum exit_status validate_load_shipped(struct validate *v);

// Numbers by the models.
enum exit_status validate_ask_models(struct validate *v);
// A few paths of each value by the path tracer, so that noise and costs are known.
enum exit_status validate_probe(struct validate *v);
// Pictures by the models and the path tracer, and how they differ.
enum exit_status validate_draw(struct validate *v);
// A field of cumulus, drawn and traced, unless there is too little time.
enum exit_status validate_check_clouds(struct validate *v);
// Numbers by the path tracer, within the time that is left.
enum exit_status validate_trace(struct validate *v);

// Seconds since the start.
double validate_spent_s(const struct validate *v);
// Relative standard error of value `index` if it had one path. 0: black, whatever is traced.
double validate_path_noise(const struct validate_case *c, int index);
// Wall clock of one path of one value.
double validate_path_cost_s(const struct validate_case *c);
// Wall clock after which the view's mean would be decided, as far as its noise is known.
double validate_missing_s(const struct validate_case *c);
// False: noise is so large that errors tell nothing, and are not shown.
bool validate_is_telling(const struct validate_case *c);
// Compares; afterwards every answer has its judgement.
void validate_judge(struct validate *v);

// Paths of a value, in the mean of the view.
double validate_mean_paths(const struct validate_case *c);

// How all views of a scene together, or of all scenes (NULL), look for a model.
struct validate_total {
    int views, good, mean_only, noisy, bad;
    int known; // views whose noise is known, see JUDGE_KNOWN_NOISE; the next four are theirs
    double signed_mean; // of all values
    double variance;    // sum over the views of those of their signed means
    double mean;        // of the views' means
    double largest;     // of all values
    double path_count;  // of all values together
};
struct validate_total validate_sum(const struct validate *v, const struct validate_scene *scene,
                                   int model);

void validate_print_table(const struct validate *v);
enum exit_status validate_print_json(const struct validate *v);
enum exit_status validate_write_html(const struct validate *v, const char *path);
// The page's part about clouds.
void validate_write_clouds(FILE *page, const struct validate *v);

#endif // CLI_VALIDATE_H
