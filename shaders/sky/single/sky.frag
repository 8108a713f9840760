// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels without ground: the air in front of space, with STAR also the star's disc.
// validate: CHANNEL_COUNT 2
// validate: CHANNEL_COUNT 0; STAR
// validate: CHANNEL_COUNT 4; STAR

#include "sky/disc.glsl"
#include "sky/single/air.glsl"
#include "sky/single/colour.glsl"

in vec2 v_uv;

layout(location = 0) out vec4 out_radiance;

void main()
{
    Ray ray = make_pixel_ray(v_uv);
    ray.meets_ground = false; // what sort.frag has found counts, in case of rounding
    vec3 added = scattered_beyond(ray, begin_of(ray), phase_of(ray.nu));
    vec4 sent = vec4(0.0);
#ifdef STAR
    sent = star_disc(ray) * transmittance_to_space(ray);
#endif
    out_radiance = join_light(sent, ray.chord_m > 0.0 ? added : vec3(0.0));
}
