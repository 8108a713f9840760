// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/surface.h"

#include "shared/blend.glsl"

#include <math.h>

static double altitude_at(const struct surface *s, double latitude, double longitude)
{
    double altitude = 0;
    for (size_t i = 0; i < s->counts[SURFACE_ELEVATION]; i++) {
        const struct terrain_layer *layer = &s->layers[SURFACE_ELEVATION][i];
        const struct layer_place place = layer_locate(&layer->frame, latitude, longitude);
        if (place.weight > 0) {
            const double height = layer_sample(layer, place.x, place.y);
            altitude = blend_layers(layer->mode, altitude, height, place.weight);
        }
    }
    return altitude;
}

size_t surface_count_layers(const struct surface *surface)
{
    size_t count = 0;
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        count += surface->counts[k];
    }
    return count;
}

bool surface_has_layers(const struct surface *surface)
{
    return surface_count_layers(surface) > 0;
}

double surface_altitude(const struct surface *surface, struct vec3 direction)
{
    return altitude_at(surface, atan2(direction.z, hypot(direction.x, direction.y)),
                       atan2(direction.y, direction.x));
}

double surface_min_altitude(const struct surface *surface)
{
    return surface->min_altitude_m;
}

double surface_max_altitude(const struct surface *surface)
{
    return surface->max_altitude_m;
}

// How large a layer is seen from a height above a place: angles, and pi where it is underfoot.
static double apparent_size(const struct layer_frame *f, const struct surface_eye *eye)
{
    const double away = acos(fmax(-1, fmin(1, vec3_dot(f->direction, eye->up)))) - f->reach_rad;
    if (f->reach_rad >= SHARED_PI) {
        return INFINITY;
    }
    const double distance = fmax(fmax(away, 0), eye->height_rad);
    return 2 * f->reach_rad / fmax(distance, 1e-9);
}

static bool is_in_reach(const struct layer_frame *f, const struct surface_eye *eye)
{
    const double away = acos(fmax(-1, fmin(1, vec3_dot(f->direction, eye->up))));
    return away <= eye->reach_rad + f->reach_rad && apparent_size(f, eye) > eye->least_rad;
}

static void drop_smallest(const struct surface *s, enum surface_kind kind,
                          const struct surface_eye *eye, struct surface_selection *selection)
{
    size_t smallest = 0;
    uint8_t *indices = selection->indices[kind];
    for (size_t i = 1; i < selection->counts[kind]; i++) {
        const double size = apparent_size(&s->layers[kind][indices[i]].frame, eye);
        if (size < apparent_size(&s->layers[kind][indices[smallest]].frame, eye)) {
            smallest = i;
        }
    }
    selection->counts[kind]--;
    for (size_t i = smallest; i < selection->counts[kind]; i++) {
        indices[i] = indices[i + 1];
    }
}

struct surface_selection surface_select(const struct surface *s, const struct surface_eye *eye)
{
    struct surface_selection selection = {0};
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        const enum surface_kind kind = (enum surface_kind)k;
        const size_t seen = surface_count_seen(s, kind);
        for (size_t i = 0; i < s->counts[kind]; i++) {
            // Only of heights does a program look at fewer where fewer are in reach.
            if (kind == SURFACE_ELEVATION && !is_in_reach(&s->layers[kind][i].frame, eye)) {
                continue;
            }
            selection.indices[kind][selection.counts[kind]++] = (uint8_t)i;
            if (selection.counts[kind] > seen) {
                drop_smallest(s, kind, eye, &selection);
            }
        }
    }
    return selection;
}

size_t surface_count_seen(const struct surface *surface, enum surface_kind kind)
{
    static const size_t MOST[SURFACE_KIND_COUNT] = {SURFACE_SEEN_LAYERS, SURFACE_SEEN_LAYERS, 2, 2,
                                                    1};
    return surface->counts[kind] < MOST[kind] ? surface->counts[kind] : MOST[kind];
}
