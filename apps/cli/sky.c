// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella sky: spectral radiances as numbers. No OpenGL is touched.
#include "app.h"
#include "commands.h"
#include "common_options.h"
#include "csv.h"
#include "output.h"
#include "query_lists.h"
#include "rayleigh_options.h"

#include <math.h>
#include <stdlib.h>

// What a query consists of, in the order of the output's columns.
enum { ALTITUDE, SUN_ZENITH, VIEW_ZENITH, AZIMUTH, WAVELENGTH, PART_COUNT };

// The tiny wavelength keeps 0 out; there is no light of longer wavelength than a metre to speak of.
static const struct query_part parts[PART_COUNT] = {
    {.column = "altitude_m",
     .option = "altitude",
     .metavar = "M",
     .range = {0.0, 1e12},
     .help = "Metres of the observer above the reference sphere; may be above the atmosphere."},
    {.column = "sun_zenith_deg",
     .option = "sun-zenith",
     .metavar = "DEG",
     .range = {0.0, 180.0},
     .help = "Degrees from the zenith to the sun's centre: 0 overhead, above 90 below the "
             "horizontal."},
    {.column = "view_zenith_deg",
     .option = "view-zenith",
     .metavar = "LIST",
     .range = {0.0, 180.0},
     .help = "Degrees from the zenith to the line of sight: 0 is up, above 90 looks down."},
    {.column = "azimuth_deg",
     .option = "azimuth",
     .metavar = "LIST",
     .range = {-360.0, 360.0},
     .help = "Degrees of the line of sight from the sun's: 0 is toward the sun."},
    {.column = "wavelength_nm",
     .option = "wavelength",
     .metavar = "LIST",
     .range = {1e-3, 1e9},
     .help = "Nanometres."},
};

enum { QUERIES_MAX = 10000000 };
static const double rad_per_deg = 3.14159265358979323846 / 180.0;

struct sky_arguments {
    const char *scene;
    struct query_lists lists;
    const char *queries; // NULL: the lists
    int solver;          // a trl_sky_model
    struct option_number orders, paths, seed;
    struct rayleigh_choice rayleigh;
    const char *output; // NULL: standard output
    bool is_quiet;
    struct data_choice data;
};

// In the order of trl_sky_model.
static const char *const solver_words[] = {"spectral", "single", "rayleigh", "reference", NULL};

// The queries, and each number as it was given.
struct questions {
    size_t count;
    trl_sky_query *queries;           // owned
    const char *(*texts)[PART_COUNT]; // owned; the strings are not
};

static const char about[] =
    "Prints the spectral radiance that reaches an observer, as CSV with the column\n"
    "radiance_W_m2_sr_nm behind those of the query: all orders of scattering, the\n"
    "ground where the line of sight meets it, no solar disc. The light transport is\n"
    "solved at exactly the wavelengths asked for. The path tracer (--solver reference)\n"
    "adds the column standard_error, of its noise.\n"
    "A LIST is numbers separated by commas; from:to:step stands for a row of them.\n"
    "All combinations of the lists are answered, wavelengths running fastest.\n";
static const char examples[] =
    "  terrella sky scenes/earth.json --altitude 0 --sun-zenith 60 \\\n"
    "      --view-zenith 0:90:10 --azimuth 0,180 --wavelength 450,550,650\n"
    "  terrella sky scenes/earth.json --queries questions.csv -o answers.csv\n"
    "  terrella sky scenes/earth.json --altitude 0 --sun-zenith 60 --view-zenith 45 \\\n"
    "      --azimuth 90 --wavelength 550 --solver reference --paths 100000\n";

static enum options_outcome read_arguments(int argc, char **argv, struct sky_arguments *out)
{
    *out = (struct sky_arguments){.rayleigh = rayleigh_choice_default(),
                                  .lists = {.command = "sky",
                                            .parts = parts,
                                            .part_count = PART_COUNT,
                                            .max_count = QUERIES_MAX,
                                            .alternative = " (or --queries)"}};
    struct option query[PART_COUNT + 1];
    query_lists_make_options(&out->lists, query);
    query[PART_COUNT] =
        (struct option){.name = "queries",
                        .kind = OPTION_TEXT,
                        .target.text = &out->queries,
                        .metavar = "FILE.csv",
                        .help = "Instead of all these: a table with the columns altitude_m, "
                                "sun_zenith_deg, view_zenith_deg, azimuth_deg, wavelength_nm in "
                                "any order, one query a row; - reads standard input."};
    const struct option solver[] = {
        {.name = "solver",
         .kind = OPTION_CHOICE,
         .target.choice = &out->solver,
         .choices = solver_words,
         .metavar = "NAME",
         .help = "spectral (all orders of scattering, the default), single or rayleigh (the models "
                 "of render --sky-model: one scattering), or reference (a Monte Carlo path tracer "
                 "to judge the others by: slow)."},
        {.name = "orders",
         .kind = OPTION_NUMBER,
         .target.number = &out->orders,
         .metavar = "K",
         .range = {1, TRL_SKY_MAX_ORDERS},
         .is_whole = true,
         .word = "all",
         .help = "Scatterings and reflections by the ground that light may have. Default: all."},
        option_paths(&out->paths, 2,
                     "Of the path tracer for each query: four times as many halve the noise. "
                     "Default: 10000."),
        option_seed(&out->seed,
                    "Of the path tracer: the same seed gives the same numbers. Default: 0."),
    };
    struct option rayleigh[RAYLEIGH_OPTIONS];
    rayleigh_options_make(&out->rayleigh, rayleigh);
    const struct option result[] = {option_output(&out->output), option_quiet(&out->is_quiet)};
    struct option data[DATA_OPTIONS];
    data_options_make(&out->data, data);
    const struct option_section sections[] = {
        {"Query", query, PART_COUNT + 1},
        {"Solver", solver, sizeof solver / sizeof *solver},
        {RAYLEIGH_OPTIONS_HEADING, rayleigh, RAYLEIGH_OPTIONS},
        {"Result", result, sizeof result / sizeof *result},
        {DATA_OPTIONS_HEADING, data, DATA_OPTIONS}};
    const struct option_spec spec = {.command = "sky",
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

static enum exit_status allocate_questions(size_t count, struct questions *out)
{
    if (count > QUERIES_MAX) {
        return report_error(EXIT_USAGE, "sky: %zu queries are more than %d", count, QUERIES_MAX);
    }
    *out = (struct questions){.count = count};
    out->queries = calloc(count + 1, sizeof *out->queries);
    out->texts = calloc(count + 1, sizeof *out->texts);
    if (out->queries && out->texts) {
        return EXIT_OK;
    }
    return report_error(EXIT_FAILED, "sky: no memory for %zu queries", count);
}

static void finish_questions(struct questions *questions)
{
    free(questions->queries);
    free(questions->texts);
    *questions = (struct questions){0};
}

static trl_sky_query make_query(const double values[PART_COUNT])
{
    return (trl_sky_query){.altitude_m = values[ALTITUDE],
                           .sun_zenith_rad = values[SUN_ZENITH] * rad_per_deg,
                           .view_zenith_rad = values[VIEW_ZENITH] * rad_per_deg,
                           .azimuth_rad = values[AZIMUTH] * rad_per_deg,
                           .wavelength_nm = values[WAVELENGTH]};
}

static enum exit_status combine_lists(const struct sky_arguments *arguments, struct questions *out)
{
    size_t count = 0;
    enum exit_status status = query_lists_count(&arguments->lists, &count);
    if (status == EXIT_OK) {
        status = allocate_questions(count, out);
    }
    for (size_t q = 0; status == EXIT_OK && q < count; q++) {
        double values[PART_COUNT];
        query_lists_get(&arguments->lists, q, values, out->texts[q]);
        out->queries[q] = make_query(values);
    }
    return status;
}

static enum exit_status read_row(const struct csv_table *table, size_t row,
                                 const size_t columns[PART_COUNT], struct questions *out)
{
    double values[PART_COUNT];
    for (int i = 0; i < PART_COUNT; i++) {
        const char *text = csv_field(table, row, columns[i]);
        struct number_message message;
        if (!number_parse_in(text, parts[i].range, &values[i], &message)) {
            return report_error(EXIT_FAILED, "%s:%zu: %s: %s", table->name, table->lines[row],
                                parts[i].column, message.text);
        }
        out->texts[row][i] = text;
    }
    out->queries[row] = make_query(values);
    return EXIT_OK;
}

static enum exit_status read_table(const struct csv_table *table, struct questions *out)
{
    size_t columns[PART_COUNT];
    enum exit_status status = EXIT_OK;
    for (int i = 0; status == EXIT_OK && i < PART_COUNT; i++) {
        status = csv_find_column(table, parts[i].column, &columns[i]);
    }
    if (status == EXIT_OK) {
        status = allocate_questions(table->row_count, out);
    }
    for (size_t row = 0; status == EXIT_OK && row < table->row_count; row++) {
        status = read_row(table, row, columns, out);
    }
    return status;
}

// One number a query, and its noise where there is some.
struct answers {
    double *radiance;       // owned
    double *standard_error; // owned; NULL: the solver has none
};

static void print_answers(FILE *stream, const struct query_lists *lists,
                          const struct questions *questions, const struct answers *answers)
{
    query_lists_print_columns(lists, stream);
    fprintf(stream, "radiance_W_m2_sr_nm%s\n", answers->standard_error ? ",standard_error" : "");
    for (size_t q = 0; q < questions->count; q++) {
        query_lists_print_texts(lists, questions->texts[q], stream);
        fprintf(stream, "%.9g", answers->radiance[q]);
        if (answers->standard_error) {
            fprintf(stream, ",%.3g", answers->standard_error[q]);
        }
        fputc('\n', stream);
    }
}

static trl_sky_desc make_desc(const struct sky_arguments *arguments)
{
    trl_sky_desc desc = trl_sky_desc_default();
    desc.model = (trl_sky_model)arguments->solver;
    if (arguments->orders.is_given && !arguments->orders.is_word) {
        desc.max_orders = (uint32_t)arguments->orders.value;
    }
    if (arguments->paths.is_given) {
        desc.paths = (uint64_t)arguments->paths.value;
    }
    if (arguments->seed.is_given) {
        desc.seed = (uint64_t)arguments->seed.value;
    }
    return desc;
}

static enum exit_status solve(struct app *app, const struct sky_arguments *arguments,
                              const struct questions *questions, struct answers *answers)
{
    trl_sky_desc desc = make_desc(arguments);
    trl_scene *scene = NULL;
    trl_result result = trl_scene_load(app->ctx, arguments->scene, &scene);
    if (result == TRL_OK && questions->count > 0) {
        const trl_rayleigh_desc rayleigh = rayleigh_choice_resolve(&arguments->rayleigh, scene);
        desc.rayleigh = &rayleigh;
        result = trl_sky_radiance(app->ctx, scene, &desc, questions->queries, questions->count,
                                  answers->radiance, answers->standard_error);
    }
    trl_scene_destroy(&scene);
    return report_result(result);
}

static enum exit_status allocate_answers(const struct sky_arguments *arguments, size_t count,
                                         struct answers *out)
{
    const bool has_error = arguments->solver == TRL_SKY_REFERENCE;
    out->radiance = calloc(count + 1, sizeof *out->radiance);
    out->standard_error = has_error ? calloc(count + 1, sizeof *out->standard_error) : NULL;
    return out->radiance && (out->standard_error || !has_error)
               ? EXIT_OK
               : report_error(EXIT_FAILED, "sky: no memory for %zu queries", count);
}

static enum exit_status answer(struct app *app, const struct sky_arguments *arguments,
                               const struct questions *questions)
{
    struct output_text output = {0};
    struct answers answers = {0};
    enum exit_status status = allocate_answers(arguments, questions->count, &answers);
    if (status == EXIT_OK) {
        status = output_text_begin(arguments->output, &output);
    }
    if (status == EXIT_OK) {
        status = solve(app, arguments, questions, &answers);
    }
    if (status == EXIT_OK) {
        progress_clear(&app->progress);
        print_answers(output.stream, &arguments->lists, questions, &answers);
        status = output_text_commit(&output);
    }
    output_text_abort(&output);
    free(answers.radiance);
    free(answers.standard_error);
    return status;
}

static enum exit_status run(struct app *app, const struct sky_arguments *arguments)
{
    struct questions questions = {0};
    struct csv_table table = {0};
    enum exit_status status = EXIT_OK;
    if (arguments->queries) {
        status = csv_read(arguments->queries, &table);
        status = status == EXIT_OK ? read_table(&table, &questions) : status;
    } else {
        status = combine_lists(arguments, &questions);
    }
    if (status == EXIT_OK) {
        status = answer(app, arguments, &questions);
    }
    finish_questions(&questions);
    csv_finish(&table);
    return status;
}

static enum exit_status check_arguments(const struct sky_arguments *arguments)
{
    const bool is_traced = arguments->solver == TRL_SKY_REFERENCE;
    if (!is_traced && (arguments->paths.is_given || arguments->seed.is_given)) {
        return report_error(EXIT_USAGE, "sky: --paths and --seed belong to --solver reference");
    }
    for (int i = 0; arguments->queries && i < PART_COUNT; i++) {
        if (arguments->lists.lists[i].count > 0) {
            return report_error(EXIT_USAGE, "sky: --queries and --%s cannot both be given",
                                parts[i].option);
        }
    }
    return rayleigh_choice_check(&arguments->rayleigh);
}

enum exit_status command_sky(int argc, char **argv)
{
    struct sky_arguments arguments;
    const enum options_outcome outcome = read_arguments(argc, argv, &arguments);
    enum exit_status status = outcome == OPTIONS_WRONG ? EXIT_USAGE : EXIT_OK;
    if (outcome == OPTIONS_READ) {
        status = check_arguments(&arguments);
    }
    if (outcome == OPTIONS_READ && status == EXIT_OK) {
        struct app app;
        status = app_init(
            &app, &(struct app_desc){.is_quiet = arguments.is_quiet, .data = &arguments.data});
        status = status == EXIT_OK ? run(&app, &arguments) : status;
        app_finish(&app);
    }
    query_lists_finish(&arguments.lists);
    return status;
}
