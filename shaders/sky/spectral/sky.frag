// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels without ground: the air in front of space, with STAR also the star's disc.
// With MOON a body stands for the star, and its light is added to what is there.
// validate: PEAKED_COUNT 1
// validate: PEAKED_COUNT 0; STAR
// validate: PEAKED_COUNT 3; STAR
// validate: PEAKED_COUNT 1; MARCH
// validate: PEAKED_COUNT 1; STAR; MARCH; ECLIPSE
// validate: PEAKED_COUNT 1; MOON

#include "sky/disc.glsl"
#include "sky/spectral/air.glsl"
#include "sky/spectral/colour.glsl"
#ifdef ECLIPSE
#include "sky/eclipse.glsl"
#endif

in vec2 v_uv;

layout(location = 0) out vec4 out_radiance;

void main()
{
    Ray ray = make_pixel_ray(v_uv);
    ray.meets_ground = false; // what sort.frag has found counts, in case of rounding
    ray.end_m = max(ray.begin_m, ray.chord_m - u_eye.x * ray.mu);
    vec4 bands = vec4(0.0);
#ifdef STAR
    float star = star_disc(ray);
#ifdef ECLIPSE
    // A covered star does not shine through edges that are softer than its rim is wide.
    star *= star_left(vec3(0.0)) > 0.0 ? 1.0 : 0.0;
    star = (star + corona(ray)) * body_leaves(ray);
#endif
    bands = vec4(star) * air_before(ray, ray.end_m).transmittance;
#endif
    vec3 light = sky_light(ray);
#ifdef MARCH
    light *= share_to_space(v_uv);
#endif
    out_radiance = join_radiance(bands, light);
}
