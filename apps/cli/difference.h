// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_DIFFERENCE_H
#define CLI_DIFFERENCE_H
// How one picture of a view differs from another: luminance, pixel by pixel, as a share of that of
// the other one, and as a map in colours.

#include "canvas.h"
#include "shot.h"

// Luminance of linear sRGB in its units, ITU-R BT.709.
double difference_luminance(const float *rgb);

// Owner: whoever made it.
struct difference {
    size_t count;
    float *share;        // owned; (luminance - of the base) / of the base; NAN where both are dark
    double mean;         // of the shares
    double mean_size;    // of their absolute values
    double largest_size; // exceeded by one lit pixel in a hundred
    double mean_delta_e; // CIELAB 1976, between the pictures as they are shown; of lit pixels
};

// Of two shots of the same size. What both show black (4000 times darker than white at the base's
// exposure) counts as dark. False when memory is out.
bool difference_make(const struct shot *base, const struct shot *other, struct difference *out);
void difference_finish(struct difference *difference);

// The smallest of 0.5, 1, 2, 5, … 100 % that is not exceeded by the largest of any of them.
double difference_choose_range(const struct difference *differences, size_t count);

// Colour of a share on a map from -range (blue: too dark) over 0 (nearly white) to range (red: too
// bright). NAN: the grey of what is dark.
struct canvas_color difference_color(double share, double range);

// The map, width x height x 4 bytes as in a canvas.
void difference_draw(const struct difference *difference, double range, uint8_t *rgba);

#endif // CLI_DIFFERENCE_H
