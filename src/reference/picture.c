// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/picture.h"

#include "reference/palette.h"

#include <math.h>
#include <omp.h>

// Paths of the calling thread between two looks at whether somebody wants to stop.
enum { PATHS_A_LOOK = 128 };

struct studio {
    const trl_context *ctx;
    const struct reference_picture *picture;
    struct reference_world world;
    struct palette palette;
    struct reference_tracer tracers[PALETTE_GROUPS];
    struct reference_under_tables *under[PALETTE_GROUPS]; // NULL: the eye is in the air
    struct reference_scratches scratches;
    uint64_t parts_done;   // groups of pixels, by all threads
    bool is_stopped;       // set by the calling thread, read by all
    uint64_t paths_traced; // by the calling thread
    trl_result result;     // for the calling thread
};

static void set_up_tracer(struct studio *studio, int group)
{
    const struct palette *palette = &studio->palette;
    double nm[REFERENCE_LANES];
    for (int k = 0; k < REFERENCE_LANES; ++k) {
        nm[k] = palette->nm[palette_bin(group, k)];
    }
    struct reference_tracer *tracer = &studio->tracers[group];
    *tracer = reference_tracer_make(&studio->world, nm, REFERENCE_LANES);
    tracer->max_order = studio->picture->max_order;
    const struct reference_surface *surface = studio->world.scene.surface;
    for (int k = 0; k < REFERENCE_LANES; ++k) {
        for (int c = 0; c < 3; ++c) {
            tracer->colour_albedo[c][k] = palette->albedo_of_colour[c][palette_bin(group, k)];
        }
        tracer->glow[k] =
            surface && palette->luminance > 0 ? surface->white_cd_m2 / palette->luminance : 0;
    }
}

static void studio_finish(struct studio *studio)
{
    for (int group = 0; group < PALETTE_GROUPS; ++group) {
        reference_under_tables_destroy(studio->ctx, &studio->under[group]);
    }
    reference_scratches_finish(studio->ctx, &studio->scratches);
    reference_world_finish(studio->ctx, &studio->world);
}

static trl_result make_under(struct studio *studio)
{
    const struct reference_surface *surface = studio->world.scene.surface;
    trl_result result = TRL_OK;
    for (int group = 0; group < PALETTE_GROUPS && surface && result == TRL_OK; ++group) {
        if (surface->under.is_there) {
            result = reference_under_tables_make(studio->ctx, &surface->under,
                                                 &studio->tracers[group].nm, REFERENCE_LANES,
                                                 &studio->under[group]);
        }
    }
    return result;
}

static trl_result studio_init(const trl_context *ctx, const struct reference_scene *scene,
                              const struct reference_picture *picture, struct studio *studio)
{
    *studio = (struct studio){.ctx = ctx, .picture = picture};
    palette_make(scene->medium, &studio->palette);
    const struct reference_wavelengths wavelengths = {studio->palette.nm, PALETTE_BINS};
    trl_result result = reference_world_init(ctx, scene, &wavelengths, &studio->world);
    if (result != TRL_OK) {
        return result;
    }
    for (int group = 0; group < PALETTE_GROUPS; ++group) {
        set_up_tracer(studio, group);
    }
    result = make_under(studio);
    if (result == TRL_OK) {
        result = reference_scratches_init(ctx, &studio->world.air, &studio->scratches);
    }
    if (result != TRL_OK) {
        studio_finish(studio);
    }
    return result;
}

// Light of the star's disc itself, through what is before it. Limb darkening of a grey atmosphere
// in radiative equilibrium (Eddington): (2 + 3 cos) / 5, here relative to its mean over the disc,
// 4/5.
static lanes4 see_star(const struct reference_tracer *tracer, struct reference_path *path,
                       bool is_in_air)
{
    const struct reference_star *star = &path->star;
    if (!(vec3_dot(path->direction, star->direction) > star->cos_radius)) {
        return lanes4_set(0);
    }
    const double sine = vec3_length(vec3_cross(path->direction, star->direction));
    const double sine2_radius = (1 - star->cos_radius) * (1 + star->cos_radius);
    const double cosine = sqrt(fmax(0, 1 - sine * sine / sine2_radius));
    const double radiance = (0.5 + 0.75 * cosine) / (3.14159265358979323846 * sine2_radius);
    if (is_in_air) {
        return reference_transmittance(tracer, path, path->direction) * radiance;
    }
    const bool is_hidden = reference_star_is_hidden(star, path->position, path->direction);
    return lanes4_set(is_hidden ? 0 : radiance);
}

// Linear sRGB in cd m^-2 of one path, as if its wavelengths were all.
static void trace_colour(const struct studio *studio, int group, struct reference_scratch *scratch,
                         struct reference_path *path, double rgb[3])
{
    const struct reference_tracer *tracer = &studio->tracers[group];
    lanes4 radiance = {0};
    if (studio->under[group]) {
        reference_under_trace(studio->under[group], tracer, scratch, path);
        radiance = path->radiance;
    } else {
        const bool is_in_air = reference_enter(&studio->world, path);
        radiance = see_star(tracer, path, is_in_air);
        if (is_in_air) {
            reference_trace(tracer, scratch, path);
            radiance += path->radiance;
        }
    }
    for (int c = 0; c < 3; ++c) {
        rgb[c] = 0;
        for (int k = 0; k < REFERENCE_LANES; ++k) {
            rgb[c] += radiance[k] * studio->palette.rgb[palette_bin(group, k)][c];
        }
        rgb[c] *= PALETTE_GROUPS;
    }
}

static struct reference_path begin_path(const struct studio *studio, uint64_t pixel, uint64_t index)
{
    const struct reference_picture *picture = studio->picture;
    const struct reference_scene *scene = &studio->world.scene;
    struct reference_path path = {.random = random_stream_for(picture->seed, pixel, index),
                                  .position = picture->camera->position_m};
    const double column = (double)(pixel % picture->width) + 0.5 +
                          picture->pixel_width * (random_next(&path.random) - 0.5);
    const double row = (double)(pixel / picture->width) + 0.5 +
                       picture->pixel_width * (random_next(&path.random) - 0.5);
    path.direction = vec3_normalize(camera_ray(picture->camera, 2 * column / picture->width - 1,
                                               1 - 2 * row / picture->height));
    path.star = (struct reference_star){.direction = picture->camera->sun_direction,
                                        .cos_radius = cos(scene->medium->star_angular_radius_rad),
                                        .occluder_count = scene->occluder_count,
                                        .occluders = scene->occluders};
    return path;
}

struct mean {
    double value[3], variance[3];
};

// Whether to go on. The calling thread tells and asks; the others only ask.
static bool goes_on(struct studio *studio)
{
    bool is_stopped;
#pragma omp atomic read
    is_stopped = studio->is_stopped;
    if (is_stopped || omp_get_thread_num() != 0 || ++studio->paths_traced % PATHS_A_LOOK != 0) {
        return !is_stopped;
    }
    uint64_t done;
#pragma omp atomic read
    done = studio->parts_done;
    const double all = (double)PALETTE_GROUPS * studio->picture->width * studio->picture->height;
    studio->result = trl_progress(studio->ctx, "tracing paths", (double)done / all);
    is_stopped = studio->result != TRL_OK;
#pragma omp atomic write
    studio->is_stopped = is_stopped;
    return !is_stopped;
}

// Adds the mean over a group's paths, and the variance of that mean.
static void trace_group(struct studio *studio, uint64_t pixel, int group, struct mean *sum)
{
    const uint64_t count = reference_picture_paths(studio->picture->paths) / PALETTE_GROUPS;
    struct reference_scratch *scratch = &studio->scratches.of[omp_get_thread_num()];
    double mean[3] = {0}, squares[3] = {0};
    for (uint64_t i = 0; i < count && goes_on(studio); ++i) {
        struct reference_path path =
            begin_path(studio, pixel, i * PALETTE_GROUPS + (uint64_t)group);
        double rgb[3];
        trace_colour(studio, group, scratch, &path, rgb);
        for (int c = 0; c < 3; ++c) {
            const double before = rgb[c] - mean[c];
            mean[c] += before / (double)(i + 1);
            squares[c] += before * (rgb[c] - mean[c]);
        }
    }
    for (int c = 0; c < 3; ++c) {
        sum->value[c] += mean[c];
        sum->variance[c] += squares[c] / ((double)count * (double)(count - 1));
    }
}

// Every group has its own paths, so that differences between wavelengths are no noise.
static void trace_pixel(struct studio *studio, uint64_t pixel,
                        const struct reference_sheets *sheets)
{
    struct mean sum = {{0}, {0}};
    for (int group = 0; group < PALETTE_GROUPS; ++group) {
        trace_group(studio, pixel, group, &sum);
#pragma omp atomic update
        studio->parts_done++;
    }
    for (size_t c = 0; c < 4; ++c) {
        sheets->rgba[4 * pixel + c] = c < 3 ? (float)(sum.value[c] / PALETTE_GROUPS) : 1;
        if (sheets->error) {
            sheets->error[4 * pixel + c] =
                c < 3 ? (float)(sqrt(sum.variance[c]) / PALETTE_GROUPS) : 1;
        }
    }
}

static trl_result trace_pixels(struct studio *studio, const struct reference_sheets *sheets)
{
    const uint64_t count = (uint64_t)studio->picture->width * studio->picture->height;
    trl_result result = trl_progress(studio->ctx, "tracing paths", 0);
    if (result != TRL_OK) {
        return result;
    }
#pragma omp parallel for schedule(dynamic) num_threads((int)studio->scratches.count)
    for (uint64_t pixel = 0; pixel < count; ++pixel) {
        trace_pixel(studio, pixel, sheets);
    }
    result = studio->result;
    return result == TRL_OK ? trl_progress(studio->ctx, "tracing paths", 1) : result;
}

uint64_t reference_picture_paths(uint64_t wanted)
{
    const uint64_t rounds = (wanted + PALETTE_GROUPS - 1) / PALETTE_GROUPS;
    return PALETTE_GROUPS * (rounds < 2 ? 2 : rounds);
}

trl_result reference_picture_trace(const trl_context *ctx, const struct reference_scene *scene,
                                   const struct reference_picture *picture,
                                   const struct reference_sheets *sheets)
{
    struct studio *studio = mem_alloc(ctx, 1, sizeof *studio);
    trl_result result = studio ? studio_init(ctx, scene, picture, studio) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = trace_pixels(studio, sheets);
        studio_finish(studio);
    }
    mem_free(ctx, studio);
    return result;
}
