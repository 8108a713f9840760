// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Every ray of a path either collides with the air, hits the ground, or, in dense air, goes on
// behind what has been looked at. A cloud ends the ray at a place that is drawn beforehand, as
// often as its light comes from there; the air before it is then as before solid ground. A path
// never leaves: its weight is multiplied with the chance that it would not have. Where it collides
// is drawn from a mixture of densities over the pieces of the ray: by what the air scatters (right
// by day), by that times the sunlight which is there, and by height (right in twilight); within a
// piece by the optical depth, exactly. The weight is the true density over the drawn one, so any
// mixture gives the same expectation.
#include "reference/tracer.h"

#include <math.h>

// Share of collisions drawn as if the air scattered although it only absorbs: covers pieces of rays
// in which the share varies.
static const double floor_share = 0.01;
// The sunlit part of a ray's scattering at which it is halved.
static const double sunlit_knee = 1e-6;
// A ray is looked at up to this transmittance; what is behind it is one more place to go on from.
// In twilight farther: what is lit may lie behind much that is not.
static const double day_far = 0.02, twilight_far = 1e-7;
// Ground with light of its own is worth a visit though it may be black.
static const double glowing_worth = 0.2;
// How far above terrain a path goes on, relative to the radius: millimetres.
static const double lift = 1e-9;
// The optical depth within a piece is inverted to this part of the whole.
static const double depth_tolerance = 1e-8;
enum { MAX_INVERSION_STEPS = 40 };

// Water sends back less than most ground, but into few directions.
static const double sea_worth = 0.2;

// A ray of the path with all that is known about it.
struct flight {
    struct reference_ray ray;
    lanes4 share; // of each wavelength in the decisions
    double glow_share;
    bool hits_ground, hits_cloud, is_cut; // is_cut: there is more behind the stretches
    size_t count;                         // of stretches
    double density[DENSITY_COUNT];
    lanes4 end_transmittance;
    struct reference_look look; // where it hits the ground
    lanes4 albedo, glow;
};

// How far toward the sun from the planet's centre a ray begins, and how fast it goes there.
struct sunward {
    double begin_m, slope;
};

// Sunlight, about, where the ray is at `s_m`.
static double guess_light(const struct reference_tracer *tracer, const struct reference_ray *ray,
                          const struct sunward *sunward, double s_m)
{
    const double radius = sqrt(ray->perigee2_m2 + s_m * s_m);
    const double toward_sun = sunward->begin_m + sunward->slope * (s_m - ray->begin_m);
    return sun_guide_at(&tracer->world->guide, radius - tracer->world->air.bottom_radius_m,
                        toward_sun / radius);
}

static void weigh_stretch(const struct reference_tracer *tracer, const struct flight *flight,
                          struct reference_stretch *stretch)
{
    const struct reference_optics *optics = &tracer->optics;
    struct reference_columns columns;
    reference_air_columns(&tracer->world->air, &flight->ray, &stretch->piece, stretch->piece.end_m,
                          &columns);
    stretch->depth = reference_optics_extinction(optics, &columns);
    const lanes4 scattering = reference_optics_scattering(optics, &columns);
    const lanes4 exponent = -stretch->depth;
    const lanes4 hit = -lanes4_expm1(&exponent, optics->count);
    stretch->passed = lanes4_set(1) - hit;
    stretch->transmittance = flight->end_transmittance;
    for (int k = 0; k < optics->count; ++k) {
        const double part = stretch->depth[k] > 0 ? scattering[k] / stretch->depth[k] : 0;
        stretch->worth[k] = stretch->transmittance[k] * (part + floor_share);
    }
    stretch->scattered = stretch->worth * hit;
    const lanes4 shared = flight->share * stretch->scattered;
    stretch->density[BY_SCATTERING] = lanes4_sum(&shared);
}

static void weigh_for_twilight(const struct reference_tracer *tracer, const struct flight *flight,
                               const struct sunward *sunward, struct reference_stretch *stretch)
{
    const double scattered = stretch->density[BY_SCATTERING];
    const double light = 0.5 * (guess_light(tracer, &flight->ray, sunward, stretch->piece.begin_m) +
                                guess_light(tracer, &flight->ray, sunward, stretch->piece.end_m));
    stretch->density[BY_SUNLIGHT] = scattered * light;
    stretch->density[BY_HEIGHT] = sqrt(scattered);
}

// Cuts the ray into stretches, as far as light comes through.
static void weigh_ray(const struct reference_tracer *tracer, const struct reference_path *path,
                      struct reference_scratch *scratch, struct flight *flight)
{
    const struct sunward sunward = {.begin_m = vec3_dot(path->position, path->star.direction),
                                    .slope = vec3_dot(path->direction, path->star.direction)};
    const bool is_twilight = flight->glow_share > 0;
    const double far = is_twilight ? twilight_far : day_far;
    flight->end_transmittance = lanes4_set(1);
    struct reference_walk walk = reference_walk_begin(&tracer->world->air, &flight->ray);
    struct reference_stretch *stretch = scratch->stretches;
    for (; !flight->is_cut && reference_walk_next(&walk, &stretch->piece); ++stretch) {
        weigh_stretch(tracer, flight, stretch);
        if (is_twilight) {
            weigh_for_twilight(tracer, flight, &sunward, stretch);
        }
        for (int k = 0; k < (is_twilight ? DENSITY_COUNT : 1); ++k) {
            flight->density[k] += stretch->density[k];
        }
        flight->end_transmittance *= stretch->passed;
        const lanes4 shared = flight->share * flight->end_transmittance;
        flight->is_cut = lanes4_sum(&shared) < far;
    }
    flight->count = (size_t)(stretch - scratch->stretches);
    const struct reference_stretch *last = stretch - 1;
    flight->is_cut = flight->is_cut && last->piece.end_m < flight->ray.end_m;
    if (flight->is_cut) {
        flight->ray.end_m = last->piece.end_m;
        flight->hits_ground = flight->hits_cloud = false;
    }
}

static void look_at_ground(const struct reference_tracer *tracer, const struct reference_path *path,
                           struct flight *flight)
{
    const struct reference_surface *surface = tracer->world->scene.surface;
    const double way_m = flight->ray.end_m - flight->ray.begin_m;
    const struct vec3 at = vec3_add(path->position, vec3_scale(path->direction, way_m));
    flight->look = (struct reference_look){.normal = vec3_normalize(at)};
    flight->albedo = tracer->optics.ground_albedo;
    if (!surface) {
        return;
    }
    surface->look(surface->user, at, &flight->look);
    lanes4 albedo = {0};
    for (int c = 0; c < 3; ++c) {
        albedo += tracer->colour_albedo[c] * flight->look.albedo_rgb[c];
        flight->glow += tracer->colour_albedo[c] * flight->look.glow_rgb[c];
    }
    flight->glow *= tracer->glow;
    for (int k = 0; k < tracer->optics.count; ++k) {
        if (flight->look.has_colour) {
            flight->albedo[k] = fmin(fmax(albedo[k], 0), 1);
        }
        flight->glow[k] = fmax(flight->glow[k], 0);
    }
}

static void look_for_cloud(const struct reference_tracer *tracer, struct reference_path *path,
                           struct flight *flight)
{
    const struct reference_clouds_way way = {path->position, path->direction,
                                             flight->ray.end_m - flight->ray.begin_m};
    const double met_m = reference_clouds_meet(tracer->world->scene.clouds, &way, &path->random);
    if (met_m < way.length_m) {
        flight->ray.end_m = flight->ray.begin_m + met_m;
        flight->hits_cloud = true;
        flight->hits_ground = false;
    }
}

static struct flight prepare(const struct reference_tracer *tracer, struct reference_path *path,
                             struct reference_scratch *scratch)
{
    const struct reference_surface *surface = tracer->world->scene.surface;
    const double mu = vec3_dot(path->position, path->direction) / vec3_length(path->position);
    struct flight flight = {
        .ray = reference_air_ray(&tracer->world->air, reference_path_radius(tracer, path), mu),
        .share = reference_shares(path),
        .glow_share = reference_find_glow(path).share};
    flight.hits_ground = flight.ray.hits_bottom;
    if (tracer->world->scene.clouds) {
        look_for_cloud(tracer, path, &flight);
    }
    if (surface) {
        const struct reference_way way = {path->position, path->direction,
                                          flight.ray.end_m - flight.ray.begin_m, 0};
        const double met_m =
            reference_surface_meet(surface, tracer->world->scene.medium->ground_radius_m, &way);
        flight.hits_ground = met_m >= 0;
        flight.hits_cloud = flight.hits_cloud && met_m < 0;
        flight.ray.end_m = flight.hits_ground ? flight.ray.begin_m + met_m : flight.ray.end_m;
    }
    weigh_ray(tracer, path, scratch, &flight);
    if (flight.hits_ground) {
        look_at_ground(tracer, path, &flight);
    }
    return flight;
}

struct mixture {
    double share[DENSITY_COUNT]; // their sum is 1
};

static struct mixture mix_densities(const struct flight *flight)
{
    const double knee = sunlit_knee * flight->density[BY_SCATTERING];
    const double sunlit =
        flight->glow_share * flight->density[BY_SUNLIGHT] / (flight->density[BY_SUNLIGHT] + knee);
    const double high = (1 - sunlit) * flight->glow_share;
    return (struct mixture){
        {[BY_SCATTERING] = 1 - sunlit - high, [BY_SUNLIGHT] = sunlit, [BY_HEIGHT] = high}};
}

static enum reference_density draw_density(const struct mixture *mixture,
                                           struct reference_path *path)
{
    const double u = reference_next(path);
    if (u < mixture->share[BY_SUNLIGHT]) {
        return BY_SUNLIGHT;
    }
    return u < mixture->share[BY_SUNLIGHT] + mixture->share[BY_HEIGHT] ? BY_HEIGHT : BY_SCATTERING;
}

// Draws a stretch; `probability` is that of the mixture.
static const struct reference_stretch *draw_stretch(const struct flight *flight,
                                                    const struct reference_scratch *scratch,
                                                    struct reference_path *path,
                                                    double *probability)
{
    const struct mixture mixture = mix_densities(flight);
    const enum reference_density drawn = draw_density(&mixture, path);
    double left = reference_next(path) * flight->density[drawn];
    const struct reference_stretch *chosen = scratch->stretches;
    for (size_t i = 0; i < flight->count && left >= 0; ++i) {
        const struct reference_stretch *stretch = &scratch->stretches[i];
        if (stretch->density[drawn] > 0) {
            chosen = stretch; // the last one that is possible, if rounding leaves something
            left -= stretch->density[drawn];
        }
    }
    *probability = 0;
    for (int k = 0; k < DENSITY_COUNT; ++k) {
        if (mixture.share[k] > 0) {
            *probability += mixture.share[k] * chosen->density[k] / flight->density[k];
        }
    }
    return chosen;
}

static int draw_lane(const lanes4 *weights, int count, struct reference_path *path)
{
    double left = reference_next(path) * lanes4_sum(weights);
    int chosen = 0;
    for (int k = 0; k < count && left >= 0; ++k) {
        if ((*weights)[k] > 0) {
            chosen = k;
            left -= (*weights)[k];
        }
    }
    return chosen;
}

// Where the optical depth from the stretch's begin reaches `depth`: Newton's steps, between bounds.
static double find_depth(const struct reference_tracer *tracer, const struct reference_ray *ray,
                         const struct reference_stretch *stretch, int lane, double depth)
{
    const struct reference_air *air = &tracer->world->air;
    double low = stretch->piece.begin_m, high = stretch->piece.end_m;
    double s_m = low + (high - low) * fmin(depth / stretch->depth[lane], 1);
    for (int i = 0; i < MAX_INVERSION_STEPS; ++i) {
        struct reference_columns columns, densities;
        reference_air_columns(air, ray, &stretch->piece, s_m, &columns);
        const double error = reference_optics_extinction(&tracer->optics, &columns)[lane] - depth;
        if (fabs(error) <= depth_tolerance * stretch->depth[lane]) {
            break;
        }
        low = error < 0 ? s_m : low;
        high = error < 0 ? high : s_m;
        reference_air_densities(air, ray, stretch->piece.shell, s_m, &densities);
        s_m -= error / reference_optics_extinction(&tracer->optics, &densities)[lane];
        s_m = s_m > low && s_m < high ? s_m : 0.5 * (low + high);
    }
    return s_m;
}

// Moves the path to a collision; its weight gets scattering and transmittance over the drawn
// density.
static void collide(const struct reference_tracer *tracer, const struct flight *flight,
                    struct reference_scratch *scratch, struct reference_path *path)
{
    const struct reference_air *air = &tracer->world->air;
    const struct reference_optics *optics = &tracer->optics;
    double probability;
    const struct reference_stretch *stretch = draw_stretch(flight, scratch, path, &probability);
    const lanes4 shared = flight->share * stretch->scattered;
    const int lane = draw_lane(&shared, optics->count, path);
    const double inside = -expm1(-stretch->depth[lane]);
    const double s_m =
        find_depth(tracer, &flight->ray, stretch, lane, -log1p(-reference_next(path) * inside));

    struct reference_columns columns;
    reference_air_columns(air, &flight->ray, &stretch->piece, s_m, &columns);
    reference_air_densities(air, &flight->ray, stretch->piece.shell, s_m, &path->densities);
    const lanes4 exponent = -reference_optics_extinction(optics, &columns);
    const lanes4 passed = lanes4_exp(&exponent, optics->count);
    const lanes4 drawn = flight->share * stretch->worth * passed *
                         reference_optics_extinction(optics, &path->densities);
    const double density = probability * lanes4_sum(&drawn) / stretch->density[BY_SCATTERING];
    path->weight *= reference_optics_scattering(optics, &path->densities) * stretch->transmittance *
                    passed / density;
    path->position =
        vec3_add(path->position, vec3_scale(path->direction, s_m - flight->ray.begin_m));
    path->is_on_ground = path->is_on_sea = path->is_in_cloud = false;
}

static void hit_ground(const struct reference_tracer *tracer, const struct flight *flight,
                       struct reference_path *path)
{
    const double ground = tracer->world->scene.medium->ground_radius_m;
    const struct vec3 at = vec3_add(
        path->position, vec3_scale(path->direction, flight->ray.end_m - flight->ray.begin_m));
    path->position = tracer->world->scene.surface ? vec3_scale(at, 1 + lift)
                                                  : vec3_scale(vec3_normalize(at), ground);
    path->is_on_ground = true;
    path->is_in_cloud = false;
    path->normal = flight->look.normal;
    path->albedo = flight->albedo;
    path->radiance += path->weight * flight->glow;
    path->is_on_sea = flight->look.water > 0 && reference_next(path) < flight->look.water;
    if (path->is_on_sea) {
        path->facets = (struct reference_facets){.up = vec3_normalize(at),
                                                 .view = vec3_scale(path->direction, -1),
                                                 .depth_code = flight->look.depth_code,
                                                 .nm = &tracer->nm};
    } else {
        path->weight *= flight->albedo;
    }
}

// Moves on to the end of what has been looked at.
static void move_on(const struct flight *flight, struct reference_path *path)
{
    path->position = vec3_add(path->position,
                              vec3_scale(path->direction, flight->ray.end_m - flight->ray.begin_m));
}

static void enter_cloud(const struct reference_tracer *tracer, const struct flight *flight,
                        struct reference_path *path)
{
    move_on(flight, path);
    path->weight *= tracer->world->scene.clouds->albedo;
    path->densities = (struct reference_columns){{0}};
    path->is_on_ground = path->is_on_sea = false;
    path->is_in_cloud = true;
}

static double cloud_worth(const struct reference_tracer *tracer, const struct flight *flight)
{
    const lanes4 arrived = flight->share * flight->end_transmittance;
    return flight->hits_cloud ? tracer->world->scene.clouds->albedo * lanes4_sum(&arrived) : 0;
}

static double ground_worth(const struct flight *flight, int count)
{
    double worth = 0;
    for (int k = 0; k < count && flight->hits_ground; ++k) {
        const double least =
            fmax(flight->glow[k] > 0 ? glowing_worth : 0, sea_worth * flight->look.water);
        worth += flight->share[k] * flight->end_transmittance[k] * fmax(flight->albedo[k], least);
    }
    return worth;
}

bool reference_advance(const struct reference_tracer *tracer, struct reference_scratch *scratch,
                       struct reference_path *path)
{
    while (lanes4_sum(&path->weight) > 0) {
        const struct flight flight = prepare(tracer, path, scratch);
        const lanes4 far = flight.share * flight.end_transmittance;
        const double behind = flight.is_cut ? lanes4_sum(&far) : 0;
        const double ground = ground_worth(&flight, tracer->optics.count);
        const double air = flight.density[BY_SCATTERING];
        const double cloud = cloud_worth(tracer, &flight);
        const double all = air + ground + cloud + behind;
        if (!(all > 0)) {
            return false;
        }
        const double drawn = reference_next(path) * all;
        if (drawn < ground) {
            path->weight *= flight.end_transmittance * (all / ground);
            hit_ground(tracer, &flight, path);
            return lanes4_sum(&path->weight) > 0;
        }
        if (drawn < ground + air) {
            path->weight *= all / air;
            collide(tracer, &flight, scratch, path);
            return lanes4_sum(&path->weight) > 0;
        }
        if (drawn < ground + air + cloud) {
            path->weight *= flight.end_transmittance * (all / cloud);
            enter_cloud(tracer, &flight, path);
            return lanes4_sum(&path->weight) > 0;
        }
        path->weight *= flight.end_transmittance * (all / behind);
        move_on(&flight, path);
    }
    return false;
}
