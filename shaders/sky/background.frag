// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The faint light of the whole sky that is no single star, in linear sRGB cd m^-2, added to air and
// space; with GROUND what it makes of the ground, which gets its mean. Air neither adds to it nor
// takes from it, beyond what airglow.c says; what uniform light loses on its way it gains from the
// side.
// validate: GROUND
// validate: GROUND; SURFACE

uniform vec3 u_background;    // at the zenith; with GROUND the mean
uniform vec3 u_ground_albedo; // of a bare sphere, linear sRGB

#ifdef SURFACE
uniform sampler2D u_albedo; // square root of linear sRGB
#endif

#ifndef GROUND
in vec2 v_uv;

uniform vec3 u_zenith;  // row from (1, x, y), the place in the picture in [-1, 1]^2
uniform vec2 u_tan;     // of half the picture
uniform vec2 u_airglow; // see airglow.h: share, layer
uniform vec3 u_depth_rgb;

vec3 airglow()
{
    vec3 at = vec3(1.0, 2.0 * v_uv - 1.0);
    float mu = max(dot(u_zenith, at) / length(vec3(1.0, at.yz * u_tan)), 0.0);
    float path = inversesqrt(1.0 - u_airglow.y * (1.0 - mu * mu));
    return (1.0 + u_airglow.x * (path - 1.0)) * exp(-u_depth_rgb * (path - 1.0));
}
#endif

layout(location = 0) out vec4 out_radiance;

void main()
{
    vec3 light = u_background;
#ifdef SURFACE
    vec3 root = texelFetch(u_albedo, ivec2(gl_FragCoord.xy), 0).rgb;
    light *= root * root;
#elif defined(GROUND)
    light *= u_ground_albedo;
#else
    light *= airglow();
#endif
    out_radiance = vec4(light, 0.0);
}
