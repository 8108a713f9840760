// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Waves on the GPU are those that C's formulas give for the same 28 bytes.
#include "fixture.h"

#include "ocean/wave_texture.h"

static const double RADIUS_M = 6371000;

struct scene {
    struct gpu_program program;
    struct waves waves;
    struct wave_texture texture;
};

static void make_scene(struct fixture *f, uint32_t count, struct scene *out)
{
    const struct ocean_desc ocean = {
        .gravity_m_s2 = 9.81,
        .waves = {.wind_m_s = 9, .wind_from_rad = 1, .fetch_m = 2e5, .count = count, .seed = 3}};
    const struct waves_desc desc = {f->ctx, &ocean, RADIUS_M, 0.045};
    const struct gpu_program_desc program = {.vertex = "lib/fullscreen.vert",
                                             .fragment = "waves.frag"};
    assert_int_equal(waves_init(&desc, &out->waves), TRL_OK);
    assert_int_equal(wave_texture_init(f->gpu, &out->waves, &out->texture), TRL_OK);
    assert_int_equal(gpu_program_init(f->gpu, &program, &out->program), TRL_OK);
}

static void finish_scene(struct scene *s)
{
    gpu_program_finish(&s->program);
    wave_texture_finish(&s->texture);
    waves_finish(&s->waves);
}

// All waves at a place of anchor axes, in double.
static GerstnerSum sum_on_cpu(const struct scene *s, struct vec3 place, double side_m,
                              double depth_m)
{
    const GerstnerPlace p = gerstner_place(place.x, place.y, place.z);
    GerstnerSum sum = gerstner_level();
    for (uint32_t i = 0; i < s->texture.view->count; i++) {
        GerstnerWave w = waves_view_get(s->texture.view, i);
        w.amplitude *= gerstner_shoal(w.wavenumber, depth_m);
        const GerstnerTurn turn = gerstner_turn(w, p);
        const GerstnerRipple r = gerstner_ripple(w, p, RADIUS_M, atan2(turn.rise, turn.run));
        const double k = w.wavenumber * side_m;
        const double weight =
            gerstner_weight_of(k * r.dx, k * r.dy, w.wavenumber, 2 * side_m * side_m);
        // Looked at four by four, while the longest is.
        const double first = waves_view_get(s->texture.view, i - i % WAVES_LANES).wavenumber;
        sum = gerstner_add(sum, w, r, gerstner_weight(first * side_m, 0) > 0.02 ? weight : 0);
    }
    sum.lost_square += s->waves.rest_square;
    return sum;
}

static struct texel draw(struct fixture *f, struct scene *s, bool wants_normal)
{
    const struct gpu_pass pass = {.target = &f->target};
    gpu_program_set_float(&s->program, "u_wants_normal", wants_normal ? 1 : 0);
    gpu_pass_begin(f->gpu, &pass);
    assert_int_equal(gpu_draw_fullscreen(&s->program, "waves"), TRL_OK);
    return fixture_read(&f->color, 0, 0);
}

static void assert_near(float got, double wanted, double tolerance)
{
    if (!(fabs((double)got - wanted) <= tolerance)) {
        fail_msg("GPU %.9g, C %.17g", (double)got, wanted);
    }
}

// A float holds a place at 3 km to 0.2 mm, and so the phase of the shortest waves (0.3 m) to 0.005;
// a window as large as theirs at that distance hides them, as it does in pictures.
static void compare(struct fixture *f, struct scene *s, double away_m, double side_m)
{
    const float eye_m = 2;
    wave_texture_bind(&s->texture, &s->program);
    for (int i = 0; i < 8; i++) {
        const float x = (float)(away_m * cos(i * 0.8)), y = (float)(away_m * sin(i * 0.8));
        // The eye is over longitude 0 of the equator: up is x, east y, north z.
        const float drop = (float)(-(double)eye_m - away_m * away_m / 2 / RADIUS_M);
        // Of waves that large pixels do not show, shallow water leaves what it does of one.
        const float depth_m = side_m < 1 && i % 2 == 1 ? 5 : 1e6F;
        const float place[4] = {drop, x, y, depth_m};
        const float footprint[4] = {(float)side_m, 0, 0, (float)side_m};
        gpu_program_set_vec4(&s->program, "u_place", place);
        gpu_program_set_vec4(&s->program, "u_footprint", footprint);
        const struct vec3 at = {(double)x, (double)y, RADIUS_M + (double)eye_m + (double)drop};
        const GerstnerSum wanted = sum_on_cpu(s, at, side_m, (double)depth_m);
        const GerstnerNormal n = gerstner_normal(wanted);
        const struct texel moved = draw(f, s, false), normal = draw(f, s, true);
        assert_near(moved.rgba[0], wanted.x, 2e-4);
        assert_near(moved.rgba[1], wanted.y, 2e-4);
        assert_near(moved.rgba[2], wanted.z, 2e-4);
        assert_near(moved.rgba[3], gerstner_jacobian(wanted, 1), 3e-4);
        assert_near(normal.rgba[0], n.x, 3e-4);
        assert_near(normal.rgba[1], n.y, 3e-4);
        assert_near(normal.rgba[2], n.z, 3e-4);
        assert_near(normal.rgba[3], wanted.lost_square, 1e-6);
    }
}

static void displacement_and_normal_agree_with_c(void **state)
{
    struct fixture *f = *state;
    const uint32_t counts[] = {20, 63};
    for (int i = 0; i < 2; i++) {
        struct scene s;
        make_scene(f, counts[i], &s);
        const struct vec3 eye = {RADIUS_M + 2, 0, 0};
        assert_int_equal(wave_texture_update(&s.texture, eye, 12345.678), TRL_OK);
        compare(f, &s, 3, 0.002);
        compare(f, &s, 100, 0.1);
        compare(f, &s, 3000, 3);
        compare(f, &s, 3000, 300);
        finish_scene(&s);
    }
}

// 28 bytes a wave, as the paper says: 560 for twenty.
static void twenty_waves_are_560_bytes(void **state)
{
    struct fixture *f = *state;
    struct scene s;
    make_scene(f, 20, &s);
    // In the middle of a cell.
    const struct vec3 eye = {RADIUS_M, 0.02 * RADIUS_M, 0.02 * RADIUS_M};
    assert_int_equal(wave_texture_update(&s.texture, eye, 0), TRL_OK);
    assert_int_equal(s.texture.view->count % s.waves.count, 0);
    const size_t cells = s.texture.view->count / s.waves.count;
    const size_t bytes = (size_t)s.texture.texture.width * s.texture.texture.height *
                         gpu_format_texel_bytes(s.texture.texture.format);
    assert_int_equal(s.waves.count, 20);
    assert_int_equal(bytes, 560 * cells);
    finish_scene(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(displacement_and_normal_agree_with_c),
        cmocka_unit_test(twenty_waves_are_560_bytes),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
