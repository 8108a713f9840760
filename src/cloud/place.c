// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Where the noise is looked at for a place: turned back by the wind, dragged by its shear, bent,
// and for fibres drawn out along circles about the planet's axis. shaders/cloud/field.glsl is the
// same.
#include "cloud/field.h"

#include "shared/cloud.glsl"

// Orthonormal, and no axis stays where it is.
static const double bend_axes[3][3] = {{0, 0.8, 0.6}, {0.6, -0.48, 0.64}, {0.8, 0.36, -0.48}};

bool cloud_field_has_fibres(enum cloud_type type)
{
    return type == CLOUD_CIRRUS;
}

double cloud_field_fibre_turns(const struct cloud_layer *layer, double ground_radius_m)
{
    const double around = 2 * SHARED_PI * ground_radius_m / (layer->scale_m * CLOUD_FIBRE_STRETCH);
    return fmax(1, floor(around + 0.5)) / (2 * SHARED_PI);
}

// The part of a metre up that a streak is dragged, at its foot, where it is most.
static double steepest_lag(const struct cloud_layer *layer)
{
    return 2 * fabs(layer->shear_m) / (layer->top_m - layer->base_m);
}

double cloud_field_strain(const struct cloud_layer *layer)
{
    const double lag = steepest_lag(layer);
    return CLOUD_BEND_STRAIN *
           (1 + (cloud_field_has_fibres(layer->type) ? lag / CLOUD_FIBRE_STRETCH : lag));
}

void cloud_field_bend_phase(struct vec3 unturned_m, double tile_m, double out[3])
{
    const double wave = 2 * SHARED_PI / (CLOUD_BEND_WAVE * tile_m);
    for (int k = 0; k < 3; k++) {
        const struct vec3 axis = {bend_axes[k][0], bend_axes[k][1], bend_axes[k][2]};
        out[k] = wave * vec3_dot(axis, unturned_m);
    }
}

struct vec3 cloud_field_bent(struct vec3 unturned_m, double tile_m)
{
    double phase[3];
    cloud_field_bend_phase(unturned_m, tile_m, phase);
    const double reach_m = CLOUD_BEND * tile_m;
    return vec3_add(unturned_m, (struct vec3){reach_m * sin(phase[0]), reach_m * sin(phase[1]),
                                              reach_m * sin(phase[2])});
}

static struct vec3 drag(const struct cloud_field *field, const struct cloud_layer *l,
                        struct vec3 unturned_m)
{
    const double altitude_m = vec3_length(unturned_m) - field->ground_radius_m;
    const double lag_m = cloud_lag((altitude_m - l->base_m) / (l->top_m - l->base_m), l->shear_m);
    const struct vec3 east = vec3_normalize((struct vec3){-unturned_m.y, unturned_m.x, 0});
    return vec3_add(unturned_m, vec3_scale(east, lag_m));
}

struct cloud_place cloud_field_place(const struct cloud_field *field, size_t layer,
                                     struct vec3 position_m)
{
    const struct cloud_layer *l = &field->desc.layers[layer];
    const double tile_m = l->scale_m;
    const struct vec3 dragged_m = drag(field, l, cloud_field_unturned(field, layer, position_m));
    const struct vec3 bent_m = cloud_field_bent(dragged_m, tile_m);
    const double finer = CLOUD_DETAIL_TILES / tile_m;
    if (!cloud_field_has_fibres(l->type)) {
        return (struct cloud_place){
            .noise = {bent_m.x / tile_m, bent_m.y / tile_m, bent_m.z / tile_m},
            .finer = {bent_m.x * finer, bent_m.y * finer, bent_m.z * finer}};
    }
    const double across_m = sqrt(bent_m.x * bent_m.x + bent_m.y * bent_m.y);
    const double along =
        cloud_longitude(bent_m.y, bent_m.x) * cloud_field_fibre_turns(l, field->ground_radius_m);
    return (struct cloud_place){
        .noise = {across_m / tile_m, bent_m.z / tile_m, along},
        .finer = {across_m * finer, bent_m.z * finer, along * CLOUD_FIBRE_DETAIL_TURNS}};
}
