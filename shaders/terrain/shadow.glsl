// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How much of the sun's disc the terrain leaves visible at a place. The C side is
// src/terrain/shadow.c.
#include "shared/hemisphere.glsl"

uniform sampler2D u_shadow_map;
uniform vec4 u_shadow; // scale of grid to texture coordinates, power, extent, sphere's radius
uniform mat3 u_shadow_from_planet;
uniform vec3 u_shadow_offset; // camera - the map's anchor on the sphere, local frame, m

// `position` is relative to the camera, planet axes; `altitude` above the sphere.
float terrain_sun_visibility(vec3 position, float altitude)
{
    vec3 local = (u_shadow_from_planet * position + u_shadow_offset) / u_shadow.w;
    LocalDirection d = LocalDirection(local.x, local.y, local.z);
    vec2 g = local.xy * shadow_map_scale(d, u_shadow.y, u_shadow.z);
    vec2 shadow = textureLod(u_shadow_map, 0.5 + 0.5 * g * u_shadow.x, 0.0).xy;
    // The part of a disc above a line, nearly: the smooth step has its slope at the middle.
    return smoothstep(-1.0, 1.0, (altitude - shadow.x) / shadow.y);
}
