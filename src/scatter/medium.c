// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/medium.h"

#include <math.h>
#include <string.h>

#include "shared/phase.glsl"
#include "shared/profile.glsl"

#define PI 3.14159265358979323846

// Midpoints of a profile's column, as many as the optics take (scatter/optics.h).
enum { COLUMN_SAMPLES = 4096 };

// Index of the last knot at or below x, which lies inside the table.
static size_t find_knot(const double *knots, size_t count, double x)
{
    size_t low = 0;
    size_t high = count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (knots[middle] <= x) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// Linear between the knots, constant outside.
static double interpolate(const double *knots, const double *values, size_t count, double x)
{
    if (x <= knots[0]) {
        return values[0];
    }
    if (x >= knots[count - 1]) {
        return values[count - 1];
    }
    const size_t i = find_knot(knots, count, x);
    const double t = (x - knots[i]) / (knots[i + 1] - knots[i]);
    return values[i] * (1 - t) + values[i + 1] * t;
}

double profile_density(const struct profile *profile, double altitude_m)
{
    switch (profile->kind) {
    case PROFILE_UNIFORM:
        return 1;
    case PROFILE_EXPONENTIAL:
        return profile_exponential(altitude_m, profile->scale_height_m);
    case PROFILE_TENT:
        return profile_tent(altitude_m, profile->centre_m, profile->half_width_m);
    case PROFILE_TABLE:
        return interpolate(profile->altitude_m, profile->density, profile->count, altitude_m);
    }
    return 0;
}

size_t profile_kink_count(const struct profile *profile)
{
    switch (profile->kind) {
    case PROFILE_TENT:
        return 3;
    case PROFILE_TABLE:
        return profile->count;
    case PROFILE_UNIFORM:
    case PROFILE_EXPONENTIAL:
        break;
    }
    return 0;
}

// Of a table between two knots; 0 outside.
static double slope_before(const struct profile *p, size_t knot)
{
    return knot > 0 && knot < p->count ? (p->density[knot] - p->density[knot - 1]) /
                                             (p->altitude_m[knot] - p->altitude_m[knot - 1])
                                       : 0;
}

double profile_kink_m(const struct profile *profile, size_t index, double *change)
{
    if (profile->kind == PROFILE_TENT) {
        *change = (index == 1 ? -2 : 1) / profile->half_width_m;
        return profile->centre_m + ((double)index - 1) * profile->half_width_m;
    }
    *change = slope_before(profile, index + 1) - slope_before(profile, index);
    return profile->altitude_m[index];
}

double profile_column_m(const struct profile *profile, double height_m)
{
    double sum = 0;
    for (int i = 0; i < COLUMN_SAMPLES; i++) {
        sum += profile_density(profile, (i + 0.5) * height_m / COLUMN_SAMPLES);
    }
    return sum * height_m / COLUMN_SAMPLES;
}

trl_result profile_copy(const trl_context *ctx, const struct profile *profile, struct profile *out)
{
    *out = *profile;
    return profile->kind == PROFILE_TABLE
               ? profile_table_init(ctx, profile->altitude_m, profile->density, profile->count, out)
               : TRL_OK;
}

double phase_value(const struct phase *phase, double cos_angle)
{
    const double nu = fmax(-1, fmin(1, cos_angle));
    switch (phase->kind) {
    case PHASE_ISOTROPIC:
        return phase_isotropic();
    case PHASE_RAYLEIGH:
        return phase_rayleigh(nu);
    case PHASE_HENYEY_GREENSTEIN:
        return phase_henyey_greenstein(nu, phase->g);
    case PHASE_CORNETTE_SHANKS:
        return phase_cornette_shanks(nu, phase->g);
    case PHASE_TABLE:
        return interpolate(phase->angle_rad, phase->value, phase->count, acos(nu));
    }
    return 0;
}

// Cornette-Shanks is Henyey-Greenstein, whose moments are g^l, times 3 (1 + nu^2) / (2 (2 + g^2)).
// Legendre's recurrence applied twice gives nu^2 P_l as a sum of P_(l+2), P_l and P_(l-2).
static double moment_of_cornette_shanks(int l, double g)
{
    const double n = l;
    const double up = (n + 1) * (n + 2) / ((2 * n + 1) * (2 * n + 3));
    const double same = (n + 1) * (n + 1) / ((2 * n + 1) * (2 * n + 3)) +
                        (l > 0 ? n * n / ((2 * n + 1) * (2 * n - 1)) : 0);
    double sum = pow(g, l) * (1 + same) + up * pow(g, l + 2);
    if (l >= 2) {
        sum += n * (n - 1) / ((2 * n + 1) * (2 * n - 1)) * pow(g, l - 2);
    }
    return sum * 1.5 / (2 + g * g);
}

// Gauss-Legendre abscissae and weights for 8 points (Abramowitz and Stegun, Table 25.4), positive
// half.
enum { GAUSS_HALF = 4 };
static const double gauss_x[GAUSS_HALF] = {0.183434642495649805, 0.525532409916328986,
                                           0.796666477413626740, 0.960289856497536232};
static const double gauss_w[GAUSS_HALF] = {0.362683783378361983, 0.313706645877887287,
                                           0.222381034453374471, 0.101228536290376259};

// Adds weight * P_l(x) to sums[0..lmax].
static void add_legendre(double x, double weight, int lmax, double *sums)
{
    double before = 0;
    double now = 1;
    for (int l = 0; l <= lmax; l++) {
        sums[l] += weight * now;
        const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
        before = now;
        now = next;
    }
}

struct segment {
    double from_rad, to_rad; // angles
    double from, to;         // values of the phase function there
};

// The integrand 2 pi f(angle) P_l(cos angle) sin(angle) is as smooth as P_l inside a segment:
// panels that are shorter than half its wavelength make 8 points good to rounding.
static void add_segment(const struct segment *s, int lmax, double *moments)
{
    const double width = s->to_rad - s->from_rad;
    if (!(width > 0)) {
        return;
    }
    const int panels = 1 + (int)(width * (lmax + 2) / PI);
    for (int p = 0; p < panels; p++) {
        for (int i = 0; i < 2 * GAUSS_HALF; i++) {
            const double x = i < GAUSS_HALF ? gauss_x[i] : -gauss_x[i - GAUSS_HALF];
            const double t = (p + 0.5 + 0.5 * x) / panels;
            const double angle = s->from_rad + width * t;
            const double value = s->from + (s->to - s->from) * t;
            const double weight = gauss_w[i % GAUSS_HALF] * width / (2 * panels);
            add_legendre(cos(angle), 2 * PI * value * sin(angle) * weight, lmax, moments);
        }
    }
}

static void integrate_table(const struct phase *phase, int lmax, double *moments)
{
    memset(moments, 0, sizeof *moments * (size_t)(lmax + 1));
    const size_t last = phase->count - 1;
    const double *angle = phase->angle_rad;
    const double *value = phase->value;
    add_segment(&(struct segment){0, angle[0], value[0], value[0]}, lmax, moments);
    for (size_t i = 0; i < last; i++) {
        add_segment(&(struct segment){angle[i], angle[i + 1], value[i], value[i + 1]}, lmax,
                    moments);
    }
    add_segment(&(struct segment){angle[last], PI, value[last], value[last]}, lmax, moments);
}

void phase_moments(const struct phase *phase, int lmax, double *moments)
{
    if (phase->kind == PHASE_TABLE) {
        integrate_table(phase, lmax, moments);
        return;
    }
    for (int l = 0; l <= lmax; l++) {
        switch (phase->kind) {
        case PHASE_ISOTROPIC:
            moments[l] = l == 0;
            break;
        case PHASE_RAYLEIGH:
            moments[l] = l == 0 ? 1 : l == 2 ? 0.1 : 0;
            break;
        case PHASE_HENYEY_GREENSTEIN:
            moments[l] = pow(phase->g, l);
            break;
        case PHASE_CORNETTE_SHANKS:
            moments[l] = moment_of_cornette_shanks(l, phase->g);
            break;
        case PHASE_TABLE:
            break;
        }
    }
}

trl_result profile_table_init(const trl_context *ctx, const double *altitude_m,
                              const double *density, size_t count, struct profile *out)
{
    *out = (struct profile){0};
    double *block = mem_alloc(ctx, count, 2 * sizeof *block);
    if (!block) {
        return TRL_ERROR_MEMORY;
    }
    memcpy(block, altitude_m, count * sizeof *block);
    memcpy(block + count, density, count * sizeof *block);
    *out = (struct profile){
        .kind = PROFILE_TABLE, .altitude_m = block, .density = block + count, .count = count};
    return TRL_OK;
}

trl_result phase_table_init(const trl_context *ctx, const double *angle_rad, const double *value,
                            size_t count, struct phase *out)
{
    *out = (struct phase){0};
    double *block = mem_alloc(ctx, count, 2 * sizeof *block);
    if (!block) {
        return TRL_ERROR_MEMORY;
    }
    memcpy(block, angle_rad, count * sizeof *block);
    memcpy(block + count, value, count * sizeof *block);
    *out = (struct phase){
        .kind = PHASE_TABLE, .angle_rad = block, .value = block + count, .count = count};
    double total = 0;
    phase_moments(out, 0, &total);
    for (size_t i = 0; i < count; i++) {
        out->value[i] /= total;
    }
    return TRL_OK;
}

struct quantity {
    const struct spectrum *spectrum;
    const char *name;
    double max;
};

static trl_result check_quantity(const trl_context *ctx, const struct quantity *q, double nm)
{
    const double value = spectrum_at(q->spectrum, nm);
    if (value >= 0 && value <= q->max) {
        return TRL_OK;
    }
    return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SCENE,
                    "%s is %g at %g nm; must be >= 0 and <= %g", q->name, value, nm, q->max);
}

trl_result medium_check(const trl_context *ctx, const struct medium *medium, double nm)
{
    const struct quantity albedo = {&medium->ground_albedo, "ground albedo", 1};
    const struct quantity star = {&medium->star_irradiance, "the star's irradiance",
                                  MEDIUM_MAX_IRRADIANCE};
    trl_result result = check_quantity(ctx, &albedo, nm);
    if (result == TRL_OK) {
        result = check_quantity(ctx, &star, nm);
    }
    for (size_t i = 0; result == TRL_OK && i < medium->constituent_count; i++) {
        const struct constituent *c = &medium->constituents[i];
        const struct quantity scattering = {&c->scattering_per_m, "scattering per metre",
                                            MEDIUM_MAX_PER_M};
        const struct quantity absorption = {&c->absorption_per_m, "absorption per metre",
                                            MEDIUM_MAX_PER_M};
        result = check_quantity(ctx, &scattering, nm);
        if (result == TRL_OK) {
            result = check_quantity(ctx, &absorption, nm);
        }
    }
    return result;
}

void constituent_finish(const trl_context *ctx, struct constituent *constituent)
{
    mem_free(ctx, constituent->name);
    spectrum_finish(ctx, &constituent->scattering_per_m);
    spectrum_finish(ctx, &constituent->absorption_per_m);
    mem_free(ctx, constituent->profile.altitude_m);
    mem_free(ctx, constituent->phase.angle_rad);
    *constituent = (struct constituent){0};
}

void medium_finish(const trl_context *ctx, struct medium *medium)
{
    spectrum_finish(ctx, &medium->ground_albedo);
    spectrum_finish(ctx, &medium->star_irradiance);
    for (size_t i = 0; i < medium->constituent_count; i++) {
        constituent_finish(ctx, &medium->constituents[i]);
    }
    *medium = (struct medium){0};
}

double medium_scattering_height(const struct medium *medium)
{
    enum { STEPS = 1000 };
    const double height_m = medium->top_radius_m - medium->ground_radius_m;
    double column = 0;
    double moment = 0;
    for (size_t i = 0; i < medium->constituent_count; i++) {
        const struct constituent *c = &medium->constituents[i];
        const double scattering = spectrum_at(&c->scattering_per_m, 550);
        for (int k = 0; k < STEPS; k++) {
            const double altitude_m = height_m * (k + 0.5) / STEPS;
            const double here = scattering * profile_density(&c->profile, altitude_m);
            column += here;
            moment += here * altitude_m;
        }
    }
    return column > 0 ? moment / column : 0;
}
