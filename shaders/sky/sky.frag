// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels without ground: the air in front of space, with STAR also the star's disc.
// validate: PEAKED_COUNT 1
// validate: PEAKED_COUNT 0; STAR
// validate: PEAKED_COUNT 3; STAR

#include "sky/air.glsl"
#include "sky/colour.glsl"

in vec2 v_uv;

#ifdef STAR
uniform vec4 u_disc; // cosine and sine of the angular radius, pixel angle
#endif

layout(location = 0) out vec4 out_radiance;

#ifdef STAR
// Limb darkening of a grey atmosphere in radiative equilibrium (Eddington): (2 + 3 cos) / 5, here
// relative to its mean over the disc, 4/5.
vec4 star_disc(Ray ray)
{
    float from_centre = length(cross(ray.direction, u_sun)) / u_disc.y;
    float edge = u_disc.z / u_disc.y;
    float inside = ray.nu > 0.0 ? clamp((1.0 - from_centre) / edge + 0.5, 0.0, 1.0) : 0.0;
    float cosine = sqrt(max(1.0 - from_centre * from_centre, 0.0));
    float radiance = inside * (0.5 + 0.75 * cosine) / (SHARED_PI * u_disc.y * u_disc.y);
    return radiance * air_before(ray, ray.end_m).transmittance;
}
#endif

void main()
{
    Ray ray = make_pixel_ray(v_uv);
    ray.meets_ground = false; // what sort.frag has found counts, in case of rounding
    ray.end_m = max(ray.begin_m, ray.chord_m - u_eye.x * ray.mu);
    vec4 bands = vec4(0.0);
#ifdef STAR
    bands = star_disc(ray);
#endif
    out_radiance = join_radiance(bands, sky_light(ray));
}
