// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Waves on the sphere against their definition.
#include "waves.h"

static struct vec3 displaced(const GerstnerWave *waves, int count, struct vec3 v)
{
    const GerstnerPlace p = gerstner_place(v.x, v.y, v.z);
    GerstnerSum sum = gerstner_level();
    for (int i = 0; i < count; i++) {
        const GerstnerTurn t = gerstner_turn(waves[i], p);
        sum = gerstner_add(sum, waves[i],
                           gerstner_ripple(waves[i], p, RADIUS_M, atan2(t.rise, t.run)), 1);
    }
    const GerstnerNormal d = gerstner_to_anchor(p, sum.x, sum.y, RADIUS_M + sum.z);
    return (struct vec3){d.x, d.y, d.z};
}

// Eq. 7 and 8 as they are printed, with Eq. 11 on Q and A.
static struct vec3 displaced_by_paper(const GerstnerWave *w, struct vec3 v)
{
    const struct vec3 o = {w->x, w->y, w->z};
    const struct vec3 d = vec3_normalize(vec3_cross(v, vec3_cross(vec3_sub(v, o), v)));
    const double l = atan2(vec3_length(vec3_cross(v, o)), vec3_dot(v, o)) * RADIUS_M;
    // The phase is that at the anchor, (0, 0, 1).
    const double l0 = atan2(hypot(o.x, o.y), o.z) * RADIUS_M;
    const double phase = w->wavenumber * (l - l0) + w->phase;
    const double reach = GERSTNER_FADE_WAVES * 2 * M_PI / (w->wavenumber * RADIUS_M);
    const double u = fmin((1 - fabs(vec3_dot(v, o))) / (reach * reach / 2), 1);
    const double fade = u * u * (3 - 2 * u), a = fade * w->amplitude;
    return vec3_add(vec3_scale(v, RADIUS_M + a * sin(phase)),
                    vec3_scale(d, fade * w->steepness * a * cos(phase)));
}

static struct vec3 place_near(struct vec3 from, double x_m, double y_m)
{
    const struct vec3 side = vec3_normalize(
        vec3_cross(from, fabs(from.z) < 0.9 ? (struct vec3){0, 0, 1} : (struct vec3){1, 0, 0}));
    const struct vec3 other = vec3_cross(from, side);
    return vec3_normalize(vec3_add(vec3_scale(from, RADIUS_M),
                                   vec3_add(vec3_scale(side, x_m), vec3_scale(other, y_m))));
}

static const GerstnerWave TWO[2] = {{0.6, 0, 0.8, 1.5, 0.05, 0.3, 0.9},
                                    {-0.48, 0.64, 0.6, 0.8, 0.11, 2, 0.8}};

// Everywhere but opposite the anchor, and near both poles of a wave.
static void displacement_is_the_papers(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        const GerstnerWave *w = &TWO[i];
        const struct vec3 o = {w->x, w->y, w->z};
        for (int j = 0; j < 200; j++) {
            const double z = 0.99 - j * 0.0095;
            const struct vec3 far = {sqrt(1 - z * z) * cos(j), sqrt(1 - z * z) * sin(j), z};
            const struct vec3 pole = vec3_scale(o, j % 2 ? 1 : -1);
            const struct vec3 v = j < 150 ? far : place_near(pole, 7.0 * (j - 149), 30);
            const struct vec3 off = vec3_sub(displaced(w, 1, v), displaced_by_paper(w, v));
            // 1 - |v o| near the poles has lost half of a double's digits.
            assert_true(vec3_length(off) < (j < 150 ? 1e-6 : 1e-3));
        }
    }
}

// The displaced surface by differences over a centimetre; what is flat for the waves is curved by
// amplitude over radius.
static void normal_is_that_of_the_displaced_surface(void **state)
{
    (void)state;
    for (int j = 0; j < 400; j++) {
        const double z = 0.99 - (j % 200) * 0.0095;
        const struct vec3 far = {sqrt(1 - z * z) * cos(j), sqrt(1 - z * z) * sin(j), z};
        const struct vec3 o = {TWO[0].x, TWO[0].y, TWO[0].z};
        const struct vec3 v = j < 200 ? far : place_near(o, 3.1 * (j - 200), 2.3 * (j - 300));
        const double h = 0.01;
        const struct vec3 a = displaced(TWO, 2, place_near(v, h, 0));
        const struct vec3 b = displaced(TWO, 2, place_near(v, -h, 0));
        const struct vec3 c = displaced(TWO, 2, place_near(v, 0, h));
        const struct vec3 d = displaced(TWO, 2, place_near(v, 0, -h));
        const struct vec3 wanted = vec3_normalize(vec3_cross(vec3_sub(a, b), vec3_sub(c, d)));
        const GerstnerPlace p = gerstner_place(v.x, v.y, v.z);
        GerstnerSum sum = gerstner_level();
        for (int i = 0; i < 2; i++) {
            const GerstnerTurn t = gerstner_turn(TWO[i], p);
            sum = gerstner_add(sum, TWO[i],
                               gerstner_ripple(TWO[i], p, RADIUS_M, atan2(t.rise, t.run)), 1);
        }
        const GerstnerNormal n = gerstner_normal(sum);
        const GerstnerNormal m = gerstner_to_anchor(p, n.x, n.y, n.z);
        const struct vec3 got = vec3_normalize((struct vec3){m.x, m.y, m.z});
        assert_true(vec3_length(vec3_sub(got, wanted)) < 1e-5);
        assert_true(gerstner_jacobian(sum, 1) > 0);
    }
}

// The travel and its normal have no step anywhere on a way over the pole of a wave.
static void nothing_jumps_at_a_pole(void **state)
{
    (void)state;
    const struct vec3 o = {TWO[0].x, TWO[0].y, TWO[0].z};
    for (int side = -1; side <= 1; side += 2) {
        struct vec3 before = {0, 0, 0};
        for (int i = -2000; i <= 2000; i++) {
            const struct vec3 v = place_near(vec3_scale(o, side), 0.05 * i, 1e-4);
            const struct vec3 now = vec3_sub(displaced(TWO, 1, v), vec3_scale(v, RADIUS_M));
            assert_true(isfinite(now.x) && isfinite(now.y) && isfinite(now.z));
            // Amplitude 1.5 m at 0.05 per m: no steeper than 0.075, twice that with Q.
            assert_true(i == -2000 || vec3_length(vec3_sub(now, before)) < 0.05 * 0.16);
            before = now;
        }
    }
}

// Also with the anchor at a pole of the wave itself.
static void anchor_may_be_a_pole(void **state)
{
    (void)state;
    const GerstnerWave w = {0, 0, 1, 1, 0.02, 0, 0.5};
    for (int i = 1; i < 100; i++) {
        const double l = 40.0 * i;
        const GerstnerPlace p =
            gerstner_place(RADIUS_M * sin(l / RADIUS_M), 0, RADIUS_M * cos(l / RADIUS_M));
        const GerstnerTurn t = gerstner_turn(w, p);
        assert_true(fabs(RADIUS_M * atan2(t.rise, t.run) - l) < 1e-6);
    }
}

// Ten days of seconds, against phases in long double.
static void phases_are_exact_after_ten_days(void **state)
{
    const struct ocean_desc ocean = waves_describe(8, OCEAN_JONSWAP, 40);
    struct waves waves;
    struct waves_view *now = test_malloc(sizeof *now), *then = test_malloc(sizeof *then);
    waves_make(*state, &ocean, &waves);
    const struct vec3 eye = {RADIUS_M, 1e5, 2e5};
    const double time_s = 864000.37;
    waves_view_make(&waves, eye, 0, now);
    waves_view_make(&waves, eye, time_s, then);
    const uint32_t cells = now->count / waves.count;
    for (uint32_t i = 0; i < now->count; i++) {
        const struct wave_component *c = &waves.components[i / cells];
        const long double turned = fmodl((long double)c->omega_per_s * (long double)time_s,
                                         2 * 3.14159265358979323846264338L);
        const double moved = waves_view_get(now, i).phase - waves_view_get(then, i).phase;
        // Both phases are floats of up to pi.
        assert_true(fabs(remainder(moved - (double)turned, 2 * M_PI)) < 5e-7);
    }
    test_free(now);
    test_free(then);
    waves_finish(&waves);
}

// Half a metre further, the eye sees the same sea: also where cells border.
static void an_eye_that_moves_sees_the_same_waves(void **state)
{
    const struct ocean_desc ocean = waves_describe(8, OCEAN_JONSWAP, 24);
    struct waves waves;
    struct waves_view *view = test_malloc(sizeof *view);
    waves_make(*state, &ocean, &waves);
    double most = 0, least_share = 1e9;
    for (int i = 0; i < 600; i++) {
        double heights[2];
        for (int side = 0; side < 2; side++) {
            // Over 2000 km in steps, each with the eye at its place and 0.5 m further.
            const double turn = 0.0005 * i, more = side * 0.5 / RADIUS_M;
            const struct vec3 eye = {cos(turn + more), 0.6 * sin(turn + more),
                                     0.8 * sin(turn + more)};
            waves_view_make(&waves, eye, 77, view);
            // The same place of the sea: 0.5 m behind the second eye, along 0.6 east, 0.8 north.
            const struct vec3 place = {cos(turn), 0.6 * sin(turn), 0.8 * sin(turn)};
            float m[9];
            waves_local_from_planet(eye, m);
            const struct vec3 up = vec3_normalize(eye);
            const struct vec3 off = vec3_scale(vec3_sub(place, up), RADIUS_M);
            const GerstnerPlace p = gerstner_place(
                (double)m[0] * off.x + (double)m[3] * off.y + (double)m[6] * off.z,
                (double)m[1] * off.x + (double)m[4] * off.y + (double)m[7] * off.z, RADIUS_M);
            GerstnerSum sum = gerstner_level();
            double variance = 0;
            for (uint32_t w = 0; w < view->count; w++) {
                const GerstnerWave wave = waves_view_get(view, w);
                const GerstnerTurn t = gerstner_turn(wave, p);
                sum = gerstner_add(sum, wave,
                                   gerstner_ripple(wave, p, RADIUS_M, atan2(t.rise, t.run)), 1);
                variance += wave.amplitude * wave.amplitude / 2;
            }
            heights[side] = sum.z;
            least_share =
                fmin(least_share, 4 * sqrt(variance) / waves_significant_height_m(&waves));
        }
        most = fmax(most, fabs(heights[0] - heights[1]));
    }
    assert_true(most < 2e-3);
    assert_true(fabs(least_share - 1) < 1e-5); // energy is shared, not lost
    test_free(view);
    waves_finish(&waves);
}

static void shallow_water_leaves_what_does_not_break(void **state)
{
    (void)state;
    const double k = 0.1;
    // Long waves keep the variance k d / 2, short ones all; both parts meet in value and slope.
    assert_true(gerstner_shoal(k, 0) == 0);
    assert_true(fabs(pow(gerstner_shoal(k, 2), 2) - 0.5 * k * 2) < 1e-12);
    assert_true(gerstner_shoal(k, 40) == 1 && gerstner_shoal(k, 1e6) == 1);
    const double below = gerstner_shoal(k, 10 - 1e-4), at = gerstner_shoal(k, 10 + 1e-12);
    const double above = gerstner_shoal(k, 10 + 1e-4);
    assert_true(fabs(at * at - 0.5) < 1e-9);
    assert_true(fabs((above - at) / (at - below) - 1) < 1e-4);
    // With q the wavenumber in this depth, times it, k d = q tanh q, and the factor that the
    // parabolas stand for is tanh^2 q / (1 + 2 q / sinh 2 q): they are off by 0.023 at most.
    for (double q = 0.05; q < 5; q += 0.05) {
        const double t = tanh(q), part = gerstner_shoal(1, q * t);
        const double exact = t * t / (1 + 2 * q / sinh(2 * q));
        assert_true(fabs(part * part - exact) < 0.025);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(displacement_is_the_papers),
        cmocka_unit_test(normal_is_that_of_the_displaced_surface),
        cmocka_unit_test(nothing_jumps_at_a_pole),
        cmocka_unit_test(anchor_may_be_a_pole),
        cmocka_unit_test(phases_are_exact_after_ten_days),
        cmocka_unit_test(an_eye_that_moves_sees_the_same_waves),
        cmocka_unit_test(shallow_water_leaves_what_does_not_break),
    };
    return cmocka_run_group_tests(tests, waves_set_up, waves_tear_down);
}
