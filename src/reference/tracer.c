// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/tracer.h"

#include <math.h>
#include <omp.h>

// Weight below which a path survives every second event only.
static const double roulette_weight = 0.1;
// Weight above which a path goes on as two.
static const double split_weight = 2;
enum { MAX_WAITING = 32 };
// After so many events a path ends with a small chance at each, so that no medium can trap it for
// ever. Far more than a path through a cloud of optical depth 1000 has.
enum { LONG_PATH = 200000 };
static const double long_path_survival = 0.9999;

// How far below the lowest terrain rays run, relative to the radius: half a metre on Earth.
static const double below_ground = 1e-7;

// A phase function of this height, in sr^-1, is sharp: 1 has sharpness 0, this 1, by logarithms.
static const double sharp_phase = 100;

struct vec3 reference_turn(struct vec3 axis, double cosine, double azimuth)
{
    const struct vec3 other = fabs(axis.z) < 0.9 ? (struct vec3){0, 0, 1} : (struct vec3){1, 0, 0};
    const struct vec3 u = vec3_normalize(vec3_cross(other, axis));
    const struct vec3 v = vec3_cross(axis, u);
    const double sine = sqrt(fmax(0, (1 - cosine) * (1 + cosine)));
    const struct vec3 across =
        vec3_add(vec3_scale(u, sine * cos(azimuth)), vec3_scale(v, sine * sin(azimuth)));
    return vec3_normalize(vec3_add(vec3_scale(axis, cosine), across));
}

double reference_path_radius(const struct reference_tracer *tracer,
                             const struct reference_path *path)
{
    const struct reference_air *air = &tracer->world->air;
    return fmin(fmax(vec3_length(path->position), air->bottom_radius_m), air->top_radius_m);
}

bool reference_enter(const struct reference_world *world, struct reference_path *path)
{
    const double top = world->air.top_radius_m;
    const double along = vec3_dot(path->position, path->direction);
    const double radius = vec3_length(path->position);
    if (radius <= top) {
        return true;
    }
    const double perigee = vec3_length(vec3_cross(path->position, path->direction));
    if (along >= 0 || perigee >= top) {
        return false;
    }
    const double distance = -along - sqrt((top - perigee) * (top + perigee));
    path->position = vec3_add(path->position, vec3_scale(path->direction, distance));
    return true;
}

static double mean_weight(const struct reference_tracer *tracer, const struct reference_path *path)
{
    return lanes4_sum(&path->weight) / tracer->optics.count;
}

static bool survives(const struct reference_tracer *tracer, struct reference_path *path)
{
    double chance = mean_weight(tracer, path) < roulette_weight ? 0.5 : 1;
    chance *= path->order > LONG_PATH ? long_path_survival : 1;
    path->weight /= chance;
    return chance == 1 || reference_next(path) < chance;
}

// Paths that wait for their turn: copies of heavy ones.
struct waiting {
    struct reference_path paths[MAX_WAITING];
    int count;
};

// A path that counts for many goes on as two.
static void split(const struct reference_tracer *tracer, struct reference_path *path,
                  struct waiting *waiting)
{
    if (mean_weight(tracer, path) > split_weight && waiting->count < MAX_WAITING) {
        path->weight *= 0.5;
        struct reference_path *copy = &waiting->paths[waiting->count++];
        *copy = *path;
        copy->radiance = lanes4_set(0);
        copy->random = random_stream_fork(&path->random);
    }
}

// Goes on from an event that has been reached; false at the path's end.
static bool leave_event(const struct reference_tracer *tracer, bool shares_disc,
                        struct reference_path *path)
{
    const bool is_last = path->order == tracer->max_order;
    // Of the last event, too, a direction is drawn where it may find the disc.
    if ((is_last && !shares_disc) || !survives(tracer, path)) {
        return false;
    }
    reference_redirect(tracer, path);
    ++path->order;
    return !is_last;
}

static void follow(const struct reference_tracer *tracer, struct reference_scratch *scratch,
                   struct reference_path *path, struct waiting *waiting)
{
    const bool shares_disc = reference_shares_disc(tracer, &path->star);
    while (reference_advance(tracer, scratch, path)) {
        reference_add_starlight(tracer, path);
        if (!leave_event(tracer, shares_disc, path)) {
            break;
        }
        split(tracer, path, waiting);
    }
}

void reference_trace(const struct reference_tracer *tracer, struct reference_scratch *scratch,
                     struct reference_path *path)
{
    path->weight = lanes4_set(0);
    for (int k = 0; k < tracer->optics.count; ++k) {
        path->weight[k] = 1;
    }
    path->radiance = lanes4_set(0);
    path->order = 1;
    struct waiting waiting = {.count = 0};
    follow(tracer, scratch, path, &waiting);
    while (waiting.count > 0) {
        struct reference_path next = waiting.paths[--waiting.count];
        follow(tracer, scratch, &next, &waiting);
        path->radiance += next.radiance;
    }
}

static double highest_value(const struct phase *phase)
{
    double highest = fmax(phase_value(phase, 1), phase_value(phase, -1));
    for (size_t i = 0; phase->kind == PHASE_TABLE && i < phase->count; ++i) {
        highest = fmax(highest, phase->value[i]);
    }
    return highest;
}

void reference_world_finish(const trl_context *ctx, struct reference_world *world)
{
    for (size_t i = 0; i < MEDIUM_MAX_CONSTITUENTS; ++i) {
        phase_sampler_finish(ctx, &world->samplers[i]);
    }
    sun_guide_finish(ctx, &world->guide);
    reference_air_finish(ctx, &world->air);
}

// Of wavelengths spread over all of them: the guide is one for all.
static trl_result make_guide(const trl_context *ctx,
                             const struct reference_wavelengths *wavelengths,
                             struct reference_world *world)
{
    double nm[REFERENCE_LANES];
    const size_t most = REFERENCE_LANES;
    const size_t count = wavelengths->count < most ? wavelengths->count : most;
    for (size_t k = 0; k < count; ++k) {
        nm[k] = wavelengths->nm[(2 * k + 1) * wavelengths->count / (2 * count)];
    }
    const struct reference_optics optics = reference_optics_at(world->scene.medium, nm, (int)count);
    return sun_guide_init(ctx, &world->air, &optics, &world->guide);
}

trl_result reference_world_init(const trl_context *ctx, const struct reference_scene *scene,
                                const struct reference_wavelengths *wavelengths,
                                struct reference_world *world)
{
    *world = (struct reference_world){.scene = *scene};
    struct reference_extent extent = {0, 0};
    if (scene->surface) {
        // A little deeper: rays that end on the bottom would miss level ground by rounding.
        extent.lowest_m =
            fmin(0, scene->surface->lowest_m) - below_ground * scene->medium->ground_radius_m;
        extent.highest_m = fmax(0, scene->surface->highest_m);
    }
    if (scene->clouds) {
        extent.highest_m = fmax(extent.highest_m, scene->clouds->highest_m);
        world->highest_phase = reference_clouds_phase(scene->clouds, 1);
    }
    const struct medium *medium = scene->medium;
    trl_result result = reference_air_init(ctx, medium, wavelengths, &extent, &world->air);
    for (size_t i = 0; i < medium->constituent_count && result == TRL_OK; ++i) {
        const struct phase *phase = &medium->constituents[i].phase;
        result = phase_sampler_init(ctx, phase, &world->samplers[i]);
        const double highest = highest_value(phase);
        world->highest_phase = fmax(world->highest_phase, highest);
        world->sharpness[i] = fmin(fmax(log(highest) / log(sharp_phase), 0), 1);
    }
    if (result == TRL_OK) {
        result = make_guide(ctx, wavelengths, world);
    }
    if (result != TRL_OK) {
        reference_world_finish(ctx, world);
    }
    return result;
}

struct reference_tracer reference_tracer_make(const struct reference_world *world, const double *nm,
                                              int count)
{
    struct reference_tracer tracer = {
        .world = world, .optics = reference_optics_at(world->scene.medium, nm, count)};
    for (int k = 0; k < REFERENCE_LANES; ++k) {
        tracer.nm[k] = nm[k < count ? k : 0];
    }
    return tracer;
}

size_t reference_max_stretches(const struct reference_air *air)
{
    // Each shell twice, the perigee's shell in two halves; and the splits.
    const double top = air->top_radius_m, bottom = air->bottom_radius_m;
    const double longest_m = 2 * sqrt((top - bottom) * (top + bottom));
    return 2 * air->shell_count + 4 + (size_t)ceil(longest_m / air->split_length_m);
}

void reference_scratches_finish(const trl_context *ctx, struct reference_scratches *scratches)
{
    for (size_t i = 0; i < scratches->count; ++i) {
        mem_free(ctx, scratches->of[i].stretches);
    }
    mem_free(ctx, scratches->of);
    *scratches = (struct reference_scratches){0};
}

trl_result reference_scratches_init(const trl_context *ctx, const struct reference_air *air,
                                    struct reference_scratches *scratches)
{
    const size_t count = (size_t)omp_get_max_threads();
    *scratches =
        (struct reference_scratches){.of = mem_alloc(ctx, count, sizeof(struct reference_scratch))};
    if (!scratches->of) {
        return TRL_ERROR_MEMORY;
    }
    scratches->count = count;
    for (size_t i = 0; i < count; ++i) {
        scratches->of[i].stretches =
            mem_alloc(ctx, reference_max_stretches(air) + 1, sizeof(struct reference_stretch));
        if (!scratches->of[i].stretches) {
            reference_scratches_finish(ctx, scratches);
            return TRL_ERROR_MEMORY;
        }
    }
    return TRL_OK;
}
