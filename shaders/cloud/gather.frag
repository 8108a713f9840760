// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clouds of every second pixel of which a quarter was marched in this frame: those are taken as
// they are, the others from where the same cloud was in the frame before, within what their
// neighbours of this frame show. What was out of sight then is taken from those, as far as their
// rays end about where its own does.
// validate: SURFACE

#include "cloud/ends.glsl"

in vec2 v_uv;

uniform vec3 u_grid; // of the marched: first texel, each way; distance between them
uniform sampler2D u_fresh;
uniform sampler2D u_fresh_ends; // logarithms: how far what is seen is, ray_end
uniform sampler2D u_past;
uniform vec3 u_moved;        // the eye since the frame before, m
uniform vec3 u_past_forward; // axes of that camera: a place there, over its depth, in [-1, 1]
uniform vec3 u_past_right;
uniform vec3 u_past_up;
uniform float u_is_still; // 1: nothing has moved since then

layout(location = 0) out vec4 out_clouds;
layout(location = 1) out vec2 out_ends; // cloud/rays.h

const float SLACK = 0.1;    // of the neighbours' range, that what is finer than they are may have
const float FAR_OFF = 0.25; // of a distance, that it may be wrong between rays

// Between the texels of the past, at a place in them.
vec4 look_back(vec2 at)
{
    ivec2 last = textureSize(u_past, 0) - 1;
    vec2 first = floor(at);
    vec2 part = at - first;
    vec4 sum = vec4(0.0);
    for (int n = 0; n < 4; n++) {
        ivec2 corner = ivec2(n & 1, n >> 1);
        vec2 near = mix(1.0 - part, part, vec2(corner));
        sum +=
            texelFetch(u_past, clamp(ivec2(first) + corner, ivec2(0), last), 0) * (near.x * near.y);
    }
    return sum;
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 offset = ivec2(u_grid.xy);
    ivec2 last = textureSize(u_fresh, 0) - 1;
    // Marched texels around: nearest, and four corners of a cell.
    ivec2 nearest = clamp((texel - offset + 1) / 2, ivec2(0), last);
    ivec2 first = (texel - offset + 2) / 2 - 1;
    vec2 part = vec2(texel - offset - 2 * first) * 0.5;
    float own = find_end(2 * texel);
    vec4 between = vec4(0.0);
    float distance_log = 0.0;
    float weights = 0.0;
    for (int n = 0; n < 4; n++) {
        ivec2 corner = ivec2(n & 1, n >> 1);
        ivec2 at = clamp(first + corner, ivec2(0), last);
        vec2 near = mix(1.0 - part, part, vec2(corner));
        vec2 ends = texelFetch(u_fresh_ends, at, 0).xy;
        float weight = (near.x * near.y + 1.0e-4) * cloud_alike(ends.y, own);
        between += texelFetch(u_fresh, at, 0) * weight;
        distance_log += ends.x * weight;
        weights += weight;
    }
    between /= weights;
    vec4 least = between;
    vec4 most = between;
    for (int n = 0; n < 9; n++) {
        ivec2 at = clamp(nearest + ivec2(n % 3, n / 3) - 1, ivec2(0), last);
        bool is_alike = cloud_alike(texelFetch(u_fresh_ends, at, 0).y, own) > 0.5;
        vec4 fresh = is_alike ? texelFetch(u_fresh, at, 0) : between;
        least = min(least, fresh);
        most = max(most, fresh);
    }
    vec2 pixel = min(2.0 * vec2(texel), u_picture - 1.0) + 0.5;
    Ray ray = make_pixel_ray(pixel / u_picture);
    float distance_m = exp(distance_log / weights);
    vec3 before = ray.direction * distance_m + u_moved;
    float depth = dot(before, u_past_forward);
    vec2 seen = vec2(dot(before, u_past_right), dot(before, u_past_up)) / max(depth, 1.0e-6);
    vec2 past_texel = (0.5 * seen + 0.5) * u_picture * 0.5 - 0.25;
    bool is_seen = depth > 0.0 && max(abs(seen.x), abs(seen.y)) < 1.0;
    vec4 past = look_back(u_is_still > 0.5 ? vec2(texel) : past_texel);
    vec4 slack = SLACK * (most - least);
    vec4 held = clamp(past, least - slack, most + slack);
    float off = length(u_moved) / distance_m * FAR_OFF / (2.0 * u_disc.z);
    float trust = 1.0 / (1.0 + off * off);
    past = u_is_still > 0.5 ? past : mix(between, held, trust);
    past.a = clamp(past.a, 0.0, 1.0);
    bool is_fresh =
        all(equal((texel - offset) % 2, ivec2(0))) && all(greaterThanEqual(texel, offset));
    vec4 fresh = texelFetch(u_fresh, clamp((texel - offset) / 2, ivec2(0), last), 0);
    out_clouds = is_fresh ? fresh : (is_seen || u_is_still > 0.5) ? past : between;
    out_ends = vec2(0.0, own);
}
