// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Directions are drawn from what the air's phase functions or Lambert's cosine want, mixed with two
// lobes that know where light comes from: in twilight the part of the sky that glows, by day the
// star itself, as the sharp phase functions of the place would spread it. Without the latter, light
// that is scattered twice by a sharp phase function is found by few paths that then count for many.
#include "reference/tracer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

// The glow of twilight as a lobe: Henyey-Greenstein about the horizontal toward the sun, tilted up;
// its share of the directions grows as the sun goes down from one cosine of its zenith angle by a
// range of them.
static const double glow_g = 0.75, glow_height = 0.1;
static const double glow_share = 0.5, glow_begin_mu = 0.03, glow_range_mu = 0.08;
// Only the first orders know of it in full: each use may double the weight, and the product of all
// the factors 1 / (1 - share) must stay bounded however long the path is.
static const double glow_orders = 2;

// The same for the lobe about the star, at most, and the sunlight at which it is halved.
static const double star_share = 0.35, star_orders = 6, star_knee = 0.01;

struct reference_glow reference_find_glow(const struct reference_path *path)
{
    const struct vec3 sun = path->star.direction, up = vec3_normalize(path->position);
    const double mu_sun = vec3_dot(sun, up);
    const double fade = path->order / glow_orders;
    const struct vec3 level = vec3_normalize(vec3_sub(sun, vec3_scale(up, mu_sun)));
    return (struct reference_glow){
        .axis = vec3_normalize(vec3_add(level, vec3_scale(up, glow_height))),
        .share = glow_share / fmax(1, fade * fade) *
                 fmin(fmax((glow_begin_mu - mu_sun) / glow_range_mu, 0), 1)};
}

// The mixture that a direction is drawn from.
struct lobes {
    double share[MEDIUM_MAX_CONSTITUENTS]; // of each constituent's phase function; none on ground
    double star_share;
    double star_part[MEDIUM_MAX_CONSTITUENTS]; // of each constituent in the lobe about the star
    struct reference_glow glow;
};

static void find_constituents(const struct reference_tracer *tracer,
                              const struct reference_path *path, struct lobes *lobes)
{
    const struct reference_optics *optics = &tracer->optics;
    const lanes4 all = reference_optics_scattering(optics, &path->densities);
    const lanes4 shares = reference_shares(path);
    for (size_t i = 0; i < optics->constituent_count; ++i) {
        lobes->share[i] = 0;
        for (int k = 0; k < optics->count; ++k) {
            const double here = optics->scattering[i][k] * path->densities.of[i];
            lobes->share[i] += here > 0 ? shares[k] * here / all[k] : 0;
        }
    }
}

static struct lobes find_lobes(const struct reference_tracer *tracer,
                               const struct reference_path *path)
{
    struct lobes lobes = {.glow = reference_find_glow(path)};
    find_constituents(tracer, path, &lobes);
    double sharp = 0;
    for (size_t i = 0; i < tracer->optics.constituent_count; ++i) {
        lobes.star_part[i] = lobes.share[i] * tracer->world->sharpness[i];
        sharp += lobes.star_part[i];
    }
    if (sharp > 0) {
        const double radius = vec3_length(path->position);
        const double mu_sun = vec3_dot(path->position, path->star.direction) / radius;
        const double light = sun_guide_at(&tracer->world->guide,
                                          radius - tracer->world->air.bottom_radius_m, mu_sun);
        const double fade = path->order / star_orders;
        lobes.star_share = fmin(sharp, 1) * star_share * light / (light + star_knee) /
                           fmax(1, fade * fade) * (1 - lobes.glow.share);
        for (size_t i = 0; i < tracer->optics.constituent_count; ++i) {
            lobes.star_part[i] /= sharp;
        }
    }
    return lobes;
}

static double lobe_density(const struct reference_tracer *tracer, const double *parts,
                           double cosine)
{
    double density = 0;
    for (size_t i = 0; i < tracer->optics.constituent_count; ++i) {
        if (parts[i] > 0) {
            density += parts[i] * phase_sampler_density(&tracer->world->samplers[i], cosine);
        }
    }
    return density;
}

static double draw_lobe(const struct reference_tracer *tracer, const double *parts,
                        struct reference_path *path)
{
    double left = reference_next(path);
    size_t chosen = 0;
    for (size_t i = 0; i < tracer->optics.constituent_count && left >= 0; ++i) {
        if (parts[i] > 0) {
            chosen = i; // the last one that is possible, if rounding leaves something
            left -= parts[i];
        }
    }
    return phase_sampler_draw(&tracer->world->samplers[chosen], &path->random);
}

static double density_of(const struct reference_tracer *tracer, const struct reference_path *path,
                         const struct lobes *lobes, struct vec3 direction)
{
    const double plain =
        path->is_in_cloud ? reference_clouds_phase(tracer->world->scene.clouds,
                                                   vec3_dot(path->direction, direction))
        : path->is_on_sea
            ? reference_sea_density(&tracer->world->scene.surface->sea, &path->facets, direction)
        : path->is_on_ground
            ? fmax(0, vec3_dot(path->normal, direction)) / pi
            : lobe_density(tracer, lobes->share, vec3_dot(path->direction, direction));
    double density = (1 - lobes->glow.share - lobes->star_share) * plain;
    if (lobes->star_share > 0) {
        density += lobes->star_share * lobe_density(tracer, lobes->star_part,
                                                    vec3_dot(path->star.direction, direction));
    }
    if (lobes->glow.share > 0) {
        const struct phase lobe = {.kind = PHASE_HENYEY_GREENSTEIN, .g = glow_g};
        density += lobes->glow.share * phase_value(&lobe, vec3_dot(lobes->glow.axis, direction));
    }
    return density;
}

double reference_direction_density(const struct reference_tracer *tracer,
                                   const struct reference_path *path, struct vec3 direction)
{
    const struct lobes lobes = find_lobes(tracer, path);
    return density_of(tracer, path, &lobes, direction);
}

static struct vec3 draw_direction(const struct reference_tracer *tracer, const struct lobes *lobes,
                                  struct reference_path *path)
{
    const double drawn = reference_next(path);
    struct vec3 axis = path->is_on_ground ? path->normal : path->direction;
    double cosine;
    if (drawn < lobes->star_share) {
        axis = path->star.direction;
        cosine = draw_lobe(tracer, lobes->star_part, path);
    } else if (drawn < lobes->star_share + lobes->glow.share) {
        axis = lobes->glow.axis;
        cosine = phase_draw_henyey_greenstein(glow_g, &path->random);
    } else if (path->is_on_sea) {
        return reference_sea_draw(&tracer->world->scene.surface->sea, &path->facets, &path->random);
    } else if (path->is_in_cloud) {
        cosine = reference_clouds_draw(tracer->world->scene.clouds, &path->random);
    } else if (path->is_on_ground) {
        cosine = sqrt(reference_next(path));
    } else {
        cosine = draw_lobe(tracer, lobes->share, path);
    }
    return reference_turn(axis, cosine, 2 * pi * reference_next(path));
}

lanes4 reference_ground_value(const struct reference_tracer *tracer,
                              const struct reference_path *path, struct vec3 direction)
{
    return path->is_on_sea
               ? reference_sea_value(&tracer->world->scene.surface->sea, &path->facets, direction)
               : lanes4_set(fmax(0, vec3_dot(path->normal, direction)) / pi);
}

lanes4 reference_phase(const struct reference_tracer *tracer, const struct reference_path *path,
                       double cosine)
{
    if (path->is_in_cloud) {
        return lanes4_set(reference_clouds_phase(tracer->world->scene.clouds, cosine));
    }
    const struct reference_optics *optics = &tracer->optics;
    const lanes4 all = reference_optics_scattering(optics, &path->densities);
    lanes4 value = {0};
    for (size_t i = 0; i < optics->constituent_count; ++i) {
        const lanes4 here = optics->scattering[i] * path->densities.of[i];
        if (lanes4_sum(&here) > 0) {
            value +=
                here * phase_value(&tracer->world->scene.medium->constituents[i].phase, cosine);
        }
    }
    for (int k = 0; k < REFERENCE_LANES; ++k) {
        value[k] = all[k] > 0 ? value[k] / all[k] : 0;
    }
    return value;
}

bool reference_shares_disc(const struct reference_tracer *tracer, const struct reference_star *star)
{
    return tracer->world->highest_phase * reference_star_solid_angle(star) > 0.01;
}

void reference_redirect(const struct reference_tracer *tracer, struct reference_path *path)
{
    const struct lobes lobes = find_lobes(tracer, path);
    const struct vec3 direction = draw_direction(tracer, &lobes, path);
    const double density = density_of(tracer, path, &lobes, direction);
    if (path->is_on_ground) {
        path->weight *= reference_ground_value(tracer, path, direction) / density;
    } else {
        path->weight *=
            reference_phase(tracer, path, vec3_dot(path->direction, direction)) / density;
    }
    path->direction = direction;
    if (!path->is_on_ground && reference_shares_disc(tracer, &path->star) &&
        vec3_dot(direction, path->star.direction) > path->star.cos_radius) {
        const double solid_angle = reference_star_solid_angle(&path->star);
        const double share = density / (density + 1 / solid_angle);
        const double radiance = 2 / ((1 + path->star.cos_radius) * solid_angle);
        path->radiance +=
            path->weight * reference_transmittance(tracer, path, direction) * (radiance * share);
    }
}
