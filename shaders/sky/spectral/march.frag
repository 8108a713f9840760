// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Two steps of the march along the rays of a coarse grid over the picture, or the last one into
// space: the light that the air between two distances sends to the eye, as the star alone would
// make it and as it is with what stands before the star, added to the sums of the nearer steps.
// Only the share of the first in the second is used, so both may be rough alike.
//
// Of the first order, terrain takes what it hides of the star. Light that was scattered before
// comes from all around, from farther away than shadows of mountains are wide, and is left whole.
// validate: PEAKED_COUNT 1; SURFACE
// validate: PEAKED_COUNT 0
// validate: PEAKED_COUNT 3; SURFACE; TO_SPACE
// validate: PEAKED_COUNT 1; ECLIPSE
// validate: PEAKED_COUNT 1; TO_SPACE; ECLIPSE
// validate: PEAKED_COUNT 1; TO_SPACE; CLOUDS
// validate: PEAKED_COUNT 1; SURFACE; CLOUDS
// validate: PEAKED_COUNT 1; CLOUDS
// validate: PEAKED_COUNT 1; SURFACE; ECLIPSE

#include "sky/spectral/air.glsl"
#ifdef ECLIPSE
#include "sky/eclipse.glsl"
#endif
#ifdef CLOUDS
#include "sky/deck.glsl"
#endif
#ifdef SURFACE
#include "terrain/shadow.glsl"
#endif

in vec2 v_uv;

uniform vec3 u_steps;    // from, between them, and to, m from where the ray's air begins
uniform sampler2D u_lit; // sums so far; alpha: how far the ray is looked at
uniform sampler2D u_all;
uniform sampler3D u_source0; // as u_scattered0, but of each cell alone
uniform sampler3D u_source_multiple;
#if PEAKED_COUNT > 0
uniform sampler3D u_source1;
#endif
#if PEAKED_COUNT > 1
uniform sampler3D u_source2;
#endif
#if PEAKED_COUNT > 2
uniform sampler3D u_source3;
#endif

layout(location = 0) out vec4 out_lit;
layout(location = 1) out vec4 out_all;
layout(location = 2) out vec4 out_first; // share of XYZ; alpha: as above, from where the air begins
#ifndef TO_SPACE
layout(location = 3) out vec4 out_second; // the same after the second step
#endif

// The terrain's edge is looked for at this many places of a step; between them it is straight.
const int SHADOW_PARTS = 4;
const int CLOUD_PARTS = 2;
// Of what is left of the way into space.
#ifdef ECLIPSE
const int SPACE_PARTS = 32;
#else
const int SPACE_PARTS = 8;
#endif

const float EVEN_PHASE = 0.25 / SHARED_PI;

struct Source {
    vec3 first, multiple; // XYZ per m
    vec3 even;            // as first, were the star's light to come from everywhere alike
};

Source source_at(Ray ray, float azimuth, float row, float distance_m)
{
    // Texel d is the middle of the cell between depths d - 1 and d.
    float depth = air_depth(ray, distance_m);
    float texel = u_eye.w > 0.5 ? u_aerial_texel.y : u_aerial_texel.x;
    vec3 at = air_map((mix(texel, 1.0, depth) - 0.5 * texel) / (1.0 - texel), azimuth, row);
    float smooth_phase = phase_rayleigh(ray.nu);
    Source source;
    vec3 smooth_first = exp(textureLod(u_source0, at, 0.0).xyz);
    source.first = smooth_first * smooth_phase;
    source.even = smooth_first * EVEN_PHASE;
    source.multiple = exp(textureLod(u_source_multiple, at, 0.0).xyz) * smooth_phase;
#if PEAKED_COUNT > 0
    vec4 phase = peaked_phase(ray.nu);
    vec3 first1 = exp(textureLod(u_source1, at, 0.0).xyz);
    source.first += first1 * phase.x;
    source.even += first1 * EVEN_PHASE;
#endif
#if PEAKED_COUNT > 1
    vec3 first2 = exp(textureLod(u_source2, at, 0.0).xyz);
    source.first += first2 * phase.y;
    source.even += first2 * EVEN_PHASE;
#endif
#if PEAKED_COUNT > 2
    vec3 first3 = exp(textureLod(u_source3, at, 0.0).xyz);
    source.first += first3 * phase.z;
    source.even += first3 * EVEN_PHASE;
#endif
    return source;
}

#if defined(SURFACE) || defined(ECLIPSE) || defined(CLOUDS)
// Height above the sphere without a difference of large numbers.
float altitude_at(Ray ray, float distance_m)
{
    float r = u_eye.x;
    float rise =
        u_eye.y * (2.0 * u_planet.x + u_eye.y) + distance_m * (2.0 * r * ray.mu + distance_m);
    return rise / (sqrt(max(u_planet.x * u_planet.x + rise, 0.0)) + u_planet.x);
}
#endif

#ifdef SURFACE
// Over a piece, from one terrain_air_shadow to another, x: the part of it that terrain leaves in
// the star's light, relative to what the level sphere does; y: the part of it that is air. A ray of
// the grid goes as far as the pixels around it see, through hills that they see past: in there is
// no air that could be in the shade.
vec2 piece_leaves(vec3 from, vec3 to)
{
    float surface = clamp(from.z / (from.z - to.z + 1.0e-6), 0.0, 1.0); // where it is crossed
    float above = max(from.z, to.z) <= 0.0   ? 0.0
                  : min(from.z, to.z) >= 0.0 ? 1.0
                  : from.z > 0.0             ? surface
                                             : 1.0 - surface;
    vec2 crossing = mix(from.xy, to.xy, surface);
    vec2 begin = from.z < 0.0 ? crossing : from.xy;
    vec2 end = to.z < 0.0 ? crossing : to.xy;
    float level = penumbra_mean(begin.y, end.y);
    float seen = level > 0.01 ? min(penumbra_mean(begin.x, end.x) / level, 1.0) : 1.0;
    return vec2(seen * above, above);
}

vec3 air_shadow_at(Ray ray, float distance_m)
{
    return terrain_air_shadow(ray.direction * distance_m, altitude_at(ray, distance_m));
}

// The same over a segment. `before` is the shadow where it begins, and comes back as that of its
// end.
vec2 terrain_leaves(Ray ray, float from_m, float to_m, inout vec3 before)
{
    vec2 sum = vec2(0.0);
    int i = 1;
    do {
        float s = mix(from_m, to_m, float(i) / float(SHADOW_PARTS));
        vec3 here = air_shadow_at(ray, s);
        sum += piece_leaves(before, here);
        before = here;
        i++;
    } while (i <= SHADOW_PARTS);
    return sum / float(SHADOW_PARTS);
}
#endif

// Light that a place of a ray sends to the eye with the star behind a body.
Source eclipsed(Ray ray, Source source, float distance_m)
{
#ifdef ECLIPSE
    vec3 place = ray.direction * distance_m;
    float star = star_left(place);
    vec4 left = sky_left(place, star, altitude_at(ray, distance_m) / u_planet.y);
    // What was scattered forward comes from where the star is.
    vec3 forward = min(source.first * left.w, source.multiple);
    source.multiple = (source.multiple - forward) * left.xyz + forward * star;
    source.first *= star;
#endif
    return source;
}

// The same under, in or over clouds: the star's light as it comes through and as they spread it,
// and that of the sky.
Source clouded(Ray ray, Source source, float distance_m)
{
#ifdef CLOUDS
    vec3 place = ray.direction * distance_m;
    Deck deck = deck_toward_star(place, altitude_at(ray, distance_m));
    float sun_mu = dot(normalize(u_eye_up * u_eye.x + place), u_sun);
    source.first *= deck.direct;
    source.multiple = source.multiple * deck_left(deck) + source.even * deck_spread(deck, sun_mu);
#endif
    return source;
}

// The mean of that over a step.
Source shaded(Ray ray, Source source, float from_m, float to_m)
{
    Source sum = Source(vec3(0.0), vec3(0.0), source.even);
#ifdef CLOUDS
    for (int i = 0; i < CLOUD_PARTS; i++) {
        float s = mix(from_m, to_m, (float(i) + 0.5) / float(CLOUD_PARTS));
        Source left = clouded(ray, source, s);
        sum.first += left.first / float(CLOUD_PARTS);
        sum.multiple += left.multiple / float(CLOUD_PARTS);
    }
#else
    sum = source;
#endif
    return sum;
}

struct Sums {
    vec3 lit, all; // XYZ
};

vec4 share_of(Sums sums, float reach)
{
#ifdef CLOUDS
    // Those below send light up: there may be more.
    vec3 share = sums.all.x > 0.0 ? sums.lit / max(sums.all, vec3(1.0e-30)) : vec3(1.0);
#else
    // Exactly 1 where nothing is hidden.
    vec3 share = mix(sums.lit / max(sums.all, vec3(1.0e-30)), vec3(1.0),
                     vec3(greaterThanEqual(sums.lit, sums.all)));
#endif
    return vec4(share, reach);
}

#ifdef TO_SPACE
void add_space(Ray ray, float from, float to, inout Sums sums)
{
    float azimuth = aerial_azimuth(ray);
    float row = aerial_row(ray);
    int i = 0;
    do {
        float x = float(i) / float(SPACE_PARTS);
        float y = float(i + 1) / float(SPACE_PARTS);
        float width = (to - from) * (y * y - x * x);
        float middle = from + (to - from) * 0.5 * (x * x + y * y);
        Source source = source_at(ray, azimuth, row, middle);
        Source left = eclipsed(ray, clouded(ray, source, middle), middle);
        sums.lit += (left.first + left.multiple) * width;
        sums.all += (source.first + source.multiple) * width;
        i++;
    } while (i < SPACE_PARTS);
}
#else
// `shadow` is the terrain's where the step begins, and comes back as that of its end.
void add_step(Ray ray, float azimuth, float row, float from, float to, inout vec3 shadow,
              inout Sums sums)
{
    vec2 leaves = vec2(1.0);
#ifdef SURFACE
    leaves = terrain_leaves(ray, from, to, shadow);
#endif
    Source source = source_at(ray, azimuth, row, 0.5 * (from + to));
    Source left = eclipsed(ray, shaded(ray, source, from, to), 0.5 * (from + to));
    sums.lit += (left.first * leaves.x + left.multiple * leaves.y) * (to - from);
    sums.all += (source.first + source.multiple) * (leaves.y * (to - from));
}
#endif

void main()
{
    Ray ray = make_pixel_ray(v_uv);
    vec4 lit = texelFetch(u_lit, ivec2(gl_FragCoord.xy), 0);
    Sums sums = Sums(lit.xyz, texelFetch(u_all, ivec2(gl_FragCoord.xy), 0).xyz);
    float end = max(min(ray.end_m, lit.w), ray.begin_m);
    vec3 at = clamp(ray.begin_m + u_steps, ray.begin_m, end);
    float reach = lit.w - ray.begin_m;
#ifdef TO_SPACE
    if (at.z > at.x) {
        add_space(ray, at.x, at.z, sums);
    }
    out_first = share_of(sums, reach);
#else
    float azimuth = aerial_azimuth(ray);
    float row = aerial_row(ray);
    vec3 shadow = vec3(0.0);
#ifdef SURFACE
    shadow = air_shadow_at(ray, at.x);
#endif
    add_step(ray, azimuth, row, at.x, at.y, shadow, sums);
    out_first = share_of(sums, reach);
    add_step(ray, azimuth, row, at.y, at.z, shadow, sums);
    out_second = share_of(sums, reach);
#endif
    out_lit = vec4(sums.lit, lit.w);
    out_all = vec4(sums.all, 0.0);
}
