// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Made-up slopes and brightness below the resolution of the data. The C side is
// src/terrain/detail.c, which has the noise.

uniform lowp sampler3D u_detail_noise; // gradient and value, -1 to 1 as 0 to 1
uniform mat3 u_detail_from_local;
// The camera in the tile, 1 / the tile's side in m; descending sides.
uniform vec4 u_detail_sizes[6];
// Number of sizes, roughness, variation of albedo, log2 of the smallest footprint in m.
uniform vec4 u_detail;

// The texture's gradients have a quarter of the deviation that is wanted: 1 for each size.
const float DETAIL_GRADIENT = 4.0;
// Tiles.
const float DETAIL_WARP = 0.3;

// xyz: gradient along local axes; w: brightness. `at`: relative to the camera, local axes.
vec4 detail_noise(vec3 at, float log2_footprint, float log2_data)
{
    vec3 q = u_detail_from_local * at;
    vec4 sum = vec4(0.0);
    vec4 larger = vec4(0.0);
    // From the largest down, and no further than a pixel shows.
    for (int i = 0; i < int(u_detail.x); i++) {
        vec4 size = u_detail_sizes[i];
        float log2_texel = -log2(size.w) - 6.0; // 64 to a tile
        float lod = max(log2_footprint, u_detail.w) - log2_texel;
        // The longest wavelength is 32 texels: gone at level 5, and where data show it.
        float seen = 1.0 - smoothstep(3.0, 5.0, lod);
        float made = 1.0 - smoothstep(0.0, 2.0, log2_texel + 5.0 - log2_data - 1.0);
        if (lod > 5.0) {
            break;
        }
        vec4 n = 2.0 * textureLod(u_detail_noise, q * size.w + size.xyz + DETAIL_WARP * larger.xyz,
                                  max(lod, 0.0)) -
                 1.0;
        // Each size bends the next and makes it strong or weak, so that no tile looks like another.
        sum += seen * made * max(1.0 + 2.0 * larger.w, 0.0) * n;
        larger = n;
    }
    return vec4(DETAIL_GRADIENT * sum.xyz * u_detail_from_local, sum.w);
}

// Slope of the noise: small on even ground, else as part of the data's slope. That of natural
// ground grows with the -0.2nd to -0.3rd power of the scale, so coarse data lack more of it than
// fine ones.
float detail_slope(float data_slope, float log2_data)
{
    return u_detail.y * (0.03 + data_slope * exp2(0.2 * log2_data - 1.6));
}

// Square root of the albedo. Snow and soil slide off what is steeper than their angle of repose,
// and leave rock: greyer, and no brighter than a fifth.
vec3 detail_albedo(vec3 root, float brightness, float slope)
{
    vec3 c = root * root;
    float luminance = dot(c, vec3(0.2126, 0.7152, 0.0722));
    vec3 rock = 0.8 * mix(c, vec3(luminance), 0.5) * min(1.0, 0.2 / max(luminance, 1e-3));
    float snow = smoothstep(0.3, 0.6, luminance); // even, where it lies
    c = mix(c, rock, smoothstep(0.6, 1.1, slope));
    return sqrt(clamp(c * (1.0 + u_detail.z * (1.0 - 0.8 * snow) * brightness), 0.0, 1.0));
}
