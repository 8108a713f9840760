// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The GPU's frame against the CPU's spectral answer for the same pixels: every stage between the
// solved moments and the colour of a pixel (four bands, 4D table, aerial perspective, light on the
// ground, projections) at once.
#include "frame_check.h"
#include "scatter/atmosphere.h"
#include "scene/scene.h"
#include <terrella/terrella.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 96, HEIGHT = 54 };

// The target of the project; the tables are made for half of it.
static const double MEDIAN_LIMIT = 0.02;
// One pixel in twenty may be worse, up to this: where the limb or twilight changes within a texel.
static const double MOST_LIMIT = 0.06;

struct fixture {
    trl_context *ctx;
    trl_scene *scene;
    trl_renderer *renderer;
    struct atmosphere *atmosphere;
    struct band_fit exact; // its exact matrix from all wavelengths to colour
    struct query *query;
};

static int set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    f->ctx = NULL;
    trl_context_desc context = trl_context_desc_default();
    context.log = trl_log_stderr;
    context.cache_dir = "";
    assert_int_equal(trl_context_create(&context, &f->ctx), TRL_OK);
    assert_int_equal(trl_scene_load(f->ctx, SPECTRAL_FRAME_SCENE, &f->scene), TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = f->scene;
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &f->renderer), TRL_OK);
    const struct atmosphere_desc atmosphere = atmosphere_desc_default();
    assert_int_equal(atmosphere_create(f->ctx, &f->scene->medium, &atmosphere, &f->atmosphere),
                     TRL_OK);
    band_fit_init(&f->exact, f->atmosphere->optics);
    assert_int_equal(query_create(f->ctx, &f->atmosphere->solution, &f->query), TRL_OK);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    query_destroy(f->ctx, &f->query);
    atmosphere_destroy(&f->atmosphere);
    trl_renderer_destroy(&f->renderer);
    trl_scene_destroy(&f->scene);
    trl_context_destroy(&f->ctx);
    free(f);
    return 0;
}

static void find_colour(const void *model, const struct query_view *view, float rgb[3])
{
    const struct fixture *f = model;
    lanes radiance;
    query_radiance(f->query, view, &radiance);
    frame_check_colour(&f->exact, &radiance, rgb);
}

static struct frame_check check_of(const struct fixture *f)
{
    return (struct frame_check){.ctx = f->ctx,
                                .scene = f->scene,
                                .renderer = f->renderer,
                                .name = "spectral-frame",
                                .width = WIDTH,
                                .height = HEIGHT,
                                .median_limit = MEDIAN_LIMIT,
                                .most_limit = MOST_LIMIT,
                                .expect = find_colour,
                                .model = f};
}

static void frames_are_the_numbers(void **state)
{
    const struct frame_check check = check_of(*state);
    frame_check_all(&check);
}

// Along the terminator light falls by factors from one azimuth to the next.
static void half_disc_from_afar(void **state)
{
    const struct frame_check check = check_of(*state);
    trl_view view;
    assert_int_equal(trl_scene_view(check.scene, "full-disc", &view), TRL_OK);
    view.sun_mode = TRL_SUN_SUBSOLAR;
    view.sun_latitude_or_elevation_rad = 0.17;
    view.sun_longitude_or_azimuth_rad = 1.05;
    frame_check_view(&check, "half-disc", &view);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_the_numbers),
        cmocka_unit_test(half_disc_from_afar),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
