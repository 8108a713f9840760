// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How high and how steep octaves can be: bounds for those who look for the ground along a way.
#include "terrain/noise_parts.h"

#include <math.h>

// How much less folded the ground may be within reach of where it was looked at.
static const double RIDGED_SLACK = 0.3;

struct noise_reach noise_find_reach(const struct terrain_noise *noise, double amplitude_m,
                                    double ridged)
{
    double noises = 0, gullies = 0;
    for (int i = 0; i < noise->ends[2]; i++) {
        const bool is_gully = i >= noise->ends[0] && i < noise->ends[1];
        *(is_gully ? &gullies : &noises) += noise->size[i];
    }
    // relief_fold: from 1 and -1 of plain noise to 0.23 and -1.33 of ridges.
    const double weight = RELIEF_WEIGHT_BOUND;
    return (struct noise_reach){
        -amplitude_m * (noises * weight * (1 + 0.35 * ridged) + gullies * NOISE_GULLIES),
        amplitude_m * (noises * weight * (1 - 0.77 * ridged) + gullies * NOISE_GULLIES)};
}

// Slopes per wavelength of octaves of size 1. Of a million random places one octave alone is never
// steeper than 13, ten together than 30: one is let be the steepest, and the others a third of it.
// Gullies nowhere are steeper than 21.02.
static const double STEEPEST_NOISE = 13;
static const double NEXT_STEEPEST = 4;
static const double STEEPEST_GULLY = 21.1;

// The least, the given and the largest of what octaves are multiplied by, within a reach.
struct noise_range {
    double least, here, most;
};

static struct noise_range find_amplitudes(const struct terrain_noise *noise,
                                          const struct noise_place *place,
                                          const struct noise_around *around)
{
    const struct noise_ground *g = &place->ground;
    const double full = noise->desc.full_height_m;
    const double spread = noise->steepest_spread * around->reach_m;
    const double rise = around->steepest * around->reach_m;
    const double height = fabs(g->height_m);
    const double dried = g->dry_per_m * around->reach_m;
    return (struct noise_range){fmax(g->amplitude_m - spread, 0) * fmax(g->dry - dried, 0) *
                                    relief_fullness(fmax(height - rise, 0), full),
                                g->amplitude_m * g->dry * relief_fullness(height, full),
                                (g->amplitude_m + spread) * fmin(g->dry + dried, 1) *
                                    relief_fullness(height + rise, full)};
}

// Of an octave, with what data leave of it: here, and around.
static struct noise_range find_sizes(const struct terrain_noise *noise, int octave,
                                     const struct noise_range *amplitudes, ReliefData here,
                                     const struct noise_around *around)
{
    const double size = noise->size[octave], wave = noise->log2_wave[octave];
    return (struct noise_range){
        amplitudes->least * size * relief_lacking(wave, around->log2_texel[0]),
        amplitudes->here * size * relief_lacking_of(wave, here),
        amplitudes->most * size * relief_lacking(wave, around->log2_texel[1])};
}

struct noise_rise noise_find_rise(const struct terrain_noise *noise,
                                  const struct noise_place *place,
                                  const struct noise_around *around)
{
    // relief_fold: between -1.35 and 1 of plain noise, 0.23 of ridges.
    const double ridged = fmax(place->ground.ridged - RIDGED_SLACK, 0);
    const double up = RELIEF_WEIGHT_BOUND * (1 - 0.77 * ridged);
    const double any = RELIEF_WEIGHT_BOUND * RELIEF_VALUE_BOUND;
    const struct noise_range amplitudes = find_amplitudes(noise, place, around);
    struct noise_rise rise = {0, 0, 0};
    bool is_long = true;
    double steepest = 0;
    for (int i = 0; i < noise->ends[2]; i++) {
        const bool is_gully = i >= noise->ends[0] && i < noise->ends[1];
        const struct noise_range size = find_sizes(noise, i, &amplitudes, place->data, around);
        const double most = size.most * (is_gully ? NOISE_GULLIES : up);
        const double slope =
            size.most * (is_gully ? NOISE_GULLIES * STEEPEST_GULLY : STEEPEST_NOISE);
        const double change = slope * around->reach_m / noise->wave_m[i];
        is_long = is_long && (change < most || !(most > 0));
        rise.octaves += is_long;
        rise.most_m += most;
        const double part = is_gully ? 1 : NEXT_STEEPEST / STEEPEST_NOISE;
        rise.rise_m += is_long ? part * change : most;
        steepest = is_long && !is_gully ? fmax(steepest, change) : steepest;
        // What is there grows, or sinks, with what it is multiplied by.
        const double grown = fmax(size.most - size.here, size.here - size.least);
        rise.rise_m += is_long ? (is_gully ? NOISE_GULLIES : any) * grown : 0;
    }
    rise.rise_m += steepest * (1 - NEXT_STEEPEST / STEEPEST_NOISE);
    return rise;
}

double noise_find_most(const struct terrain_noise *noise, const struct noise_ground *ground,
                       double reach_m)
{
    const double amplitude = ground->amplitude_m + noise->steepest_spread * reach_m;
    return noise_find_reach(noise, amplitude, fmax(ground->ridged - RIDGED_SLACK, 0)).up_m;
}
