// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "spectrum/spectrum.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

// Second radiation constant h c / k in nm K, from the exact SI values of h, c and k (SI Brochure
// 2019).
#define RADIATION_C2_NM_K (6.62607015e-34 * 299792458.0 / 1.380649e-23 * 1e9)

// Panels of Simpson's rule for the smooth forms; an even number.
enum { MEAN_PANELS = 64 };

// Index of the last knot at or below nm; the caller knows that nm is inside the table.
static size_t find_knot(const double *knots, size_t count, double nm)
{
    size_t low = 0;
    size_t high = count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (knots[middle] <= nm) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static double interpolate_table(const struct spectrum *spectrum, double nm)
{
    const double *knots = spectrum->table.nm;
    const double *values = spectrum->table.value;
    const size_t count = spectrum->table.count;
    if (nm <= knots[0]) {
        return values[0];
    }
    if (nm >= knots[count - 1]) {
        return values[count - 1];
    }
    const size_t i = find_knot(knots, count, nm);
    const double t = (nm - knots[i]) / (knots[i + 1] - knots[i]);
    return values[i] * (1 - t) + values[i + 1] * t;
}

// 8 pi^3 (n^2 - 1)^2 / (3 N lambda^4): Elek 2010 Eq. 1 integrated over the sphere.
static double scatter_rayleigh(double refractive_index, double number_density_per_m3, double nm)
{
    const double lambda_m = nm * 1e-9;
    const double polarisability = refractive_index * refractive_index - 1;
    return 8 * PI * PI * PI * polarisability * polarisability /
           (3 * number_density_per_m3 * lambda_m * lambda_m * lambda_m * lambda_m);
}

// Planck's law as a share of its own integral: with x = h c / (lambda k T) the share of dx is
// 15/pi^4 x^3/(e^x - 1), and |dx| = x / lambda dlambda.
static double radiate_blackbody(double temperature_K, double total_W_m2, double nm)
{
    const double x = RADIATION_C2_NM_K / (nm * temperature_K);
    if (x > 700) { // exp would overflow; the value is below 1e-290 of the total
        return 0;
    }
    return total_W_m2 * 15 / (PI * PI * PI * PI) * x * x * x * x / (nm * expm1(x));
}

static double weigh(const struct spectrum_hat *hat, double nm)
{
    if (nm < hat->peak_nm && hat->from_nm > 0) {
        return fmax(0, (nm - hat->from_nm) / (hat->peak_nm - hat->from_nm));
    }
    if (nm > hat->peak_nm && hat->to_nm > 0) {
        return fmax(0, (hat->to_nm - nm) / (hat->to_nm - hat->peak_nm));
    }
    return 1;
}

static double evaluate(const struct spectrum *spectrum, double nm)
{
    switch (spectrum->kind) {
    case SPECTRUM_CONSTANT:
        return spectrum->constant;
    case SPECTRUM_TABLE:
        return interpolate_table(spectrum, nm);
    case SPECTRUM_POWER_LAW:
        return spectrum->power_law.value *
               pow(nm / spectrum->power_law.at_nm, spectrum->power_law.exponent);
    case SPECTRUM_RAYLEIGH:
        return scatter_rayleigh(spectrum->rayleigh.refractive_index,
                                spectrum->rayleigh.number_density_per_m3, nm);
    case SPECTRUM_BLACKBODY:
        return radiate_blackbody(spectrum->blackbody.temperature_K, spectrum->blackbody.total_W_m2,
                                 nm);
    }
    return 0;
}

double spectrum_at(const struct spectrum *spectrum, double nm)
{
    const double value = evaluate(spectrum, nm);
    return spectrum->hat.peak_nm > 0 ? value * weigh(&spectrum->hat, nm) : value;
}

// Trapezoids from knot to knot are the exact integral of a piecewise linear function.
static double average_table(const struct spectrum *spectrum, double from_nm, double to_nm)
{
    double sum = 0;
    double x = from_nm;
    double y = interpolate_table(spectrum, x);
    for (size_t i = 0; i < spectrum->table.count && x < to_nm; i++) {
        const double next = fmin(spectrum->table.nm[i], to_nm);
        if (next > x) {
            const double next_y = interpolate_table(spectrum, next);
            sum += (next - x) * (y + next_y) / 2;
            x = next;
            y = next_y;
        }
    }
    sum += (to_nm - x) * y; // beyond the last knot
    return sum / (to_nm - from_nm);
}

double spectrum_mean(const struct spectrum *spectrum, double from_nm, double to_nm)
{
    const bool has_hat = spectrum->hat.peak_nm > 0;
    if (spectrum->kind == SPECTRUM_CONSTANT && !has_hat) {
        return spectrum->constant;
    }
    if (spectrum->kind == SPECTRUM_TABLE && !has_hat) {
        return average_table(spectrum, from_nm, to_nm);
    }
    double sum = 0;
    for (int i = 0; i <= MEAN_PANELS; i++) {
        const double weight = i == 0 || i == MEAN_PANELS ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * spectrum_at(spectrum, from_nm + (to_nm - from_nm) * i / MEAN_PANELS);
    }
    return sum / (3 * MEAN_PANELS);
}

trl_result spectrum_table_init(const trl_context *ctx, const double *nm, const double *value,
                               size_t count, struct spectrum *out)
{
    *out = (struct spectrum){0};
    double *block = mem_alloc(ctx, count, 2 * sizeof *block);
    if (!block) {
        return TRL_ERROR_MEMORY;
    }
    memcpy(block, nm, count * sizeof *block);
    memcpy(block + count, value, count * sizeof *block);
    *out = (struct spectrum){.kind = SPECTRUM_TABLE,
                             .table = {.nm = block, .value = block + count, .count = count}};
    return TRL_OK;
}

trl_result spectrum_copy(const trl_context *ctx, const struct spectrum *spectrum,
                         struct spectrum *out)
{
    *out = *spectrum;
    if (spectrum->kind != SPECTRUM_TABLE) {
        return TRL_OK;
    }
    const trl_result result = spectrum_table_init(ctx, spectrum->table.nm, spectrum->table.value,
                                                  spectrum->table.count, out);
    out->hat = spectrum->hat;
    return result;
}

struct spectrum_hat spectrum_hat_of(const double *knot_nm, size_t count, size_t index)
{
    return (struct spectrum_hat){.from_nm = index > 0 ? knot_nm[index - 1] : 0,
                                 .peak_nm = knot_nm[index],
                                 .to_nm = index + 1 < count ? knot_nm[index + 1] : 0};
}

void spectrum_finish(const trl_context *ctx, struct spectrum *spectrum)
{
    if (spectrum->kind == SPECTRUM_TABLE) {
        mem_free(ctx, spectrum->table.nm);
    }
    *spectrum = (struct spectrum){0};
}
