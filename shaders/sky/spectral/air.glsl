// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The air between the eye and what a pixel shows. Lengths in m. Light that the air adds is CIE 1931
// XYZ in cd m^-2; what it leaves of light behind it is in four bands.
#ifndef SKY_SPECTRAL_AIR_GLSL
#define SKY_SPECTRAL_AIR_GLSL

#include "shared/phase.glsl"
#include "shared/sky_map.glsl"
#include "sky/ray.glsl"

uniform vec4 u_rows;         // nearest, farthest, horizon mu, highest mu
uniform vec4 u_sun_grid;     // centre, width, first, last: see sky_map_sun
uniform vec3 u_slice_texel;  // 1 over azimuths, suns, views
uniform vec3 u_aerial_texel; // 1 over texels of u_scattered: see air_map
uniform vec3 u_aerial_rows;  // on the ground, in all; altitude below which air hides the ground, m

uniform sampler3D u_slice0;
uniform sampler3D u_scattered0;
uniform sampler2D u_extinction;
#if PEAKED_COUNT > 0
uniform sampler3D u_slice1;
uniform sampler3D u_scattered1;
#endif
#if PEAKED_COUNT > 1
uniform sampler3D u_slice2;
uniform sampler3D u_scattered2;
#endif
#if PEAKED_COUNT > 2
uniform sampler3D u_slice3;
uniform sampler3D u_scattered3;
#endif
#if PEAKED_COUNT > 0
uniform sampler2D u_phase; // sine of half the scattering angle x peaked constituent
#endif
#ifdef MARCH
uniform sampler3D u_share; // see sky/march.h
uniform vec2 u_march;      // farthest distance from where a ray's air begins; layers up to there
#endif

float azimuth_cosine(float mu, float sun_mu, float nu)
{
    float sines = sqrt(max((1.0 - mu * mu) * (1.0 - sun_mu * sun_mu), 1.0e-12));
    return clamp((nu - mu * sun_mu) / sines, -1.0, 1.0);
}

float sun_coordinate(float sun_mu)
{
    return sky_map_sun(sun_mu, u_sun_grid.x, u_sun_grid.y, u_sun_grid.z, u_sun_grid.w);
}

// From [0, 1] to the centres of the first and the last texel; `texel` is 1 over their number.
float centre(float coordinate, float texel)
{
    return coordinate + (0.5 - coordinate) * texel;
}

// Joins the channels: the first is stored without the Rayleigh phase function, the peaked ones
// without their own.
#if PEAKED_COUNT > 0
vec4 peaked_phase(float nu)
{
    return textureLod(u_phase, vec2(centre(sqrt(max(0.5 - 0.5 * nu, 0.0)), 1.0 / 1024.0), 0.5),
                      0.0);
}
#endif

vec3 join_slice(vec3 at, float nu)
{
    vec3 sum = exp(textureLod(u_slice0, at, 0.0).xyz) * phase_rayleigh(nu);
#if PEAKED_COUNT > 0
    vec4 phase = peaked_phase(nu);
    sum += exp(textureLod(u_slice1, at, 0.0).xyz) * phase.x;
#endif
#if PEAKED_COUNT > 1
    sum += exp(textureLod(u_slice2, at, 0.0).xyz) * phase.y;
#endif
#if PEAKED_COUNT > 2
    sum += exp(textureLod(u_slice3, at, 0.0).xyz) * phase.z;
#endif
    return sum;
}

vec3 join_scattered(vec3 at, float nu)
{
    vec3 sum = exp(textureLod(u_scattered0, at, 0.0).xyz) * phase_rayleigh(nu);
#if PEAKED_COUNT > 0
    vec4 phase = peaked_phase(nu);
    sum += exp(textureLod(u_scattered1, at, 0.0).xyz) * phase.x;
#endif
#if PEAKED_COUNT > 1
    sum += exp(textureLod(u_scattered2, at, 0.0).xyz) * phase.y;
#endif
#if PEAKED_COUNT > 2
    sum += exp(textureLod(u_scattered3, at, 0.0).xyz) * phase.z;
#endif
    return sum;
}

// How much of the light of the air is left by what stands before the star, of XYZ: up to a
// distance, and of the whole way into space.
#ifdef MARCH
vec3 share_before(vec2 uv, Ray ray, float distance_m)
{
    float place = sky_map_depth(distance_m - ray.begin_m, 0.0, u_march.x) * u_march.y;
    return textureLod(u_share,
                      vec3(uv, clamp(place - 0.5, 0.5, u_march.y - 0.5) / (u_march.y + 1.0)), 0.0)
        .xyz;
}

vec3 share_to_space(vec2 uv)
{
    return textureLod(u_share, vec3(uv, 1.0), 0.0).xyz;
}
#endif

// Light of the whole way through the air of a ray that ends in space. From outside the eye stands
// where the ray enters (Elek 2010 Section 5).
vec3 sky_light(Ray ray)
{
    bool outside = u_eye.w > 0.5;
    float top = u_planet.x + u_planet.y;
    float rise = sqrt(max(u_eye.y * (2.0 * u_planet.x + u_eye.y), 0.0));
    float mu = outside ? -ray.chord_m / top : ray.mu;
    float sun_mu =
        outside ? clamp((u_eye.x * u_eye.z + ray.begin_m * ray.nu) / top, -1.0, 1.0) : u_eye.z;
    float way = outside ? 2.0 * ray.chord_m : ray.chord_m - u_eye.x * ray.mu;
    float shortest = outside ? 0.0 : u_planet.y - u_eye.y;
    float longest = (outside ? u_planet.z : rise) + u_planet.z;
    float view = sky_map_view(way, shortest, longest);
    // Inside, the slice has one sun.
    float sun = outside ? sun_coordinate(sun_mu) : 0.0;
    vec3 at = vec3(centre(sky_map_azimuth(azimuth_cosine(mu, sun_mu, ray.nu)), u_slice_texel.x),
                   centre(sun, u_slice_texel.y), centre(view, u_slice_texel.z));
    // Lower suns than the lowest of the table: light goes on to fall, by a factor e for some 0.15
    // dips of the horizon.
    float beyond =
        outside ? min(sky_map_asinh((sun_mu - u_sun_grid.x) / u_sun_grid.y) - u_sun_grid.z, 0.0)
                : 0.0;
    return ray.chord_m > 0.0 ? join_slice(at, ray.nu) * exp(9.3 * beyond) : vec3(0.0);
}

// The row of a ray in the maps of aerial perspective, as a texture coordinate.
float aerial_row(Ray ray)
{
    float ground = u_eye.w > 0.5 ? sky_map_ground_row_outside(ray.ground_m, u_rows.x, u_rows.y)
                                 : sky_map_ground_row(ray.ground_m, u_rows.x, u_rows.y);
    float row = ray.meets_ground ? ground * (u_aerial_rows.x - 1.0)
                                 : u_aerial_rows.x + sky_map_air_row(ray.mu, u_rows.z, u_rows.w) *
                                                         (u_aerial_rows.y - u_aerial_rows.x - 1.0);
    return (row + 0.5) * u_aerial_texel.z;
}

// Its azimuth there, in [0, 1].
float aerial_azimuth(Ray ray)
{
    float cosine = azimuth_cosine(ray.mu, u_eye.z, ray.nu);
    float along = -u_eye.x * ray.mu;
    float place = ray.meets_ground ? u_planet.x : u_eye.x * sqrt(max(1.0 - ray.mu * ray.mu, 0.0));
    SkyMapSuns suns =
        sky_map_suns(u_eye.x, ray.meets_ground ? ray.ground_m : along, place, ray.mu, u_eye.z);
    float lowest = sun_coordinate(suns.middle - suns.reach);
    float highest = sun_coordinate(suns.middle + suns.reach);
    float here = sun_coordinate(suns.middle + suns.reach * cosine);
    return u_eye.w > 0.5 ? clamp((here - lowest) / max(highest - lowest, 1.0e-6), 0.0, 1.0)
                         : sky_map_azimuth(cosine);
}

// A distance's place on its ray, in [0, 1]. From outside air is dense where it hides the ground, or
// at the ground, or where rays pass closest; see find_dense in scatter/aerial.c.
float air_depth(Ray ray, float distance_m)
{
    float opaque_m = u_aerial_rows.z;
    float inside_m2 = ray.inside_m2 + opaque_m * (2.0 * u_planet.x + opaque_m);
    float dense_m = ray.begin_m + ray.chord_m - sqrt(max(inside_m2, 0.0));
    float before = ray.meets_ground && opaque_m == 0.0 ? 1.0 : 0.5;
    return u_eye.w > 0.5
               ? sky_map_depth_outside(distance_m, ray.begin_m, dense_m, ray.end_m, before)
               : sky_map_depth(distance_m, ray.begin_m, ray.end_m);
}

// The places of u_scattered: depth x azimuth x row, from outside azimuth x depth x row.
vec3 air_map(float depth, float azimuth, float row)
{
    vec2 at = u_eye.w > 0.5 ? vec2(azimuth, depth) : vec2(depth, azimuth);
    return vec3(centre(at.x, u_aerial_texel.x), centre(at.y, u_aerial_texel.y), row);
}

// Of u_extinction: depth x row, from outside in the first of its columns.
float extinction_map(float depth)
{
    float columns = u_eye.w > 0.5 ? u_aerial_texel.x / u_aerial_texel.y : 1.0;
    return mix(0.5 * u_aerial_texel.x, columns - 0.5 * u_aerial_texel.x, depth);
}

struct Air {
    vec3 scattered;     // XYZ that the air adds
    vec2 at;            // place in the maps of bands
    float way;          // m
    vec4 transmittance; // what it leaves of the light behind it, in the bands
};

// The air between the eye and a point at `distance_m` on the ray.
Air air_before(Ray ray, float distance_m)
{
    float depth = air_depth(ray, distance_m);
    vec3 at = air_map(depth, aerial_azimuth(ray), aerial_row(ray));
    float way = clamp(distance_m, ray.begin_m, max(ray.end_m * 1.2, distance_m)) - ray.begin_m;
    Air air;
    air.scattered = join_scattered(at, ray.nu) * way;
    air.at = vec2(extinction_map(depth), at.z);
    air.way = way;
    air.transmittance = exp(-textureLod(u_extinction, air.at, 0.0) * way);
    return air;
}

#endif // SKY_SPECTRAL_AIR_GLSL
