// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The air of the model `single`, by Schafhitzel 2007: light scattered once, looked up in a 3D table
// over altitude, star and view. Lengths in m. Light that the air adds is linear sRGB in cd m^-2,
// what it leaves of other light is in four bands.
#ifndef SKY_SINGLE_AIR_GLSL
#define SKY_SINGLE_AIR_GLSL

#include "shared/single_map.glsl"
#include "shared/sky_map.glsl"
#include "sky/ray.glsl"

uniform vec4 u_sun_grid;     // centre, width, first, last: see sky_map_sun
uniform vec4 u_texels;       // heights, suns, views, of these on the ground
uniform vec2 u_depth_texels; // views, heights

uniform sampler2D u_optical_depth; // optical depth to the top: views x heights
#if CHANNEL_COUNT > 0
uniform sampler2D u_phase;      // a column each: sine of half the scattering angle
uniform sampler3D u_scattered0; // views x suns x heights
#endif
#if CHANNEL_COUNT > 1
uniform sampler3D u_scattered1;
#endif
#if CHANNEL_COUNT > 2
uniform sampler3D u_scattered2;
#endif
#if CHANNEL_COUNT > 3
uniform sampler3D u_scattered3;
#endif

// From [0, 1] to the centres of the first and the last of `texels`.
float centre(float coordinate, float texels)
{
    return (coordinate * (texels - 1.0) + 0.5) / texels;
}

// The 1D table of the phase functions, one channel a component.
vec4 phase_of(float nu)
{
#if CHANNEL_COUNT > 0
    return textureLod(u_phase, vec2(centre(sqrt(max(0.5 - 0.5 * nu, 0.0)), 1024.0), 0.5), 0.0);
#else
    return vec4(0.0);
#endif
}

vec3 join_channels(vec3 at, vec4 phase)
{
    vec3 sum = vec3(0.0);
#if CHANNEL_COUNT > 0
    sum += textureLod(u_scattered0, at, 0.0).rgb * phase.x;
#endif
#if CHANNEL_COUNT > 1
    sum += textureLod(u_scattered1, at, 0.0).rgb * phase.y;
#endif
#if CHANNEL_COUNT > 2
    sum += textureLod(u_scattered2, at, 0.0).rgb * phase.z;
#endif
#if CHANNEL_COUNT > 3
    sum += textureLod(u_scattered3, at, 0.0).rgb * phase.w;
#endif
    return sum;
}

// A point of a ray inside the air. Places on the ray are counted from where it passes nearest to
// the planet's centre.
struct Point {
    float altitude_m;
    float place_m;
    float sun_mu; // cosine of the star's zenith angle
};

float ray_place(Ray ray)
{
    return u_eye.x * ray.mu;
}

// Where the ray enters the air: the eye, or from outside its outer boundary.
Point begin_of(Ray ray)
{
    bool outside = u_eye.w > 0.5;
    float radius = outside ? u_planet.x + u_planet.y : u_eye.x;
    Point p;
    p.altitude_m = outside ? u_planet.y : u_eye.y;
    p.place_m = outside ? -ray.chord_m : ray_place(ray);
    p.sun_mu = clamp((u_eye.x * u_eye.z + ray.begin_m * ray.nu) / radius, -1.0, 1.0);
    return p;
}

// Its end in space, as a place; that on the reference sphere is counted from the eye.
float way_to_end(Ray ray, Point p)
{
    float from_eye = max(p.place_m - ray_place(ray), 0.0);
    return max(ray.meets_ground ? ray.ground_m - from_eye : ray.chord_m - p.place_m, 0.0);
}

// The look-up: light from a point to the far end of its ray, as if there were no terrain.
vec3 scattered_beyond(Ray ray, Point p, vec4 phase)
{
    float horizon = single_horizon(p.altitude_m, u_planet.x);
    float way = way_to_end(ray, p);
    float ground_row = sky_map_ground_row(way, p.altitude_m, horizon) * (u_texels.w - 1.0);
    float sky_row = sky_map_view(way, u_planet.y - p.altitude_m, horizon + u_planet.z) *
                        (u_texels.z - u_texels.w - 1.0) +
                    u_texels.w;
    float row = ray.meets_ground ? ground_row : sky_row;
    float sun = sky_map_sun(p.sun_mu, u_sun_grid.x, u_sun_grid.y, u_sun_grid.z, u_sun_grid.w);
    vec3 at = vec3((row + 0.5) / u_texels.z, centre(sun, u_texels.y),
                   centre(single_height(horizon, u_planet.z), u_texels.x));
    // Rays that meet the ground have means over their way.
    return join_channels(at, phase) * (ray.meets_ground ? way : 1.0);
}

// Optical depth from a point to the top of the air, `way_m` from it on a ray that misses the
// ground.
vec4 depth_to_top(float altitude_m, float way_m)
{
    float horizon = single_horizon(altitude_m, u_planet.x);
    float view = sky_map_view(way_m, u_planet.y - altitude_m, horizon + u_planet.z);
    return textureLod(u_optical_depth,
                      vec2(centre(view, u_depth_texels.x),
                           centre(single_height(horizon, u_planet.z), u_depth_texels.y)),
                      0.0);
}

// From the eye to space.
vec4 transmittance_to_space(Ray ray)
{
    Point p = begin_of(ray);
    vec4 depth = depth_to_top(p.altitude_m, ray.chord_m - p.place_m);
    return ray.chord_m > 0.0 ? exp(-depth) : vec4(1.0);
}

// Between two points, as the difference of their depths to the top: backward where the ray falls,
// so that the way behind is the one that misses the ground. `whole` is the larger of the two.
vec4 depth_between(Ray ray, Point near, Point far, out vec4 whole)
{
    bool falls = ray.meets_ground || near.place_m + far.place_m < 0.0;
    float turn = falls ? 1.0 : -1.0;
    vec4 near_depth = depth_to_top(near.altitude_m, ray.chord_m + turn * near.place_m);
    vec4 far_depth = depth_to_top(far.altitude_m, ray.chord_m + turn * far.place_m);
    whole = falls ? far_depth : near_depth;
    return max((far_depth - near_depth) * turn, 0.0);
}

#endif // SKY_SINGLE_AIR_GLSL
