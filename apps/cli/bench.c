// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella bench: speed and memory, for people or as JSON.
#include "bench.h"

#include "commands.h"
#include "mesher_option.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Passes of a frame that are looked through.
enum { TIMINGS_MAX = 48 };

struct bench {
    const char *name;
    const char *summary;
    trl_result (*run)(const struct bench_job *job);
    const char *source; // the paper that prints a table of it; NULL: ours alone
};

static const struct bench benches[] = {
    {"solver", "light in Earth's air: 16 wavelengths, all orders to 0.1 %", bench_run_solver, NULL},
    {"tables", "the 4D table from that solution", bench_run_tables, NULL},
    {"sky-frame", "frames of a bare sphere: from the ground, at the limb, full disc",
     bench_run_sky_frame, NULL},
    {"start", "from program start to the first finished picture, caches warm", bench_run_start,
     NULL},
    {"water-tables", "light out of the water over depth, view and star: time, size, error",
     bench_run_water_tables, NULL},
    {"water-error", "colours of three waters in four depths, noon and 4 PM, against traced paths",
     bench_run_water_error, NULL},
    {"terrain-error", "each mesh of the ground against rays: pixels, triangles, time, popping",
     bench_run_terrain_error, NULL},
    {"stream", "rasters larger than their memory: first complete frame, tiles, a flight",
     bench_run_stream, NULL},
    {"clouds", "clouds over a bare sphere: by cover, view, size and samples toward the sun; memory",
     bench_run_clouds, NULL},
    {"cloud-frame", "terrain, sea, air and clouds: complete frames of each view, and in flight",
     bench_run_cloud_frame, NULL},
    {"cloud-error", "drawn clouds against traced ones: a field at noon, sunset, against the sun",
     bench_run_cloud_error, NULL},
    {"schafhitzel-table1", "Earth and Mars, outside and inside, with air and without",
     bench_run_schafhitzel_table1, "Schafhitzel, Falk and Ertl 2007, Table 1"},
    {"schafhitzel-table2", "single scattering on spheres: 3D table against integrals at vertices",
     bench_run_schafhitzel_table2, "Schafhitzel, Falk and Ertl 2007, Table 2"},
    {"santana-samples", "model rayleigh: points along a line of sight, error and time",
     bench_run_santana_samples, "Santana, Trujillo, Suarez and Ortega 2017, Section 8.2"},
    {"santana-spectrum", "model rayleigh: wavelengths, error of colour and time",
     bench_run_santana_spectrum, "Santana, Trujillo, Suarez and Ortega 2017, Section 8.3"},
    {"santana-fit", "model rayleigh: optical depth by polynomials, error and time",
     bench_run_santana_fit, "Santana, Trujillo, Suarez and Ortega 2017, Section 8.1"},
    {"elek-precompute", "light in the air by orders and by wavelengths, and its tables",
     bench_run_elek_precompute, "Elek and Kmoch 2010, Section 6"},
    {"elek-fps", "frames per second over all views of a scene, on small and large screens",
     bench_run_elek_fps, "Elek and Kmoch 2010, Section 6"},
    {"elek-rgb-vs-spectral", "colours from three wavelengths against those from sixteen",
     bench_run_elek_rgb, "Elek and Kmoch 2010, Figure 6"},
    {"michelic-table1", "invented ground by layers of noise and size of the tessellated grid",
     bench_run_michelic_table1, "Michelic 2019, Table 1"},
    {"michelic-table2",
     "spherical waves by their number, for a picture of 80 x 80 and a larger one",
     bench_run_michelic_table2, "Michelic 2019, Table 2"},
    {"ocean-frame", "the sea in a frame, pass by pass, from 10 m, 1 km and 400 km",
     bench_run_ocean_frame, NULL},
    {"michelic-frame", "terrain, ocean, and air with clouds in full HD, by passes",
     bench_run_michelic_frame, "Michelic 2019, Figure 17"},
    {"pgm-fps", "frames per second of the projective mesher, by grid and screen, three views",
     bench_run_pgm_fps, "Planetary Terrain Rendering (PGM), Section 8"},
};
enum { BENCH_COUNT = sizeof benches / sizeof benches[0] };
_Static_assert((int)BENCH_COUNT <= (int)OPTIONS_MAX_POSITIONALS, "all can be named at once");

// Words that stand for several benches.
static const char *const group_words[] = {"speed", "papers", "all"};
enum { GROUP_SPEED, GROUP_PAPERS, GROUP_ALL, GROUP_COUNT };

struct bench_arguments {
    struct option_arguments names;
    const char *scene;
    struct mesher_option mesher;
    struct option_number runs, shrink;
    bool is_json;
    bool lists_benches;
    struct data_choice data;
};

static const char about[] =
    "Measures the benches named; --list tells what there is. A bench of a paper's\n"
    "results prints the paper's numbers beside those measured here, on the same work.\n"
    "The word speed stands for all that are of no paper (the default), papers for the\n"
    "others, all for both.\n";
static const char examples[] = "  terrella bench\n"
                               "  terrella bench --list\n"
                               "  terrella bench solver sky-frame --json --runs 5\n"
                               "  terrella bench papers\n";

static enum options_outcome read_arguments(int argc, char **argv, struct bench_arguments *out)
{
    *out = (struct bench_arguments){.mesher = mesher_option_default()};
    const struct option options[] = {
        {.name = "json",
         .kind = OPTION_FLAG,
         .target.flag = &out->is_json,
         .help = "Print one JSON object a bench, one a line, instead of tables."},
        {.name = "list",
         .kind = OPTION_FLAG,
         .target.flag = &out->lists_benches,
         .help = "Print the names of all benches, each with what it measures, and measure "
                 "nothing."},
        mesher_option_make(&out->mesher,
                           "Mesh of the ground to measure with (see terrella render). Default: the "
                           "default one; all where meshes are compared."),
        {.name = "runs",
         .kind = OPTION_NUMBER,
         .target.number = &out->runs,
         .metavar = "N",
         .range = {1.0, BENCH_MAX_RUNS},
         .is_whole = true,
         .help = "How often each thing is measured. Default: each bench has its own."},
        {.name = "shrink",
         .kind = OPTION_NUMBER,
         .target.number = &out->shrink,
         .metavar = "N",
         .range = {1.0, 64.0},
         .is_whole = true,
         .help = "Draw what is timed N times narrower and lower: a quick look at what a bench "
                 "prints. Default: 1."},
        {.name = "scene",
         .kind = OPTION_TEXT,
         .target.text = &out->scene,
         .metavar = "FILE",
         .help = "Scene to measure with, all its views where pictures are drawn. Default: the "
                 "ones that ship with the program."},
    };
    struct option data[DATA_OPTIONS];
    data_options_make(&out->data, data);
    const struct option_section sections[] = {
        {"Options", options, sizeof options / sizeof *options},
        {DATA_OPTIONS_HEADING, data, DATA_OPTIONS}};
    const struct option_spec spec = {.command = "bench",
                                     .positional = "[NAME...]",
                                     .max_positionals = OPTIONS_MAX_POSITIONALS,
                                     .about = about,
                                     .examples = examples,
                                     .sections = sections,
                                     .section_count = 2};
    return options_read(&spec, argc, argv, &out->names);
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

void bench_show(const struct bench_job *job)
{
    if (!job->is_json) {
        progress_clear(&job->app->progress);
        bench_table_print_rows(job->table);
    }
}

trl_renderer_desc bench_renderer_desc(const struct bench_job *job, const trl_scene *scene)
{
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    desc.mesher = job->mesher < 0 ? desc.mesher : (trl_mesher)job->mesher;
    return desc;
}

trl_result bench_draw(const struct bench_job *job, trl_renderer *renderer, const trl_view *view,
                      struct number_size size, double frame_s)
{
    const uint32_t shrink = (uint32_t)job->shrink;
    const uint32_t width = size.width / shrink;
    const uint32_t height = size.height / shrink;
    return trl_renderer_draw(renderer, view, width ? width : 1, height ? height : 1, frame_s);
}

double bench_timing_ms(const trl_timing *timing)
{
    return timing->gpu_ms > 0 ? timing->gpu_ms : timing->cpu_ms;
}

double bench_pass_ms(const trl_renderer *renderer, const char *pass)
{
    trl_timing rows[TIMINGS_MAX];
    const size_t all = trl_renderer_timings(renderer, rows, TIMINGS_MAX);
    for (size_t i = 0; i < all && i < TIMINGS_MAX; i++) {
        if (strcmp(rows[i].name, pass) == 0) {
            return bench_timing_ms(&rows[i]);
        }
    }
    return 0;
}

static enum exit_status run_bench(struct app *app, const struct bench *bench,
                                  const struct bench_arguments *arguments,
                                  const struct bench_machine *machine)
{
    struct bench_table *table = calloc(1, sizeof *table);
    if (!table) {
        return report_error(EXIT_FAILED, "bench: out of memory");
    }
    table->name = bench->name;
    table->summary = bench->summary;
    table->source = bench->source;
    const struct bench_job job = {
        .app = app,
        .scene = arguments->scene,
        .runs = (int)arguments->runs.value,
        .shrink = arguments->shrink.value > 1 ? (int)arguments->shrink.value : 1,
        .mesher = arguments->mesher.mesher,
        .is_json = arguments->is_json,
        .table = table};
    if (job.shrink > 1) {
        bench_note(table, "Pictures that are timed are %d times narrower and lower than said.",
                   job.shrink);
    }
    enum exit_status status = report_result(bench->run(&job));
    progress_clear(&app->progress);
    if (status == EXIT_OK && arguments->is_json) {
        status = bench_table_print_json(table, machine);
    } else if (status == EXIT_OK) {
        bench_table_print(table);
    }
    fflush(stdout);
    bench_table_finish(table);
    free(table);
    return status;
}

static void report_unknown(const char *name)
{
    const char *names[BENCH_COUNT + GROUP_COUNT];
    for (int i = 0; i < BENCH_COUNT; i++) {
        names[i] = benches[i].name;
    }
    memcpy(names + BENCH_COUNT, group_words, sizeof group_words);
    const char *nearest = report_nearest(name, names, sizeof names / sizeof *names);
    report_error(EXIT_USAGE, "bench: there is no bench '%.60s'%s%s%s", name,
                 nearest ? "; did you mean " : "; see terrella bench --list",
                 nearest ? nearest : "", nearest ? "?" : "");
}

static bool is_meant(const char *word, const struct bench *bench)
{
    if (strcmp(word, group_words[GROUP_SPEED]) == 0) {
        return !bench->source;
    }
    if (strcmp(word, group_words[GROUP_PAPERS]) == 0) {
        return bench->source != NULL;
    }
    return strcmp(word, group_words[GROUP_ALL]) == 0 || strcmp(word, bench->name) == 0;
}

// Which benches to run, each once, in the order of the command line.
static enum exit_status choose_benches(const struct option_arguments *names,
                                       const struct bench *chosen[BENCH_COUNT], size_t *count)
{
    static const struct option_arguments all_of_ours = {{"speed"}, 1};
    const struct option_arguments *words = names->count > 0 ? names : &all_of_ours;
    bool is_chosen[BENCH_COUNT] = {false};
    *count = 0;
    for (size_t w = 0; w < words->count; w++) {
        bool is_known = false;
        for (int i = 0; i < BENCH_COUNT; i++) {
            if (!is_meant(words->positionals[w], &benches[i])) {
                continue;
            }
            is_known = true;
            if (!is_chosen[i]) {
                is_chosen[i] = true;
                chosen[(*count)++] = &benches[i];
            }
        }
        if (!is_known) {
            report_unknown(words->positionals[w]);
            return EXIT_USAGE;
        }
    }
    return EXIT_OK;
}

static void list_benches(void)
{
    for (int i = 0; i < BENCH_COUNT; i++) {
        printf("%-22s %s\n", benches[i].name, benches[i].summary);
    }
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
    if (arguments.lists_benches) {
        list_benches();
        return EXIT_OK;
    }
    const struct bench *chosen[BENCH_COUNT];
    size_t count = 0;
    if (choose_benches(&arguments.names, chosen, &count) != EXIT_OK) {
        return EXIT_USAGE;
    }
    struct app app;
    enum exit_status status = app_init(&app, &(struct app_desc){.data = &arguments.data});
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
