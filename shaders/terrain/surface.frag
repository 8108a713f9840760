// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Colour, normal, terrain shadow and lights of the ground, for each pixel of the position target.
// Formats and meanings of the outputs are in src/terrain/compose.h.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 4; WATER_COUNT 4; LIGHTS_COUNT 4
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; NO_FLOAT_LINEAR
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; HAS_DETAIL
#include "terrain/layers.glsl"
#include "terrain/shadow.glsl"
#ifdef HAS_DETAIL
#include "terrain/detail.glsl"
#endif

uniform highp sampler2D u_position;
uniform mat3 u_local_from_planet; // at the camera's ground point, which is the anchor
uniform vec4 u_view;              // the camera's distance from the centre, m; a pixel's angle
uniform vec3 u_default_albedo;
uniform float u_region; // log2 of its width, m

#if COLOUR_COUNT > 0
uniform vec4 u_colour_place[4];
uniform vec4 u_colour_shape[4];
uniform vec4 u_colour_texel[4];
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
#if WATER_COUNT > 0
uniform vec4 u_water_place[4];
uniform vec4 u_water_shape[4];
uniform vec4 u_water_texel[4];
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
#if LIGHTS_COUNT > 0
uniform vec4 u_lights_place[4];
uniform vec4 u_lights_shape[4];
uniform vec4 u_lights_texel[4];
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

layout(location = 0) out vec4 o_albedo_water;
layout(location = 1) out vec4 o_normal_sun;
layout(location = 2) out vec4 o_lights;
layout(location = 3) out vec4 o_region;

vec4 layer_picture(sampler2D picture, vec4 place, vec4 shape, vec4 texel, vec3 geo_footprint)
{
    vec3 at = layer_locate(place, shape, geo_footprint.xy);
    vec4 c = textureLod(picture, at.xy, geo_footprint.z - texel.z);
    return vec4(c.xyz, c.w * at.z);
}

// Colour (mixed as square roots) over what lies below, by the layer's alpha.
vec3 layer_over_picture(vec3 below, sampler2D picture, mat3x4 frame, vec3 geo_footprint)
{
    vec4 c = layer_picture(picture, frame[0], frame[1], frame[2], geo_footprint);
    return mix(below, c.xyz, c.w);
}

float layer_over_mask(float below, sampler2D mask, mat3x4 frame, vec3 geo_footprint)
{
    vec3 at = layer_locate(frame[0], frame[1], geo_footprint.xy);
    return mix(below, textureLod(mask, at.xy, geo_footprint.z - frame[2].z).x, at.z);
}

// Slopes to the east and north of the layer, laid over those below. Steps are half a texel of the
// level that is seen, alike in metres: over a linear filter that is the continuous slope of a
// quadratic spline. z: log2 of a texel's height in m.
vec3 layer_over_slope(vec3 below, sampler2D heights, mat3x4 frame, vec3 geo_footprint,
                      float cos_latitude)
{
    vec3 at = layer_locate(frame[0], frame[1], geo_footprint.xy);
    float lod = max(geo_footprint.z - frame[2].z, 0.0);
    float north = 0.5 * frame[2].y * exp2(lod);
    float east = min(north / cos_latitude, 0.5 * LAYER_PI);
    vec2 geo = geo_footprint.xy;
    vec2 uv_n = layer_locate(frame[0], frame[1], geo_over_pole(geo + vec2(0.0, north))).xy;
    vec2 uv_s = layer_locate(frame[0], frame[1], geo_over_pole(geo - vec2(0.0, north))).xy;
    vec2 to_east = vec2(east * frame[0].z, 0.0);
    float dn =
        layer_linear(heights, frame[1], uv_n, lod) - layer_linear(heights, frame[1], uv_s, lod);
    float de = layer_linear(heights, frame[1], at.xy + to_east, lod) -
               layer_linear(heights, frame[1], at.xy - to_east, lod);
    vec2 slope = vec2(de / (east * cos_latitude), dn / north) * (frame[2].x / (2.0 * u_anchor.w));
    return mix(below, vec3(slope, frame[2].z), at.z);
}

vec3 terrain_slope(vec3 geo_footprint, float cos_latitude)
{
    vec3 slope = vec3(0.0, 0.0, 30.0); // no data: larger than any planet
#if ELEVATION_COUNT > 0
    slope = layer_over_slope(slope, u_elevation0, ELEVATION_FRAME(0), geo_footprint, cos_latitude);
#endif
#if ELEVATION_COUNT > 1
    slope = layer_over_slope(slope, u_elevation1, ELEVATION_FRAME(1), geo_footprint, cos_latitude);
#endif
#if ELEVATION_COUNT > 2
    slope = layer_over_slope(slope, u_elevation2, ELEVATION_FRAME(2), geo_footprint, cos_latitude);
#endif
#if ELEVATION_COUNT > 3
    slope = layer_over_slope(slope, u_elevation3, ELEVATION_FRAME(3), geo_footprint, cos_latitude);
#endif
    return slope;
}

#define COLOUR_FRAME(i) mat3x4(u_colour_place[i], u_colour_shape[i], u_colour_texel[i])
#define WATER_FRAME(i) mat3x4(u_water_place[i], u_water_shape[i], u_water_texel[i])
#define LIGHTS_FRAME(i) mat3x4(u_lights_place[i], u_lights_shape[i], u_lights_texel[i])

vec3 terrain_albedo(vec3 geo_footprint)
{
    vec3 c = sqrt(u_default_albedo);
#if COLOUR_COUNT > 0
    c = layer_over_picture(c, u_colour0, COLOUR_FRAME(0), geo_footprint);
#endif
#if COLOUR_COUNT > 1
    c = layer_over_picture(c, u_colour1, COLOUR_FRAME(1), geo_footprint);
#endif
#if COLOUR_COUNT > 2
    c = layer_over_picture(c, u_colour2, COLOUR_FRAME(2), geo_footprint);
#endif
#if COLOUR_COUNT > 3
    c = layer_over_picture(c, u_colour3, COLOUR_FRAME(3), geo_footprint);
#endif
    return c;
}

float terrain_water(vec3 geo_footprint)
{
    float w = 0.0;
#if WATER_COUNT > 0
    w = layer_over_mask(w, u_water0, WATER_FRAME(0), geo_footprint);
#endif
#if WATER_COUNT > 1
    w = layer_over_mask(w, u_water1, WATER_FRAME(1), geo_footprint);
#endif
#if WATER_COUNT > 2
    w = layer_over_mask(w, u_water2, WATER_FRAME(2), geo_footprint);
#endif
#if WATER_COUNT > 3
    w = layer_over_mask(w, u_water3, WATER_FRAME(3), geo_footprint);
#endif
    return w;
}

vec3 terrain_lights(vec3 geo_footprint)
{
    vec3 c = vec3(0.0);
#if LIGHTS_COUNT > 0
    c = layer_over_picture(c, u_lights0, LIGHTS_FRAME(0), geo_footprint);
#endif
#if LIGHTS_COUNT > 1
    c = layer_over_picture(c, u_lights1, LIGHTS_FRAME(1), geo_footprint);
#endif
#if LIGHTS_COUNT > 2
    c = layer_over_picture(c, u_lights2, LIGHTS_FRAME(2), geo_footprint);
#endif
#if LIGHTS_COUNT > 3
    c = layer_over_picture(c, u_lights3, LIGHTS_FRAME(3), geo_footprint);
#endif
    return c;
}

void main()
{
    vec4 p = texelFetch(u_position, ivec2(gl_FragCoord.xy), 0);
    vec3 local = u_local_from_planet * p.xyz;
    vec2 geo = geo_from_local(local, u_view.x);
    vec3 up = normalize(vec3(local.xy, u_view.x + local.z));
    float distance_m = length(local);
    // A pixel's width on the ground; seen at a slant it is longer, and the middle of both is taken.
    float slant = max(abs(dot(local, up)), 0.02 * distance_m) / max(distance_m, 1e-3);
    float log2_footprint = log2(max(distance_m * u_view.y, 1e-3)) - 0.5 * log2(slant);
#ifdef NO_FLOAT_LINEAR
    // Levels fetched by hand must be one for 2 x 2 pixels: llvmpipe takes the first's for all.
    vec3 first = texelFetch(u_position, ivec2(gl_FragCoord.xy) & ~1, 0).xyz;
    log2_footprint = log2(max(length(first) * u_view.y, 1e-3)) + 1.0;
#endif
    vec3 geo_footprint = vec3(geo, log2_footprint);

    vec3 east = cross(vec3(0.0, u_anchor.y, u_anchor.x), up);
    float cos_latitude = max(length(east), 1e-5);
    east /= cos_latitude;
    vec3 north = cross(up, east);
    vec3 slope = terrain_slope(geo_footprint, cos_latitude);
    vec3 root = terrain_albedo(geo_footprint);
    float water = terrain_water(geo_footprint);
#ifdef HAS_DETAIL
    // On the sphere and not on the mesh, whose vertices move with the camera.
    vec4 noise = detail_noise(local - up * p.w, log2_footprint - 0.3 * log2(slant), slope.z);
    // Plains are not quite plain, and water is.
    float land = 1.0 - water;
    float rough = land * detail_slope(length(slope.xy), min(slope.z, 20.0));
    slope.xy += rough * vec2(dot(noise.xyz, east), dot(noise.xyz, north));
    root = detail_albedo(root, land * noise.w, land * length(slope.xy));
#endif
    vec3 normal = normalize(up - slope.x * east - slope.y * north);

    float is_ground = p.w > -1e8 ? 1.0 : 0.0;
    o_albedo_water = is_ground * vec4(root, water);
    float sun = terrain_sun_visibility(p.xyz, p.w);
    // A row times a matrix: the transpose turns local axes back into the planet's.
    o_normal_sun = is_ground * vec4(normal * u_local_from_planet, sun);
    o_lights = is_ground * vec4(terrain_lights(geo_footprint), 1.0);
    o_region = is_ground * vec4(terrain_albedo(vec3(geo, max(log2_footprint, u_region))), 1.0);
}
