// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "judge.h"

#include <math.h>

static const double FALSE_ALARMS = 0.01; // of a whole run
static const double FLOOR_SHARE = 0.01;  // of the view's mean

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

static double subtract_squares(double a, double b)
{
    return a > b ? sqrt(a * a - b * b) : 0;
}

struct judgement judge(const struct judge_values *values)
{
    struct judgement out = {0};
    const double n = values->count;
    const double sigmas = judge_granted_sigmas(values->trials);
    double floor = 0;
    for (int i = 0; i < values->count; i++) {
        floor += FLOOR_SHARE * fabs(values->reference[i]) / n;
    }
    double size = 0;     // mean of |error|
    double variance = 0; // of that mean, by noise
    for (int i = 0; i < values->count; i++) {
        const double scale = fmax(fmax(fabs(values->reference[i]), floor), 1e-300);
        const double error = fabs(values->answer[i] - values->reference[i]) / scale;
        const double sigma = values->standard_error[i] / scale;
        size += error / n;
        out.noise += sigma / n;
        // |normal| has the mean sqrt(2/pi) and the variance 1 - 2/pi.
        out.mean_noise += sqrt(2 / M_PI) * sigma / n;
        variance += (1 - 2 / M_PI) * sigma * sigma / (n * n);
        out.largest = fmax(out.largest, error - sigmas * sigma);
        out.largest_noise = fmax(out.largest_noise, sigmas * sigma);
    }
    out.mean = subtract_squares(size, out.mean_noise);
    const double granted =
        judge_granted_sigmas(values->count > 0 ? values->trials / values->count : 1); // to means
    const double certain = subtract_squares(size - granted * sqrt(variance), out.mean_noise);
    if (certain > JUDGE_MEAN_BOUND || out.largest > JUDGE_LARGEST_BOUND) {
        out.verdict = VERDICT_BAD;
    } else if (out.mean > JUDGE_MEAN_BOUND || out.mean_noise > JUDGE_MEAN_BOUND ||
               out.largest_noise > JUDGE_LARGEST_BOUND) {
        out.verdict = VERDICT_NOISY;
    }
    return out;
}
