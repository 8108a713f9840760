// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella sea: light in the water as numbers. No OpenGL is touched.
#include "app.h"
#include "commands.h"
#include "common_options.h"
#include "output.h"
#include "query_lists.h"

#include <terrella/water.h>

#include <math.h>
#include <stdlib.h>

// What a query consists of, in the order of the output's columns.
enum { DEPTH, EYE_DEPTH, SUN_ZENITH, VIEW_ZENITH, AZIMUTH, WAVELENGTH, PART_COUNT };

static const struct number_item zero = {0.0, "0"};

static const struct query_part parts[PART_COUNT] = {
    {.column = "depth_m",
     .option = "depth",
     .metavar = "LIST",
     .range = {0.0, 1e6},
     .help = "Metres of water."},
    {.column = "eye_depth_m",
     .option = "eye-depth",
     .metavar = "LIST",
     .range = {0.0, 1e6},
     .fallback = &zero,
     .help = "Metres of the eye below the surface. Default: 0, above it."},
    {.column = "sun_zenith_deg",
     .option = "sun-zenith",
     .metavar = "LIST",
     .range = {0.0, 89.99},
     .help = "Degrees from the zenith to the sun's centre, in the air: 0 overhead."},
    {.column = "view_zenith_deg",
     .option = "view-zenith",
     .metavar = "LIST",
     .range = {0.0, 180.0},
     .help = "Degrees from the zenith to the line of sight, where the eye is: 180 looks straight "
             "down. Above 90 for an eye above the water."},
    {.column = "azimuth_deg",
     .option = "azimuth",
     .metavar = "LIST",
     .range = {-360.0, 360.0},
     .fallback = &zero,
     .help = "Degrees of the line of sight from the sun's: 0 is toward the sun. Default: 0."},
    {.column = "wavelength_nm",
     .option = "wavelength",
     .metavar = "LIST",
     .range = {1.0, 1e7},
     .help = "Nanometres."},
};

enum { QUERIES_MAX = 1000000 };
static const double rad_per_deg = 3.14159265358979323846 / 180.0;

struct sea_arguments {
    const char *scene;
    struct query_lists lists;
    int solver;
    struct option_number paths, seed;
    const char *output; // NULL: standard output
    bool is_quiet;
    struct data_choice data;
};

enum { SOLVER_REFERENCE = 1 };
static const char *const solver_words[] = {"spectral", "reference", NULL};

static const char about[] =
    "Prints the light that leaves the water of a scene's ocean, or that an eye in it\n"
    "sees, as CSV: all orders of scattering between a flat surface and the bed.\n"
    "Behind the query are star_per_sr and sky_per_sr: radiance per irradiance of\n"
    "level water by the sun alone and by an even sky alone (above the water: remote-\n"
    "sensing reflectance, without what the surface mirrors; below: with the sky\n"
    "through the surface, without the sun's disc). Then the irradiances behind the\n"
    "scene's air, in W m^-2 nm^-1, and radiance_W_m2_sr_nm of both. The path tracer\n"
    "(--solver reference) adds the standard errors of the first two.\n"
    "A LIST is numbers separated by commas; from:to:step stands for a row of them.\n"
    "All combinations of the lists are answered, wavelengths running fastest.\n";
static const char examples[] =
    "  terrella sea scenes/earth.json --depth 2,4,10,100 --sun-zenith 30 \\\n"
    "      --view-zenith 180 --wavelength 400:700:20\n"
    "  terrella sea scenes/earth.json --depth 10 --eye-depth 3 --sun-zenith 30 \\\n"
    "      --view-zenith 0:180:30 --wavelength 450,550\n"
    "  terrella sea scenes/earth.json --depth 10 --sun-zenith 30 --view-zenith 180 \\\n"
    "      --wavelength 450 --solver reference --paths 1000000\n";

static enum options_outcome read_arguments(int argc, char **argv, struct sea_arguments *out)
{
    *out = (struct sea_arguments){.lists = {.command = "sea",
                                            .parts = parts,
                                            .part_count = PART_COUNT,
                                            .max_count = QUERIES_MAX,
                                            .alternative = ""}};
    struct option query[PART_COUNT];
    query_lists_make_options(&out->lists, query);
    const struct option solver[] = {
        {.name = "solver",
         .kind = OPTION_CHOICE,
         .target.choice = &out->solver,
         .choices = solver_words,
         .metavar = "NAME",
         .help = "spectral (the default) or reference (a Monte Carlo path tracer to judge it by: "
                 "slow)."},
        option_paths(&out->paths, 2,
                     "Of the path tracer for each query: four times as many halve the noise. "
                     "Default: 100000."),
        option_seed(&out->seed,
                    "Of the path tracer: the same seed gives the same numbers. Default: 0."),
    };
    const struct option result[] = {option_output(&out->output), option_quiet(&out->is_quiet)};
    struct option data[DATA_OPTIONS];
    data_options_make(&out->data, data);
    const struct option_section sections[] = {{"Query", query, PART_COUNT},
                                              {"Solver", solver, sizeof solver / sizeof *solver},
                                              {"Result", result, sizeof result / sizeof *result},
                                              {DATA_OPTIONS_HEADING, data, DATA_OPTIONS}};
    const struct option_spec spec = {.command = "sea",
                                     .positional = "SCENE",
                                     .min_positionals = 1,
                                     .max_positionals = 1,
                                     .about = about,
                                     .examples = examples,
                                     .sections = sections,
                                     .section_count = sizeof sections / sizeof *sections};
    struct option_arguments words;
    const enum options_outcome outcome = options_read(&spec, argc, argv, &words);
    out->scene = words.positionals[0];
    return outcome;
}

// The queries, each number as it was given, and the answers.
struct work {
    size_t count;
    trl_water_query *queries;         // owned
    const char *(*texts)[PART_COUNT]; // owned; the strings are not
    trl_water_light *lights;          // owned
};

static void finish_work(struct work *work)
{
    free(work->queries);
    free(work->texts);
    free(work->lights);
}

static enum exit_status begin_work(const struct sea_arguments *arguments, struct work *out)
{
    const enum exit_status status = query_lists_count(&arguments->lists, &out->count);
    if (status != EXIT_OK) {
        return status;
    }
    if (out->count > QUERIES_MAX) {
        return report_error(EXIT_USAGE, "sea: these are more than %d queries", QUERIES_MAX);
    }
    out->queries = calloc(out->count, sizeof *out->queries);
    out->texts = calloc(out->count, sizeof *out->texts);
    out->lights = calloc(out->count, sizeof *out->lights);
    return out->queries && out->texts && out->lights
               ? EXIT_OK
               : report_error(EXIT_FAILED, "sea: no memory for %zu queries", out->count);
}

static void combine_lists(const struct sea_arguments *arguments, struct work *work)
{
    for (size_t q = 0; q < work->count; q++) {
        double values[PART_COUNT];
        query_lists_get(&arguments->lists, q, values, work->texts[q]);
        work->queries[q] = (trl_water_query){.depth_m = values[DEPTH],
                                             .eye_depth_m = values[EYE_DEPTH],
                                             .sun_zenith_rad = values[SUN_ZENITH] * rad_per_deg,
                                             .view_zenith_rad = values[VIEW_ZENITH] * rad_per_deg,
                                             .azimuth_rad = values[AZIMUTH] * rad_per_deg,
                                             .wavelength_nm = values[WAVELENGTH]};
    }
}

static void print_answers(FILE *stream, const struct query_lists *lists, const struct work *work,
                          bool has_error)
{
    query_lists_print_columns(lists, stream);
    fprintf(stream, "star_per_sr,sky_per_sr,star_W_m2_nm,sky_W_m2_nm,radiance_W_m2_sr_nm%s\n",
            has_error ? ",star_standard_error,sky_standard_error" : "");
    for (size_t q = 0; q < work->count; q++) {
        const trl_water_light *l = &work->lights[q];
        query_lists_print_texts(lists, work->texts[q], stream);
        fprintf(stream, "%.9g,%.9g,%.9g,%.9g,%.9g", l->star_per_sr, l->sky_per_sr,
                l->star_irradiance, l->sky_irradiance, l->radiance);
        if (has_error) {
            fprintf(stream, ",%.3g,%.3g", l->star_error, l->sky_error);
        }
        fputc('\n', stream);
    }
}

static enum exit_status solve(struct app *app, const struct sea_arguments *arguments,
                              struct work *work)
{
    trl_water_desc desc = trl_water_desc_default();
    desc.uses_reference = arguments->solver == SOLVER_REFERENCE;
    if (arguments->paths.is_given) {
        desc.paths = (uint64_t)arguments->paths.value;
    }
    if (arguments->seed.is_given) {
        desc.seed = (uint64_t)arguments->seed.value;
    }
    trl_scene *scene = NULL;
    trl_result result = trl_scene_load(app->ctx, arguments->scene, &scene);
    if (result == TRL_OK) {
        result =
            trl_water_radiance(app->ctx, scene, &desc, work->queries, work->count, work->lights);
    }
    trl_scene_destroy(&scene);
    return report_result(result);
}

static enum exit_status run(struct app *app, const struct sea_arguments *arguments)
{
    struct work work = {0};
    struct output_text output = {0};
    enum exit_status status = begin_work(arguments, &work);
    if (status == EXIT_OK) {
        combine_lists(arguments, &work);
        status = output_text_begin(arguments->output, &output);
    }
    status = status == EXIT_OK ? solve(app, arguments, &work) : status;
    if (status == EXIT_OK) {
        progress_clear(&app->progress);
        print_answers(output.stream, &arguments->lists, &work,
                      arguments->solver == SOLVER_REFERENCE);
        status = output_text_commit(&output);
    }
    output_text_abort(&output);
    finish_work(&work);
    return status;
}

enum exit_status command_sea(int argc, char **argv)
{
    struct sea_arguments arguments;
    const enum options_outcome outcome = read_arguments(argc, argv, &arguments);
    enum exit_status status = outcome == OPTIONS_WRONG ? EXIT_USAGE : EXIT_OK;
    if (outcome == OPTIONS_READ && arguments.solver != SOLVER_REFERENCE &&
        (arguments.paths.is_given || arguments.seed.is_given)) {
        status = report_error(EXIT_USAGE, "sea: --paths and --seed belong to --solver reference");
    } else if (outcome == OPTIONS_READ) {
        struct app app;
        status = app_init(
            &app, &(struct app_desc){.is_quiet = arguments.is_quiet, .data = &arguments.data});
        status = status == EXIT_OK ? run(&app, &arguments) : status;
        app_finish(&app);
    }
    query_lists_finish(&arguments.lists);
    return status;
}
