// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Colours of made-up ground. The C side is src/terrain/biomes.c.
#include "shared/biome.glsl"

uniform int u_biome_count;
// Of each biome: linear albedo and its variation; ranges of altitude in m, slope as a tangent,
// latitude and temperature in degrees: ends, feathers; the same of moisture.
uniform vec4 u_biome_albedo[16];
uniform vec4 u_biome_low[16];
uniform vec4 u_biome_high[16];
uniform vec4 u_biome_feather[16];
uniform vec4 u_biome_moisture[16]; // low, high, feather
uniform vec4 u_biome_climate;      // degrees at the equator, at the poles, lost per m of altitude

struct BiomePlace {
    vec4 place; // altitude, slope, latitude, without sign, and temperature
    float moisture, tone;
    // Deviations of the slopes, and of the heights in m, that are too small to be seen.
    float slope_spread, height_spread;
};

BiomePlace biome_place(float altitude, float slope, float latitude, float moisture)
{
    float mean = biome_temperature(u_biome_climate.x, u_biome_climate.y, sin(latitude));
    return BiomePlace(vec4(altitude, slope, degrees(abs(latitude)),
                           mean - u_biome_climate.z * max(altitude, 0.0)),
                      moisture, 0.0, 0.0, 0.0);
}

// Linear albedo; later biomes lie over earlier ones.
vec3 biome_albedo(vec3 below, BiomePlace p)
{
    vec3 c = below;
    int i = 0;
    do {
        vec4 low = u_biome_low[i];
        vec4 high = u_biome_high[i];
        vec4 moist = u_biome_moisture[i];
        vec4 x = p.place + 0.5 * p.tone * u_biome_feather[i]; // biome_fray
        vec4 feather = u_biome_feather[i];
        // A beach stays one, and the sea where it is.
        feather.x += 2.0 * min(p.height_spread, max(high.x, 0.0));
        feather.y += 2.0 * p.slope_spread;
        feather.w += 2.0 * u_biome_climate.z * p.height_spread;
        float part = biome_within(x.x, low.x, high.x, feather.x);
        part *= biome_within(x.y, low.y, high.y, feather.y);
        part *= biome_within(x.z, low.z, high.z, feather.z);
        part *= biome_within(x.w, low.w, high.w, feather.w);
        part *= biome_within(biome_fray(p.moisture, moist.z, p.tone), moist.x, moist.y, moist.z);
        c = mix(c, u_biome_albedo[i].rgb * max(1.0 + u_biome_albedo[i].a * p.tone, 0.3), part);
        i++;
    } while (i < u_biome_count);
    return c;
}
