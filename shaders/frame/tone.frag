// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// From radiance to the picture. In: radiance (RGBA32F, linear sRGB cd m^-2), exposure (RG32F, one
// texel). Out: RGBA8, sRGB codes, dithered. TONE_IS_EXPONENTIAL chooses the other curve.
// validate:
// validate: TONE_IS_EXPONENTIAL

#include "shared/tone.glsl"

uniform sampler2D u_radiance;
uniform sampler2D u_exposure;

layout(location = 0) out vec4 out_picture;

// Colours that the primaries cannot show are mixed with grey of their own luminance, just so much
// that no component is negative: hue stays, and nothing turns black. Without luminance there is
// nothing to show.
vec3 fit_gamut(vec3 rgb)
{
    float luminance = max(dot(rgb, vec3(0.2126, 0.7152, 0.0722)), 0.0);
    float lowest = min(min(rgb.r, rgb.g), rgb.b);
    float keep = lowest < 0.0 ? luminance / (luminance - lowest) : 1.0;
    return max(luminance + (rgb - luminance) * keep, vec3(0.0));
}

#ifdef TONE_IS_EXPONENTIAL
vec3 map_tone(vec3 rgb)
{
    return vec3(tone_exponential(rgb.r), tone_exponential(rgb.g), tone_exponential(rgb.b));
}
#else
// The curve works on the largest component and the ratios stay, so that a highlight keeps its hue
// instead of drifting to the primaries; far above saturation it bleaches to white.
vec3 map_tone(vec3 rgb)
{
    float norm = max(max(max(rgb.r, rgb.g), rgb.b), 1.0e-12);
    return tone_filmic(norm) * mix(rgb / norm, vec3(1.0), tone_bleach(norm));
}
#endif

// Uniform in [0, 1), evenly spread over any neighbourhood. Wraps as unsigned integers do.
float spread_noise(uvec2 pixel)
{
    uint bits = pixel.x * TONE_NOISE_X + pixel.y * TONE_NOISE_Y;
    return float(bits >> 8) / 16777216.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float scale = texelFetch(u_exposure, ivec2(0), 0).g;
    vec3 tone = map_tone(fit_gamut(texelFetch(u_radiance, pixel, 0).rgb * scale));
    vec3 code = vec3(tone_srgb_encode(tone.r), tone_srgb_encode(tone.g), tone_srgb_encode(tone.b));
    // Rounding makes floor(255 code + noise) of this: the mean is kept also at black and at white.
    vec3 dithered = code + (spread_noise(uvec2(pixel)) - 0.5) / 255.0;
    out_picture = vec4(clamp(dithered, 0.0, 1.0), 1.0);
}
