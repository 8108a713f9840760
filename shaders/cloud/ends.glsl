// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Where rays end for clouds, of any pixel: what tells which of them may stand for one another.
#ifndef CLOUD_ENDS_GLSL
#define CLOUD_ENDS_GLSL

#include "cloud/parts.glsl"
#include "shared/cloud.glsl"

uniform vec2 u_picture; // pixels
#ifdef SURFACE
uniform sampler2D u_position; // xyz relative to the camera, m; w altitude, m, or below -1e8
#endif

// Logarithm of ray_end of a pixel, or of the nearest one of the picture.
float find_end(ivec2 pixel)
{
    ivec2 at = min(pixel, ivec2(u_picture) - 1);
    float end = SKY_M;
#ifdef SURFACE
    vec4 position = texelFetch(u_position, at, 0);
    if (position.w > -1.0e8) {
        float distance_m = length(position.xyz);
        end = ray_end(make_ray(position.xyz / max(distance_m, 1.0e-6)), distance_m);
    }
#else
    Ray ray = make_pixel_ray((vec2(at) + 0.5) / u_picture);
    if (ray.meets_ground) {
        end = ray_end(ray, ray.ground_m);
    }
#endif
    return log(end);
}

#endif // CLOUD_ENDS_GLSL
