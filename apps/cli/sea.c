// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella sea: light in the water as numbers. No OpenGL is touched.
#include "app.h"
#include "commands.h"
#include "output.h"

#include <terrella/water.h>

#include <math.h>
#include <stdlib.h>

// What a query consists of, in the order of the output's columns.
enum { DEPTH, EYE_DEPTH, SUN_ZENITH, VIEW_ZENITH, AZIMUTH, WAVELENGTH, PART_COUNT };

struct part {
    const char *column; // of the CSV
    const char *option;
    const char *metavar;
    struct number_range range;
    const char *fallback; // NULL: it must be given
    const char *help;
};

static const struct part parts[PART_COUNT] = {
    {"depth_m", "depth", "LIST", {0.0, 1e6}, NULL, "Metres of water."},
    {"eye_depth_m",
     "eye-depth",
     "LIST",
     {0.0, 1e6},
     "0",
     "Metres of the eye below the surface. Default: 0, above it."},
    {"sun_zenith_deg",
     "sun-zenith",
     "LIST",
     {0.0, 89.99},
     NULL,
     "Degrees from the zenith to the sun's centre, in the air: 0 overhead."},
    {"view_zenith_deg",
     "view-zenith",
     "LIST",
     {0.0, 180.0},
     NULL,
     "Degrees from the zenith to the line of sight, where the eye is: 180 looks straight down. "
     "Above 90 for an eye above the water."},
    {"azimuth_deg",
     "azimuth",
     "LIST",
     {-360.0, 360.0},
     "0",
     "Degrees of the line of sight from the sun's: 0 is toward the sun. Default: 0."},
    {"wavelength_nm", "wavelength", "LIST", {1.0, 1e7}, NULL, "Nanometres."},
};

enum { QUERIES_MAX = 1000000 };
static const double rad_per_deg = 3.14159265358979323846 / 180.0;

struct sea_arguments {
    const char *scene;
    struct number_list lists[PART_COUNT];
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
    *out = (struct sea_arguments){0};
    struct option query[PART_COUNT];
    for (int i = 0; i < PART_COUNT; i++) {
        query[i] = (struct option){.name = parts[i].option,
                                   .kind = OPTION_LIST,
                                   .target.list = &out->lists[i],
                                   .metavar = parts[i].metavar,
                                   .range = parts[i].range,
                                   .help = parts[i].help};
    }
    const struct option solver[] = {
        {.name = "solver",
         .kind = OPTION_CHOICE,
         .target.choice = &out->solver,
         .choices = solver_words,
         .metavar = "NAME",
         .help = "spectral (the default) or reference (a Monte Carlo path tracer to judge it by: "
                 "slow)."},
        {.name = "paths",
         .kind = OPTION_NUMBER,
         .target.number = &out->paths,
         .metavar = "N",
         .range = {2, 1e12},
         .is_whole = true,
         .help = "Of the path tracer for each query: four times as many halve the noise. Default: "
                 "100000."},
        {.name = "seed",
         .kind = OPTION_NUMBER,
         .target.number = &out->seed,
         .metavar = "N",
         .range = {0, 9007199254740992},
         .is_whole = true,
         .help = "Of the path tracer: the same seed gives the same numbers. Default: 0."},
    };
    const struct option result[] = {
        {.name = "output",
         .letter = 'o',
         .kind = OPTION_TEXT,
         .target.text = &out->output,
         .metavar = "FILE",
         .help = "Where to write. Default: standard output."},
        {.name = "quiet",
         .letter = 'q',
         .kind = OPTION_FLAG,
         .target.flag = &out->is_quiet,
         .help = "No progress line."},
    };
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
    out->count = 1;
    for (int i = 0; i < PART_COUNT; i++) {
        if (arguments->lists[i].count == 0 && !parts[i].fallback) {
            return report_error(EXIT_USAGE, "sea: --%s is missing; see terrella sea --help",
                                parts[i].option);
        }
        out->count *= arguments->lists[i].count > 0 ? arguments->lists[i].count : 1;
        out->count = out->count > QUERIES_MAX ? QUERIES_MAX + 1 : out->count; // no overflow
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

// Every combination of the lists, the last one running fastest.
static void combine_lists(const struct sea_arguments *arguments, struct work *work)
{
    for (size_t q = 0; q < work->count; q++) {
        double values[PART_COUNT] = {0};
        size_t rest = q;
        for (int i = PART_COUNT - 1; i >= 0; i--) {
            const struct number_list *list = &arguments->lists[i];
            work->texts[q][i] = parts[i].fallback;
            if (list->count > 0) {
                const struct number_item *item = &list->items[rest % list->count];
                rest /= list->count;
                values[i] = item->value;
                work->texts[q][i] = item->text;
            }
        }
        work->queries[q] = (trl_water_query){.depth_m = values[DEPTH],
                                             .eye_depth_m = values[EYE_DEPTH],
                                             .sun_zenith_rad = values[SUN_ZENITH] * rad_per_deg,
                                             .view_zenith_rad = values[VIEW_ZENITH] * rad_per_deg,
                                             .azimuth_rad = values[AZIMUTH] * rad_per_deg,
                                             .wavelength_nm = values[WAVELENGTH]};
    }
}

static void print_answers(FILE *stream, const struct work *work, bool has_error)
{
    for (int i = 0; i < PART_COUNT; i++) {
        fprintf(stream, "%s,", parts[i].column);
    }
    fprintf(stream, "star_per_sr,sky_per_sr,star_W_m2_nm,sky_W_m2_nm,radiance_W_m2_sr_nm%s\n",
            has_error ? ",star_standard_error,sky_standard_error" : "");
    for (size_t q = 0; q < work->count; q++) {
        const trl_water_light *l = &work->lights[q];
        for (int i = 0; i < PART_COUNT; i++) {
            fprintf(stream, "%s,", work->texts[q][i]);
        }
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
        print_answers(output.stream, &work, arguments->solver == SOLVER_REFERENCE);
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
    for (int i = 0; i < PART_COUNT; i++) {
        number_list_finish(&arguments.lists[i]);
    }
    return status;
}
