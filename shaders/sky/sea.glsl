// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Open water as models of the sky light it. C sets the uniforms with sea_water_set.
#ifndef SKY_SEA_GLSL
#define SKY_SEA_GLSL

#include "shared/sea.glsl"
#include "sky/ground.glsl"

uniform sampler2D u_water; // depth x 2: reflectance of the water; x of the second row: that of the
                           // surface over the root of the view's cosine, y: see Sea.mirror_mu
uniform vec4 u_sea;        // mean square slope, refractive index, white share, its albedo
uniform float u_sea_texel; // 1 over depths of u_water
uniform float u_shadowed;  // 1: terrain's shadow is the light's

struct Sea {
    vec3 up;
    float altitude_m;
    float sun_mu, height; // of the star, and of its visible part
    float view_mu;
    float visible;   // part of the star that terrain leaves
    float glint;     // radiance per irradiance of a plane that faces the star
    float seen;      // reflectance of the surface for the view
    float mirror_mu; // cosine of the zenith angle where it mirrors the sky, in the mean
    float passed;    // part of light from everywhere that enters the water, at 60 degrees
    float entered;   // of the star's
    vec4 water;      // of the water below the surface
};

vec4 water_at(float x, float row)
{
    return textureLod(u_water, vec2(x + (0.5 - x) * u_sea_texel, row), 0.0);
}

float surface_reflectance(float mu)
{
    return water_at(sqrt(clamp(mu, 0.0, 1.0)), 0.75).x;
}

Sea find_sea(Ray ray, Ground ground)
{
    Sea sea;
    sea.up = normalize(u_eye_up * u_eye.x + ray.direction * ground.distance_m);
    sea.altitude_m = ground.altitude_m;
    sea.sun_mu = dot(sea.up, u_sun);
    sea.height = visible_height(sea.sun_mu, u_disc.y);
    sea.view_mu = clamp(-dot(sea.up, ray.direction), 0.0, 1.0);
    sea.visible = mix(1.0, ground.star_visible, u_shadowed);
    vec3 light = normalize(u_sun + sea.up * (sea.height - sea.sun_mu));
    vec3 facet = normalize(light - ray.direction);
    sea.glint =
        sea_glint(dot(facet, sea.up), dot(facet, light), sea.view_mu, sea.height, u_sea.x, u_sea.y);
    vec4 surface = water_at(sqrt(sea.view_mu), 0.75);
    sea.seen = surface.x;
    sea.mirror_mu = surface.y;
    sea.passed = 1.0 - surface_reflectance(0.5);
    sea.entered = 1.0 - surface_reflectance(sea.height);
    sea.water = water_at(ground.depth_code, 0.25);
    return sea;
}

// The mirrored ray in the mean.
vec3 sea_mirror(Sea sea, vec3 direction)
{
    vec3 along = direction + sea.up * sea.view_mu;
    float level = sqrt(max(1.0 - sea.mirror_mu * sea.mirror_mu, 0.0));
    return along * (level / max(length(along), 1.0e-6)) + sea.up * sea.mirror_mu;
}

// Radiance under light of the star (on a plane that faces it), irradiance of level ground by the
// sky, and the sky's radiance where it is mirrored.
vec4 sea_radiance(Sea sea, vec4 star, vec4 sky, vec4 mirrored)
{
    star *= sea.visible;
    vec4 below = star * (sea.height * sea.entered) + sky * sea.passed;
    vec4 clear =
        star * sea.glint + mirrored * sea.seen + sea.water * below * ((1.0 - sea.seen) / SHARED_PI);
    vec4 white = (star * sea.height + sky) * (u_sea.w / SHARED_PI);
    return mix(clear, white, u_sea.z);
}

#endif // SKY_SEA_GLSL
