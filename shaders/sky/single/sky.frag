// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels without ground: the air in front of space, with STAR also the star's disc.
// validate: CHANNEL_COUNT 2
// validate: CHANNEL_COUNT 0; STAR
// validate: CHANNEL_COUNT 4; STAR
// validate: CHANNEL_COUNT 2; SPHERE
// validate: CHANNEL_COUNT 2; SPHERE; INTEGRAL

#include "sky/disc.glsl"
#include "sky/fragment.glsl"
#include "sky/single/air.glsl"
#include "sky/single/colour.glsl"
#ifdef INTEGRAL
#include "sky/single/vertex_light.glsl"
#endif

layout(location = 0) out vec4 out_radiance;

void main()
{
    Ray ray = fragment_ray();
    ray.meets_ground = false; // what sort.frag has found counts, in case of rounding
#ifdef INTEGRAL
    vec3 added = vertex_light(phase_of(ray.nu));
#else
    vec3 added = scattered_beyond(ray, begin_of(ray), phase_of(ray.nu));
#endif
    vec4 sent = vec4(0.0);
#ifdef STAR
    sent = star_disc(ray) * transmittance_to_space(ray);
#endif
    out_radiance = join_light(sent, ray.chord_m > 0.0 ? added : vec3(0.0));
}
