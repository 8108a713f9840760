// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TEST_SCENE_SAMPLE_H
#define TEST_SCENE_SAMPLE_H
// A scene that the tests change one thing of.

#include <stdlib.h>
#include <string.h>
#include <terrella/scene.h>

// What its only constituent says beside the name.
#define SAMPLE_AIR                                                                                 \
    "\"scattering_per_m\": 1e-5, \"absorption_per_m\": 0,\n"                                       \
    "      \"profile\": { \"exponential\": { \"scale_height_m\": 8000 } },\n"                      \
    "      \"phase\": \"rayleigh\""

// Another one, of spheres.
#define SAMPLE_SPHERES                                                                             \
    "\"mie\": { \"refractive_index\": 1.5, \"absorption_index\": [[450, 0.01], [650, 0.001]],\n"   \
    "  \"size\": { \"log_normal\": { \"effective_radius_m\": 1e-6, \"effective_variance\": 0.2 } " \
    "},\n"                                                                                         \
    "  \"optical_depth\": { \"at_nm\": 600, \"value\": 0.5 } },\n"                                 \
    "  \"profile\": { \"table\": [[0, 1], [100000, 0]] }"

static const char sample_scene[] =
    "{ \"terrella\": 1, \"name\": \"Test\",\n"
    "  \"star\": { \"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.25 },\n"
    "  \"planet\": { \"radius_m\": 6371000, \"ground_albedo\": 0.1 },\n"
    "  \"atmosphere\": { \"height_m\": 100000, \"constituents\": [\n"
    "    { \"name\": \"air\", " SAMPLE_AIR " } ] },\n"
    "  \"surface\": { \"layers\": [ { \"elevation\": \"a.tif\" } ] },\n"
    "  \"views\": { \"one\": {\n"
    "    \"camera\": { \"latitude_deg\": 10, \"longitude_deg\": 20, \"altitude_m\": 3 },\n"
    "    \"sun\": { \"elevation_deg\": 45, \"azimuth_deg\": 180 },\n"
    "    \"bodies\": { \"Moon\": { \"elevation_deg\": 20, \"azimuth_deg\": 90 } } } },\n"
    "  \"bodies\": [ { \"name\": \"Moon\", \"radius_m\": 2e6, \"distance_m\": 4e8,\n"
    "    \"geometric_albedo\": 0.1 } ] }\n";

// A copy with the first `from` replaced by `to`; free() it. NULL when `from` is not there.
static inline char *sample_replace(const char *from, const char *to)
{
    const char *at = strstr(sample_scene, from);
    char *text = at ? malloc(sizeof sample_scene + strlen(to)) : NULL;
    if (text) {
        const size_t before = (size_t)(at - sample_scene);
        memcpy(text, sample_scene, before);
        strcpy(text + before, to);
        strcat(text, at + strlen(from));
    }
    return text;
}

#endif // TEST_SCENE_SAMPLE_H
