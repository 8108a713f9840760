// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_CLOUD_JUDGE_H
#define CLI_CLOUD_JUDGE_H
// How far drawn pixels are from traced ones where paths are few and carry light of very different
// strength: what they say of their own noise is then too small, and is not believed.

#include <stddef.h>

struct cloud_pixel {
    double drawn;     // luminance
    double halves[2]; // as each half of the paths says
    double error;     // standard error of both together, as paths tell it
};

// Luminances. Errors of pixels are relative to what is traced there, but for the root mean square.
struct cloud_figures {
    double traced_cd_m2; // in the mean
    double ratio;        // of the means, drawn over traced
    double size;         // of errors, in the mean, with the noise of the paths
    double noise;        // the mean size of that noise, as paths tell it
    double least_size;   // of errors without noise, at least: signs are those of half of the paths
    // Root mean square of errors relative to what is drawn, without noise whatever its kind: it is
    // not in the product of what each half of the paths says.
    double rms;
    // Of the pixels in the order of what is drawn, which has no noise: the darkest third drawn over
    // traced, the middle and the brightest.
    double thirds[3];
    double contrast[2]; // standard deviation over the mean, drawn and traced, without noise
};
// Sorts the pixels.
struct cloud_figures cloud_judge(struct cloud_pixel *pixels, size_t count);

#endif // CLI_CLOUD_JUDGE_H
