// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The path tracer's answers, as exact as the time allows.
//
// A probe tells how noisy each value is and what its paths cost. Then views are decided one by one,
// always the one that is cheapest to decide: first the means of views by day, then means and single
// values of all. What a decision needs is spread over the view's values so that it costs least: the
// standard error of a mean falls fastest for its time where paths are proportional to the noise of
// one (Neyman 1934). Rounds are independent, averaged by their paths.
#include "validate.h"

#include <math.h>
#include <stdio.h>

enum { PROBE_PATHS = 128, QUICK_PROBE_PATHS = 64 };
// A round gives a value at most so many times the paths that its noise is known from.
static const double GROWTH = 16;
static const double PIECE_SHARE = 0.005; // of the time, for one call
// What is aimed at is a little more than needed: noise is known only roughly.
static const double RESERVE = 1.1;
// Sun elevation from which the mean of a view is of first interest, and the share of the time that
// such views may take together: under dense clouds they never end.
static const double DAY_DEG = 10;
static const double DAY_SHARE = 0.45;

// Standard errors that decide: of the mean by day, of the mean, and of each value.
enum aim { AIM_DAY_MEAN, AIM_MEAN, AIM_VALUES, AIM_NONE };
static const double aims[] = {[AIM_DAY_MEAN] = 0.004, [AIM_MEAN] = 0.0028, [AIM_VALUES] = 0.0040};

// What would decide a view next.
struct plan {
    struct validate_case *c;
    const struct validate_scene *scene;
    enum aim aim;
    double more[VALIDATE_VALUES]; // paths
    double cost_s;
};

struct plans {
    struct plan of[VALIDATE_MAX_SCENES * VALIDATE_CASES];
    int count;
    double day_s; // left for means by day
};

// Values of a view that get the same number of paths at once.
struct batch {
    int first, count;
    double paths;
};

double validate_spent_s(const struct validate *v)
{
    return progress_clock_s() - v->app->progress.started_s;
}

static struct judge_values reference_values(const struct validate_case *c)
{
    return (struct judge_values){
        .reference = c->reference, .standard_error = c->error, .count = c->count, .trials = 1};
}

double validate_path_noise(const struct validate_case *c, int index)
{
    const struct judge_values values = reference_values(c);
    const double scale = judge_scale(&values, index);
    const double paths = fmax(c->paths[index], 1);
    return scale > 0 ? c->error[index] / scale * sqrt(paths) : 0;
}

double validate_path_cost_s(const struct validate_case *c)
{
    return fmax(c->traced_s, 1e-6) / fmax(c->traced_paths, 1);
}

static void merge(struct validate_case *c, int index, double paths, const double found[2])
{
    const double all = c->paths[index] + paths;
    const double old = c->paths[index] / all;
    const double new = paths / all;
    c->reference[index] = old * c->reference[index] + new *found[0];
    c->error[index] = hypot(old * c->error[index], new *found[1]);
    c->paths[index] = all;
}

// In a round of its own.
static enum exit_status trace(struct validate *v, const struct plan *plan,
                              const struct batch *batch)
{
    struct validate_case *c = plan->c;
    const double paths = floor(batch->paths);
    trl_sky_desc desc = trl_sky_desc_default();
    desc.model = TRL_SKY_REFERENCE;
    desc.paths = (uint64_t)paths;
    desc.seed = v->rounds++;
    double radiance[VALIDATE_VALUES];
    double error[VALIDATE_VALUES];
    const double begun_s = progress_clock_s();
    const trl_result result =
        trl_sky_radiance(v->app->ctx, plan->scene->scene, &desc, c->queries + batch->first,
                         (size_t)batch->count, radiance, error);
    c->traced_s += progress_clock_s() - begun_s;
    c->traced_paths += paths * batch->count;
    for (int i = 0; result == TRL_OK && i < batch->count; i++) {
        merge(c, batch->first + i, paths, (const double[2]){radiance[i], error[i]});
    }
    return report_result(result);
}

// What is traced next is this part of the whole work.
static void tell(struct validate *v, const struct plan *plan, double begin, double end)
{
    char stage[80];
    snprintf(stage, sizeof stage, "%.30s, %s, sun at %.0f deg", trl_scene_name(plan->scene->scene),
             plan->c->place, plan->c->sun_elevation_deg);
    progress_set_part(&v->app->progress, stage, fmin(begin, 0.99), fmin(end, 1));
}

static void list_plans(struct validate *v, struct plans *plans)
{
    plans->count = 0;
    for (int s = 0; s < v->scene_count; s++) {
        for (int c = 0; c < v->scenes[s].case_count; c++) {
            plans->of[plans->count++] =
                (struct plan){.c = &v->scenes[s].cases[c], .scene = &v->scenes[s]};
        }
    }
}

enum exit_status validate_probe(struct validate *v)
{
    struct plans plans = {.count = 0};
    list_plans(v, &plans);
    const double probe = v->is_quick ? QUICK_PROBE_PATHS : PROBE_PATHS;
    const double paths = v->paths > 0 ? v->paths : probe;
    const double begin = v->paths > 0 ? 0 : validate_spent_s(v) / v->budget_s;
    const double share = v->paths > 0 ? 1 : 0.1;
    enum exit_status status = EXIT_OK;
    for (int i = 0; status == EXIT_OK && i < plans.count; i++) {
        const struct batch batch = {0, plans.of[i].c->count, paths};
        tell(v, &plans.of[i], begin + share * i / plans.count,
             begin + share * (i + 1) / plans.count);
        status = trace(v, &plans.of[i], &batch);
    }
    return status;
}

// Paths of each value, in `wanted`, with which the plan's aim is reached at least cost.
static void want_paths(const struct plan *plan, double *wanted)
{
    const double n = plan->c->count;
    double sum = 0;
    for (int i = 0; i < plan->c->count; i++) {
        sum += validate_path_noise(plan->c, i);
    }
    for (int i = 0; i < plan->c->count; i++) {
        const double noise = validate_path_noise(plan->c, i);
        wanted[i] = plan->aim == AIM_VALUES ? pow(noise / aims[plan->aim], 2)
                                            : noise * sum / pow(n * aims[plan->aim], 2);
    }
}

static bool is_reached(const struct plan *plan)
{
    double variance = 0;
    double largest = 0;
    for (int i = 0; i < plan->c->count; i++) {
        const double paths = fmax(plan->c->paths[i], 1);
        const double noise = validate_path_noise(plan->c, i) / sqrt(paths);
        variance += noise * noise;
        largest = fmax(largest, noise);
    }
    return plan->aim == AIM_VALUES ? largest <= aims[plan->aim]
                                   : sqrt(variance) / plan->c->count <= aims[plan->aim];
}

double validate_missing_s(const struct validate_case *c)
{
    // Only read.
    const struct plan plan = {.c = (struct validate_case *)c, .aim = AIM_MEAN};
    double wanted[VALIDATE_VALUES];
    want_paths(&plan, wanted);
    double paths = 0;
    for (int i = 0; i < c->count; i++) {
        paths += fmax(0, RESERVE * wanted[i] - c->paths[i]);
    }
    return paths * validate_path_cost_s(c);
}

// Looks at what the view needs next, now that more is known of its noise.
static void update(struct plan *plan)
{
    while (plan->aim != AIM_NONE && is_reached(plan)) {
        plan->aim++;
    }
    plan->cost_s = 0;
    if (plan->aim == AIM_NONE) {
        return;
    }
    double wanted[VALIDATE_VALUES];
    want_paths(plan, wanted);
    for (int i = 0; i < plan->c->count; i++) {
        plan->more[i] = fmax(0, RESERVE * wanted[i] - plan->c->paths[i]);
        plan->cost_s += plan->more[i] * validate_path_cost_s(plan->c);
    }
}

static struct plan *find_cheapest(struct plans *plans, bool is_for_day)
{
    struct plan *found = NULL;
    for (int i = 0; i < plans->count; i++) {
        struct plan *plan = &plans->of[i];
        const bool is_wanted = is_for_day ? plan->aim == AIM_DAY_MEAN : plan->aim != AIM_NONE;
        if (is_wanted && (!found || plan->cost_s < found->cost_s)) {
            found = plan;
        }
    }
    return found;
}

// Paths for one value, in pieces that are short against the time of the run: what its paths cost is
// known only in the mean of the view, and other work may slow them down.
static enum exit_status follow_value(struct validate *v, struct plan *plan, int index, double paths)
{
    enum exit_status status = EXIT_OK;
    while (status == EXIT_OK && paths >= 2 && validate_spent_s(v) < v->budget_s) {
        const double cost_s = validate_path_cost_s(plan->c);
        const double piece = fmax(2, PIECE_SHARE * v->budget_s / cost_s);
        const struct batch batch = {index, 1, fmin(paths, piece)};
        const double begin = validate_spent_s(v) / v->budget_s;
        tell(v, plan, begin, begin + batch.paths * cost_s / v->budget_s);
        status = trace(v, plan, &batch);
        paths -= floor(batch.paths);
    }
    return status;
}

// One round of paths toward the plan's aim, in the time that is left.
static enum exit_status follow(struct validate *v, struct plan *plan)
{
    const double left_s = v->budget_s - validate_spent_s(v);
    const double share = fmin(1, left_s / plan->cost_s);
    enum exit_status status = EXIT_OK;
    for (int i = 0; status == EXIT_OK && i < plan->c->count; i++) {
        const double most = GROWTH * plan->c->paths[i];
        status = follow_value(v, plan, i, fmin(share * plan->more[i], most));
    }
    return status;
}

enum exit_status validate_trace(struct validate *v)
{
    struct plans plans = {.day_s = DAY_SHARE * (v->budget_s - validate_spent_s(v))};
    list_plans(v, &plans);
    for (int i = 0; i < plans.count; i++) {
        const bool is_day = plans.of[i].c->sun_elevation_deg >= DAY_DEG;
        plans.of[i].aim = is_day ? AIM_DAY_MEAN : AIM_MEAN;
        update(&plans.of[i]);
    }
    enum exit_status status = EXIT_OK;
    while (v->paths == 0 && status == EXIT_OK && validate_spent_s(v) < v->budget_s) {
        struct plan *plan = plans.day_s > 0 ? find_cheapest(&plans, true) : NULL;
        plan = plan ? plan : find_cheapest(&plans, false);
        if (!plan) {
            break;
        }
        const double begun_s = validate_spent_s(v);
        const double paths = plan->c->traced_paths;
        status = follow(v, plan);
        plans.day_s -= plan->aim == AIM_DAY_MEAN ? validate_spent_s(v) - begun_s : 0;
        update(plan);
        if (plan->c->traced_paths == paths) {
            plan->aim = AIM_NONE; // what is missing is less than a path
        }
    }
    return status;
}
