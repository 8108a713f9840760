// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The ground that a pixel shows, before any model of the sky lights it. With SURFACE it comes from
// the surface buffers, else it is the bare reference sphere, whose albedo the model knows.
#ifndef SKY_GROUND_GLSL
#define SKY_GROUND_GLSL

#include "shared/cloud.glsl"
#include "shared/sky_map.glsl"
#include "sky/fragment.glsl"

#ifdef SURFACE
uniform sampler2D u_position; // xyz relative to the camera, m; w altitude, m, or below -1e8
uniform sampler2D u_albedo;   // square root of linear sRGB
uniform sampler2D u_normal;   // a normal, and how much of the star is left: terrain/compose.h
// Square root of linear sRGB; a: where there is water its depth, else root of the star's light
// around.
uniform sampler2D u_lights;
uniform sampler2D u_region; // the same: albedo around; a: sky view factor
#endif

#ifdef CLOUDS
#include "sky/deck.glsl"

uniform sampler2D u_cloud_shade; // what clouds leave of the star, see cloud/shade.frag

// x: from about where the star is; y: from all around; z: of x, what is not scattered. Of every
// second pixel: of the four around those that are about as far away.
vec3 cloud_shade(float distance_m)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_cloud_shade, 0) - 1;
    ivec2 first = pixel / 2;
    vec2 part = vec2(pixel - 2 * first) * 0.5;
    float own = log(max(distance_m, 1.0e-3));
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int n = 0; n < 4; n++) {
        ivec2 offset = ivec2(n & 1, n >> 1);
        vec4 shade = texelFetch(u_cloud_shade, min(first + offset, last), 0);
        vec2 near = mix(1.0 - part, part, vec2(offset));
        float weight = (near.x * near.y + 1.0e-4) * cloud_alike(shade.y, own);
        sum += shade.xzw * weight;
        weights += weight;
    }
    return sum / weights;
}

// Under clouds, x: what is left of light from everywhere, and z of the star, on level ground, both
// in the mean around; y: what they send back of the ground's.
vec3 cloud_sky(vec3 place, float altitude, float sun_mu, float shed)
{
    Deck deck = deck_overhead(place, altitude);
    float through = cloud_star_through(deck.through, deck.cover, max(sun_mu, 0.0));
    float taken = min(shed / max(through, 1.0e-6), 1.0);
    return vec3(deck_left(deck), deck_back(deck), 1.0 - taken + shed);
}
#else
vec3 cloud_shade(float distance_m)
{
    return vec3(1.0, 0.0, 1.0);
}

vec3 cloud_sky(vec3 place, float altitude, float sun_mu, float shed)
{
    return vec3(1.0, 0.0, 1.0);
}
#endif

struct Ground {
    float distance_m;
    float altitude_m;
    vec3 normal;
    float star_visible; // share of the star's disc that terrain leaves, and of its light clouds
    float star_direct;  // of that, what clouds have not scattered
    float star_shed;    // of its light on level ground, what clouds shed from all around
#ifdef SURFACE
    vec3 albedo;      // linear sRGB
    vec3 region;      // the same, mean around
    vec3 lights;      // linear sRGB, of white
    float water;      // part that is open water
    float depth_code; // of that water: shared/sea.glsl
    float open;       // sky view factor
    // What ground around has of the star's light, 1 where it falls straight on; below 0: unknown.
    float around_lit;
#endif
};

#ifdef SURFACE
Ground find_ground(out Ray ray)
{
    Ground ground;
    vec4 position = texelFetch(u_position, ivec2(gl_FragCoord.xy), 0);
    float distance_m = length(position.xyz);
    ray = make_ray(position.xyz / max(distance_m, 1.0e-6));
    vec4 albedo = texelFetch(u_albedo, ivec2(gl_FragCoord.xy), 0);
    vec4 normal = texelFetch(u_normal, ivec2(gl_FragCoord.xy), 0);
    vec4 lights = texelFetch(u_lights, ivec2(gl_FragCoord.xy), 0);
    ground.distance_m = distance_m;
    ground.altitude_m = position.w;
    ground.normal = normal.xyz * inversesqrt(max(dot(normal.xyz, normal.xyz), 1.0e-6));
    vec3 shade = cloud_shade(distance_m);
    ground.star_visible = normal.w * shade.x;
    ground.star_direct = shade.z;
    ground.star_shed = shade.y;
    ground.albedo = albedo.rgb * albedo.rgb;
    vec4 region = texelFetch(u_region, ivec2(gl_FragCoord.xy), 0);
    ground.region = region.rgb * region.rgb;
    ground.lights = lights.rgb * lights.rgb;
    ground.water = albedo.a;
    ground.depth_code = lights.a;
    ground.around_lit = albedo.a > 0.0 ? -1.0 : lights.a * lights.a;
    ground.open = region.a;
    return ground;
}
#else
Ground find_ground(out Ray ray)
{
    Ground ground;
    ray = fragment_ray();
    ray.meets_ground = true; // what sort.frag has found counts, in case of rounding
    ray.end_m = ray.ground_m;
    ground.distance_m = ray.ground_m;
    ground.altitude_m = 0.0;
    ground.normal = normalize(u_eye_up * u_eye.x + ray.direction * ray.ground_m);
    vec3 shade = cloud_shade(ray.ground_m);
    ground.star_visible = shade.x;
    ground.star_direct = shade.z;
    ground.star_shed = shade.y;
    return ground;
}
#endif

#endif // SKY_GROUND_GLSL
