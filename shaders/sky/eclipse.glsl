// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A body between the star and what is seen. C sets the uniforms with sky_eclipse_set.
#ifndef SKY_ECLIPSE_GLSL
#define SKY_ECLIPSE_GLSL

#include "shared/eclipse.glsl"
#include "sky/ray.glsl"

uniform vec4 u_body;      // of its centre from the eye, across the way to the star; radius
uniform vec4 u_body_rays; // of its centre from the eye: unit; sine of its angular radius
uniform vec3 u_shadow;    // of its centre from the eye, toward the star; star's angular radius,
                          // standard deviation of where scattered light comes from

// Distances of a place from the shadow's axis and behind the body; the place from the eye.
vec2 eclipse_place(vec3 place)
{
    float toward = dot(place, u_sun);
    return vec2(length(u_body.xyz - (place - toward * u_sun)), u_shadow.x - toward);
}

// Visible part of the star.
float star_left(vec3 place)
{
    vec2 at = eclipse_place(place);
    return eclipse_shadow(at.x, at.y, u_body.w, u_shadow.y);
}

// What is left of light that the air around has scattered.
float sky_left(vec3 place)
{
    vec2 at = eclipse_place(place);
    return eclipse_shadow_mean(at.x, at.y, u_body.w, u_shadow.y, u_shadow.z);
}

// 0 where the body is before what a ray shows, with an edge as soft as a pixel.
float body_leaves(Ray ray)
{
    float from_centre = length(cross(ray.direction, u_body_rays.xyz));
    float beside = clamp((from_centre - u_body_rays.w) / u_disc.z + 0.5, 0.0, 1.0);
    return dot(ray.direction, u_body_rays.xyz) > 0.0 ? beside : 1.0;
}

#endif // SKY_ECLIPSE_GLSL
