// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Lengths are drawn from the mixture of what the path's wavelengths want, in proportion to their
// weights, as tracer.h has it. The star is looked for at each event through level water, and from
// the eye through the facets; what leaves the water goes on as a path of the air's tracer.
#include "reference/under.h"

#include "reference/tracer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;
// Particles' scattering into smaller angles counts as none.
static const double SMALLEST_RAD = 0.05;
// Place above the surface from which paths go on in the air, relative to the radius.
static const double LIFT = 1e-9;

enum { ANGLES = 1024 };

struct reference_under_tables {
    struct reference_under under;
    int count;
    struct reference_water_optics optics[REFERENCE_LANES];
    lanes4 extinction, scattering; // without the smallest angles
    lanes4 clear;                  // part of that
    lanes4 albedo;                 // of the bed
    // Angles of equal shares of the particles' scattering beyond the smallest.
    double angle[REFERENCE_LANES][ANGLES + 1];
};

// Part of what particles scatter that is so by less than an angle: Fournier and Jonasz 1999.
static double cumulative(const struct reference_water_optics *o, double angle)
{
    const double nu = 0.5 * (3 - o->particle_slope), over = o->particle_index - 1;
    const double sine = sin(0.5 * angle), s2 = sine * sine;
    const double whole = 4 / (3 * over * over), d = whole * s2;
    if (fabs(d - 1) < 1e-5) {
        return 0.5 * (cumulative(o, angle * (1 - 1e-4)) + cumulative(o, angle * (1 + 1e-4)));
    }
    const double a = 1 - pow(d, nu + 1) - (1 - pow(d, nu)) * s2;
    const double b = (1 - pow(whole, nu)) / (8 * (whole - 1) * pow(whole, nu));
    return a / ((1 - d) * pow(d, nu)) + b * cos(angle) * sin(angle) * sin(angle);
}

static void find_angles(const struct reference_water_optics *o, double least_share, double *angle)
{
    for (int i = 0; i <= ANGLES; ++i) {
        const double wanted = least_share + (1 - least_share) * i / ANGLES;
        double low = log(SMALLEST_RAD), high = log(pi);
        for (int round = 0; round < 40; ++round) {
            const double middle = 0.5 * (low + high);
            if (cumulative(o, exp(middle)) < wanted) {
                low = middle;
            } else {
                high = middle;
            }
        }
        angle[i] = exp(0.5 * (low + high));
    }
}

trl_result reference_under_tables_make(const trl_context *ctx, const struct reference_under *under,
                                       const lanes4 *nm, int count,
                                       struct reference_under_tables **out)
{
    struct reference_under_tables *t = mem_alloc(ctx, 1, sizeof *t);
    *out = t;
    if (!t) {
        return TRL_ERROR_MEMORY;
    }
    t->under = *under;
    t->count = count;
    for (int k = 0; k < count; ++k) {
        struct reference_water_optics *o = &t->optics[k];
        under->optics(under->user, (*nm)[k], o);
        const double least = cumulative(o, SMALLEST_RAD);
        const double particles = o->particles_per_m * (1 - least);
        t->scattering[k] = o->clear_per_m + particles;
        t->extinction[k] = o->absorption_per_m + t->scattering[k];
        t->clear[k] = t->scattering[k] > 0 ? o->clear_per_m / t->scattering[k] : 1;
        t->albedo[k] = o->bed_albedo;
        find_angles(o, least, t->angle[k]);
    }
    return TRL_OK;
}

void reference_under_tables_destroy(const trl_context *ctx, struct reference_under_tables **tables)
{
    mem_free(ctx, *tables);
    *tables = NULL;
}

static double density_of(const struct reference_under_tables *t, int lane, double cosine)
{
    const double ratio = (1 - 0.09) / (1 + 0.09);
    const double clear = 3 / (4 * pi) * (1 + ratio * cosine * cosine) / (3 + ratio);
    const double angle = acos(fmin(fmax(cosine, -1), 1)), *angles = t->angle[lane];
    int low = 0, high = ANGLES;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (angles[middle] <= angle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const double ring = 2 * pi * (cos(angles[low]) - cos(angles[high]));
    const double particles = angle > angles[0] ? 1.0 / ANGLES / ring : 0;
    return t->clear[lane] * clear + (1 - t->clear[lane]) * particles;
}

static lanes4 densities(const struct reference_under_tables *t, double cosine)
{
    lanes4 value = {0};
    for (int k = 0; k < t->count; ++k) {
        value[k] = density_of(t, k, cosine);
    }
    return value;
}

static double draw_cosine(const struct reference_under_tables *t, int lane,
                          struct reference_path *path)
{
    if (reference_next(path) < t->clear[lane]) {
        const double ratio = (1 - 0.09) / (1 + 0.09);
        double x = 2 * reference_next(path) - 1;
        while (reference_next(path) * (1 + ratio) > 1 + ratio * x * x) {
            x = 2 * reference_next(path) - 1;
        }
        return x;
    }
    const int i = (int)(reference_next(path) * ANGLES); // even in the cosine within a share
    const double a = cos(t->angle[lane][i]), b = cos(t->angle[lane][i + 1]);
    return a + (b - a) * reference_next(path);
}

static int draw_lane(const struct reference_under_tables *t, struct reference_path *path)
{
    const lanes4 shares = reference_shares(path);
    double left = reference_next(path);
    int lane = 0;
    while (lane < t->count - 1 && left >= shares[lane]) {
        left -= shares[lane++];
    }
    return lane;
}

// By Fresnel's coefficients of both polarisations as ratios of sines and tangents; from the water.
static double reflect_below(double cosine, double index)
{
    const double in = acos(fmin(fmax(cosine, 0), 1)), sine = index * sin(in);
    if (sine >= 1) {
        return 1;
    }
    if (in < 1e-4) {
        return pow((index - 1) / (index + 1), 2);
    }
    const double out = asin(sine);
    const double across = sin(in - out) / sin(in + out), along = tan(in - out) / tan(in + out);
    return 0.5 * (across * across + along * along);
}

// What a walk knows of its star and place.
struct walk {
    const struct reference_under_tables *t;
    struct vec3 up, star; // at the surface, refracted
    double star_mu;       // of that
    lanes4 sent;          // irradiance of a plane that faces the star, above the surface
    lanes4 beam;          // below it, of one that faces the refracted star
    double depth_m;
    bool is_direct; // nothing was met but the surface
};

static void find_star(const struct reference_tracer *tracer, struct reference_path *path,
                      struct walk *w)
{
    const struct reference_under *under = &w->t->under;
    struct reference_path above = *path;
    above.position = vec3_scale(w->up, under->level_radius_m * (1 + LIFT));
    above.is_on_ground = above.is_on_sea = above.is_in_cloud = false;
    const struct vec3 sun = path->star.direction;
    const double mu = vec3_dot(sun, w->up);
    w->sent = mu > 0 ? reference_transmittance(tracer, &above, sun) : lanes4_set(0);
    path->random = above.random;
    const struct vec3 level = vec3_scale(vec3_sub(sun, vec3_scale(w->up, mu)), 1 / under->index);
    w->star_mu = sqrt(fmax(1 - vec3_dot(level, level), 0));
    w->star = vec3_add(level, vec3_scale(w->up, w->star_mu));
    const double enters = 1 - reflect_below(w->star_mu, under->index);
    w->beam = w->sent * (enters * fmax(mu, 0) / w->star_mu);
}

static lanes4 beam_at(const struct walk *w, double depth_m)
{
    const lanes4 exponent = w->t->extinction * (-depth_m / w->star_mu);
    return w->beam * lanes4_exp(&exponent, w->t->count);
}

static struct vec3 refract_out(struct vec3 direction, struct vec3 facet, double index)
{
    const double cosine = vec3_dot(direction, facet);
    const struct vec3 along = vec3_scale(vec3_sub(direction, vec3_scale(facet, cosine)), index);
    return vec3_add(along, vec3_scale(facet, sqrt(fmax(1 - vec3_dot(along, along), 0))));
}

static struct vec3 facet_of(const struct vec3 axes[3], double x, double y)
{
    return vec3_normalize(
        vec3_sub(axes[2], vec3_add(vec3_scale(axes[0], x), vec3_scale(axes[1], y))));
}

// Smith 1967.
static double count_hidden(double mu, double mss)
{
    const double v = mu / sqrt(fmax(1 - mu * mu, 1e-14) * mss);
    return v > 6 ? 0 : 0.5 * (exp(-v * v) / (v * sqrt(pi)) - erfc(v));
}

// The star through the facets: the density of slopes over the solid angle that refracted rays turn
// through, by differences.
static double see_star(const struct walk *w, const struct vec3 axes[3], struct vec3 direction,
                       struct vec3 sun, double disc_rad)
{
    const double index = w->t->under.index;
    const struct vec3 sum = vec3_sub(vec3_scale(direction, index), sun);
    const double z = vec3_dot(sum, axes[2]);
    if (!(z > 0.05 * vec3_length(sum))) {
        return 0;
    }
    const double x = -vec3_dot(sum, axes[0]) / z, y = -vec3_dot(sum, axes[1]) / z;
    const struct vec3 facet = facet_of(axes, x, y);
    const double cosine = vec3_dot(facet, direction);
    if (!(cosine > 0) || !(vec3_dot(facet, sun) > 0)) {
        return 0;
    }
    const double step = 1e-4;
    const struct vec3 turned[2] = {
        vec3_sub(refract_out(direction, facet_of(axes, x + step, y), index),
                 refract_out(direction, facet_of(axes, x - step, y), index)),
        vec3_sub(refract_out(direction, facet_of(axes, x, y + step), index),
                 refract_out(direction, facet_of(axes, x, y - step), index))};
    const double solid_angle = vec3_length(vec3_cross(turned[0], turned[1])) / (4 * step * step);
    // The disc makes the image of the star broader.
    const double mss =
        w->t->under.mean_square_slope + disc_rad * disc_rad / (2 * (index - 1) * (index - 1));
    const double mu = vec3_dot(direction, axes[2]), facet_mu = vec3_dot(facet, axes[2]);
    const double seen =
        cosine / facet_mu /
        (mu * (1 + count_hidden(mu, mss) + count_hidden(vec3_dot(sun, axes[2]), mss)));
    return (1 - reflect_below(cosine, index)) * index * index * seen * exp(-(x * x + y * y) / mss) /
           (pi * mss) / solid_angle;
}

// At the surface from below: goes on down, or adds what the air sends and ends.
static bool meet_surface(struct walk *w, const struct reference_tracer *tracer,
                         struct reference_scratch *scratch, struct reference_path *path)
{
    const struct reference_under *under = &w->t->under;
    const struct vec3 other = fabs(w->up.z) < 0.9 ? (struct vec3){0, 0, 1} : (struct vec3){1, 0, 0};
    const struct vec3 x = vec3_normalize(vec3_cross(other, w->up));
    const struct vec3 axes[3] = {x, vec3_cross(w->up, x), w->up};
    if (w->is_direct) {
        path->radiance += path->weight * w->sent *
                          see_star(w, axes, path->direction, path->star.direction,
                                   acos(fmin(path->star.cos_radius, 1)));
    }
    const double slope = sqrt(-under->mean_square_slope * log(fmax(reference_next(path), 1e-300)));
    const double turn = 2 * pi * reference_next(path);
    const struct vec3 facet = facet_of(axes, slope * cos(turn), slope * sin(turn));
    const double cosine = vec3_dot(path->direction, facet), mu = vec3_dot(path->direction, w->up);
    if (!(cosine > 0)) {
        return false;
    }
    path->weight *=
        cosine / vec3_dot(facet, w->up) / (mu * (1 + count_hidden(mu, under->mean_square_slope)));
    const double back = reflect_below(cosine, under->index);
    if (reference_next(path) < back) {
        path->direction = vec3_sub(path->direction, vec3_scale(facet, 2 * cosine));
        const double rises = vec3_dot(path->direction, w->up);
        if (rises > -1e-3) { // to the level at least
            path->direction =
                vec3_normalize(vec3_sub(path->direction, vec3_scale(w->up, rises + 1e-3)));
        }
        w->depth_m = 0;
        return true;
    }
    struct reference_path air = *path;
    air.direction = refract_out(path->direction, facet, under->index);
    const double rises = vec3_dot(air.direction, w->up);
    if (rises < 1e-3) {
        air.direction = vec3_normalize(vec3_add(air.direction, vec3_scale(w->up, 1e-3 - rises)));
    }
    air.position = vec3_scale(w->up, under->level_radius_m * (1 + LIFT));
    reference_trace(tracer, scratch, &air);
    path->radiance += path->weight * air.radiance * (under->index * under->index);
    return false;
}

static void meet_bed(struct walk *w, struct reference_path *path)
{
    path->weight *= w->t->albedo;
    path->radiance += path->weight * beam_at(w, w->t->under.depth_m) * (w->star_mu / pi);
    path->direction =
        reference_turn(w->up, sqrt(reference_next(path)), 2 * pi * reference_next(path));
    w->depth_m = w->t->under.depth_m;
    w->is_direct = false;
}

static void scatter(struct walk *w, struct reference_path *path)
{
    path->radiance +=
        path->weight * beam_at(w, w->depth_m) * densities(w->t, vec3_dot(path->direction, w->star));
    const int lane = draw_lane(w->t, path);
    const double cosine = draw_cosine(w->t, lane, path);
    const lanes4 density = densities(w->t, cosine), shares = reference_shares(path);
    const lanes4 mixed = shares * density;
    path->weight *= density / lanes4_sum(&mixed);
    path->direction = reference_turn(path->direction, cosine, 2 * pi * reference_next(path));
    w->is_direct = false;
}

// To the next event; false at the path's end.
static bool advance(struct walk *w, const struct reference_tracer *tracer,
                    struct reference_scratch *scratch, struct reference_path *path)
{
    const struct reference_under_tables *t = w->t;
    const double mu = vec3_dot(path->direction, w->up);
    const double end_m = fabs(mu) < 1e-9 ? 1e9
                         : mu > 0        ? w->depth_m / mu
                                         : (t->under.depth_m - w->depth_m) / -mu;
    const lanes4 shares = reference_shares(path);
    const double way_m =
        -log(fmax(reference_next(path), 1e-300)) / t->extinction[draw_lane(t, path)];
    const bool is_through = way_m >= end_m;
    const lanes4 exponent = t->extinction * -fmin(way_m, end_m);
    const lanes4 passed = lanes4_exp(&exponent, t->count);
    const lanes4 mixed = shares * passed * (is_through ? lanes4_set(1) : t->extinction);
    path->weight *= passed * (is_through ? lanes4_set(1) : t->scattering) / lanes4_sum(&mixed);
    if (is_through) {
        if (mu > 0) {
            return meet_surface(w, tracer, scratch, path);
        }
        meet_bed(w, path);
    } else {
        w->depth_m -= mu * way_m;
        scatter(w, path);
    }
    if (lanes4_sum(&path->weight) < 0.05 * t->count) { // roulette
        path->weight = reference_next(path) < 0.5 ? 2 * path->weight : lanes4_set(0);
    }
    return lanes4_sum(&path->weight) > 0;
}

void reference_under_trace(const struct reference_under_tables *tables,
                           const struct reference_tracer *tracer, struct reference_scratch *scratch,
                           struct reference_path *path)
{
    const double radius = vec3_length(path->position);
    struct walk w = {.t = tables,
                     .up = vec3_scale(path->position, 1 / radius),
                     .depth_m = fmax(tables->under.level_radius_m - radius, 0),
                     .is_direct = true};
    path->weight = lanes4_set(0);
    for (int k = 0; k < tables->count; ++k) {
        path->weight[k] = 1 / (tables->under.index * tables->under.index);
    }
    path->radiance = lanes4_set(0);
    find_star(tracer, path, &w);
    while (advance(&w, tracer, scratch, path)) {
    }
}
