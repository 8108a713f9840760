// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Which tiles a view shows, and how fine.
#include "terrain/stream.h"

#include "shared/shared.glsl"
#include "terrain/surface.h"

#include <math.h>
#include <string.h>

enum { MORE_WANTS = 1024 };
// Beside the picture: what casts shadows into it, and what a turn of the head shows next. Shadows
// are found on cells of several pixels, so twice as coarse is fine enough.
static const double BESIDE_LEVELS = 1;
// Places at a slant are seen through pixels that are longer there; see terrain/surface.frag.
static const double LEAST_SLANT = 0.02;

struct walk {
    struct stream *stream;
    const struct surface *surface;
    const struct stream_view *view;
    uint32_t layer;
    double distance_m;   // of the camera from the centre
    struct vec3 up;      // its direction from there
    double solid_m;      // the sphere that is all below ground
    double horizon_rad;  // of that sphere
    double log2_texel_m; // of level 0
    trl_result result;
};

// A cap of the sphere with the heights above it that holds a tile.
struct cap {
    struct vec3 direction;
    double angle_rad, low_m, high_m; // radii
};

static struct vec3 direction_at(const struct layer_frame *f, const struct pyramid *p,
                                uint32_t level, const double texel[2])
{
    const double x = texel[0] * p->levels[0].width / p->levels[level].width;
    const double y = texel[1] * p->levels[0].height / p->levels[level].height;
    const struct layer_geo g = layer_geo_of(f, x - 0.5, y - 0.5);
    return vec3_from_lat_lon(g.latitude, g.longitude);
}

// Two texels more on each side: slopes look beside a place, and ancestors are a little shifted.
static struct cap bound_tile(const struct walk *w, const struct pyramid_tile *tile)
{
    enum { STEPS = 4 };
    const struct stream_layer *l = &w->stream->layers[w->layer];
    const struct pyramid_level *level = &l->pyramid.levels[tile->level];
    const double x0 = tile->x * (double)PYRAMID_TILE, y0 = tile->y * (double)PYRAMID_TILE;
    const double width = fmin(PYRAMID_TILE, level->width - x0) + 4;
    const double height = fmin(PYRAMID_TILE, level->height - y0) + 4;
    const double middle[2] = {x0 - 2 + width / 2, y0 - 2 + height / 2};
    struct cap cap = {.direction = direction_at(&l->frame, &l->pyramid, tile->level, middle)};
    double chord = 0;
    for (int i = 0; i < (STEPS + 1) * (STEPS + 1); i++) {
        const double at[2] = {x0 - 2 + width * (i % (STEPS + 1)) / STEPS,
                              y0 - 2 + height * (i / (STEPS + 1)) / STEPS};
        const struct vec3 d = direction_at(&l->frame, &l->pyramid, tile->level, at);
        chord = fmax(chord, vec3_length(vec3_sub(d, cap.direction)));
    }
    // Between the places looked at a parallel bends by less than 5 %.
    cap.angle_rad = fmin(SHARED_PI, 1.05 * 2 * asin(fmin(1, chord / 2)));
    const struct surface_bounds b =
        cap.angle_rad > 1 ? (struct surface_bounds){(float)surface_min_altitude(w->surface),
                                                    (float)surface_max_altitude(w->surface)}
                          : surface_bounds_around(w->surface, cap.direction, cap.angle_rad);
    cap.low_m = w->surface->radius_m + (double)b.min;
    cap.high_m = w->surface->radius_m + (double)b.max;
    return cap;
}

static double angle_between(struct vec3 a, struct vec3 b)
{
    return 2 * asin(fmin(1, vec3_length(vec3_sub(a, b)) / 2));
}

static bool is_above_horizon(const struct walk *w, const struct cap *cap)
{
    const double away = angle_between(w->up, cap->direction) - cap->angle_rad;
    const double peak = fmax(cap->high_m, w->solid_m);
    return away <= w->horizon_rad + acos(w->solid_m / peak);
}

static bool is_in_picture(const struct walk *w, const struct cap *cap)
{
    const struct camera *c = w->view->camera;
    const double middle_m = (cap->low_m + cap->high_m) / 2;
    const double radius_m = 2 * sin(fmin(cap->angle_rad, SHARED_PI / 2) / 2) * cap->high_m +
                            (cap->high_m - cap->low_m) / 2;
    const struct vec3 v = vec3_sub(vec3_scale(cap->direction, middle_m), c->position_m);
    const double z = vec3_dot(c->forward, v);
    const double x = fabs(vec3_dot(c->right, v));
    const double y = fabs(vec3_dot(c->up, v));
    const double tx = c->tan_half_fov_x, ty = c->tan_half_fov_y;
    return z > -radius_m && x - z * tx <= radius_m * sqrt(1 + tx * tx) &&
           y - z * ty <= radius_m * sqrt(1 + ty * ty);
}

// The least width of a pixel on the ground anywhere in the cap, as terrain/surface.frag finds it:
// distance times the pixel's angle over the root of the slant.
static double least_footprint_m(const struct walk *w, const struct cap *cap)
{
    const double away = angle_between(w->up, cap->direction);
    const double least = cos(fmax(0, away - cap->angle_rad));
    const double most = cos(fmin(SHARED_PI, away + cap->angle_rad));
    const double nearest_m = fmax(cap->low_m, fmin(cap->high_m, w->distance_m * least));
    const double distance_m = sqrt(fmax(0, w->distance_m * w->distance_m + nearest_m * nearest_m -
                                               2 * w->distance_m * nearest_m * least));
    // The height of the camera above the place's tangent plane, at most.
    const double drop_m =
        fmax(fabs(cap->high_m - w->distance_m * most), fabs(cap->low_m - w->distance_m * least));
    const double slant = fmax(LEAST_SLANT, fmin(1, drop_m / fmax(distance_m, 1e-3)));
    return fmax(distance_m * w->view->pixel_rad, 1e-3) / sqrt(slant);
}

static void add_want(struct walk *w, const struct pyramid_tile *tile, double priority)
{
    struct stream *s = w->stream;
    if (s->want_count == s->want_size) {
        const size_t size = s->want_size + MORE_WANTS;
        struct stream_want *wants = mem_alloc(s->ctx, size, sizeof *wants);
        if (!wants) {
            w->result = TRL_ERROR_MEMORY;
            return;
        }
        if (s->want_count > 0) {
            memcpy(wants, s->wants, s->want_count * sizeof *wants);
        }
        mem_free(s->ctx, s->wants);
        s->wants = wants;
        s->want_size = size;
    }
    s->wants[s->want_count++] = (struct stream_want){w->layer, *tile, (float)priority};
}

static void visit(struct walk *w, const struct pyramid_tile *tile)
{
    const struct cap cap = bound_tile(w, tile);
    const bool is_last = tile->level + 1 == w->stream->layers[w->layer].pyramid.level_count;
    if (!is_last && !is_above_horizon(w, &cap)) {
        return;
    }
    const bool is_seen = is_in_picture(w, &cap);
    // The finest level that is looked at: shaders mix the two beside the footprint's.
    const double lod = log2(least_footprint_m(w, &cap)) - w->log2_texel_m + w->stream->coarser +
                       (is_seen ? 0 : BESIDE_LEVELS);
    const double excess = tile->level - floor(lod);
    if (!is_last && excess < 0) {
        return;
    }
    // Larger texels on the screen first, and what is beside the picture last.
    add_want(w, tile, excess + (is_seen ? 32 : 0));
    if (excess < 1 || tile->level == 0 || w->result != TRL_OK) {
        return;
    }
    for (uint32_t i = 0; i < 4; i++) {
        const struct pyramid_tile child = {tile->level - 1, 2 * tile->x + i % 2,
                                           2 * tile->y + i / 2};
        if (pyramid_has_tile(&w->stream->layers[w->layer].pyramid, &child)) {
            visit(w, &child);
        }
    }
}

trl_result stream_walk(struct stream *stream, const struct surface *surface,
                       const struct stream_view *view)
{
    struct walk w = {.stream = stream, .surface = surface, .view = view, .result = TRL_OK};
    w.distance_m = vec3_length(view->camera->position_m);
    w.up = vec3_normalize(view->camera->position_m);
    w.solid_m = fmin(w.distance_m, surface->radius_m + surface_min_altitude(surface));
    w.horizon_rad = acos(w.solid_m / w.distance_m);
    stream->want_count = 0;
    for (uint32_t i = 0; i < stream->layer_count && w.result == TRL_OK; i++) {
        const struct stream_layer *l = &stream->layers[i];
        w.layer = i;
        w.log2_texel_m = log2(l->frame.texel_height * surface->radius_m);
        visit(&w, &(struct pyramid_tile){l->pyramid.level_count - 1, 0, 0});
    }
    return w.result;
}
