// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The part of a pixel that is open water, behind air, added to what ground.frag has drawn: lit by
// the star alone, mirroring the sky that is scattered once, where its facets point in the mean.
// validate: CHANNEL_COUNT 2; SURFACE
// validate: CHANNEL_COUNT 0; SURFACE

#include "sky/sea.glsl"
#include "sky/single/near.glsl"

layout(location = 0) out vec4 out_radiance;

// The whole sky along a ray that begins on the water.
vec3 sky_above(Sea sea, vec3 direction)
{
    Ray ray;
    Point p;
    float radius = u_planet.x + sea.altitude_m;
    ray.mu = radius * dot(direction, sea.up) / u_eye.x; // its place is that of the point
    ray.nu = dot(direction, u_sun);
    ray.meets_ground = false;
    p.altitude_m = clamp(sea.altitude_m, 0.0, u_planet.y);
    p.place_m = u_eye.x * ray.mu;
    p.sun_mu = sea.sun_mu;
    ray.chord_m = sqrt(p.place_m * p.place_m + (u_planet.y - p.altitude_m) *
                                                   (2.0 * u_planet.x + u_planet.y + p.altitude_m));
    return scattered_beyond(ray, p, phase_of(ray.nu));
}

void main()
{
    Ray ray;
    Ground ground = find_ground(ray);
    Sea sea = find_sea(ray, ground);
    vec3 sky = sky_above(sea, sea_mirror(sea));
    vec4 mirrored =
        u_added_from_rgb[0] * sky.r + u_added_from_rgb[1] * sky.g + u_added_from_rgb[2] * sky.b;
    Point p;
    p.altitude_m = clamp(ground.altitude_m, 0.0, u_planet.y);
    p.place_m = 0.0;
    p.sun_mu = sea.sun_mu;
    vec4 sent = sea_radiance(sea, star_light(p), vec4(0.0), vec4(0.0));
    Air air = air_before(ray, ground.distance_m, ground.altitude_m);
    vec3 shown = added_colour(mirrored * air.transmittance) *
                 (sea.seen * (1.0 - sea.white.x) * (1.0 - sea.terrain.a));
    vec4 light = join_light(sent * air.transmittance, shown);
    out_radiance = vec4((light.rgb + sea_mirrored_terrain(sea)) * ground.water, 0.0);
}
