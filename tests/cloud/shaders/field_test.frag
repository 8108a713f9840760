// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Extinction of the first layer at a place, with its height.
#include "cloud/field.glsl"

uniform vec4 u_place; // relative to the eye, m; level

out vec4 out_point;

void main()
{
    float cover = cloud_cover(0, u_place.xyz, 1.0);
    cover = cloud_gathered(0, u_place.xyz, cover, u_place.w);
    float extinction = cloud_point(0, u_place.xyz, cover, u_place.w);
    out_point = vec4(extinction, cloud_height(0, u_place.xyz), 0.0, cover);
}
