// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// A path starts at the eye. Every ray of it either collides with the air or hits the ground: the
// ray never leaves, its weight is multiplied with the chance that it would not have. Where it
// collides is drawn from a mixture of densities over the pieces of the ray: by what the air
// scatters (right by day), by that times the sunlight which is there, and by height (right in
// twilight). The weight is the true density over the drawn one, so any mixture gives the same
// expectation. Each event adds the sunlight that it turns into the path; then the path goes on in
// a direction drawn from the phase function or from Lambert's cosine, in twilight mixed with the
// part of the sky that glows, with weights again.
#include "reference/path_tracer.h"

#include <math.h>
#include <omp.h>

#include "base/vec3.h"
#include "reference/air.h"
#include "reference/phase_sampler.h"
#include "reference/sun_guide.h"

static const double pi = 3.14159265358979323846;

// Paths of a block are summed by one thread; blocks are summed in their order.
enum { BLOCK_PATHS = 512, BLOCKS_A_BATCH = 256 };

// Weight below which a path survives every second event only.
static const double roulette_weight = 0.02;
// After so many events a path ends with a small chance at each, so that no medium can trap it for
// ever.
enum { LONG_PATH = 1000 };
static const double long_path_survival = 0.99;

// Share of collisions drawn as if the air scattered although it only absorbs: covers shells whose
// middle stands badly for the rest.
static const double floor_share = 0.01;
// The sunlit part of a ray's scattering at which it is
// halved.
static const double sunlit_knee = 1e-6;

// The glow of twilight as a lobe: Henyey-Greenstein about the horizontal toward the sun, tilted up;
// its share of the directions grows as the sun goes down from one cosine of its zenith angle by a
// range of them.
static const double glow_g = 0.75, glow_height = 0.1;
// Only the first orders know of it in full: each use may double the weight, and the product of all
// the factors 1 / (1 - share) must stay bounded however long the path is.
static const double glow_orders = 2;
static const double glow_share = 0.5, glow_begin_mu = 0.03, glow_range_mu = 0.08;

struct tracer {
    const struct medium *medium;
    struct reference_air air;
    struct sun_guide guide;
    struct phase_sampler samplers[MEDIUM_MAX_CONSTITUENTS];
    int max_order;
};

// By what a piece of the ray is drawn: the scattering in it; that times the sunlight there; and in
// twilight the root of the first, for the thin air high up that sees more of the glow than its
// share.
enum density { BY_SCATTERING, BY_SUNLIGHT, BY_HEIGHT, DENSITY_COUNT };

// What one thread works with: the pieces of a ray and the densities over them.
struct scratch {
    struct reference_piece *pieces;
    double *transmittance; // to the piece's begin
    double *density[DENSITY_COUNT];
};

struct path {
    struct random_stream random;
    struct vec3 position; // from the planet's centre
    struct vec3 direction;
    double weight;
    int order; // of the event that comes next, from 1
    bool is_on_ground;
};

static double next(struct path *path)
{
    return random_next(&path->random);
}

// The vector at a given angle about `axis`, a unit vector.
static struct vec3 turn_from(struct vec3 axis, double cosine, double azimuth)
{
    const struct vec3 other = fabs(axis.z) < 0.9 ? (struct vec3){0, 0, 1} : (struct vec3){1, 0, 0};
    const struct vec3 u = vec3_normalize(vec3_cross(other, axis));
    const struct vec3 v = vec3_cross(axis, u);
    const double sine = sqrt(fmax(0, (1 - cosine) * (1 + cosine)));
    const struct vec3 across =
        vec3_add(vec3_scale(u, sine * cos(azimuth)), vec3_scale(v, sine * sin(azimuth)));
    return vec3_normalize(vec3_add(vec3_scale(axis, cosine), across));
}

static double clamp_radius(const struct tracer *tracer, double radius)
{
    return fmin(fmax(radius, tracer->medium->ground_radius_m), tracer->medium->top_radius_m);
}

// Scattering per metre of each constituent; returns their sum.
static double scattering_at(const struct tracer *tracer, double altitude_m, double *each)
{
    double sum = 0;
    for (size_t i = 0; i < tracer->medium->constituent_count; ++i) {
        const double reference = tracer->air.scattering_per_m[i];
        each[i] =
            reference > 0
                ? reference * profile_density(&tracer->medium->constituents[i].profile, altitude_m)
                : 0;
        sum += each[i];
    }
    return sum;
}

// Where the sky is bright after sunset: a lobe toward the sun's side, a little above the
// horizontal. Its share is none by day.
struct glow {
    struct vec3 axis;
    double share;
};

static struct glow find_glow(struct vec3 sun, struct vec3 up, int order)
{
    const double mu_sun = vec3_dot(sun, up);
    const double fade = order / glow_orders;
    const struct vec3 level = vec3_normalize(vec3_sub(sun, vec3_scale(up, mu_sun)));
    return (struct glow){.axis = vec3_normalize(vec3_add(level, vec3_scale(up, glow_height))),
                         .share = glow_share / fmax(1, fade * fade) *
                                  fmin(fmax((glow_begin_mu - mu_sun) / glow_range_mu, 0), 1)};
}

// --- Where a ray ends ---

// How far toward the sun from the planet's centre a ray begins, and how fast it goes there.
struct sunward {
    double begin_m, slope;
};

struct ray_sums {
    size_t count;
    double ground_transmittance; // 0 if the ray leaves
    double density[DENSITY_COUNT];
};

// Sunlight, about, where the ray is at `s_m`.
static double guess_light(const struct tracer *tracer, const struct reference_ray *ray,
                          const struct sunward *sunward, double s_m)
{
    const double radius = sqrt(ray->perigee2_m2 + s_m * s_m);
    const double toward_sun = sunward->begin_m + sunward->slope * (s_m - ray->begin_m);
    return sun_guide_at(&tracer->guide, radius - tracer->medium->ground_radius_m,
                        toward_sun / radius);
}

// The chance, about, of a scattering in each piece, and that times the sunlight in it.
static struct ray_sums weigh_pieces(const struct tracer *tracer, const struct reference_ray *ray,
                                    const struct sunward *sunward, struct scratch *scratch)
{
    struct ray_sums sums = {.count = reference_air_pieces(&tracer->air, ray, scratch->pieces)};
    double transmittance = 1, light = guess_light(tracer, ray, sunward, ray->begin_m);
    for (size_t i = 0; i < sums.count; ++i) {
        const struct reference_piece *piece = &scratch->pieces[i];
        const double next_light = guess_light(tracer, ray, sunward, piece->end_m);
        const double share = tracer->air.scattering_share[piece->shell] + floor_share;
        const double scattered = transmittance * -expm1(-piece->optical_depth) * share;
        scratch->transmittance[i] = transmittance;
        scratch->density[BY_SCATTERING][i] = scattered;
        scratch->density[BY_SUNLIGHT][i] = scattered * 0.5 * (light + next_light);
        scratch->density[BY_HEIGHT][i] = sqrt(scattered);
        for (int k = 0; k < DENSITY_COUNT; ++k) {
            sums.density[k] += scratch->density[k][i];
        }
        transmittance *= exp(-piece->optical_depth);
        light = next_light;
    }
    sums.ground_transmittance = ray->hits_ground ? transmittance : 0;
    return sums;
}

struct mixture {
    double share[DENSITY_COUNT]; // their sum is 1
};

// `glow_part` is above 0 in twilight only.
static struct mixture mix_densities(const struct ray_sums *sums, double glow_part)
{
    const double knee = sunlit_knee * sums->density[BY_SCATTERING];
    const double sunlit =
        glow_part * sums->density[BY_SUNLIGHT] / (sums->density[BY_SUNLIGHT] + knee);
    const double high = (1 - sunlit) * glow_part;
    return (struct mixture){
        {[BY_SCATTERING] = 1 - sunlit - high, [BY_SUNLIGHT] = sunlit, [BY_HEIGHT] = high}};
}

static enum density draw_density(const struct mixture *mixture, struct path *path)
{
    const double u = next(path);
    if (u < mixture->share[BY_SUNLIGHT]) {
        return BY_SUNLIGHT;
    }
    return u < mixture->share[BY_SUNLIGHT] + mixture->share[BY_HEIGHT] ? BY_HEIGHT : BY_SCATTERING;
}

// Draws a piece; `probability` is that of the mixture.
static size_t draw_piece(const struct ray_sums *sums, const struct mixture *mixture,
                         const struct scratch *scratch, struct path *path, double *probability)
{
    const enum density drawn = draw_density(mixture, path);
    const double *density = scratch->density[drawn];
    double left = next(path) * sums->density[drawn];
    size_t piece = 0; // the last one that is possible, if rounding leaves something
    for (size_t i = 0; i < sums->count && left >= 0; ++i) {
        if (density[i] > 0) {
            piece = i;
            left -= density[i];
        }
    }
    *probability = 0;
    for (int k = 0; k < DENSITY_COUNT; ++k) {
        if (mixture->share[k] > 0) {
            *probability += mixture->share[k] * scratch->density[k][piece] / sums->density[k];
        }
    }
    return piece;
}

// Moves the path to a collision; its weight gets scattering and transmittance over the drawn
// density.
static void collide(const struct tracer *tracer, const struct reference_ray *ray,
                    const struct ray_sums *sums, const struct mixture *mixture,
                    struct scratch *scratch, struct path *path)
{
    double probability;
    const size_t i = draw_piece(sums, mixture, scratch, path, &probability);
    const struct reference_piece *piece = &scratch->pieces[i];
    const double length = piece->end_m - piece->begin_m, depth = piece->optical_depth;

    // Within the piece as if it were uniform.
    const double u = next(path);
    double fraction = u, density = 1;
    if (depth > 1e-6) {
        const double inside = -expm1(-depth);
        fraction = fmin(-log1p(-u * inside) / depth, 1);
        density = depth * exp(-depth * fraction) / inside;
    }
    const double s_m = piece->begin_m + fraction * length;
    const double transmittance = scratch->transmittance[i] *
                                 exp(-reference_air_partial_depth(&tracer->air, ray, piece, s_m));

    path->position = vec3_add(path->position, vec3_scale(path->direction, s_m - ray->begin_m));
    path->is_on_ground = false;
    const double radius = clamp_radius(tracer, vec3_length(path->position));
    double each[MEDIUM_MAX_CONSTITUENTS];
    const double scattering = scattering_at(tracer, radius - tracer->medium->ground_radius_m, each);
    path->weight *= scattering * transmittance * length / (probability * density);
}

static void hit_ground(const struct tracer *tracer, const struct reference_ray *ray,
                       struct path *path)
{
    const double ground = tracer->medium->ground_radius_m;
    const double end_m = -sqrt(fmax(0, ground * ground - ray->perigee2_m2));
    const struct vec3 at =
        vec3_add(path->position, vec3_scale(path->direction, end_m - ray->begin_m));
    path->position = vec3_scale(vec3_normalize(at), ground);
    path->is_on_ground = true;
}

// To the next event; false if the path comes to nothing.
static bool advance(const struct tracer *tracer, struct vec3 sun, struct scratch *scratch,
                    struct path *path)
{
    const double length = vec3_length(path->position);
    const double mu = vec3_dot(path->position, path->direction) / length;
    const struct reference_ray ray =
        reference_air_ray(&tracer->air, clamp_radius(tracer, length), mu);
    const struct sunward sunward = {.begin_m = vec3_dot(path->position, sun),
                                    .slope = vec3_dot(path->direction, sun)};
    const struct ray_sums sums = weigh_pieces(tracer, &ray, &sunward, scratch);
    const double reflected = sums.ground_transmittance * tracer->air.ground_albedo;
    const double all = sums.density[BY_SCATTERING] + reflected;
    if (!(all > 0)) {
        return false;
    }
    if (next(path) * all < reflected) {
        path->weight *= all; // reflected, over its probability
        hit_ground(tracer, &ray, path);
    } else {
        path->weight *= all / sums.density[BY_SCATTERING];
        const double glow_part =
            find_glow(sun, vec3_scale(path->position, 1 / length), path->order).share;
        const struct mixture mixture = mix_densities(&sums, glow_part);
        collide(tracer, &ray, &sums, &mixture, scratch, path);
    }
    return path->weight > 0;
}

// --- What happens there ---

static double transmittance_to(const struct tracer *tracer, const struct path *path,
                               struct vec3 direction)
{
    const double length = vec3_length(path->position);
    const double mu = vec3_dot(path->position, direction) / length;
    const struct reference_ray ray =
        reference_air_ray(&tracer->air, clamp_radius(tracer, length), mu);
    return ray.hits_ground ? 0 : exp(-reference_air_optical_depth(&tracer->air, &ray));
}

static double mixed_phase(const struct tracer *tracer, const struct path *path, double cosine)
{
    double each[MEDIUM_MAX_CONSTITUENTS];
    const double altitude_m =
        clamp_radius(tracer, vec3_length(path->position)) - tracer->medium->ground_radius_m;
    const double sum = scattering_at(tracer, altitude_m, each);
    double value = 0;
    for (size_t i = 0; i < tracer->medium->constituent_count; ++i) {
        if (each[i] > 0) {
            value += each[i] / sum * phase_value(&tracer->medium->constituents[i].phase, cosine);
        }
    }
    return value;
}

// Sunlight that the event sends back along the path, from a random point of the sun's disc.
static double sunlight(const struct tracer *tracer, struct vec3 sun, struct path *path)
{
    const double cos_radius = cos(tracer->medium->star_angular_radius_rad);
    const double cosine = 1 - next(path) * (1 - cos_radius);
    const struct vec3 to_sun = turn_from(sun, cosine, 2 * pi * next(path));
    double factor;
    if (path->is_on_ground) {
        const double incidence = vec3_dot(path->position, to_sun) / vec3_length(path->position);
        factor = fmax(0, incidence) / pi;
    } else {
        factor = mixed_phase(tracer, path, vec3_dot(path->direction, to_sun));
    }
    if (!(factor > 0)) {
        return 0;
    }
    // A disc of uniform radiance that puts star_irradiance on a plane facing it: radiance times
    // solid angle.
    const double irradiance = tracer->air.star_irradiance * 2 / (1 + cos_radius);
    return irradiance * factor * transmittance_to(tracer, path, to_sun);
}

// The constituent that scatters, in proportion to what each does here.
static size_t draw_constituent(const struct tracer *tracer, struct path *path)
{
    double each[MEDIUM_MAX_CONSTITUENTS];
    const double altitude_m =
        clamp_radius(tracer, vec3_length(path->position)) - tracer->medium->ground_radius_m;
    double left = next(path) * scattering_at(tracer, altitude_m, each);
    size_t chosen = 0;
    for (size_t i = 0; i < tracer->medium->constituent_count && left >= 0; ++i) {
        if (each[i] > 0) {
            chosen = i;
            left -= each[i];
        }
    }
    return chosen;
}

// Replaces the direction by one in the glow, for a share of the paths.
static void draw_glow(const struct glow *glow, struct path *path)
{
    if (glow->share > 0 && next(path) < glow->share) {
        const double cosine = phase_draw_henyey_greenstein(glow_g, &path->random);
        path->direction = turn_from(glow->axis, cosine, 2 * pi * next(path));
    }
}

static double glow_density(const struct glow *glow, struct vec3 direction)
{
    const struct phase lobe = {.kind = PHASE_HENYEY_GREENSTEIN, .g = glow_g};
    return phase_value(&lobe, vec3_dot(glow->axis, direction));
}

static void reflect(const struct glow *glow, struct vec3 up, struct path *path)
{
    const double cosine = sqrt(next(path));
    path->direction = turn_from(up, cosine, 2 * pi * next(path));
    if (glow->share > 0) {
        draw_glow(glow, path);
        const double wanted = fmax(0, vec3_dot(up, path->direction)) / pi;
        path->weight *= wanted / ((1 - glow->share) * wanted +
                                  glow->share * glow_density(glow, path->direction));
    }
}

static void scatter(const struct tracer *tracer, const struct glow *glow, struct path *path)
{
    const struct phase_sampler *sampler = &tracer->samplers[draw_constituent(tracer, path)];
    const struct vec3 before = path->direction;
    const double cosine = phase_sampler_draw(sampler, &path->random);
    path->direction = turn_from(before, cosine, 2 * pi * next(path));
    draw_glow(glow, path);
    const double drawn = vec3_dot(before, path->direction);
    double density = (1 - glow->share) * phase_sampler_density(sampler, drawn);
    if (glow->share > 0) {
        density += glow->share * glow_density(glow, path->direction);
    }
    path->weight *= phase_value(sampler->phase, drawn) / density;
}

static void redirect(const struct tracer *tracer, struct vec3 sun, struct path *path)
{
    const struct vec3 up = vec3_normalize(path->position);
    const struct glow glow = find_glow(sun, up, path->order);
    if (path->is_on_ground) {
        reflect(&glow, up, path);
    } else {
        scatter(tracer, &glow, path);
    }
}

static bool survives(struct path *path)
{
    double chance = path->weight < roulette_weight ? 0.5 : 1;
    chance *= path->order > LONG_PATH ? long_path_survival : 1;
    path->weight /= chance;
    return chance == 1 || next(path) < chance;
}

static double trace_path(const struct tracer *tracer, struct vec3 sun, struct scratch *scratch,
                         struct path *path)
{
    double radiance = 0;
    for (path->order = 1; advance(tracer, sun, scratch, path); ++path->order) {
        radiance += path->weight * sunlight(tracer, sun, path);
        if (path->order == tracer->max_order || !survives(path)) {
            break;
        }
        redirect(tracer, sun, path);
    }
    return radiance;
}

// --- Queries ---

// The observer at (0, 0, z), the sun above the x axis. False if the view misses the air.
static bool start_path(const struct tracer *tracer, const trl_sky_query *query, struct path *path)
{
    const double sine = sin(query->view_zenith_rad);
    path->direction = (struct vec3){sine * cos(query->azimuth_rad), sine * sin(query->azimuth_rad),
                                    cos(query->view_zenith_rad)};
    path->weight = 1;
    const double radius = tracer->medium->ground_radius_m + query->altitude_m;
    path->position = (struct vec3){0, 0, radius};
    const double top = tracer->medium->top_radius_m;
    if (radius <= top) {
        return true;
    }
    const double perigee = radius * sine;
    if (path->direction.z >= 0 || perigee >= top) {
        return false;
    }
    const double distance = -radius * path->direction.z - sqrt((top - perigee) * (top + perigee));
    path->position = vec3_add(path->position, vec3_scale(path->direction, distance));
    return true;
}

struct block {
    size_t query;
    uint64_t first_path, path_count;
    double sum, sum_of_squares;
};

static void trace_block(const struct tracer *tracer, const trl_sky_query *query, uint64_t seed,
                        struct scratch *scratch, struct block *block)
{
    const struct vec3 sun = {sin(query->sun_zenith_rad), 0, cos(query->sun_zenith_rad)};
    for (uint64_t i = 0; i < block->path_count; ++i) {
        struct path path = {.random = random_stream_for(seed, block->query, block->first_path + i)};
        if (!start_path(tracer, query, &path)) {
            return;
        }
        const double radiance = trace_path(tracer, sun, scratch, &path);
        block->sum += radiance;
        block->sum_of_squares += radiance * radiance;
    }
}

static void tracer_finish(const trl_context *ctx, struct tracer *tracer)
{
    for (size_t i = 0; i < MEDIUM_MAX_CONSTITUENTS; ++i) {
        phase_sampler_finish(ctx, &tracer->samplers[i]);
    }
    sun_guide_finish(ctx, &tracer->guide);
    reference_air_finish(ctx, &tracer->air);
}

static trl_result tracer_init(const trl_context *ctx, const struct medium *medium,
                              double wavelength_nm, struct tracer *tracer)
{
    *tracer = (struct tracer){.medium = medium};
    trl_result result = reference_air_init(ctx, medium, wavelength_nm, &tracer->air);
    if (result == TRL_OK) {
        result = sun_guide_init(ctx, &tracer->air, &tracer->guide);
    }
    for (size_t i = 0; i < medium->constituent_count && result == TRL_OK; ++i) {
        result = phase_sampler_init(ctx, &medium->constituents[i].phase, &tracer->samplers[i]);
    }
    if (result != TRL_OK) {
        tracer_finish(ctx, tracer);
    }
    return result;
}

// One scratch per thread, in one array.
struct scratches {
    struct scratch *of;
    size_t count;
};

static void scratches_finish(const trl_context *ctx, struct scratches *scratches)
{
    for (size_t i = 0; i < scratches->count; ++i) {
        mem_free(ctx, scratches->of[i].pieces);
        mem_free(ctx, scratches->of[i].transmittance);
    }
    mem_free(ctx, scratches->of);
    *scratches = (struct scratches){0};
}

static trl_result scratches_init(const trl_context *ctx, size_t max_pieces,
                                 struct scratches *scratches)
{
    const size_t count = (size_t)omp_get_max_threads();
    *scratches = (struct scratches){.of = mem_alloc(ctx, count, sizeof(struct scratch))};
    if (!scratches->of) {
        return TRL_ERROR_MEMORY;
    }
    scratches->count = count;
    for (size_t i = 0; i < count; ++i) {
        struct scratch *scratch = &scratches->of[i];
        scratch->pieces = mem_alloc(ctx, max_pieces, sizeof(struct reference_piece));
        scratch->transmittance = mem_alloc(ctx, max_pieces, (1 + DENSITY_COUNT) * sizeof(double));
        if (!scratch->pieces || !scratch->transmittance) {
            scratches_finish(ctx, scratches);
            return TRL_ERROR_MEMORY;
        }
        for (size_t k = 0; k < DENSITY_COUNT; ++k) {
            scratch->density[k] = scratch->transmittance + (1 + k) * max_pieces;
        }
    }
    return TRL_OK;
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

static trl_result trace_blocks(const struct job *job, const struct tracer *tracer,
                               struct block *blocks, size_t block_count)
{
    struct scratches scratches;
    trl_result result =
        scratches_init(job->ctx, reference_air_max_pieces(&tracer->air), &scratches);
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
    scratches_finish(job->ctx, &scratches);
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
        const double mean = sum / paths;
        const double variance = fmax(0, sum_of_squares / paths - mean * mean);
        job->radiance[query] = mean;
        job->standard_error[query] = sqrt(variance / (paths - 1));
        job->is_done[query] = true;
    }
}

static trl_result trace_wavelength(struct job *job, double wavelength_nm)
{
    struct tracer tracer;
    trl_result result = tracer_init(job->ctx, job->medium, wavelength_nm, &tracer);
    if (result != TRL_OK) {
        return result;
    }
    tracer.max_order = job->desc->max_order;
    size_t block_count;
    struct block *blocks = make_blocks(job, wavelength_nm, &block_count);
    result = blocks ? trace_blocks(job, &tracer, blocks, block_count) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        sum_blocks(job, blocks, block_count);
    }
    mem_free(job->ctx, blocks);
    tracer_finish(job->ctx, &tracer);
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
