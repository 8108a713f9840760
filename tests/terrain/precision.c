// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// From a centimetre above the ground to a hundred radii, in valleys and under cliffs: no jitter, no
// gap, nothing behind shines through. With one depth range, and with two.
#include "planet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 96, TALL = 4 * SIDE };
static const double R = 1e6;
static const double DEGREE = 3.14159265358979323846 / 180;

// Land with a trench of 3 km below the reference sphere, and mountains of up to 9 km around it.
static double rugged(double latitude, double longitude)
{
    const struct vec3 d = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
    const double trench = exp(-pow((latitude - 20) / 3, 2) - pow((longitude - 60) / 12, 2));
    const double range = exp(-pow((latitude - 30) / 3, 2) - pow((longitude - 60) / 20, 2));
    return 300 * sin(15 * d.x) * cos(14 * d.y) - 3300 * trench +
           range * (6500 + 2500 * sin(longitude * 1.3));
}

// Hills with steep sides.
static double steep(double latitude, double longitude)
{
    const double s = sin(latitude * 9) * cos(longitude * 8);
    return 2500 + 1500 * s / sqrt(0.05 + s * s);
}

struct scene {
    struct camera_place place;
    double height_m;
};

// Beside what the test's name asks for: poles and antimeridian, wide and narrow.
static const struct scene SCENES[] = {
    {{.latitude = 40, .longitude = 30, .heading = 40, .pitch = 2, .fov = 60}, 0.01},
    {{.latitude = 5, .longitude = -70, .heading = 200, .pitch = -30, .fov = 90}, 0.01},
    {{.latitude = 20, .longitude = 60, .heading = 0, .pitch = 5, .fov = 50}, 2},     // the trench
    {{.latitude = 26.5, .longitude = 61, .heading = 0, .pitch = 12, .fov = 50}, 20}, // below peaks
    // Peaks 6 degrees away, of which the horizon hides the lower 5 km.
    {{.latitude = 36, .longitude = 60, .heading = 180, .pitch = 1, .fov = 15}, 2},
    {{.latitude = -89.99, .longitude = 10, .heading = 90, .pitch = -5, .fov = 60}, 500},
    {{.latitude = 2, .longitude = 180, .heading = 120, .pitch = -12, .fov = 70}, 2e4},
    {{.latitude = 25, .longitude = 40, .heading = 80, .pitch = -60, .fov = 60}, 3e5},
    {{.latitude = 25, .longitude = 60, .pitch = -90, .fov = 50}, 4e6},
    {{.latitude = 25, .longitude = 60, .pitch = -90, .fov = 1.5}, 1e8}}; // a hundred radii
enum { SCENE_COUNT = sizeof SCENES / sizeof *SCENES };

struct sheet {
    struct gpu_texture position, depth;
    struct gpu_target target;
    float *pixels; // 4 each, lowest row first
    uint32_t width, height;
};

static void sheet_init(struct fixture *f, uint32_t width, uint32_t height, struct sheet *out)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.width = out->width = width;
    desc.height = out->height = height;
    desc.filter = GPU_FILTER_NEAREST;
    desc.format = GPU_FORMAT_RGBA32F;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &out->position), TRL_OK);
    desc.format = GPU_FORMAT_DEPTH32F;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &out->depth), TRL_OK);
    const struct gpu_target_desc target = {.color_count = 1,
                                           .colors = {{.texture = &out->position}},
                                           .depth = {.texture = &out->depth}};
    assert_int_equal(gpu_target_init(f->gpu, &target, &out->target), TRL_OK);
    out->pixels = mem_alloc(f->ctx, (size_t)width * height, 4 * sizeof(float));
    assert_non_null(out->pixels);
}

static void sheet_finish(struct fixture *f, struct sheet *sheet)
{
    gpu_target_finish(&sheet->target);
    gpu_texture_finish(&sheet->position);
    gpu_texture_finish(&sheet->depth);
    mem_free(f->ctx, sheet->pixels);
}

static void sheet_draw(struct sheet *sheet, struct mesher *mesher, const struct camera *camera)
{
    assert_int_equal(mesher_update(mesher, camera), TRL_OK);
    assert_int_equal(mesher_draw(mesher, &sheet->target), TRL_OK);
    const struct gpu_region all = gpu_texture_region(&sheet->position, 0);
    assert_int_equal(gpu_texture_read(&sheet->position, &all, sheet->pixels), TRL_OK);
}

static const float *pixel_at(const struct sheet *sheet, uint32_t x, uint32_t y)
{
    return sheet->pixels + 4 * ((size_t)y * sheet->width + x);
}

static bool is_ground(const float *pixel)
{
    return pixel[3] > -1e8f;
}

static double distance_of(const float *pixel)
{
    const struct vec3 p = {(double)pixel[0], (double)pixel[1], (double)pixel[2]};
    return vec3_length(p);
}

// ---- no gap: along a column of a level picture, ground begins once and ends once

static int count_gaps(const struct sheet *sheet)
{
    int gaps = 0;
    for (uint32_t x = 0; x < sheet->width; x++) {
        int begins = 0;
        for (uint32_t y = 0; y < sheet->height; y++) {
            begins += is_ground(pixel_at(sheet, x, y)) &&
                      (y == 0 || !is_ground(pixel_at(sheet, x, y - 1)));
        }
        gaps += begins > 1 ? begins - 1 : 0;
    }
    return gaps;
}

static void ground_has_no_gap(void **state)
{
    struct planet p;
    struct sheet sheet;
    planet_make(*state, rugged, steep, &p);
    sheet_init(*state, SIDE, TALL, &sheet);
    for (int kind = 0; mesher_name((trl_mesher)kind); kind++) {
        if (!planet_use(&p, (trl_mesher)kind)) {
            continue;
        }
        for (size_t i = 0; i < SCENE_COUNT; i++) {
            const struct camera camera = planet_camera(&p, SCENES[i].place, SCENES[i].height_m);
            sheet_draw(&sheet, p.mesher, &camera);
            const int gaps = count_gaps(&sheet);
            if (gaps > 0) {
                printf("%s, scene %zu: %d gaps\n", mesher_name((trl_mesher)kind), i, gaps);
            }
            assert_int_equal(gaps, 0);
        }
    }
    sheet_finish(*state, &sheet);
    planet_destroy(&p);
}

// ---- the right ground is in front

static struct reference_hit *cast(const struct planet *p, const struct camera *camera)
{
    const struct reference_caster caster = {&p->truth, R, camera,
                                            2 * camera->tan_half_fov_y / SIDE};
    const uint32_t size[2] = {SIDE, SIDE};
    struct reference_hit *hits = mem_alloc(p->f->ctx, (size_t)SIDE * SIDE, sizeof *hits);
    assert_non_null(hits);
    assert_int_equal(reference_caster_picture(p->f->ctx, &caster, size, hits), TRL_OK);
    return hits;
}

// Pixels, away from silhouettes, that show something else than the truth: by the distance.
static int count_wrong(const struct sheet *sheet, const struct reference_hit *hits)
{
    int wrong = 0;
    for (uint32_t y = 1; y + 1 < SIDE; y++) {
        for (uint32_t x = 1; x + 1 < SIDE; x++) {
            double least = INFINITY, most = 0;
            for (uint32_t k = 0; k < 9; k++) {
                const double d = hits[(y + k / 3 - 1) * SIDE + x + k % 3 - 1].distance_m;
                least = fmin(least, d);
                most = fmax(most, d);
            }
            const float *pixel = pixel_at(sheet, x, y);
            const double drawn = is_ground(pixel) ? distance_of(pixel) : (double)INFINITY;
            // Among its neighbours the truth has what is drawn, give or take a tenth.
            wrong += drawn < 0.9 * least || drawn > 1.1 * most;
        }
    }
    return wrong;
}

static void what_is_in_front_is_drawn(void **state)
{
    struct planet p;
    struct sheet sheet;
    struct reference_hit *hits[SCENE_COUNT] = {NULL}; // the same for all meshers
    planet_make(*state, rugged, steep, &p);
    sheet_init(*state, SIDE, SIDE, &sheet);
    for (int kind = 0; mesher_name((trl_mesher)kind); kind++) {
        if (!planet_use(&p, (trl_mesher)kind)) {
            continue;
        }
        for (size_t i = 0; i < SCENE_COUNT; i++) {
            const struct camera camera = planet_camera(&p, SCENES[i].place, SCENES[i].height_m);
            sheet_draw(&sheet, p.mesher, &camera);
            hits[i] = hits[i] ? hits[i] : cast(&p, &camera);
            const int wrong = count_wrong(&sheet, hits[i]);
            if (wrong > 0) {
                printf("%s, scene %zu: %d wrong\n", mesher_name((trl_mesher)kind), i, wrong);
            }
            // A crest that is off by a pixel.
            assert_true(wrong <= SIDE * SIDE / 500);
        }
    }
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        mem_free(p.f->ctx, hits[i]);
    }
    sheet_finish(*state, &sheet);
    planet_destroy(&p);
}

// ---- no jitter

static void check_at(const struct planet *p, const struct camera *camera, struct mesh_check *out)
{
    const struct mesh_check_desc desc = {.ctx = p->f->ctx,
                                         .gpu = p->f->gpu,
                                         .mesher = p->mesher,
                                         .truth = {&p->truth, R, camera, 0},
                                         .width = SIDE,
                                         .height = SIDE,
                                         .step = 1};
    assert_int_equal(mesh_check_init(&desc, NULL, out), TRL_OK);
}

// The camera moves aside by tenths of a pixel of what it sees in the middle. What the picture does
// beyond that is the mesh's rounding: each step is held against the truth for its own place.
static double find_jitter(const struct planet *p, const struct scene *scene)
{
    enum { STEPS = 3 };
    struct camera camera = planet_camera(p, scene->place, scene->height_m);
    const struct reference_caster caster = {&p->truth, R, &camera, 0};
    double distance = reference_caster_ray(&caster, (struct reference_point){0, -0.5}, INFINITY);
    distance = isfinite(distance) ? distance : scene->height_m;
    const double pixel_m = distance * 2 * camera.tan_half_fov_y / SIDE;
    struct mesh_check before, after;
    check_at(p, &camera, &before);
    double worst = 0;
    for (int i = 0; i < STEPS; i++) {
        camera.position_m = vec3_add(camera.position_m, vec3_scale(camera.right, 0.1 * pixel_m));
        check_at(p, &camera, &after);
        struct mesh_change change;
        assert_int_equal(mesh_check_change(&before, &after, &change), TRL_OK);
        worst = fmax(worst, change.rms);
        mesh_check_finish(&before);
        before = after;
    }
    mesh_check_finish(&before);
    return worst;
}

static void motion_below_a_pixel_moves_the_picture_by_as_much(void **state)
{
    struct planet p;
    planet_make(*state, rugged, steep, &p);
    for (int kind = 0; mesher_name((trl_mesher)kind); kind++) {
        if (!planet_use(&p, (trl_mesher)kind)) {
            continue;
        }
        for (size_t i = 0; i < SCENE_COUNT; i++) {
            const double jitter = find_jitter(&p, &SCENES[i]);
            printf("%s, scene %zu: %.4f px\n", mesher_name((trl_mesher)kind), i, jitter);
            // Half of a step. Between pixels the mesh's error is taken as linear, which it is not
            // where a triangle ends.
            assert_true(jitter < 0.05);
        }
    }
    planet_destroy(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ground_has_no_gap),
        cmocka_unit_test(what_is_in_front_is_drawn),
        cmocka_unit_test(motion_below_a_pixel_moves_the_picture_by_as_much),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
