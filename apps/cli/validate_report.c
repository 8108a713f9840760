// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What validate found, on the terminal: a table for people, or JSON.
#include "validate.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const verdict_words[] = {
    [VERDICT_GOOD] = "good", [VERDICT_NOISY] = "noisy", [VERDICT_BAD] = "BAD"};

static void print_answer(const struct validate_answer *answer)
{
    const struct judgement *j = &answer->judgement;
    if (answer->is_there) {
        printf("  %8.*f %8.*f", j->mean < 1 ? 2 : 0, 100 * j->mean, j->largest < 1 ? 2 : 0,
               100 * j->largest);
    } else {
        printf("  %8s %8s", "-", "-");
    }
}

static void print_scene(const struct validate_scene *scene)
{
    printf("\n%s\n  %-7s %4s %9s %7s", trl_scene_name(scene->scene), "", "sun", "paths", "noise");
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        printf("  %8s %8s", trl_sky_model_name((trl_sky_model)m), "largest");
    }
    printf("\n");
    for (int i = 0; i < scene->case_count; i++) {
        const struct validate_case *c = &scene->cases[i];
        const struct judgement *j = &c->answers[TRL_SKY_SPECTRAL].judgement;
        printf("  %-7s %4.0f %9.0f %7.2f", c->place, c->sun_elevation_deg, c->paths,
               100 * j->noise);
        for (int m = 0; m < VALIDATE_MODELS; m++) {
            print_answer(&c->answers[m]);
        }
        printf("  %s\n", verdict_words[j->verdict]);
    }
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        if (scene->refusal[m][0]) {
            printf("  %s has no answer: %s\n", trl_sky_model_name((trl_sky_model)m),
                   scene->refusal[m]);
        }
    }
}

void validate_print_table(const struct validate *v)
{
    printf(
        "Relative errors in %%, beyond the noise of the path tracer: of each view the mean of %d "
        "values\n(%d directions, %d wavelengths) and the largest; noise is the mean standard "
        "error.\n",
        VALIDATE_VALUES, VALIDATE_DIRECTIONS, VALIDATE_WAVELENGTHS);
    for (int s = 0; s < v->scene_count; s++) {
        print_scene(&v->scenes[s]);
    }
    const struct validate_total t = validate_sum(v, NULL, TRL_SKY_SPECTRAL);
    printf(
        "\nspectral: %d views, %d within the bounds (mean 1 %%, largest 2 %%), %d noisier than a "
        "bound,\n%d outside; mean error %.2f %%, largest %.2f %%; %.0f s\n",
        t.views, t.views - t.noisy - t.bad, t.noisy, t.bad, 100 * t.mean, 100 * t.largest,
        v->spent_s);
}

static json_t *pack_answer(const struct validate_case *c, int model)
{
    const struct validate_answer *answer = &c->answers[model];
    const struct judgement *j = &answer->judgement;
    json_t *object = json_pack("{s:f, s:f, s:s}", "mean", j->mean, "largest", j->largest, "verdict",
                               j->verdict == VERDICT_BAD ? "bad" : verdict_words[j->verdict]);
    if (answer->frame_ms > 0) {
        json_object_set_new(object, "frame_ms", json_real(answer->frame_ms));
    }
    json_t *values = json_array();
    for (int i = 0; i < c->count; i++) {
        json_array_append_new(values, json_real(answer->radiance[i]));
    }
    json_object_set_new(object, "radiance", values);
    return object;
}

static json_t *pack_reference(const struct validate_case *c)
{
    json_t *radiance = json_array();
    json_t *error = json_array();
    for (int i = 0; i < c->count; i++) {
        json_array_append_new(radiance, json_real(c->reference[i]));
        json_array_append_new(error, json_real(c->error[i]));
    }
    const struct judgement *j = &c->answers[TRL_SKY_SPECTRAL].judgement;
    return json_pack("{s:f, s:f, s:f, s:o, s:o}", "paths", c->paths, "seconds", c->traced_s,
                     "noise", j->noise, "radiance", radiance, "standard_error", error);
}

static json_t *pack_case(const struct validate_case *c)
{
    json_t *models = json_object();
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        if (c->answers[m].is_there) {
            json_object_set_new(models, trl_sky_model_name((trl_sky_model)m), pack_answer(c, m));
        }
    }
    return json_pack("{s:s, s:f, s:f, s:o, s:o}", "place", c->place, "altitude_m", c->altitude_m,
                     "sun_elevation_deg", c->sun_elevation_deg, "reference", pack_reference(c),
                     "models", models);
}

static json_t *pack_scene(const struct validate_scene *scene)
{
    json_t *views = json_array();
    for (int c = 0; c < scene->case_count; c++) {
        json_array_append_new(views, pack_case(&scene->cases[c]));
    }
    json_t *refusals = json_object();
    json_t *solve_s = json_object();
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        const char *name = trl_sky_model_name((trl_sky_model)m);
        if (scene->refusal[m][0]) {
            json_object_set_new(refusals, name, json_string(scene->refusal[m]));
        } else {
            json_object_set_new(solve_s, name, json_real(scene->solve_s[m]));
        }
    }
    return json_pack("{s:s, s:s, s:o, s:o, s:o}", "name", trl_scene_name(scene->scene), "path",
                     scene->path, "solve_s", solve_s, "refusals", refusals, "views", views);
}

enum exit_status validate_print_json(const struct validate *v)
{
    json_t *scenes = json_array();
    for (int s = 0; s < v->scene_count; s++) {
        json_array_append_new(scenes, pack_scene(&v->scenes[s]));
    }
    const struct validate_total t = validate_sum(v, NULL, TRL_SKY_SPECTRAL);
    json_t *object = json_pack(
        "{s:b, s:{s:f, s:f}, s:{s:i, s:i, s:i, s:f, s:f}, s:f, s:{s:s, s:i, s:f, s:s}, s:o}",
        "passed", t.bad == 0, "bounds", "mean", JUDGE_MEAN_BOUND, "largest", JUDGE_LARGEST_BOUND,
        "spectral", "views", t.views, "noisy", t.noisy, "bad", t.bad, "mean", t.mean, "largest",
        t.largest, "seconds", v->spent_s, "machine", "cpu", v->machine.cpu, "cores",
        v->machine.cores, "load_average", v->machine.load_average, "gl_renderer",
        v->machine.gl_renderer, "scenes", scenes);
    char *text = object ? json_dumps(object, JSON_COMPACT | JSON_REAL_PRECISION(7)) : NULL;
    json_decref(object);
    if (!text) {
        return report_error(EXIT_FAILED, "validate: out of memory");
    }
    printf("%s\n", text);
    free(text);
    return EXIT_OK;
}
