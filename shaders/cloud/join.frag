// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clouds of every second pixel over a whole picture, in two passes. FILTER joins each four, whose
// rays begin their steps at different places, into one between them; without it each pixel takes of
// the four around it. Both take those whose rays end about where their own does, so that no cloud
// behind a ridge hangs before it.
// validate: SURFACE
// validate: SURFACE; FILTER

#include "sky/ray.glsl"

in vec2 v_uv;

uniform sampler2D u_clouds;
#ifdef SURFACE
uniform sampler2D u_position; // xyz relative to the camera, m; w altitude, m, or below -1e8
#endif

layout(location = 0) out vec4 out_clouds;

const float SKY_M = 1.0e8;

float find_end(ivec2 pixel)
{
#ifdef SURFACE
    vec4 position = texelFetch(u_position, pixel, 0);
    return position.w > -1.0e8 ? length(position.xyz) : SKY_M;
#else
    return 1.0;
#endif
}

#ifdef FILTER
const int TAPS_AT = 0; // of the first two pixels
#else
const int TAPS_AT = 1;
#endif

void main()
{
    ivec2 last = textureSize(u_clouds, 0) - 1;
#ifdef FILTER
    ivec2 first = ivec2(gl_FragCoord.xy);
    ivec2 pixel = 2 * first + 1;
    vec2 part = vec2(0.5);
#else
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 first = (pixel + 1) / 2 - 1;
    vec2 part = vec2(pixel - 2 * first - 1) * 0.5;
#endif
#ifdef SURFACE
    ivec2 edge = textureSize(u_position, 0) - 1;
#else
    ivec2 edge = pixel;
#endif
    float own = log(find_end(min(pixel, edge)));
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int n = 0; n < 4; n++) {
        ivec2 offset = ivec2(n & 1, n >> 1);
        ivec2 at = clamp(first + offset, ivec2(0), last);
        vec2 near = mix(1.0 - part, part, vec2(offset));
        float apart = abs(log(find_end(min(2 * at + TAPS_AT, edge))) - own);
        // Alike within some per cent counts as one surface.
        float weight = (near.x * near.y + 1.0e-4) / (1.0 + 4.0e3 * apart * apart * apart);
        sum += texelFetch(u_clouds, at, 0) * weight;
        weights += weight;
    }
    out_clouds = sum / weights;
}
