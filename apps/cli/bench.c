// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella bench: speed and memory, for people or as JSON.
#include "bench.h"

#include "bench_machine.h"
#include "commands.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct bench {
    const char *name;
    const char *summary;
    trl_result (*run)(const struct bench_job *job);
};

static const struct bench benches[] = {
    {"solver", "light in Earth's air: 16 wavelengths, all orders to 0.1 %", bench_run_solver},
    {"tables", "the 4D table from that solution", bench_run_tables},
    {"sky-frame", "frames of a bare sphere: from the ground, at the limb, full disc",
     bench_run_sky_frame},
    {"start", "from program start to the first finished picture, caches warm", bench_run_start},
};
enum { BENCH_COUNT = sizeof benches / sizeof benches[0] };

struct bench_arguments {
    struct option_arguments names;
    const char *scene;
    struct option_number runs;
    bool is_json;
};

static const char about[] =
    "Measures the benches named, or all:\n"
    "  solver     light in Earth's air: 16 wavelengths, all orders to 0.1 %\n"
    "  tables     the 4D table from that solution\n"
    "  sky-frame  frames of a bare sphere: from the ground, at the limb, full disc\n"
    "  start      from program start to the first finished picture, caches warm\n";
static const char examples[] = "  terrella bench\n"
                               "  terrella bench solver sky-frame --json --runs 5\n";

static enum options_outcome read_arguments(int argc, char **argv, struct bench_arguments *out)
{
    *out = (struct bench_arguments){0};
    const struct option options[] = {
        {.name = "json",
         .kind = OPTION_FLAG,
         .target.flag = &out->is_json,
         .help = "Print one JSON object a bench, one a line, instead of tables."},
        {.name = "runs",
         .kind = OPTION_NUMBER,
         .target.number = &out->runs,
         .metavar = "N",
         .range = {1.0, BENCH_MAX_RUNS},
         .is_whole = true,
         .help = "How often each thing is measured. Default: each bench has its own."},
        {.name = "scene",
         .kind = OPTION_TEXT,
         .target.text = &out->scene,
         .metavar = "FILE",
         .help = "Scene to measure with, all its views where pictures are drawn. Default: the "
                 "ones that ship with the program."},
    };
    const struct option_section sections[] = {{"Options", options, 3}};
    const struct option_spec spec = {.command = "bench",
                                     .positional = "[NAME...]",
                                     .max_positionals = BENCH_COUNT,
                                     .about = about,
                                     .examples = examples,
                                     .sections = sections,
                                     .section_count = 1};
    return options_read(&spec, argc, argv, &out->names);
}

trl_result bench_add(struct bench_table *table, struct bench_sample sample)
{
    int i = 0;
    while (i < table->row_count && (strcmp(table->rows[i].case_name, sample.case_name) != 0 ||
                                    strcmp(table->rows[i].metric, sample.metric) != 0)) {
        i++;
    }
    if (i == BENCH_MAX_ROWS || (i < table->row_count && table->rows[i].runs == BENCH_MAX_RUNS)) {
        report_error(EXIT_FAILED, "bench: too many rows or runs");
        return TRL_ERROR_MEMORY;
    }
    struct bench_row *row = &table->rows[i];
    if (i == table->row_count) {
        snprintf(row->case_name, sizeof row->case_name, "%s", sample.case_name);
        snprintf(row->metric, sizeof row->metric, "%s", sample.metric);
        row->unit = sample.unit;
        row->samples = calloc(BENCH_MAX_RUNS, sizeof *row->samples);
        if (!row->samples) {
            report_error(EXIT_FAILED, "bench: out of memory");
            return TRL_ERROR_MEMORY;
        }
        table->row_count++;
    }
    row->samples[row->runs++] = sample.value;
    return TRL_OK;
}

trl_result bench_load_scene(const struct bench_job *job, const char *file, trl_scene **out)
{
    *out = NULL;
    if (job->scene) {
        return trl_scene_load(job->app->ctx, job->scene, out);
    }
    char *path = app_find_scene(file);
    if (!path) {
        report_error(EXIT_FAILED,
                     "bench: %s is not where the program was built or installed; give "
                     "a scene with --scene",
                     file);
        return TRL_ERROR_IO;
    }
    const trl_result result = trl_scene_load(job->app->ctx, path, out);
    free(path);
    return result;
}

static int compare_samples(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

// Sorts the samples; the median of an even number is between the two in the middle.
static double find_median(struct bench_row *row)
{
    qsort(row->samples, (size_t)row->runs, sizeof *row->samples, compare_samples);
    const int half = row->runs / 2;
    return row->runs % 2 ? row->samples[half] : 0.5 * (row->samples[half - 1] + row->samples[half]);
}

static void print_table(const struct bench *bench, struct bench_table *table)
{
    printf("%s: %s\n  %-28s %-24s %12s %12s %-6s %4s\n", bench->name, bench->summary, "case",
           "metric", "median", "min", "unit", "runs");
    for (int i = 0; i < table->row_count; i++) {
        struct bench_row *row = &table->rows[i];
        const double median = find_median(row);
        printf("  %-28s %-24s %12.4g %12.4g %-6s %4d\n", row->case_name, row->metric, median,
               row->samples[0], row->unit, row->runs);
    }
}

// json_pack answers NULL when memory is out, and takes NULL for it again.
static enum exit_status print_json(const struct bench *bench, struct bench_table *table,
                                   const struct bench_machine *machine)
{
    json_t *rows = json_array();
    for (int i = 0; i < table->row_count; i++) {
        struct bench_row *row = &table->rows[i];
        const double median = find_median(row);
        json_array_append_new(rows,
                              json_pack("{s:s, s:s, s:s, s:f, s:f, s:i}", "case", row->case_name,
                                        "metric", row->metric, "unit", row->unit, "median", median,
                                        "min", row->samples[0], "runs", row->runs));
    }
    json_t *object =
        json_pack("{s:s, s:{s:s, s:i, s:f, s:s}, s:o}", "bench", bench->name, "machine", "cpu",
                  machine->cpu, "cores", machine->cores, "load_average", machine->load_average,
                  "gl_renderer", machine->gl_renderer, "rows", rows);
    char *text = object ? json_dumps(object, JSON_COMPACT | JSON_REAL_PRECISION(6)) : NULL;
    json_decref(object);
    if (!text) {
        return report_error(EXIT_FAILED, "bench: out of memory");
    }
    printf("%s\n", text);
    free(text);
    return EXIT_OK;
}

static void finish_table(struct bench_table *table)
{
    for (int i = 0; i < table->row_count; i++) {
        free(table->rows[i].samples);
    }
    free(table);
}

static enum exit_status run_bench(struct app *app, const struct bench *bench,
                                  const struct bench_arguments *arguments,
                                  const struct bench_machine *machine)
{
    struct bench_table *table = calloc(1, sizeof *table);
    if (!table) {
        return report_error(EXIT_FAILED, "bench: out of memory");
    }
    const struct bench_job job = {
        .app = app, .scene = arguments->scene, .runs = (int)arguments->runs.value, .table = table};
    enum exit_status status = report_result(bench->run(&job));
    progress_clear(&app->progress);
    if (status == EXIT_OK && arguments->is_json) {
        status = print_json(bench, table, machine);
    } else if (status == EXIT_OK) {
        print_table(bench, table);
    }
    fflush(stdout);
    finish_table(table);
    return status;
}

static const struct bench *find_bench(const char *name)
{
    for (int i = 0; i < BENCH_COUNT; i++) {
        if (strcmp(benches[i].name, name) == 0) {
            return &benches[i];
        }
    }
    const char *names[BENCH_COUNT];
    for (int i = 0; i < BENCH_COUNT; i++) {
        names[i] = benches[i].name;
    }
    const char *nearest = report_nearest(name, names, BENCH_COUNT);
    report_error(EXIT_USAGE, "bench: there is no bench '%.60s'%s%s%s", name,
                 nearest ? "; did you mean " : "; see terrella bench --help",
                 nearest ? nearest : "", nearest ? "?" : "");
    return NULL;
}

// Which benches to run, in the order of the command line.
static enum exit_status choose_benches(const struct bench_arguments *arguments,
                                       const struct bench *chosen[BENCH_COUNT], size_t *count)
{
    *count = arguments->names.count;
    for (size_t i = 0; i < *count; i++) {
        chosen[i] = find_bench(arguments->names.positionals[i]);
        if (!chosen[i]) {
            return EXIT_USAGE;
        }
    }
    if (*count == 0) {
        *count = BENCH_COUNT;
        for (size_t i = 0; i < BENCH_COUNT; i++) {
            chosen[i] = &benches[i];
        }
    }
    return EXIT_OK;
}

static void print_machine(const struct bench_machine *machine)
{
    printf("%s, %d cores, load %.2f, %s\n", machine->cpu, machine->cores, machine->load_average,
           machine->gl_renderer);
}

enum exit_status command_bench(int argc, char **argv)
{
    struct bench_arguments arguments;
    const enum options_outcome outcome = read_arguments(argc, argv, &arguments);
    if (outcome != OPTIONS_READ) {
        return outcome == OPTIONS_HELP ? EXIT_OK : EXIT_USAGE;
    }
    const struct bench *chosen[BENCH_COUNT];
    size_t count = 0;
    if (choose_benches(&arguments, chosen, &count) != EXIT_OK) {
        return EXIT_USAGE;
    }
    struct app app;
    enum exit_status status = app_init(&app, &(struct app_desc){0});
    struct bench_machine machine;
    if (status == EXIT_OK) {
        bench_machine_read(app.ctx, &machine);
        if (!arguments.is_json) {
            print_machine(&machine);
        }
    }
    for (size_t i = 0; status == EXIT_OK && i < count; i++) {
        status = run_bench(&app, chosen[i], &arguments, &machine);
    }
    app_finish(&app);
    return status;
}
