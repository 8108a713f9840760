// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "validate_plot.h"

#include <math.h>

// In units of the drawing.
enum { WIDTH = 420, HEIGHT = 186, LEFT = 44, RIGHT = 414, TOP = 10, BOTTOM = 150 };

static const double deg_per_rad = 180.0 / 3.14159265358979323846;

static double relative(const struct validate_case *c, int i, double value)
{
    return value / fmax(fabs(c->reference[i]), 1e-300);
}

static double error_of(const struct validate_case *c, int i)
{
    return relative(c, i, c->answers[TRL_SKY_SPECTRAL].radiance[i] - c->reference[i]);
}

// The half height of the plot: enough for nearly all bars, in even steps.
static double choose_range(const struct validate_case *c)
{
    static const double ranges[] = {0.02, 0.05, 0.1, 0.2, 0.5, 1.0};
    enum { RANGES = sizeof ranges / sizeof *ranges };
    double largest = 0;
    for (int i = 0; i < c->count; i++) {
        largest = fmax(largest, fabs(error_of(c, i)) + relative(c, i, c->error[i]));
    }
    int chosen = 0;
    while (chosen < RANGES - 1 && ranges[chosen] < largest) {
        chosen++;
    }
    return ranges[chosen];
}

static double y_of(double error, double range)
{
    const double share = fmax(-1, fmin(1, error / range));
    return 0.5 * (TOP + BOTTOM) - 0.5 * (BOTTOM - TOP) * share;
}

static void begin_svg(FILE *page, const char *label)
{
    fprintf(page, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"%s\">", WIDTH, HEIGHT,
            label);
}

static void draw_frame(FILE *page, double range)
{
    const double band = y_of(JUDGE_MEAN_BOUND, range);
    fprintf(page, "<rect x=\"%d\" y=\"%.1f\" width=\"%d\" height=\"%.1f\" class=\"band\"/>", LEFT,
            band, RIGHT - LEFT, y_of(-JUDGE_MEAN_BOUND, range) - band);
    for (int k = -2; k <= 2; k++) {
        const double y = y_of(0.5 * k * range, range);
        fprintf(page,
                "<path d=\"M%d %.1fH%d\" class=\"%s\"/>"
                "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%s%g%%</text>",
                LEFT, y, RIGHT, k ? "grid" : "axis", LEFT - 4, y + 3.5, k > 0 ? "+" : "",
                50 * k * range);
    }
}

static void draw_value(FILE *page, const struct validate_case *c, int i, double range)
{
    static const char colors[] = {'b', 'g', 'r'};
    const double step = (double)(RIGHT - LEFT) / VALIDATE_DIRECTIONS;
    const int direction = i / VALIDATE_WAVELENGTHS;
    const int wavelength = i % VALIDATE_WAVELENGTHS;
    const double x = LEFT + step * (direction + 0.5 + 0.22 * (wavelength - 1));
    const double error = error_of(c, i);
    const double sigma = relative(c, i, c->error[i]);
    fprintf(page,
            "<path d=\"M%.1f %.1fV%.1f\" class=\"bar %c\"/>"
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.4\" class=\"%c\"/>",
            x, y_of(error - sigma, range), y_of(error + sigma, range), colors[wavelength], x,
            y_of(error, range), colors[wavelength]);
    if (wavelength == 1) {
        fprintf(page,
                "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%.0f&deg;</text>"
                "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%.0f&deg;</text>",
                x, BOTTOM + 15, c->queries[i].view_zenith_rad * deg_per_rad, x, BOTTOM + 28,
                c->queries[i].azimuth_rad * deg_per_rad);
    }
}

void validate_plot_errors(FILE *page, const struct validate_case *c)
{
    const double range = choose_range(c);
    begin_svg(page, "relative errors");
    draw_frame(page, range);
    for (int i = 0; i < c->count; i++) {
        draw_value(page, c, i, range);
    }
    fprintf(page, "</svg>");
}

// Decades of luminance from the bottom to the top of a plot, and angles from its left to its right.
struct axes {
    double low, high;         // log10 of cd m^-2
    double low_deg, high_deg; // elevation
};

static double x_at(const struct axes *axes, double degrees)
{
    return LEFT + (RIGHT - LEFT) * (degrees - axes->low_deg) / (axes->high_deg - axes->low_deg);
}

static double y_at(const struct axes *axes, double luminance)
{
    const double level = log10(fmax(luminance, 1e-300));
    const double share = (level - axes->low) / (axes->high - axes->low);
    return BOTTOM - (BOTTOM - TOP) * fmax(0, fmin(1, share));
}

// Elevation of a row's middle in the column of the picture's middle.
static double row_deg(const struct validate_case *c, const struct validate_profile *p, int row)
{
    const double up = 1 - 2 * (row + 0.5) / p->rows;
    return deg_per_rad * (c->pitch_rad + atan(up * tan(0.5 * c->vertical_fov_rad)));
}

// At most five decades, down from the brightest row.
static struct axes choose_axes(const struct validate_case *c)
{
    const struct validate_profile *p = &c->traced.profile;
    double least = INFINITY;
    double most = 0;
    for (int row = 0; row < p->rows; row++) {
        most = fmax(most, p->luminance[row]);
        least = p->luminance[row] > 0 ? fmin(least, p->luminance[row]) : least;
    }
    const double high = ceil(log10(fmax(most, 1e-6)) + 0.05);
    const double low = floor(log10(fmax(fmin(least, most), 1e-9)) - 0.05);
    const double half_deg = 0.5 * deg_per_rad * c->vertical_fov_rad;
    const double pitch_deg = deg_per_rad * c->pitch_rad;
    return (struct axes){fmin(fmax(low, high - 5), high - 1), high, pitch_deg - half_deg,
                         pitch_deg + half_deg};
}

static void draw_axes(FILE *page, const struct axes *axes)
{
    for (double level = axes->low; level <= axes->high; level++) {
        const double y = y_at(axes, pow(10, level));
        fprintf(page,
                "<path d=\"M%d %.1fH%d\" class=\"grid\"/>"
                "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%g</text>",
                LEFT, y, RIGHT, LEFT - 4, y + 3.5, pow(10, level));
    }
    for (double degrees = 10 * ceil(axes->low_deg / 10); degrees < axes->high_deg; degrees += 10) {
        const double x = x_at(axes, degrees);
        fprintf(page,
                "<path d=\"M%.1f %dV%d\" class=\"grid\"/>"
                "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%.0f&deg;</text>",
                x, TOP, BOTTOM, x, BOTTOM + 15, degrees);
    }
}

static void draw_profile(FILE *page, const struct validate_case *c, const struct axes *axes,
                         int model)
{
    static const char colors[VALIDATE_MODELS] = {'b', 'r', 'g'};
    const struct validate_profile *p = &c->answers[model].pictures.profile;
    if (p->rows == 0) {
        return;
    }
    fprintf(page, "<polyline class=\"%c line\" style=\"fill:none\" points=\"", colors[model]);
    const int step = p->rows > 60 ? 2 : 1;
    for (int row = 0; row < p->rows; row += step) {
        fprintf(page, "%.1f,%.1f ", x_at(axes, row_deg(c, p, row)), y_at(axes, p->luminance[row]));
    }
    fprintf(page, "\"/>");
}

void validate_plot_profiles(FILE *page, const struct validate_case *c)
{
    const struct axes axes = choose_axes(c);
    begin_svg(page, "luminance along the elevation");
    draw_axes(page, &axes);
    for (int m = VALIDATE_MODELS - 1; m >= 0; m--) {
        draw_profile(page, c, &axes, m);
    }
    const struct validate_profile *p = &c->traced.profile;
    for (int row = 0; row < p->rows; row++) {
        const double x = x_at(&axes, row_deg(c, p, row));
        const double luminance = p->luminance[row];
        fprintf(page,
                "<path d=\"M%.1f %.1fV%.1f\" class=\"bar k\"/>"
                "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"1.3\" class=\"k\"/>",
                x, y_at(&axes, luminance - p->error[row]), y_at(&axes, luminance + p->error[row]),
                x, y_at(&axes, luminance));
    }
    fprintf(page, "</svg>");
}
