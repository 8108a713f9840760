// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_METER_GLSL
#define SHARED_METER_GLSL
// A reflected-light meter: from the luminances of a picture, in cd m^-2, to an exposure value
// EV100.
//
// It takes the mean of log2 L weighed by the square root of L: black space has no weight, so a
// small lit planet is exposed as if it filled the picture; a thin crescent outweighs the night
// beside it; but bright parts do not rule alone.

#include "shared/tone.glsl"

// It looks at cells of the picture, each through a regular grid of samples.
#define METER_CELLS_X 64
#define METER_CELLS_Y 40
#define METER_SAMPLES 8 // in each direction

#define METER_EV_MIN (-10.0)
#define METER_EV_MAX 24.0
#define METER_EV_UNLIT 15.0 // of a picture without any light: that of a bright day

// Below this mean luminance a picture gets darker by a quarter of a stop for each stop that the
// scene does, and by less and less, until it stops: dusk looks like dusk, and what moonlight or
// starlight shows is dark but can be seen.
#define METER_LOG2_DIM 2.0 // 4 cd m^-2
#define METER_DIM_SLOPE 0.25
#define METER_DIM_MOST 2.5

SHARED_FN Number meter_luminance(Number red, Number green, Number blue)
{
    return red * 0.2126 + green * 0.7152 + blue * 0.0722;
}

// What is brighter than a sunlit white wall is a light source and counts as such a wall: the star's
// disc covers too little to matter.
SHARED_FN Number meter_counted(Number luminance, Number wall)
{
    return shared_clamp(luminance, 0.0, wall);
}

// The mean of log2 L, from the sum of weights and the weighted sum, to EV100.
SHARED_FN Number meter_exposure(Number weights, Number weighted)
{
    Number mean = weighted / weights;
    Number below = shared_max(METER_LOG2_DIM - mean, 0.0);
    Number dimming = METER_DIM_MOST * (1.0 - exp(-below * METER_DIM_SLOPE / METER_DIM_MOST));
    return shared_clamp(mean - TONE_LOG2_MEAN_PER_EV0 + dimming, METER_EV_MIN, METER_EV_MAX);
}

#endif // SHARED_METER_GLSL
