// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/relief.h"

#include "frame/ground.h"
#include "ocean/water_phase.h"
#include "sky/sea_volume.h"
#include "terrain/look.h"

#include <math.h>

static size_t keep_heights(struct surface_layer_desc *layers, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        if (layers[i].kind == SURFACE_ELEVATION || layers[i].kind == SURFACE_WATER) {
            layers[kept++] = layers[i];
        }
    }
    return kept;
}

static trl_result init(const trl_context *ctx, const struct trl_scene *scene, bool has_pictures,
                       struct relief *out)
{
    *out = (struct relief){.lights_cd_m2 = ground_find_lights_cd_m2(scene),
                           .sea = frame_sea_surface(ctx, &scene->ocean)};
    trl_result result = has_pictures ? frame_sea_init(ctx, scene, &out->sea) : TRL_OK;
    if (result == TRL_OK) {
        result = frame_sea_light(&out->sea); // none without pictures
    }
    struct surface_layer_desc layers[SCENE_MAX_LAYERS];
    struct surface_desc desc;
    ground_describe(ctx, scene, layers, &desc);
    if (!has_pictures) {
        desc.layer_count = keep_heights(layers, desc.layer_count);
    } else {
        // Paths meet the ground many times: they would spend most of it on decimetres.
        desc.detail = (struct surface_detail){0};
    }
    if (result == TRL_OK) {
        result = trl_progress(ctx, "reading rasters", 0);
    }
    if (result == TRL_OK) {
        result = surface_init_on_cpu(ctx, &desc, &out->surface);
    }
    if (result == TRL_OK) {
        result = terrain_ceiling_init(&out->surface, &out->ceiling);
    }
    out->is_bare = result == TRL_OK && !surface_has_layers(&out->surface);
    if (result != TRL_OK) {
        relief_finish(out);
    }
    return result;
}

trl_result relief_init(const trl_context *ctx, const struct trl_scene *scene, struct relief *out)
{
    return init(ctx, scene, true, out);
}

trl_result relief_init_heights(const trl_context *ctx, const struct trl_scene *scene,
                               struct relief *out)
{
    return init(ctx, scene, false, out);
}

void relief_finish(struct relief *relief)
{
    terrain_ceiling_finish(&relief->ceiling);
    surface_finish(&relief->surface);
    frame_sea_finish(&relief->sea);
    *relief = (struct relief){0};
}

double relief_altitude_m(const struct relief *relief, double latitude_rad, double longitude_rad)
{
    return surface_altitude(&relief->surface, vec3_from_lat_lon(latitude_rad, longitude_rad));
}

double relief_water_depth_m(const struct relief *relief, double latitude_rad, double longitude_rad)
{
    return surface_water_depth_m(&relief->surface, vec3_from_lat_lon(latitude_rad, longitude_rad));
}

static double find_altitude(const void *user, struct vec3 direction)
{
    const struct relief *relief = user;
    return surface_altitude(&relief->surface, direction);
}

static double find_step(const void *user, struct vec3 direction, double reach_m)
{
    const struct relief *relief = user;
    return surface_half_texel_m(&relief->surface, direction, reach_m / relief->surface.radius_m);
}

static bool is_below(const void *user, struct vec3 direction, double reach_m, double altitude_m)
{
    const struct relief *relief = user;
    const double angle_rad = reach_m / relief->surface.radius_m;
    return terrain_ceiling_is_below(&relief->ceiling, direction, angle_rad, altitude_m);
}

static void look(const void *user, struct vec3 direction, struct reference_look *out)
{
    const struct relief *relief = user;
    const struct surface *surface = &relief->surface;
    out->normal = surface_normal(surface, direction);
    for (int c = 0; c < 3; c++) {
        out->albedo_rgb[c] = (double)surface->default_albedo[c];
        out->glow_rgb[c] = 0;
    }
    const bool has_biomes = surface_biomes(surface, direction, out->albedo_rgb);
    out->has_colour = surface_picture(surface, SURFACE_COLOUR, direction, out->albedo_rgb);
    out->has_colour = out->has_colour || has_biomes;
    surface_picture(surface, SURFACE_LIGHTS, direction, out->glow_rgb);
    out->water = relief->sea.sea.is_there ? surface_water(surface, direction, &out->depth_code) : 0;
}

static lanes4 find_volume(const void *user, double depth_code, const struct reference_rays *rays,
                          const lanes4 *nm)
{
    const struct relief *relief = user;
    const struct sea_volume_rays same = {rays->light_mu, rays->view_mu, rays->azimuth_cosine};
    struct sea_volume_light light;
    sea_volume_at(relief->sea.volume, depth_code, &same, &light);
    lanes4 value = {0};
    for (int k = 0; k < REFERENCE_LANES; k++) {
        value[k] = fmax(sea_volume_value(relief->sea.volume, light.star, (*nm)[k]), 0);
    }
    return value;
}

static void find_optics(const void *user, double nm, struct reference_water_optics *out)
{
    const struct ocean_desc *ocean = user;
    const struct water_optics optics = water_optics_at(&ocean->water, nm);
    const struct water_phase phase = water_phase_make(&optics);
    *out = (struct reference_water_optics){.absorption_per_m = optics.absorption_per_m,
                                           .clear_per_m = optics.clear_per_m,
                                           .particles_per_m = optics.particles_per_m,
                                           .particle_index = phase.index,
                                           .particle_slope = phase.slope,
                                           .bed_albedo = spectrum_at(&ocean->bed.albedo, nm)};
}

struct reference_under relief_under(const struct relief *relief, const struct ocean_desc *ocean,
                                    struct vec3 eye_m)
{
    const struct vec3 up = vec3_normalize(eye_m);
    const double latitude_rad = asin(fmax(-1, fmin(1, up.z)));
    const double longitude_rad = atan2(up.y, up.x);
    const double level_m =
        relief->surface.radius_m + relief_altitude_m(relief, latitude_rad, longitude_rad);
    const double depth_m = relief_water_depth_m(relief, latitude_rad, longitude_rad);
    const struct sky_sea *sea = &relief->sea.sea;
    return (struct reference_under){.is_there = depth_m > 0 && vec3_length(eye_m) < level_m,
                                    .level_radius_m = level_m,
                                    .depth_m = depth_m,
                                    .mean_square_slope = fmax(sea->mean_square_slope, 1e-6),
                                    .index = sea->index,
                                    .user = ocean,
                                    .optics = find_optics};
}

struct reference_surface relief_surface(const struct relief *relief)
{
    const struct sky_sea *sea = &relief->sea.sea;
    return (struct reference_surface){
        .user = relief,
        .lowest_m = surface_min_altitude(&relief->surface),
        .highest_m = surface_max_altitude(&relief->surface),
        .sea = {.mean_square_slope = fmax(sea->mean_square_slope, 1e-6),
                .index = sea->index,
                .white_share = sea->white_share,
                .white_albedo = sea->white_albedo,
                .user = relief,
                .volume = sea->volume ? find_volume : NULL},
        .white_cd_m2 = relief->lights_cd_m2,
        .altitude_m = find_altitude,
        .step_m = find_step,
        .is_below = is_below,
        .look = look};
}
