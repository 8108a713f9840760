// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The light of clouds toward the eye: what falls on them, and which share of it they send on.
#ifndef CLOUD_LIGHT_GLSL
#define CLOUD_LIGHT_GLSL

#include "cloud/field.glsl"
#include "sky/spectral/air.glsl"

uniform vec4 u_ground_light; // as in sky/spectral/ground.frag
uniform vec2 u_light_texel;
uniform sampler2D u_sunlight;
uniform sampler2D u_skylight;
uniform sampler2D u_rising;

// Further orders of scattering inside the cloud, as octaves of which each is dimmer, less dimmed on
// its way and less peaked than the one before (Wrenninge, Kulla and Lundqvist 2013), and what has
// lost all direction, which falls with the depth as a diffusion does.
const float OCTAVE_LIGHT = 0.5;
const float OCTAVE_DEPTH = 0.4;
const float OCTAVE_NARROW = 0.5;
const float DIFFUSE = 3.5;

// Of what lights clouds around a place, in the bands.
struct Lights {
    vec4 sun, above, below;
};

Lights lights_at(vec3 place)
{
    float altitude_m = cloud_altitude(place);
    vec3 up = normalize(u_eye_up * u_eye.x + place);
    float altitude = centre(
        clamp((altitude_m - u_ground_light.x) / (u_ground_light.y - u_ground_light.x), 0.0, 1.0),
        u_ground_light.w);
    Lights lights;
    float sun_mu = dot(up, u_sun);
    float lowest = sky_map_lowest_sun(u_planet.x, altitude_m, u_disc.x, u_disc.y);
    float sun = sky_map_sunlight(sun_mu, lowest, u_ground_light.z);
    vec2 day = vec2(centre(sun_coordinate(sun_mu), u_light_texel.y), altitude);
    lights.sun = textureLod(u_sunlight, vec2(centre(sun, u_light_texel.x), altitude), 0.0);
    lights.above = exp(textureLod(u_skylight, day, 0.0)) * (1.0 / SHARED_PI);
    lights.below = exp(textureLod(u_rising, day, 0.0)) * (1.0 / SHARED_PI);
    return lights;
}

// The phase function of each octave.
vec3 phases_at(float nu)
{
    return vec3(cloud_phase(nu, 1.0), cloud_phase(nu, OCTAVE_NARROW),
                cloud_phase(nu, OCTAVE_NARROW * OCTAVE_NARROW));
}

// What the light toward the eye is per unit of the star's irradiance and of radiance from above and
// below.
struct Shares {
    float sun, above, below;
};

Shares shares_at(CloudLayer layer, vec3 place, float cover, float sun_mu, vec3 phases, float width)
{
    float height = cloud_height(layer, place);
    float depth = cloud_sun_depth(layer, place, cover, sun_mu, height, width);
    // How thick the cloud around is, from a look at a box of half the layer's height.
    float thick_m = layer.shell.y - layer.shell.x;
    float around =
        cloud_coarse(layer, place, cover,
                     cloud_whole_box(layer, cloud_level(layer, max(0.5 * thick_m, width)), 0.5))
            .y;
    float thick = CLOUD_DIFFUSE_DEPTH * around * 0.7 * thick_m;
    float returned = thick / (1.0 + thick);
    Shares shares;
    float octave2 = OCTAVE_DEPTH * OCTAVE_DEPTH;
    shares.sun = phases.x * exp(-depth) + OCTAVE_LIGHT * phases.y * exp(-OCTAVE_DEPTH * depth) +
                 OCTAVE_LIGHT * OCTAVE_LIGHT * phases.z * exp(-octave2 * depth) +
                 DIFFUSE / (4.0 * SHARED_PI) * (0.5 + 0.5 * sun_mu) * returned /
                     (1.0 + CLOUD_DIFFUSE_DEPTH * depth);
    // Radiance between two lit sides runs linearly with the depth.
    float high = clamp(height, 0.0, 1.0);
    shares.above = (1.0 + thick * high) / (2.0 + thick);
    shares.below = 1.0 - shares.above;
    return shares;
}

#endif // CLOUD_LIGHT_GLSL
