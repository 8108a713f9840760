// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// ocean/waves.glsl at a place from the eye: displacement, and normal with what is not shown.
#include "ocean/waves.glsl"

uniform vec4 u_place;     // from the eye, planet axes, m; w: depth of the water, m
uniform vec4 u_footprint; // sides of the window
uniform float u_wants_normal;
layout(location = 0) out vec4 o_color;

void main()
{
    float least = min(length(u_footprint.xy), length(u_footprint.zw));
    GerstnerSum s = waves_sum(waves_place(u_place.xyz),
                              WavesWindow(u_footprint.xy, u_footprint.zw, least, u_place.w));
    GerstnerNormal n = gerstner_normal(s);
    o_color = u_wants_normal > 0.5 ? vec4(n.x, n.y, n.z, s.lost_square)
                                   : vec4(s.x, s.y, s.z, gerstner_jacobian(s, 1.0));
}
