// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The ground, over which mesh.frag draws the sea.
uniform sampler2D u_ground; // positions of the ground

layout(location = 0) out vec4 o_position;
// Of displaced sea, the place that was moved here, relative to the eye, and the cosine between view
// and normal; else 0.
layout(location = 1) out vec4 o_level;

void main()
{
    o_position = texelFetch(u_ground, ivec2(gl_FragCoord.xy), 0);
    o_level = vec4(0.0);
}
