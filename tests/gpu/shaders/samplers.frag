// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// One sampler of each kind, all at their middle.
uniform sampler2D u_image;
uniform sampler3D u_volume;
uniform sampler2DArray u_layers;
uniform isampler2D u_heights;

in vec2 v_uv;
layout(location = 0) out vec4 o_color;

void main()
{
    o_color =
        vec4(texture(u_image, v_uv).r, texture(u_volume, vec3(v_uv, 0.5)).r,
             texture(u_layers, vec3(v_uv, 1.0)).r, float(texelFetch(u_heights, ivec2(0), 0).r));
}
