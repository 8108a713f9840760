// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Where the shells of the air lie, and the densities in them.
#include "reference/shells.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_DEPTH = 10, MIN_SHELLS = 16, MAX_SPLITS = 64, MAX_PROBES = 3 };

// How far the extinction within a shell may bend away from a straight line, relative to its largest
// value. An exponential reaches it over about half a scale height.
static const double max_bend = 0.03;
static const double max_shell_depth = 1; // vertical
// Extinction below this optical depth along the longest ray is not worth a finer shell.
static const double negligible_depth = 1e-12;

// What decides how thin shells are: the extinction at a few wavelengths.
struct cutter {
    const struct reference_air *air;
    int probe_count;
    double extinction_per_m[MAX_PROBES][MEDIUM_MAX_CONSTITUENTS];
};

struct bounds {
    double *altitude_m; // NULL: only counted
    size_t count;
};

static double density_exact(const struct reference_air *air, size_t constituent, double altitude_m)
{
    const double thickness = air->medium->top_radius_m - air->medium->ground_radius_m;
    return altitude_m <= thickness
               ? profile_density(&air->medium->constituents[constituent].profile, altitude_m)
               : 0;
}

// The shortest, the longest, and one between.
static void choose_probes(const struct reference_wavelengths *wavelengths, struct cutter *cutter)
{
    const struct medium *medium = cutter->air->medium;
    const size_t last = wavelengths->count - 1;
    const size_t index[MAX_PROBES] = {0, last, last / 2};
    cutter->probe_count = (int)(wavelengths->count < MAX_PROBES ? wavelengths->count : MAX_PROBES);
    for (int p = 0; p < cutter->probe_count; ++p) {
        const double nm = wavelengths->nm[index[p]];
        for (size_t i = 0; i < medium->constituent_count; ++i) {
            const struct constituent *c = &medium->constituents[i];
            cutter->extinction_per_m[p][i] =
                spectrum_at(&c->scattering_per_m, nm) + spectrum_at(&c->absorption_per_m, nm);
        }
    }
}

static double extinction_exact(const struct cutter *cutter, int probe, double altitude_m)
{
    double sum = 0;
    for (size_t i = 0; i < cutter->air->medium->constituent_count; ++i) {
        const double extinction = cutter->extinction_per_m[probe][i];
        sum += extinction > 0 ? extinction * density_exact(cutter->air, i, altitude_m) : 0;
    }
    return sum;
}

static double thickness(const struct reference_air *air)
{
    return air->top_radius_m - air->bottom_radius_m;
}

static double longest_ray(const struct reference_air *air)
{
    const double top = air->top_radius_m, bottom = air->bottom_radius_m;
    return 2 * sqrt((top - bottom) * (top + bottom));
}

static bool is_smooth_at(const struct cutter *cutter, int probe, double low_m, double high_m)
{
    // The ends belong to neighbours, where a profile may jump.
    const double margin = 1e-9 * (high_m - low_m);
    double value[5], largest = 0;
    for (int i = 0; i < 5; ++i) {
        const double inside =
            fmin(fmax(i / 4.0 * (high_m - low_m), margin), high_m - low_m - margin);
        value[i] = extinction_exact(cutter, probe, low_m + inside);
        largest = fmax(largest, value[i]);
    }
    if (largest * longest_ray(cutter->air) < negligible_depth) {
        return true;
    }
    double bend = 0;
    for (int i = 1; i < 4; ++i) {
        bend = fmax(bend, fabs(value[i] - value[0] - (value[4] - value[0]) * i / 4));
    }
    return bend <= max_bend * largest && largest * (high_m - low_m) <= max_shell_depth &&
           high_m - low_m <= thickness(cutter->air) / MIN_SHELLS;
}

static bool is_smooth(const struct cutter *cutter, double low_m, double high_m)
{
    for (int p = 0; p < cutter->probe_count; ++p) {
        if (!is_smooth_at(cutter, p, low_m, high_m)) {
            return false;
        }
    }
    return true;
}

static void append_bound(struct bounds *bounds, double altitude_m)
{
    if (bounds->altitude_m) {
        bounds->altitude_m[bounds->count] = altitude_m;
    }
    ++bounds->count;
}

// Appends the upper bounds of the shells between the two altitudes.
static void split_interval(const struct cutter *cutter, double low_m, double high_m, int depth,
                           struct bounds *bounds)
{
    if (depth == MAX_DEPTH || is_smooth(cutter, low_m, high_m)) {
        append_bound(bounds, high_m);
        return;
    }
    const double middle_m = 0.5 * (low_m + high_m);
    split_interval(cutter, low_m, middle_m, depth + 1, bounds);
    split_interval(cutter, middle_m, high_m, depth + 1, bounds);
}

static void append_kinks(const struct profile *profile, struct bounds *kinks)
{
    switch (profile->kind) {
    case PROFILE_UNIFORM:
    case PROFILE_EXPONENTIAL:
        break;
    case PROFILE_TENT:
        append_bound(kinks, profile->centre_m - profile->half_width_m);
        append_bound(kinks, profile->centre_m);
        append_bound(kinks, profile->centre_m + profile->half_width_m);
        break;
    case PROFILE_TABLE:
        for (size_t i = 0; i < profile->count; ++i) {
            append_bound(kinks, profile->altitude_m[i]);
        }
        break;
    }
}

static void collect_kinks(const struct reference_air *air, struct bounds *kinks)
{
    append_bound(kinks, air->lowest_m);
    append_bound(kinks, air->lowest_m + thickness(air));
    append_bound(kinks, air->medium->top_radius_m - air->medium->ground_radius_m);
    for (size_t i = 0; i < air->medium->constituent_count; ++i) {
        append_kinks(&air->medium->constituents[i].profile, kinks);
    }
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Sorts and drops what is outside the air or equal.
static void clean_kinks(const struct reference_air *air, struct bounds *kinks)
{
    qsort(kinks->altitude_m, kinks->count, sizeof(double), compare_doubles);
    const double highest_m = air->lowest_m + thickness(air);
    size_t kept = 0;
    for (size_t i = 0; i < kinks->count; ++i) {
        const double altitude_m = kinks->altitude_m[i];
        const bool is_inside = altitude_m >= air->lowest_m && altitude_m <= highest_m;
        if (is_inside && (kept == 0 || altitude_m > kinks->altitude_m[kept - 1])) {
            kinks->altitude_m[kept++] = altitude_m;
        }
    }
    kinks->count = kept;
}

static void split_all(const struct cutter *cutter, const struct bounds *kinks,
                      struct bounds *bounds)
{
    append_bound(bounds, kinks->altitude_m[0]);
    for (size_t i = 0; i + 1 < kinks->count; ++i) {
        split_interval(cutter, kinks->altitude_m[i], kinks->altitude_m[i + 1], 0, bounds);
    }
}

static trl_result make_bounds(const trl_context *ctx, const struct cutter *cutter,
                              struct reference_air *air)
{
    struct bounds kinks = {0};
    collect_kinks(air, &kinks);
    kinks.altitude_m = mem_alloc(ctx, kinks.count, sizeof(double));
    if (!kinks.altitude_m) {
        return TRL_ERROR_MEMORY;
    }
    kinks.count = 0;
    collect_kinks(air, &kinks);
    clean_kinks(air, &kinks);

    struct bounds bounds = {0};
    split_all(cutter, &kinks, &bounds);
    bounds.altitude_m = mem_alloc(ctx, bounds.count, sizeof(double));
    if (bounds.altitude_m) {
        bounds.count = 0;
        split_all(cutter, &kinks, &bounds);
        air->bound_m = bounds.altitude_m;
        air->shell_count = bounds.count - 1;
    }
    mem_free(ctx, kinks.altitude_m);
    return bounds.altitude_m ? TRL_OK : TRL_ERROR_MEMORY;
}

// Just inside the shell, so that a jump of a profile falls between shells.
static double knot_altitude(const struct reference_air *air, size_t shell, int knot)
{
    const double low_m = air->bound_m[shell], high_m = air->bound_m[shell + 1];
    const double margin = 1e-9 * (high_m - low_m);
    const double at_m = low_m + (high_m - low_m) * knot / SHELL_INTERVALS;
    return fmin(fmax(at_m, low_m + margin), high_m - margin);
}

static trl_result fill_shells(const trl_context *ctx, struct reference_air *air)
{
    const size_t knots = air->shell_count * (SHELL_INTERVALS + 1);
    air->density = mem_alloc(ctx, knots, (air->constituent_count + 1) * sizeof(double));
    if (!air->density) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t shell = 0; shell < air->shell_count; ++shell) {
        for (int i = 0; i <= SHELL_INTERVALS; ++i) {
            double *densities =
                air->density + (shell * (SHELL_INTERVALS + 1) + (size_t)i) * air->constituent_count;
            for (size_t c = 0; c < air->constituent_count; ++c) {
                densities[c] = density_exact(air, c, knot_altitude(air, shell, i));
            }
        }
    }
    return TRL_OK;
}

trl_result reference_air_init(const trl_context *ctx, const struct medium *medium,
                              const struct reference_wavelengths *wavelengths,
                              const struct reference_extent *extent, struct reference_air *air)
{
    *air = (struct reference_air){
        .medium = medium,
        .lowest_m = extent->lowest_m,
        .bottom_radius_m = medium->ground_radius_m + extent->lowest_m,
        .top_radius_m = fmax(medium->top_radius_m, medium->ground_radius_m + extent->highest_m),
        .constituent_count = medium->constituent_count};
    air->split_length_m = fmax(0.5 * thickness(air), longest_ray(air) / MAX_SPLITS);
    struct cutter cutter = {.air = air};
    choose_probes(wavelengths, &cutter);
    trl_result result = make_bounds(ctx, &cutter, air);
    if (result == TRL_OK) {
        result = fill_shells(ctx, air);
    }
    if (result != TRL_OK) {
        reference_air_finish(ctx, air);
    }
    return result;
}

void reference_air_finish(const trl_context *ctx, struct reference_air *air)
{
    mem_free(ctx, air->bound_m);
    mem_free(ctx, air->density);
    *air = (struct reference_air){0};
}
