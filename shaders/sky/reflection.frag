// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Terrain that open water mirrors, for every second pixel: rays of a few facets are followed in the
// picture, from the water to the pixel whose ground hides them: docs/physics.md, *The sea*.

#include "shared/fresnel.glsl"
#include "sky/ray.glsl"

uniform sampler2D u_position; // as in sky/ground.glsl
uniform sampler2D u_albedo;   // a: part that is open water
uniform sampler2D u_radiance; // what is drawn but for open water: of it only the air before it
uniform sampler2D u_near;     // nearest land in squares of 1, 4, 16 and 64 pixels, beside another
uniform sampler2D u_land;     // of sky/reflection_land.frag
uniform vec2 u_rectangle;     // pixels of one of its texels
uniform vec3 u_sea;           // as in sky/sea.glsl
uniform sampler2D u_facets;   // as in sky/sea.glsl

// Radiance less that of the air before the water, times the part of the mirrored light that comes
// from terrain; that part, or below 0 where there is no water.
layout(location = 0) out vec4 out_reflection;
// How large the facets are toward the eye, times their reflectance.
layout(location = 1) out float out_weight;

const int FACETS_FOLLOWED = 2;
const int LOOKS = 64;          // at squares, for a ray
const float FAR_M = 1.0e6;     // where rays end
const float STEP = 0.01;       // into the next square, pixels
const float BEHIND = 1.0e-5;   // relative: rounding of distances
const float THICKNESS = 0.1;   // relative: what is farther behind an edge passes behind it
const float BEYOND = 0.5;      // relative: so far behind the ray nothing is known of ground that
                               // goes on beyond the border
const float HIGHEST_M = 1.0e4; // above a sea no ground stands as high
// A ray in the picture: x and y in pixels, and 1 / distance along the view's axis, all linear.
struct Way {
    vec3 from, step;    // step: for a pixel along the longer side
    float end;          // in steps
    bool leaves;        // the picture, there
    float metres;       // steps times this, over 1 / distance where they end, are the way's length
    float radius, sine; // of the water, from the planet's centre; of the ray's elevation there
};

vec3 picture_at(vec3 point, vec2 size)
{
    float inverse = 1.0 / dot(point, u_forward);
    vec2 at = vec2(dot(point, u_right) / dot(u_right, u_right), dot(point, u_up) / dot(u_up, u_up));
    return vec3((at * inverse * 0.5 + 0.5) * size, inverse);
}

Way find_way(vec3 water, vec3 direction, vec2 size)
{
    float start = dot(water, u_forward);
    float away = dot(direction, u_forward);
    float reach = away < 0.0 ? min(-0.9 * start / away, FAR_M) : FAR_M;
    Way way;
    way.from = picture_at(water, size);
    vec3 across = picture_at(water + reach * direction, size) - way.from;
    float count = max(max(abs(across.x), abs(across.y)), 1.0e-3);
    way.step = across / count;
    vec2 room = mix(way.from.xy, size - way.from.xy, step(vec2(0.0), across.xy)) /
                max(abs(way.step.xy), vec2(1.0e-9));
    float border = max(min(room.x, room.y) - 2.0 * STEP, 0.0);
    way.leaves = border < count;
    way.metres = reach / count * (way.from.z + across.z);
    vec3 centre = u_eye_up * u_eye.x + water;
    way.radius = length(centre);
    way.sine = dot(centre, direction) / way.radius;
    way.end = min(border, count);
    return way;
}

// Where squares of 4^level pixels are in u_near: sky/reflection.c lays them out alike.
ivec2 square_texel(ivec2 square, int level, ivec2 size)
{
    ivec2 fours = (size + 3) / 4;
    int column = level == 3 ? fours.x + (fours.x + 3) / 4 : level == 2 ? fours.x : 0;
    return square + (level > 0 ? ivec2(column, size.y) : ivec2(0));
}

// How high a ray is over the water where it ends.
float rise_of(Way way)
{
    float along = way.metres * way.end / (way.from.z + way.step.z * way.end);
    float more = 2.0 * way.radius * way.sine * along + along * along;
    return more / (way.radius + sqrt(max(way.radius * way.radius + more, 0.0)));
}

// The pixel that the ray meets, and in z how much of the light is terrain's.
vec3 follow(Way way, ivec2 size)
{
    float s = 0.0;
    float known = 0.0;
    int level = 1;
    vec2 slow = max(abs(way.step.xy), vec2(1.0e-6));
    vec2 ahead = step(vec2(0.0), way.step.xy);
    int i = 0;
    bool goes_on;
    do {
        float side = float(1 << (2 * level));
        vec3 at = way.from + way.step * (s + STEP);
        vec2 square = floor(at.xy / side);
        vec2 rest = abs((square + ahead) * side - at.xy) / slow;
        float next = s + STEP + min(rest.x, rest.y);
        float leave = way.from.z + way.step.z * min(next, way.end);
        float nearest = texelFetch(u_near, square_texel(ivec2(square), level, size), 0).x;
        bool may_hide = min(at.z, leave) * (1.0 + BEHIND) < nearest;
        bool is_pixel = level == 0;
        known =
            s < way.end && may_hide && is_pixel && at.z * (1.0 + THICKNESS) > nearest ? 1.0 : 0.0;
        i++;
        if (known < 0.5) {
            bool is_past = is_pixel || !may_hide;
            s = is_past ? next : s;
            level = is_past ? min(level + 1, 3) : level - 1;
        }
        goes_on = known < 0.5 && s < way.end && i < LOOKS;
    } while (goes_on);
    vec3 at = way.from + way.step * (min(s, way.end) + STEP);
    ivec2 pixel = clamp(ivec2(at.xy), ivec2(0), size - 1);
    // Ground that the border cuts goes on there, the less surely the higher above it the ray is.
    // From space all coasts at the border lay in the way of rays that went up beside them.
    float nearest = texelFetch(u_near, pixel, 0).x;
    float gap = at.z / max(nearest, 1.0e-9) - 1.0;
    float guess =
        way.leaves && s >= way.end && gap > -THICKNESS ? 1.0 - smoothstep(0.0, BEYOND, gap) : 0.0;
    guess *= 1.0 - smoothstep(0.5, 1.0, rise_of(way) / HIGHEST_M);
    return vec3(vec2(pixel), max(known, guess));
}

// Slopes along the view for equal shares of all facets, over the root of half the mean square
// slope: the logistic law in place of the normal one. The 16 texels of a square take different
// ones, by the bits of their places in turn.
float slope_of(int facet, ivec2 texel)
{
    ivec2 low = texel & 1;
    ivec2 high = (texel >> 1) & 1;
    int order = 8 * (low.x ^ low.y) + 4 * low.y + 2 * (high.x ^ high.y) + high.y;
    float share = (float(facet) + (float(order) + 0.5) / 16.0) / float(FACETS_FOLLOWED);
    return log(share / (1.0 - share)) * (1.0 / 1.702);
}

// Of land at a pixel; where facets spread the image, of the land around it (`spread` 1), so that
// bright places are not seen once for each facet.
vec3 land_at(vec2 pixel, float spread)
{
    vec2 at = (pixel + 0.5) / u_rectangle - 0.5;
    ivec2 first = ivec2(floor(at));
    ivec2 last = textureSize(u_land, 0) - 1;
    vec2 part = at - vec2(first);
    vec4 sum = vec4(0.0);
    for (int n = 0; n < 4; n++) {
        ivec2 offset = ivec2(n & 1, n >> 1);
        vec2 near = mix(1.0 - part, part, vec2(offset));
        sum += texelFetch(u_land, clamp(first + offset, ivec2(0), last), 0) * (near.x * near.y);
    }
    vec3 own = texelFetch(u_radiance, ivec2(pixel), 0).rgb;
    return mix(own, sum.rgb / max(sum.a, 1.0e-6), sum.a > 0.0 ? spread : 0.0);
}

struct Mirrored {
    vec4 light; // as out_reflection
    float weight;
};

Mirrored reflection(ivec2 pixel, ivec2 size)
{
    vec3 water = texelFetch(u_position, pixel, 0).xyz;
    vec3 direction = normalize(water);
    vec3 up = normalize(u_eye_up * u_eye.x + water);
    vec4 waves = texelFetch(u_facets, pixel, 0);
    vec3 normal = normalize(waves.xyz);
    float mss = waves.w;
    vec3 air = texelFetch(u_radiance, pixel, 0).rgb;
    vec3 toward = up * dot(direction, up) - direction;
    toward /= max(length(toward), 1.0e-6);
    float spread = clamp(sqrt(mss) / (u_rectangle.y * u_disc.z) - 0.5, 0.0, 1.0);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < FACETS_FOLLOWED; i++) {
        vec3 facet = normalize(normal + toward * (slope_of(i, pixel / 2) * sqrt(0.5 * mss)));
        float seen = -dot(facet, direction);
        vec3 mirrored = direction + 2.0 * seen * facet;
        float weight = seen > 0.0 && dot(mirrored, up) > 0.0
                           ? seen * fresnel_reflectance(seen, u_sea.y) + 1.0e-6
                           : 0.0;
        vec3 met = follow(find_way(water, mirrored, vec2(size)), size);
        vec3 light = max(land_at(met.xy, spread) - air, vec3(0.0));
        sum += vec4(light, 1.0) * (met.z * weight);
        weights += weight;
    }
    return Mirrored(sum / max(weights, 1.0e-6), weights);
}

void main()
{
    ivec2 size = textureSize(u_position, 0);
    ivec2 first = 2 * ivec2(gl_FragCoord.xy);
    ivec2 pixel = first;
    float most = 0.0;
    for (int n = 0; n < 4; n++) {
        ivec2 other = min(first + ivec2(n & 1, n >> 1), size - 1);
        float water = texelFetch(u_albedo, other, 0).a;
        pixel = water > most ? other : pixel;
        most = max(most, water);
    }
    Mirrored mirrored = Mirrored(vec4(0.0, 0.0, 0.0, -1.0), 0.0);
    if (most > 0.0) {
        mirrored = reflection(pixel, size);
    }
    out_reflection = mirrored.light;
    out_weight = mirrored.weight;
}
