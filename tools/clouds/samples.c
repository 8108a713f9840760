// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "samples.h"

#include "cloud/traced.h"
#include "shared/cloud.glsl"

#include <math.h>

static const double radius_m = 6371000, pi = 3.14159265358979323846, far_m = 60000;

// Of a path: orders that all look toward the star, and how often later ones do; up to which order
// directions are also drawn around the star's, and how often.
enum { FIRST_ORDERS = 6, MOST_ORDERS = 3000 };
static const double look_share = 0.25, star_share = 0.1;

// As cloud_sun_depth in shaders/cloud/field.glsl.
enum { SUN_PLACES = 6, SUN_FINE_PLACES = 3 };
static const double sun_reach = 0.3125, sun_box = 0.25, least_side_m = 10;

struct sampler {
    struct cloud_field field;
    struct reference_clouds clouds;
    const struct cloud_layer *layer;
    const struct cloud_sky *sky;
    double thick_m;
};

static struct vec3 turned(struct vec3 axis, double cosine, double angle)
{
    const struct vec3 other = fabs(axis.z) < 0.9 ? (struct vec3){0, 0, 1} : (struct vec3){1, 0, 0};
    const struct vec3 u = vec3_normalize(vec3_cross(axis, other));
    const struct vec3 v = vec3_cross(axis, u);
    const double sine = sqrt(fmax(0, 1 - cosine * cosine));
    return vec3_normalize(
        vec3_add(vec3_scale(axis, cosine),
                 vec3_add(vec3_scale(u, sine * cos(angle)), vec3_scale(v, sine * sin(angle)))));
}

static struct vec3 draw_around(struct vec3 axis, double cosine, struct random_stream *random)
{
    return turned(axis, cosine, 2 * pi * random_next(random));
}

static double height_of(const struct sampler *s, struct vec3 place)
{
    return (vec3_length(place) - radius_m - s->layer->base_m) / s->thick_m;
}

static double level_of(const struct sampler *s, double side_m)
{
    return log2(fmax(side_m / (s->layer->scale_m / CLOUD_SIDE), 1 / CLOUD_DETAIL_TILES));
}

// A box that is looked at, with both noises.
struct box {
    CloudNoise noise;
    double level;
};

static struct box look(const struct sampler *s, struct vec3 place, double side_m, bool is_fine)
{
    const double level = level_of(s, side_m);
    const struct cloud_place at = cloud_field_place(&s->field, 0, place);
    const CloudNoise finer =
        is_fine ? cloud_field_noise(&s->field, at.finer, level + log2(CLOUD_DETAIL_TILES))
                : (CloudNoise){0.5, 0.5};
    return (struct box){cloud_joint_noise(cloud_field_noise(&s->field, at.noise, level), finer,
                                          cloud_field_detail(s->layer->type)),
                        level};
}

static double beyond(const struct sampler *s, const struct box *box, double cover, double height)
{
    return box->noise.value -
           cloud_threshold(cover, cloud_height_signal(height, cloud_field_peak(s->layer->type)));
}

// As cloud_from_inside.
static double extinction_from_inside(const struct sampler *s, struct vec3 place,
                                     const struct box *box, double cover, double from_height,
                                     double along_m)
{
    const double way_m = cloud_clump(s->thick_m, s->layer->scale_m,
                                     s->layer->scale_m / CLOUD_SIDE * exp2(box->level));
    const double x = beyond(s, box, cover, height_of(s, place));
    const double first = beyond(s, box, cover, from_height);
    const double part = cloud_part(x, box->noise.spread);
    const double of_it = fmin(part / fmax(cloud_part(first, box->noise.spread), 1e-4), 1);
    const double met = part + (of_it - part) * exp(-along_m / way_m);
    const double density = cloud_density(x, box->noise.spread, cloud_field_edge(s->layer->type));
    return cloud_extinction(density / fmax(part, 1e-4) * met, met, s->layer->extinction_per_m,
                            way_m);
}

static double near_depth(const struct sampler *s, struct vec3 place, struct vec3 sun, double cover,
                         double reach_m)
{
    double sum = 0, from_m = 0;
    for (int i = 1; i <= SUN_PLACES; i++) {
        const double to_m = reach_m * i * i / (SUN_PLACES * SUN_PLACES);
        const double along_m = 0.5 * (from_m + to_m);
        const struct vec3 there = vec3_add(place, vec3_scale(sun, along_m));
        const struct box box =
            look(s, there, fmax(sun_box * (to_m - from_m), least_side_m), i <= SUN_FINE_PLACES);
        sum += (to_m - from_m) *
               extinction_from_inside(s, there, &box, cover, height_of(s, place), along_m);
        from_m = to_m;
    }
    return sum;
}

// Exactly, up to a depth of 30.
static double far_depth(const struct sampler *s, struct vec3 place, struct vec3 sun, double from_m)
{
    static const double step_m = 20;
    double sum = 0;
    for (double at_m = from_m + 0.5 * step_m; at_m < far_m && sum < 30; at_m += step_m) {
        const struct vec3 there = vec3_add(place, vec3_scale(sun, at_m));
        if (height_of(s, there) > 1) {
            break;
        }
        sum += step_m * cloud_field_extinction(&s->field, 0, there, level_of(s, 0));
    }
    return sum;
}

static double density_at(const struct sampler *s, struct vec3 place, double side_m, double cover)
{
    const struct box box = look(s, place, side_m, false);
    return cloud_density(beyond(s, &box, cover, height_of(s, place)), box.noise.spread,
                         cloud_field_edge(s->layer->type));
}

static void find_around(const struct sampler *s, struct vec3 place, struct vec3 sun,
                        struct cloud_sample *out)
{
    const struct vec3 up = vec3_normalize(place);
    const double cover = cloud_field_gathered(&s->field, 0, place, 0);
    const double side_m = cloud_side(s->thick_m, s->layer->scale_m);
    const double reach_m = fmin((1 - out->height) * s->thick_m / fmax(out->sun_mu, 0.02),
                                sun_reach * s->layer->scale_m);
    const struct vec3 rise = vec3_scale(up, side_m);
    out->depth = near_depth(s, place, sun, cover, reach_m);
    out->far = far_depth(s, place, sun, reach_m);
    out->side = CLOUD_DIFFUSE_DEPTH * s->layer->extinction_per_m * side_m;
    out->whole = CLOUD_DIFFUSE_DEPTH * s->layer->extinction_per_m * s->thick_m * cover;
    out->cover = cover;
    out->around_above = density_at(s, vec3_add(place, rise), side_m, cover);
    out->around_below = density_at(s, vec3_sub(place, rise), side_m, cover);
}

// The horizontal direction toward the star.
static struct vec3 horizontal(struct vec3 up, struct vec3 sun)
{
    return vec3_normalize(vec3_sub(sun, vec3_scale(up, vec3_dot(up, sun))));
}

struct path {
    struct vec3 place, direction;
    double weight;
    int sun; // of cloud_sky_suns_deg
};

static double starlight(const struct sampler *s, const struct path *path, struct vec3 sun,
                        struct random_stream *random)
{
    const struct reference_clouds_way way = {path->place, sun, far_m};
    return path->weight * reference_clouds_phase(&s->clouds, vec3_dot(path->direction, sun)) *
           reference_clouds_passed(&s->clouds, &way, random);
}

// Follows light back. Sharp phase functions toward the star are met by few paths, so early
// directions are drawn from a mixture with that around the star.
static void follow(const struct sampler *s, struct path path, struct vec3 sun,
                   struct random_stream *random, struct cloud_sample *sum)
{
    for (int order = 1; order < MOST_ORDERS; order++) {
        const bool is_first = order <= FIRST_ORDERS;
        if (is_first || random_next(random) < look_share) {
            const double light = starlight(s, &path, sun, random) / (is_first ? 1 : look_share);
            *(order == 1 ? &sum->once : &sum->several) += light;
        }
        const double share = is_first ? star_share : 0;
        const struct vec3 axis = random_next(random) < share ? sun : path.direction;
        const struct vec3 next =
            draw_around(axis, reference_clouds_draw(&s->clouds, random), random);
        const double own = reference_clouds_phase(&s->clouds, vec3_dot(path.direction, next));
        const double about = reference_clouds_phase(&s->clouds, vec3_dot(sun, next));
        path.weight *= own / ((1 - share) * own + share * about);
        path.direction = next;
        const struct reference_clouds_way way = {path.place, next, far_m};
        const double met_m = reference_clouds_meet(&s->clouds, &way, random);
        if (isinf(met_m)) {
            const struct vec3 up = vec3_normalize(path.place);
            sum->above += vec3_dot(up, next) > 0 ? path.weight : 0;
            const double x = vec3_dot(horizontal(up, sun), next);
            sum->turned += path.weight * x;
            sum->horizon += path.weight * cloud_sky_rest(s->sky, path.sun, vec3_dot(up, next), x);
            return;
        }
        path.place = vec3_add(path.place, vec3_scale(next, met_m));
    }
}

// Where a ray from below or above the clouds meets them.
static struct path find_place(const struct sampler *s, struct random_stream *random)
{
    const double top_m = s->layer->top_m;
    for (;;) {
        const struct vec3 up =
            draw_around((struct vec3){0, 0, 1}, 2 * random_next(random) - 1, random);
        const bool is_below = random_next(random) < 0.4;
        const double altitude_m =
            is_below ? fmin(10, 0.5 * s->layer->base_m + 10) : top_m + 2500 * random_next(random);
        const double sine =
            is_below ? 0.1 + 0.7 * random_next(random) : 0.2 - 0.9 * random_next(random);
        const struct reference_clouds_way way = {vec3_scale(up, radius_m + altitude_m),
                                                 draw_around(up, sine, random), 30000};
        const double met_m = reference_clouds_meet(&s->clouds, &way, random);
        if (isfinite(met_m)) {
            return (struct path){vec3_add(way.from_m, vec3_scale(way.direction, met_m)),
                                 way.direction, 1, 0};
        }
    }
}

static double error_of(double mean, double square, double paths)
{
    return sqrt(fmax(square - mean * mean, 0) / paths);
}

static void sample_place(const struct sampler *s, size_t paths, struct random_stream *random,
                         struct cloud_sample *out)
{
    struct path path = find_place(s, random);
    const struct vec3 up = vec3_normalize(path.place);
    path.sun = (int)(CLOUD_SKY_SUNS * random_next(random));
    const double elevation = cloud_sky_suns_deg[path.sun] * pi / 180;
    const struct vec3 sun = draw_around(up, sin(elevation), random);
    *out = (struct cloud_sample){.sun_mu = sin(elevation),
                                 .view_mu = vec3_dot(up, path.direction),
                                 .nu = vec3_dot(sun, path.direction),
                                 .toward = vec3_dot(horizontal(up, sun), path.direction),
                                 .height = height_of(s, path.place),
                                 .horizon_mean = s->sky->mean[path.sun]};
    double several2 = 0, above2 = 0;
    const double share = 1 / (double)paths;
    for (size_t i = 0; i < paths; i++) {
        struct cloud_sample one = {0};
        follow(s, path, sun, random, &one);
        out->once += one.once * share;
        out->several += one.several * share;
        out->above += one.above * share;
        out->turned += one.turned * share;
        out->horizon += one.horizon * share;
        several2 += one.several * one.several * share;
        above2 += one.above * one.above * share;
    }
    out->several_error = error_of(out->several, several2, (double)paths);
    out->above_error = error_of(out->above, above2, (double)paths);
    find_around(s, path.place, sun, out);
}

trl_result cloud_samples_make(const trl_context *ctx, const struct cloud_plan *plan,
                              struct cloud_sample *out)
{
    const struct cloud_desc desc = {.layer_count = 1, .seed = plan->seed, .layers = {plan->layer}};
    struct sampler s = {
        .layer = &plan->layer, .sky = plan->sky, .thick_m = plan->layer.top_m - plan->layer.base_m};
    const trl_result result = cloud_field_init(ctx, &desc, radius_m, &s.field);
    if (result != TRL_OK) {
        return result;
    }
    s.clouds = cloud_field_traced(&s.field);
#pragma omp parallel for schedule(dynamic)
    for (size_t i = 0; i < plan->places; i++) {
        struct random_stream random = random_stream_for(plan->seed, 5, i);
        sample_place(&s, plan->paths, &random, &out[i]);
    }
    cloud_field_finish(&s.field);
    return TRL_OK;
}
