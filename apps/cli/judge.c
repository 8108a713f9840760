// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "judge.h"

#include <math.h>

static const double FALSE_ALARMS = 0.01; // of a whole run
static const double FLOOR_SHARE = 0.01;  // of the view's mean
static const double CLAIM_SIGMAS = 2;    // behind "shown to be within", on one side

double judge_granted_sigmas(int trials)
{
    // P(one within) = (1 - FALSE_ALARMS)^(1/trials) = erf(z / sqrt 2), by bisection.
    const double outside = -expm1(log1p(-FALSE_ALARMS) / (trials > 1 ? trials : 1));
    double low = 0;
    double high = 10;
    for (int i = 0; i < 60; i++) {
        const double z = 0.5 * (low + high);
        if (erfc(z / sqrt(2)) > outside) {
            low = z;
        } else {
            high = z;
        }
    }
    return 0.5 * (low + high);
}

double judge_scale(const struct judge_values *values, int index)
{
    double mean = 0;
    for (int i = 0; i < values->count; i++) {
        mean += fabs(values->reference[i]) / values->count;
    }
    return fmax(fabs(values->reference[index]), FLOOR_SHARE * mean);
}

struct relative {
    double error, sigma;
};

static struct relative make_relative(const struct judge_values *values, int index)
{
    const double scale = judge_scale(values, index);
    const double error = values->answer[index] - values->reference[index];
    if (scale > 0) {
        return (struct relative){error / scale, values->standard_error[index] / scale};
    }
    // All paths of the view came back black: right, or all of the light was missed.
    return error == 0 ? (struct relative){0, 0} : (struct relative){1, 1};
}

// Of |x| with x normal about `error`: the folded normal distribution (Leone, Nelson and Nottingham
// 1961, Technometrics 3).
static double folded_mean(double error, double sigma)
{
    if (!(sigma > 0)) {
        return error;
    }
    const double t = error / sigma;
    return sigma * sqrt(2 / M_PI) * exp(-0.5 * t * t) + error * erf(t / sqrt(2));
}

// The mean of all |x| if every error had the same size, and the standard deviation of that mean.
static double mean_size(const struct judge_values *values, double error, double *deviation)
{
    const double n = values->count;
    double mean = 0;
    double variance = 0;
    for (int i = 0; i < values->count; i++) {
        const double sigma = make_relative(values, i).sigma;
        const double folded = folded_mean(error, sigma);
        mean += folded / n;
        variance += fmax(0, error * error + sigma * sigma - folded * folded) / (n * n);
    }
    *deviation = sqrt(variance);
    return mean;
}

// The size of errors of which noise makes `size`, when that is `sigmas` deviations too small; 0
// where noise alone makes more.
static double solve_size(const struct judge_values *values, double size, double sigmas)
{
    double low = 0;
    double high = 2 * size + 10 * sigmas * size + 1e-300;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        double deviation;
        const double mean = mean_size(values, middle, &deviation);
        if (mean - sigmas * deviation < size) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static void judge_values_alone(const struct judge_values *values, struct judgement *out)
{
    const double granted = judge_granted_sigmas(values->trials);
    for (int i = 0; i < values->count; i++) {
        const struct relative r = make_relative(values, i);
        out->largest_noise = fmax(out->largest_noise, granted * r.sigma);
        if (r.sigma <= JUDGE_KNOWN_NOISE) {
            out->known++;
            out->largest = fmax(out->largest, fabs(r.error) - granted * r.sigma);
        }
    }
}

// Sums over values, as parts of a mean over all.
struct sums {
    double size, signed_size, noise, variance;
};

static struct sums add_values(const struct judge_values *values, double most_noise)
{
    const double n = values->count;
    struct sums sums = {0};
    for (int i = 0; i < values->count; i++) {
        const struct relative r = make_relative(values, i);
        if (r.sigma <= most_noise) {
            sums.size += fabs(r.error) / n;
            sums.signed_size += r.error / n;
            sums.noise += r.sigma / n;
            sums.variance += r.sigma * r.sigma / (n * n);
        }
    }
    return sums;
}

// What the mean size surely exceeds: it is no smaller than the part of the values whose noise is
// known, which is no smaller than the size of their signed sum; and noise adds at most its own mean
// size to a size.
static double least_mean(const struct judge_values *values)
{
    const struct sums known = add_values(values, JUDGE_KNOWN_NOISE);
    const int views = values->count > 0 ? values->trials / values->count : 1;
    const double granted = judge_granted_sigmas(views) * sqrt(known.variance);
    const double by_size = known.size - sqrt(2 / M_PI) * known.noise - granted;
    const double by_sign = fabs(known.signed_size) - granted;
    return fmax(0, fmax(by_size, by_sign));
}

static void judge_mean(const struct judge_values *values, struct judgement *out)
{
    const struct sums all = add_values(values, INFINITY);
    out->signed_mean = all.signed_size;
    out->signed_noise = sqrt(all.variance);
    out->noise = all.noise;
    out->mean = solve_size(values, all.size, 0);
    out->mean_high = solve_size(values, all.size, CLAIM_SIGMAS);
    out->mean_low = least_mean(values);
}

struct judgement judge(const struct judge_values *values)
{
    struct judgement out = {.verdict = VERDICT_NOISY};
    judge_values_alone(values, &out);
    judge_mean(values, &out);
    // Where most values are noisy, a quiet one has not yet met the rare paths that carry its light.
    if (out.noise > JUDGE_KNOWN_NOISE) {
        out.known = 0;
        out.largest = out.mean_low = 0;
    }
    const double signed_high = fabs(out.signed_mean) + CLAIM_SIGMAS * out.signed_noise;
    if (out.mean_low > JUDGE_MEAN_BOUND || out.largest > JUDGE_LARGEST_BOUND) {
        out.verdict = VERDICT_BAD;
    } else if (out.mean_high <= JUDGE_MEAN_BOUND && out.largest_noise <= JUDGE_LARGEST_BOUND) {
        out.verdict = VERDICT_GOOD;
    } else if (signed_high <= JUDGE_MEAN_BOUND) {
        out.verdict = VERDICT_MEAN;
    }
    return out;
}
