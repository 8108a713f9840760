// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The formulas that C and GLSL share, at the arguments of a test.
#include "shared/phase.glsl"
#include "shared/profile.glsl"

uniform vec4 u_angle; // cosine, g
uniform vec4 u_shell; // altitude, scale height, centre, half width
uniform float u_wants_profile;
layout(location = 0) out vec4 o_color;

void main()
{
    vec4 phases = vec4(phase_isotropic(), phase_rayleigh(u_angle.x),
                       phase_henyey_greenstein(u_angle.x, u_angle.y),
                       phase_cornette_shanks(u_angle.x, u_angle.y));
    vec4 profiles = vec4(profile_exponential(u_shell.x, u_shell.y),
                         profile_tent(u_shell.x, u_shell.z, u_shell.w), 0.0, 0.0);
    o_color = u_wants_profile > 0.5 ? profiles : phases;
}
