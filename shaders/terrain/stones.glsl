// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Stones on made-up ground, of octaves of its noise: part of terrain/noise.glsl. They have a
// colour, a normal and a shadow, and take light from what is about their feet; the ground is not
// moved.
#include "shared/relief.glsl"

struct Stones {
    vec3 up, sun;      // unit, local axes
    float climate;     // -1 dry to 1 wet
    float part, cover; // of the place that they cover, and those that are seen of ground like it
    vec3 slope;        // m per m
    float open, lit;   // what they leave of an even sky, and of the sun
};

Stones stones;

void stones_begin(vec3 up, float climate)
{
    stones.up = up;
    stones.climate = climate;
    stones.part = 0.0;
    stones.cover = 0.0;
    stones.slope = vec3(0.0);
    stones.open = 1.0;
    stones.lit = 1.0;
}

// A stone near by: the noise's direction toward its top, unit; how far that and its edge are, how
// high it is, m.
struct Stone {
    vec3 toward;
    float from, radius, high;
};

Stone stone_near(NoiseValue n, vec3 gradient, float level, float wave)
{
    float slope = length(gradient) * wave;
    float top = relief_stone_top(n.value, slope);
    return Stone(gradient * (wave / max(slope, 1e-6)), relief_stone_from(n.value, top) * wave,
                 relief_stone_from(level, max(top, level)) * wave,
                 min(RELIEF_STONE_HIGH * max(top - level, 0.0), RELIEF_STONE_HIGHEST) * wave);
}

// What it leaves of the sun: its outline is a parabola, whose shadow is as long as it is high, over
// the tangent of the sun's elevation. `blur` in m.
float stone_shadow(Stone stone, float blur)
{
    float sine = dot(stones.sun, stones.up);
    vec3 level = stones.sun - sine * stones.up;
    float cosine = max(length(level), 1e-4);
    float along = dot(level, stone.toward) / cosine * stone.from;
    float aside2 = stone.from * stone.from - along * along;
    float outline = stone.high * (1.0 - aside2 / max(stone.radius * stone.radius, 1e-8));
    float reach = outline * cosine / max(sine, 0.02) - along;
    return along > 0.0 ? 1.0 - smoothstep(-blur, blur, min(reach, outline)) : 1.0;
}

// Of an octave of noise `n`, with its gradient per m; lengths in m. `past`: what those before make
// of the place.
void stones_add(NoiseValue n, float log2_wave, float log2_footprint, float past, float soil)
{
    // Where one lies there is no smaller one.
    float seen = soil * relief_seen(log2_wave - 1.0, log2_footprint) * (1.0 - stones.part);
    float wave = exp2(log2_wave);
    float level = relief_stone_level(log2_wave, clamp(past - stones.climate, -1.0, 1.0));
    vec3 gradient = vec3(n.x, n.y, n.z);
    gradient -= stones.up * dot(gradient, stones.up);
    Stone stone = stone_near(n, gradient, level, wave);
    float pixel = exp2(log2_footprint);
    float edge = max(length(gradient) * pixel, 0.02);
    float part = seen * clamp((n.value - level) / edge + 0.5, 0.0, 1.0);
    stones.part += part;
    stones.cover += seen * relief_stone_cover(level);
    stones.slope = mix(stones.slope, wave * RELIEF_STONE_HIGH * gradient, part);

    // About its foot, as far as the octave tells where it is.
    float near = (seen - part) * (1.0 - smoothstep(0.25, 0.35, stone.from / wave));
    // Its shade under a sky goes before it does: a pixel across, it would be a ring.
    float wide = relief_seen(log2_wave - 2.0, log2_footprint);
    stones.open *= 1.0 - wide * near * relief_stone_hides(stone.high, stone.radius, stone.from);
    stones.lit *= mix(1.0, stone_shadow(stone, max(pixel, 0.02 * wave)), near);
}
