// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// One texel a query: what the atlas has at a place and level, linear.
#include "terrain/pages.glsl"

uniform highp sampler2D u_queries; // u, v, level
uniform highp sampler2D u_tiles;
uniform vec4 u_paging;

out vec4 o_value;

void main()
{
    vec4 query = texelFetch(u_queries, ivec2(gl_FragCoord.xy), 0);
    vec2 at = page_texel(u_paging, query.xy, int(query.z));
    o_value = textureLod(u_tiles, at / vec2(textureSize(u_tiles, 0)), 0.0);
}
