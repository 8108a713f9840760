// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Density and light of clouds, from what the noise volume, the weather and the height say.
// Noise values are evenly distributed over [0, 1], so that a part `cover` of them is above
// 1 - cover. A place that is looked at from afar stands for a box of values: `noise` is their mean,
// and they are taken as even over noise +- spread (0: a point). Heights are parts of the layer.
// docs/physics.md, section 29.
#ifndef SHARED_CLOUD_GLSL
#define SHARED_CLOUD_GLSL

#include "shared/shared.glsl"

// The finer noise of the edges is the same volume in tiles that are smaller by this, which no small
// number of tiles makes whole.
#define CLOUD_DETAIL_TILES 6.137

// Michelic 2019, Eq. 13: 0 at the base and the top, 1 at `peak`; the parabola is his where that is
// in the middle, else each side is stretched. With a peak at 0 a layer lies on what is below it.
SHARED_FN Number cloud_height_signal(Number height, Number peak)
{
    Number x = shared_clamp(height, 0.0, 1.0);
    Number side = shared_abs(x - peak) / (x < peak ? peak : 1.0 - peak);
    return height < 0.0 ? 0.0 : 1.0 - side * side;
}

// Clouds of many heights hide more of the sky than of any level: what of one makes a cover of the
// whole. The exponent is measured on columns through the layer, 0.6 for cumulus, 1 for flat layers.
SHARED_FN Number cloud_level_cover(Number cover, Number overlap)
{
    return 1.0 - pow(shared_max(1.0 - cover, 1.0e-6), overlap);
}

// The same volume in tiles that are larger by this gathers clouds into fields, and in still larger
// ones, along other axes, these into regions, which hides that tiles repeat. Both noises move the
// odds of cloud, so that none stays none and all stays all.
#define CLOUD_FIELD_TILES 5.31
#define CLOUD_WIDE_TILES 37.7
SHARED_FN Number cloud_gathered_cover(Number cover, Number noise, Number wide)
{
    Number odds = exp(2.2 * (noise + wide - 1.0));
    return cover * odds / (1.0 - cover + cover * odds);
}

// Weather systems are a third of their tiles, as the largest clouds are of theirs, and twice as
// long along circles of latitude as across; their odds are those of fields and regions together.
#define CLOUD_SYSTEM_TILES 3.0
#define CLOUD_SYSTEM_STRETCH 2.0

// Tiles are bent by a field of sines, each along an axis of its own, that no two look alike. Their
// wavelength and amplitude are these numbers of tiles; a metre becomes at most
// 1 + 2 pi amplitude / wavelength, 1.31, of noise.
#define CLOUD_BEND_WAVE 8.15
#define CLOUD_BEND 0.4
#define CLOUD_BEND_STRAIN 1.31

// The noise of fibres has circles about the planet's axis as its third axis, along which its tiles
// are longer by this; the finer noise has them longer by still more.
#define CLOUD_FIBRE_STRETCH 7.0
#define CLOUD_FIBRE_DETAIL_TURNS 2.0

// atan2 within 2e-4, with the same steps on CPU and GPU and without its cost.
SHARED_FN Angle cloud_longitude(Length y, Length x)
{
    Length most = shared_max(shared_max(shared_abs(x), shared_abs(y)), 1.0e-9);
    Number t = shared_min(shared_abs(x), shared_abs(y)) / most;
    Number t2 = t * t;
    Number a =
        ((((0.0208351 * t2 - 0.085133) * t2 + 0.180141) * t2 - 0.3302995) * t2 + 0.999866) * t;
    Number b = shared_abs(y) > shared_abs(x) ? 0.5 * SHARED_PI - a : a;
    Number c = x < 0.0 ? SHARED_PI - b : b;
    return y < 0.0 ? -c : c;
}

// How far the foot of a streak is behind its head, which the wind above drags along: m for a
// `shear` in m at the base.
SHARED_FN Length cloud_lag(Number height, Length shear)
{
    Number below = 1.0 - shared_clamp(height, 0.0, 1.0);
    return shear * below * below;
}

// Noise in a box: its mean, and its spread around that.
SHARED_STRUCT(CloudNoise)
{
    Number value, spread;
};

// How far apart the least and the most are that the finer noise makes of a value. What it makes
// stays in order and in [0, 1], and is moved by as much at most values.
SHARED_FN Number cloud_finer_range(Number noise, Number weight)
{
    return shared_min(weight, 2.0 * noise * (1.0 - noise));
}

SHARED_FN Number cloud_most_noise(Number noise, Number weight)
{
    return noise + 0.5 * cloud_finer_range(noise, weight);
}

// Both noises. The finer one is folded at its median, |2 n - 1|, which is as evenly distributed:
// so surfaces are round outward with creases between, as heads of cumulus are. In a box where it is
// even over +- s with the mean x, both after 2 n - 1, the mean of |x| is (x^2 + s^2) / (2 s) within
// s of the crease, and that of x^2 is x^2 + s^2 / 3.
SHARED_FN CloudNoise cloud_joint_noise(CloudNoise noise, CloudNoise finer, Number weight)
{
    Number x = shared_abs(2.0 * finer.value - 1.0);
    Number s = shared_max(shared_min(2.0 * finer.spread, 1.0 - x), 1.0e-4);
    Number folded = x > s ? x : (x * x + s * s) / (2.0 * s);
    Number folded_spread2 = 3.0 * (x * x - folded * folded) + s * s;
    Number range = cloud_finer_range(noise.value, weight);
    CloudNoise joint;
    joint.value = noise.value + (folded - 0.5) * range;
    joint.spread = shared_min(sqrt(noise.spread * noise.spread + range * range * folded_spread2),
                              shared_min(joint.value, 1.0 - joint.value));
    return joint;
}

// How far clouds and gaps reach along a ray, in a layer of tiles of `scale`, where a box is wider:
// a fourteenth is the size of the billows that are cut out of the larger shapes.
SHARED_FN Length cloud_clump(Length thickness, Length scale, Length box)
{
    return shared_min(shared_min(0.5 * thickness, 0.07 * scale), box);
}

// Noise above this is cloud.
SHARED_FN Number cloud_threshold(Number cover, Number signal)
{
    return 1.0 - shared_clamp(cover, 0.0, 1.0) * signal;
}

// Mean of max(x + u, 0) for u even over [-spread, spread].
SHARED_FN Number cloud_ramp(Number x, Number spread)
{
    Number s = shared_max(spread, 1.0e-4);
    Number y = shared_clamp(x + s, 0.0, 2.0 * s);
    return y * y / (4.0 * s) + shared_max(x - s, 0.0);
}

// Mean density in [0, 1] of a box whose noise is `x` above the threshold in the mean. A cloud is as
// dense as it gets where noise is beyond the threshold by `edge`.
SHARED_FN Number cloud_density(Number x, Number spread, Number edge)
{
    return (cloud_ramp(x, spread) - cloud_ramp(x - edge, spread)) / edge;
}

// The part of the box that is cloud.
SHARED_FN Number cloud_part(Number x, Number spread)
{
    Number s = shared_max(spread, 1.0e-4);
    return shared_clamp((x + s) / (2.0 * s), 0.0, 1.0);
}

// Extinction that lets through in the mean what a box of clouds and gaps does: with the optical
// depth t of a way of `length` through cloud, 1 - part + part exp(-t) of it. Without gaps it is the
// density times `extinction`.
SHARED_FN PerLength cloud_extinction(Number density, Number part, PerLength extinction,
                                     Length length)
{
    Number inside = density / shared_max(part, 1.0e-4);
    Number left = 1.0 - part + part * exp(-extinction * inside * length);
    PerLength broken = -log(shared_max(left, 1.0e-6)) / length;
    return part > 0.999 ? density * extinction : broken;
}

// Two lobes of Henyey and Greenstein (1941): droplets scatter forward, and back a little.
SHARED_FN Number cloud_lobe(Number cos_angle, Number g)
{
    Number base = 1.0 + g * g - 2.0 * g * cos_angle;
    return (1.0 - g * g) / (4.0 * SHARED_PI * base * sqrt(base));
}

#define CLOUD_FORWARD_G 0.88
#define CLOUD_BACK_G -0.4
#define CLOUD_BACK_SHARE 0.04

#define CLOUD_MEAN_COSINE 0.829 // of both lobes

// 3/4 (1 - g) with that: of the optical depth, what two streams see turned back.
#define CLOUD_DIFFUSE_DEPTH 0.128

// 1 - g^2 with that: of the optical depth, what takes light from where it goes; the rest spreads it
// by some degrees (Joseph, Wiscombe and Weinman 1976).
#define CLOUD_TURNING_DEPTH 0.313

// What a few scatterings leave of the asymmetries.
#define CLOUD_TURNED 0.8

// `narrow` in [0, 1]: what further scatterings have left of both asymmetries.
SHARED_FN Number cloud_phase(Number cos_angle, Number narrow)
{
    return cloud_lobe(cos_angle, CLOUD_FORWARD_G * narrow) * (1.0 - CLOUD_BACK_SHARE) +
           cloud_lobe(cos_angle, CLOUD_BACK_G * narrow) * CLOUD_BACK_SHARE;
}

// The cloud around a place as two streams see it: diffuse depths of a side of the boxes that were
// looked at, and of the layer's height at its cover, if they were full; how full those above and
// below are; and the cover of a level around there.
SHARED_STRUCT(CloudAround)
{
    Number side, whole;
    Number above, below;
    Number cover;
};

// How far above and below a place, and how wide: of a layer of tiles of `scale`.
SHARED_FN Length cloud_side(Length thickness, Length scale)
{
    return shared_min(0.25 * thickness, 0.03125 * scale);
}

// Light that was scattered more than once, toward the eye per irradiance of the star. A few
// scatterings leave a peak, of `phase`, where there is enough cloud for them; after many, light
// has no direction and falls as in two streams. A closed deck gets what level ground does; sides
// of broken clouds get more of a low star, and through them clouds where there are few lose more.
// `depth` is that toward the star nearby, `far` that of other clouds. Numbers are those of
// tools/clouds.
SHARED_FN Number cloud_several(CloudAround around, Number phase, Number sun_mu, Number depth,
                               Number far)
{
    Number enough = 1.0 - exp(-36.4 * around.side * (0.1 + around.above + around.below));
    Number few = 0.744 * phase * enough * exp(-0.163 * depth - 0.753 * far);
    Number mu = shared_max(sun_mu, 0.02);
    Number turned = around.side * (0.41 + 1.13 * around.below + 1.32 * around.above);
    Number closed2 = around.cover * around.cover;
    Number closed = closed2 * closed2 * closed2 * closed2;
    Number lit = mu * (1.71 / (1.0 + 4.57 * mu) * (1.0 - closed) + 0.398 * closed);
    Number wide = around.cover / (around.cover + 0.0768);
    Number many =
        lit * wide * turned / (1.0 + turned) / (1.0 + 0.0592 * depth) * exp(-0.0425 * far);
    return few + many;
}

// The part of light from above in what two streams from above and below make of a place between
// them; a view from below sees more of what is scattered forward from above.
SHARED_FN Number cloud_from_above(CloudAround around, Number height, Number view_mu)
{
    Number high = shared_clamp(height, 0.0, 1.0);
    Number over = 4.48 * around.side * around.above + 1.03 * around.whole * (1.0 - high);
    Number under = 4.48 * around.side * around.below + 1.03 * around.whole * high;
    Number tilt = exp(1.61 * view_mu);
    return (tilt + under) / (tilt + 1.0 / tilt + over + under);
}

// Of light of all directions that grows brighter toward the star, as the part x of a direction that
// points horizontally there, what a place sends to the eye: the mean x of where its paths come
// from. `toward` is the x of the view, and one scattering leaves the mean cosine of it; where there
// is cloud all around what is left is that of the lit sides, or of those with clouds of this
// optical depth between them and the star.
SHARED_FN Number cloud_turn(Number toward, Number whole, Number depth)
{
    Number ahead = CLOUD_MEAN_COSINE * toward / (1.0 + 2.67 * whole);
    return ahead + 0.062 / (1.0 + 0.151 * depth) - 0.035;
}

// A sky has more than two even halves and its slope, most of it about the horizon. Of that, as 1
// in the mean of all directions, a place sends this to the eye: level views through thin layers see
// the horizon ahead, steep ones do not; outer places of deep clouds meet it, inner ones have other
// clouds there. Of sides only the star's are looked at.
SHARED_FN Number cloud_horizon(Number view_mu, Number whole, Number depth)
{
    Number ahead = 2.61 * exp(-2.5 * shared_abs(view_mu)) - 0.613;
    return ahead / (1.0 + 1.4 * whole) + 0.286 / (1.0 + 0.202 * depth);
}

// How far clouds of this cover of the sky stand by themselves, and send light out by their sides.
SHARED_FN Number cloud_openness(Number cover)
{
    return 1.0 - cover * cover * cover;
}

// Of light from all of the sky that clouds of a layer meet, what comes out below them; `closed` is
// what two streams let through a flat layer as deep, `overlap` that of cloud_level_cover: flat
// clouds have few sides.
SHARED_FN Number cloud_through(Number closed, Number cover, Number overlap)
{
    return shared_min(closed + 0.55 * (1.0 - overlap) * cloud_openness(cover), 1.0);
}

// The same of the star's light: the higher that is the more goes on, through closed layers as
// Eddington's two streams have it.
SHARED_FN Number cloud_star_through(Number through, Number cover, Number sun_mu)
{
    Number open = cloud_openness(cover);
    Number by_sides = 1.2 * sun_mu / (sun_mu + 0.1);
    return shared_min(through * (open * by_sides + (1.0 - open) * (0.5 + 0.75 * sun_mu)), 1.0);
}

// How surely two rays end at one surface, by the logarithms of their distances: they do within some
// per cent.
SHARED_FN Number cloud_alike(Number end, Number own)
{
    Number apart = shared_abs(end - own);
    return 1.0 / (1.0 + 4.0e3 * apart * apart * apart);
}

// A part of a step that is as dense all along, integrated: (1 - exp(-t)) / t, without cancellation.
SHARED_FN Number cloud_mean_transmittance(Number depth)
{
    return depth < 0.001 ? 1.0 - 0.5 * depth : (1.0 - exp(-depth)) / shared_max(depth, 1.0e-6);
}

#endif // SHARED_CLOUD_GLSL
