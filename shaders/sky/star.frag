// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A star's light in one pixel, added to what is there.

#include "sky/star.glsl"

flat in vec2 v_centre;
flat in vec4 v_light;

layout(location = 0) out vec4 out_radiance;

void main()
{
    vec2 offset = gl_FragCoord.xy - v_centre;
    float core = star_kernel(offset);
    float halo = star_kernel(offset / STAR_HALO) / (STAR_HALO * STAR_HALO);
    out_radiance = vec4(v_light.rgb * mix(core, halo, v_light.a), 0.0);
}
