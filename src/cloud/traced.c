// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// The bound of the extinction around a place comes from the volume's second channel, which is the
// largest noise within CLOUD_BORDER texels of each; between texels that holds for one less.
#include "cloud/traced.h"

#include "shared/cloud.glsl"

#include <math.h>

// For what values between texels are rounded and the edge is smoothed.
static const double slack = 1e-3;

// The largest noise within the border of a place, in tiles.
static double most_noise(const struct cloud_field *field, const double place[3])
{
    return cloud_volume_sample(&field->volume, place, 0).around;
}

static double most_wide_noise(const struct cloud_field *field, struct vec3 place_m, double tile_m)
{
    return most_noise(field,
                      (const double[]){place_m.x / tile_m, place_m.y / tile_m, place_m.z / tile_m});
}

static bool is_in_reach(const struct cloud_field *field, struct vec3 position_m, double reach_m)
{
    for (size_t i = 0; i < field->desc.cyclone_count; i++) {
        const struct cloud_cyclone *c = &field->desc.cyclones[i];
        const struct vec3 at = vec3_from_lat_lon(c->latitude_rad, c->longitude_rad);
        const double apart = vec3_length(vec3_sub(vec3_normalize(position_m), at));
        // Lumps in the outer bands reach a little farther than the radius.
        if (apart * field->ground_radius_m < 1.2 * c->radius_m + reach_m) {
            return true;
        }
    }
    return false;
}

// The largest cover of one height within reach. Between texels of the map it is bilinear, so that
// it rises by no more than 1 along each side of a texel; these are narrow near the poles. Belts
// only take from it.
static double most_cover(const struct cloud_field *field, size_t layer, struct vec3 position_m,
                         double reach_m)
{
    const struct cloud_layer *l = &field->desc.layers[layer];
    const struct raster_grid *map = cloud_field_map(field, layer);
    double part = 1;
    if (map) {
        const struct vec3 up = vec3_normalize(cloud_field_unturned(field, layer, position_m));
        const double latitude = asin(fmax(-1, fmin(1, up.z)));
        const double here = raster_grid_sample(map, latitude, atan2(up.y, up.x)).value;
        const double reach = reach_m / vec3_length(position_m);
        const double side = 2 * SHARED_PI / map->width * fmax(cos(latitude) - reach, 0);
        const double lower = SHARED_PI / map->height;
        part = side > 0 ? fmin(1, here + reach / side + reach / lower) : 1;
    }
    double cover = l->cover * part;
    double tiles[3];
    if (cloud_field_system_place(field, layer, position_m, tiles)) {
        const bool are_wide = CLOUD_SYSTEM_TILES * field->desc.systems_m >=
                              CLOUD_SYSTEM_STRETCH * l->scale_m; // than what reach_m is for
        const double noise = are_wide ? most_noise(field, tiles) : 1;
        cover = cloud_gathered_cover(cover, noise, noise);
    }
    if (is_in_reach(field, position_m, reach_m)) {
        cover = fmax(cover, l->cyclone_cover);
    }
    return cloud_level_cover(cover, cloud_field_overlap(l->type));
}

// How far the border reaches around a place in the noise of a layer, m.
static double find_border_m(const struct cloud_field *field, const struct cloud_layer *l,
                            struct vec3 position_m)
{
    const double border_m = (CLOUD_BORDER - 1) * l->scale_m / CLOUD_SIDE / cloud_field_strain(l);
    if (!cloud_field_has_fibres(l->type)) {
        return border_m;
    }
    // Circles about the axis get narrow. What bends a place may have brought it nearer.
    const double across_m = sqrt(position_m.x * position_m.x + position_m.y * position_m.y) -
                            2 * CLOUD_BEND * l->scale_m;
    const double wide_m = field->ground_radius_m / CLOUD_FIBRE_STRETCH;
    return border_m * fmin(1, fmax(across_m / wide_m, 1e-3));
}

static double layer_most(const struct cloud_field *field, size_t layer, struct vec3 position_m,
                         double *reach_m)
{
    const struct cloud_layer *l = &field->desc.layers[layer];
    const double altitude_m = vec3_length(position_m) - field->ground_radius_m;
    const double outside_m = fmax(l->base_m - altitude_m, altitude_m - l->top_m);
    *reach_m = find_border_m(field, l, position_m);
    if (outside_m > *reach_m) {
        *reach_m = outside_m;
        return 0;
    }
    const double height = (altitude_m - l->base_m) / (l->top_m - l->base_m);
    const double rise = *reach_m / (l->top_m - l->base_m);
    const double peak = cloud_field_peak(l->type);
    const double signal = cloud_height_signal(fmin(fmax(peak, height - rise), height + rise), peak);
    const struct vec3 unturned_m = cloud_field_unturned(field, layer, position_m);
    const double field_m = l->scale_m * CLOUD_FIELD_TILES;
    const double wide_m = l->scale_m * CLOUD_WIDE_TILES;
    const double noise = most_noise(field, cloud_field_place(field, layer, position_m).noise);
    const double joint = cloud_most_noise(noise, cloud_field_detail(l->type));
    const double cover = cloud_gathered_cover(
        most_cover(field, layer, position_m, *reach_m),
        most_wide_noise(field, cloud_field_bent(unturned_m, field_m), field_m),
        field->map_count > 0 ? 0.5
                             : most_wide_noise(field, cloud_field_wide_place(unturned_m), wide_m));
    const double x = joint - cloud_threshold(cover, signal) + slack;
    return l->extinction_per_m * fmin(fmax(x / cloud_field_edge(l->type), 0), 1) * (1 + slack);
}

static double most_per_m(const void *user, struct vec3 position_m, double *reach_m)
{
    const struct cloud_field *field = user;
    double most = 0;
    *reach_m = INFINITY;
    for (size_t i = 0; i < field->desc.layer_count; i++) {
        double layer_reach_m;
        most += layer_most(field, i, position_m, &layer_reach_m);
        *reach_m = fmin(*reach_m, layer_reach_m);
    }
    return most;
}

static double extinction_per_m(const void *user, struct vec3 position_m)
{
    const struct cloud_field *field = user;
    const double finest_level = -log(CLOUD_DETAIL_TILES) / log(2);
    double sum = 0;
    for (size_t i = 0; i < field->desc.layer_count; i++) {
        sum += cloud_field_extinction(field, i, position_m, finest_level);
    }
    return sum;
}

struct reference_clouds cloud_field_traced(const struct cloud_field *field)
{
    return (struct reference_clouds){.user = field,
                                     .highest_m = cloud_field_highest_m(field),
                                     .albedo = 1, // of water in visible light, within 1e-5
                                     .forward_g = CLOUD_FORWARD_G,
                                     .back_g = CLOUD_BACK_G,
                                     .back_share = CLOUD_BACK_SHARE,
                                     .extinction_per_m = extinction_per_m,
                                     .most_per_m = most_per_m};
}
