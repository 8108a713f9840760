// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The rasters of the surface at a place, which is given as an offset from the anchor: `geo` is the
// difference in longitude and latitude, in radians. Needs ELEVATION_COUNT, COLOUR_COUNT,
// WATER_COUNT, LIGHTS_COUNT (0 to 4); NO_FLOAT_LINEAR where 32F textures are not filtered. The C
// side is src/terrain/bind.c.
#include "shared/cubic.glsl"

uniform vec4 u_anchor; // sine, cosine of its latitude, the latitude, the sphere's radius in m

// Of each layer: place = offset of the anchor from the raster's middle (longitude, latitude), and
// 1 / extent; shape = how far it reaches from the middle (sideways, north, south; 9 is endless),
// 1 / feather; texel = height's scale (see below), a texel's height in radians, log2 of that in m,
// offset. Heights are scale times what a texture holds plus the offset, in m.
#if ELEVATION_COUNT > 0
uniform vec4 u_elevation_place[4];
uniform vec4 u_elevation_shape[4];
uniform vec4 u_elevation_texel[4];
uniform sampler2D u_elevation0;
#endif
#if ELEVATION_COUNT > 1
uniform sampler2D u_elevation1;
#endif
#if ELEVATION_COUNT > 2
uniform sampler2D u_elevation2;
#endif
#if ELEVATION_COUNT > 3
uniform sampler2D u_elevation3;
#endif

const float LAYER_PI = 3.14159265358979;

// Longitude and latitude of a direction, less the anchor's. `o` is (direction - anchor's direction)
// in the anchor's frame, times any length if `size` is that length; small o keep all their digits.
vec2 geo_from_local(vec3 o, float size)
{
    float up = size + o.z;
    float inward = up * u_anchor.y - o.y * u_anchor.x; // from the axis, in the anchor's meridian
    float axis_distance = length(vec2(inward, o.x));
    float versine = inward > 0.0 ? o.x * o.x / (axis_distance + inward) : axis_distance - inward;
    float along = up * u_anchor.x + o.y * u_anchor.y; // the axis
    return vec2(atan(o.x, inward),
                atan(o.y - versine * u_anchor.x, along * u_anchor.x + axis_distance * u_anchor.y));
}

// A place stepped over a pole comes down the opposite meridian.
vec2 geo_over_pole(vec2 geo)
{
    float latitude = u_anchor.z + geo.y;
    float past = abs(latitude) - 0.5 * LAYER_PI;
    return past > 0.0 ? vec2(geo.x + LAYER_PI, geo.y - 2.0 * sign(latitude) * past) : geo;
}

// Texture coordinates (x, y) and the layer's weight (z).
vec3 layer_locate(vec4 place, vec4 shape, vec2 geo)
{
    float east = place.x + geo.x;
    east -= 2.0 * LAYER_PI * floor(east / (2.0 * LAYER_PI) + 0.5);
    float north = place.y + geo.y;
    float inside = min(shape.x - abs(east), min(shape.y - north, shape.z + north));
    float t = clamp(inside * shape.w, 0.0, 1.0);
    return vec3(0.5 + east * place.z, 0.5 - north * place.w, t * t * (3.0 - 2.0 * t));
}

// textureSize(heights, level), which llvmpipe answers for one level for all pixels of a vector.
ivec2 layer_size(sampler2D heights, int level)
{
    return max(textureSize(heights, 0) >> level, ivec2(1));
}

float layer_texel(sampler2D heights, vec4 shape, ivec2 p, int level)
{
    ivec2 size = layer_size(heights, level);
    bool is_round = shape.x > 4.0;
    if (is_round && ((p.y < 0 && shape.y > 4.0) || (p.y >= size.y && shape.z > 4.0))) {
        p.y = p.y < 0 ? -1 - p.y : 2 * size.y - 1 - p.y;
        p.x += size.x / 2;
    }
    if (is_round) {
        p.x += p.x < 0 ? size.x : 0;
        p.x -= p.x >= size.x ? size.x : 0;
    }
    return texelFetch(heights, clamp(p, ivec2(0), size - 1), level).x;
}

float layer_cubic(sampler2D heights, vec4 shape, vec2 uv, int level)
{
    vec2 at = uv * vec2(layer_size(heights, level)) - 0.5;
    vec2 base = floor(at);
    vec2 f = at - base;
    ivec2 corner = ivec2(base) - 1;
    float rows[4];
    for (int j = 0; j < 4; j++) {
        rows[j] = cubic_blend(f.x, layer_texel(heights, shape, corner + ivec2(0, j), level),
                              layer_texel(heights, shape, corner + ivec2(1, j), level),
                              layer_texel(heights, shape, corner + ivec2(2, j), level),
                              layer_texel(heights, shape, corner + ivec2(3, j), level));
    }
    return cubic_blend(f.y, rows[0], rows[1], rows[2], rows[3]);
}

#ifdef NO_FLOAT_LINEAR
float layer_bilinear(sampler2D heights, vec4 shape, vec2 uv, int level)
{
    vec2 at = uv * vec2(layer_size(heights, level)) - 0.5;
    vec2 base = floor(at);
    ivec2 p = ivec2(base);
    float a = layer_texel(heights, shape, p, level);
    float b = layer_texel(heights, shape, p + ivec2(1, 0), level);
    float c = layer_texel(heights, shape, p + ivec2(0, 1), level);
    float d = layer_texel(heights, shape, p + ivec2(1, 1), level);
    vec2 f = at - base;
    return mix(mix(a, b, f.x), mix(c, d, f.x), f.y);
}

float layer_linear(sampler2D heights, vec4 shape, vec2 uv, float lod)
{
    float level = floor(max(lod, 0.0));
    float low = layer_bilinear(heights, shape, uv, int(level));
    float high = layer_bilinear(heights, shape, uv, int(level) + 1);
    return mix(low, high, max(lod, 0.0) - level);
}
#else
float layer_linear(sampler2D heights, vec4 shape, vec2 uv, float lod)
{
    return textureLod(heights, uv, lod).x;
}
#endif

// Lays a layer over `altitude`, smooth where its texels are larger than the footprint.
float layer_over_cubic(float altitude, sampler2D heights, mat3x4 frame, vec2 geo,
                       float log2_footprint)
{
    vec3 at = layer_locate(frame[0], frame[1], geo);
    float lod = max(log2_footprint - frame[2].z, 0.0);
    float level = floor(lod);
    float low = layer_cubic(heights, frame[1], at.xy, int(level));
    float high = layer_cubic(heights, frame[1], at.xy, int(level) + (lod > level ? 1 : 0));
    float value = frame[2].w + frame[2].x * mix(low, high, lod - level);
    return mix(altitude, value, at.z);
}

float layer_over_linear(float altitude, sampler2D heights, mat3x4 frame, vec2 geo,
                        float log2_footprint)
{
    vec3 at = layer_locate(frame[0], frame[1], geo);
    float lod = log2_footprint - frame[2].z;
    float value = frame[2].w + frame[2].x * layer_linear(heights, frame[1], at.xy, lod);
    return mix(altitude, value, at.z);
}

#define ELEVATION_FRAME(i) mat3x4(u_elevation_place[i], u_elevation_shape[i], u_elevation_texel[i])

// Metres above the sphere, as all layers together say it.
float terrain_altitude(vec2 geo, float log2_footprint)
{
    float h = 0.0;
#if ELEVATION_COUNT > 0
    h = layer_over_cubic(h, u_elevation0, ELEVATION_FRAME(0), geo, log2_footprint);
#endif
#if ELEVATION_COUNT > 1
    h = layer_over_cubic(h, u_elevation1, ELEVATION_FRAME(1), geo, log2_footprint);
#endif
#if ELEVATION_COUNT > 2
    h = layer_over_cubic(h, u_elevation2, ELEVATION_FRAME(2), geo, log2_footprint);
#endif
#if ELEVATION_COUNT > 3
    h = layer_over_cubic(h, u_elevation3, ELEVATION_FRAME(3), geo, log2_footprint);
#endif
    return h;
}

// The same, cheaper: linear between texels.
float terrain_altitude_linear(vec2 geo, float log2_footprint)
{
    float h = 0.0;
#if ELEVATION_COUNT > 0
    h = layer_over_linear(h, u_elevation0, ELEVATION_FRAME(0), geo, log2_footprint);
#endif
#if ELEVATION_COUNT > 1
    h = layer_over_linear(h, u_elevation1, ELEVATION_FRAME(1), geo, log2_footprint);
#endif
#if ELEVATION_COUNT > 2
    h = layer_over_linear(h, u_elevation2, ELEVATION_FRAME(2), geo, log2_footprint);
#endif
#if ELEVATION_COUNT > 3
    h = layer_over_linear(h, u_elevation3, ELEVATION_FRAME(3), geo, log2_footprint);
#endif
    return h;
}
