// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Slopes of the layers of heights. Needs terrain/layers.glsl before it.
#include "shared/relief.glsl"

// A pixel's place and the unit vectors east, north and up there, local frame.
struct Tangent {
    Ground ground;
    float log2_footprint, cos_latitude;
    vec3 east, north, up;
};

// `at`: the place's direction less the anchor's, local frame.
Tangent tangent_at(vec3 at, vec2 geo, float log2_footprint)
{
    Tangent t;
    t.ground = ground_at(geo);
    t.log2_footprint = log2_footprint;
    t.up = vec3(at.xy, 1.0 + at.z);
    vec3 east = cross(vec3(0.0, u_anchor.y, u_anchor.x), t.up);
    float axis_distance = length(east);
    t.cos_latitude = max(axis_distance, 1e-5);
    t.east = east / max(axis_distance, 1e-12);
    t.north = cross(t.up, t.east);
    return t;
}

// Unit vectors along a map's x and y at a place, and half the map's scale there (stereographic).
struct MapAxes {
    vec3 x, y;
    float half_scale;
};

// The stereographic map turns a vector e of its plane to e - (e . v) / (1 + a . v) (v + a), where v
// is the place and a its pole.
MapAxes layer_axes(LayerFrame frame, Tangent t)
{
    MapAxes axes = MapAxes(t.east, t.north, 0.5);
#ifdef HAS_POLAR
    vec4 turn = frame.turn;
    float pole = turn.z < 0.0 ? -1.0 : 1.0;
    vec3 axis = pole * vec3(0.0, u_anchor.y, u_anchor.x);
    vec3 outward = vec3(0.0, -u_anchor.x, u_anchor.y);
    vec3 sum = (t.up + axis) / max(1.0 + dot(axis, t.up), 1.0e-4);
    vec3 along = outward - dot(outward, t.up) * sum;
    vec3 across = vec3(1.0, 0.0, 0.0) - t.up.x * sum;
    if (turn.z != 0.0) {
        axes.x = along * turn.x + across * turn.y;
        axes.y = pole * (across * turn.x - along * turn.y);
        axes.half_scale =
            projection_stereographic_scale(u_anchor.x, t.ground.axis.up, pole) * abs(turn.z);
    }
#endif
    return axes;
}

// The slope of a layer, as a tangent vector, laid over those below; w: log2 of a texel's height in
// m, between layers; `data`: the same, layer by layer. Steps are half a texel of the level that is
// seen, alike in metres: over a linear filter that is the continuous slope of a quadratic spline.
// `height` is that of the layers so far; `gap` is 1 where the texture also says how coarse the
// model is in gaps.
vec4 layer_over_slope(vec4 below, sampler2D heights, LayerFrame frame, float mode, float gap,
                      Tangent t, inout float height, inout ReliefData data)
{
    vec3 at = layer_locate(frame, t.ground);
    float lod = max(t.log2_footprint - frame.texel.z, 0.0);
    float step_map = 0.5 * frame.texel.y * exp2(lod);
    float up = step_map;
    float right = min(up / t.cos_latitude, 0.5 * LAYER_PI);
    vec2 geo = t.ground.geo;
    vec2 uv_up = layer_uv(frame, layer_map_round(frame, geo_over_pole(geo + vec2(0.0, up))));
    vec2 uv_down = layer_uv(frame, layer_map_round(frame, geo_over_pole(geo - vec2(0.0, up))));
    vec2 to_right = vec2(right * frame.place.z, 0.0);
    vec2 steps = vec2(right * t.cos_latitude, up); // angles
    MapAxes axes = layer_axes(frame, t);
#ifdef HAS_POLAR
    bool is_polar = frame.turn.z != 0.0;
    vec2 to_up = vec2(0.0, step_map * frame.place.w);
    uv_up = is_polar ? at.xy - to_up : uv_up;
    uv_down = is_polar ? at.xy + to_up : uv_down;
    to_right = is_polar ? vec2(step_map * frame.place.z, 0.0) : to_right;
    steps = is_polar ? vec2(step_map / (2.0 * axes.half_scale)) : steps;
#endif
    vec2 rise =
        vec2(layer_linear(heights, frame, at.xy + to_right, lod) -
                 layer_linear(heights, frame, at.xy - to_right, lod),
             layer_linear(heights, frame, uv_up, lod) - layer_linear(heights, frame, uv_down, lod));
    vec2 slope = rise / steps * (frame.texel.x / (2.0 * u_anchor.w));
    vec3 vector = slope.x * axes.x + slope.y * axes.y;
#ifdef HAS_MODES
    float value = frame.texel.w + frame.texel.x * layer_linear(heights, frame, at.xy, lod);
    vector = vec3(blend_slope(mode, height, value, below.x, vector.x),
                  blend_slope(mode, height, value, below.y, vector.y),
                  blend_slope(mode, height, value, below.z, vector.z));
    height = blend_layers(mode, height, value, at.z);
#endif
    float log2_texel = frame.texel.z;
#ifdef HAS_GAPS
    // In a gap it is known more coarsely, but not more than what is below.
    float coarser = gap > 0.5 ? textureLod(heights, at.xy, lod).y : 0.0;
    log2_texel = coarser > 0.0 ? min(log2_texel + coarser, max(below.w, log2_texel)) : log2_texel;
#endif
    bool is_there = at.z > 0.0;
    data.top = is_there ? log2_texel : data.top;
    data.below = is_there ? below.w : data.below;
    data.part = is_there ? at.z : data.part;
    return mix(below, vec4(vector, log2_texel), at.z);
}

const float SLOPE_NO_DATA = 30.0; // log2 of a texel in m: larger than any planet

// Of all layers of heights, over what lies below them: its slope and its height.
vec4 layers_slope(vec4 below, float below_height, Tangent t, out ReliefData data)
{
    data = ReliefData(below.w, below.w, 1.0);
    vec4 slope = below;
    float height = below_height;
#if ELEVATION_COUNT > 0
    slope = layer_over_slope(slope, u_elevation0, ELEVATION_FRAME(0), u_elevation_modes.x,
                             u_elevation_gaps.x, t, height, data);
#endif
#if ELEVATION_COUNT > 1
    slope = layer_over_slope(slope, u_elevation1, ELEVATION_FRAME(1), u_elevation_modes.y,
                             u_elevation_gaps.y, t, height, data);
#endif
#if ELEVATION_COUNT > 2
    slope = layer_over_slope(slope, u_elevation2, ELEVATION_FRAME(2), u_elevation_modes.z,
                             u_elevation_gaps.z, t, height, data);
#endif
#if ELEVATION_COUNT > 3
    slope = layer_over_slope(slope, u_elevation3, ELEVATION_FRAME(3), u_elevation_modes.w,
                             u_elevation_gaps.w, t, height, data);
#endif
    return slope;
}
