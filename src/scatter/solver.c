// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/solver.h"

#include <math.h>
#include <string.h>

// Moments of the phase function beyond lmax are dropped; what they would scatter a second time is
// about the constituent's optical depth times the first moment dropped, below this.
static const double DROPPED_MOMENT[] = {[SOLVER_INTERACTIVE] = 0.01, [SOLVER_PRECISE] = 0.008};

enum { MIN_ORDERS = 4 };          // fewer show no ratio of a series
static const double DARK = 1e-20; // radiance per unit irradiance that nobody will see

static int choose_degree(const struct optics *optics, double allowed)
{
    for (int lmax = 2; lmax < OPTICS_MAX_DEGREE; lmax++) {
        double dropped = 0;
        for (int i = 0; i < optics->constituent_count; i++) {
            dropped +=
                fmin(1, optics->vertical_scattering_depth[i]) * fabs(optics->moment[i][lmax + 1]);
        }
        if (dropped <= allowed) {
            return lmax;
        }
    }
    return OPTICS_MAX_DEGREE - 1;
}

struct solver_settings solver_settings_choose(const struct optics *optics,
                                              enum solver_quality quality)
{
    const double depth = optics_largest_depth(optics);
    const bool is_precise = quality == SOLVER_PRECISE;
    // Beyond a depth of four the light is diffuse: grids grow slower than the depth.
    const double thick = depth < 4 ? depth : fmin(4 + 0.3 * (depth - 4), 8);
    const int lmax = choose_degree(optics, DROPPED_MOMENT[quality]);
    return (struct solver_settings){.lmax = lmax,
                                    .levels = (is_precise ? 38 : 28) + (int)(12 * thick),
                                    .suns = is_precise ? 72 : 56,
                                    .zeniths = (is_precise ? 7 : 5) + lmax / 2,
                                    .azimuths = lmax < 6 ? 5 : lmax - 1,
                                    .first_refinement = 2,
                                    .nodes_per_shell = (is_precise ? 10 : 8) + 12 * thick,
                                    .first_nodes_per_shell = (is_precise ? 128 : 64) + 24 * thick,
                                    .max_orders = 200,
                                    .tolerance = is_precise ? 2e-4 : 1e-3};
}

// Directions at one level: zenith cosines on both sides of the geometric horizon, denser toward it,
// and azimuths at midpoints of half a turn, which the mirror symmetry doubles.
struct directions {
    int zeniths; // above and below together
    int azimuths;
    double mu[4 * GAUSS_MAX];
    double weight[4 * GAUSS_MAX]; // of d mu
    double cos_azimuth[4 * GAUSS_MAX];
    double azimuth_weight;
};

static void fill_directions(struct directions *d, double horizon_mu, int half, int azimuths)
{
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

// What one thread needs; freed as a whole.
struct worker {
    struct ray ray;
    struct directions directions;
    struct transport_scratch *scratch;
    float *sun_mu, *nu;                    // [members]
    float *phase[MEDIUM_MAX_CONSTITUENTS]; // [members]
    lanes *radiance;                       // [members]
};

struct iteration {
    const trl_context *ctx;
    const struct solution *solution;
    const struct solver_settings *settings;
    int members_max;
    int worker_count;
    struct worker *workers;
    double *sun_mu;            // [suns] of the grid
    struct moments before;     // of the order before
    struct moments now;        // of this order
    lanes *norm, *norm_before; // [suns] size of this order and of the one before
    lanes *ratio;              // [suns] of the two, at the order before
    double done;               // share of the work, by the error
    lanes *tail;               // [suns] what is left out, in units of this order
};

// Suns outermost, so that the azimuths of one sun are neighbours.
static void fill_family(struct worker *w, const struct iteration *it, double mu)
{
    const struct directions *d = &w->directions;
    const double sine = sqrt(fmax(0, 1 - mu * mu));
    for (int i = 0; i < it->now.suns; i++) {
        const double sun_mu = it->sun_mu[i];
        const double sun_sine = sqrt(fmax(0, 1 - sun_mu * sun_mu));
        for (int p = 0; p < d->azimuths; p++) {
            w->sun_mu[i * d->azimuths + p] = (float)sun_mu;
            w->nu[i * d->azimuths + p] = (float)(mu * sun_mu + sine * sun_sine * d->cos_azimuth[p]);
        }
    }
}

static void add_first_order(struct worker *w, const struct iteration *it,
                            const struct transport_family *family)
{
    const struct optics *optics = it->now.optics;
    struct transport_channels channels;
    for (int i = 0; i < optics->constituent_count; i++) {
        const bool scatters = optics->vertical_scattering_depth[i] > 0;
        channels.channel[i] = scatters ? 0 : -1;
        channels.phase[i] = w->phase[i];
        for (int t = 0; scatters && t < family->count; t++) {
            // What counts as not scattered is in the direct light already.
            w->phase[i][t] =
                (float)((1 - optics->forward_share[i]) *
                        phase_value(&optics->medium->constituents[i].phase, (double)family->nu[t]));
        }
    }
    lanes *const out[1] = {w->radiance};
    transport_add_single(&it->solution->sun, &w->ray, family, &channels, out, w->scratch);
    transport_add_ground(&it->solution->sun, NULL, &w->ray, family, w->radiance);
}

// a_lm += weight * Y_lm(mu) * integral over the azimuth of L cos(m phi); the ground's irradiance
// likewise.
static void project(struct worker *w, const struct iteration *it, int level, double mu,
                    double weight)
{
    const struct directions *d = &w->directions;
    const int lmax = it->now.lmax;
    const int harmonics = harmonic_count(lmax);
    double harmonic[(OPTICS_MAX_DEGREE + 1) * (OPTICS_MAX_DEGREE + 2) / 2];
    harmonic_values(lmax, mu, harmonic);
    // The first sun stays dark: below the grid, its row is what is looked up.
    for (int i = 1; i < it->now.suns; i++) {
        lanes around[OPTICS_MAX_DEGREE + 1];
        for (int m = 0; m <= lmax; m++) {
            around[m] = lanes_set(0);
        }
        for (int p = 0; p < d->azimuths; p++) {
            const lanes value = w->radiance[i * d->azimuths + p];
            double before = d->cos_azimuth[p];
            double now = 1;
            for (int m = 0; m <= lmax; m++) {
                around[m] += value * (float)(now * d->azimuth_weight * weight);
                const double next = 2 * d->cos_azimuth[p] * now - before;
                before = now;
                now = next;
            }
        }
        lanes *a = it->now.radiance + ((size_t)level * it->now.suns + i) * harmonics;
        for (int l = 0; l <= lmax; l++) {
            for (int m = 0; m <= l; m++) {
                a[harmonic_index(l, m)] += around[m] * (float)harmonic[harmonic_index(l, m)];
            }
        }
        if (level == 0 && mu > 0) {
            it->now.irradiance[i] += around[0] * (float)mu;
        }
    }
}

static void compute_level(const struct iteration *it, struct worker *w, int level, bool is_first)
{
    const struct optics *optics = it->now.optics;
    const struct solver_settings *set = it->settings;
    const double radius_m = moments_level_radius(&it->now, level);
    const double sine = optics->ground_radius_m / radius_m;
    const int finer = is_first ? set->first_refinement : 1;
    fill_directions(&w->directions, -sqrt(fmax(0, 1 - sine * sine)), set->zeniths * finer,
                    set->azimuths * finer);
    const int harmonics = harmonic_count(it->now.lmax);
    memset(it->now.radiance + (size_t)level * it->now.suns * harmonics, 0,
           (size_t)it->now.suns * harmonics * sizeof(lanes));
    for (int q = 0; q < w->directions.zeniths; q++) {
        const struct ray_desc desc = {.radius_m = radius_m,
                                      .mu = w->directions.mu[q],
                                      .nodes_per_shell = is_first ? set->first_nodes_per_shell
                                                                  : set->nodes_per_shell,
                                      .end_m = INFINITY};
        ray_init(&w->ray, optics, it->solution->rules, &desc);
        fill_family(w, it, desc.mu);
        const struct transport_family family = {it->now.suns * w->directions.azimuths, w->sun_mu,
                                                w->nu};
        memset(w->radiance, 0, (size_t)family.count * sizeof(lanes));
        if (is_first) {
            add_first_order(w, it, &family);
        } else {
            transport_add_multiple(&it->before, &w->ray, &family, w->radiance, w->scratch);
            transport_add_ground(NULL, &it->before, &w->ray, &family, w->radiance);
        }
        project(w, it, level, desc.mu, w->directions.weight[q]);
    }
}

// The caller's thread tells how far the work is, and hears whether to stop.
static trl_result compute_order(struct iteration *it, bool is_first)
{
    memset(it->now.irradiance, 0, (size_t)it->now.suns * sizeof(lanes));
    int result = TRL_OK;
#pragma omp parallel for schedule(dynamic) num_threads(it->worker_count)
    for (int level = 0; level < it->now.levels; level++) {
        int so_far;
#pragma omp atomic read
        so_far = result;
        if (so_far != TRL_OK) {
            continue;
        }
        const unsigned state = lanes_flush_denormals();
        compute_level(it, &it->workers[lanes_thread()], level, is_first);
        lanes_restore(state);
        if (lanes_thread() == 0) {
            so_far = trl_progress(it->ctx, "solving the atmosphere", it->done);
            if (so_far != TRL_OK) {
#pragma omp atomic write
                result = so_far;
            }
        }
    }
    return (trl_result)result;
}

// Adds `factor[sun]` times the moments to the sum.
static void accumulate(struct moments *sum, const struct moments *order, const lanes *factor)
{
    const int harmonics = harmonic_count(sum->lmax);
    for (int j = 0; j < sum->levels; j++) {
        for (int i = 0; i < sum->suns; i++) {
            const size_t at = ((size_t)j * sum->suns + i) * harmonics;
            for (int h = 0; h < harmonics; h++) {
                sum->radiance[at + h] += order->radiance[at + h] * factor[i];
            }
        }
    }
    for (int i = 0; i < sum->suns; i++) {
        sum->irradiance[i] += order->irradiance[i] * factor[i];
    }
}

// The mean radiance of each sun's row over the levels.
static void measure(const struct moments *m, lanes *norm)
{
    const int harmonics = harmonic_count(m->lmax);
    for (int i = 0; i < m->suns; i++) {
        norm[i] = lanes_set(0);
        for (int j = 0; j < m->levels; j++) {
            norm[i] += m->radiance[((size_t)j * m->suns + i) * harmonics];
        }
    }
}

// What the orders not computed would add, in units of the last order, as a geometric series for
// each sun and wavelength. Its error is what the ratio still changes from order to order: with d
// ratio, the series is off by d / (1 - ratio)^2. Returns the largest such error relative to the
// sum.
static double close_series(struct iteration *it, const lanes *total, lanes *tail)
{
    double largest = 0;
    for (int i = 0; i < it->now.suns; i++) {
        for (int k = 0; k < LANES; k++) {
            const double before = (double)it->norm_before[i][k];
            const double now = (double)it->norm[i][k];
            const double ratio = before > 0 ? fmin(now / before, 0.9995) : 0;
            const double change = fabs(ratio - (double)it->ratio[i][k]);
            it->ratio[i][k] = (float)ratio;
            tail[i][k] = (float)(ratio / (1 - ratio));
            if ((double)total[i][k] > DARK) {
                const double error = now * change / ((1 - ratio) * (1 - ratio));
                largest = fmax(largest, error / (double)total[i][k]);
            }
        }
    }
    return largest;
}

static trl_result run_orders(struct iteration *it, struct solution *out, lanes *one, lanes *total)
{
    struct moments *sum = &out->moments;
    lanes *tail = it->tail;
    double first_error = 0;
    for (int i = 0; i < sum->suns; i++) {
        one[i] = lanes_set(1);
    }
    for (int order = 1;; order++) {
        if (order == it->settings->orders) {
            return TRL_OK; // the last order is integrated where it is looked at
        }
        const trl_result result = compute_order(it, order == 1);
        if (result != TRL_OK) {
            return result;
        }
        accumulate(sum, &it->now, one);
        lanes *const kept_norm = it->norm_before;
        it->norm_before = it->norm;
        it->norm = kept_norm;
        measure(&it->now, it->norm);
        measure(sum, total);
        out->orders = order;
        const double error = close_series(it, total, tail);
        if (order >= MIN_ORDERS &&
            (error < it->settings->tolerance || order >= it->settings->max_orders)) {
            accumulate(sum, &it->now, tail);
            return TRL_OK;
        }
        first_error = order == MIN_ORDERS - 1 ? fmax(error, 1e-9) : first_error;
        if (order >= MIN_ORDERS) {
            const double done =
                log(fmax(first_error / error, 1)) / log(first_error / it->settings->tolerance);
            it->done = fmax(it->done, fmin(done, 1));
        }
        const struct moments kept = it->before;
        it->before = it->now;
        it->now = kept;
    }
}

static trl_result worker_init(const struct iteration *it, struct worker *w)
{
    const size_t members = (size_t)it->members_max;
    w->sun_mu = mem_alloc(it->ctx, members, sizeof *w->sun_mu);
    w->nu = mem_alloc(it->ctx, members, sizeof *w->nu);
    w->radiance = mem_alloc(it->ctx, members, sizeof *w->radiance);
    bool has_memory = w->sun_mu && w->nu && w->radiance;
    for (int i = 0; i < it->now.optics->constituent_count && has_memory; i++) {
        w->phase[i] = mem_alloc(it->ctx, members, sizeof(float));
        has_memory = w->phase[i] != NULL;
    }
    return has_memory
               ? transport_scratch_create(it->ctx, it->members_max, it->now.suns, &w->scratch)
               : TRL_ERROR_MEMORY;
}

static void iteration_finish(struct iteration *it)
{
    for (int n = 0; it->workers && n < it->worker_count; n++) {
        struct worker *w = &it->workers[n];
        mem_free(it->ctx, w->sun_mu);
        mem_free(it->ctx, w->nu);
        mem_free(it->ctx, w->radiance);
        for (int i = 0; i < MEDIUM_MAX_CONSTITUENTS; i++) {
            mem_free(it->ctx, w->phase[i]);
        }
        transport_scratch_destroy(it->ctx, &w->scratch);
    }
    mem_free(it->ctx, it->workers);
    mem_free(it->ctx, it->sun_mu);
    mem_free(it->ctx, it->norm);
    mem_free(it->ctx, it->norm_before);
    mem_free(it->ctx, it->ratio);
    mem_free(it->ctx, it->tail);
    moments_finish(it->ctx, &it->before);
    moments_finish(it->ctx, &it->now);
}

static trl_result iteration_init(struct iteration *it)
{
    const trl_context *ctx = it->ctx;
    const struct solver_settings *set = it->settings;
    const struct optics *optics = it->solution->optics;
    trl_result result = moments_init(ctx, optics, set->lmax, set->levels, set->suns, &it->before);
    if (result == TRL_OK) {
        result = moments_init(ctx, optics, set->lmax, set->levels, set->suns, &it->now);
    }
    if (result != TRL_OK) {
        return result;
    }
    it->members_max = set->suns * set->azimuths * set->first_refinement;
    it->worker_count = lanes_max_threads();
    it->workers = mem_alloc(ctx, (size_t)it->worker_count, sizeof *it->workers);
    it->sun_mu = mem_alloc(ctx, (size_t)set->suns, sizeof *it->sun_mu);
    it->norm = mem_alloc(ctx, (size_t)set->suns, sizeof(lanes));
    it->norm_before = mem_alloc(ctx, (size_t)set->suns, sizeof(lanes));
    it->ratio = mem_alloc(ctx, (size_t)set->suns, sizeof(lanes));
    it->tail = mem_alloc(ctx, (size_t)set->suns, sizeof(lanes));
    if (!it->workers || !it->sun_mu || !it->norm || !it->norm_before || !it->ratio || !it->tail) {
        return TRL_ERROR_MEMORY;
    }
    for (int i = 0; i < set->suns; i++) {
        it->sun_mu[i] = moments_sun_mu(&it->now, i);
    }
    for (int n = 0; n < it->worker_count && result == TRL_OK; n++) {
        result = worker_init(it, &it->workers[n]);
    }
    return result;
}

trl_result solution_reserve(const trl_context *ctx, const struct optics *optics,
                            const struct solver_settings *settings, struct solution *out)
{
    *out = (struct solution){.optics = optics};
    out->rules = mem_alloc(ctx, 1, sizeof *out->rules);
    trl_result result = out->rules ? sunlight_reserve(ctx, optics, &out->sun) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        ray_rules_init(out->rules);
        result = moments_init(ctx, optics, settings->lmax, settings->levels, settings->suns,
                              &out->moments);
    }
    if (result != TRL_OK) {
        solution_finish(ctx, out);
    }
    return result;
}

static trl_result check_depth(const trl_context *ctx, const struct optics *optics)
{
    for (int k = 0; k < optics->wavelength_count; k++) {
        if (!(optics->vertical_depth[k] <= SOLVER_MAX_DEPTH)) {
            return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SOLVER,
                            "the atmosphere is too dense to be solved: vertical optical depth %.3g "
                            "at %g nm; at most %g",
                            optics->vertical_depth[k], optics->wavelength_nm[k], SOLVER_MAX_DEPTH);
        }
    }
    return TRL_OK;
}

trl_result solution_init(const trl_context *ctx, const struct optics *optics,
                         const struct solver_settings *settings, struct solution *out)
{
    trl_result result = check_depth(ctx, optics);
    if (result == TRL_OK) {
        result = solution_reserve(ctx, optics, settings, out);
    }
    if (result != TRL_OK) {
        return result;
    }
    struct iteration it = {.ctx = ctx, .solution = out, .settings = settings};
    lanes *one = mem_alloc(ctx, (size_t)settings->suns, sizeof(lanes));
    lanes *total = mem_alloc(ctx, (size_t)settings->suns, sizeof(lanes));
    result = one && total ? sunlight_fill(ctx, out->rules, &out->sun) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = iteration_init(&it);
    }
    if (result == TRL_OK) {
        result = run_orders(&it, out, one, total);
    }
    iteration_finish(&it);
    mem_free(ctx, one);
    mem_free(ctx, total);
    if (result != TRL_OK) {
        solution_finish(ctx, out);
    }
    return result;
}

void solution_finish(const trl_context *ctx, struct solution *solution)
{
    mem_free(ctx, solution->rules);
    sunlight_finish(ctx, &solution->sun);
    moments_finish(ctx, &solution->moments);
    *solution = (struct solution){0};
}
