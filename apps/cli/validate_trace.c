// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The path tracer's answers, as exact as the time allows.
//
// A first round tells how noisy each view is and what a path costs there. The paths of the others
// are then spread so that the sum of the variances is least (Neyman 1934): proportional to the
// noise of one path over the root of its cost. Rounds are independent, averaged by their paths.
#include "validate.h"

#include <math.h>
#include <stdio.h>

enum { FIRST_PATHS = 1000, QUICK_FIRST_PATHS = 200 };
static const double ENOUGH = 0.0008; // mean relative standard error below which nobody needs more

// What one view asks for.
struct plan {
    struct validate_case *c;
    const struct validate_scene *scene;
    double noise;      // mean relative standard error of one path
    double cost_s;     // of one path of every value
    double begin, end; // of its next round, as shares of the whole work
};

static void merge(struct validate_case *c, double paths, const double *radiance,
                  const double *error)
{
    const double all = c->paths + paths;
    for (int i = 0; i < c->count; i++) {
        const double old = c->paths / all;
        const double new = paths / all;
        c->reference[i] = old * c->reference[i] + new *radiance[i];
        c->error[i] = hypot(old * c->error[i], new *error[i]);
    }
    c->paths = all;
}

// One more round; `seed` must differ from those before.
static enum exit_status trace(struct validate *v, const struct plan *plan, double paths,
                              uint64_t seed)
{
    struct validate_case *c = plan->c;
    trl_sky_desc desc = trl_sky_desc_default();
    desc.model = TRL_SKY_REFERENCE;
    desc.paths = (uint64_t)paths;
    desc.seed = seed;
    double radiance[VALIDATE_VALUES];
    double error[VALIDATE_VALUES];
    const double begun_s = progress_clock_s();
    char stage[80];
    snprintf(stage, sizeof stage, "%.30s, %s, sun at %.0f deg", trl_scene_name(plan->scene->scene),
             c->place, c->sun_elevation_deg);
    progress_set_part(&v->app->progress, stage, plan->begin, plan->end);
    const trl_result result = trl_sky_radiance(v->app->ctx, plan->scene->scene, &desc, c->queries,
                                               (size_t)c->count, radiance, error);
    c->traced_s += progress_clock_s() - begun_s;
    if (result == TRL_OK) {
        merge(c, floor(paths), radiance, error);
    }
    return report_result(result);
}

static double mean_noise(const struct validate_case *c)
{
    double sum = 0;
    for (int i = 0; i < c->count; i++) {
        sum += c->error[i] / fmax(fabs(c->reference[i]), 1e-300);
    }
    return sum / c->count;
}

static int list_plans(struct validate *v, struct plan *plans)
{
    int count = 0;
    for (int s = 0; s < v->scene_count; s++) {
        for (int c = 0; c < v->scenes[s].case_count; c++) {
            plans[count++] = (struct plan){.c = &v->scenes[s].cases[c], .scene = &v->scenes[s]};
        }
    }
    return count;
}

// Paths for this view so that all views from it on take the time that is left.
static double choose_paths(const struct plan *plans, int count, double left_s)
{
    double whole_s = 0;
    for (int i = 0; i < count; i++) {
        const double weight = plans[i].noise / sqrt(plans[i].cost_s);
        whole_s += weight * plans[i].cost_s;
    }
    const double paths = plans[0].noise / sqrt(plans[0].cost_s) * left_s / whole_s;
    const double enough = pow(plans[0].noise / ENOUGH, 2);
    return fmax(fmin(paths, enough), 2);
}

static enum exit_status trace_fixed(struct validate *v, struct plan *plans, int count)
{
    enum exit_status status = EXIT_OK;
    for (int i = 0; status == EXIT_OK && i < count; i++) {
        plans[i].begin = (double)i / count;
        plans[i].end = (double)(i + 1) / count;
        status = trace(v, &plans[i], v->paths, 0);
    }
    return status;
}

static double spent_s(const struct validate *v)
{
    return progress_clock_s() - v->app->progress.started_s;
}

// The next round of a view takes this long, out of the time that there is.
static void set_share(const struct validate *v, struct plan *plan, double round_s)
{
    plan->begin = fmin(spent_s(v) / v->budget_s, 0.99);
    plan->end = fmin(plan->begin + round_s / v->budget_s, 1);
}

enum exit_status validate_trace(struct validate *v)
{
    struct plan plans[VALIDATE_MAX_SCENES * VALIDATE_CASES];
    const int count = list_plans(v, plans);
    if (v->paths > 0) {
        return trace_fixed(v, plans, count);
    }
    const double first = v->is_quick ? QUICK_FIRST_PATHS : FIRST_PATHS;
    enum exit_status status = EXIT_OK;
    for (int i = 0; status == EXIT_OK && i < count; i++) {
        set_share(v, &plans[i], 0.1 * v->budget_s / count);
        status = trace(v, &plans[i], first, 0);
        plans[i].noise = mean_noise(plans[i].c) * sqrt(first);
        plans[i].cost_s = fmax(plans[i].c->traced_s, 1e-6) / first;
    }
    // What one view does not need is there for the next ones.
    for (int i = 0; status == EXIT_OK && i < count; i++) {
        const double left_s = v->budget_s - spent_s(v);
        if (left_s > 0) {
            const double paths = choose_paths(&plans[i], count - i, left_s);
            set_share(v, &plans[i], paths * plans[i].cost_s);
            status = trace(v, &plans[i], paths, 1);
        }
    }
    return status;
}
