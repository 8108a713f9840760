// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "drawer.h"

#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char scene_format[] = CLOUD_SCENE "%s}";

trl_view look(double altitude_m, double pitch_deg)
{
    trl_view view = trl_view_default();
    view.altitude_m = altitude_m;
    view.latitude_rad = 10 * DEGREE; // where no hole of a deck happens to be
    view.pitch_rad = pitch_deg * DEGREE;
    view.vertical_fov_rad = 50 * DEGREE;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 40 * DEGREE;
    view.sun_longitude_or_azimuth_rad = 0;
    return view;
}

struct drawer make_drawer(struct fixture *f, const char *clouds)
{
    char text[2048];
    snprintf(text, sizeof text, scene_format, clouds);
    return make_scene_drawer(f, text);
}

struct drawer make_scene_drawer(struct fixture *f, const char *text)
{
    struct drawer d = {0};
    assert_int_equal(trl_scene_parse(f->ctx, text, strlen(text), "cloudy", ".", &d.scene), TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = d.scene;
    desc.wavelengths = 4;
    fixture_skip_without_gl(f, trl_renderer_create(f->ctx, &desc, &d.renderer));
    return d;
}

void finish_drawer(struct drawer *d)
{
    trl_renderer_destroy(&d->renderer);
    trl_scene_destroy(&d->scene);
}

float *draw_larger(const struct drawer *d, const trl_view *view, int times)
{
    float *rgba = malloc(FLOATS * (size_t)times * (size_t)times * sizeof *rgba);
    assert_non_null(rgba);
    const uint32_t width = WIDTH * (uint32_t)times;
    const uint32_t height = HEIGHT * (uint32_t)times;
    assert_int_equal(trl_renderer_draw(d->renderer, view, width, height, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(d->renderer, rgba), TRL_OK);
    return rgba;
}

float *draw(const struct drawer *d, const trl_view *view)
{
    return draw_larger(d, view, 1);
}
