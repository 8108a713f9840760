// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The sea where it stands before the ground: what is nearer of both, and of what lies at sea level
// always the sea. Nearest first by depth, land of the mask included, so that no sea shows through a
// spit.
uniform sampler2D u_ground; // positions of the ground: relative to the eye, m; altitude

in vec4 v_position;
in vec3 v_level;
in vec4 v_normal;

layout(location = 0) out vec4 o_position; // as u_ground
layout(location = 1) out vec4 o_level;    // as join.frag

// Within so much of sea level ground counts as the level sea that the mesh replaces, m.
const float SEA_LEVEL_M = 0.02;

void main()
{
    vec4 ground = texelFetch(u_ground, ivec2(gl_FragCoord.xy), 0);
    float distance_m = length(v_position.xyz);
    bool stands_before = ground.w > SEA_LEVEL_M && length(ground.xyz) < distance_m;
    bool is_sea = v_normal.w > 0.0 && !stands_before;
    // By the slope of the waves that are displaced, how long a pixel is on the water.
    float mu = -dot(normalize(v_normal.xyz), v_position.xyz) / max(distance_m, 1.0e-6);
    o_position = is_sea ? v_position : ground;
    o_level = is_sea ? vec4(v_level, max(mu, 1.0e-3)) : vec4(0.0);
}
