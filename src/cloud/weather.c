// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How much of the sky a layer covers where: its own cover, map or weather systems, and belt,
// cyclones over them, and clouds gathered into fields. shaders/cloud/weather.glsl is the same.
#include "cloud/field.h"

#include "shared/cloud.glsl"
#include "shared/cyclone.glsl"

const struct raster_grid *cloud_field_map(const struct cloud_field *field, size_t layer)
{
    return field->map_count > 0 ? &field->maps[layer % field->map_count] : NULL;
}

static double find_map(const struct cloud_field *field, size_t layer, struct vec3 position_m)
{
    const struct raster_grid *map = cloud_field_map(field, layer);
    if (!map) {
        return 1;
    }
    const struct vec3 up = vec3_normalize(cloud_field_unturned(field, layer, position_m));
    return raster_grid_sample(map, asin(fmax(-1, fmin(1, up.z))), atan2(up.y, up.x)).value;
}

static double find_belt(const struct cloud_belt *belt, double latitude_rad)
{
    return cyclone_step(belt->south_rad - belt->feather_rad, belt->south_rad, latitude_rad) *
           (1 - cyclone_step(belt->north_rad, belt->north_rad + belt->feather_rad, latitude_rad));
}

void cloud_cyclone_axes(const struct cloud_cyclone *cyclone, struct vec3 *at, struct vec3 *east,
                        struct vec3 *turn)
{
    *at = vec3_from_lat_lon(cyclone->latitude_rad, cyclone->longitude_rad);
    *east = (struct vec3){-sin(cyclone->longitude_rad), cos(cyclone->longitude_rad), 0};
    // Counterclockwise in the north.
    *turn = vec3_scale(vec3_cross(*at, *east), cyclone->latitude_rad < 0 ? -1 : 1);
}

static double cover_with(const struct cloud_field *field, const struct cloud_cyclone *cyclone,
                         struct vec3 up, const double covers[2])
{
    struct vec3 at;
    struct vec3 east;
    struct vec3 turn;
    cloud_cyclone_axes(cyclone, &at, &east, &turn);
    const struct vec3 from = vec3_sub(up, at);
    const double x = vec3_length(from) * field->ground_radius_m / cyclone->radius_m;
    const double eye = cyclone->eye_radius_m / cyclone->radius_m;
    const double phase = cyclone_phase(x, atan2(vec3_dot(from, turn), vec3_dot(from, east)));
    const double place[3] = {phase * (CYCLONE_NOISE_TURNS / (2 * SHARED_PI)),
                             log(fmax(x, 1e-4)) * CYCLONE_NOISE_TILES, 0.5};
    const double noise = cloud_volume_sample(&field->volume, place, 0).value;
    const double share = cyclone_share(x, phase, eye, noise);
    return covers[0] * cyclone_rest(x, eye) * (1 - share) + covers[1] * share;
}

double cloud_field_system_tiles(const struct cloud_field *field)
{
    return field->desc.systems_m > 0 && field->map_count == 0
               ? field->ground_radius_m / (CLOUD_SYSTEM_TILES * field->desc.systems_m)
               : 0;
}

bool cloud_field_system_place(const struct cloud_field *field, size_t layer, struct vec3 position_m,
                              double tiles[3])
{
    const double around = cloud_field_system_tiles(field);
    const struct vec3 up = vec3_normalize(cloud_field_unturned(field, layer, position_m));
    tiles[0] = around * up.x;
    tiles[1] = around * up.y;
    tiles[2] = around * CLOUD_SYSTEM_STRETCH * up.z;
    return around > 0;
}

double cloud_field_cover(const struct cloud_field *field, size_t layer, struct vec3 position_m)
{
    const struct cloud_layer *l = &field->desc.layers[layer];
    const struct vec3 up = vec3_normalize(position_m);
    double cover = l->cover * find_map(field, layer, position_m) *
                   find_belt(&l->belt, asin(fmax(-1, fmin(1, up.z))));
    double tiles[3];
    if (cloud_field_system_place(field, layer, position_m, tiles)) {
        const double noise = cloud_volume_sample(&field->volume, tiles, 0).value;
        cover = cloud_gathered_cover(cover, noise, noise);
    }
    for (size_t i = 0; i < field->desc.cyclone_count; i++) {
        cover = cover_with(field, &field->desc.cyclones[i], up,
                           (const double[]){cover, l->cyclone_cover});
    }
    return cloud_level_cover(cover, cloud_field_overlap(l->type));
}

struct vec3 cloud_field_wide_place(struct vec3 position_m)
{
    return (struct vec3){position_m.y, position_m.z, position_m.x};
}

double cloud_field_gathered(const struct cloud_field *field, size_t layer, struct vec3 position_m,
                            double level)
{
    const double field_m = field->desc.layers[layer].scale_m * CLOUD_FIELD_TILES;
    const double wide_m = field->desc.layers[layer].scale_m * CLOUD_WIDE_TILES;
    const struct vec3 unturned_m = cloud_field_unturned(field, layer, position_m);
    const struct vec3 field_place = vec3_scale(cloud_field_bent(unturned_m, field_m), 1 / field_m);
    const struct vec3 wide_place = vec3_scale(cloud_field_wide_place(unturned_m), 1 / wide_m);
    const double narrow[3] = {field_place.x, field_place.y, field_place.z};
    const double wide[3] = {wide_place.x, wide_place.y, wide_place.z};
    const double narrow_level = fmax(0, level - log(CLOUD_FIELD_TILES) / log(2));
    const double wide_level = fmax(0, level - floor(log(CLOUD_WIDE_TILES) / log(2)));
    // A map knows the regions.
    return cloud_gathered_cover(
        cloud_field_cover(field, layer, position_m),
        cloud_volume_sample(&field->volume, narrow, narrow_level).value,
        field->map_count > 0 ? 0.5 : cloud_volume_sample(&field->volume, wide, wide_level).value);
}
