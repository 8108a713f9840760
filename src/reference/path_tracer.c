// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/path_tracer.h"

#include <math.h>
#include <omp.h>

#include "reference/tracer.h"

static const double pi = 3.14159265358979323846;

// Paths of a block are summed by one thread; blocks are summed in their order.
enum { BLOCK_PATHS = 512, BLOCKS_A_BATCH = 256 };

// The observer at (0, 0, z), the star above the x axis. False if the view misses the air.
static bool start_path(const struct reference_world *world, const trl_sky_query *query,
                       struct reference_path *path)
{
    const double sine = sin(query->view_zenith_rad);
    const double radius = world->scene.medium->ground_radius_m + query->altitude_m;
    path->direction = (struct vec3){sine * cos(query->azimuth_rad), sine * sin(query->azimuth_rad),
                                    cos(query->view_zenith_rad)};
    path->position = (struct vec3){0, 0, radius};
    path->star = (struct reference_star){
        .direction = {sin(query->sun_zenith_rad), 0, cos(query->sun_zenith_rad)},
        .cos_radius = cos(world->scene.medium->star_angular_radius_rad),
        .occluder_count = world->scene.occluder_count,
        .occluders = world->scene.occluders};
    return reference_enter(world, path);
}

struct block {
    size_t query;
    uint64_t first_path, path_count;
    double sum, sum_of_squares;
};

static void trace_block(const struct reference_tracer *tracer, const trl_sky_query *query,
                        uint64_t seed, struct reference_scratch *scratch, struct block *block)
{
    for (uint64_t i = 0; i < block->path_count; ++i) {
        struct reference_path path = {
            .random = random_stream_for(seed, block->query, block->first_path + i)};
        if (!start_path(tracer->world, query, &path)) {
            return;
        }
        reference_trace(tracer, scratch, &path);
        block->sum += path.radiance[0];
        block->sum_of_squares += path.radiance[0] * path.radiance[0];
    }
}

struct job {
    const trl_context *ctx;
    const struct medium *medium;
    const trl_sky_query *queries;
    size_t query_count;
    const struct reference_desc *desc;
    bool *is_done;
    size_t done_count;
    double *radiance, *standard_error;
};

static trl_result trace_blocks(const struct job *job, const struct reference_tracer *tracer,
                               struct block *blocks, size_t block_count)
{
    struct reference_scratches scratches;
    trl_result result = reference_scratches_init(job->ctx, &tracer->world->air, &scratches);
    for (size_t from = 0; from < block_count && result == TRL_OK; from += BLOCKS_A_BATCH) {
        const size_t to = from + BLOCKS_A_BATCH < block_count ? from + BLOCKS_A_BATCH : block_count;
#pragma omp parallel for schedule(dynamic) num_threads((int)scratches.count)
        for (size_t i = from; i < to; ++i) {
            trace_block(tracer, &job->queries[blocks[i].query], job->desc->seed,
                        &scratches.of[omp_get_thread_num()], &blocks[i]);
        }
        const double done = (double)blocks[to - 1].query + 1;
        result = trl_progress(job->ctx, "tracing paths", done / (double)job->query_count);
    }
    reference_scratches_finish(job->ctx, &scratches);
    return result;
}

// The blocks of all queries at one wavelength, those of a query side by side.
static struct block *make_blocks(const struct job *job, double wavelength_nm, size_t *count)
{
    const uint64_t paths = job->desc->paths;
    const size_t a_query = (size_t)((paths + BLOCK_PATHS - 1) / BLOCK_PATHS);
    size_t queries = 0;
    for (size_t q = 0; q < job->query_count; ++q) {
        queries += job->queries[q].wavelength_nm == wavelength_nm;
    }
    struct block *blocks = mem_alloc(job->ctx, queries, a_query * sizeof(struct block));
    if (!blocks) {
        return NULL;
    }
    *count = 0;
    for (size_t q = 0; q < job->query_count; ++q) {
        if (job->queries[q].wavelength_nm != wavelength_nm) {
            continue;
        }
        for (uint64_t first = 0; first < paths; first += BLOCK_PATHS) {
            const uint64_t left = paths - first;
            blocks[(*count)++] =
                (struct block){.query = q,
                               .first_path = first,
                               .path_count = left < BLOCK_PATHS ? left : BLOCK_PATHS};
        }
    }
    return blocks;
}

static void sum_blocks(struct job *job, const struct block *blocks, size_t block_count)
{
    const double paths = (double)job->desc->paths;
    for (size_t from = 0; from < block_count;) {
        const size_t query = blocks[from].query;
        double sum = 0, sum_of_squares = 0;
        for (; from < block_count && blocks[from].query == query; ++from) {
            sum += blocks[from].sum;
            sum_of_squares += blocks[from].sum_of_squares;
        }
        const double irradiance =
            spectrum_at(&job->medium->star_irradiance, job->queries[query].wavelength_nm);
        const double mean = sum / paths;
        const double variance = fmax(0, sum_of_squares / paths - mean * mean);
        job->radiance[query] = irradiance * mean;
        job->standard_error[query] = irradiance * sqrt(variance / (paths - 1));
        job->is_done[query] = true;
    }
}

static trl_result trace_with(struct job *job, const struct reference_tracer *tracer,
                             double wavelength_nm)
{
    size_t block_count;
    struct block *blocks = make_blocks(job, wavelength_nm, &block_count);
    const trl_result result =
        blocks ? trace_blocks(job, tracer, blocks, block_count) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        sum_blocks(job, blocks, block_count);
    }
    mem_free(job->ctx, blocks);
    return result;
}

static trl_result trace_wavelength(struct job *job, double wavelength_nm)
{
    const struct reference_scene scene = {.medium = job->medium,
                                          .occluder_count = job->desc->occluder_count,
                                          .occluders = job->desc->occluders,
                                          .clouds = job->desc->clouds};
    const struct reference_wavelengths wavelengths = {&wavelength_nm, 1};
    struct reference_world world;
    trl_result result = reference_world_init(job->ctx, &scene, &wavelengths, &world);
    if (result != TRL_OK) {
        return result;
    }
    struct reference_tracer tracer = reference_tracer_make(&world, &wavelength_nm, 1);
    tracer.max_order = job->desc->max_order;
    result = trace_with(job, &tracer, wavelength_nm);
    reference_world_finish(job->ctx, &world);
    return result;
}

static bool is_valid(const trl_sky_query *query)
{
    return isfinite(query->altitude_m) && query->altitude_m >= 0 && query->sun_zenith_rad >= 0 &&
           query->sun_zenith_rad <= pi && query->view_zenith_rad >= 0 &&
           query->view_zenith_rad <= pi && isfinite(query->azimuth_rad) &&
           isfinite(query->wavelength_nm) && query->wavelength_nm > 0;
}

trl_result reference_sky_radiance(const trl_context *ctx, const struct medium *medium,
                                  const trl_sky_query *queries, size_t count,
                                  const struct reference_desc *desc, double *radiance,
                                  double *standard_error)
{
    if (desc->paths < 2 || desc->max_order < 0) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "the path tracer needs two paths and no negative order");
    }
    for (size_t q = 0; q < count; ++q) {
        if (!is_valid(&queries[q])) {
            return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                            "query %zu is out of range", q);
        }
    }
    struct job job = {.ctx = ctx,
                      .medium = medium,
                      .queries = queries,
                      .query_count = count,
                      .desc = desc,
                      .is_done = mem_alloc(ctx, count, sizeof(bool)),
                      .radiance = radiance,
                      .standard_error = standard_error};
    trl_result result = job.is_done ? TRL_OK : TRL_ERROR_MEMORY;
    for (size_t q = 0; q < count && result == TRL_OK; ++q) {
        if (!job.is_done[q]) {
            result = trace_wavelength(&job, queries[q].wavelength_nm);
        }
    }
    mem_free(ctx, job.is_done);
    return result;
}
