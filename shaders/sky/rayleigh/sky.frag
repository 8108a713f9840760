// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels without ground: the air in front of space, with STAR also the star's disc.
// validate: SAMPLES 5; WAVELENGTHS 10
// validate: SAMPLES 5; WAVELENGTHS 10; FIT_HEIGHTS 10; STAR
// validate: SAMPLES 65; WAVELENGTHS 40; FIT_HEIGHTS 32
// validate: SAMPLES 5; WAVELENGTHS 10; SIMPLE

#include "sky/disc.glsl"
#include "sky/rayleigh/air.glsl"

in vec2 v_uv;

layout(location = 0) out vec4 out_radiance;

void main()
{
    Ray ray = make_pixel_ray(v_uv);
    float end_m =
        max(ray.begin_m, ray.chord_m - u_eye.x * ray.mu); // whether or not it meets ground
    Sight sight = make_sight(ray, end_m - ray.begin_m);
    vec3 light = ray.chord_m > 0.0 ? air_light(sight) : vec3(0.0);
#ifdef STAR
    float column = find_between(sight, sight.eye, find_point(sight, sight.line.end));
    light += star_disc(ray) * star_through(ray.chord_m > 0.0 ? column : 0.0);
#endif
    out_radiance = vec4(light, 1.0);
}
