// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Colour, normal, terrain shadow and lights of the ground, for each pixel of the position target.
// Formats and meanings of the outputs are in src/terrain/compose.h.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 4; WATER_COUNT 4; LIGHTS_COUNT 4; NORMAL_COUNT 4
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; NO_FLOAT_LINEAR
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 2; WATER_COUNT 1; LIGHTS_COUNT 1; HAS_COVERS; HAS_NOISE
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_BIOMES
// validate: ELEVATION_COUNT 3; COLOUR_COUNT 3; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_POLAR; HAS_MODES
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; NORMAL_COUNT 1
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 2; WATER_COUNT 1; LIGHTS_COUNT 1; HAS_PAGES
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_GAPS
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 1; LIGHTS_COUNT 0; HAS_MEAN_SHORES
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; HAS_DEPTH; HAS_NOISE
#ifndef NORMAL_COUNT
#define NORMAL_COUNT 0
#endif
#define HAS_ROCK
#include "shared/albedo.glsl"
#include "terrain/layers.glsl"
#include "terrain/shadow.glsl"
#include "terrain/water.glsl"

uniform highp sampler2D u_position;
uniform mat3 u_local_from_planet; // at the camera's ground point, which is the anchor
uniform vec4 u_view;              // the camera's distance from the centre, m; a pixel's angle
uniform vec3 u_default_albedo;
uniform float u_region; // log2 of its width, m

#if COLOUR_COUNT > 0
uniform vec4 u_colour[4 * LAYER_VECTORS];
uniform vec4 u_colour_modes;
uniform sampler2D u_colour0;
#endif
#if COLOUR_COUNT > 1
uniform sampler2D u_colour1;
#endif
#if COLOUR_COUNT > 2
uniform sampler2D u_colour2;
#endif
#if COLOUR_COUNT > 3
uniform sampler2D u_colour3;
#endif
#if LIGHTS_COUNT > 0
uniform vec4 u_lights[4 * LAYER_VECTORS];
uniform vec4 u_lights_modes;
uniform sampler2D u_lights0;
#endif
#if LIGHTS_COUNT > 1
uniform sampler2D u_lights1;
#endif
#if LIGHTS_COUNT > 2
uniform sampler2D u_lights2;
#endif
#if LIGHTS_COUNT > 3
uniform sampler2D u_lights3;
#endif
#if NORMAL_COUNT > 0
uniform vec4 u_normal[4 * LAYER_VECTORS];
uniform vec4 u_normal_modes;
uniform sampler2D u_normal0;
#endif
#if NORMAL_COUNT > 1
uniform sampler2D u_normal1;
#endif
#if NORMAL_COUNT > 2
uniform sampler2D u_normal2;
#endif
#if NORMAL_COUNT > 3
uniform sampler2D u_normal3;
#endif

layout(location = 0) out vec4 o_albedo_water;
layout(location = 1) out vec4 o_normal_sun;
layout(location = 2) out vec4 o_lights;
layout(location = 3) out vec4 o_region;

#ifdef HAS_COVERS
#define COVER_MODE 5.0 // of u_colour_modes: the alpha is a mask's

// How a place lies among the heights that are made up around it: standard deviations above their
// mean; what of their variance a pixel hides; the deviation in m. log2 of the texels of data, m.
struct Cover {
    float height, hidden, deviation, log2_texel;
};

Cover cover = Cover(0.0, 1.0, 0.0, 0.0);

// The part of a mask's share that lies here. What is below finer texels than the data's is not
// known.
float cover_within(float share, float log2_texel)
{
    float strength = albedo_cover_strength(cover.deviation) *
                     clamp(1.0 + log2_texel - cover.log2_texel, 0.0, 1.0);
    return strength > 0.01 ? albedo_cover(share, cover.height, strength, cover.hidden) : share;
}
#endif

// Colour (as square roots) over what lies below, by the layer's alpha.
vec3 layer_over_picture(vec3 below, sampler2D picture, LayerFrame frame, float mode, Ground g,
                        float log2_footprint)
{
    vec3 at = layer_locate(frame, g);
    vec4 c = layer_fetch(picture, frame, at.xy, log2_footprint - frame.texel.z);
#ifdef HAS_COVERS
    bool is_cover = mode > COVER_MODE - 0.5;
    c.w = is_cover ? cover_within(c.w, frame.texel.z) : c.w;
    mode = is_cover ? 0.0 : mode;
#endif
    vec3 value = c.xyz;
#ifdef HAS_MODES
    bool adds = mode > 0.5 && mode < 1.5; // light, not its roots
    value = vec3(blend_whole(mode, below.x, c.x), blend_whole(mode, below.y, c.y),
                 blend_whole(mode, below.z, c.z));
    value = adds ? sqrt(below * below + c.xyz * c.xyz) : value;
#endif
    return mix(below, value, c.w * at.z);
}

// A picture of normals: red to the map's right, green up, blue out of it, each -1 to 1.
vec4 layer_over_normal(vec4 below, sampler2D normals, LayerFrame frame, float mode, Tangent t)
{
    vec3 at = layer_locate(frame, t.ground);
    vec4 c = layer_fetch(normals, frame, at.xy, t.log2_footprint - frame.texel.z);
    vec3 n = 2.0 * c.xyz - 1.0;
    MapAxes axes = layer_axes(frame, t);
    vec3 vector = -(n.x * axes.x + n.y * axes.y) / max(n.z, 0.05);
    vector += mode > 0.5 ? below.xyz : vec3(0.0);
    return mix(below, vec4(vector, frame.texel.z), at.z * c.w);
}

// Of heights that lie as `slope`, with what pictures of normals say.
vec4 terrain_slope(vec4 slope, Tangent t)
{
#if NORMAL_COUNT > 0
    slope = layer_over_normal(slope, u_normal0, LAYER_FRAME(u_normal, 0), u_normal_modes.x, t);
#endif
#if NORMAL_COUNT > 1
    slope = layer_over_normal(slope, u_normal1, LAYER_FRAME(u_normal, 1), u_normal_modes.y, t);
#endif
#if NORMAL_COUNT > 2
    slope = layer_over_normal(slope, u_normal2, LAYER_FRAME(u_normal, 2), u_normal_modes.z, t);
#endif
#if NORMAL_COUNT > 3
    slope = layer_over_normal(slope, u_normal3, LAYER_FRAME(u_normal, 3), u_normal_modes.w, t);
#endif
    return slope;
}

vec3 terrain_albedo(vec3 below, Ground g, float log2_footprint)
{
    vec3 c = below;
#if COLOUR_COUNT > 0
    c = layer_over_picture(c, u_colour0, LAYER_FRAME(u_colour, 0), u_colour_modes.x, g,
                           log2_footprint);
#endif
#if COLOUR_COUNT > 1
    c = layer_over_picture(c, u_colour1, LAYER_FRAME(u_colour, 1), u_colour_modes.y, g,
                           log2_footprint);
#endif
#if COLOUR_COUNT > 2
    c = layer_over_picture(c, u_colour2, LAYER_FRAME(u_colour, 2), u_colour_modes.z, g,
                           log2_footprint);
#endif
#if COLOUR_COUNT > 3
    c = layer_over_picture(c, u_colour3, LAYER_FRAME(u_colour, 3), u_colour_modes.w, g,
                           log2_footprint);
#endif
    return c;
}

vec3 terrain_lights(Ground g, float log2_footprint)
{
    vec3 c = vec3(0.0);
#if LIGHTS_COUNT > 0
    c = layer_over_picture(c, u_lights0, LAYER_FRAME(u_lights, 0), u_lights_modes.x, g,
                           log2_footprint);
#endif
#if LIGHTS_COUNT > 1
    c = layer_over_picture(c, u_lights1, LAYER_FRAME(u_lights, 1), u_lights_modes.y, g,
                           log2_footprint);
#endif
#if LIGHTS_COUNT > 2
    c = layer_over_picture(c, u_lights2, LAYER_FRAME(u_lights, 2), u_lights_modes.z, g,
                           log2_footprint);
#endif
#if LIGHTS_COUNT > 3
    c = layer_over_picture(c, u_lights3, LAYER_FRAME(u_lights, 3), u_lights_modes.w, g,
                           log2_footprint);
#endif
    return c;
}

#ifdef HAS_DEPTH
#include "shared/sea.glsl"
uniform float u_sea_depth; // code of the depth everywhere; below 0: there is none
uniform vec3 u_sea_albedo; // of what a region has of the sea
#endif
#include "terrain/look.glsl"

void main()
{
    vec4 p = texelFetch(u_position, ivec2(gl_FragCoord.xy), 0);
    vec3 local = u_local_from_planet * p.xyz;
    vec2 geo = geo_from_local(local, u_view.x);
    vec3 up = normalize(vec3(local.xy, u_view.x + local.z));
    float distance_m = length(local);
    // A pixel's width on the ground; seen at a slant it is longer, and the middle of both is taken.
    float slant = max(abs(dot(local, up)), 0.02 * distance_m) / max(distance_m, 1e-3);
    float log2_pixel = log2(max(distance_m * u_view.y, 1e-3));
    float log2_footprint = log2_pixel - 0.5 * log2(slant);
    // Levels fetched by hand must be one for 2 x 2 pixels: llvmpipe takes the first's for all.
    vec3 first = texelFetch(u_position, ivec2(gl_FragCoord.xy) & ~1, 0).xyz;
    float quad_footprint = log2(max(length(first) * u_view.y, 1e-3)) + 1.0;
#ifdef NO_FLOAT_LINEAR
    log2_footprint = quad_footprint;
#endif
    // 1 - cosine without cancellation.
    vec3 at = vec3(up.xy, -dot(up.xy, up.xy) / (1.0 + up.z));
    Tangent tangent = tangent_at(at, geo, log2_footprint);
#ifdef HAS_NOISE
    stones.sun = u_local_from_planet * (u_shadow_toward * u_shadow_from_planet);
#endif
    Look look = find_look(
        tangent, LookPlace(at, quad_footprint, p.w, local / max(distance_m, 1e-3), log2_pixel));

    float is_ground = p.w > -1e8 ? 1.0 : 0.0;
    o_albedo_water = is_ground * vec4(look.root, look.water);
    float sun = look.lit * terrain_sun_visibility(p.xyz, p.w);
    // A row times a matrix: the transpose turns local axes back into the planet's.
    o_normal_sun = is_ground * vec4(look.open * look.normal * u_local_from_planet, sun);
#ifdef HAS_DEPTH
    float depth = u_sea_depth < 0.0 ? look.depth : u_sea_depth;
#else
    float depth = 1.0;
#endif
    // What land has in alpha is added afterwards, and of what the sky leaves: sky_view.frag.
    depth = look.water > 0.5 / 255.0 ? depth : 0.0;
    o_lights = is_ground * vec4(terrain_lights(tangent.ground, log2_footprint), depth);
    o_region = is_ground * vec4(look.region, 0.0);
}
