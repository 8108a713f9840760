// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels with ground: lit by the star alone, behind air. With SURFACE the ground comes
// from the surface buffers, else it is the bare reference sphere. With SEA open water is drawn by
// sea.frag, and is black here.
// validate: SAMPLES 5; WAVELENGTHS 10
// validate: SAMPLES 5; WAVELENGTHS 10; FIT_HEIGHTS 10; SURFACE
// validate: SAMPLES 5; WAVELENGTHS 10; SIMPLE; SURFACE
// validate: SAMPLES 5; WAVELENGTHS 10; SURFACE; SEA

#include "sky/ground.glsl"
#include "sky/rayleigh/air.glsl"

#ifdef SURFACE
uniform vec3 u_night_light; // cd m^-2 of white lights, over the colour of the star's light
#endif

layout(location = 0) out vec4 out_radiance;

// How much of the star's light falls on the ground, without air: the visible part of the disc at
// its mean height.
float ground_share(Ground ground, vec3 up, float sun_mu)
{
    float radius = u_planet.x + ground.altitude_m;
    float rise = max(ground.altitude_m * (u_planet.x + radius), 0.0);
    float horizon_mu = -sqrt(rise) / radius;
    float height = visible_height(sun_mu, u_disc.y);
    float incidence = max(dot(ground.normal, u_sun + up * (height - sun_mu)), 0.0);
    return incidence * ground.star_visible * rayleigh_visible((sun_mu - horizon_mu) / u_disc.y);
}

void main()
{
    Ray ray;
    Ground ground = find_ground(ray);
    Sight sight = make_sight(ray, ground.distance_m - ray.begin_m);
    float view = find_between(sight, sight.eye, find_point(sight, sight.line.end));
    vec3 up = normalize(u_eye_up * u_eye.x + ray.direction * ground.distance_m);
    float sun_mu = dot(up, u_sun);
    float star = star_column(ground.altitude_m, sun_mu * (u_planet.x + ground.altitude_m));
    float share = ground_share(ground, up, sun_mu) / SHARED_PI;
    vec3 light = air_light(sight);
#ifdef SEA
    share *= 1.0 - ground.water;
#endif
#ifdef SURFACE
    light += max(star_through(view + star), vec3(0.0)) * ground.albedo * share;
    light += max(star_through(view), vec3(0.0)) * u_night_light * ground.lights;
#else
    for (int k = 0; k < WAVELENGTHS; k++) {
        light +=
            u_spectrum[k].rgb * (u_matter[k].y * share * exp(-u_spectrum[k].w * (view + star)));
    }
#endif
    out_radiance = vec4(light, 1.0);
}
