// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/sunlight.h"

#include <math.h>

enum { COLUMNS = 256, DISC_NODES = 12, NODES_PER_SHELL = 40 };

// Light grazes the edges of dense layers within few metres: the levels grow as the logarithm of the
// depth.
static const double LEVELS = 96;
static const double DENSE_LEVELS = 60;
static const double MOST_LEVELS = 256;
static const double POINT_DISC_RAD = 1e-4; // stands for a star without extent

struct sunlight_row sunlight_row_at(double ground_radius_m, double radius_m, double disc_rad)
{
    const double horizon_rad = M_PI - asin(fmin(1, ground_radius_m / radius_m));
    const double lowest = cos(fmin(M_PI, horizon_rad + disc_rad));
    return (struct sunlight_row){lowest, 1 / log1p((1 - lowest) / SUNLIGHT_SOFT)};
}

static double row_coordinate(struct sunlight_row row, double mu)
{
    return log1p(fmax(0, mu - row.lowest_mu) / SUNLIGHT_SOFT) * row.scale;
}

static double row_mu(struct sunlight_row row, double coordinate)
{
    return row.lowest_mu + SUNLIGHT_SOFT * expm1(coordinate / row.scale);
}

// Where a coordinate in [0, 1] lies between nodes.
struct cell {
    int index;
    double part;
};

static struct cell find_cell(double coordinate, int count)
{
    const double position = fmin(coordinate, 1) * (count - 1);
    const int index = position < count - 2 ? (int)position : count - 2;
    return (struct cell){index, position - index};
}

// Columns to the top of the medium over (level, coordinate) of a point star, one plane per
// constituent.
struct columns {
    const struct optics *optics;
    int levels;
    double *length_m;
};

static double *columns_at(const struct columns *columns, int level, int column)
{
    return columns->length_m + ((size_t)level * COLUMNS + (size_t)column) * MEDIUM_MAX_CONSTITUENTS;
}

static int choose_levels(const struct optics *optics)
{
    const double dense = DENSE_LEVELS * log(fmax(optics_largest_depth(optics), 1));
    return (int)fmin(LEVELS + dense, MOST_LEVELS);
}

static double level_radius(const struct columns *columns, int level)
{
    const double shell = (double)level / (columns->levels - 1);
    return columns->optics->ground_radius_m + optics_altitude(columns->optics, shell);
}

static void fill_column_level(const struct columns *columns, const struct ray_rules *rules,
                              struct ray *ray, int level)
{
    const struct optics *optics = columns->optics;
    const double radius_m = level_radius(columns, level);
    const struct sunlight_row row = sunlight_row_at(optics->ground_radius_m, radius_m, 0);
    for (int c = 0; c < COLUMNS; c++) {
        // A hair above the horizon, lest rounding makes the lowest ray hit the ground.
        const double mu = fmin(1, row_mu(row, (double)c / (COLUMNS - 1)) + 1e-12);
        const struct ray_desc desc = {
            .radius_m = radius_m, .mu = mu, .nodes_per_shell = NODES_PER_SHELL, .end_m = INFINITY};
        ray_init(ray, optics, rules, &desc);
        for (int i = 0; i < optics->constituent_count; i++) {
            columns_at(columns, level, c)[i] = ray->column_m[i];
        }
    }
}

static lanes transmittance_of_point(const struct columns *columns, int level,
                                    struct sunlight_row row, double mu)
{
    const struct cell cell = find_cell(row_coordinate(row, mu), COLUMNS);
    const double *a = columns_at(columns, level, cell.index);
    const double *b = columns_at(columns, level, cell.index + 1);
    lanes depth = {0};
    for (int i = 0; i < columns->optics->constituent_count; i++) {
        depth += columns->optics->extinction_per_m[i] * (float)(a[i] + cell.part * (b[i] - a[i]));
    }
    return lanes_exp_negative(-depth);
}

// Means over the disc, which is cut into horizontal chords of length 2 sqrt(1 - y^2): y in [-1, 1]
// is the height in disc radii; the part below the horizon is dark. y = sin(angle) makes the
// integrand smooth.
static void average_disc(const struct columns *columns, const struct gauss *rule, int level,
                         double disc_rad, double mu, lanes *transmittance, lanes *irradiance)
{
    const struct optics *optics = columns->optics;
    const double radius_m = level_radius(columns, level);
    const struct sunlight_row row = sunlight_row_at(optics->ground_radius_m, radius_m, 0);
    const double zenith_rad = acos(fmin(fmax(mu, -1), 1));
    const double horizon_rad = acos(row.lowest_mu);
    const double lowest = fmin(fmax((zenith_rad - horizon_rad) / disc_rad, -1), 1);
    const double from = asin(lowest);
    *transmittance = *irradiance = lanes_set(0);
    for (int k = 0; k < rule->count; k++) {
        const double angle = from + (M_PI_2 - from) * rule->node[k];
        const double point_mu = cos(zenith_rad - disc_rad * sin(angle));
        const double weight =
            2 / M_PI * cos(angle) * cos(angle) * (M_PI_2 - from) * rule->weight[k];
        const lanes light = transmittance_of_point(columns, level, row, point_mu) * (float)weight;
        *transmittance += light;
        *irradiance += light * (float)fmax(0, point_mu);
    }
}

static lanes logarithm(lanes transmittance)
{
    lanes v;
    for (int k = 0; k < LANES; k++) {
        v[k] = transmittance[k] > 0 ? fmaxf(logf(transmittance[k]), SUNLIGHT_DARK) : SUNLIGHT_DARK;
    }
    return v;
}

static void fill_level(struct sunlight *sun, const struct columns *columns,
                       const struct gauss *rule, int level)
{
    const struct sunlight_row row =
        sunlight_row_at(sun->optics->ground_radius_m, level_radius(columns, level), sun->disc_rad);
    for (int c = 0; c < COLUMNS; c++) {
        lanes transmittance;
        lanes irradiance;
        average_disc(columns, rule, level, sun->disc_rad, row_mu(row, (double)c / (COLUMNS - 1)),
                     &transmittance, &irradiance);
        sun->log_transmittance[level * COLUMNS + c] = logarithm(transmittance);
        if (level == 0) {
            sun->ground_irradiance[c] = irradiance;
        }
    }
}

static void fill_table(struct sunlight *sun, const struct columns *columns,
                       const struct ray_rules *rules, struct ray *scratch, int scratch_count)
{
    struct gauss rule;
    gauss_init(&rule, DISC_NODES);
    (void)scratch_count; // without OpenMP there is one
#pragma omp parallel for schedule(dynamic) num_threads(scratch_count)
    for (int level = 0; level < sun->levels; level++) {
        const unsigned state = lanes_flush_denormals();
        fill_column_level(columns, rules, &scratch[lanes_thread()], level);
        fill_level(sun, columns, &rule, level);
        lanes_restore(state);
    }
}

trl_result sunlight_reserve(const trl_context *ctx, const struct optics *optics,
                            struct sunlight *out)
{
    *out = (struct sunlight){.optics = optics, .levels = choose_levels(optics), .columns = COLUMNS};
    out->disc_rad = fmax(optics->medium->star_angular_radius_rad, POINT_DISC_RAD);
    out->log_transmittance = mem_alloc(ctx, (size_t)out->levels * COLUMNS, sizeof(lanes));
    out->ground_irradiance = mem_alloc(ctx, COLUMNS, sizeof(lanes));
    if (!out->log_transmittance || !out->ground_irradiance) {
        sunlight_finish(ctx, out);
        return TRL_ERROR_MEMORY;
    }
    return TRL_OK;
}

trl_result sunlight_fill(const trl_context *ctx, const struct ray_rules *rules,
                         struct sunlight *sun)
{
    const int threads = lanes_max_threads();
    struct columns columns = {
        sun->optics, sun->levels,
        mem_alloc(ctx, (size_t)sun->levels * COLUMNS * MEDIUM_MAX_CONSTITUENTS, sizeof(double))};
    struct ray *scratch = mem_alloc(ctx, (size_t)threads, sizeof *scratch);
    const bool has_memory = columns.length_m && scratch;
    if (has_memory) {
        fill_table(sun, &columns, rules, scratch, threads);
    }
    mem_free(ctx, columns.length_m);
    mem_free(ctx, scratch);
    return has_memory ? TRL_OK : TRL_ERROR_MEMORY;
}

void sunlight_finish(const trl_context *ctx, struct sunlight *sun)
{
    mem_free(ctx, sun->log_transmittance);
    mem_free(ctx, sun->ground_irradiance);
    *sun = (struct sunlight){0};
}

// Straight between columns, by logarithms between levels, as transport.c does.
void sunlight_at(const struct sunlight *sun, double radius_m, double mu, lanes *transmittance)
{
    const struct optics *optics = sun->optics;
    const struct sunlight_row row =
        sunlight_row_at(optics->ground_radius_m, radius_m, sun->disc_rad);
    const struct cell column = find_cell(row_coordinate(row, mu), COLUMNS);
    const struct cell level =
        find_cell(optics_shell(optics, radius_m - optics->ground_radius_m), sun->levels);
    const lanes *below = sun->log_transmittance + (size_t)level.index * COLUMNS + column.index;
    const lanes *above = below + COLUMNS;
    const float part = (float)level.part;
    const lanes left = lanes_exp_negative(below[0] + (above[0] - below[0]) * part);
    const lanes right = lanes_exp_negative(below[1] + (above[1] - below[1]) * part);
    *transmittance = left + (right - left) * (float)column.part;
}

void sunlight_ground_at(const struct sunlight *sun, double mu, lanes *irradiance)
{
    const double radius_m = sun->optics->ground_radius_m;
    const struct sunlight_row row = sunlight_row_at(radius_m, radius_m, sun->disc_rad);
    const struct cell column = find_cell(row_coordinate(row, mu), COLUMNS);
    const lanes *at = sun->ground_irradiance + column.index;
    *irradiance = at[0] + (at[1] - at[0]) * (float)column.part;
}
