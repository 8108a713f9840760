// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What validate found, on the terminal: a table for people, or JSON.
#include "validate.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const verdict_words[] = {[VERDICT_GOOD] = "within",
                                            [VERDICT_MEAN] = "mean within",
                                            [VERDICT_NOISY] = "noisy",
                                            [VERDICT_BAD] = "OUTSIDE"};
static const char *const verdict_codes[] = {[VERDICT_GOOD] = "good",
                                            [VERDICT_MEAN] = "mean",
                                            [VERDICT_NOISY] = "noisy",
                                            [VERDICT_BAD] = "bad"};

// Of a view, beyond which a mean error says no more than that it is dark there.
static const double MOST_NOISE = 0.1;

// In %, 8 columns wide.
static void print_percent(double share, bool is_known)
{
    if (is_known) {
        printf(" %8.*f", share < 1 ? 2 : 0, 100 * share);
    } else {
        printf(" %8s", "-");
    }
}

static void print_answer(const struct validate_answer *answer, bool is_telling)
{
    const struct judgement *j = &answer->judgement;
    print_percent(j->mean, answer->is_there && is_telling);
    print_percent(j->largest, answer->is_there && j->known > 0);
}

double validate_mean_paths(const struct validate_case *c)
{
    double sum = 0;
    for (int i = 0; i < c->count; i++) {
        sum += c->paths[i];
    }
    return c->count > 0 ? sum / c->count : 0;
}

bool validate_is_telling(const struct validate_case *c)
{
    return c->answers[TRL_SKY_SPECTRAL].judgement.noise <= MOST_NOISE;
}

static void print_verdict(const struct validate_case *c, enum verdict verdict)
{
    printf("  %s", verdict_words[verdict]);
    const double missing_s = validate_missing_s(c);
    if (verdict == VERDICT_NOISY && missing_s >= 1) {
        const char *unit = missing_s < 120 ? "s" : missing_s < 7200 ? "min" : "h";
        const double unit_s = missing_s < 120 ? 1 : missing_s < 7200 ? 60 : 3600;
        printf(", %.0f %s more", missing_s / unit_s, unit);
    }
    printf("\n");
}

static void print_case(const struct validate_case *c)
{
    const struct judgement *j = &c->answers[TRL_SKY_SPECTRAL].judgement;
    const bool is_telling = validate_is_telling(c);
    printf("  %-7s %3.0f %8.0f %7.2f", c->place, c->sun_elevation_deg, validate_mean_paths(c),
           100 * j->noise);
    if (is_telling) {
        printf(" %+7.2f +- %4.2f", 100 * j->signed_mean, 100 * j->signed_noise);
    } else {
        printf(" %15s", "-");
    }
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        print_answer(&c->answers[m], is_telling);
    }
    print_verdict(c, j->verdict);
}

static void print_scene(const struct validate_scene *scene)
{
    printf("\n%s\n  %-7s %3s %8s %7s %15s", trl_scene_name(scene->scene), "", "sun", "paths",
           "noise", "signed mean");
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        printf(" %8s %8s", trl_sky_model_name((trl_sky_model)m), "largest");
    }
    printf("\n");
    for (int i = 0; i < scene->case_count; i++) {
        print_case(&scene->cases[i]);
    }
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        if (scene->refusal[m][0]) {
            printf("  %s has no answer: %s\n", trl_sky_model_name((trl_sky_model)m),
                   scene->refusal[m]);
        }
    }
}

static void print_explanation(void)
{
    printf(
        "Relative errors in %%, of %d values a view (%d directions, %d wavelengths). noise: mean "
        "standard\nerror of the path tracer's values. signed mean: of the spectral model, with "
        "its standard error.\nUnder each model the mean size of its errors with what noise adds "
        "taken out, and the largest\nbeyond its noise (-: too noisy to tell). Words are "
        "about spectral (mean 1 %%, largest 2 %%):\n"
        "  within       the mean size is shown to be, and noise hides no value that is not\n"
        "  mean within  only the signed mean is shown to be: noise hides sizes\n"
        "  noisy        not decided in this time, and how much more it needs, if noise is known\n"
        "  OUTSIDE      noise does not explain it\n",
        VALIDATE_VALUES, VALIDATE_DIRECTIONS, VALIDATE_WAVELENGTHS);
}

void validate_print_table(const struct validate *v)
{
    print_explanation();
    for (int s = 0; s < v->scene_count; s++) {
        print_scene(&v->scenes[s]);
    }
    const struct validate_total t = validate_sum(v, NULL, TRL_SKY_SPECTRAL);
    printf(
        "\nspectral: %d views: %d within the bounds, %d within in the mean, %d noisy, %d "
        "outside;\nover %d views with a noise below %.0f %%: signed mean %+.2f +- %.2f %%, largest "
        "%.2f %%; %.0f s\n",
        t.views, t.good, t.mean_only, t.noisy, t.bad, t.known, 100 * JUDGE_KNOWN_NOISE,
        100 * t.signed_mean, 100 * sqrt(t.variance) / fmax(t.known, 1), 100 * t.largest,
        v->spent_s);
    for (int look = 0; v->clouds.paths > 0 && look < CLOUD_LOOKS; look++) {
        const struct cloud_figures *f = &v->clouds.looks[look].figures;
        printf("clouds, %s: luminance %.3f of traced; pixels off by %.0f to %.0f %%\n",
               cloud_look_name(look), f->ratio, 100 * f->least_size, 100 * f->rms);
    }
}

static json_t *pack_clouds(const struct validate_clouds *clouds)
{
    json_t *looks = json_array();
    for (int look = 0; clouds->paths > 0 && look < CLOUD_LOOKS; look++) {
        const struct cloud_figures *f = &clouds->looks[look].figures;
        json_array_append_new(looks,
                              json_pack("{s:s, s:f, s:f, s:f, s:f, s:[f, f, f], s:[f, f]}", "look",
                                        cloud_look_name(look), "mean_luminance_cd_m2",
                                        f->traced_cd_m2, "drawn_over_traced", f->ratio,
                                        "pixel_error_at_least", f->least_size, "pixel_error_rms",
                                        f->rms, "thirds", f->thirds[0], f->thirds[1], f->thirds[2],
                                        "contrast_drawn_traced", f->contrast[0], f->contrast[1]));
    }
    return looks;
}

static json_t *pack_answer(const struct validate_case *c, int model)
{
    const struct validate_answer *answer = &c->answers[model];
    const struct judgement *j = &answer->judgement;
    json_t *object = json_pack("{s:f, s:f, s:f, s:[f, f], s:f, s:i, s:s}", "signed_mean",
                               j->signed_mean, "signed_noise", j->signed_noise, "mean", j->mean,
                               "mean_range", j->mean_low, j->mean_high, "largest", j->largest,
                               "known", j->known, "verdict", verdict_codes[j->verdict]);
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
    json_t *paths = json_array();
    for (int i = 0; i < c->count; i++) {
        json_array_append_new(radiance, json_real(c->reference[i]));
        json_array_append_new(error, json_real(c->error[i]));
        json_array_append_new(paths, json_real(c->paths[i]));
    }
    const struct judgement *j = &c->answers[TRL_SKY_SPECTRAL].judgement;
    return json_pack("{s:o, s:f, s:f, s:f, s:o, s:o}", "paths", paths, "seconds", c->traced_s,
                     "noise", j->noise, "largest_noise", j->largest_noise, "radiance", radiance,
                     "standard_error", error);
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
        "{s:b, s:{s:f, s:f}, s:{s:i, s:i, s:i, s:i, s:i, s:i, s:f, s:f, s:f}, s:f, "
        "s:{s:s, s:i, s:f, s:s}, "
        "s:o, s:o}",
        "passed", t.bad == 0, "bounds", "mean", JUDGE_MEAN_BOUND, "largest", JUDGE_LARGEST_BOUND,
        "spectral", "views", t.views, "good", t.good, "mean_only", t.mean_only, "noisy", t.noisy,
        "bad", t.bad, "known", t.known, "signed_mean", t.signed_mean, "mean", t.mean, "largest",
        t.largest, "seconds", v->spent_s, "machine", "cpu", v->machine.cpu, "cores",
        v->machine.cores, "load_average", v->machine.load_average, "gl_renderer",
        v->machine.gl_renderer, "scenes", scenes, "clouds", pack_clouds(&v->clouds));
    char *text = object ? json_dumps(object, JSON_COMPACT | JSON_REAL_PRECISION(7)) : NULL;
    json_decref(object);
    if (!text) {
        return report_error(EXIT_FAILED, "validate: out of memory");
    }
    printf("%s\n", text);
    free(text);
    return EXIT_OK;
}
