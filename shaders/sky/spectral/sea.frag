// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of the part of a pixel that is open water, behind air, added to what ground.frag has
// drawn of the rest: the sun's glint, the sky in the rough surface, what comes out of the water,
// white caps. What the air itself adds is drawn there.
// validate: PEAKED_COUNT 1; SURFACE
// validate: PEAKED_COUNT 3; SURFACE
// validate: PEAKED_COUNT 1; SURFACE; ECLIPSE

#define MOON // what is added leaves the picture's alpha
#include "shared/sea.glsl"
#include "sky/ground.glsl"
#include "sky/spectral/air.glsl"
#include "sky/spectral/colour.glsl"
#ifdef ECLIPSE
#include "sky/eclipse.glsl"
#endif

uniform vec4 u_ground_light; // lowest and highest tabulated altitude, softness, 1 over altitudes
uniform vec2 u_light_texel;  // 1 over suns in u_sunlight, in u_skylight
uniform sampler2D u_sunlight;
uniform sampler2D u_skylight;
uniform float u_shadowed; // 1: terrain's shadow is the light's

uniform sampler3D u_mirror; // azimuth x sun x view: see sky/sea.h
uniform sampler2D u_water;  // depth x 2: what comes out of the water; what the surface mirrors
uniform vec4 u_sea;         // mean square slope, refractive index, white share, its albedo
uniform vec3 u_sea_texel;   // 1 over azimuths and views of u_mirror, over depths of u_water

layout(location = 0) out vec4 out_radiance;

float surface_reflectance(float mu)
{
    float root = sqrt(clamp(mu, 0.0, 1.0));
    return textureLod(u_water, vec2(centre(root, u_sea_texel.z), 0.75), 0.0).x;
}

vec4 mirrored_sky(float view_mu, float sun_mu, float nu, float day)
{
    float azimuth = sqrt(sky_map_azimuth(azimuth_cosine(-view_mu, sun_mu, nu)));
    vec3 at = vec3(centre(azimuth, u_sea_texel.x), centre(day, u_slice_texel.y),
                   centre(sqrt(view_mu), u_sea_texel.y));
    // Lower suns than the lowest of the table, as in sky_light.
    float beyond = min(sky_map_asinh((sun_mu - u_sun_grid.x) / u_sun_grid.y) - u_sun_grid.z, 0.0);
    return exp(textureLod(u_mirror, at, 0.0) + 9.3 * beyond);
}

// In the bands, before the air.
vec4 sea_light(Ray ray, Ground ground, float depth_code)
{
    vec3 up = normalize(u_eye_up * u_eye.x + ray.direction * ground.distance_m);
    float sun_mu = dot(up, u_sun);
    float altitude =
        centre(clamp((ground.altitude_m - u_ground_light.x) / (u_ground_light.y - u_ground_light.x),
                     0.0, 1.0),
               u_ground_light.w);
    float lowest = sky_map_lowest_sun(u_planet.x, ground.altitude_m, u_disc.x, u_disc.y);
    float sun = sky_map_sunlight(sun_mu, lowest, u_ground_light.z);
    vec4 star = textureLod(u_sunlight, vec2(centre(sun, u_light_texel.x), altitude), 0.0);
    float day = sun_coordinate(sun_mu);
    vec4 sky = exp(textureLod(u_skylight, vec2(centre(day, u_light_texel.y), altitude), 0.0));
    float view_mu = clamp(-dot(up, ray.direction), 0.0, 1.0);
    vec4 mirrored = mirrored_sky(view_mu, sun_mu, ray.nu, day);
#ifdef ECLIPSE
    vec3 place = ray.direction * ground.distance_m;
    float left = star_left(place);
    vec4 sky_part = ground_left(place, left);
    star *= left;
    sky *= sky_part;
    mirrored *= sky_part;
#endif
    star *= ground.star_visible;
    float height = visible_height(sun_mu, u_disc.y);
    vec3 light = normalize(u_sun + up * (height - sun_mu));
    vec3 facet = normalize(light - ray.direction);
    float glint = sea_glint(dot(facet, up), dot(facet, light), view_mu, height, u_sea.x, u_sea.y);
    float seen = surface_reflectance(view_mu);
    vec4 below = star * (height * (1.0 - surface_reflectance(height))) +
                 sky * (1.0 - surface_reflectance(0.5));
    vec4 water = textureLod(u_water, vec2(centre(depth_code, u_sea_texel.z), 0.25), 0.0);
    vec4 clear = star * glint + mirrored * seen + water * below * ((1.0 - seen) / SHARED_PI);
    vec4 white = (star * height + sky) * (u_sea.w / SHARED_PI);
    return mix(clear, white, u_sea.z);
}

void main()
{
    Ray ray;
    Ground ground = find_ground(ray);
    ground.star_visible = mix(1.0, ground.star_visible, u_shadowed);
    vec4 light = sea_light(ray, ground, ground.depth_code) * ground.water;
    float row = aerial_row(ray);
    float way = clamp(ground.distance_m, ray.begin_m, max(ray.end_m * 1.2, ground.distance_m)) -
                ray.begin_m;
    vec2 at = vec2(extinction_map(air_depth(ray, ground.distance_m)), row);
    light *= exp(-textureLod(u_extinction, at, 0.0) * way);
    out_radiance = join_radiance(light, vec3(0.0));
}
