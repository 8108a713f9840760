// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of the part of a pixel that is open water, behind air, added to what ground.frag has
// drawn of the rest: the sun's glint, the sky in the rough surface, what comes out of the water,
// white caps. What the air itself adds is drawn there.
// validate: PEAKED_COUNT 1; SURFACE; MOON
// validate: PEAKED_COUNT 3; SURFACE; MOON
// validate: PEAKED_COUNT 1; SURFACE; MOON; ECLIPSE
// validate: PEAKED_COUNT 1; SURFACE; MOON; ECLIPSE; CLOUDS

#include "sky/sea.glsl"
#include "sky/spectral/air.glsl"
#include "sky/spectral/colour.glsl"
#ifdef ECLIPSE
#include "sky/eclipse.glsl"
#endif

uniform vec4 u_ground_light; // lowest and highest tabulated altitude, softness, 1 over altitudes
uniform vec2 u_light_texel;  // 1 over suns in u_sunlight, in u_skylight
uniform sampler2D u_sunlight;
uniform sampler2D u_skylight;
uniform sampler3D u_mirror;  // azimuth x sun x view: see sky/sea.h
uniform vec2 u_mirror_texel; // 1 over azimuths and views

layout(location = 0) out vec4 out_radiance;

// The sky as the facets that are seen mirror it, weighed by their reflectance: as level water would
// that mirrors the same ray.
vec4 mirrored_sky(Sea sea, float day)
{
    float mu = clamp(dot(sea.mirrored, sea.up), 0.0, 1.0);
    float nu = dot(sea.mirrored, u_sun);
    float azimuth = sqrt(sky_map_azimuth(azimuth_cosine(mu, sea.sun_mu, nu)));
    // One table for each roughness, side by side.
    float lower = min(floor(sea.level), float(SEA_LEVELS - 2));
    vec3 at = vec3((centre(azimuth, u_mirror_texel.x) + lower) / float(SEA_LEVELS),
                   centre(day, u_slice_texel.y), centre(sqrt(mu), u_mirror_texel.y));
    vec4 smooth_sea = textureLod(u_mirror, at, 0.0);
    vec4 rough_sea = textureLod(u_mirror, at + vec3(1.0 / float(SEA_LEVELS), 0.0, 0.0), 0.0);
    // Lower suns than the lowest of the table, as in sky_light.
    float beyond =
        min(sky_map_asinh((sea.sun_mu - u_sun_grid.x) / u_sun_grid.y) - u_sun_grid.z, 0.0);
    return exp(mix(smooth_sea, rough_sea, sea.level - lower) + 9.3 * beyond);
}

// In the bands, before the air.
vec4 sea_light(Ray ray, Ground ground, Sea sea)
{
    float altitude =
        centre(clamp((ground.altitude_m - u_ground_light.x) / (u_ground_light.y - u_ground_light.x),
                     0.0, 1.0),
               u_ground_light.w);
    float lowest = sky_map_lowest_sun(u_planet.x, ground.altitude_m, u_disc.x, u_disc.y);
    float sun = sky_map_sunlight(sea.sun_mu, lowest, u_ground_light.z);
    vec4 star = textureLod(u_sunlight, vec2(centre(sun, u_light_texel.x), altitude), 0.0);
    float day = sun_coordinate(sea.sun_mu);
    vec4 sky = exp(textureLod(u_skylight, vec2(centre(day, u_light_texel.y), altitude), 0.0));
    vec4 mirrored = mirrored_sky(sea, day);
#ifdef ECLIPSE
    vec3 place = ray.direction * ground.distance_m;
    float left = star_left(place);
    vec4 sky_part = ground_left(place, left);
    star *= left;
    sky *= sky_part;
    mirrored *= sky_part;
#endif
    // Clouds hide a part of the mirrored sky, and are there as bright as what they let through.
    vec3 cloudy =
        cloud_sky(ray.direction * ground.distance_m, ground.altitude_m, sea.sun_mu, sea.shed);
    vec4 level = star * sea.height * cloudy.z + sky * cloudy.x;
    mirrored = mix(level * (1.0 / SHARED_PI), mirrored, cloudy.x);
    sky = sky * cloudy.x + star * (sea.height * sea.shed);
    return sea_radiance(sea, star, sky, mirrored);
}

void main()
{
    Ray ray;
    Ground ground = find_ground(ray);
    Sea sea = find_sea(ray, ground);
    vec4 light = sea_light(ray, ground, sea) * ground.water;
    float way = clamp(ground.distance_m, ray.begin_m, max(ray.end_m * 1.2, ground.distance_m)) -
                ray.begin_m;
    vec2 at = vec2(extinction_map(air_depth(ray, ground.distance_m)), aerial_row(ray));
    light *= exp(-textureLod(u_extinction, at, 0.0) * way);
    out_radiance = join_radiance(light, vec3(0.0));
    out_radiance.rgb += sea_mirrored_terrain(sea) * ground.water;
}
