// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "validate_plot.h"

#include <math.h>

// In units of the drawing.
enum { WIDTH = 300, HEIGHT = 186, LEFT = 40, RIGHT = 294, TOP = 10, BOTTOM = 150 };

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

static void draw_frame(FILE *page, double range)
{
    const double band = y_of(JUDGE_MEAN_BOUND, range);
    fprintf(page, "<rect x=\"%d\" y=\"%.1f\" width=\"%d\" height=\"%.1f\" fill=\"#e4f1e6\"/>", LEFT,
            band, RIGHT - LEFT, y_of(-JUDGE_MEAN_BOUND, range) - band);
    for (int k = -2; k <= 2; k++) {
        const double y = y_of(0.5 * k * range, range);
        fprintf(page,
                "<path d=\"M%d %.1fH%d\" stroke=\"%s\" stroke-width=\"%s\"/>"
                "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%s%g%%</text>",
                LEFT, y, RIGHT, k ? "#dcdcd6" : "#8a8d94", k ? "0.7" : "1", LEFT - 4, y + 3.5,
                k > 0 ? "+" : "", 50 * k * range);
    }
}

void validate_plot_errors(FILE *page, const struct validate_case *c)
{
    static const char *const colors[VALIDATE_WAVELENGTHS] = {"#2f62b5", "#3c9048", "#c0412f"};
    const double range = choose_range(c);
    fprintf(page, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"relative errors\">", WIDTH,
            HEIGHT);
    draw_frame(page, range);
    const double step = (double)(RIGHT - LEFT) / VALIDATE_DIRECTIONS;
    for (int i = 0; i < c->count; i++) {
        const int direction = i / VALIDATE_WAVELENGTHS;
        const int wavelength = i % VALIDATE_WAVELENGTHS;
        const double x = LEFT + step * (direction + 0.5 + 0.22 * (wavelength - 1));
        const double error = error_of(c, i);
        const double sigma = relative(c, i, c->error[i]);
        fprintf(page,
                "<path d=\"M%.1f %.1fV%.1f\" stroke=\"%s\" stroke-width=\"1.4\" opacity=\".55\"/>"
                "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.6\" fill=\"%s\"/>",
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
    fprintf(page, "</svg>");
}
