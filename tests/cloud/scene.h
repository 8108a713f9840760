// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_CLOUD_SCENE_H
#define TESTS_CLOUD_SCENE_H

// A scene of a bare planet with thin air; more keys and the closing brace are to follow.
#define CLOUD_SCENE                                                                                \
    "{\"terrella\": 1, \"name\": \"cloudy\","                                                      \
    " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.27},"                     \
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.1},"                                \
    " \"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"air\","                \
    "  \"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 1e-5,"                    \
    "   \"exponent\": -4}}, \"profile\": {\"exponential\": {\"scale_height_m\": 8000}},"           \
    "  \"phase\": \"rayleigh\"}]}"

#endif // TESTS_CLOUD_SCENE_H
