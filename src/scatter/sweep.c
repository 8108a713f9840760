// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Along the rays of further orders: few nodes, since the source is smooth.
static const double DEPTH_PER_RULE = 2.5;
static const double LEAST_TRANSMITTANCE = 1e-5;

void directions_init(struct directions *d, const struct optics *optics, double radius_m, int half,
                     int azimuths)
{
    const double sine = optics->ground_radius_m / radius_m;
    const double horizon_mu = -sqrt(fmax(0, 1 - sine * sine));
    struct gauss rule;
    gauss_init(&rule, half < GAUSS_MAX ? half : GAUSS_MAX);
    d->zeniths = 2 * rule.count;
    for (int k = 0; k < rule.count; k++) {
        const double x = rule.node[k];
        const double weight = 2 * x * rule.weight[k];
        d->mu[k] = horizon_mu + (1 - horizon_mu) * x * x;
        d->weight[k] = (1 - horizon_mu) * weight;
        d->mu[rule.count + k] = horizon_mu - (1 + horizon_mu) * x * x;
        d->weight[rule.count + k] = (1 + horizon_mu) * weight;
    }
    d->azimuths = azimuths < 4 * GAUSS_MAX ? azimuths : 4 * GAUSS_MAX;
    for (int p = 0; p < d->azimuths; p++) {
        d->cos_azimuth[p] = cos((p + 0.5) * M_PI / d->azimuths);
    }
    d->azimuth_weight = 2 * M_PI / d->azimuths;
}

struct ray_desc sweep_ray(const struct solver_settings *settings, double radius_m, double mu)
{
    return (struct ray_desc){.radius_m = radius_m,
                             .mu = mu,
                             .nodes_per_shell = settings->nodes_per_shell,
                             .end_m = INFINITY,
                             .depth_per_rule = DEPTH_PER_RULE,
                             .least_transmittance = LEAST_TRANSMITTANCE};
}

// A node of one of a level's rays.
struct place {
    float shell;
    short ray;
    short node;
};

// What one thread needs; freed as a whole.
struct worker {
    struct ray *rays; // one for each zenith direction of the orders after the first
    struct place *places;
    struct directions directions;
    struct transport_scratch *scratch;
    float *sun_mu;                         // [members]
    float *nu;                             // [zeniths][members]
    float *phase[MEDIUM_MAX_CONSTITUENTS]; // [members]
    lanes *radiance;                       // [zeniths][members]
};

struct sweep {
    const trl_context *ctx;
    const struct solution *solution;
    const struct solver_settings *settings;
    const struct moments *before; // the order that is gathered; NULL: direct light
    struct moments *out;
    double *sun_mu; // [suns] of the grid
    int worker_count;
    struct worker *workers;
};

// Suns outermost, so that the azimuths of one sun are neighbours.
static struct transport_family fill_family(struct worker *w, const struct sweep *sweep, int zenith,
                                           double mu)
{
    const struct directions *d = &w->directions;
    const int count = sweep->out->suns * d->azimuths;
    float *nu = w->nu + (size_t)zenith * count;
    const double sine = sqrt(fmax(0, 1 - mu * mu));
    for (int i = 0; i < sweep->out->suns; i++) {
        const double sun_mu = sweep->sun_mu[i];
        const double sun_sine = sqrt(fmax(0, 1 - sun_mu * sun_mu));
        for (int p = 0; p < d->azimuths; p++) {
            w->sun_mu[i * d->azimuths + p] = (float)sun_mu;
            nu[i * d->azimuths + p] = (float)(mu * sun_mu + sine * sun_sine * d->cos_azimuth[p]);
        }
    }
    return (struct transport_family){count, w->sun_mu, nu};
}

// The phase function as far as the moments have it: what is dropped here would be dropped at the
// next scattering, and what counts as not scattered is in the direct light already.
static void fill_phase(const struct optics *optics, int i, const struct transport_family *family,
                       float *phase)
{
    double factor[OPTICS_MAX_DEGREE + 1];
    for (int l = 0; l <= optics->lmax; l++) {
        factor[l] =
            (1 - optics->forward_share[i]) * (2 * l + 1) / (4 * M_PI) * optics->moment[i][l];
    }
    for (int t = 0; t < family->count; t++) {
        const double nu = (double)family->nu[t];
        double before = 0;
        double now = 1;
        double sum = 0;
        for (int l = 0; l <= optics->lmax; l++) {
            sum += factor[l] * now;
            const double next = ((2 * l + 1) * nu * now - l * before) / (l + 1);
            before = now;
            now = next;
        }
        phase[t] = (float)sum;
    }
}

static void add_first_order(struct worker *w, const struct sweep *sweep,
                            const struct transport_family *family)
{
    const struct optics *optics = sweep->solution->optics;
    struct transport_channels channels;
    for (int i = 0; i < optics->constituent_count; i++) {
        const bool scatters = optics->vertical_scattering_depth[i] > 0;
        channels.channel[i] = scatters ? 0 : -1;
        channels.phase[i] = w->phase[i];
        if (scatters) {
            fill_phase(optics, i, family, w->phase[i]);
        }
    }
    lanes *const out[1] = {w->radiance};
    transport_add_single(&sweep->solution->sun, &w->rays[0], family, &channels, out, w->scratch);
    transport_add_ground(&sweep->solution->sun, NULL, &w->rays[0], family, w->radiance);
}

// a_lm += weight * Y_lm(mu) * integral over the azimuth of L cos(m phi); the ground's irradiance
// likewise.
static void project(const struct worker *w, const struct sweep *sweep, int level, int zenith,
                    const lanes *radiance)
{
    const struct directions *d = &w->directions;
    const double mu = d->mu[zenith];
    const double weight = d->weight[zenith];
    const int lmax = sweep->out->lmax;
    const int harmonics = harmonic_count(lmax);
    double harmonic[(OPTICS_MAX_DEGREE + 1) * (OPTICS_MAX_DEGREE + 2) / 2];
    harmonic_values(lmax, mu, harmonic);
    // The first sun stays dark: below the grid, its row is what is looked up.
    for (int i = 1; i < sweep->out->suns; i++) {
        lanes around[OPTICS_MAX_DEGREE + 1];
        for (int m = 0; m <= lmax; m++) {
            around[m] = lanes_set(0);
        }
        for (int p = 0; p < d->azimuths; p++) {
            const lanes value = radiance[i * d->azimuths + p];
            double before = d->cos_azimuth[p];
            double now = 1;
            for (int m = 0; m <= lmax; m++) {
                around[m] += value * (float)(now * d->azimuth_weight * weight);
                const double next = 2 * d->cos_azimuth[p] * now - before;
                before = now;
                now = next;
            }
        }
        lanes *a = sweep->out->radiance + ((size_t)level * sweep->out->suns + i) * harmonics;
        for (int l = 0; l <= lmax; l++) {
            for (int m = 0; m <= l; m++) {
                a[harmonic_index(l, m)] += around[m] * (float)harmonic[harmonic_index(l, m)];
            }
        }
        if (level == 0 && mu > 0) {
            sweep->out->irradiance[i] += around[0] * (float)mu;
        }
    }
}

// Light scattered once, direction by direction.
static void gather_first(const struct sweep *sweep, struct worker *w, int level, double radius_m)
{
    for (int q = 0; q < w->directions.zeniths; q++) {
        struct ray_desc desc = sweep_ray(sweep->settings, radius_m, w->directions.mu[q]);
        desc.nodes_per_shell = sweep->settings->first_nodes_per_shell;
        ray_init(&w->rays[0], sweep->solution->optics, sweep->solution->rules, &desc);
        const struct transport_family family = fill_family(w, sweep, 0, desc.mu);
        memset(w->radiance, 0, (size_t)family.count * sizeof(lanes));
        add_first_order(w, sweep, &family);
        project(w, sweep, level, q, w->radiance);
    }
}

static int compare_places(const void *a, const void *b)
{
    const struct place *x = a;
    const struct place *y = b;
    return (x->shell > y->shell) - (x->shell < y->shell);
}

static int list_places(struct worker *w)
{
    int count = 0;
    for (int q = 0; q < w->directions.zeniths; q++) {
        const struct ray *ray = &w->rays[q];
        for (int k = 0; k < ray->node_count; k++) {
            w->places[count++] = (struct place){(float)ray->node[k].shell, (short)q, (short)k};
        }
    }
    qsort(w->places, (size_t)count, sizeof *w->places, compare_places);
    return count;
}

// Light scattered again, from all directions at once and in the order of altitude: the moments of a
// few levels are the better part of a megabyte, and so are read once.
static void gather_further(const struct sweep *sweep, struct worker *w, int level, double radius_m)
{
    const struct directions *d = &w->directions;
    struct transport_family family[4 * GAUSS_MAX];
    for (int q = 0; q < d->zeniths; q++) {
        const struct ray_desc desc = sweep_ray(sweep->settings, radius_m, d->mu[q]);
        ray_init(&w->rays[q], sweep->solution->optics, sweep->solution->rules, &desc);
        family[q] = fill_family(w, sweep, q, desc.mu);
    }
    const size_t members = (size_t)family[0].count;
    memset(w->radiance, 0, (size_t)d->zeniths * members * sizeof(lanes));
    const int places = list_places(w);
    for (int n = 0; n < places; n++) {
        const struct place at = w->places[n];
        w->rays[at.ray].first_node = at.node;
        w->rays[at.ray].node_count = at.node + 1;
        transport_add_multiple(sweep->before, &w->rays[at.ray], &family[at.ray],
                               w->radiance + at.ray * members, w->scratch);
    }
    for (int q = 0; q < d->zeniths; q++) {
        lanes *radiance = w->radiance + (size_t)q * members;
        transport_add_ground(NULL, sweep->before, &w->rays[q], &family[q], radiance);
        project(w, sweep, level, q, radiance);
    }
}

static void compute_level(const struct sweep *sweep, struct worker *w, int level)
{
    const struct solver_settings *set = sweep->settings;
    struct moments *out = sweep->out;
    const double radius_m = moments_level_radius(out, level);
    const int finer = sweep->before ? 1 : set->first_refinement;
    directions_init(&w->directions, sweep->solution->optics, radius_m, set->zeniths * finer,
                    set->azimuths * finer);
    const size_t row = (size_t)out->suns * (size_t)harmonic_count(out->lmax);
    memset(out->radiance + (size_t)level * row, 0, row * sizeof(lanes));
    if (sweep->before) {
        gather_further(sweep, w, level, radius_m);
    } else {
        gather_first(sweep, w, level, radius_m);
    }
}

// The caller's thread tells how far the work is, and hears whether to stop.
trl_result sweep_order(struct sweep *sweep, const struct moments *before, double done,
                       struct moments *out)
{
    sweep->before = before;
    sweep->out = out;
    memset(out->irradiance, 0, (size_t)out->suns * sizeof(lanes));
    int result = TRL_OK;
#pragma omp parallel for schedule(dynamic) num_threads(sweep->worker_count)
    for (int level = 0; level < out->levels; level++) {
        int so_far;
#pragma omp atomic read
        so_far = result;
        if (so_far != TRL_OK) {
            continue;
        }
        const unsigned state = lanes_flush_denormals();
        compute_level(sweep, &sweep->workers[lanes_thread()], level);
        lanes_restore(state);
        if (lanes_thread() == 0) {
            so_far = trl_progress(sweep->ctx, "solving the atmosphere", done);
            if (so_far != TRL_OK) {
#pragma omp atomic write
                result = so_far;
            }
        }
    }
    return (trl_result)result;
}

static trl_result worker_init(const struct sweep *sweep, struct worker *w)
{
    const trl_context *ctx = sweep->ctx;
    const struct solver_settings *set = sweep->settings;
    const size_t zeniths = 2 * (size_t)set->zeniths;
    const size_t members = (size_t)set->suns * (size_t)set->azimuths;
    const size_t most = members * (size_t)set->first_refinement;
    const size_t all = zeniths * members > most ? zeniths * members : most;
    w->rays = mem_alloc(ctx, zeniths, sizeof *w->rays);
    w->places = mem_alloc(ctx, zeniths * RAY_MAX_NODES, sizeof *w->places);
    w->sun_mu = mem_alloc(ctx, most, sizeof *w->sun_mu);
    w->nu = mem_alloc(ctx, all, sizeof *w->nu);
    w->radiance = mem_alloc(ctx, all, sizeof *w->radiance);
    bool has_memory = w->rays && w->places && w->sun_mu && w->nu && w->radiance;
    for (int i = 0; i < sweep->solution->optics->constituent_count && has_memory; i++) {
        w->phase[i] = mem_alloc(ctx, most, sizeof(float));
        has_memory = w->phase[i] != NULL;
    }
    return has_memory ? transport_scratch_create(ctx, (int)most, set->suns, &w->scratch)
                      : TRL_ERROR_MEMORY;
}

void sweep_destroy(const trl_context *ctx, struct sweep **sweep)
{
    struct sweep *s = *sweep;
    if (!s) {
        return;
    }
    for (int n = 0; s->workers && n < s->worker_count; n++) {
        struct worker *w = &s->workers[n];
        mem_free(ctx, w->rays);
        mem_free(ctx, w->places);
        mem_free(ctx, w->sun_mu);
        mem_free(ctx, w->nu);
        mem_free(ctx, w->radiance);
        for (int i = 0; i < MEDIUM_MAX_CONSTITUENTS; i++) {
            mem_free(ctx, w->phase[i]);
        }
        transport_scratch_destroy(ctx, &w->scratch);
    }
    mem_free(ctx, s->workers);
    mem_free(ctx, s->sun_mu);
    mem_free(ctx, s);
    *sweep = NULL;
}

static trl_result sweep_init(struct sweep *sweep)
{
    const struct solver_settings *set = sweep->settings;
    sweep->worker_count = lanes_max_threads();
    sweep->workers = mem_alloc(sweep->ctx, (size_t)sweep->worker_count, sizeof *sweep->workers);
    sweep->sun_mu = mem_alloc(sweep->ctx, (size_t)set->suns, sizeof *sweep->sun_mu);
    trl_result result = sweep->workers && sweep->sun_mu ? TRL_OK : TRL_ERROR_MEMORY;
    for (int i = 0; i < set->suns && result == TRL_OK; i++) {
        sweep->sun_mu[i] = moments_sun_mu(&sweep->solution->moments, i);
    }
    for (int n = 0; n < sweep->worker_count && result == TRL_OK; n++) {
        result = worker_init(sweep, &sweep->workers[n]);
    }
    return result;
}

trl_result sweep_create(const trl_context *ctx, const struct solution *solution,
                        const struct solver_settings *settings, struct sweep **out)
{
    *out = mem_alloc(ctx, 1, sizeof **out);
    if (!*out) {
        return TRL_ERROR_MEMORY;
    }
    **out = (struct sweep){.ctx = ctx, .solution = solution, .settings = settings};
    const trl_result result = sweep_init(*out);
    if (result != TRL_OK) {
        sweep_destroy(ctx, out);
    }
    return result;
}
