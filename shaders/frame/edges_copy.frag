// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Back into the radiance, where pixels are marked.

uniform sampler2D u_blended;

layout(location = 0) out vec4 out_radiance;

void main()
{
    out_radiance = texelFetch(u_blended, ivec2(gl_FragCoord.xy), 0);
}
