// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels with ground: lit by the star alone, behind air that scatters once. With
// SURFACE the ground comes from the surface buffers, else it is the bare reference sphere. With SEA
// open water is drawn by sea.frag, and is black here.
// validate: CHANNEL_COUNT 2
// validate: CHANNEL_COUNT 0
// validate: CHANNEL_COUNT 4; SURFACE
// validate: CHANNEL_COUNT 2; SURFACE; SEA
// validate: CHANNEL_COUNT 2; SPHERE
// validate: CHANNEL_COUNT 2; SPHERE; INTEGRAL

#include "sky/ground.glsl"
#include "sky/single/colour.glsl"
#include "sky/single/near.glsl"
#ifdef INTEGRAL
#include "sky/single/vertex_light.glsl"
#endif

uniform vec4 u_ground_albedo; // in the bands, of the bare sphere

#ifdef SURFACE
uniform vec4 u_bands_from_rgb[3]; // columns
uniform vec4 u_bands_of_light[3]; // columns: bands that show lights of this colour
#endif

layout(location = 0) out vec4 out_radiance;

#ifdef SURFACE
vec4 to_bands(vec4 columns[3], vec3 rgb)
{
    return max(columns[0] * rgb.r + columns[1] * rgb.g + columns[2] * rgb.b, vec4(0.0));
}
#endif

// Eq. 10: Lambert's law in the attenuated light of the star.
vec4 light_ground(Ray ray, Ground ground)
{
    vec3 up = normalize(u_eye_up * u_eye.x + ray.direction * ground.distance_m);
    Point p;
    p.altitude_m = clamp(ground.altitude_m, 0.0, u_planet.y);
    p.place_m = 0.0;
    p.sun_mu = dot(up, u_sun);
    float height = visible_height(p.sun_mu, u_disc.y);
    float incidence = max(dot(ground.normal, u_sun + up * (height - p.sun_mu)), 0.0);
    vec4 reflected = star_light(p) * (incidence * ground.star_visible * (1.0 / SHARED_PI));
#ifdef SURFACE
#ifdef SEA
    reflected *= 1.0 - ground.water;
#endif
    return to_bands(u_bands_from_rgb, ground.albedo) * reflected +
           to_bands(u_bands_of_light, ground.lights);
#else
    return u_ground_albedo * reflected;
#endif
}

void main()
{
    Ray ray;
    Ground ground = find_ground(ray);
#ifdef INTEGRAL
    Air air = Air(vertex_light(phase_of(ray.nu)), v_transmittance);
#else
    Air air = air_before(ray, ground.distance_m, ground.altitude_m);
#endif
    out_radiance = join_light(light_ground(ray, ground) * air.transmittance, air.scattered);
}
