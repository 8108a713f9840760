// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The faint light of the whole sky that is no single star: the same radiance from everywhere, in
// linear sRGB cd m^-2, added to air and space; with GROUND what it makes of the ground. Air neither
// adds to it nor takes from it: what uniform light loses on its way it gains from the side, but for
// absorption.
// validate: GROUND
// validate: GROUND; SURFACE

uniform float u_background;
uniform vec3 u_ground_albedo; // of a bare sphere, linear sRGB

#ifdef SURFACE
uniform sampler2D u_albedo; // square root of linear sRGB
#endif

layout(location = 0) out vec4 out_radiance;

void main()
{
    vec3 light = vec3(u_background);
#ifdef SURFACE
    vec3 root = texelFetch(u_albedo, ivec2(gl_FragCoord.xy), 0).rgb;
    light *= root * root;
#elif defined(GROUND)
    light *= u_ground_albedo;
#endif
    out_radiance = vec4(light, 0.0);
}
