// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella render: one picture of a scene, or those of a flight.
#include "app.h"
#include "commands.h"
#include "compare.h"
#include "flight.h"
#include "output.h"
#include "render_reference.h"
#include "shrink.h"
#include "view_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { TIMINGS_MAX = 64, DRAWN_OPTIONS = 8 };
static const char default_output[] = "terrella.png";

struct render_arguments {
    const char *scene;
    const char *output;
    struct number_size size;
    struct option_number samples;
    struct view_choice view;
    int spectrum;        // a trl_spectrum
    const char *compare; // models between commas; NULL: one picture
    struct compare_models models;
    struct traced_arguments traced;
    struct flight_arguments flight;
    bool lists_views;
    bool shows_timings;
    bool is_quiet;
};

enum picture_format { PICTURE_PNG, PICTURE_EXR };

static const char about[] =
    "Draws SCENE (a JSON file) and writes the picture. Needs neither display nor GPU.\n"
    "A .png is exposed and tone-mapped; a .exr holds linear light before exposure, in\n"
    "cd/m2 with sRGB primaries, as 32-bit floats.\n";
static const char examples[] =
    "  terrella render scenes/earth.json --view himalaya-morning --size 1920x1080 \\\n"
    "      -o himalaya.png\n"
    "  terrella render scenes/earth.json --view orbit --sun-elevation 10 \\\n"
    "      --sun-azimuth 90 -o orbit.exr\n"
    "  terrella render scenes/earth.json --view limb --compare spectral,single\n"
    "  terrella render scenes/earth.json --view orbit --size 320x180 \\\n"
    "      --reference --paths 256 -o traced.exr --error error.exr\n"
    "  terrella render scenes/mars.json --view gale-from-above --to gale-inset \\\n"
    "      --seconds 20 -o gale.mp4\n";

// In the order of trl_spectrum.
static const char *const spectrum_words[] = {"full", "rgb", NULL};

static void make_options(struct render_arguments *out, struct option options[])
{
    const struct option drawn[DRAWN_OPTIONS] = {
        {.name = "output",
         .letter = 'o',
         .kind = OPTION_TEXT,
         .target.text = &out->output,
         .metavar = "FILE",
         .help = "Where to write; .png or .exr. Default: terrella.png. With --to, see there."},
        {.name = "size",
         .kind = OPTION_SIZE,
         .target.size = &out->size,
         .metavar = "WxH",
         .help = "Width and height in pixels. Default: 1280x720; with --compare, of each model's "
                 "picture, 640x360."},
        {.name = "samples",
         .kind = OPTION_NUMBER,
         .target.number = &out->samples,
         .metavar = "N",
         .range = {1, 4},
         .is_whole = true,
         .help = "Draw N x N times the pixels and average: smooth edges. 1 to 4. Default: 1."},
        {.name = "spectrum",
         .kind = OPTION_CHOICE,
         .target.choice = &out->spectrum,
         .choices = spectrum_words,
         .metavar = "NAME",
         .help = "Of the spectral sky: full (16 wavelengths) or rgb (one each of red, green and "
                 "blue, to see what that costs in colour). Default: full."},
        {.name = "compare",
         .kind = OPTION_TEXT,
         .target.text = &out->compare,
         .metavar = "MODELS",
         .help = "The same view by several models of the sky (see --sky-model), as in "
                 "spectral,single,rayleigh: side by side with one exposure, and below how the "
                 "luminance of the others differs from the first's. A .exr holds the radiances "
                 "and below them the differences as shares, without words."},
        {.name = "views",
         .kind = OPTION_FLAG,
         .target.flag = &out->lists_views,
         .help = "List the scene's views and draw nothing."},
        {.name = "timings",
         .kind = OPTION_FLAG,
         .target.flag = &out->shows_timings,
         .help = "Print how long each pass of the frame took."},
        {.name = "quiet",
         .letter = 'q',
         .kind = OPTION_FLAG,
         .target.flag = &out->is_quiet,
         .help = "No progress line and no closing line."},
    };
    memcpy(options, drawn, sizeof drawn);
    traced_make_options(&out->traced, options + DRAWN_OPTIONS);
    flight_make_options(&out->flight, options + DRAWN_OPTIONS + TRACED_OPTIONS);
}

static enum options_outcome read_arguments(int argc, char **argv, struct render_arguments *out)
{
    *out = (struct render_arguments){
        .output = default_output, .samples = {.value = 1}, .view = view_choice_default()};
    struct option picture[DRAWN_OPTIONS + TRACED_OPTIONS + FLIGHT_OPTIONS];
    make_options(out, picture);
    const struct view_command command = {
        .name = "render",
        .about = about,
        .examples = examples,
        .own = {"Picture", picture, sizeof picture / sizeof picture[0]},
        .scene = &out->scene,
        .choice = &out->view,
    };
    return view_command_read(&command, argc, argv);
}

static enum exit_status choose_format(const char *path, enum picture_format *out)
{
    const char *suffix = output_suffix(path);
    if (strcasecmp(suffix, "png") == 0) {
        *out = PICTURE_PNG;
        return EXIT_OK;
    }
    if (strcasecmp(suffix, "exr") == 0) {
        *out = PICTURE_EXR;
        return EXIT_OK;
    }
    return report_error(EXIT_USAGE, "render: --output: '%s' ends neither with .png nor with .exr",
                        path);
}

// What contradicts itself, and what depends on it.
static enum exit_status complete_arguments(struct render_arguments *arguments)
{
    enum exit_status status = EXIT_OK;
    if (arguments->compare) {
        status = compare_models_parse(arguments->compare, &arguments->models);
    }
    if (status == EXIT_OK && arguments->compare && arguments->shows_timings) {
        status = report_error(EXIT_USAGE, "render: --compare and --timings cannot both be given");
    }
    if (status == EXIT_OK && arguments->spectrum != TRL_SPECTRUM_FULL &&
        (arguments->compare || arguments->traced.is_wanted)) {
        status = report_error(EXIT_USAGE, "render: --spectrum rgb goes with neither --compare nor "
                                          "--reference");
    }
    if (status == EXIT_OK && arguments->compare &&
        arguments->view.sky_model != TRL_SKY_MODEL_OF_SCENE) {
        status = report_error(EXIT_USAGE, "render: --compare and --sky-model cannot both be given");
    }
    const int model = arguments->view.sky_model;
    const bool knows_orders = model == TRL_SKY_MODEL_OF_SCENE || model == TRL_SKY_SPECTRAL;
    if (status == EXIT_OK && arguments->traced.orders.is_given &&
        (arguments->compare || !knows_orders)) {
        status = report_error(EXIT_USAGE, "render: --orders is for the spectral sky and "
                                          "--reference; other models have one order");
    }
    if (arguments->size.width == 0) {
        arguments->size =
            arguments->compare ? (struct number_size){640, 360} : (struct number_size){1280, 720};
    }
    return status;
}

static void print_views(const trl_scene *scene)
{
    for (size_t i = 0; i < trl_scene_view_count(scene); i++) {
        printf("%s\n", trl_scene_view_name(scene, i));
    }
}

static void print_timings(const trl_renderer *renderer)
{
    trl_timing rows[TIMINGS_MAX];
    const size_t all = trl_renderer_timings(renderer, rows, TIMINGS_MAX);
    const size_t count = all < TIMINGS_MAX ? all : TIMINGS_MAX;
    double gpu_ms = 0.0;
    double cpu_ms = 0.0;
    printf("%-20s %10s %10s\n", "pass", "GPU ms", "CPU ms");
    for (size_t i = 0; i < count; i++) {
        printf("%-20s %10.2f %10.2f\n", rows[i].name, rows[i].gpu_ms, rows[i].cpu_ms);
        gpu_ms += rows[i].gpu_ms;
        cpu_ms += rows[i].cpu_ms;
    }
    printf("%-20s %10.2f %10.2f\n", "all", gpu_ms, cpu_ms);
}

// What is drawn: the picture, or a larger one that is averaged.
static uint32_t sample_count(const struct render_arguments *arguments)
{
    return (uint32_t)arguments->samples.value;
}

// Reads what was drawn, averages it, and writes it.
static trl_result write_picture(struct app *app, trl_renderer *renderer,
                                const struct render_arguments *arguments,
                                enum picture_format format)
{
    const struct number_size size = arguments->size;
    const uint32_t samples = sample_count(arguments);
    const size_t values = (size_t)size.width * samples * size.height * samples * 4;
    void *pixels = malloc(values * (format == PICTURE_EXR ? sizeof(float) : 1));
    if (!pixels) {
        report_error(EXIT_FAILED, "%ux%u: out of memory", size.width, size.height);
        return TRL_ERROR_MEMORY;
    }
    trl_result result;
    if (format == PICTURE_EXR) {
        result = trl_renderer_read_radiance(renderer, pixels);
        if (result == TRL_OK && samples > 1) {
            shrink_radiance(pixels, size.width, size.height, samples);
        }
        if (result == TRL_OK) {
            result =
                trl_image_write_exr(app->ctx, arguments->output, size.width, size.height, pixels);
        }
    } else {
        result = trl_renderer_read_rgba8(renderer, pixels);
        if (result == TRL_OK && samples > 1) {
            shrink_srgb(pixels, size.width, size.height, samples);
        }
        if (result == TRL_OK) {
            result =
                trl_image_write_png(app->ctx, arguments->output, size.width, size.height, pixels);
        }
    }
    free(pixels);
    return result;
}

static trl_result make_renderer(struct app *app, const trl_scene *scene,
                                const struct render_arguments *arguments, trl_renderer **out)
{
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    desc.sky_model = arguments->view.sky_model;
    desc.air = (trl_air)arguments->view.air;
    desc.mesher = mesher_option_get(&arguments->view.mesher);
    desc.projective = mesher_option_get_projective(&arguments->view.mesher);
    desc.mesh_error_px = mesher_option_get_error_px(&arguments->view.mesher);
    const trl_rayleigh_desc rayleigh = rayleigh_choice_resolve(&arguments->view.rayleigh, scene);
    desc.rayleigh = &rayleigh;
    desc.spectrum = (trl_spectrum)arguments->spectrum;
    desc.max_orders = traced_max_orders(&arguments->traced);
    desc.measures_time = arguments->shows_timings;
    return trl_renderer_create(app->ctx, &desc, out);
}

static trl_result draw_picture(struct app *app, const trl_scene *scene, const trl_view *view,
                               const struct render_arguments *arguments, enum picture_format format)
{
    trl_renderer *renderer = NULL;
    trl_result result = make_renderer(app, scene, arguments, &renderer);
    // The driver compiles in the first frame: the times that are worth telling are a later one's.
    const int frames = arguments->shows_timings ? 2 : 1;
    const uint32_t samples = sample_count(arguments);
    for (int i = 0; result == TRL_OK && i < frames; i++) {
        result = trl_renderer_draw(renderer, view, arguments->size.width * samples,
                                   arguments->size.height * samples, 0.0);
    }
    // The last moment to be stopped: what follows takes no time and writes the file.
    if (result == TRL_OK && !progress_report(&app->progress, "writing", 0.0)) {
        report_error(EXIT_FAILED, "cancelled before writing %s", arguments->output);
        result = TRL_ERROR_CANCELLED;
    }
    if (result == TRL_OK) {
        result = write_picture(app, renderer, arguments, format);
    }
    progress_clear(&app->progress);
    if (result == TRL_OK && arguments->shows_timings) {
        print_timings(renderer);
    }
    trl_renderer_destroy(&renderer);
    return result;
}

static enum exit_status draw_flight(struct app *app, const trl_scene *scene,
                                    const struct render_arguments *arguments)
{
    const double fps = flight_fps(&arguments->flight);
    struct film_desc desc = {.path = arguments->output, .size = arguments->size, .fps = fps};
    trl_renderer *renderer = NULL;
    struct film film = {.pipe = -1};
    enum exit_status status = film_choose(desc.path, &desc.kind);
    if (status == EXIT_OK) {
        status = film_begin(app->ctx, &desc, &film);
    }
    if (status == EXIT_OK) {
        status = report_result(make_renderer(app, scene, arguments, &renderer));
    }
    if (status == EXIT_OK) {
        const struct flight_desc flight = {.app = app,
                                           .scene = scene,
                                           .renderer = renderer,
                                           .arguments = &arguments->flight,
                                           .choice = &arguments->view,
                                           .film = &film,
                                           .samples = sample_count(arguments)};
        status = flight_draw(&flight);
    }
    if (status == EXIT_OK) {
        status = film_commit(&film);
    }
    film_abort(&film);
    trl_renderer_destroy(&renderer);
    if (status == EXIT_OK && !arguments->is_quiet) {
        printf("wrote %s: %u frames of %ux%u, %g per second, %.1f s\n", arguments->output,
               flight_frame_count(&arguments->flight), desc.size.width, desc.size.height, fps,
               progress_clock_s() - app->progress.started_s);
    }
    return status;
}

// The sheet of several models.
static struct compare_desc make_comparison(struct app *app, const trl_scene *scene,
                                           const trl_view *view,
                                           const struct render_arguments *arguments)
{
    const char *name = arguments->view.name;
    if (!name) {
        name = trl_scene_view_count(scene) > 0 ? trl_scene_view_name(scene, 0) : "";
    }
    return (struct compare_desc){
        .app = app,
        .scene = scene,
        .view = view,
        .view_name = name,
        .models = arguments->models,
        .size = arguments->size,
        .rayleigh = rayleigh_choice_resolve(&arguments->view.rayleigh, scene),
        .mesher = mesher_option_get(&arguments->view.mesher),
        .projective = mesher_option_get_projective(&arguments->view.mesher),
        .mesh_error_px = mesher_option_get_error_px(&arguments->view.mesher),
        .samples = sample_count(arguments),
        .output = arguments->output,
        .is_exr = strcasecmp(output_suffix(arguments->output), "exr") == 0};
}

static enum exit_status render_scene(struct app *app, const trl_scene *scene,
                                     const struct render_arguments *arguments)
{
    struct number_size size = arguments->size;
    enum picture_format format = PICTURE_PNG;
    trl_view view;
    enum exit_status status = choose_format(arguments->output, &format);
    if (status == EXIT_OK) {
        status = view_choice_apply(&arguments->view, scene, &view);
    }
    if (status == EXIT_OK) {
        status = output_check_writable(arguments->output);
    }
    if (status == EXIT_OK && arguments->traced.error) {
        status = output_check_writable(arguments->traced.error);
    }
    if (status == EXIT_OK && arguments->compare) {
        const struct compare_desc sheet = make_comparison(app, scene, &view, arguments);
        status = report_result(compare_write(&sheet, arguments->is_quiet ? NULL : stdout));
        size = compare_sheet_size(&sheet);
    } else if (status == EXIT_OK && arguments->traced.is_wanted) {
        const struct traced_picture picture = {scene, &view, arguments->size, arguments->output,
                                               format == PICTURE_EXR};
        status = report_result(traced_draw(app, &arguments->traced, &picture));
        progress_clear(&app->progress);
    } else if (status == EXIT_OK) {
        status = report_result(draw_picture(app, scene, &view, arguments, format));
    }
    if (status == EXIT_OK && !arguments->is_quiet) {
        printf("wrote %s: %ux%u, %.1f s\n", arguments->output, size.width, size.height,
               progress_clock_s() - app->progress.started_s);
    }
    return status;
}

// Of a flight, or of one picture.
static enum exit_status check_output(const struct render_arguments *arguments)
{
    if (!arguments->flight.to) {
        enum picture_format format;
        return choose_format(arguments->output, &format);
    }
    if (arguments->compare || arguments->traced.is_wanted || arguments->shows_timings) {
        return report_error(EXIT_USAGE, "render: --to goes with none of --compare, --reference and "
                                        "--timings");
    }
    enum film_kind kind;
    const enum exit_status status = film_choose(arguments->output, &kind);
    return status == EXIT_OK ? film_check_size(kind, arguments->size) : status;
}

static enum exit_status check_arguments(const struct render_arguments *arguments)
{
    const bool is_drawn =
        arguments->compare || arguments->shows_timings || arguments->samples.value > 1 ||
        arguments->view.sky_model != TRL_SKY_MODEL_OF_SCENE || arguments->view.mesher.mesher >= 0;
    if (arguments->traced.is_wanted && is_drawn) {
        return report_error(EXIT_USAGE, "render: --reference cannot be given with --compare, "
                                        "--samples, --timings, --sky-model or --mesher");
    }
    enum exit_status status = mesher_option_check(&arguments->view.mesher, "render");
    status = status == EXIT_OK ? flight_check(&arguments->flight) : status;
    status = status == EXIT_OK ? check_output(arguments) : status;
    status = status == EXIT_OK ? rayleigh_choice_check(&arguments->view.rayleigh) : status;
    return status == EXIT_OK ? traced_check(&arguments->traced) : status;
}

enum exit_status command_render(int argc, char **argv)
{
    struct render_arguments arguments;
    const enum options_outcome outcome = read_arguments(argc, argv, &arguments);
    if (outcome != OPTIONS_READ) {
        return outcome == OPTIONS_HELP ? EXIT_OK : EXIT_USAGE;
    }
    if (complete_arguments(&arguments) != EXIT_OK || check_arguments(&arguments) != EXIT_OK) {
        return EXIT_USAGE;
    }
    struct app app;
    enum exit_status status = app_init(
        &app, &(struct app_desc){.is_quiet = arguments.is_quiet, .data = &arguments.view.data});
    trl_scene *scene = NULL;
    if (status == EXIT_OK) {
        status = report_result(trl_scene_load(app.ctx, arguments.scene, &scene));
    }
    if (status == EXIT_OK && arguments.lists_views) {
        print_views(scene);
    } else if (status == EXIT_OK && arguments.flight.to) {
        status = draw_flight(&app, scene, &arguments);
    } else if (status == EXIT_OK) {
        status = render_scene(&app, scene, &arguments);
    }
    trl_scene_destroy(&scene);
    app_finish(&app);
    return status;
}
