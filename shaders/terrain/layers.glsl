// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The rasters of the surface at a place, which is given as an offset from the anchor: `geo` is the
// difference in longitude and latitude, in radians. Needs ELEVATION_COUNT, COLOUR_COUNT,
// WATER_COUNT, LIGHTS_COUNT, NORMAL_COUNT (0 to 4); NO_FLOAT_LINEAR where 32F textures are not
// filtered; HAS_POLAR where a layer is stereographic; HAS_MODES where one does more than cover;
// HAS_GAPS where one has gaps; HAS_PAGES where one is held in tiles; HAS_NOISE where noise goes on
// below the layers, HAS_GROUND where it is the ground below them, HAS_BIOMES where that has
// colours. The C side is src/terrain/bind.c.
#ifdef HAS_BIOMES
#define HAS_GROUND
#endif
#ifdef HAS_GROUND
#define HAS_NOISE
#endif
#include "shared/blend.glsl"
#include "shared/cubic.glsl"
#include "shared/projection.glsl"
#include "shared/shore.glsl"
#ifdef HAS_PAGES
#include "terrain/pages.glsl"
#endif

uniform vec4 u_anchor; // sine, cosine of its latitude, the latitude, the sphere's radius in m

// Of each layer, in this order:
//     place   map coordinates of the anchor less those of the raster's middle, and 1 / extent
//     shape   how far it reaches from the middle (sideways, up, down; 9 is endless), 1 / feather
//     texel   scale and offset (w) of what it holds, a texel's height on the map (y), log2 of that
//             in m (z); heights are scale times what a texture holds plus the offset, in m
//     turn    stereographic: sine, cosine of the anchor's longitude less the map's; the pole (1 or
//             -1) times the ellipsoid's factor at the anchor; e^2. z is 0 for equirectangular ones.
//     paging  HAS_PAGES: see terrain/pages.glsl
struct LayerFrame {
    vec4 place, shape, texel, turn;
#ifdef HAS_PAGES
    vec4 paging;
#endif
};

// clang-format off
#ifdef HAS_PAGES
const int LAYER_VECTORS = 5;
#define LAYER_FRAME(u, i) LayerFrame(u[5*i], u[5*i + 1], u[5*i + 2], u[5*i + 3], u[5*i + 4])
#else
const int LAYER_VECTORS = 4;
#define LAYER_FRAME(u, i) LayerFrame(u[4*i], u[4*i + 1], u[4*i + 2], u[4*i + 3])
#endif
// clang-format on

// What heights need besides, since a float of the whole raster would be off by decimetres on the
// ground, and one of the whole range of heights by millimetres:
//     place   texture coordinates of the anchor: whole 1024ths, and what is left
//     unit    how many steps a texture's 1 stands for (0: it holds units as they are); the height
//             that is subtracted from all, in steps; its altitude over u_datum, m; metres of a
//             step
struct LayerNear {
    vec4 place, unit;
};

#if ELEVATION_COUNT > 0
uniform vec4 u_elevation_near[8];
uniform vec4 u_elevation[4 * LAYER_VECTORS];
uniform vec4 u_elevation_modes; // of shared/blend.glsl
uniform vec4 u_elevation_gaps;  // 1: the texture's y is log2 of how coarse gaps are
// Altitude of the level water over a layer's heights, m: 0 for one that has the sea's bed, else far
// below all.
uniform vec4 u_elevation_floors;
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

// The altitude that all others here count from, m: 0, unless a mesh wants more digits near the eye.
// Far from the sphere a float has steps of half a millimetre (at 5 km), a tenth of what an eye on
// the ground sees of it.
uniform float u_datum;

const float LAYER_PI = 3.14159265358979;
const float LAYER_NO_FLOOR = -1.0e8; // m; below it: not a floor

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

// A place as the projections want it.
struct Ground {
    vec2 geo;
    AxisOffset axis; // not set without HAS_POLAR
};

Ground ground_at(vec2 geo)
{
    Ground g;
    g.geo = geo;
#ifdef HAS_POLAR
    g.axis = projection_axis_offset(u_anchor.x, u_anchor.y, geo.x, geo.y);
#endif
    return g;
}

// Map coordinates from the raster's middle, of equirectangular layers only and of any.
vec2 layer_map_round(LayerFrame frame, vec2 geo)
{
    float east = frame.place.x + geo.x;
    east -= 2.0 * LAYER_PI * floor(east / (2.0 * LAYER_PI) + 0.5);
    return vec2(east, frame.place.y + geo.y);
}

// Map coordinates from the anchor's, of a stereographic layer.
#ifdef HAS_POLAR
vec2 layer_map_polar(vec4 turn, Ground g)
{
    float pole = turn.z < 0.0 ? -1.0 : 1.0;
    MapOffset m =
        projection_stereographic(g.axis, u_anchor.x, u_anchor.y, pole, turn.w, abs(turn.z));
    return vec2(m.x * turn.x + m.y * turn.y, pole * (m.y * turn.x - m.x * turn.y));
}
#endif

vec2 layer_map(LayerFrame frame, Ground g)
{
    vec2 map = layer_map_round(frame, g.geo);
#ifdef HAS_POLAR
    map = frame.turn.z != 0.0 ? frame.place.xy + layer_map_polar(frame.turn, g) : map;
#endif
    return map;
}

vec2 layer_uv(LayerFrame frame, vec2 map)
{
    return vec2(0.5 + map.x * frame.place.z, 0.5 - map.y * frame.place.w);
}

// Texture coordinates (x, y) and the layer's weight (z).
vec3 layer_locate(LayerFrame frame, Ground g)
{
    vec2 map = layer_map(frame, g);
    vec4 shape = frame.shape;
    float inside = min(shape.x - abs(map.x), min(shape.y - map.y, shape.z + map.y));
    float t = clamp(inside * shape.w, 0.0, 1.0);
    return vec3(layer_uv(frame, map), t * t * (3.0 - 2.0 * t));
}

// Texture coordinates that are known to a part of the distance from the anchor: whole 1024ths, and
// the rest, which is small near the anchor.
struct LayerPoint {
    ivec2 coarse;
    vec2 fine;
};

LayerPoint layer_point(LayerFrame frame, LayerNear near, Ground g)
{
    vec2 away = g.geo; // on the map, from the anchor
    float turns = floor((frame.place.x + away.x) / (2.0 * LAYER_PI) + 0.5);
#ifdef HAS_POLAR
    away = frame.turn.z != 0.0 ? layer_map_polar(frame.turn, g) : away;
    turns = frame.turn.z != 0.0 ? 0.0 : turns;
#endif
    bool is_round = frame.shape.x > 4.0;
    vec2 fine = near.place.zw + vec2(away.x, -away.y) * frame.place.zw;
    fine.x -= is_round ? 0.0 : turns * 2.0 * LAYER_PI * frame.place.z;
    float u = near.place.x / 1024.0 + fine.x;
    return LayerPoint(ivec2(near.place.xy) - ivec2(is_round ? 1024 * int(floor(u)) : 0, 0), fine);
}

vec2 layer_point_uv(LayerPoint point)
{
    return vec2(point.coarse) / 1024.0 + point.fine;
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

// A place on a level, as texels of the texture that holds it.
struct LayerTexels {
    ivec2 base; // (0, 0) is the first one's middle
    vec2 at;    // from the base
    int level;  // of the texture
    vec4 shape;
};

LayerTexels layer_texels_near(sampler2D heights, LayerFrame frame, LayerPoint point, int level)
{
    ivec2 size = layer_size(heights, level);
    ivec2 whole = point.coarse * size;
    LayerTexels t = LayerTexels(whole >> 10, vec2(whole & 1023) / 1024.0 + point.fine * vec2(size),
                                level, frame.shape);
#ifdef HAS_PAGES
    // Tiles have their neighbours' texels, so that nothing turns around or over a pole.
    if (page_is_used(frame.paging)) {
        Page page = page_find(frame.paging, layer_point_uv(point), level);
        whole = point.coarse * page.size;
        t = LayerTexels((whole >> 10) - page.corner + page.origin,
                        vec2(whole & 1023) / 1024.0 + point.fine * vec2(page.size), 0, vec4(0.0));
    }
#endif
    t.at -= 0.5;
    return t;
}

LayerTexels layer_texels(sampler2D heights, LayerFrame frame, vec2 uv, int level)
{
    LayerTexels t =
        LayerTexels(ivec2(0), uv * vec2(layer_size(heights, level)) - 0.5, level, frame.shape);
#ifdef HAS_PAGES
    // Tiles have their neighbours' texels, so that nothing turns around or over a pole.
    if (page_is_used(frame.paging)) {
        vec2 place = vec2(frame.shape.x > 4.0 ? fract(uv.x) : uv.x, uv.y);
        t = LayerTexels(ivec2(0), page_texel(frame.paging, place, level) - 0.5, 0, vec4(0.0));
    }
#endif
    return t;
}

// A texel in steps above the anchor's ground: whole numbers come out of the texture as such.
float layer_step(sampler2D heights, LayerTexels t, vec4 unit, ivec2 p)
{
    float value = layer_texel(heights, t.shape, p, t.level);
    return (unit.x > 0.0 ? floor(value * unit.x + 0.5) : value) - unit.y;
}

float layer_cubic(sampler2D heights, LayerTexels t, vec4 unit)
{
    vec2 base = floor(t.at);
    vec2 f = t.at - base;
    ivec2 corner = t.base + ivec2(base) - 1;
    float rows[4];
    for (int j = 0; j < 4; j++) {
        rows[j] = cubic_blend(f.x, layer_step(heights, t, unit, corner + ivec2(0, j)),
                              layer_step(heights, t, unit, corner + ivec2(1, j)),
                              layer_step(heights, t, unit, corner + ivec2(2, j)),
                              layer_step(heights, t, unit, corner + ivec2(3, j)));
    }
    return cubic_blend(f.y, rows[0], rows[1], rows[2], rows[3]);
}

// What a filtered texture holds, between two levels of detail.
#ifdef HAS_PAGES
vec4 layer_fetch_level(sampler2D texels, LayerFrame frame, vec2 uv, int level)
{
    bool is_paged = page_is_used(frame.paging);
    vec2 place = vec2(frame.shape.x > 4.0 ? fract(uv.x) : uv.x, uv.y);
    vec2 at = page_texel(frame.paging, place, level) / vec2(textureSize(texels, 0));
    return textureLod(texels, is_paged ? at : uv, is_paged ? 0.0 : float(level));
}

vec4 layer_fetch(sampler2D texels, LayerFrame frame, vec2 uv, float lod)
{
    float level = floor(max(lod, 0.0));
    return mix(layer_fetch_level(texels, frame, uv, int(level)),
               layer_fetch_level(texels, frame, uv, int(level) + 1), max(lod, 0.0) - level);
}
#else
vec4 layer_fetch(sampler2D texels, LayerFrame frame, vec2 uv, float lod)
{
    return textureLod(texels, uv, lod);
}
#endif

#ifdef NO_FLOAT_LINEAR
float layer_bilinear(sampler2D heights, LayerFrame frame, vec2 uv, int level)
{
    LayerTexels t = layer_texels(heights, frame, uv, level);
    vec2 base = floor(t.at);
    ivec2 p = t.base + ivec2(base);
    float a = layer_texel(heights, t.shape, p, t.level);
    float b = layer_texel(heights, t.shape, p + ivec2(1, 0), t.level);
    float c = layer_texel(heights, t.shape, p + ivec2(0, 1), t.level);
    float d = layer_texel(heights, t.shape, p + ivec2(1, 1), t.level);
    vec2 f = t.at - base;
    return mix(mix(a, b, f.x), mix(c, d, f.x), f.y);
}

float layer_linear(sampler2D heights, LayerFrame frame, vec2 uv, float lod)
{
    float level = floor(max(lod, 0.0));
    float low = layer_bilinear(heights, frame, uv, int(level));
    float high = layer_bilinear(heights, frame, uv, int(level) + 1);
    return mix(low, high, max(lod, 0.0) - level);
}
#else
float layer_linear(sampler2D heights, LayerFrame frame, vec2 uv, float lod)
{
    return layer_fetch(heights, frame, uv, lod).x;
}
#endif

// Heights count from u_datum; what is added and factors are as they are, and what is multiplied
// counts from the sphere.
float layer_origin(float mode)
{
#ifdef HAS_MODES
    return blend_is_change(mode) ? 0.0 : u_datum;
#else
    return u_datum;
#endif
}

float layer_blend(float mode, float below, float value, float weight)
{
#ifdef HAS_MODES
    float origin = blend_is_factor(mode) ? u_datum : 0.0;
    float mixed = blend_layers(mode, below + origin, value, weight) - origin;
    bool is_whole = weight >= 1.0 && mode < 0.5;
#else
    float mixed = mix(below, value, weight);
    bool is_whole = weight >= 1.0;
#endif
    return is_whole ? value : mixed; // with all its digits, which below + 1 (value - below) has not
}

// Lays a layer over `altitude`, smooth where its texels are larger than the footprint.
float layer_over_cubic(float altitude, sampler2D heights, LayerFrame frame, LayerNear near,
                       vec2 mode_floor, Ground g, float log2_footprint)
{
    LayerPoint point = layer_point(frame, near, g);
    float lod = max(log2_footprint - frame.texel.z, 0.0);
    int level = int(floor(lod));
    int next = level + (lod > floor(lod) ? 1 : 0);
    float low = layer_cubic(heights, layer_texels_near(heights, frame, point, level), near.unit);
    float high = layer_cubic(heights, layer_texels_near(heights, frame, point, next), near.unit);
    float value = near.unit.z + near.unit.w * mix(low, high, lod - floor(lod));
    value = max(value, mode_floor.y - u_datum);
    return layer_blend(mode_floor.x, altitude, value, layer_locate(frame, g).z);
}

// And lays over `altitude.y` whether the layer has the sea's bed.
vec2 layer_over_linear(vec2 altitude, sampler2D heights, LayerFrame frame, vec2 mode_floor,
                       float least, Ground g, float log2_footprint)
{
    vec3 at = layer_locate(frame, g);
    float lod = log2_footprint - frame.texel.z;
    float value = frame.texel.w + frame.texel.x * layer_linear(heights, frame, at.xy, lod);
    value = max(value, min(mode_floor.y, least)) - layer_origin(mode_floor.x);
    float bed = mode_floor.y > LAYER_NO_FLOOR ? 1.0 : 0.0;
    return vec2(layer_blend(mode_floor.x, altitude.x, value, at.z), mix(altitude.y, bed, at.z));
}

#define ELEVATION_FRAME(i) LAYER_FRAME(u_elevation, i)
#define ELEVATION_MODE(i) vec2(u_elevation_modes[i], u_elevation_floors[i])
#define ELEVATION_NEAR(i) LayerNear(u_elevation_near[2 * i], u_elevation_near[2 * i + 1])

// Metres above u_datum, as all layers together say it, over what lies below them.
float layers_altitude(float below, Ground g, float log2_footprint)
{
    float h = below;
#if ELEVATION_COUNT > 0
    h = layer_over_cubic(h, u_elevation0, ELEVATION_FRAME(0), ELEVATION_NEAR(0), ELEVATION_MODE(0),
                         g, log2_footprint);
#endif
#if ELEVATION_COUNT > 1
    h = layer_over_cubic(h, u_elevation1, ELEVATION_FRAME(1), ELEVATION_NEAR(1), ELEVATION_MODE(1),
                         g, log2_footprint);
#endif
#if ELEVATION_COUNT > 2
    h = layer_over_cubic(h, u_elevation2, ELEVATION_FRAME(2), ELEVATION_NEAR(2), ELEVATION_MODE(2),
                         g, log2_footprint);
#endif
#if ELEVATION_COUNT > 3
    h = layer_over_cubic(h, u_elevation3, ELEVATION_FRAME(3), ELEVATION_NEAR(3), ELEVATION_MODE(3),
                         g, log2_footprint);
#endif
    return h;
}

// The same, cheaper: linear between texels; y: 1 where that is a layer with the sea's bed. `least`:
// nothing is raised above it, 0 for level water.
vec2 layers_linear(float below, float least, Ground g, float log2_footprint)
{
    vec2 h = vec2(below, 0.0);
#if ELEVATION_COUNT > 0
    h = layer_over_linear(h, u_elevation0, ELEVATION_FRAME(0), ELEVATION_MODE(0), least, g,
                          log2_footprint);
#endif
#if ELEVATION_COUNT > 1
    h = layer_over_linear(h, u_elevation1, ELEVATION_FRAME(1), ELEVATION_MODE(1), least, g,
                          log2_footprint);
#endif
#if ELEVATION_COUNT > 2
    h = layer_over_linear(h, u_elevation2, ELEVATION_FRAME(2), ELEVATION_MODE(2), least, g,
                          log2_footprint);
#endif
#if ELEVATION_COUNT > 3
    h = layer_over_linear(h, u_elevation3, ELEVATION_FRAME(3), ELEVATION_MODE(3), least, g,
                          log2_footprint);
#endif
    return h;
}

float layers_altitude_linear(float below, Ground g, float log2_footprint)
{
    return layers_linear(below, 0.0, g, log2_footprint).x;
}

// Here, since a file counts once, also where it is left out.
#include "terrain/slope.glsl"
#include "terrain/water.glsl"

#ifdef HAS_NOISE
#include "terrain/ground.glsl"
#else
float terrain_altitude(vec2 geo, float log2_footprint)
{
    return layers_altitude(-u_datum, ground_at(geo), log2_footprint);
}

float terrain_altitude_linear(vec2 geo, float log2_footprint)
{
    return layers_altitude_linear(-u_datum, ground_at(geo), log2_footprint);
}
#endif
