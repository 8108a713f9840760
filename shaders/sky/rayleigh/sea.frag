// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The part of a pixel that is open water, behind air, added to what ground.frag has drawn: lit by
// the star alone, mirroring the sky of a second line of sight, where its facets point in the mean.
// validate: SAMPLES 5; WAVELENGTHS 10; SURFACE
// validate: SAMPLES 5; WAVELENGTHS 10; FIT_HEIGHTS 10; SURFACE
// validate: SAMPLES 5; WAVELENGTHS 10; SIMPLE; SURFACE

#include "sky/rayleigh/air.glsl"
#include "sky/sea.glsl"

layout(location = 0) out vec4 out_radiance;

// From the water into space.
Sight look_up(Sea sea, vec3 direction)
{
    RayleighAir air = get_air();
    float radius = u_planet.x + sea.altitude_m;
    float begin = radius * dot(direction, sea.up);
    float above = (u_air.y - sea.altitude_m) * (2.0 * u_planet.x + u_air.y + sea.altitude_m);
    Sight sight;
    sight.line.begin = begin;
    sight.line.end = sqrt(begin * begin + max(above, 0.0));
    sight.line.excess = rayleigh_excess(air, sea.altitude_m) - begin * begin;
    sight.line.nu = dot(direction, u_sun);
    sight.line.sun_distance = radius * sea.sun_mu - begin * sight.line.nu;
    float closest = rayleigh_altitude(air, sight.line.excess);
    sight.closest_m = read_column(0.0, max(closest, 0.0));
    sight.closest_density = rayleigh_density(air, closest);
    sight.eye = find_point(sight, begin);
    return sight;
}

void main()
{
    Ray ray;
    Ground ground = find_ground(ray);
    Sea sea = find_sea(ray, ground);
    Sight sight = make_sight(ray, ground.distance_m - ray.begin_m);
    float view = find_between(sight, sight.eye, find_point(sight, sight.line.end));
    float star = star_column(ground.altitude_m, sea.sun_mu * (u_planet.x + ground.altitude_m));
    float radius = u_planet.x + ground.altitude_m;
    float horizon_mu = -sqrt(max(ground.altitude_m * (u_planet.x + radius), 0.0)) / radius;
    float share = rayleigh_visible((sea.sun_mu - horizon_mu) / u_disc.y);
    vec4 sent = vec4(max(star_through(view + star), vec3(0.0)) * share, 0.0);
    vec3 sky = air_light(look_up(sea, sea_mirror(sea)));
    vec3 whole = max(star_through(0.0), vec3(1.0e-6));
    vec4 mirrored = vec4(sky * max(star_through(view), vec3(0.0)) / whole, 0.0);
    vec4 light = sea_radiance(sea, sent, vec4(0.0), mirrored);
    out_radiance = vec4((light.rgb + sea_mirrored_terrain(sea)) * ground.water, 0.0);
}
