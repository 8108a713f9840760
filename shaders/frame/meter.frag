// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Light meter, first step: one texel looks at a cell of the picture through a regular grid of
// samples. In: radiance (RGBA32F, linear sRGB cd m^-2). Out: RG32F, sum of weights, weighted sum of
// log2 luminance.

#include "shared/meter.glsl"

uniform sampler2D u_radiance;
uniform vec2 u_cells;       // size of the target
uniform float u_wall_cd_m2; // luminance of a white wall that faces the star

layout(location = 0) out vec2 out_sums;

void main()
{
    vec2 size = vec2(textureSize(u_radiance, 0));
    vec2 corner = floor(gl_FragCoord.xy);
    vec2 sums = vec2(0.0);
    for (int y = 0; y < METER_SAMPLES; y++) {
        for (int x = 0; x < METER_SAMPLES; x++) {
            vec2 place = (corner + (vec2(x, y) + 0.5) / float(METER_SAMPLES)) / u_cells;
            vec3 rgb = texelFetch(u_radiance, ivec2(place * size), 0).rgb;
            float luminance = meter_counted(meter_luminance(rgb.r, rgb.g, rgb.b), u_wall_cd_m2);
            float weight = sqrt(luminance);
            sums += vec2(weight, weight * log2(max(luminance, 1.0e-30)));
        }
    }
    out_sums = sums;
}
