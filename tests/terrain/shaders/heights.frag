// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The altitude at offsets from the anchor, one to a pixel. x: altitude; y, z, w: the slope where
// there is noise, local axes.
#include "terrain/layers.glsl"

uniform vec4 u_offsets[64]; // direction - the anchor's, local axes; log2 of the footprint in m

out vec4 o_height;

void main()
{
    vec4 o = u_offsets[int(gl_FragCoord.x)];
    vec2 geo = geo_from_local(o.xyz, 1.0);
    o_height = vec4(terrain_altitude(geo, o.w), 0.0, 0.0, 0.0);
#ifdef HAS_GROUND
    Tangent t = tangent_at(o.xyz, geo, o.w);
    Relief r = noise_compose(ground_base(t, o.w, 0.0), o.xyz * u_anchor.w, t.up);
    vec3 s = vec3(r.x, r.y, r.z);
    o_height.yzw = s - t.up * dot(s, t.up);
#endif
}
