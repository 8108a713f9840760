// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels without ground: the air in front of space, with STAR also the star's disc.
// validate: CHANNEL_COUNT 2
// validate: CHANNEL_COUNT 0; STAR
// validate: CHANNEL_COUNT 4; STAR

#include "sky/disc.glsl"
#include "sky/single/air.glsl"

uniform vec4 u_rgb_from_bands[3]; // rows

in vec2 v_uv;

layout(location = 0) out vec4 out_radiance;

void main()
{
    Ray ray = make_pixel_ray(v_uv);
    ray.meets_ground = false; // what sort.frag has found counts, in case of rounding
    vec4 bands = scattered_beyond(ray, begin_of(ray), phase_of(ray.nu));
    bands *= ray.chord_m > 0.0 ? 1.0 : 0.0;
#ifdef STAR
    bands += star_disc(ray) * transmittance_to_space(ray);
#endif
    out_radiance = vec4(dot(u_rgb_from_bands[0], bands), dot(u_rgb_from_bands[1], bands),
                        dot(u_rgb_from_bands[2], bands), 1.0);
}
