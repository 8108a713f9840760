// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "difference.h"

#include <math.h>
#include <stdlib.h>

// Luminance that is white in the picture; include/terrella/renderer.h.
static double white_cd_m2(double ev100)
{
    return 1.2 * exp2(ev100);
}

static const double DARK_SHARE = 1.0 / 4096;

double difference_luminance(const float *rgb)
{
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

struct lab {
    double l, a, b;
};

// IEC 61966-2-1.
static double decode(uint8_t code)
{
    const double x = code / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

// CIE 15:2004, 8.2.1.1.
static double lab_curve(double t)
{
    return t > 216.0 / 24389.0 ? cbrt(t) : (24389.0 / 27.0 * t + 16) / 116;
}

// Relative to sRGB's own white.
static struct lab lab_of(const uint8_t *rgba)
{
    const double r = decode(rgba[0]);
    const double g = decode(rgba[1]);
    const double b = decode(rgba[2]);
    const double x = lab_curve((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
    const double y = lab_curve(0.2126 * r + 0.7152 * g + 0.0722 * b);
    const double z = lab_curve((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
    return (struct lab){116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

static double delta_e(const uint8_t *first, const uint8_t *second)
{
    const struct lab p = lab_of(first);
    const struct lab q = lab_of(second);
    return sqrt((p.l - q.l) * (p.l - q.l) + (p.a - q.a) * (p.a - q.a) + (p.b - q.b) * (p.b - q.b));
}

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

// Means, and the size that one lit pixel in a hundred exceeds; `sizes` is scratch.
static void summarize(struct difference *d, float *sizes)
{
    size_t lit = 0;
    for (size_t i = 0; i < d->count; i++) {
        if (!isnan(d->share[i])) {
            d->mean += (double)d->share[i];
            d->mean_size += fabs((double)d->share[i]);
            sizes[lit++] = fabsf(d->share[i]);
        }
    }
    if (lit > 0) {
        d->mean /= (double)lit;
        d->mean_size /= (double)lit;
        d->mean_delta_e /= (double)lit;
        qsort(sizes, lit, sizeof *sizes, compare_floats);
        d->largest_size = (double)sizes[(size_t)(0.99 * (double)(lit - 1))];
    }
}

bool difference_make(const struct shot *base, const struct shot *other, struct difference *out)
{
    *out = (struct difference){.count = (size_t)base->width * base->height};
    out->share = malloc(out->count * sizeof *out->share);
    float *sizes = malloc(out->count * sizeof *sizes);
    const double dark_cd_m2 = DARK_SHARE * white_cd_m2(base->ev100);
    for (size_t i = 0; out->share && sizes && i < out->count; i++) {
        const double at_base = difference_luminance(base->radiance + 4 * i);
        const double here = difference_luminance(other->radiance + 4 * i);
        const bool is_dark = at_base < dark_cd_m2 && here < dark_cd_m2;
        // What is black in the base alone is counted from the edge of black.
        out->share[i] = is_dark ? NAN : (float)((here - at_base) / fmax(at_base, dark_cd_m2));
        if (!is_dark) {
            out->mean_delta_e += delta_e(base->picture + 4 * i, other->picture + 4 * i);
        }
    }
    const bool is_made = out->share && sizes;
    if (is_made) {
        summarize(out, sizes);
    } else {
        difference_finish(out);
    }
    free(sizes);
    return is_made;
}

void difference_finish(struct difference *difference)
{
    free(difference->share);
    *difference = (struct difference){0};
}

double difference_choose_range(const struct difference *differences, size_t count)
{
    static const double ranges[] = {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0};
    enum { RANGE_COUNT = sizeof ranges / sizeof *ranges };
    double largest = 0;
    for (size_t i = 0; i < count; i++) {
        largest = fmax(largest, differences[i].largest_size);
    }
    int chosen = 0;
    while (chosen < RANGE_COUNT - 1 && ranges[chosen] < largest) {
        chosen++;
    }
    return ranges[chosen];
}

struct canvas_color difference_color(double share, double range)
{
    // From the ends to the middle: dark, mid and light of either hue, evenly spaced in lightness.
    static const double colors[][3] = {{24, 57, 122},   {72, 130, 190},  {168, 204, 228},
                                       {247, 246, 243}, {245, 196, 160}, {217, 110, 74},
                                       {133, 19, 36}};
    enum { LAST = sizeof colors / sizeof *colors - 1 };
    if (isnan(share)) {
        return (struct canvas_color){190, 190, 190};
    }
    const double at = fmin(fmax(share / range, -1), 1);
    const double x = 0.5 * (at + 1) * LAST;
    const int below = x < LAST ? (int)x : LAST - 1;
    const double t = x - below;
    uint8_t mixed[3];
    for (int c = 0; c < 3; c++) {
        mixed[c] = (uint8_t)lround((1 - t) * colors[below][c] + t * colors[below + 1][c]);
    }
    return (struct canvas_color){mixed[0], mixed[1], mixed[2]};
}

void difference_draw(const struct difference *difference, double range, uint8_t *rgba)
{
    for (size_t i = 0; i < difference->count; i++) {
        const struct canvas_color color = difference_color((double)difference->share[i], range);
        rgba[4 * i] = color.red;
        rgba[4 * i + 1] = color.green;
        rgba[4 * i + 2] = color.blue;
        rgba[4 * i + 3] = 255;
    }
}
