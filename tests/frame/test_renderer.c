// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The public renderer, without a window: what it refuses, what it draws and reads back.
#include "sphere.h"
#include <terrella/renderer.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 48, HEIGHT = 32 };

static const double PI = 3.14159265358979323846;

struct setup {
    struct fixture *f;
    trl_scene *scene;
    trl_renderer *renderer;
};

static trl_result make_renderer(const struct setup *s, bool measures_time, trl_renderer **out)
{
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    desc.measures_time = measures_time;
    return trl_renderer_create(s->f->ctx, &desc, out);
}

static int set_up(void **state)
{
    void *f = NULL;
    struct setup *s = calloc(1, sizeof *s);
    *state = s;
    if (!s || fixture_set_up(&f)) {
        return 1;
    }
    s->f = f;
    s->scene = sphere_scene(s->f);
    const trl_result result = make_renderer(s, true, &s->renderer);
    fixture_skip_without_gl(s->f, result);
    return result == TRL_OK ? 0 : 1;
}

static int tear_down(void **state)
{
    struct setup *s = *state;
    trl_renderer_destroy(&s->renderer);
    trl_scene_destroy(&s->scene);
    void *f = s->f;
    free(s);
    return fixture_tear_down(&f);
}

// Half lit, from two radii above the ground; the planet's middle is at the lower edge.
static trl_view view_of_the_lower_half(void)
{
    trl_view view = trl_view_default();
    view.latitude_rad = 0;
    view.longitude_rad = 0;
    view.altitude_m = 2 * 6371000.0;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.heading_rad = 0;
    view.pitch_rad = -PI / 3;
    view.roll_rad = 0;
    view.vertical_fov_rad = PI / 3;
    view.sun_mode = TRL_SUN_SUBSOLAR;
    view.sun_latitude_or_elevation_rad = 0;
    view.sun_longitude_or_azimuth_rad = 0.5;
    return view;
}

static void expect_invalid(const struct setup *s, trl_result got)
{
    fixture_expect_error(s->f, got, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT);
}

static void wrong_descriptions_are_refused(void **state)
{
    struct setup *s = *state;
    trl_renderer *out = s->renderer;
    trl_renderer_desc desc = trl_renderer_desc_default();
    expect_invalid(s, trl_renderer_create(s->f->ctx, &desc, &out)); // no scene
    assert_null(out);
    desc.scene = s->scene;
    expect_invalid(s, trl_renderer_create(s->f->ctx, NULL, &out));
    expect_invalid(s, trl_renderer_create(s->f->ctx, &desc, NULL));
    desc.wavelengths = 0;
    expect_invalid(s, trl_renderer_create(s->f->ctx, &desc, &out));
    desc.wavelengths = TRL_RENDERER_MAX_WAVELENGTHS + 1;
    expect_invalid(s, trl_renderer_create(s->f->ctx, &desc, &out));
    desc.wavelengths = 1;
    desc.mesher = (trl_mesher)99;
    expect_invalid(s, trl_renderer_create(s->f->ctx, &desc, &out));
    const trl_renderer_desc zeroed = {.scene = s->scene};
    expect_invalid(s, trl_renderer_create(s->f->ctx, &zeroed, &out));
    assert_int_equal(trl_renderer_create(NULL, &desc, &out), TRL_ERROR_INVALID);
}

static void meshers_have_names_and_others_are_refused(void **state)
{
    struct setup *s = *state;
    int count = 0;
    for (; trl_mesher_name((trl_mesher)count); count++) {
        assert_int_equal(trl_renderer_set_mesher(s->renderer, (trl_mesher)count), TRL_OK);
        assert_int_equal(trl_renderer_mesher(s->renderer), count);
    }
    assert_true(count >= 1);
    expect_invalid(s, trl_renderer_set_mesher(s->renderer, (trl_mesher)count));
    expect_invalid(s, trl_renderer_set_mesher(s->renderer, (trl_mesher)-1));
    assert_int_equal(trl_renderer_mesher(s->renderer), count - 1);
    trl_mesh_stats stats = {1, 1, 1};
    assert_int_equal(trl_renderer_mesh_stats(s->renderer, &stats), TRL_OK);
    assert_int_equal(stats.triangles, 0); // a bare sphere
    expect_invalid(s, trl_renderer_mesh_stats(s->renderer, NULL));
    assert_int_equal(trl_renderer_set_mesher(s->renderer, trl_renderer_desc_default().mesher),
                     TRL_OK);
}

static void projective_grids_that_cannot_be_are_refused(void **state)
{
    struct setup *s = *state;
    const trl_projective_desc good = trl_renderer_desc_default().projective;
    trl_projective_desc bad = good;
    bad.columns = TRL_PROJECTIVE_MAX_SIDE + 2;
    expect_invalid(s, trl_renderer_set_projective(s->renderer, &bad));
    bad.columns = 101; // odd
    expect_invalid(s, trl_renderer_set_projective(s->renderer, &bad));
    bad = good;
    bad.rows = 2;
    expect_invalid(s, trl_renderer_set_projective(s->renderer, &bad));
    bad = good;
    bad.placing = (trl_projective_rows)7;
    expect_invalid(s, trl_renderer_set_projective(s->renderer, &bad));
    expect_invalid(s, trl_renderer_set_projective(s->renderer, NULL));
    trl_renderer *out = s->renderer;
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    desc.projective = bad;
    expect_invalid(s, trl_renderer_create(s->f->ctx, &desc, &out));
    assert_int_equal(trl_renderer_set_projective(s->renderer, &good), TRL_OK);
}

static void hemispheres_that_cannot_be_are_refused(void **state)
{
    struct setup *s = *state;
    const uint32_t bad[] = {0, 16, 40, 808, TRL_HEMISPHERE_MAX_CELLS + TRL_HEMISPHERE_STEP};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        expect_invalid(s, trl_renderer_set_hemisphere(s->renderer, bad[i]));
    }
    assert_int_equal(trl_renderer_set_hemisphere(s->renderer, TRL_HEMISPHERE_MAX_CELLS), TRL_OK);
    assert_int_equal(trl_renderer_set_hemisphere(s->renderer, 800), TRL_OK);
}

static void mesh_errors_that_cannot_be_are_refused(void **state)
{
    struct setup *s = *state;
    const double bad[] = {0, -1, 0.01, 1000, NAN, INFINITY};
    trl_renderer *out = s->renderer;
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        expect_invalid(s, trl_renderer_set_mesh_error(s->renderer, bad[i]));
        desc.mesh_error_px = bad[i];
        expect_invalid(s, trl_renderer_create(s->f->ctx, &desc, &out));
    }
    assert_int_equal(trl_renderer_set_mesh_error(s->renderer, 3), TRL_OK);
    assert_int_equal(trl_renderer_set_mesh_error(NULL, 3), TRL_ERROR_INVALID);
}

static void wrong_sizes_are_refused(void **state)
{
    struct setup *s = *state;
    const trl_view view = view_of_the_lower_half();
    const uint32_t sizes[][2] = {{0, 10},      {10, 0},        {100000, 10},
                                 {10, 100000}, {16384, 16384}, {UINT32_MAX, UINT32_MAX}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        expect_invalid(s, trl_renderer_draw(s->renderer, &view, sizes[i][0], sizes[i][1], 0));
    }
}

static void views_with_wrong_numbers_are_refused(void **state)
{
    struct setup *s = *state;
    const size_t fields[] = {
        offsetof(trl_view, latitude_rad),     offsetof(trl_view, longitude_rad),
        offsetof(trl_view, altitude_m),       offsetof(trl_view, heading_rad),
        offsetof(trl_view, pitch_rad),        offsetof(trl_view, roll_rad),
        offsetof(trl_view, vertical_fov_rad), offsetof(trl_view, sun_latitude_or_elevation_rad),
        offsetof(trl_view, exposure_bias_ev), offsetof(trl_view, sun_longitude_or_azimuth_rad),
        offsetof(trl_view, exposure_ev100)};
    const double wrong[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        for (size_t k = 0; k < 3; k++) {
            trl_view view = view_of_the_lower_half();
            view.has_fixed_exposure = true;
            memcpy((char *)&view + fields[i], &wrong[k], sizeof wrong[k]);
            expect_invalid(s, trl_renderer_draw(s->renderer, &view, WIDTH, HEIGHT, 0));
            expect_invalid(s, trl_renderer_resolve(s->renderer, &view, &view));
        }
    }
    trl_view view = view_of_the_lower_half();
    view.latitude_rad = 1.6;
    expect_invalid(s, trl_renderer_draw(s->renderer, &view, WIDTH, HEIGHT, 0));
    view = view_of_the_lower_half();
    view.vertical_fov_rad = PI;
    expect_invalid(s, trl_renderer_draw(s->renderer, &view, WIDTH, HEIGHT, 0));
    view = view_of_the_lower_half();
    view.sun_mode = (trl_sun_mode)7;
    expect_invalid(s, trl_renderer_draw(s->renderer, &view, WIDTH, HEIGHT, 0));
    expect_invalid(s, trl_renderer_draw(s->renderer, NULL, WIDTH, HEIGHT, 0));
    view = view_of_the_lower_half();
    expect_invalid(s, trl_renderer_draw(s->renderer, &view, WIDTH, HEIGHT, (double)NAN));
    expect_invalid(s, trl_renderer_draw(s->renderer, &view, WIDTH, HEIGHT, -1));
}

static void nothing_is_read_before_something_is_drawn(void **state)
{
    struct setup *s = *state;
    trl_renderer *fresh = NULL;
    assert_int_equal(make_renderer(s, false, &fresh), TRL_OK);
    uint8_t rgba[4];
    float radiance[4];
    double ev100 = 0;
    expect_invalid(s, trl_renderer_read_rgba8(fresh, rgba));
    expect_invalid(s, trl_renderer_read_radiance(fresh, radiance));
    expect_invalid(s, trl_renderer_exposure(fresh, &ev100));
    expect_invalid(s, trl_renderer_present(fresh, 0, 0, 1, 1));
    expect_invalid(s, trl_renderer_read_rgba8(fresh, NULL));
    trl_renderer_destroy(&fresh);
    assert_null(fresh);
    trl_renderer_destroy(&fresh);
    trl_renderer_destroy(NULL);
    assert_int_equal(trl_renderer_draw(NULL, NULL, 1, 1, 0), TRL_ERROR_INVALID);
}

static void draw(const struct setup *s, const trl_view *view)
{
    assert_int_equal(trl_renderer_draw(s->renderer, view, WIDTH, HEIGHT, 0), TRL_OK);
}

static void pictures_come_top_row_first(void **state)
{
    struct setup *s = *state;
    const trl_view view = view_of_the_lower_half();
    uint8_t rgba[4 * WIDTH * HEIGHT];
    static float radiance[4 * WIDTH * HEIGHT];
    draw(s, &view);
    assert_int_equal(trl_renderer_read_rgba8(s->renderer, rgba), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(s->renderer, radiance), TRL_OK);
    const size_t top = WIDTH / 2, bottom = (size_t)(HEIGHT - 1) * WIDTH + WIDTH / 2;
    assert_int_equal(rgba[4 * top + 1], 0); // black space
    assert_true(rgba[4 * bottom + 1] > 60); // lit ground, exposed for it
    assert_true(fabs((double)radiance[4 * top + 1]) < 1e-3);
    // 0.3 of the light of a star of 1.5 W m^-2 nm^-1: 683 * 106.9 nm (the integral of ybar) / pi,
    // at cos 0.5; thin air in front and the sunlight's own colour change it by less than a fifth.
    const double expected = 0.3 * 1.5 * 683 * 106.9 / PI * cos(0.5);
    assert_true(fabs((double)radiance[4 * bottom + 1] / expected - 1) < 0.2);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        assert_int_equal(rgba[4 * i + 3], 255);
        assert_true(radiance[4 * i + 3] == 1.0f);
    }
}

static void the_same_view_gives_the_same_picture(void **state)
{
    struct setup *s = *state;
    trl_view view = view_of_the_lower_half();
    uint8_t first[4 * WIDTH * HEIGHT], second[4 * WIDTH * HEIGHT];
    draw(s, &view);
    assert_int_equal(trl_renderer_read_rgba8(s->renderer, first), TRL_OK);
    trl_view other = view;
    other.heading_rad = 2;
    assert_int_equal(trl_renderer_draw(s->renderer, &other, 33, 7, 0), TRL_OK);
    draw(s, &view);
    assert_int_equal(trl_renderer_read_rgba8(s->renderer, second), TRL_OK);
    assert_memory_equal(first, second, sizeof first);
}

static void fixed_exposure_is_reported_and_bias_brightens(void **state)
{
    struct setup *s = *state;
    trl_view view = view_of_the_lower_half();
    view.has_fixed_exposure = true;
    view.exposure_ev100 = 14;
    uint8_t plain[4 * WIDTH * HEIGHT], biased[4 * WIDTH * HEIGHT];
    draw(s, &view);
    double ev100 = 0;
    assert_int_equal(trl_renderer_exposure(s->renderer, &ev100), TRL_OK);
    assert_true(ev100 == 14);
    assert_int_equal(trl_renderer_read_rgba8(s->renderer, plain), TRL_OK);
    view.exposure_bias_ev = 1;
    draw(s, &view);
    assert_int_equal(trl_renderer_read_rgba8(s->renderer, biased), TRL_OK);
    const size_t bottom = 4 * ((size_t)(HEIGHT - 1) * WIDTH + WIDTH / 2) + 1;
    assert_true(biased[bottom] > plain[bottom] + 10);
}

static void passes_are_timed_when_asked(void **state)
{
    struct setup *s = *state;
    const trl_view view = view_of_the_lower_half();
    draw(s, &view);
    trl_timing rows[16];
    const size_t count = trl_renderer_timings(s->renderer, rows, 16);
    assert_int_equal(count, trl_renderer_timings(s->renderer, NULL, 0));
    assert_true(count >= 3 && count <= 16);
    assert_string_equal(rows[count - 1].name, "tone");
    double cpu_ms = 0;
    for (size_t i = 0; i < count; i++) {
        assert_non_null(rows[i].name);
        assert_true(rows[i].gpu_ms >= 0 && isfinite(rows[i].gpu_ms));
        cpu_ms += rows[i].cpu_ms;
    }
    assert_true(cpu_ms > 0);
    trl_renderer *untimed = NULL;
    assert_int_equal(make_renderer(s, false, &untimed), TRL_OK);
    assert_int_equal(trl_renderer_draw(untimed, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_timings(untimed, rows, 16), 0);
    trl_renderer_wait(untimed);
    trl_renderer_destroy(&untimed);
}

static void a_bare_sphere_has_its_ground_at_zero(void **state)
{
    struct setup *s = *state;
    assert_true(trl_renderer_ground_altitude_m(s->renderer, 0.3, 100) == 0);
    trl_view view = view_of_the_lower_half(), resolved;
    view.altitude_m = -5;
    assert_int_equal(trl_renderer_resolve(s->renderer, &view, &resolved), TRL_OK);
    assert_true(resolved.altitude_m > 0 && resolved.altitude_m < 1);
}

static bool refuse(void *user, const char *stage, double fraction)
{
    (void)stage;
    (void)fraction;
    *(int *)user += 1;
    return false;
}

static void creation_can_be_cancelled(void **state)
{
    struct setup *s = *state;
    int calls = 0;
    trl_context_desc desc = trl_context_desc_default();
    desc.progress = refuse;
    desc.progress_user = &calls;
    desc.cache_dir = "";
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    trl_renderer_desc renderer_desc = trl_renderer_desc_default();
    renderer_desc.scene = s->scene;
    trl_renderer *out = NULL;
    assert_int_equal(trl_renderer_create(ctx, &renderer_desc, &out), TRL_ERROR_CANCELLED);
    assert_null(out);
    assert_int_equal(calls, 1);
    trl_context_destroy(&ctx);
}

// Memory that runs out at the n-th request, and counts what is not given back. Blocking calls ask
// from several threads at once.
struct purse {
    atomic_int left, live;
};

static void *take(void *user, size_t bytes)
{
    struct purse *purse = user;
    if (atomic_fetch_sub(&purse->left, 1) <= 0) {
        return NULL;
    }
    void *block = malloc(bytes);
    atomic_fetch_add(&purse->live, block != NULL);
    return block;
}

static void *retake(void *user, void *block, size_t bytes)
{
    (void)user;
    return realloc(block, bytes);
}

static void give_back(void *user, void *block)
{
    struct purse *purse = user;
    atomic_fetch_sub(&purse->live, block != NULL);
    free(block);
}

static trl_result create_with(const struct setup *s, struct purse *purse, trl_sky_model model)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.allocator = (trl_allocator){take, retake, give_back, purse};
    desc.cache_dir = "";
    trl_context *ctx = NULL;
    trl_result result = trl_context_create(&desc, &ctx);
    if (result == TRL_OK) {
        trl_renderer_desc renderer_desc = trl_renderer_desc_default();
        renderer_desc.scene = s->scene;
        renderer_desc.wavelengths = 4;
        renderer_desc.sky_model = (int)model;
        trl_renderer *renderer = NULL;
        result = trl_renderer_create(ctx, &renderer_desc, &renderer);
        assert_true((renderer != NULL) == (result == TRL_OK));
        trl_renderer_destroy(&renderer);
        trl_context_destroy(&ctx);
    }
    return result;
}

static void starve(void **state, trl_sky_model model)
{
    struct purse rich = {.left = 1000000};
    assert_int_equal(create_with(*state, &rich, model), TRL_OK);
    assert_int_equal(rich.live, 0);
    const int needed = 1000000 - rich.left;
    const int step = needed / 6 + 1; // six of the places where it may happen
    for (int left = 0; left < needed; left += step) {
        struct purse purse = {.left = left};
        assert_int_equal(create_with(*state, &purse, model), TRL_ERROR_MEMORY);
        assert_int_equal(purse.live, 0);
    }
}

static void running_out_of_memory_is_a_result_and_leaks_nothing(void **state)
{
    starve(state, TRL_SKY_SPECTRAL);
    starve(state, TRL_SKY_SINGLE);
    starve(state, TRL_SKY_RAYLEIGH);
}

static void the_gl_of_the_machine_is_described(void **state)
{
    struct setup *s = *state;
    trl_gpu_info info;
    assert_int_equal(trl_gpu_info_read(s->f->ctx, &info), TRL_OK);
    assert_true(strlen(info.renderer) > 0 && strlen(info.version) > 0);
    assert_true(info.max_texture_size >= 2048 && info.max_anisotropy >= 1); // floor of ES 3.0
    expect_invalid(s, trl_gpu_info_read(s->f->ctx, NULL));
    const trl_view view = view_of_the_lower_half();
    draw(s, &view); // the renderer takes its own context again
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_descriptions_are_refused),
        cmocka_unit_test(meshers_have_names_and_others_are_refused),
        cmocka_unit_test(projective_grids_that_cannot_be_are_refused),
        cmocka_unit_test(hemispheres_that_cannot_be_are_refused),
        cmocka_unit_test(mesh_errors_that_cannot_be_are_refused),
        cmocka_unit_test(wrong_sizes_are_refused),
        cmocka_unit_test(views_with_wrong_numbers_are_refused),
        cmocka_unit_test(nothing_is_read_before_something_is_drawn),
        cmocka_unit_test(pictures_come_top_row_first),
        cmocka_unit_test(the_same_view_gives_the_same_picture),
        cmocka_unit_test(fixed_exposure_is_reported_and_bias_brightens),
        cmocka_unit_test(passes_are_timed_when_asked),
        cmocka_unit_test(a_bare_sphere_has_its_ground_at_zero),
        cmocka_unit_test(creation_can_be_cancelled),
        cmocka_unit_test(running_out_of_memory_is_a_result_and_leaks_nothing),
        cmocka_unit_test(the_gl_of_the_machine_is_described),
    };
    return cmocka_run_group_tests_name("renderer", tests, set_up, tear_down);
}
