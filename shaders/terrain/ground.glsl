// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Heights of layers and noise together: part of terrain/layers.glsl.
#include "terrain/noise.glsl"

// The inverse of geo_from_local on the sphere; small offsets keep all their digits.
vec3 ground_local(vec2 geo)
{
    vec2 versine = 2.0 * sin(0.5 * geo) * sin(0.5 * geo);
    float cos_latitude = u_anchor.y * (1.0 - versine.y) - u_anchor.x * sin(geo.y);
    return vec3(cos_latitude * sin(geo.x), sin(geo.y) + cos_latitude * u_anchor.x * versine.x,
                -versine.y - cos_latitude * u_anchor.y * versine.x);
}

// Part of the octaves that lakes leave, whose depth is not known; the sea has none at its level.
float ground_dry(Tangent t)
{
#if defined(HAS_DEPTH) && !defined(HAS_PAGES)
    vec3 water = terrain_water(t.ground, t.log2_footprint);
    return shore_dry(water.y > 0.5 / 255.0 ? 0.0 : water.x);
#else
    return 1.0;
#endif
}

// `quad_footprint`: one for 2 x 2 pixels; `known_height`: of the data, where they are the ground.
NoiseBase ground_base(Tangent t, float quad_footprint, float known_height)
{
    NoiseGround g = noise_ground(t.ground.geo, t.cos_latitude, quad_footprint);
    vec4 below = vec4(g.slope.x * t.east + g.slope.y * t.north, SLOPE_NO_DATA);
    ReliefData data;
    vec4 slope = layers_slope(below, g.map.x, t, data);
    NoiseBase b;
#ifdef HAS_GROUND
    b.height = layers_altitude(g.map.x - u_datum, t.ground, quad_footprint);
#else
    b.height = known_height;
#endif
    b.slope = slope.xyz;
    float dry = ground_dry(t);
    b.spread = dry * (g.spread.x * t.east + g.spread.y * t.north);
    b.view = NoiseView(t.log2_footprint, slope.w, data, g.map.y * dry, g.map.z, g.map.w);
    return b;
}

float ground_altitude(Tangent t, vec3 at, float known_height)
{
    NoiseBase b = ground_base(t, t.log2_footprint, known_height);
    return max(noise_compose(b, at * u_anchor.w, t.up).height, u_noise_form.w - u_datum);
}

float terrain_altitude(vec2 geo, float log2_footprint)
{
    vec3 at = ground_local(geo);
    Tangent t = tangent_at(at, geo, log2_footprint);
#ifdef HAS_GROUND
    return ground_altitude(t, at, 0.0);
#else
    return ground_altitude(t, at, layers_altitude(-u_datum, t.ground, log2_footprint));
#endif
}

// The same, cheaper where it can be: linear between the texels of data.
float terrain_altitude_linear(vec2 geo, float log2_footprint)
{
    vec3 at = ground_local(geo);
    Tangent t = tangent_at(at, geo, log2_footprint);
#ifdef HAS_GROUND
    return ground_altitude(t, at, 0.0);
#else
    return ground_altitude(t, at, layers_altitude_linear(-u_datum, t.ground, log2_footprint));
#endif
}
