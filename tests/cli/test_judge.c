// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Errors against a noisy reference: what is noise is not counted, what is not is.
#include "cli/cloud_judge.h"
#include "cli/judge.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

enum { COUNT = 18, VIEWS = 3000, TRIALS = COUNT * VIEWS };

struct sample {
    double answer[COUNT], reference[COUNT], error[COUNT];
};

// Box and Muller, from a generator of Knuth's.
static double draw_normal(uint64_t *state)
{
    double uniform[2];
    for (int i = 0; i < 2; i++) {
        *state = *state * 6364136223846793005u + 1442695040888963407u;
        uniform[i] = ((double)(*state >> 11) + 0.5) / 9007199254740992.0;
    }
    return sqrt(-2 * log(uniform[0])) * cos(6.283185307179586 * uniform[1]);
}

// A reference with noise of `sigma`, and answers that are off by `error`.
static struct sample draw_sample(double sigma, double error, uint64_t *state)
{
    struct sample s;
    for (int i = 0; i < COUNT; i++) {
        const double truth = 0.01 * (1 + i % 5);
        s.answer[i] = truth * (1 + error);
        s.reference[i] = truth * (1 + sigma * draw_normal(state));
        s.error[i] = truth * sigma;
    }
    return s;
}

static struct judgement judge_sample(const struct sample *s)
{
    const struct judge_values values = {s->answer, s->reference, s->error, COUNT, TRIALS};
    return judge(&values);
}

static void exact_answers_are_good(void **state)
{
    (void)state;
    uint64_t seed = 1;
    const struct sample s = draw_sample(0, 0, &seed);
    const struct judgement j = judge_sample(&s);
    assert_true(j.mean == 0 && j.largest == 0 && j.noise == 0);
    assert_int_equal(j.verdict, VERDICT_GOOD);
}

static void errors_without_noise_are_what_they_are(void **state)
{
    (void)state;
    uint64_t seed = 1;
    const struct sample small = draw_sample(0, 0.009, &seed);
    assert_true(fabs(judge_sample(&small).mean - 0.009) < 1e-12);
    assert_int_equal(judge_sample(&small).verdict, VERDICT_GOOD);
    const struct sample large = draw_sample(0, -0.011, &seed);
    assert_true(fabs(judge_sample(&large).largest - 0.011) < 1e-12);
    assert_int_equal(judge_sample(&large).verdict, VERDICT_BAD);
    struct sample one = draw_sample(0, 0, &seed);
    one.answer[7] *= 1.021;
    assert_true(judge_sample(&one).mean < 0.01);
    assert_int_equal(judge_sample(&one).verdict, VERDICT_BAD);
}

static void noise_alone_is_not_an_error(void **state)
{
    (void)state;
    static const double sigmas[] = {0.002, 0.003, 0.03};
    uint64_t seed = 5;
    for (int k = 0; k < 3; k++) {
        double mean = 0;
        double signed_mean = 0;
        double signed_square = 0;
        int exceeded = 0;
        for (int i = 0; i < VIEWS; i++) {
            const struct sample s = draw_sample(sigmas[k], 0, &seed);
            const struct judgement j = judge_sample(&s);
            mean += j.mean / VIEWS;
            assert_int_equal(j.verdict, k == 2 ? VERDICT_NOISY : VERDICT_GOOD);
            signed_mean += j.signed_mean / VIEWS;
            signed_square += j.signed_mean * j.signed_mean / VIEWS;
            exceeded += j.mean_high <= 0;
            assert_true(fabs(j.noise / sigmas[k] - 1) < 0.1); // relative to noisy values
        }
        // Without the correction it would be 0.8 sigma. Half of the views are left with something:
        // a mean of 18 sizes has a standard deviation of 0.14 sigma, and where errors are small
        // against the noise, the mean size grows with their square.
        assert_true(mean < 0.35 * sigmas[k]);
        // What the signed mean is said to vary by, sigma / sqrt(18), is what it varies by: to 5 %,
        // which is four deviations for 3000 views. Dividing by noisy values adds sigma^2 to it.
        const double bias = sigmas[k] * sigmas[k];
        const double deviation = sigmas[k] / sqrt(COUNT);
        assert_true(fabs(signed_mean - bias) < 4 * deviation / sqrt(VIEWS) + 0.1 * bias);
        assert_true(fabs(sqrt(signed_square) / deviation - 1) < 0.05);
        // Views so quiet that even the upper limit of the mean size is nothing: 2.3 %.
        assert_true(exceeded < 0.04 * VIEWS);
    }
}

static void an_error_is_seen_through_noise(void **state)
{
    (void)state;
    uint64_t seed = 9;
    double mean = 0;
    for (int i = 0; i < 500; i++) {
        const struct sample s = draw_sample(0.004, 0.03, &seed);
        const struct judgement j = judge_sample(&s);
        assert_int_equal(j.verdict, VERDICT_BAD);
        mean += j.mean / 500;
    }
    assert_true(fabs(mean - 0.03) < 0.001);
}

// The mean size of equal errors is found, and its upper limit holds in 97.7 % of views.
static void sizes_are_found_under_noise(void **state)
{
    (void)state;
    static const double sizes[] = {0.002, 0.005, 0.02};
    uint64_t seed = 11;
    for (int k = 0; k < 3; k++) {
        double mean = 0;
        int above = 0;
        int below = 0;
        for (int i = 0; i < VIEWS; i++) {
            const struct sample s = draw_sample(0.005, i % 2 ? sizes[k] : -sizes[k], &seed);
            const struct judgement j = judge_sample(&s);
            mean += j.mean / VIEWS;
            above += j.mean_high < sizes[k];
            below += j.mean_low > sizes[k];
        }
        // Of single views the smallest is known to half its size; the estimator's own bias where
        // the noise is larger than the error is a quarter.
        assert_true(fabs(mean / sizes[k] - 1) < (k == 0 ? 0.3 : 0.05));
        // A normal law would give 2.3 %; means of 18 sizes are a little skew.
        assert_true(above < 0.035 * VIEWS);
        assert_int_equal(below, 0);
    }
}

// One value with twelve per cent of noise is far off, the others are exact: nobody is convicted by
// a spread that too few paths tell of.
static void noise_that_is_not_known_convicts_nobody(void **state)
{
    (void)state;
    uint64_t seed = 3;
    struct sample s = draw_sample(0.001, 0, &seed);
    s.error[5] = 0.12 * s.reference[5];
    s.answer[5] = 2 * s.reference[5];
    const struct judgement j = judge_sample(&s);
    assert_int_equal(j.known, COUNT - 1);
    assert_int_equal(j.verdict, VERDICT_NOISY);
    s.error[5] = 0.019 * s.reference[5];
    assert_int_equal(judge_sample(&s).verdict, VERDICT_BAD);
    // Nor by a quiet value among noisy ones.
    for (int i = 0; i < COUNT; i++) {
        s.error[i] = (i == 5 ? 0.019 : 0.2) * s.reference[i];
    }
    assert_int_equal(judge_sample(&s).verdict, VERDICT_NOISY);
}

// Noise of 1 % a value hides single errors of 2 %; that of their mean is a quarter.
static void a_mean_is_known_better_than_its_values(void **state)
{
    (void)state;
    uint64_t seed = 13;
    int shown = 0;
    for (int i = 0; i < 500; i++) {
        const struct sample s = draw_sample(0.01, 0.002, &seed);
        const struct judgement j = judge_sample(&s);
        assert_true(j.verdict == VERDICT_MEAN || j.verdict == VERDICT_NOISY);
        shown += j.verdict == VERDICT_MEAN;
    }
    // |mean| + 2 x 0.24 % < 1 % where the mean, 0.2 +- 0.24 %, is below 0.53 %: 91 %.
    assert_true(shown > 430);
}

// All paths of a view missed the light that a model sees.
static void black_references_are_finite(void **state)
{
    (void)state;
    uint64_t seed = 1;
    struct sample s = draw_sample(0, 0, &seed);
    for (int i = 0; i < COUNT; i++) {
        s.reference[i] = s.error[i] = 0;
    }
    const struct judgement j = judge_sample(&s);
    assert_true(isfinite(j.mean) && isfinite(j.largest) && isfinite(j.mean_high));
    assert_int_equal(j.verdict, VERDICT_NOISY);
}

static void nearly_black_values_count_against_the_mean(void **state)
{
    (void)state;
    uint64_t seed = 1;
    struct sample s = draw_sample(0, 0, &seed);
    s.reference[3] = 1e-12;
    s.answer[3] = 2e-12;
    assert_int_equal(judge_sample(&s).verdict, VERDICT_GOOD);
    for (int i = 0; i < COUNT; i++) {
        s.answer[i] = s.reference[i] = s.error[i] = 0;
    }
    assert_int_equal(judge_sample(&s).verdict, VERDICT_GOOD);
}

// Quantiles of the normal distribution: 99 % of one value, and of 100 with each 99.98995 %.
static void more_values_are_granted_more(void **state)
{
    (void)state;
    assert_true(fabs(judge_granted_sigmas(1) - 2.5758) < 1e-4);
    assert_true(fabs(judge_granted_sigmas(100) - 3.8896) < 1e-3);
    assert_true(judge_granted_sigmas(1350) > judge_granted_sigmas(270));
}

// Light of few strong paths: most of them see a little, one in forty a lot. Mean 1.
static double draw_paths(uint64_t *state, int paths)
{
    double sum = 0;
    for (int i = 0; i < paths; i++) {
        *state = *state * 6364136223846793005u + 1442695040888963407u;
        sum += *state >> 59 == 0 ? 24 : 8.0 / 31; // one in 32
    }
    return sum / paths;
}

// Errors of 12 % below and 4 % above truth, in equal parts: 8 % in the mean, 9 % in the square.
static void noise_of_few_strong_paths_is_no_error(void **state)
{
    (void)state;
    enum { PIXELS = 3000 };
    static struct cloud_pixel pixels[PIXELS];
    uint64_t seed = 5;
    double ratio = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double truth = 100 + i % 7, drawn = i % 2 ? 1 / 1.12 : 1 / 0.96;
        pixels[i] = (struct cloud_pixel){.drawn = truth * drawn};
        for (int half = 0; half < 2; half++) {
            pixels[i].halves[half] = truth * draw_paths(&seed, 2000);
        }
        ratio += drawn / PIXELS;
    }
    const struct cloud_figures f = cloud_judge(pixels, PIXELS);
    const double rms = sqrt(0.5 * (0.12 * 0.12 + 0.04 * 0.04));
    // With errors of e and a half's noise s = 0.092 a product is off by sqrt((e^2 + s^2)^2 - e^4).
    assert_true(fabs(f.rms * f.rms - rms * rms) < 3 * 0.015 / sqrt(PIXELS));
    assert_true(f.least_size < 0.08 && f.rms > 0.08);
    assert_true(f.size > 0.085); // noise and all
    assert_true(fabs(f.ratio - ratio) < 0.005);
    // The field itself has none but what the seven steps and the errors make of it.
    assert_true(f.contrast[1] < 0.05 && f.contrast[0] > f.contrast[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_answers_are_good),
        cmocka_unit_test(errors_without_noise_are_what_they_are),
        cmocka_unit_test(noise_alone_is_not_an_error),
        cmocka_unit_test(an_error_is_seen_through_noise),
        cmocka_unit_test(sizes_are_found_under_noise),
        cmocka_unit_test(noise_that_is_not_known_convicts_nobody),
        cmocka_unit_test(a_mean_is_known_better_than_its_values),
        cmocka_unit_test(black_references_are_finite),
        cmocka_unit_test(nearly_black_values_count_against_the_mean),
        cmocka_unit_test(more_values_are_granted_more),
        cmocka_unit_test(noise_of_few_strong_paths_is_no_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
