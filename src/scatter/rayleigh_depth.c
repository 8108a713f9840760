// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/rayleigh_depth.h"

#include "scatter/quadrature.h"

#include <string.h>

// Above so many scale heights nothing is left to integrate: exp(-40) is 4e-18.
#define DEEPEST 40.0

enum { EXACT_NODES = 48, FIT_POINTS = 129 };

// The inverse air mass bends at the zenith cosine sqrt(2 H / R), where a line stops being level.
// Ten times that leaves a curve that few texels and low polynomials follow; found by trying 1 to
// 12.
#define SOFTNESS 10.0

RayleighAir rayleigh_air_make(double ground_radius_m, double height_m, double scale_height_m)
{
    return (RayleighAir){.ground_m = ground_radius_m,
                         .height_m = height_m,
                         .scale_m = scale_height_m,
                         .softness = SOFTNESS * sqrt(2 * scale_height_m / ground_radius_m)};
}

// Distance to a sphere `rise` above a point, upward: the positive root of s^2 + 2 r c s - e = 0
// with e the difference of the squared radii, without cancellation.
static double find_way(double radius_m, double cosine, double rise_m)
{
    const double e = rise_m * (2 * radius_m + rise_m);
    const double along = radius_m * cosine;
    return e / (along + sqrt(along * along + e));
}

// Gauss over the root of the way, which puts nodes where the air is dense.
static double integrate(const RayleighAir *air, const struct gauss *rule, double cosine,
                        double altitude_m)
{
    const double radius = air->ground_m + altitude_m;
    const double rise = fmin(air->height_m - altitude_m, DEEPEST * air->scale_m);
    const double way = find_way(radius, cosine, rise);
    double sum = 0;
    for (int k = 0; k < rule->count; k++) {
        const double t = rule->node[k];
        const double s = way * t * t;
        const double e = s * (s + 2 * radius * cosine);
        const double above = e / (radius + sqrt(radius * radius + e));
        sum += rule->weight[k] * 2 * t * exp(-above / air->scale_m);
    }
    const double up = -air->scale_m * expm1(-(air->height_m - altitude_m) / air->scale_m);
    return up / (sum * way);
}

double rayleigh_inverse_exact(const RayleighAir *air, double cosine, double altitude_m)
{
    struct gauss rule;
    gauss_init(&rule, EXACT_NODES);
    return integrate(air, &rule, cosine, altitude_m);
}

// At the very top there is no way to integrate: straight up over slant is the cosine.
static double inverse_at(const RayleighAir *air, const struct gauss *rule, double cosine, double y)
{
    return y < 1 ? integrate(air, rule, cosine, rayleigh_map_altitude(y, air->height_m)) : cosine;
}

static void fill_map(struct rayleigh_depth *depth, const struct gauss *rule)
{
    for (int row = 0; row < RAYLEIGH_MAP_HEIGHT; row++) {
        const double y = (double)row / (RAYLEIGH_MAP_HEIGHT - 1);
        for (int c = 0; c < RAYLEIGH_MAP_WIDTH; c++) {
            const double x = (double)c / (RAYLEIGH_MAP_WIDTH - 1);
            const double cosine = rayleigh_map_cosine(x, depth->air.softness);
            depth->map[row][c] = (float)inverse_at(&depth->air, rule, cosine, y);
        }
    }
}

enum { MAX_TERMS = TRL_RAYLEIGH_MAX_DEGREE + 1 };

// Normal equations of a weighted fit.
struct equations {
    int terms;
    double matrix[MAX_TERMS][MAX_TERMS], right[MAX_TERMS];
};

static void add_point(struct equations *e, double x, double value, double weight)
{
    double power[MAX_TERMS] = {1};
    for (int i = 1; i < e->terms; i++) {
        power[i] = power[i - 1] * x;
    }
    for (int i = 0; i < e->terms; i++) {
        for (int j = 0; j < e->terms; j++) {
            e->matrix[i][j] += weight * power[i] * power[j];
        }
        e->right[i] += weight * power[i] * value;
    }
}

// Cholesky without pivots: the matrix is positive definite. The answer replaces the right side.
static void solve(struct equations *e)
{
    for (int i = 0; i < e->terms; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = e->matrix[i][j];
            for (int k = 0; k < j; k++) {
                sum -= e->matrix[i][k] * e->matrix[j][k];
            }
            e->matrix[i][j] = i == j ? sqrt(sum) : sum / e->matrix[j][j];
        }
    }
    for (int i = 0; i < e->terms; i++) {
        for (int k = 0; k < i; k++) {
            e->right[i] -= e->matrix[i][k] * e->right[k];
        }
        e->right[i] /= e->matrix[i][i];
    }
    for (int i = e->terms - 1; i >= 0; i--) {
        for (int k = i + 1; k < e->terms; k++) {
            e->right[i] -= e->matrix[k][i] * e->right[k];
        }
        e->right[i] /= e->matrix[i][i];
    }
}

// Least squares of the relative error at Chebyshev points, which are dense at both ends. Where the
// inverse goes to 0, at the horizon of the very top, errors count no more than at the sphere's.
static RayleighFit fit_height(const RayleighAir *air, const struct gauss *rule, double y,
                              int degree)
{
    struct equations e = {.terms = degree + 1};
    const double floor = inverse_at(air, rule, 0, 0);
    for (int i = 0; i < FIT_POINTS; i++) {
        const double x = 0.5 - 0.5 * cos(SHARED_PI * i / (FIT_POINTS - 1));
        const double value = inverse_at(air, rule, rayleigh_map_cosine(x, air->softness), y);
        const double weight = 1 / fmax(value, floor);
        add_point(&e, x, value, weight * weight);
    }
    solve(&e);
    const double *c = e.right;
    return (RayleighFit){c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]};
}

void rayleigh_depth_init(struct rayleigh_depth *depth, const RayleighAir *air,
                         const trl_rayleigh_desc *desc)
{
    memset(depth, 0, sizeof *depth);
    depth->air = *air;
    depth->kind = desc->optical_depth;
    struct gauss rule;
    gauss_init(&rule, EXACT_NODES);
    if (depth->kind == TRL_RAYLEIGH_TEXTURE) {
        fill_map(depth, &rule);
        return;
    }
    depth->fit_heights = (int)desc->fit_heights;
    for (int i = 0; i < depth->fit_heights; i++) {
        const double y = (double)i / (depth->fit_heights - 1);
        depth->fit[i] = fit_height(air, &rule, y, (int)desc->fit_degree);
    }
}

// The lower of the two rows (or columns) that a coordinate in [0, 1] lies between, and its share
// of the way to the upper one.
static int find_cell(double coordinate, int count, double *share)
{
    const double at = coordinate * (count - 1);
    const int low = at >= count - 1 ? count - 2 : (int)at;
    *share = at - low;
    return low;
}

static double mix(double a, double b, double share)
{
    return a + (b - a) * share;
}

double rayleigh_depth_inverse(const struct rayleigh_depth *depth, double cosine, double altitude_m)
{
    const double x = rayleigh_map_x(cosine, depth->air.softness);
    const double y = rayleigh_map_y(altitude_m, depth->air.height_m);
    double up = 0;
    if (depth->kind == TRL_RAYLEIGH_FIT) {
        const int row = find_cell(y, depth->fit_heights, &up);
        return mix(rayleigh_fit_value(depth->fit[row], x),
                   rayleigh_fit_value(depth->fit[row + 1], x), up);
    }
    double along = 0;
    const int row = find_cell(y, RAYLEIGH_MAP_HEIGHT, &up);
    const int column = find_cell(x, RAYLEIGH_MAP_WIDTH, &along);
    const float *low = &depth->map[row][column];
    const float *high = &depth->map[row + 1][column];
    return mix(mix((double)low[0], (double)low[1], along),
               mix((double)high[0], (double)high[1], along), up);
}

static double read_column(const struct rayleigh_depth *depth, double cosine, double altitude_m)
{
    return rayleigh_column(depth->air, altitude_m,
                           rayleigh_depth_inverse(depth, cosine, altitude_m));
}

double rayleigh_depth_along(const struct rayleigh_depth *depth, double cos_phi, double altitude_m,
                            double closest_m)
{
    const double mirrored = read_column(depth, fmin(fabs(cos_phi), 1), altitude_m);
    return cos_phi > 0 ? rayleigh_beyond(read_column(depth, 0, fmax(closest_m, 0)), mirrored)
                       : mirrored;
}

double rayleigh_depth_g(const struct rayleigh_depth *depth, double phi_rad, double altitude_m)
{
    const RayleighAir *air = &depth->air;
    if (altitude_m < 0) {
        return (double)INFINITY;
    }
    const double cosine = cos(phi_rad); // even in phi
    const double along = (air->ground_m + altitude_m) * cosine;
    const double closest = rayleigh_closest(*air, rayleigh_excess(*air, altitude_m), along);
    if (altitude_m > air->height_m && (cosine <= 0 || closest > air->height_m)) {
        return 0;
    }
    return cosine > 0 && closest < 0 ? (double)INFINITY
                                     : rayleigh_depth_along(depth, cosine, altitude_m, closest);
}

struct rayleigh_errors rayleigh_depth_errors(const struct rayleigh_depth *depth)
{
    struct gauss rule;
    gauss_init(&rule, EXACT_NODES);
    struct rayleigh_errors errors = {0, 0};
    for (int j = 0; j < RAYLEIGH_CHECKS; j++) {
        const double altitude_m = depth->air.height_m * (j + 0.5) / RAYLEIGH_CHECKS;
        for (int i = 0; i < RAYLEIGH_CHECKS; i++) {
            const double cosine = sin(SHARED_PI / 2 * i / (RAYLEIGH_CHECKS - 1));
            const double exact = integrate(&depth->air, &rule, cosine, altitude_m);
            // Of the column, which is 1 over this.
            const double error =
                fabs(exact / fmax(rayleigh_depth_inverse(depth, cosine, altitude_m), 1e-6) - 1);
            errors.mean += error / (RAYLEIGH_CHECKS * RAYLEIGH_CHECKS);
            errors.largest = fmax(errors.largest, error);
        }
    }
    return errors;
}
