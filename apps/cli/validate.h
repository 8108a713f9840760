// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_VALIDATE_H
#define CLI_VALIDATE_H
// The models of the sky against the path tracer: what is asked, what was answered, how it is
// judged. docs/testing.md says what the numbers mean.

#include "app.h"
#include "bench_machine.h"
#include "judge.h"
#include "shot.h"

enum {
    VALIDATE_MODELS = 3, // that are judged: all before TRL_SKY_REFERENCE
    VALIDATE_DIRECTIONS = 6,
    VALIDATE_WAVELENGTHS = 3,
    VALIDATE_VALUES = VALIDATE_DIRECTIONS * VALIDATE_WAVELENGTHS,
    VALIDATE_PLACES = 3, // ground, 10 km, orbit
    VALIDATE_SUNS = 5,
    VALIDATE_CASES = VALIDATE_PLACES * VALIDATE_SUNS,
    VALIDATE_MAX_SCENES = OPTIONS_MAX_POSITIONALS
};

// Picture and map as they stand on the page; owned texts, NULL where there is none.
struct validate_pictures {
    char *picture, *map; // "data:image/png;base64,…"
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
    double paths;                                              // of each value, so far
    double traced_s;                                           // wall clock
    double map_range;
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

struct validate {
    struct app *app;
    struct bench_machine machine;
    bool is_quick;
    bool wants_pictures;
    double paths;    // of each value; 0: as many as there is time for
    double budget_s; // of the whole run
    struct validate_scene scenes[VALIDATE_MAX_SCENES];
    int scene_count;
    double spent_s;
};

// Loads, without the surface: all models then see the sphere that the path tracer sees. Errors are
// reported.
enum exit_status validate_load(struct validate *v, const char *path);
void validate_finish(struct validate *v);

// The scenes that ship with the program.
enum exit_status validate_load_shipped(struct validate *v);

// Numbers and pictures by the models.
enum exit_status validate_ask_models(struct validate *v);
// Numbers by the path tracer, within the time that is left.
enum exit_status validate_trace(struct validate *v);
// Compares; afterwards every answer has its judgement.
void validate_judge(struct validate *v);

// How all views of a scene together, or of all scenes (NULL), look for a model.
struct validate_total {
    int views, bad, noisy;
    double mean;    // of the views' means
    double largest; // of all values
    double noise;   // mean standard error, relative
};
struct validate_total validate_sum(const struct validate *v, const struct validate_scene *scene,
                                   int model);

void validate_print_table(const struct validate *v);
enum exit_status validate_print_json(const struct validate *v);
enum exit_status validate_write_html(const struct validate *v, const char *path);

#endif // CLI_VALIDATE_H
