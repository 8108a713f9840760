// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A vertex of a sphere around the planet, as the paper draws air and ground. With INTEGRAL the air
// before it is integrated here, in u_steps equal steps, instead of looked up per pixel: what the
// paper's Table 2 compares with. The star is in the plane of ray and zenith, as in the table.
// validate: CHANNEL_COUNT 2; SPHERE
// validate: CHANNEL_COUNT 2; SPHERE; INTEGRAL
// validate: CHANNEL_COUNT 0; SPHERE; INTEGRAL

#include "sky/single/near.glsl"

layout(location = 0) in vec3 a_direction; // unit, planet frame

uniform float u_sphere_m; // radius
uniform vec3 u_eye_m;     // from the planet's centre

out vec3 v_position;
#ifdef INTEGRAL
uniform int u_steps;
out vec4 v_transmittance;
#if CHANNEL_COUNT > 0
out vec4 v_added[CHANNEL_COUNT]; // bands, without the phase functions
#endif

void integrate(Ray ray)
{
    Point eye = begin_of(ray);
    float mu = eye.place_m / (u_planet.x + eye.altitude_m);
    ray.nu =
        mu * eye.sun_mu + sqrt(max(1.0 - mu * mu, 0.0) * max(1.0 - eye.sun_mu * eye.sun_mu, 0.0));
    float step_m = (ray.end_m - ray.begin_m) / float(u_steps);
    vec4 depth = vec4(0.0);
#if CHANNEL_COUNT > 0
    for (int c = 0; c < CHANNEL_COUNT; c++) {
        v_added[c] = vec4(0.0);
    }
#endif
    for (int k = 0; k < u_steps; k++) {
        Point p = advance(ray, eye, (float(k) + 0.5) * step_m);
        vec4 extinction = medium_at(p.altitude_m, 0) * step_m;
#if CHANNEL_COUNT > 0
        vec4 light = star_light(p) * exp(-depth - 0.5 * extinction) * step_m;
        for (int c = 0; c < CHANNEL_COUNT; c++) {
            v_added[c] += light * medium_at(p.altitude_m, 1 + c);
        }
#endif
        depth += extinction;
    }
    v_transmittance = exp(-depth);
}
#endif

void main()
{
    v_position = a_direction * u_sphere_m - u_eye_m;
    float along = dot(v_position, u_forward);
    // No depth: the ground is drawn over the far half of the air.
    gl_Position = vec4(dot(v_position, u_right) / dot(u_right, u_right),
                       dot(v_position, u_up) / dot(u_up, u_up), 0.5 * along, along);
#ifdef INTEGRAL
    integrate(make_ray(normalize(v_position)));
#endif
}
