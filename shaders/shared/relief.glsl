// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_RELIEF_GLSL
#define SHARED_RELIEF_GLSL
// Octaves of noise become relief: from the longest down, each knowing what those before it made.
// Heights in m, gradients in m per m, along any axes. docs/physics.md, section 26.
#include "shared/noise.glsl"

// Mean square of the gradient of noise, per squared lattice unit.
#define RELIEF_SLOPE2 3.0

// And of noise itself.
#define RELIEF_HEIGHT2 0.05

// Part of a gully's slope that smaller gullies follow.
#define RELIEF_FORK 0.5

// An octave's value within this, and what it is multiplied by.
#define RELIEF_VALUE_BOUND 1.35
#define RELIEF_WEIGHT_BOUND 2.0
#define RELIEF_WEIGHT_LEAST 0.15

SHARED_STRUCT(Relief)
{
    Number height;
    Number x, y, z;                // its gradient
    Number fall_x, fall_y, fall_z; // what gullies follow; then the slope of what is no soil
    // Values of the octaves before, fading by a half: over ridges above 0, in valleys below. And
    // the gradient.
    Number past, past_x, past_y, past_z;
    Number tone;           // for colours: a sum of values
    Length shore;          // how far shores are off: a sum of values times their wavelengths
    Number cutting;        // of the slope that noise and gullies leave, for what is finer
    Number unseen;         // variance of the slopes of octaves that the footprint hides
    Number unseen_height2; // and of their heights, m^2
    Number passing;        // height that the footprint's mean has not, m
};

SHARED_FN Relief relief_of(Number height, Number x, Number y, Number z)
{
    Relief r;
    r.height = height;
    r.x = x;
    r.y = y;
    r.z = z;
    r.fall_x = x;
    r.fall_y = y;
    r.fall_z = z;
    r.past = 0.0;
    r.past_x = 0.0;
    r.past_y = 0.0;
    r.past_z = 0.0;
    r.tone = 0.0;
    r.shore = 0.0;
    r.cutting = 1.0;
    r.unseen = 0.0;
    r.unseen_height2 = 0.0;
    r.passing = 0.0;
    return r;
}

// What it is so far is what lies on it knows.
SHARED_FN Relief relief_stand(Relief r)
{
    r.fall_x = r.x;
    r.fall_y = r.y;
    r.fall_z = r.z;
    return r;
}

// Adds a slope.
SHARED_FN Relief relief_lean(Relief r, Number x, Number y, Number z)
{
    r.x += x;
    r.y += y;
    r.z += z;
    r.fall_x += x;
    r.fall_y += y;
    r.fall_z += z;
    return r;
}

SHARED_FN Number relief_smooth(Number low, Number high, Number x)
{
    Number t = shared_clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// How much of an octave a footprint shows: none below two of its widths, all above four. Logarithms
// to base 2 of lengths in m.
SHARED_FN Number relief_seen(Number log2_wave, Number log2_footprint)
{
    return relief_smooth(1.0, 2.0, log2_wave - log2_footprint);
}

// Part of an octave in the tone: all from 250 m on, half of what is small.
SHARED_FN Number relief_tone(Number log2_wave)
{
    return shared_clamp(0.6 + 0.05 * log2_wave, 0.45, 1.0);
}

// How much of an octave data lack: all from two texels down, none above four.
SHARED_FN Number relief_lacking(Number log2_wave, Number log2_texel)
{
    return 1.0 - relief_smooth(1.0, 2.0, log2_wave - log2_texel);
}

// What data resolve, log2 of sizes in m: the layer on top, and what lies below it where it covers
// only a part.
SHARED_STRUCT(ReliefData)
{
    Number top, below, part;
};

// Toward the border of a fine layer octaves fade as its heights do: by its part, each of them. By a
// size between the two they would end one after the other, the largest, whose heights are hundreds
// of metres, within a few steps.
SHARED_FN Number relief_lacking_of(Number log2_wave, ReliefData data)
{
    Number below = relief_lacking(log2_wave, data.below);
    return below + data.part * (relief_lacking(log2_wave, data.top) - below);
}

// Amplitude by altitude: none at 0, all from `full` m on; full = 0: all everywhere.
SHARED_FN Number relief_fullness(Number height, Number full)
{
    return full > 0.0 ? relief_smooth(0.0, 1.0, shared_abs(height) / full) : 1.0;
}

// Folded noise: a ridge where the noise is 0. Of the same deviation as the noise, and mean 0.
SHARED_FN NoiseValue relief_fold(NoiseValue n, Number ridged)
{
    Number size = sqrt(n.value * n.value + 0.0012);
    Number turn = (1.0 - ridged) - ridged * 1.6 * n.value / size;
    NoiseValue v;
    v.value = (1.0 - ridged) * n.value + ridged * 1.6 * (0.178 - size);
    v.x = turn * n.x;
    v.y = turn * n.y;
    v.z = turn * n.z;
    return v;
}

// Adds an octave of `size` m; `v` with its gradient per m. `rough`: its size for slopes, with soil.
// `contrast`: how much rougher ridges are than valleys.
SHARED_FN Relief relief_add(Relief r, NoiseValue v, Number size, Number rough, Number contrast)
{
    // With a continuous derivative: gullies follow the gradient, and would break where it jumps.
    Number t = shared_clamp(0.45 + 0.3 * contrast * r.past, 0.0, 1.0);
    Number range = RELIEF_WEIGHT_BOUND - RELIEF_WEIGHT_LEAST;
    Number weight = RELIEF_WEIGHT_LEAST + range * t * t * (3.0 - 2.0 * t);
    Number rate = range * 6.0 * t * (1.0 - t) * 0.3 * contrast * v.value;
    r.height += size * weight * v.value;
    r.x += rough * (weight * v.x + rate * r.past_x);
    r.y += rough * (weight * v.y + rate * r.past_y);
    r.z += rough * (weight * v.z + rate * r.past_z);
    r.past = 0.5 * r.past + v.value;
    r.past_x = 0.5 * r.past_x + v.x;
    r.past_y = 0.5 * r.past_y + v.y;
    r.past_z = 0.5 * r.past_z + v.z;
    return r;
}

// What a slope lets water cut: nothing on level ground.
SHARED_FN Number relief_cutting(Number slope2)
{
    return slope2 / (slope2 + 0.02);
}

// Adds an octave of gullies down the slope. They are cut: mean below 0, floors as sharp as crests.
SHARED_FN Relief relief_cut(Relief r, NoiseValue v, Number size)
{
    r.height += size * v.value;
    r.x += size * v.x;
    r.y += size * v.y;
    r.z += size * v.z;
    r.fall_x += RELIEF_FORK * size * v.x;
    r.fall_y += RELIEF_FORK * size * v.y;
    r.fall_z += RELIEF_FORK * size * v.z;
    r.past = 0.5 * r.past + 0.3 * v.value;
    r.past_x = 0.5 * r.past_x + 0.3 * v.x;
    r.past_y = 0.5 * r.past_y + 0.3 * v.y;
    r.past_z = 0.5 * r.past_z + 0.3 * v.z;
    return r;
}

// Stones and soil make no slope: what lies on the ground knows that of waves longer than this, as
// log2 of m.
#define RELIEF_STAND_LOG2 1.0

// Soil and gravel are rough whatever mountains are. Over lengths d from metres down natural ground
// deviates by about d^0.6, with some degrees at 1 m (Shepard et al. 2001, J. Geophys. Res. 106,
// 32777: Hurst exponents of 0.4 to 0.7, on Earth and Mars). It is seen by its slopes: as heights,
// an eye near the ground would want meshes of centimetres. `soil`: 1 on dry ground.
#define RELIEF_SOIL_LOG2 6.0
SHARED_FN Number relief_soil_size(Number size, Number log2_wave, Number soil)
{
    Number least = log2_wave > RELIEF_SOIL_LOG2 ? 0.0 : 0.05 * soil * exp2(0.6 * log2_wave);
    return shared_max(size, least);
}

// Where mountains have an amplitude in m of nothing, water lies.
SHARED_FN Number relief_soil(Number amplitude)
{
    return shared_min(0.2 * amplitude, 1.0);
}

// Heights know no more of a place than its direction: their octaves are drawn out down a cliff, by
// 1 / cos(slope). From 35 to 55 degrees on rock has octaves of its own, of the place in space.
SHARED_FN Number relief_rock(Number slope)
{
    return relief_smooth(0.7, 1.4, slope);
}

// The longest of them, as log2 of m, and how large those of `size` m are: broken rock at least.
#define RELIEF_ROCK_LOG2 4.0
SHARED_FN Number relief_rock_size(Number size, Number log2_wave)
{
    return shared_max(size, 0.04 * exp2(log2_wave));
}

// What they make of a normal: `n` is their gradient, per m, times their sizes.
SHARED_STRUCT(RockNormal)
{
    Number x, y, z;
};
SHARED_FN RockNormal relief_rock_normal(RockNormal normal, NoiseValue n)
{
    Number along = normal.x * n.x + normal.y * n.y + normal.z * n.z;
    RockNormal r;
    r.x = normal.x * (1.0 + along) - n.x;
    r.y = normal.y * (1.0 + along) - n.y;
    r.z = normal.z * (1.0 + along) - n.z;
    Number size = sqrt(r.x * r.x + r.y * r.y + r.z * r.z);
    r.x /= size;
    r.y /= size;
    r.z /= size;
    return r;
}

// Stones are where an octave is above a level. About a high level the tops of a random surface of
// deviation d and of slopes d_x along each axis are paraboloids, n = h (1 - r^2 d_x^2 / (2 d^2)):
// here h (1 - 10 r^2), r in wavelengths. From waves of 1 m on stones are ever fewer, as the areas
// that rocks of a size cover are (Golombek and Rapp 1997, J. Geophys. Res. 102, 4117, Eq. 2-4).
// `stony`: -1 to 1.
#define RELIEF_STONE_LOG2 2.0
#define RELIEF_STONE_BEND (RELIEF_SLOPE2 / 3.0 / (2.0 * RELIEF_HEIGHT2))
SHARED_FN Number relief_stone_level(Number log2_wave, Number stony)
{
    return 0.48 - 0.12 * stony + 0.06 * shared_max(log2_wave, 0.0);
}

// The paraboloid's top, where the noise is `value` and its slope, per wavelength, `slope`.
SHARED_FN Number relief_stone_top(Number value, Number slope)
{
    Number more = slope * slope / RELIEF_STONE_BEND;
    return 0.5 * (value + sqrt(value * value + more));
}

// And how far from it a value is, in wavelengths.
SHARED_FN Number relief_stone_from(Number value, Number top)
{
    return sqrt(shared_max(1.0 - value / top, 0.0) / RELIEF_STONE_BEND);
}

// Height of a stone for each of the noise's above the level, in wavelengths, and of a flat one.
#define RELIEF_STONE_HIGH 1.1
#define RELIEF_STONE_HIGHEST 0.18

// The part of the ground that is above a level: the tail of a normal distribution (Bowling et al.
// 2009, J. Ind. Eng. Manag. 2, 114), of the noise's deviation.
SHARED_FN Number relief_stone_cover(Number level)
{
    Number x = level / sqrt(RELIEF_HEIGHT2);
    return 1.0 / (1.0 + exp(x * (1.5976 + 0.070566 * x * x)));
}

// What a stone, high * (1 - r^2 / radius^2), takes of an even sky's light on level ground `from`
// its middle. Its tangent from there rises by `steep`; at the foot, where that is the stone's own
// slope, the ground has lost as much as the stone, (1 - cos e) / 2. Farther off fewer azimuths are
// lost: the power is fitted, to 0.02.
SHARED_FN Number relief_stone_hides(Number high, Number radius, Number from)
{
    Number reach = shared_max(radius, 1e-6);
    Number away = shared_max(from / reach, 1.0);
    Number steep = 2.0 * high / reach * (away - sqrt(away * away - 1.0));
    return (0.5 - 0.5 / sqrt(1.0 + steep * steep)) / (away * sqrt(away));
}

#endif // SHARED_RELIEF_GLSL
