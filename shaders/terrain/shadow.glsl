// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How much of the sun's disc the terrain leaves visible at a place. The C side is
// src/terrain/shadow.c.
#include "shared/hemisphere.glsl"
#include "shared/penumbra.glsl"

uniform sampler2D u_shadow_map; // altitude of the shadow, distance to what casts it, ground; m
uniform vec4 u_shadow; // scale of grid to texture coordinates, power, extent, sphere's radius
uniform mat3 u_shadow_from_planet;
uniform float u_shadow_sun;   // angular radius of the sun
uniform vec3 u_shadow_toward; // to it, local frame
uniform vec3 u_shadow_offset; // camera - the map's anchor on the sphere, local frame, m

// The cubic B-spline over the map by four linear taps: where one ridge takes over from another the
// map jumps, and linear patches would show.
vec2 shadow_smooth(vec2 uv)
{
    vec2 size = vec2(textureSize(u_shadow_map, 0));
    vec2 at = uv * size - 0.5;
    vec2 base = floor(at);
    vec2 f = at - base;
    vec2 r = 1.0 - f;
    vec2 w0 = r * r * r / 6.0;
    vec2 w1 = 2.0 / 3.0 - 0.5 * f * f * (2.0 - f);
    vec2 w3 = f * f * f / 6.0;
    vec2 low = w0 + w1;
    vec2 a = (base - 0.5 + w1 / low) / size;
    vec2 b = (base + 1.5 + w3 / (1.0 - low)) / size;
    return mix(mix(textureLod(u_shadow_map, b, 0.0).xy,
                   textureLod(u_shadow_map, vec2(a.x, b.y), 0.0).xy, low.x),
               mix(textureLod(u_shadow_map, vec2(b.x, a.y), 0.0).xy,
                   textureLod(u_shadow_map, a, 0.0).xy, low.x),
               low.y);
}

// From a position relative to the camera, planet axes, to the map's local frame: a direction of
// any length with x, y, z + 1.
vec3 shadow_local(vec3 position)
{
    return (u_shadow_from_planet * position + u_shadow_offset) / u_shadow.w;
}

vec2 shadow_grid(vec3 local)
{
    LocalDirection d = LocalDirection(local.x, local.y, local.z);
    return local.xy * shadow_map_scale(d, u_shadow.y, u_shadow.z);
}

// Sine of the sun's elevation.
float shadow_sine(vec3 local)
{
    return dot(u_shadow_toward, normalize(vec3(local.xy, 1.0 + local.z)));
}

// `position` is relative to the camera, planet axes; `altitude` above the sphere.
float terrain_sun_visibility(vec3 position, float altitude)
{
    vec3 local = shadow_local(position);
    vec2 shadow = shadow_smooth(0.5 + 0.5 * shadow_grid(local) * u_shadow.x);
    // The disc crosses the crest over its radius times 1 / cos^2 of its elevation.
    float sine = shadow_sine(local);
    float penumbra = max(shadow.y, 1.0) * u_shadow_sun / max(1.0 - sine * sine, 0.01);
    // The part of a disc above a line, nearly: the smooth step has its slope at the middle.
    return penumbra_visible((altitude - shadow.x) / max(penumbra, 0.5));
}

// For a point of the air, the place t of shared/penumbra.glsl: x in the terrain's shadow, y in that
// of the level sphere, which direct light already knows; z is the height above the ground, m.
// Outside the map there is no terrain.
vec3 terrain_air_shadow(vec3 position, float altitude)
{
    vec3 local = shadow_local(position);
    vec2 g = shadow_grid(local);
    vec3 shadow = textureLod(u_shadow_map, 0.5 + 0.5 * g * u_shadow.x, 0.0).xyz;
    float sine = shadow_sine(local);
    float cos2 = max(1.0 - sine * sine, 0.01);
    float inverse = 1.0 / sqrt(cos2);
    float spread = u_shadow_sun / cos2;
    // A ray that grazes the sphere passes R (1 / cos - 1) above it, R tan away.
    float level = altitude - u_shadow.w * sine * sine * inverse * inverse / (1.0 + inverse);
    float t = (altitude - shadow.x) / max(max(shadow.y, 1.0) * spread, 0.5);
    float level_t = level / max(-u_shadow.w * sine * inverse * spread, 0.5);
    bool is_inside = max(abs(g.x), abs(g.y)) < 1.0;
    return vec3(is_inside ? t : 2.0, sine < 0.0 ? level_t : 2.0,
                is_inside ? altitude - shadow.z : 1.0e6);
}
