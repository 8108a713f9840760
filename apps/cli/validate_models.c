// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What the models answer, as numbers.
#include "validate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// All queries of a scene, one case after the other.
static size_t gather_queries(const struct validate_scene *scene, trl_sky_query *out)
{
    size_t count = 0;
    for (int c = 0; c < scene->case_count; c++) {
        memcpy(out + count, scene->cases[c].queries, (size_t)scene->cases[c].count * sizeof *out);
        count += (size_t)scene->cases[c].count;
    }
    return count;
}

static void spread_answers(struct validate_scene *scene, int model, const double *radiance)
{
    for (int c = 0; c < scene->case_count; c++) {
        struct validate_answer *answer = &scene->cases[c].answers[model];
        const size_t count = (size_t)scene->cases[c].count;
        answer->is_there = true;
        memcpy(answer->radiance, radiance, count * sizeof *radiance);
        radiance += count;
    }
}

// A model other than the spectral one may refuse a scene; then it says why and has no answers.
static enum exit_status ask_model(struct validate *v, struct validate_scene *scene, int model)
{
    enum { MOST = VALIDATE_CASES * VALIDATE_VALUES };
    trl_sky_query queries[MOST];
    double radiance[MOST];
    const size_t count = gather_queries(scene, queries);
    trl_sky_desc desc = trl_sky_desc_default();
    desc.model = (trl_sky_model)model;
    v->app->holds_errors = model != TRL_SKY_SPECTRAL;
    const double begun_s = progress_clock_s();
    const trl_result result =
        trl_sky_radiance(v->app->ctx, scene->scene, &desc, queries, count, radiance, NULL);
    scene->solve_s[model] = progress_clock_s() - begun_s;
    v->app->holds_errors = false;
    if (result == TRL_OK) {
        spread_answers(scene, model, radiance);
    } else if (result == TRL_ERROR_INVALID && model != TRL_SKY_SPECTRAL) {
        snprintf(scene->refusal[model], sizeof scene->refusal[model], "%.190s", v->app->held_error);
    } else {
        if (model != TRL_SKY_SPECTRAL) {
            report_error(EXIT_FAILED, "%s", v->app->held_error);
        }
        return EXIT_FAILED;
    }
    return EXIT_OK;
}

enum exit_status validate_ask_models(struct validate *v)
{
    enum exit_status status = EXIT_OK;
    for (int s = 0; status == EXIT_OK && s < v->scene_count; s++) {
        struct validate_scene *scene = &v->scenes[s];
        const double share = progress_clock_s() - v->app->progress.started_s;
        char stage[80];
        snprintf(stage, sizeof stage, "%.40s by the models", trl_scene_name(scene->scene));
        const double at = fmin(share / v->budget_s, 0.9);
        progress_set_part(&v->app->progress, stage, at, at + 0.01);
        for (int m = 0; status == EXIT_OK && m < VALIDATE_MODELS; m++) {
            status = ask_model(v, scene, m);
        }
    }
    return status;
}
