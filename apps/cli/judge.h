// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_JUDGE_H
#define CLI_JUDGE_H
// How far answers are from a reference that is itself noisy, and whether that is within bounds.

// What `spectral` has to keep: relative errors beyond the reference's noise.
#define JUDGE_MEAN_BOUND 0.01
#define JUDGE_LARGEST_BOUND 0.02

enum verdict {
    VERDICT_GOOD,  // within the bounds
    VERDICT_NOISY, // not shown to be outside, but the noise is larger than a bound
    VERDICT_BAD    // outside, and noise does not explain it
};

struct judgement {
    double mean;          // mean size of the relative errors, less what noise adds to it
    double mean_noise;    // what noise alone would make of that mean
    double largest;       // largest relative error beyond its noise
    double largest_noise; // the largest error that noise is granted
    double noise;         // mean standard error of the reference, relative
    enum verdict verdict;
};

// Values of one view.
struct judge_values {
    const double *answer, *reference, *standard_error;
    int count;
    int trials; // values of the whole run: noise is granted more where there are more chances
};

// An error counts relative to the value, or to a hundredth of the view's mean where the value is
// smaller than that.
struct judgement judge(const struct judge_values *values);

// How many standard errors one value of `trials` may be off, in either direction, so that all of
// them stay within with a probability of 99 %, if errors are normal.
double judge_granted_sigmas(int trials);

#endif // CLI_JUDGE_H
