// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_FRAME_SPHERE_H
#define TESTS_FRAME_SPHERE_H
// A bare grey sphere under thin air, which is solved in no time.

#include "fixture.h"
#include <terrella/scene.h>

#include <string.h>

static inline trl_scene *sphere_scene(const struct fixture *f)
{
    static const char text[] =
        "{\"terrella\": 1, \"name\": \"sphere\","
        " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.27},"
        " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.3},"
        " \"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"air\","
        "  \"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 1e-6,"
        "   \"exponent\": -4}},"
        "  \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}, \"phase\": \"rayleigh\"}]}}";
    trl_scene *scene = NULL;
    assert_int_equal(trl_scene_parse(f->ctx, text, strlen(text), "sphere", "/nonexistent", &scene),
                     TRL_OK);
    return scene;
}

#endif // TESTS_FRAME_SPHERE_H
