// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_JUDGE_H
#define CLI_JUDGE_H
// How far answers are from a reference that is itself noisy, and what that says about bounds.
// docs/testing.md derives the numbers.

#include <stdbool.h>

// What `spectral` has to keep: relative errors beyond the reference's noise.
#define JUDGE_MEAN_BOUND 0.01
#define JUDGE_LARGEST_BOUND 0.02

// A relative standard error above this one is that of fewer than 2500 paths that matter: too few to
// know their spread by, and nobody is convicted by it.
#define JUDGE_KNOWN_NOISE 0.02

enum verdict {
    VERDICT_GOOD,  // shown to be within: mean size and every value
    VERDICT_MEAN,  // the signed mean is shown to be within, noise hides sizes
    VERDICT_NOISY, // neither shown to be within nor to be outside
    VERDICT_BAD    // outside, and noise does not explain it
};

struct judgement {
    double signed_mean;         // of the relative errors: noise averages out
    double signed_noise;        // its standard error
    double mean;                // size of the relative errors, less what noise adds to it
    double mean_low, mean_high; // what it surely exceeds, and what 97.7 % of such stay below
    double largest;             // relative error beyond its noise, of the values below
    int known;                  // values whose noise is known, see JUDGE_KNOWN_NOISE
    double largest_noise;       // the largest error that noise is granted
    double noise;               // mean standard error of the reference, relative
    enum verdict verdict;
};

// Values of one view.
struct judge_values {
    const double *answer, *reference, *standard_error;
    int count;
    int trials; // values of the whole run: noise is granted more where there are more chances
};

struct judgement judge(const struct judge_values *values);

// What an error of value `index` is relative to: the reference, or a hundredth of the view's mean
// where that is more. 0 when all are black.
double judge_scale(const struct judge_values *values, int index);

// How many standard errors one value of `trials` may be off, in either direction, so that all of
// them stay within with a probability of 99 %, if errors are normal.
double judge_granted_sigmas(int trials);

#endif // CLI_JUDGE_H
