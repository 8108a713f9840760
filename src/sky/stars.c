// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/stars.h"

#include "spectrum/starlight.h"

#include <math.h>

// A star of the catalogue with its spectrum.
struct star {
    struct vec3 direction; // ICRS
    lanes irradiance;      // above the air, W m^-2 nm^-1
};

static void set_axes(struct stars *stars, double right_ascension_rad, double declination_rad)
{
    stars->pole = vec3_from_lat_lon(declination_rad, right_ascension_rad);
    stars->node_right_ascension_rad = right_ascension_rad + M_PI / 2;
    stars->node = vec3_from_lat_lon(0, stars->node_right_ascension_rad);
}

static void add_star(const struct catalogue_star *from, const struct extinction *extinction,
                     struct star *out)
{
    const struct spectrum body = {.kind = SPECTRUM_BLACKBODY,
                                  .blackbody = {starlight_temperature_K(from->colour_index), 1}};
    const lanes light = extinction_sample(extinction, &body);
    const double illuminance_lx = starlight_illuminance_lx(from->magnitude);
    const double unit_lx = cie_luminance(extinction_colour(extinction, &light));
    *out = (struct star){.direction = from->direction,
                         .irradiance = light * (float)(illuminance_lx / unit_lx)};
}

trl_result stars_init(const struct stars_desc *desc, struct stars *out)
{
    const trl_context *ctx = desc->ctx;
    const size_t count = desc->catalogue->count;
    *out = (struct stars){
        .ctx = ctx, .count = count, .stars = mem_alloc(ctx, count, sizeof *out->stars)};
    set_axes(out, desc->pole_right_ascension_rad, desc->pole_declination_rad);
    for (size_t i = 0; out->stars && i < count; i++) {
        add_star(&desc->catalogue->stars[i], desc->extinction, &out->stars[i]);
    }
    return out->stars ? TRL_OK : TRL_ERROR_MEMORY;
}

void stars_finish(struct stars *stars)
{
    if (stars->ctx) {
        mem_free(stars->ctx, stars->stars);
    }
    *stars = (struct stars){0};
}

struct stars_axes stars_turn(const struct stars *stars, double sidereal_rad)
{
    const double turned_rad = sidereal_rad - stars->node_right_ascension_rad;
    const struct vec3 ahead = vec3_cross(stars->pole, stars->node);
    const struct vec3 x =
        vec3_add(vec3_scale(stars->node, cos(turned_rad)), vec3_scale(ahead, sin(turned_rad)));
    return (struct stars_axes){x, vec3_cross(stars->pole, x), stars->pole};
}

static struct vec3 turn(const struct stars_axes *axes, struct vec3 v)
{
    return vec3_add(vec3_scale(axes->x, v.x),
                    vec3_add(vec3_scale(axes->y, v.y), vec3_scale(axes->z, v.z)));
}

// A body as something that hides stars.
struct cover {
    struct vec3 direction;
    double cosine; // of its angular radius
};

// What one frame needs, in the ICRS.
struct sight {
    struct sprite_frame frame;
    struct vec3 zenith;
    size_t cover_count;
    struct cover covers[CAMERA_MAX_BODIES];
};

static void add_covers(const struct camera *camera, const struct stars_axes *axes,
                       struct sight *out)
{
    for (unsigned i = 0; i < camera->body_count; i++) {
        const struct camera_body *body = &camera->bodies[i];
        const struct vec3 way_m = vec3_sub(body->position_m, camera->position_m);
        const double sine = fmin(body->radius_m / vec3_length(way_m), 1);
        out->covers[out->cover_count++] =
            (struct cover){turn(axes, vec3_normalize(way_m)), sqrt(1 - sine * sine)};
    }
}

static struct sight find_sight(const struct stars *stars, const struct stars_view *view)
{
    const struct camera *camera = view->camera;
    const struct stars_axes axes = stars_turn(stars, view->sidereal_rad);
    struct sight sight = {.frame = sprite_frame_make(camera, view->target),
                          .zenith = turn(&axes, vec3_normalize(camera->position_m))};
    sight.frame.right = turn(&axes, camera->right);
    sight.frame.up = turn(&axes, camera->up);
    sight.frame.forward = turn(&axes, camera->forward);
    add_covers(camera, &axes, &sight);
    return sight;
}

static bool is_covered(const struct sight *sight, struct vec3 direction)
{
    for (size_t i = 0; i < sight->cover_count; i++) {
        if (vec3_dot(sight->covers[i].direction, direction) > sight->covers[i].cosine) {
            return true;
        }
    }
    return false;
}

void stars_add(const struct stars *stars, const struct stars_view *view, struct sprites *sprites)
{
    const struct sight sight = find_sight(stars, view);
    for (size_t i = 0; i < stars->count; i++) {
        const struct star *star = &stars->stars[i];
        struct sprite_place place;
        if (!sprite_find(&sight.frame, star->direction, &place)) {
            continue;
        }
        const double mu = vec3_dot(star->direction, sight.zenith);
        if (extinction_is_hidden(view->extinction, mu) || is_covered(&sight, star->direction)) {
            continue;
        }
        const lanes left = star->irradiance * extinction_at(view->extinction, mu);
        sprites_add(sprites, &sight.frame, &place, extinction_colour(view->extinction, &left));
    }
}
