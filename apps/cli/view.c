// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella view: the window. The flying itself is in apps/viewer.
#include "app.h"
#include "commands.h"
#include "common_options.h"
#include "interrupt.h"
#include "output.h"
#include "view_options.h"
#include "viewer/viewer.h"

#include <strings.h>

struct view_arguments {
    const char *scene;
    const char *screenshot;
    struct number_size size;
    struct option_number frames;
    struct view_choice view;
    bool is_quiet;
};

static const char about[] =
    "Opens SCENE in a window and flies through it, from orbit to the ground.\n\n" VIEWER_KEYS;
static const char examples[] =
    "  terrella view scenes/earth.json --view himalaya-morning\n"
    "  xvfb-run terrella view scenes/earth.json --frames 1 --screenshot window.png\n";

static enum options_outcome read_arguments(int argc, char **argv, struct view_arguments *out)
{
    *out = (struct view_arguments){.size = {1280, 720}, .view = view_choice_default()};
    const struct option window[] = {
        {.name = "size",
         .kind = OPTION_SIZE,
         .target.size = &out->size,
         .metavar = "WxH",
         .help = "Width and height of the window in pixels. Default: 1280x720."},
        {.name = "frames",
         .kind = OPTION_NUMBER,
         .target.number = &out->frames,
         .metavar = "N",
         .range = {1.0, 1e9},
         .is_whole = true,
         .help = "Quit after N frames. Default: never."},
        {.name = "screenshot",
         .kind = OPTION_TEXT,
         .target.text = &out->screenshot,
         .metavar = "FILE.png",
         .help = "Write the last frame before quitting; without --frames the first one is the "
                 "last."},
        option_quiet(&out->is_quiet),
    };
    const struct view_command command = {
        .name = "view",
        .about = about,
        .examples = examples,
        .own = {"Window", window, sizeof window / sizeof window[0]},
        .scene = &out->scene,
        .choice = &out->view,
    };
    return view_command_read(&command, argc, argv);
}

static enum exit_status check_screenshot(const char *path)
{
    if (!path) {
        return EXIT_OK;
    }
    if (strcasecmp(output_suffix(path), "png") != 0) {
        return report_error(EXIT_USAGE, "view: --screenshot: '%s' does not end with .png", path);
    }
    return output_check_writable(path);
}

static enum exit_status open_window(struct app *app, const struct view_arguments *arguments)
{
    trl_scene *scene = NULL;
    trl_view view;
    enum exit_status status = report_result(trl_scene_load(app->ctx, arguments->scene, &scene));
    if (status == EXIT_OK) {
        status = view_choice_apply(&arguments->view, scene, &view);
    }
    if (status == EXIT_OK) {
        const trl_rayleigh_desc rayleigh =
            rayleigh_choice_resolve(&arguments->view.rayleigh, scene);
        const double frames = arguments->frames.is_given ? arguments->frames.value : 0.0;
        struct viewer_desc desc = {
            .ctx = app->ctx,
            .scene = scene,
            .scene_path = arguments->scene,
            .sky_model = arguments->view.sky_model,
            .air = (trl_air)arguments->view.air,
            .mesher = mesher_option_get(&arguments->view.mesher),
            .projective = mesher_option_get_projective(&arguments->view.mesher),
            .mesh_error_px = mesher_option_get_error_px(&arguments->view.mesher),
            .rayleigh = &rayleigh,
            .view = view,
            .width = arguments->size.width,
            .height = arguments->size.height,
            .frame_limit = (uint64_t)frames,
            .screenshot = arguments->screenshot,
            .is_stopped = interrupt_is_pending};
        if (desc.screenshot && desc.frame_limit == 0) {
            desc.frame_limit = 1;
        }
        char message[VIEWER_MESSAGE_MAX] = "";
        const trl_result result = viewer_run(&desc, message);
        progress_clear(&app->progress);
        status = *message ? report_error(EXIT_FAILED, "%s", message) : report_result(result);
    }
    trl_scene_destroy(&scene);
    return status;
}

enum exit_status command_view(int argc, char **argv)
{
    struct view_arguments arguments;
    const enum options_outcome outcome = read_arguments(argc, argv, &arguments);
    if (outcome != OPTIONS_READ) {
        return outcome == OPTIONS_HELP ? EXIT_OK : EXIT_USAGE;
    }
    enum exit_status status = check_screenshot(arguments.screenshot);
    if (status == EXIT_OK) {
        status = mesher_option_check(&arguments.view.mesher, "view");
    }
    if (status == EXIT_OK) {
        status = rayleigh_choice_check(&arguments.view.rayleigh);
    }
    if (status != EXIT_OK) {
        return status;
    }
    struct app app;
    status = app_init(
        &app, &(struct app_desc){.is_quiet = arguments.is_quiet, .data = &arguments.view.data});
    if (status == EXIT_OK) {
        status = open_window(&app, &arguments);
    }
    app_finish(&app);
    return status;
}
