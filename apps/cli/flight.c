// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "flight.h"

#include "shrink.h"
#include "viewer/fly.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STOPS_MAX = 32, NAME_MAX_LENGTH = 128 };

static const double default_fps = 25, default_leg_s = 10;
// No lower above the ground between views, unless both of them are.
static const double clearance_m = 30;
// What rises in the way is flown over from so long before it on.
static const double foresight_s = 1;

void flight_make_options(struct flight_arguments *arguments, struct option out[FLIGHT_OPTIONS])
{
    const struct option options[FLIGHT_OPTIONS] = {
        {.name = "to",
         .kind = OPTION_TEXT,
         .target.text = &arguments->to,
         .metavar = "VIEW[,VIEW...]",
         .help =
             "Fly there from --view, through all of them: many frames, as numbered pictures "
             "(-o flight-%04d.png or .exr) or a video (-o flight.mp4, .mkv, .mov or .webm, made "
             "by ffmpeg). Heights change by equal factors, and automatic exposure follows as "
             "the eye does. What replaces the camera of --view counts for the start alone, sun "
             "and exposure for all."},
        {.name = "seconds",
         .kind = OPTION_NUMBER,
         .target.number = &arguments->seconds,
         .metavar = "S",
         .range = {0.04, 86400},
         .help = "How long the flight takes. Default: 10 for each view of --to."},
        {.name = "fps",
         .kind = OPTION_NUMBER,
         .target.number = &arguments->fps,
         .metavar = "N",
         .range = {1, 240},
         .help = "Frames per second of it. Default: 25."},
    };
    memcpy(out, options, sizeof options);
}

enum exit_status flight_check(const struct flight_arguments *arguments)
{
    if (!arguments->to && (arguments->seconds.is_given || arguments->fps.is_given)) {
        return report_error(EXIT_USAGE, "render: --%s is for a flight; it needs --to",
                            arguments->seconds.is_given ? "seconds" : "fps");
    }
    return EXIT_OK;
}

static int count_legs(const char *to)
{
    int legs = 1;
    for (; *to; to++) {
        legs += *to == ',';
    }
    return legs;
}

double flight_fps(const struct flight_arguments *arguments)
{
    return arguments->fps.is_given ? arguments->fps.value : default_fps;
}

static double find_seconds(const struct flight_arguments *arguments)
{
    return arguments->seconds.is_given ? arguments->seconds.value
                                       : default_leg_s * count_legs(arguments->to);
}

uint32_t flight_frame_count(const struct flight_arguments *arguments)
{
    return (uint32_t)fmax(2, round(find_seconds(arguments) * flight_fps(arguments)));
}

struct plan {
    struct fly_flight legs[STOPS_MAX];
    int count;
    double whole_s; // as planned
    double least_m; // above the ground; the ends may be lower
};

static double find_ground_m(const struct flight_desc *desc, const trl_view *view)
{
    return trl_renderer_ground_altitude_m(desc->renderer, view->latitude_rad, view->longitude_rad);
}

// A view of the scene by `name`; NULL: the choice's own, with its camera.
static enum exit_status find_stop(const struct flight_desc *desc, const char *name, trl_view *out)
{
    struct view_choice choice = *desc->choice;
    if (name) {
        const struct option_number none = {0};
        choice.name = name;
        choice.latitude_deg = choice.longitude_deg = choice.altitude_m = choice.height_m = none;
        choice.heading_deg = choice.pitch_deg = choice.roll_deg = choice.fov_deg = none;
    }
    trl_view view;
    const enum exit_status status = view_choice_apply(&choice, desc->scene, &view);
    return status == EXIT_OK ? report_result(trl_renderer_resolve(desc->renderer, &view, out))
                             : status;
}

static enum exit_status add_leg(const struct flight_desc *desc, const trl_view *from,
                                const trl_view *to, struct plan *plan)
{
    if (plan->count == STOPS_MAX) {
        return report_error(EXIT_USAGE, "render: --to: at most %d views", STOPS_MAX);
    }
    struct fly_flight *leg = &plan->legs[plan->count++];
    *leg = fly_flight_plan(from, to, trl_scene_ground_radius_m(desc->scene));
    leg->from_ground_m = find_ground_m(desc, from);
    leg->to_ground_m = find_ground_m(desc, to);
    plan->whole_s += leg->duration_s;
    const double from_m = from->altitude_m - leg->from_ground_m;
    const double to_m = to->altitude_m - leg->to_ground_m;
    plan->least_m = fmin(plan->least_m, 0.5 * fmin(from_m, to_m));
    return EXIT_OK;
}

static enum exit_status make_plan(const struct flight_desc *desc, struct plan *plan)
{
    trl_view from, to;
    enum exit_status status = find_stop(desc, NULL, &from);
    const char *next = desc->arguments->to;
    while (next && status == EXIT_OK) {
        char name[NAME_MAX_LENGTH];
        const size_t length = strcspn(next, ",");
        snprintf(name, sizeof name, "%.*s", (int)length, next);
        next = next[length] ? next + length + 1 : NULL;
        status = find_stop(desc, name, &to);
        if (status == EXIT_OK) {
            status = add_leg(desc, &from, &to, plan);
        }
        from = to;
    }
    return status;
}

// `part` of the whole flight, in [0, 1]: each leg has its share of the time.
static trl_view find_view(const struct plan *plan, double part)
{
    double at_s = part * plan->whole_s;
    int leg = 0;
    while (leg + 1 < plan->count && at_s > plan->legs[leg].duration_s) {
        at_s -= plan->legs[leg++].duration_s;
    }
    return fly_flight_view(&plan->legs[leg], at_s);
}

// How much higher a camera has to be there.
static double find_lack(const struct flight_desc *desc, const struct plan *plan,
                        const trl_view *view)
{
    return fmax(0, find_ground_m(desc, view) + fmax(plan->least_m, fly_clearance_m / 2) -
                       view->altitude_m);
}

static int clamp_frame(int frame, int frames)
{
    return frame < 0 ? 0 : frame >= frames ? frames - 1 : frame;
}

// Lifts the way smoothly above what stands in it: the mean over +-reach frames of the largest lack
// within +-reach of each is no less than what the frame itself lacks. Both ends are views, and
// stay. `most_m` has room for a number a frame.
struct lift {
    double *lack_m, *most_m;
    int frames, reach;
};
static void lift_way(const struct lift *l, trl_view *views)
{
    for (int i = 0; i < l->frames; i++) {
        l->most_m[i] = 0;
        for (int k = i - l->reach; k <= i + l->reach; k++) {
            l->most_m[i] = fmax(l->most_m[i], l->lack_m[clamp_frame(k, l->frames)]);
        }
    }
    for (int i = 0; i < l->frames; i++) {
        double sum_m = 0;
        for (int j = i - l->reach; j <= i + l->reach; j++) {
            sum_m += l->most_m[clamp_frame(j, l->frames)];
        }
        const double t = fmin(1, fmin(i, l->frames - 1 - i) / (double)l->reach);
        const double lift_m = sum_m / (2 * l->reach + 1) * t * t * (3 - 2 * t);
        views[i].altitude_m += fmax(l->lack_m[i], lift_m);
    }
}

// free() it. NULL is reported.
static trl_view *make_way(const struct flight_desc *desc, const struct plan *plan, int frames)
{
    trl_view *views = calloc((size_t)frames, sizeof *views);
    double *lack_m = calloc(2 * (size_t)frames, sizeof *lack_m);
    if (views && lack_m) {
        bool is_lifted = false;
        for (int i = 0; i < frames; i++) {
            views[i] = find_view(plan, i / (double)(frames - 1));
            lack_m[i] = find_lack(desc, plan, &views[i]);
            is_lifted = is_lifted || lack_m[i] > 0;
        }
        const double reach = fmin(foresight_s * flight_fps(desc->arguments), frames / 8.0);
        const struct lift lift = {lack_m, lack_m + frames, frames, (int)fmax(1, reach)};
        if (is_lifted) {
            lift_way(&lift, views);
        }
    } else {
        free(views);
        views = NULL;
        report_error(EXIT_FAILED, "%d frames: out of memory", frames);
    }
    free(lack_m);
    return views;
}

static trl_result read_frame(const struct flight_desc *desc, void *pixels)
{
    const struct film_desc *film = &desc->film->desc;
    const bool is_exr = film->kind == FILM_EXR;
    const trl_result result = is_exr ? trl_renderer_read_radiance(desc->renderer, pixels)
                                     : trl_renderer_read_rgba8(desc->renderer, pixels);
    if (result == TRL_OK && desc->samples > 1 && is_exr) {
        shrink_radiance(pixels, film->size.width, film->size.height, desc->samples);
    } else if (result == TRL_OK && desc->samples > 1) {
        shrink_srgb(pixels, film->size.width, film->size.height, desc->samples);
    }
    return result;
}

static enum exit_status draw_frames(const struct flight_desc *desc, const trl_view *views,
                                    void *pixels)
{
    const struct film_desc *film = &desc->film->desc;
    const uint32_t frames = flight_frame_count(desc->arguments);
    const uint32_t width = film->size.width * desc->samples;
    const uint32_t height = film->size.height * desc->samples;
    struct progress *progress = &desc->app->progress;
    enum exit_status status = EXIT_OK;
    progress->started_s = progress_clock_s(); // the time left is told from here on
    for (uint32_t i = 0; i < frames && status == EXIT_OK; i++) {
        progress_set_part(progress, "flight", i / (double)frames, (i + 1.0) / frames);
        if (!progress_report(progress, "flight", 0)) {
            return report_error(EXIT_FAILED, "cancelled after %u of %u frames", i, frames);
        }
        // The first is exposed at once, the others as the eye follows.
        const double elapsed_s = i > 0 ? 1 / film->fps : 0;
        trl_result result = trl_renderer_draw(desc->renderer, &views[i], width, height, elapsed_s);
        result = result == TRL_OK ? read_frame(desc, pixels) : result;
        status = report_result(result);
        status = status == EXIT_OK ? film_add(desc->film, pixels) : status;
    }
    progress_set_part(progress, "", 0, 0);
    return status;
}

enum exit_status flight_draw(const struct flight_desc *desc)
{
    struct plan plan = {.least_m = clearance_m};
    const double begun_s = desc->app->progress.started_s;
    enum exit_status status = make_plan(desc, &plan);
    if (status != EXIT_OK) {
        return status;
    }
    trl_view *views = make_way(desc, &plan, (int)flight_frame_count(desc->arguments));
    const size_t bytes = film_frame_bytes(&desc->film->desc) * desc->samples * desc->samples;
    void *pixels = malloc(bytes);
    if (!views) {
        status = EXIT_FAILED;
    } else if (!pixels) {
        status = report_error(EXIT_FAILED, "frames: out of memory");
    } else {
        status = draw_frames(desc, views, pixels);
    }
    desc->app->progress.started_s = begun_s;
    progress_clear(&desc->app->progress);
    free(views);
    free(pixels);
    return status;
}
