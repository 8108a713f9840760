// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A body between the star and what is seen. C sets the uniforms with sky_eclipse_set.
#ifndef SKY_ECLIPSE_GLSL
#define SKY_ECLIPSE_GLSL

#include "shared/eclipse.glsl"
#include "sky/ray.glsl"

uniform vec4 u_body;      // of its centre from the eye, across the way to the star; radius
uniform vec4 u_body_rays; // of its centre from the eye: unit; sine of its angular radius
uniform vec3 u_eclipse;   // of its centre from the eye, toward the star; star's angular radius;
                          // scale of umbra_coordinate (scatter/umbra.h)
uniform float u_corona;   // times the Sun's
uniform vec3 u_umbra_u;   // unit, across: that way u grows
uniform sampler3D u_umbra_air;    // u x v x altitude: what is left, of XYZ
uniform sampler2D u_umbra_ground; // u x v: of the sky's light on the ground, in the bands

// Distances of a place from the shadow's axis and behind the body; the place from the eye.
vec2 eclipse_place(vec3 place)
{
    float toward = dot(place, u_sun);
    return vec2(length(u_body.xyz - (place - toward * u_sun)), u_eclipse.x - toward);
}

// Visible part of the star.
float star_left(vec3 place)
{
    vec2 at = eclipse_place(place);
    return eclipse_shadow(at.x, at.y, u_body.w, u_eclipse.y);
}

vec2 umbra_place(vec3 place)
{
    vec3 across = place - dot(place, u_sun) * u_sun - u_body.xyz;
    float u = dot(across, u_umbra_u);
    float v = length(across - u * u_umbra_u);
    return vec2(0.5 + 0.5 * u / (abs(u) + u_eclipse.z), v / (v + u_eclipse.z));
}

// What is left of light that the air and the ground around have scattered, of XYZ, where `star` is
// left of the star; fourth: see scatter/umbra.h. `height` is the altitude in parts of the air's.
vec4 sky_left(vec3 place, float star, float height)
{
    float level = sqrt(clamp(height, 0.0, 1.0));
    float levels = float(textureSize(u_umbra_air, 0).z);
    vec3 at = vec3(umbra_place(place), level + (0.5 - level) / levels);
    return max(textureLod(u_umbra_air, at, 0.0) + vec4(vec3(star), 0.0), vec4(0.0));
}

// The same of the sky's light on the ground, in the bands.
vec4 ground_left(vec3 place, float star)
{
    return max(textureLod(u_umbra_ground, umbra_place(place), 0.0) + star, vec4(0.0));
}

// Radiance per unit irradiance of the star, sr^-1.
float corona(Ray ray)
{
    float apart = length(cross(ray.direction, u_sun)) / u_disc.y;
    float around = ray.nu > 0.0 && apart > 1.0 ? eclipse_corona(apart) : 0.0;
    return around * u_corona / (SHARED_PI * u_disc.y * u_disc.y);
}

// 0 where the body is before what a ray shows, with an edge as soft as a pixel.
float body_leaves(Ray ray)
{
    float from_centre = length(cross(ray.direction, u_body_rays.xyz));
    float beside = clamp((from_centre - u_body_rays.w) / u_disc.z + 0.5, 0.0, 1.0);
    return dot(ray.direction, u_body_rays.xyz) > 0.0 ? beside : 1.0;
}

#endif // SKY_ECLIPSE_GLSL
