// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "cloud/field.h"

#include "raster/remote.h"
#include "shared/cloud.glsl"

#include <stdio.h>
#include <unistd.h>

// Finer than the volume is between clouds, a map only moves them: 20 km on Earth.
enum { MAP_MAX_SIDE = 2048, LONGEST_ERROR = 1024 };

static trl_result check_map(const struct raster *raster)
{
    if (!raster->is_whole_circle || raster->type != RASTER_UINT8) {
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: a map of clouds must be of 8 bits (gdal_translate -ot Byte -scale) "
                        "and go around the planet",
                        raster->path);
    }
    return raster->width >= 2 && raster->height >= 2
               ? TRL_OK
               : trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                          "%s: %u x %u pixels; a map of clouds needs at least 2 x 2", raster->path,
                          raster->width, raster->height);
}

// Parts of 1; where it has no data there are no clouds.
static trl_result take_values(const trl_context *ctx, const char *path, struct raster_grid *grid)
{
    bool has_data = false;
    for (size_t i = 0; i < (size_t)grid->width * grid->height; i++) {
        const float value = grid->values[i] / 255;
        has_data = has_data || value >= 0;
        grid->values[i] = value >= 0 ? value : 0;
    }
    return has_data ? TRL_OK
                    : trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                               "%s: no pixel of it has data", path);
}

static void finish_maps(struct cloud_field *field)
{
    for (size_t i = 0; i < field->map_count; i++) {
        raster_grid_finish(&field->maps[i]);
    }
    field->map_count = 0;
}

// A band for each layer, from below, where there are as many (alpha does not count), else the first
// for all.
static trl_result load_maps(const trl_context *ctx, const char *path, struct cloud_field *field)
{
    struct raster raster;
    trl_result result = raster_open(ctx, path, &raster);
    if (result != TRL_OK) {
        return result;
    }
    result = check_map(&raster);
    const size_t bands = raster.band_count - (raster.has_alpha ? 1 : 0);
    const size_t layers = field->desc.layer_count;
    const size_t wanted = bands >= layers ? layers : 1;
    while (result == TRL_OK && field->map_count < wanted) {
        struct raster_grid *map = &field->maps[field->map_count];
        result = raster_grid_load(&raster, (uint32_t)field->map_count, MAP_MAX_SIDE, map);
        if (result == TRL_OK) {
            field->map_count++;
            map->ctx = field->ctx; // `ctx` ends before it
            result = take_values(ctx, path, map);
        }
    }
    if (result != TRL_OK) {
        finish_maps(field);
    }
    raster_finish(&raster);
    return result;
}

static void keep_error(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    char *said = user;
    (void)item;
    if (level == TRL_LOG_ERROR) {
        snprintf(said, LONGEST_ERROR, "%s", message);
    }
}

// As with layers of the surface: a file that is there and no good is told and left out, one that is
// missing is an error.
static trl_result take_map(struct cloud_field *field, const char *path)
{
    char said[LONGEST_ERROR] = "";
    trl_context quiet = *field->ctx;
    quiet.desc.log = keep_error;
    quiet.desc.log_user = said;
    const trl_result result = load_maps(&quiet, path, field);
    const bool is_bad = result == TRL_ERROR_INVALID || result == TRL_ERROR_IO;
    if (is_bad && (remote_is_path(path) || access(path, F_OK) == 0)) {
        trl_log(field->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_RASTER,
                "clouds.map %s; left out: their cover is the same everywhere", said);
        return TRL_OK;
    }
    return said[0] ? trl_fail(field->ctx, result, TRL_LOG_ITEM_RASTER, "clouds.map %s", said)
                   : result;
}

trl_result cloud_field_init(const trl_context *ctx, const struct cloud_desc *desc,
                            double ground_radius_m, struct cloud_field *out)
{
    *out = (struct cloud_field){.ctx = ctx, .desc = *desc, .ground_radius_m = ground_radius_m};
    out->desc.map_path = NULL;
    cloud_field_set_time(out, 0);
    trl_result result = TRL_OK;
    if (desc->map_path) {
        result = take_map(out, desc->map_path);
    }
    if (result == TRL_OK) {
        result = cloud_volume_init(ctx, (uint32_t)desc->seed, &out->volume);
    }
    if (result != TRL_OK) {
        cloud_field_finish(out);
    }
    return result;
}

void cloud_field_finish(struct cloud_field *field)
{
    if (field->volume.ctx) {
        cloud_volume_finish(&field->volume);
    }
    finish_maps(field);
    *field = (struct cloud_field){0};
}

double cloud_field_highest_m(const struct cloud_field *field)
{
    double highest_m = 0;
    for (size_t i = 0; i < field->desc.layer_count; i++) {
        highest_m = fmax(highest_m, field->desc.layers[i].top_m);
    }
    return highest_m;
}

double cloud_field_far_m(const struct cloud_field *field, struct vec3 position_m)
{
    const double altitude_m = vec3_length(position_m) - field->ground_radius_m;
    double far_m = INFINITY;
    for (size_t i = 0; i < field->desc.layer_count; i++) {
        const struct cloud_layer *l = &field->desc.layers[i];
        const double outside_m = fmax(l->base_m - altitude_m, altitude_m - l->top_m);
        far_m = fmin(far_m, fmax(outside_m, 0));
    }
    return far_m;
}

double cloud_field_detail(enum cloud_type type)
{
    static const double weights[] = {
        [CLOUD_CUMULUS] = 0.2, [CLOUD_STRATUS] = 0.15, [CLOUD_CIRRUS] = 0.5, [CLOUD_FOG] = 0.15};
    return weights[type];
}

double cloud_field_edge(enum cloud_type type)
{
    static const double edges[] = {
        [CLOUD_CUMULUS] = 0.08, [CLOUD_STRATUS] = 0.12, [CLOUD_CIRRUS] = 0.5, [CLOUD_FOG] = 0.3};
    return edges[type];
}

double cloud_field_peak(enum cloud_type type)
{
    static const double peaks[] = {[CLOUD_CUMULUS] = CLOUD_CUMULUS_PEAK,
                                   [CLOUD_STRATUS] = CLOUD_STRATUS_PEAK,
                                   [CLOUD_CIRRUS] = CLOUD_STRATUS_PEAK,
                                   [CLOUD_FOG] = CLOUD_FOG_PEAK};
    return peaks[type];
}

double cloud_field_overlap(enum cloud_type type)
{
    return type == CLOUD_CUMULUS ? 0.6 : 1;
}

void cloud_field_set_time(struct cloud_field *field, double time_s)
{
    for (size_t i = 0; i < field->desc.layer_count; i++) {
        const double turn = field->desc.layers[i].wind_m_s * time_s / field->ground_radius_m;
        field->turn[i][0] = cos(turn);
        field->turn[i][1] = sin(turn);
    }
}

struct vec3 cloud_field_unturned(const struct cloud_field *field, size_t layer,
                                 struct vec3 position_m)
{
    const double c = field->turn[layer][0];
    const double s = field->turn[layer][1];
    return (struct vec3){c * position_m.x + s * position_m.y, c * position_m.y - s * position_m.x,
                         position_m.z};
}

CloudNoise cloud_field_noise(const struct cloud_field *field, const double place[3], double level)
{
    return (CloudNoise){cloud_volume_sample(&field->volume, place, level).value,
                        cloud_volume_spread(&field->volume, level)};
}

double cloud_field_extinction(const struct cloud_field *field, size_t layer, struct vec3 position_m,
                              double level)
{
    const struct cloud_layer *l = &field->desc.layers[layer];
    const double height =
        (vec3_length(position_m) - field->ground_radius_m - l->base_m) / (l->top_m - l->base_m);
    const double signal = cloud_height_signal(height, cloud_field_peak(l->type));
    if (signal <= 0) {
        return 0;
    }
    const double finer_level = level + log(CLOUD_DETAIL_TILES) / log(2);
    const struct cloud_place place = cloud_field_place(field, layer, position_m);
    const CloudNoise noise = cloud_joint_noise(cloud_field_noise(field, place.noise, level),
                                               cloud_field_noise(field, place.finer, finer_level),
                                               cloud_field_detail(l->type));
    const double cover = cloud_field_gathered(field, layer, position_m, level);
    const double x = noise.value - cloud_threshold(cover, signal);
    const double way_m =
        cloud_clump(l->top_m - l->base_m, l->scale_m, l->scale_m / CLOUD_SIDE * exp2(level));
    return cloud_extinction(cloud_density(x, noise.spread, cloud_field_edge(l->type)),
                            cloud_part(x, noise.spread), l->extinction_per_m, way_m);
}
