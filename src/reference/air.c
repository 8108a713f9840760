// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/air.h"

#include <math.h>
#include <stdlib.h>

// Intervals of the linear extinction table within a shell: with the bend allowed below it is exact
// to 5e-5 of the shell's extinction at worst and 1e-5 in the mean.
enum { KNOT_INTERVALS = 32, MAX_DEPTH = 10, MIN_SHELLS = 16, MAX_SPLITS = 64 };

// How far the extinction within a shell may bend away from a straight line, relative to its largest
// value. An exponential reaches it over about half a scale height.
static const double max_bend = 0.03;
static const double max_shell_depth = 1; // vertical
// Extinction below this optical depth along the longest ray is not worth a finer shell.
static const double negligible_depth = 1e-12;

struct bounds {
    double *altitude_m; // NULL: only counted
    size_t count;
};

static double extinction_exact(const struct reference_air *air, double altitude_m)
{
    double sum = 0;
    for (size_t i = 0; i < air->medium->constituent_count; ++i) {
        if (air->extinction_per_m[i] > 0) {
            sum += air->extinction_per_m[i] *
                   profile_density(&air->medium->constituents[i].profile, altitude_m);
        }
    }
    return sum;
}

static double thickness(const struct reference_air *air)
{
    return air->medium->top_radius_m - air->medium->ground_radius_m;
}

static double longest_ray(const struct reference_air *air)
{
    const double top = air->medium->top_radius_m, ground = air->medium->ground_radius_m;
    return 2 * sqrt((top - ground) * (top + ground));
}

static bool is_smooth(const struct reference_air *air, double low_m, double high_m)
{
    double value[5], largest = 0;
    for (int i = 0; i < 5; ++i) {
        value[i] = extinction_exact(air, low_m + (high_m - low_m) * i / 4);
        largest = fmax(largest, value[i]);
    }
    if (largest * longest_ray(air) < negligible_depth) {
        return true;
    }
    double bend = 0;
    for (int i = 1; i < 4; ++i) {
        bend = fmax(bend, fabs(value[i] - value[0] - (value[4] - value[0]) * i / 4));
    }
    return bend <= max_bend * largest && largest * (high_m - low_m) <= max_shell_depth &&
           high_m - low_m <= thickness(air) / MIN_SHELLS;
}

static void append_bound(struct bounds *bounds, double altitude_m)
{
    if (bounds->altitude_m) {
        bounds->altitude_m[bounds->count] = altitude_m;
    }
    ++bounds->count;
}

// Appends the upper bounds of the shells between the two altitudes.
static void split_interval(const struct reference_air *air, double low_m, double high_m, int depth,
                           struct bounds *bounds)
{
    if (depth == MAX_DEPTH || is_smooth(air, low_m, high_m)) {
        append_bound(bounds, high_m);
        return;
    }
    const double middle_m = 0.5 * (low_m + high_m);
    split_interval(air, low_m, middle_m, depth + 1, bounds);
    split_interval(air, middle_m, high_m, depth + 1, bounds);
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
    append_bound(kinks, 0);
    append_bound(kinks, thickness(air));
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
    size_t kept = 0;
    for (size_t i = 0; i < kinks->count; ++i) {
        const double altitude_m = kinks->altitude_m[i];
        const bool is_inside = altitude_m >= 0 && altitude_m <= thickness(air);
        if (is_inside && (kept == 0 || altitude_m > kinks->altitude_m[kept - 1])) {
            kinks->altitude_m[kept++] = altitude_m;
        }
    }
    kinks->count = kept;
}

static void split_all(const struct reference_air *air, const struct bounds *kinks,
                      struct bounds *bounds)
{
    append_bound(bounds, kinks->altitude_m[0]);
    for (size_t i = 0; i + 1 < kinks->count; ++i) {
        split_interval(air, kinks->altitude_m[i], kinks->altitude_m[i + 1], 0, bounds);
    }
}

static trl_result make_bounds(const trl_context *ctx, struct reference_air *air)
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
    split_all(air, &kinks, &bounds);
    bounds.altitude_m = mem_alloc(ctx, bounds.count, sizeof(double));
    if (bounds.altitude_m) {
        bounds.count = 0;
        split_all(air, &kinks, &bounds);
        air->bound_m = bounds.altitude_m;
        air->shell_count = bounds.count - 1;
    }
    mem_free(ctx, kinks.altitude_m);
    return bounds.altitude_m ? TRL_OK : TRL_ERROR_MEMORY;
}

static double scattering_share(const struct reference_air *air, double altitude_m)
{
    double scattering = 0;
    for (size_t i = 0; i < air->medium->constituent_count; ++i) {
        scattering += air->scattering_per_m[i] *
                      profile_density(&air->medium->constituents[i].profile, altitude_m);
    }
    const double extinction = extinction_exact(air, altitude_m);
    return extinction > 0 ? scattering / extinction : 0;
}

static trl_result fill_shells(const trl_context *ctx, struct reference_air *air)
{
    air->extinction_knots = mem_alloc(ctx, air->shell_count, (KNOT_INTERVALS + 1) * sizeof(double));
    air->scattering_share = mem_alloc(ctx, air->shell_count, sizeof(double));
    if (!air->extinction_knots || !air->scattering_share) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t shell = 0; shell < air->shell_count; ++shell) {
        const double low_m = air->bound_m[shell], high_m = air->bound_m[shell + 1];
        double *knots = air->extinction_knots + shell * (KNOT_INTERVALS + 1);
        for (int i = 0; i <= KNOT_INTERVALS; ++i) {
            knots[i] = extinction_exact(air, low_m + (high_m - low_m) * i / KNOT_INTERVALS);
        }
        air->scattering_share[shell] = scattering_share(air, 0.5 * (low_m + high_m));
    }
    return TRL_OK;
}

trl_result reference_air_init(const trl_context *ctx, const struct medium *medium,
                              double wavelength_nm, struct reference_air *air)
{
    *air = (struct reference_air){
        .medium = medium,
        .star_irradiance = spectrum_at(&medium->star_irradiance, wavelength_nm),
        .ground_albedo = spectrum_at(&medium->ground_albedo, wavelength_nm)};
    for (size_t i = 0; i < medium->constituent_count; ++i) {
        const struct constituent *constituent = &medium->constituents[i];
        air->scattering_per_m[i] = spectrum_at(&constituent->scattering_per_m, wavelength_nm);
        air->extinction_per_m[i] =
            air->scattering_per_m[i] + spectrum_at(&constituent->absorption_per_m, wavelength_nm);
    }
    air->split_length_m = fmax(0.5 * thickness(air), longest_ray(air) / MAX_SPLITS);
    trl_result result = make_bounds(ctx, air);
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
    mem_free(ctx, air->extinction_knots);
    mem_free(ctx, air->scattering_share);
    *air = (struct reference_air){0};
}

struct reference_ray reference_air_ray(const struct reference_air *air, double radius_m, double mu)
{
    const double ground = air->medium->ground_radius_m;
    const double perigee2 = radius_m * radius_m * (1 - mu) * (1 + mu);
    return (struct reference_ray){.perigee2_m2 = perigee2,
                                  .begin_m = radius_m * mu,
                                  .hits_ground =
                                      mu < 0 && (radius_m <= ground || perigee2 < ground * ground)};
}

static double altitude_at(const struct reference_air *air, const struct reference_ray *ray,
                          double s_m)
{
    return sqrt(ray->perigee2_m2 + s_m * s_m) - air->medium->ground_radius_m;
}

static double extinction_in_shell(const struct reference_air *air, size_t shell, double altitude_m)
{
    const double low_m = air->bound_m[shell], high_m = air->bound_m[shell + 1];
    const double x = (altitude_m - low_m) / (high_m - low_m) * KNOT_INTERVALS;
    const double inside = fmin(fmax(x, 0), KNOT_INTERVALS);
    const int i = inside < KNOT_INTERVALS ? (int)inside : KNOT_INTERVALS - 1;
    const double *knots = air->extinction_knots + shell * (KNOT_INTERVALS + 1) + i;
    return knots[0] + (knots[1] - knots[0]) * (inside - i);
}

// Gauss-Legendre, three points.
static double integrate_extinction(const struct reference_air *air, const struct reference_ray *ray,
                                   const struct reference_piece *piece)
{
    static const double abscissa = 0.774596669241483377; // sqrt(3/5)
    const double middle = 0.5 * (piece->begin_m + piece->end_m);
    const double half_length = 0.5 * (piece->end_m - piece->begin_m);
    double value[3];
    for (int i = 0; i < 3; ++i) {
        const double s_m = middle + (i - 1) * abscissa * half_length;
        value[i] = extinction_in_shell(air, piece->shell, altitude_at(air, ray, s_m));
    }
    return half_length * (5 * (value[0] + value[2]) + 8 * value[1]) / 9;
}

double reference_air_partial_depth(const struct reference_air *air, const struct reference_ray *ray,
                                   const struct reference_piece *piece, double s_m)
{
    const struct reference_piece part = {
        .shell = piece->shell, .begin_m = piece->begin_m, .end_m = s_m};
    return integrate_extinction(air, ray, &part);
}

// Where the outward half of the ray meets the lower bound of the shell.
static double bound_crossing(const struct reference_air *air, const struct reference_ray *ray,
                             size_t shell)
{
    const double radius = air->medium->ground_radius_m + air->bound_m[shell];
    return sqrt(fmax(0, radius * radius - ray->perigee2_m2));
}

static size_t find_shell(const struct reference_air *air, double altitude_m)
{
    size_t low = 0, high = air->shell_count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (air->bound_m[middle] <= altitude_m) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

struct cutter {
    const struct reference_air *air;
    const struct reference_ray *ray;
    struct reference_piece *pieces;
    size_t count;
    double at_m;
    double depth;
};

// Moves on to `end_m` through the shell, in pieces short enough. Keeps only the sum if there is no
// room.
static void cut_to(struct cutter *cutter, size_t shell, double end_m)
{
    const double begin_m = cutter->at_m, length = end_m - begin_m;
    if (length <= 0) {
        return; // rounding at a bound
    }
    const int parts = (int)ceil(length / cutter->air->split_length_m);
    for (int i = 0; i < parts; ++i) {
        struct reference_piece piece = {.shell = shell,
                                        .begin_m = begin_m + length * i / parts,
                                        .end_m = begin_m + length * (i + 1) / parts};
        piece.optical_depth = integrate_extinction(cutter->air, cutter->ray, &piece);
        cutter->depth += piece.optical_depth;
        if (cutter->pieces) {
            cutter->pieces[cutter->count] = piece;
        }
        ++cutter->count;
    }
    cutter->at_m = end_m;
}

// Inward to the ground or the perigee; returns the shell that it ends in.
static size_t cut_inward(struct cutter *cutter, size_t shell)
{
    for (;; --shell) {
        const double crossing = bound_crossing(cutter->air, cutter->ray, shell);
        if (crossing <= 0 || (shell == 0 && !cutter->ray->hits_ground)) {
            cut_to(cutter, shell, 0);
            return shell;
        }
        cut_to(cutter, shell, -crossing);
        if (shell == 0) {
            return 0;
        }
    }
}

static void cut_ray(struct cutter *cutter)
{
    size_t shell = find_shell(cutter->air, altitude_at(cutter->air, cutter->ray, cutter->at_m));
    if (cutter->at_m < 0) {
        shell = cut_inward(cutter, shell);
    }
    if (!cutter->ray->hits_ground) {
        for (; shell < cutter->air->shell_count; ++shell) {
            cut_to(cutter, shell, bound_crossing(cutter->air, cutter->ray, shell + 1));
        }
    }
}

size_t reference_air_max_pieces(const struct reference_air *air)
{
    // Each shell twice, the perigee's shell in two halves; and the splits, of which there are no
    // more than fit into the longest ray.
    return 2 * air->shell_count + 2 + MAX_SPLITS;
}

size_t reference_air_pieces(const struct reference_air *air, const struct reference_ray *ray,
                            struct reference_piece *pieces)
{
    struct cutter cutter = {.air = air, .ray = ray, .pieces = pieces, .at_m = ray->begin_m};
    cut_ray(&cutter);
    return cutter.count;
}

double reference_air_optical_depth(const struct reference_air *air, const struct reference_ray *ray)
{
    struct cutter cutter = {.air = air, .ray = ray, .at_m = ray->begin_m};
    cut_ray(&cutter);
    return cutter.depth;
}
