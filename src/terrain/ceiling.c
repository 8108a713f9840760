// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/ceiling.h"

#include "shared/blend.glsl"
#include "terrain/slope.h"

#include <math.h>

static const double WIDEST = 0.2;

static double bound_noise(const void *user, struct vec3 up, double angle_rad);

trl_result terrain_ceiling_init(const struct surface *surface, struct terrain_ceiling *out)
{
    *out = (struct terrain_ceiling){.surface = surface};
    const bool has_noise = noise_is_there(&surface->noise);
    trl_result result = has_noise ? ceiling_cells_init(surface->ctx, &out->cells) : TRL_OK;
    for (size_t i = 0; i < surface->counts[SURFACE_ELEVATION] && result == TRL_OK; i++) {
        result = ceiling_pyramid_init(&surface->layers[SURFACE_ELEVATION][i], surface->radius_m,
                                      has_noise, &out->pyramids[out->count]);
        out->count += result == TRL_OK;
    }
    out->steepest_map = surface->is_invented ? noise_find_steepest(&surface->noise) : 0;
    if (result != TRL_OK) {
        terrain_ceiling_finish(out);
    }
    return result;
}

void terrain_ceiling_finish(struct terrain_ceiling *ceiling)
{
    for (size_t i = 0; i < ceiling->count; i++) {
        ceiling_pyramid_finish(&ceiling->pyramids[i]);
    }
    if (ceiling->surface) {
        ceiling_cells_finish(ceiling->surface->ctx, &ceiling->cells);
    }
    *ceiling = (struct terrain_ceiling){.surface = NULL};
}

// By the table of the surface, which holds what layers below others are, too. More cells than those
// of a wide neighbourhood are not worth looking at.
static struct surface_bounds bound_by_table(const struct surface *s, struct vec3 up,
                                            double angle_rad)
{
    return angle_rad > WIDEST ? (struct surface_bounds){(float)surface_min_altitude(s),
                                                        (float)surface_max_altitude(s)}
                              : surface_bounds_around(s, up, angle_rad);
}

// Of the layers, over ground that is nowhere higher than `below`.
static double bound_data(const struct terrain_ceiling *ceiling, double below, struct vec3 up,
                         double angle_rad)
{
    double highest = below;
    for (size_t i = 0; i < ceiling->count; i++) {
        const struct ceiling_pyramid *pyramid = &ceiling->pyramids[i];
        const double high = ceiling_pyramid_most(pyramid, CEILING_HIGHEST, up, angle_rad);
        if (isfinite(high)) {
            highest = fmax(highest, blend_whole(pyramid->layer->mode, highest, high));
        }
        // A factor below 0 makes the lowest ground the highest: nothing here knows how low it is.
        if (isfinite(high) && pyramid->lowest < 0) {
            highest = fmax(highest, (double)bound_by_table(ceiling->surface, up, angle_rad).max);
        }
    }
    return highest;
}

// The least weight of a layer within an angle of a direction, by its middle and four sides.
static double least_weight(const struct layer_frame *f, struct vec3 up, double angle_rad)
{
    const struct anchor a = anchor_below(up);
    double least = 1;
    for (int k = 0; k < 5; k++) {
        const struct vec3 way = k < 3 ? vec3_scale(a.east, k - 1) : vec3_scale(a.north, 2 * k - 7);
        const struct vec3 p = vec3_add(up, vec3_scale(way, 1.5 * angle_rad));
        least = fmin(least, layer_locate(f, atan2(p.z, hypot(p.x, p.y)), atan2(p.y, p.x)).weight);
    }
    return least;
}

// The steepest slope where a factor is, whole or in part, of ground that is no steeper than
// `below`: its own counts by the height that it multiplies.
static double steepest_product(const struct ceiling_pyramid *factor, double below, double slope,
                               const struct surface_bounds *heights)
{
    const double most = fmax(fabs(factor->lowest), fabs(factor->all[CEILING_HIGHEST]));
    return below * fmax(most, 1) +
           slope * fmax(fabs((double)heights->min), fabs((double)heights->max));
}

// What layer i changes of what is known of the ground below it. What covers all hides that.
static void look_at_layer(const struct terrain_ceiling *ceiling, size_t i, struct vec3 up,
                          struct noise_around *around)
{
    const double radius_m = ceiling->surface->radius_m;
    const double angle_rad = around->reach_m / radius_m;
    const struct terrain_layer *layer = ceiling->pyramids[i].layer;
    const struct layer_frame *f = &layer->frame;
    const double slope =
        ceiling_pyramid_most(&ceiling->pyramids[i], CEILING_STEEPEST, up, angle_rad);
    if (!(slope >= 0)) {
        return;
    }
    const bool covers = least_weight(f, up, angle_rad) >= 1;
    const bool is_over = layer->mode == BLEND_OVER;
    const double own = log2(layer_finest_frame(layer)->texel_height * radius_m);
    if (blend_is_factor(layer->mode)) {
        const struct surface_bounds heights = bound_by_table(ceiling->surface, up, angle_rad);
        around->steepest =
            steepest_product(&ceiling->pyramids[i], around->steepest, slope, &heights);
    } else {
        around->steepest = covers && is_over ? slope : around->steepest + slope;
    }
    if (!covers) {
        const double feather = fmax(f->feather, f->texel_height) * radius_m;
        around->steepest += 1.5 * around->range_m / feather;
    }
    const bool is_known = covers && !layer->heights.coarser;
    around->log2_texel[0] = covers ? own : fmin(around->log2_texel[0], own);
    around->log2_texel[1] = is_known ? own : fmax(around->log2_texel[1], own);
}

// With noise: the surface's table of bounds, whose cells are large; or the highest data there and
// the most that octaves add; or what the ground at the place and its slopes allow.
static double bound_noise(const void *user, struct vec3 up, double angle_rad)
{
    const struct terrain_ceiling *ceiling = user;
    const struct surface *s = ceiling->surface;
    const struct surface_bounds cells = bound_by_table(s, up, angle_rad);
    if (angle_rad > WIDEST) {
        return (double)cells.max;
    }
    const double table = (double)cells.max, range = table - (double)cells.min;
    struct noise_around around = {.reach_m = angle_rad * s->radius_m,
                                  .range_m = range,
                                  .steepest = ceiling->steepest_map,
                                  .log2_texel = {SLOPE_NO_DATA, SLOPE_NO_DATA}};
    for (size_t i = 0; i < ceiling->count; i++) {
        look_at_layer(ceiling, i, up, &around);
    }
    struct noise_place place;
    surface_find_place(s, up, &place);
    const struct noise_rise rise = noise_find_rise(&s->noise, &place, &around);
    double bound = table;
    const double by_slope = around.steepest * around.reach_m;
    if (by_slope < range) {
        place.octaves = rise.octaves;
        const double here = noise_relief_at(&s->noise, &place).height;
        bound = fmin(bound, here + by_slope + rise.rise_m);
    }
    if (!s->is_invented) {
        bound = fmin(bound, bound_data(ceiling, 0, up, angle_rad) + rise.most_m);
    }
    return s->noise.desc.has_sea ? fmax(bound, 0) : bound;
}

// With noise, without looking at octaves: the table of bounds, or data and the most above them.
static double bound_coarsely(const struct terrain_ceiling *ceiling, struct vec3 up,
                             double angle_rad)
{
    const struct surface *s = ceiling->surface;
    const double reach_m = angle_rad * s->radius_m;
    const double data = bound_data(ceiling, 0, up, angle_rad);
    const struct noise_ground ground = noise_ground_at(&s->noise, up);
    return data + noise_find_most(&s->noise, &ground, reach_m);
}

static struct ceiling_cells open_cells(const struct terrain_ceiling *ceiling)
{
    return (struct ceiling_cells){ceiling->cells.slots, bound_noise, ceiling};
}

double terrain_ceiling_m(const struct terrain_ceiling *ceiling, struct vec3 direction,
                         double angle_rad)
{
    const struct vec3 up = vec3_normalize(direction);
    if (!noise_is_there(&ceiling->surface->noise)) {
        return bound_data(ceiling, 0, up, angle_rad); // 0: where no layer is
    }
    const struct ceiling_cells cells = open_cells(ceiling);
    return ceiling_cells_ask(&cells, up, angle_rad);
}

bool terrain_ceiling_is_below(const struct terrain_ceiling *ceiling, struct vec3 direction,
                              double angle_rad, double altitude_m)
{
    const struct surface *s = ceiling->surface;
    const struct vec3 up = vec3_normalize(direction);
    if (altitude_m > surface_max_altitude(s)) {
        return true;
    }
    if (!noise_is_there(&s->noise)) {
        return bound_data(ceiling, 0, up, angle_rad) < altitude_m;
    }
    const bool is_small = angle_rad < WIDEST; // larger ones have many cells
    if (is_small && (double)surface_bounds_around(s, up, angle_rad).max < altitude_m) {
        return true;
    }
    if (!s->is_invented && bound_coarsely(ceiling, up, angle_rad) < altitude_m) {
        return true;
    }
    const struct ceiling_cells cells = open_cells(ceiling);
    return is_small && ceiling_cells_are_below(&cells, up, angle_rad, altitude_m);
}
