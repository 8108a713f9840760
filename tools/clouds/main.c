// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Finds the numbers of cloud_several, cloud_from_above, cloud_turn and cloud_horizon
// (shaders/shared/cloud.glsl) from light by paths in seven kinds of layers, and says how far the
// laws as they stand are off in fields that the numbers were not found in.
//
//     fit-clouds [PLACES [PATHS]]     of each of the layers; 400 and 64
#include "fit.h"

#include "shared/cloud.glsl"
#include <terrella/context.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct field {
    const char *name;
    struct cloud_layer layer;
    uint32_t seed;
    bool is_held; // not used for fitting
};

static const struct field fields[] = {
    {"cumulus",
     {CLOUD_CUMULUS, 900, 2600, 0.1, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE},
     21,
     false},
    {"cumulus",
     {CLOUD_CUMULUS, 900, 2600, 0.2, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE},
     22,
     false},
    {"cumulus", {CLOUD_CUMULUS, 900, 2600, 0.3, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE}, 0, false},
    {"cumulus", {CLOUD_CUMULUS, 900, 2600, 0.5, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE}, 1, false},
    {"cumulus", {CLOUD_CUMULUS, 900, 2600, 0.6, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE}, 4, false},
    {"cumulus", {CLOUD_CUMULUS, 900, 2600, 0.8, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE}, 7, false},
    {"cumulus",
     {CLOUD_CUMULUS, 900, 2600, 0.95, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE},
     9,
     false},
    {"thin cumulus",
     {CLOUD_CUMULUS, 900, 2600, 0.6, 0.01, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE},
     2,
     false},
    {"stratus",
     {CLOUD_STRATUS, 600, 1400, 0.8, 0.03, 16000, 0, 0, 0.9, CLOUD_EVERYWHERE},
     0,
     false},
    {"deck", {CLOUD_STRATUS, 600, 1400, 1, 0.03, 16000, 0, 0, 0.9, CLOUD_EVERYWHERE}, 1, false},
    {"high deck",
     {CLOUD_STRATUS, 3600, 14000, 0.95, 0.01, 40000, 0, 0, 0.9, CLOUD_EVERYWHERE},
     3,
     false},
    {"cirrus",
     {CLOUD_CIRRUS, 8500, 9500, 0.5, 1e-3, 40000, 0, 6000, 0.7, CLOUD_EVERYWHERE},
     0,
     false},
    {"fog", {CLOUD_FOG, 0, 120, 0.9, 0.015, 5000, 0, 0, 0, CLOUD_EVERYWHERE}, 0, false},
    {"cumulus",
     {CLOUD_CUMULUS, 900, 2600, 0.15, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE},
     23,
     true},
    {"cumulus", {CLOUD_CUMULUS, 900, 2600, 0.4, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE}, 5, true},
    {"cumulus", {CLOUD_CUMULUS, 900, 2600, 0.7, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE}, 12, true},
    {"cumulus", {CLOUD_CUMULUS, 900, 2600, 0.9, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE}, 11, true},
    {"thin cumulus",
     {CLOUD_CUMULUS, 900, 2600, 0.5, 0.01, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE},
     5,
     true},
    {"stratus",
     {CLOUD_STRATUS, 600, 1400, 0.6, 0.03, 16000, 0, 0, 0.9, CLOUD_EVERYWHERE},
     2,
     true}};
enum { FIELDS = sizeof fields / sizeof *fields };

static struct CloudAround around_of(const struct cloud_sample *s)
{
    return (struct CloudAround){.side = s->side,
                                .whole = s->whole,
                                .above = s->around_above,
                                .below = s->around_below,
                                .cover = s->cover};
}

// cloud_several with its numbers in their order.
static double several_law(const double *n, const struct cloud_sample *s)
{
    const double enough =
        1 - exp(-fabs(n[0]) * s->side * (0.1 + s->around_above + s->around_below));
    const double few = fabs(n[1]) * cloud_phase(s->nu, CLOUD_TURNED) * enough *
                       exp(-fabs(n[2]) * s->depth - fabs(n[3]) * s->far);
    const double turned =
        s->side * fmax(fabs(n[4]) + fabs(n[5]) * s->around_below + n[6] * s->around_above, 0);
    const double wide = s->cover / (s->cover + fabs(n[11]));
    const double closed = pow(s->cover, 8);
    const double lit = s->sun_mu * (fabs(n[7]) / (1 + fabs(n[8]) * s->sun_mu) * (1 - closed) +
                                    fabs(n[12]) * closed);
    const double many = lit * wide * turned / (1 + turned) / (1 + fabs(n[9]) * s->depth) *
                        exp(-fabs(n[10]) * s->far);
    return few + many;
}

static double above_law(const double *n, const struct cloud_sample *s)
{
    const double high = fmin(fmax(s->height, 0), 1);
    const double over = n[0] * s->side * s->around_above + n[1] * s->whole * (1 - high);
    const double under = n[0] * s->side * s->around_below + n[1] * s->whole * high;
    const double tilt = exp(n[2] * s->view_mu);
    return (tilt + under) / (tilt + 1 / tilt + over + under);
}

static double turn_law(const double *n, const struct cloud_sample *s)
{
    return CLOUD_MEAN_COSINE * s->toward / (1 + fabs(n[0]) * s->whole) +
           n[1] / (1 + fabs(n[2]) * s->depth) - n[3];
}

static double horizon_law(const double *n, const struct cloud_sample *s)
{
    const double ahead = n[0] * exp(-2.5 * fabs(s->view_mu)) - n[1];
    return s->horizon_mean *
           (ahead / (1 + fabs(n[2]) * s->whole) + n[3] / (1 + fabs(n[4]) * s->depth));
}

static double once_as_it_stands(const double *n, const struct cloud_sample *s)
{
    (void)n;
    return cloud_phase(s->nu, 1) * exp(-s->depth - s->far);
}

static double several_as_it_stands(const double *n, const struct cloud_sample *s)
{
    (void)n;
    return cloud_several(around_of(s), cloud_phase(s->nu, CLOUD_TURNED), s->sun_mu, s->depth,
                         s->far);
}

static double above_as_it_stands(const double *n, const struct cloud_sample *s)
{
    (void)n;
    return cloud_from_above(around_of(s), s->height, s->view_mu);
}

static double turn_as_it_stands(const double *n, const struct cloud_sample *s)
{
    (void)n;
    return cloud_turn(s->toward, s->whole, s->depth);
}

static double horizon_as_it_stands(const double *n, const struct cloud_sample *s)
{
    (void)n;
    return s->horizon_mean * cloud_horizon(s->view_mu, s->whole, s->depth);
}

static double once_of(const struct cloud_sample *s)
{
    return s->once;
}
static double several_of(const struct cloud_sample *s)
{
    return s->several;
}
static double above_of(const struct cloud_sample *s)
{
    return s->above;
}
static double turned_of(const struct cloud_sample *s)
{
    return s->turned;
}
static double horizon_of(const struct cloud_sample *s)
{
    return s->horizon;
}

static void print_fit(struct fit fit, const struct cloud_sample *samples, size_t count)
{
    fit_numbers(&fit, samples, count);
    printf("%s:", fit.name);
    for (int i = 0; i < fit.count; i++) {
        printf(" %.4g", fit.numbers[i]);
    }
    printf("\n");
}

// The law over what was measured, in the mean, where that is of one sign, and the mean size of its
// errors over that of what was measured.
static void print_judged(const struct fit *fit, const struct cloud_sample *samples, size_t count)
{
    double measured = 0, size = 0, said = 0, off = 0;
    for (size_t i = 0; i < count; i++) {
        const double law = fit->law(NULL, &samples[i]), wanted = fit->measured(&samples[i]);
        measured += wanted;
        size += fabs(wanted);
        said += law;
        off += fabs(law - wanted);
    }
    printf("  %s", fit->name);
    if (measured > 0.9 * size) {
        printf(" %.3f", said / measured);
    }
    printf(" (%.2f)", off / size);
}

static void judge(const struct field *field, const struct cloud_sample *samples, size_t count)
{
    const struct fit laws[] = {{"once", once_as_it_stands, once_of, 0, 0, {0}},
                               {"several", several_as_it_stands, several_of, 0, 0, {0}},
                               {"above", above_as_it_stands, above_of, 0, 0, {0}},
                               {"turned", turn_as_it_stands, turned_of, 0, 0, {0}},
                               {"level", horizon_as_it_stands, horizon_of, 0, 0, {0}}};
    printf("%-12s cover %.2f%s", field->name, field->layer.cover,
           field->is_held ? ", held out:" : ":");
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        print_judged(&laws[i], samples, count);
    }
    printf("\n");
}

static trl_result run(const trl_context *ctx, const struct cloud_sky *sky, size_t places,
                      size_t paths)
{
    struct cloud_sample *samples = malloc(FIELDS * places * sizeof *samples);
    trl_result result = samples ? TRL_OK : TRL_ERROR_MEMORY;
    size_t fitted = 0;
    for (int i = 0; i < FIELDS && result == TRL_OK; i++) {
        const struct cloud_plan plan = {fields[i].layer, fields[i].seed, places, paths, sky};
        result = cloud_samples_make(ctx, &plan, samples + (size_t)i * places);
        if (result == TRL_OK) {
            judge(&fields[i], samples + (size_t)i * places, places);
            fitted += fields[i].is_held ? 0 : places;
        }
    }
    if (result == TRL_OK) {
        const struct fit several = {
            "cloud_several",
            several_law,
            several_of,
            0.03,
            13,
            {34, 0.79, 0.14, 0.81, 0.62, 0.71, 0.65, 2.2, 5.1, 0.062, 0.045, 0.18, 0.47}};
        const struct fit above = {"cloud_from_above", above_law, above_of, 0.05, 3, {5, 1, 1}};
        print_fit(several, samples, fitted);
        const struct fit turn = {"cloud_turn", turn_law, turned_of, 1, 4, {2.6, 0.07, 0.15, 0.04}};
        const struct fit horizon = {"cloud_horizon",           horizon_law, horizon_of, 1, 5,
                                    {2.6, 0.6, 1.5, 0.35, 0.3}};
        print_fit(above, samples, fitted);
        print_fit(turn, samples, fitted);
        print_fit(horizon, samples, fitted);
    }
    free(samples);
    return result;
}

int main(int argc, char **argv)
{
    const long places = argc > 1 ? strtol(argv[1], NULL, 10) : 400;
    const long paths = argc > 2 ? strtol(argv[2], NULL, 10) : 64;
    const trl_context_desc desc = trl_context_desc_default();
    static struct cloud_sky sky; // too large for a stack
    trl_context *ctx = NULL;
    trl_result result =
        places > 0 && paths > 1 ? trl_context_create(&desc, &ctx) : TRL_ERROR_INVALID;
    if (result == TRL_OK) {
        result = cloud_sky_make(ctx, &sky);
    }
    if (result == TRL_OK) {
        result = run(ctx, &sky, (size_t)places, (size_t)paths);
    }
    trl_context_destroy(&ctx);
    return result == TRL_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
