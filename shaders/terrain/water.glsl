// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Where open water is, by the masks, and how deep. Needs terrain/layers.glsl.
#if WATER_COUNT > 0
uniform vec4 u_water[4 * LAYER_VECTORS];
uniform vec4 u_water_modes;
uniform sampler2D u_water0;
#endif
#if WATER_COUNT > 1
uniform sampler2D u_water1;
#endif
#if WATER_COUNT > 2
uniform sampler2D u_water2;
#endif
#if WATER_COUNT > 3
uniform sampler2D u_water3;
#endif

// Of a mask the part that is water, where it tells depths the code of shared/sea.glsl, and log2 of
// a texel's height in m.
vec3 layer_over_mask(vec3 below, sampler2D mask, LayerFrame frame, float mode, Ground g,
                     float log2_footprint)
{
    vec3 at = layer_locate(frame, g);
    vec2 texel = layer_fetch(mask, frame, at.xy, log2_footprint - frame.texel.z).xy;
#ifdef HAS_MODES
    // What two masks make together is as deep as the deeper says.
    texel.y = mode > 0.5 ? max(texel.y, below.y) : texel.y;
    texel.x = min(blend_whole(mode, below.x, texel.x), 1.0);
#endif
    return mix(below, vec3(texel, frame.texel.z), at.z);
}

vec3 terrain_water(Ground g, float log2_footprint)
{
    vec3 w = vec3(0.0);
#if WATER_COUNT > 0
    w = layer_over_mask(w, u_water0, LAYER_FRAME(u_water, 0), u_water_modes.x, g, log2_footprint);
#endif
#if WATER_COUNT > 1
    w = layer_over_mask(w, u_water1, LAYER_FRAME(u_water, 1), u_water_modes.y, g, log2_footprint);
#endif
#if WATER_COUNT > 2
    w = layer_over_mask(w, u_water2, LAYER_FRAME(u_water, 2), u_water_modes.z, g, log2_footprint);
#endif
#if WATER_COUNT > 3
    w = layer_over_mask(w, u_water3, LAYER_FRAME(u_water, 3), u_water_modes.w, g, log2_footprint);
#endif
    return w;
}
