// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The planet from so far away that its relief is less than a pixel: one height a pixel, on a sphere
// through that height. Output as src/terrain/mesher.h says. The C side is src/terrain/impostor.c.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 4; WATER_COUNT 4; LIGHTS_COUNT 4
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; NO_FLOAT_LINEAR
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_NOISE
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_GROUND
#include "shared/projective.glsl"
#include "terrain/depth.glsl"
#include "terrain/layers.glsl"

uniform vec3
    u_distance; // the viewer's altitude above the reference sphere, that sphere's radius, m;
                // the mean altitude of the ground
uniform float u_log2_footprint;
uniform mat3 u_local_from_view; // columns right * tan, up * tan, forward
uniform mat3 u_planet_from_local;

in vec2 v_uv;
layout(location = 0) out vec4 o_position;

struct Hit {
    float gamma, distance_m; // negative where the ray misses
};

Hit hit_sphere(float omega, float altitude)
{
    float above = u_distance.x - altitude;
    float excess = projective_excess(above, u_distance.y + altitude);
    float tangent = projective_tangent(excess);
    float inside = min(omega, tangent);
    float distance_m = projective_distance(inside, tangent, excess, above);
    return Hit(projective_normal_angle(inside, tangent, excess),
               omega < tangent ? distance_m : -1.0);
}

void main()
{
    vec3 view = vec3(2.0 * v_uv - 1.0, 1.0);
    vec3 ray = normalize(u_local_from_view * view);
    float level = length(ray.xy);
    float omega = atan(level, -ray.z);
    // From a point above the limb the height there is taken.
    float gamma = hit_sphere(omega, u_distance.z).gamma;
    float s = sin(0.5 * gamma);
    vec3 direction = vec3(sin(gamma) * ray.xy / max(level, 1e-9), -2.0 * s * s);
    float h = terrain_altitude(geo_from_local(direction, 1.0), u_log2_footprint);
    Hit hit = hit_sphere(omega, h);
    if (hit.distance_m < 0.0) {
        discard;
    }
    o_position = vec4(u_planet_from_local * (ray * hit.distance_m), h);
    vec4 clip = depth_clip(vec3(0.0, 0.0, hit.distance_m / length(u_local_from_view * view)));
    float depth = clip.z / clip.w;
#if TRL_CLIP_CONTROL
    gl_FragDepth = depth;
#else
    gl_FragDepth = 0.5 * depth + 0.5;
#endif
}
