// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella validate: all models of the sky against the path tracer, as a table, JSON or a page.
#include "validate.h"

#include "commands.h"
#include "common_options.h"
#include "output.h"

#include <stdio.h>
#include <stdlib.h>

static const double DEFAULT_SECONDS = 540;
static const double QUICK_SECONDS = 60;

struct validate_arguments {
    struct option_arguments scenes;
    const char *html;
    struct option_number paths, seconds;
    bool is_json, is_quick, is_quiet;
    struct data_choice data;
};

static const char about[] =
    "Compares the models of the sky with a path tracer that shares no transport code\n"
    "with them: from the ground, 10 km and orbit, under suns from noon to 6 degrees\n"
    "below the horizon, in each SCENE (without one: Earth, Mars, Venus, Titan, dense\n"
    "air, as far as they are installed). The ground is the sphere of the scene's mean\n"
    "albedo; rasters are left out. The exit status is 1 when the spectral model is\n"
    "further off than 1 % in a view's mean or 2 % in a value, beyond the noise of the\n"
    "path tracer; views that are too noisy to tell are counted, and no failure.\n"
    "docs/testing.md explains the numbers.\n";
static const char examples[] = "  terrella validate --html report.html\n"
                               "  terrella validate scenes/earth.json --quick\n"
                               "  terrella validate scenes/mars.json --paths 20000 --json\n";

static enum options_outcome read_arguments(int argc, char **argv, struct validate_arguments *out)
{
    *out = (struct validate_arguments){.html = NULL};
    const struct option work[] = {
        option_paths(&out->paths, 2,
                     "Of the path tracer for each value, in every view, however long that takes. "
                     "Default: as many as there is time for, more where they are noisier."),
        {.name = "seconds",
         .kind = OPTION_NUMBER,
         .target.number = &out->seconds,
         .metavar = "S",
         .range = {1, 1e6},
         .help = "For the whole run. Default: 540, with --quick 60."},
        {.name = "quick",
         .kind = OPTION_FLAG,
         .target.flag = &out->is_quick,
         .help = "Three suns instead of five, and a minute instead of nine."},
    };
    const struct option result[] = {
        {.name = "html",
         .kind = OPTION_TEXT,
         .target.text = &out->html,
         .metavar = "FILE",
         .help = "Write a page with pictures and their differences too, in one file. Needs "
                 "OpenGL, as render does."},
        {.name = "json",
         .kind = OPTION_FLAG,
         .target.flag = &out->is_json,
         .help = "Print one JSON object instead of tables."},
        option_quiet(&out->is_quiet),
    };
    struct option data[DATA_OPTIONS];
    data_options_make(&out->data, data);
    const struct option_section sections[] = {{"Work", work, sizeof work / sizeof *work},
                                              {DATA_OPTIONS_HEADING, data, DATA_OPTIONS},
                                              {"Result", result, sizeof result / sizeof *result}};
    const struct option_spec spec = {.command = "validate",
                                     .positional = "[SCENE...]",
                                     .max_positionals = VALIDATE_MAX_SCENES,
                                     .about = about,
                                     .examples = examples,
                                     .sections = sections,
                                     .section_count = sizeof sections / sizeof *sections};
    return options_read(&spec, argc, argv, &out->scenes);
}

static enum exit_status load_scenes(struct validate *v, const struct option_arguments *words)
{
    v->is_shipped = words->count == 0;
    if (v->is_shipped) {
        return validate_load_shipped(v);
    }
    enum exit_status status = EXIT_OK;
    for (size_t i = 0; status == EXIT_OK && i < words->count; i++) {
        status = validate_load(v, words->positionals[i]);
    }
    return status;
}

static void judge_answer(struct validate_case *c, int model, int trials)
{
    struct validate_answer *answer = &c->answers[model];
    const struct judge_values values = {.answer = answer->radiance,
                                        .reference = c->reference,
                                        .standard_error = c->error,
                                        .count = c->count,
                                        .trials = trials};
    answer->judgement = judge(&values);
}

void validate_judge(struct validate *v)
{
    int trials = 0;
    for (int s = 0; s < v->scene_count; s++) {
        trials += v->scenes[s].case_count * VALIDATE_VALUES;
    }
    for (int s = 0; s < v->scene_count; s++) {
        for (int c = 0; c < v->scenes[s].case_count; c++) {
            for (int m = 0; m < VALIDATE_MODELS; m++) {
                judge_answer(&v->scenes[s].cases[c], m, trials);
            }
        }
    }
    v->spent_s = validate_spent_s(v);
}

static void add_case(const struct validate_case *c, int model, struct validate_total *total)
{
    const struct validate_answer *answer = &c->answers[model];
    if (!answer->is_there) {
        return;
    }
    const struct judgement *j = &answer->judgement;
    total->views++;
    total->bad += j->verdict == VERDICT_BAD;
    total->noisy += j->verdict == VERDICT_NOISY;
    total->mean_only += j->verdict == VERDICT_MEAN;
    total->good += j->verdict == VERDICT_GOOD;
    for (int i = 0; i < c->count; i++) {
        total->path_count += c->paths[i];
    }
    if (j->noise > JUDGE_KNOWN_NOISE) {
        return;
    }
    total->known++;
    total->signed_mean += (j->signed_mean - total->signed_mean) / total->known;
    total->variance += j->signed_noise * j->signed_noise;
    total->mean += (j->mean - total->mean) / total->known;
    total->largest = j->largest > total->largest ? j->largest : total->largest;
}

struct validate_total validate_sum(const struct validate *v, const struct validate_scene *scene,
                                   int model)
{
    struct validate_total total = {0};
    for (int s = 0; s < v->scene_count; s++) {
        const struct validate_scene *one = &v->scenes[s];
        for (int c = 0; (!scene || scene == one) && c < one->case_count; c++) {
            add_case(&one->cases[c], model, &total);
        }
    }
    return total;
}

static enum exit_status compare(struct validate *v, const struct validate_arguments *arguments)
{
    enum exit_status status = load_scenes(v, &arguments->scenes);
    if (status == EXIT_OK) {
        bench_machine_read(v->app->ctx, &v->machine);
        status = validate_ask_models(v);
    }
    if (status == EXIT_OK) {
        status = validate_probe(v);
    }
    if (status == EXIT_OK && v->wants_pictures) {
        status = validate_draw(v);
    }
    if (status == EXIT_OK && v->wants_pictures && v->is_shipped) {
        status = validate_check_clouds(v);
    }
    if (status == EXIT_OK) {
        status = validate_trace(v);
    }
    progress_set_part(&v->app->progress, "", 0, 0);
    progress_clear(&v->app->progress);
    if (status != EXIT_OK) {
        return status;
    }
    validate_judge(v);
    if (arguments->is_json) {
        status = validate_print_json(v);
    } else {
        validate_print_table(v);
    }
    return status == EXIT_OK && arguments->html ? validate_write_html(v, arguments->html) : status;
}

static enum exit_status run(struct app *app, const struct validate_arguments *arguments)
{
    struct validate *v = calloc(1, sizeof *v);
    if (!v) {
        return report_error(EXIT_FAILED, "validate: out of memory");
    }
    v->app = app;
    v->is_quick = arguments->is_quick;
    v->wants_pictures = arguments->html != NULL;
    v->paths = arguments->paths.value;
    v->budget_s = arguments->is_quick ? QUICK_SECONDS : DEFAULT_SECONDS;
    if (arguments->seconds.is_given) {
        v->budget_s = arguments->seconds.value;
    }
    enum exit_status status = compare(v, arguments);
    const struct validate_total total = validate_sum(v, NULL, TRL_SKY_SPECTRAL);
    if (status == EXIT_OK && total.bad > 0) {
        status =
            report_error(EXIT_FAILED, "the spectral model is outside its bounds in %d of %d views",
                         total.bad, total.views);
    }
    validate_finish(v);
    free(v);
    return status;
}

enum exit_status command_validate(int argc, char **argv)
{
    struct validate_arguments arguments;
    const enum options_outcome outcome = read_arguments(argc, argv, &arguments);
    if (outcome != OPTIONS_READ) {
        return outcome == OPTIONS_HELP ? EXIT_OK : EXIT_USAGE;
    }
    if (arguments.paths.is_given && arguments.seconds.is_given) {
        return report_error(EXIT_USAGE, "validate: --paths and --seconds cannot both be given");
    }
    struct app app;
    enum exit_status status =
        app_init(&app, &(struct app_desc){.is_quiet = arguments.is_quiet, .data = &arguments.data});
    if (status == EXIT_OK && arguments.html) {
        status = output_check_writable(arguments.html);
    }
    if (status == EXIT_OK) {
        status = run(&app, &arguments);
    }
    app_finish(&app);
    return status;
}
