// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Errors against a noisy reference: what is noise is not counted, what is not is.
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
        for (int i = 0; i < VIEWS; i++) {
            const struct sample s = draw_sample(sigmas[k], 0, &seed);
            const struct judgement j = judge_sample(&s);
            mean += j.mean / VIEWS;
            // Beyond what is granted is not yet beyond the bound.
            assert_true(j.verdict != VERDICT_BAD);
            assert_int_equal(j.verdict, k == 2 ? VERDICT_NOISY : VERDICT_GOOD);
            assert_true(fabs(j.noise / sigmas[k] - 1) < 0.1); // relative to noisy values
        }
        // Without the correction it would be 0.8 sigma. Half of the views are left with something,
        // since a mean of 18 sizes has a standard deviation of 0.14 sigma.
        assert_true(mean < 0.3 * sigmas[k]);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_answers_are_good),
        cmocka_unit_test(errors_without_noise_are_what_they_are),
        cmocka_unit_test(noise_alone_is_not_an_error),
        cmocka_unit_test(an_error_is_seen_through_noise),
        cmocka_unit_test(nearly_black_values_count_against_the_mean),
        cmocka_unit_test(more_values_are_granted_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
