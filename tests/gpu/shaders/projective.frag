// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// shared/projective.glsl at the arguments of a test.
#include "shared/projective.glsl"

uniform vec4 u_ray; // omega over the tangent, altitude, radius, rise of the maximum sphere
layout(location = 0) out vec4 o_color;

void main()
{
    float excess = projective_excess(u_ray.y, u_ray.z);
    float tangent = projective_tangent(excess);
    float omega = u_ray.x * tangent;
    float reach = projective_reach(excess, u_ray.z, u_ray.w);
    o_color = vec4(projective_normal_angle(omega, tangent, excess),
                   projective_distance(omega, tangent, excess, u_ray.y),
                   projective_blended_angle(omega, excess, reach, 0.5),
                   projective_rings_within(u_ray.x, 0.001, 7.0));
}
