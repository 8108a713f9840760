// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/ground.h"

#include "frame/daylight.h"
#include "frame/invention.h"
#include "ocean/fetch.h"
#include "ocean/sea.h"
#include "shared/blend.glsl"
#include "terrain/look.h"
#include "terrain/projective.h"

#include <math.h>
#include <string.h>

static enum surface_kind choose_kind(enum layer_kind kind)
{
    switch (kind) {
    case LAYER_ELEVATION:
        return SURFACE_ELEVATION;
    case LAYER_COLOUR:
    case LAYER_SNOW: // a colour where the mask says so
        return SURFACE_COLOUR;
    case LAYER_WATER:
        return SURFACE_WATER;
    case LAYER_NORMAL:
        return SURFACE_NORMAL;
    case LAYER_LIGHTS:
        break;
    }
    return SURFACE_LIGHTS;
}

static double choose_mode(enum layer_blend blend)
{
    static const double MODES[] = {[LAYER_BLEND_OVER] = BLEND_OVER,
                                   [LAYER_BLEND_ADD] = BLEND_ADD,
                                   [LAYER_BLEND_MULTIPLY] = BLEND_MULTIPLY,
                                   [LAYER_BLEND_MAX] = BLEND_MAX,
                                   [LAYER_BLEND_MIN] = BLEND_MIN};
    return MODES[blend];
}

void ground_describe(const trl_context *ctx, const struct trl_scene *scene,
                     struct surface_layer_desc layers[SCENE_MAX_LAYERS], struct surface_desc *out)
{
    for (size_t i = 0; i < scene->layer_count; i++) {
        const struct layer *layer = &scene->layers[i];
        layers[i] = (struct surface_layer_desc){.kind = choose_kind(layer->kind),
                                                .path = layer->path,
                                                .is_optional = layer->is_optional,
                                                .scale = layer->scale,
                                                .offset_m = layer->offset_m,
                                                .feather_rad = layer->feather_deg * M_PI / 180,
                                                .mode = choose_mode(layer->blend),
                                                .has_bed = layer->has_bed,
                                                .is_cover = layer->kind == LAYER_SNOW};
        if (layers[i].is_cover) {
            daylight_albedo(&scene->medium, &layer->albedo, layers[i].cover_rgb);
        }
    }
    *out = surface_desc_default();
    out->radius_m = scene->medium.ground_radius_m;
    out->layer_count = scene->layer_count;
    out->layers = layers;
    out->exaggeration = scene->exaggeration;
    out->depth = (struct surface_depth){scene->ocean.is_there, scene->ocean.bed.depth_m};
    out->max_bytes = 1e6 * ctx->desc.raster_mb;
    daylight_ground_albedo(&scene->medium, out->default_albedo);
    invention_describe(scene, out);
}

static trl_result load_surface(struct gpu *gpu, const struct ground_desc *ground,
                               struct surface *surface)
{
    struct surface_layer_desc layers[SCENE_MAX_LAYERS];
    struct surface_desc desc;
    ground_describe(gpu->ctx, ground->scene, layers, &desc);
    desc.waits = ground->waits_for_rasters;
    return surface_init(gpu, &desc, surface);
}

static trl_result make_mesher(const struct ground *ground, trl_mesher mesher, struct mesher **out)
{
    if (mesher == TRL_MESHER_PROJECTIVE) {
        return projective_create(&ground->surface, &ground->projective, out);
    }
    if (mesher == TRL_MESHER_HEMISPHERE || mesher == TRL_MESHER_TESSELLATED) {
        const struct hemisphere_desc desc = {ground->hemisphere_cells,
                                             mesher == TRL_MESHER_TESSELLATED};
        return hemisphere_create_of(&ground->surface, &desc, out);
    }
    return mesher_create(&ground->surface, mesher, out);
}

trl_result ground_set_mesher(struct ground *ground, trl_mesher mesher)
{
    struct mesher **slot = &ground->meshers[mesher];
    const trl_result result = ground->is_bare || *slot ? TRL_OK : make_mesher(ground, mesher, slot);
    ground->mesher = result == TRL_OK ? mesher : ground->mesher;
    return result;
}

trl_result ground_set_projective(struct ground *ground, const trl_projective_desc *desc)
{
    struct mesher **slot = &ground->meshers[TRL_MESHER_PROJECTIVE];
    struct mesher *made = NULL;
    const trl_result result = *slot ? projective_create(&ground->surface, desc, &made) : TRL_OK;
    if (result == TRL_OK) {
        mesher_destroy(slot);
        *slot = made;
        ground->projective = *desc;
    }
    return result;
}

trl_result ground_set_hemisphere(struct ground *ground, uint32_t cells)
{
    static const trl_mesher kinds[2] = {TRL_MESHER_HEMISPHERE, TRL_MESHER_TESSELLATED};
    const uint32_t old_cells = ground->hemisphere_cells;
    struct mesher *made[2] = {NULL, NULL};
    trl_result result = TRL_OK;
    ground->hemisphere_cells = cells;
    for (int i = 0; i < 2 && result == TRL_OK; i++) {
        result = ground->meshers[kinds[i]] ? make_mesher(ground, kinds[i], &made[i]) : TRL_OK;
    }
    for (int i = 0; i < 2; i++) {
        if (result == TRL_OK && made[i]) {
            mesher_destroy(&ground->meshers[kinds[i]]);
            ground->meshers[kinds[i]] = made[i];
        } else {
            mesher_destroy(&made[i]);
        }
    }
    ground->hemisphere_cells = result == TRL_OK ? cells : old_cells;
    return result;
}

void ground_set_mesh_error(struct ground *ground, double error_px)
{
    ground->mesh_error_px = error_px;
}

struct mesher_stats ground_mesher_stats(const struct ground *ground)
{
    const struct mesher *mesher = ground->meshers[ground->mesher];
    return mesher ? mesher->stats : (struct mesher_stats){0};
}

// Length of what an eye that rides on waves stands on.
static const double BOAT_M = 6;

static trl_result make_waves(struct ground *ground, const struct trl_scene *scene)
{
    if (!scene->ocean.is_there) {
        return TRL_OK;
    }
    const struct waves_desc desc = {ground->gpu->ctx, &scene->ocean, scene->medium.ground_radius_m,
                                    sea_mean_square_slope(&scene->ocean.waves)};
    ground->stand = mem_alloc(ground->gpu->ctx, 1, sizeof *ground->stand);
    trl_result result = ground->stand ? waves_init(&desc, &ground->waves) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = facets_init(ground->gpu, &ground->waves, &ground->facets);
    }
    if (result == TRL_OK) {
        ground->facets.waves.shores = &ground->surface;
        result = sea_mesh_init(&ground->surface, &ground->facets.waves, &ground->sea_mesh);
    }
    if (result == TRL_OK) {
        result = terrain_open_sea_init(&ground->surface, &ground->open_sea);
    }
    ground->has_waves = result == TRL_OK;
    return result;
}

static trl_result make_passes(struct ground *ground, double sun_angular_radius_rad)
{
    trl_result result = ground_set_mesher(ground, ground->mesher);
    if (result == TRL_OK) {
        result = terrain_shadow_init(&ground->surface, sun_angular_radius_rad, &ground->shadow);
    }
    if (result == TRL_OK) {
        result = terrain_compose_init(&ground->surface, &ground->compose);
    }
    if (result == TRL_OK) {
        result = terrain_kinds_init(ground->gpu, &ground->kinds);
    }
    if (result == TRL_OK) {
        result = gpu_hide_init(ground->gpu, &ground->hide);
    }
    if (result == TRL_OK) {
        result = terrain_sky_view_init(&ground->shadow, &ground->sky_view);
    }
    return result;
}

// All lights share a buffer, and with it the scale of the brightest layer.
double ground_find_lights_cd_m2(const struct trl_scene *scene)
{
    double brightest_cd_m2 = 0;
    for (size_t i = 0; i < scene->layer_count; i++) {
        if (scene->layers[i].kind == LAYER_LIGHTS) {
            brightest_cd_m2 = fmax(brightest_cd_m2, scene->layers[i].radiance_cd_m2);
        }
    }
    return brightest_cd_m2;
}

trl_result ground_init(struct gpu *gpu, const struct ground_desc *desc, struct ground *out)
{
    const struct trl_scene *scene = desc->scene;
    *out = (struct ground){.gpu = gpu,
                           .mesher = desc->meshing.mesher,
                           .projective = desc->meshing.projective,
                           .hemisphere_cells = 0,
                           .mesh_error_px = desc->meshing.error_px,
                           .lights_cd_m2 = ground_find_lights_cd_m2(scene),
                           .region_m = 2 * medium_scattering_height(&scene->medium)};
    trl_result result = load_surface(gpu, desc, &out->surface);
    out->is_bare = result == TRL_OK && !surface_has_layers(&out->surface);
    if (result == TRL_OK && !out->is_bare) {
        result = make_passes(out, scene->medium.star_angular_radius_rad);
    }
    if (result == TRL_OK && !out->is_bare) {
        result = make_waves(out, scene);
    }
    if (result != TRL_OK) {
        ground_finish(out);
    }
    return result;
}

static void finish_buffers(struct ground *ground)
{
    gpu_target_finish(&ground->mesh_target);
    gpu_target_finish(&ground->kinds_target);
    gpu_target_finish(&ground->surface_target);
    gpu_target_finish(&ground->sky_view_target);
    gpu_texture_finish(&ground->position);
    gpu_texture_finish(&ground->depth);
    gpu_texture_finish(&ground->albedo);
    gpu_texture_finish(&ground->normal);
    gpu_texture_finish(&ground->lights);
    gpu_texture_finish(&ground->region);
}

void ground_finish(struct ground *ground)
{
    finish_buffers(ground);
    terrain_open_sea_finish(&ground->open_sea);
    sea_mesh_finish(&ground->sea_mesh);
    facets_finish(&ground->facets);
    if (ground->gpu) {
        mem_free(ground->gpu->ctx, ground->stand);
    }
    waves_finish(&ground->waves);
    terrain_sky_view_finish(&ground->sky_view);
    terrain_compose_finish(&ground->compose);
    terrain_kinds_finish(&ground->kinds);
    gpu_hide_finish(&ground->hide);
    terrain_shadow_finish(&ground->shadow);
    for (int i = 0; i < MESHER_MAX_KINDS; i++) {
        mesher_destroy(&ground->meshers[i]);
    }
    surface_finish(&ground->surface);
    *ground = (struct ground){0};
}

struct buffer {
    struct gpu_texture *texture;
    enum gpu_format format;
    const char *label;
};

static trl_result make_buffers(struct ground *ground, uint32_t width, uint32_t height)
{
    const struct buffer buffers[] = {{&ground->position, GPU_FORMAT_RGBA32F, "position"},
                                     {&ground->depth, GPU_FORMAT_DEPTH32F, "depth"},
                                     {&ground->albedo, GPU_FORMAT_RGBA8, "albedo"},
                                     {&ground->normal, GPU_FORMAT_RGBA16F, "normal"},
                                     {&ground->lights, GPU_FORMAT_RGBA8, "lights"},
                                     {&ground->region, GPU_FORMAT_RGBA8, "region"}};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers && result == TRL_OK; i++) {
        struct gpu_texture_desc desc = gpu_texture_desc_default();
        desc.label = buffers[i].label;
        desc.format = buffers[i].format;
        desc.filter = GPU_FILTER_NEAREST;
        desc.width = width;
        desc.height = height;
        result = gpu_texture_init(ground->gpu, &desc, buffers[i].texture);
    }
    return result;
}

static trl_result make_targets(struct ground *ground)
{
    const struct gpu_target_desc mesh = {.label = "mesh",
                                         .color_count = 1,
                                         .colors[0].texture = &ground->position,
                                         .depth.texture = &ground->depth};
    const struct gpu_target_desc kinds = {.label = "kinds", .depth.texture = &ground->depth};
    const struct gpu_target_desc surface = {.label = "surface",
                                            .color_count = 4,
                                            .colors = {{.texture = &ground->albedo},
                                                       {.texture = &ground->normal},
                                                       {.texture = &ground->lights},
                                                       {.texture = &ground->region}},
                                            .depth.texture = &ground->depth};
    const struct gpu_target_desc sky_view = {
        .label = "sky view",
        .color_count = 2,
        .colors = {{.texture = &ground->lights}, {.texture = &ground->region}},
        .depth.texture = &ground->depth};
    trl_result result = gpu_target_init(ground->gpu, &mesh, &ground->mesh_target);
    if (result == TRL_OK) {
        result = gpu_target_init(ground->gpu, &kinds, &ground->kinds_target);
    }
    if (result == TRL_OK) {
        result = gpu_target_init(ground->gpu, &surface, &ground->surface_target);
    }
    return result == TRL_OK ? gpu_target_init(ground->gpu, &sky_view, &ground->sky_view_target)
                            : result;
}

trl_result ground_resize(struct ground *ground, uint32_t width, uint32_t height)
{
    finish_buffers(ground);
    if (ground->is_bare) {
        return TRL_OK;
    }
    trl_result result = make_buffers(ground, width, height);
    if (result == TRL_OK) {
        result = make_targets(ground);
    }
    if (result == TRL_OK && ground->has_waves) {
        result = facets_resize(&ground->facets, &ground->depth);
    }
    if (result == TRL_OK && ground->has_waves) {
        result = sea_mesh_resize(&ground->sea_mesh, &ground->depth);
    }
    if (result == TRL_OK && ground->has_waves) {
        result = terrain_open_sea_resize(&ground->open_sea, &ground->depth);
    }
    if (result != TRL_OK) {
        finish_buffers(ground);
    }
    return result;
}

// Of ground and displaced sea, or of the ground alone.
static const struct gpu_texture *find_position(const struct ground *ground)
{
    return ground->sea_mesh.plan.is_seen ? &ground->sea_mesh.position : &ground->position;
}

static const struct gpu_texture *find_level(const struct ground *ground)
{
    return ground->sea_mesh.plan.is_seen ? &ground->sea_mesh.level : NULL;
}

static trl_result draw_sky_view(struct ground *ground, const struct camera *camera)
{
    const struct terrain_sky_view_inputs inputs = {camera, find_position(ground), &ground->normal,
                                                   &ground->albedo};
    const trl_result result = terrain_sky_view_update(&ground->sky_view);
    return result == TRL_OK
               ? terrain_sky_view_draw(&ground->sky_view, &inputs, &ground->sky_view_target)
               : result;
}

static trl_result draw_sea_mesh(struct ground *ground, const struct camera *camera,
                                const struct ground_extras *extras)
{
    const struct sea_mesh_inputs inputs = {camera, extras->time_s, &ground->position};
    ground->sea_mesh.plan.is_seen = false;
    return sea_mesh_draw(&ground->sea_mesh, &inputs);
}

// The depth of the sky in kinds, over which no pass draws.
static const float HIDDEN_DEPTH = 0;

static trl_result set_open_sea(struct ground *ground, struct terrain_compose_inputs *inputs)
{
    const struct gpu_texture *open = NULL;
    const trl_result result = terrain_open_sea_find(&ground->open_sea, inputs, &open);
    inputs->has_open = open;
    return result == TRL_OK
               ? gpu_hide_draw(&ground->hide, open, TERRAIN_OPEN_DEPTH, &ground->kinds_target)
               : result;
}

static trl_result draw_surface(struct ground *ground, const struct camera *camera,
                               const struct ground_extras *extras, const struct gpu_texture *hidden)
{
    struct terrain_compose_inputs inputs = {.camera = camera,
                                            .position = find_position(ground),
                                            .shadow = &ground->shadow,
                                            .region_m = ground->region_m};
    memcpy(inputs.sea_albedo, extras->sea_albedo, sizeof inputs.sea_albedo);
    trl_result result = terrain_kinds_draw(&ground->kinds, inputs.position, &ground->kinds_target);
    if (result == TRL_OK && ground->has_waves) {
        result = set_open_sea(ground, &inputs);
    }
    if (result == TRL_OK) {
        result = gpu_hide_draw(&ground->hide, hidden, HIDDEN_DEPTH, &ground->kinds_target);
    }
    if (result == TRL_OK) {
        result = terrain_compose_draw(&ground->compose, &inputs, &ground->surface_target);
    }
    return result == TRL_OK && ground->has_waves
               ? terrain_kinds_add_water(&ground->kinds, &ground->albedo, &ground->kinds_target)
               : result;
}

static trl_result draw_facets(struct ground *ground, const struct camera *camera,
                              const struct ground_extras *extras)
{
    const struct facets_inputs inputs = {.camera = camera,
                                         .time_s = extras->time_s,
                                         .position = find_position(ground),
                                         .level = find_level(ground),
                                         .albedo = &ground->albedo,
                                         .lights = &ground->lights,
                                         .water_depth = TERRAIN_WATER_DEPTH};
    gpu_condition_begin(&ground->kinds.has_water);
    const trl_result result = facets_draw(&ground->facets, &inputs);
    gpu_condition_end(&ground->kinds.has_water);
    return result;
}

trl_result ground_draw_shape(struct ground *ground, const struct camera *camera,
                             const struct ground_extras *extras, struct frame_clock *clock)
{
    if (ground->is_bare) {
        return TRL_OK;
    }
    frame_clock_part(clock, "tiles");
    const double pixel_rad = 2 * camera->tan_half_fov_y / ground->position.height;
    trl_result result = surface_update(&ground->surface, camera, pixel_rad);
    frame_clock_part(clock, "vertices");
    struct mesher *mesher = ground->meshers[ground->mesher];
    if (result == TRL_OK) {
        mesher->error_px = ground->mesh_error_px;
        result = mesher_update(mesher, camera);
    }
    if (result == TRL_OK) {
        frame_clock_part(clock, "mesh");
        result = mesher_draw(mesher, &ground->mesh_target);
    }
    if (result == TRL_OK) {
        frame_clock_part(clock, "shadow");
        result = terrain_shadow_update(&ground->shadow, camera);
    }
    if (result == TRL_OK && ground->has_waves) {
        frame_clock_part(clock, "sea mesh");
        result = draw_sea_mesh(ground, camera, extras);
    }
    return result;
}

trl_result ground_draw_look(struct ground *ground, const struct camera *camera,
                            const struct ground_extras *extras, const struct gpu_texture *hidden,
                            struct frame_clock *clock)
{
    if (ground->is_bare) {
        return TRL_OK;
    }
    frame_clock_part(clock, "surface");
    trl_result result = draw_surface(ground, camera, extras, hidden);
    if (result == TRL_OK && ground->has_waves) {
        frame_clock_part(clock, "waves");
        result = draw_facets(ground, camera, extras);
    }
    if (result == TRL_OK && extras->has_sky_view) {
        frame_clock_part(clock, "sky view");
        result = draw_sky_view(ground, camera);
    }
    return result;
}

struct sky_surface ground_surface(const struct ground *ground)
{
    if (ground->is_bare) {
        return (struct sky_surface){0};
    }
    return (struct sky_surface){.position = find_position(ground),
                                .albedo = &ground->albedo,
                                .normal = &ground->normal,
                                .lights = &ground->lights,
                                .region = &ground->region,
                                .kinds = &ground->depth,
                                .facets = ground->has_waves ? &ground->facets.texture : NULL,
                                .has_water = ground->has_waves ? &ground->kinds.has_water : NULL,
                                .lights_cd_m2 = ground->lights_cd_m2};
}

static void bind_shadow(const void *self, const struct camera *camera, struct gpu_program *program)
{
    terrain_shadow_bind(self, camera, program);
}

struct sky_shadow ground_shadow(const struct ground *ground)
{
    return (struct sky_shadow){.bind = bind_shadow,
                               .self = &ground->shadow,
                               .highest_m = ground->shadow.projection.max_altitude_m};
}

double ground_altitude_m(const struct ground *ground, double latitude_rad, double longitude_rad)
{
    return surface_altitude(&ground->surface, vec3_from_lat_lon(latitude_rad, longitude_rad));
}

double ground_water_depth_m(const struct ground *ground, double latitude_rad, double longitude_rad)
{
    return ground->is_bare ? 0
                           : surface_water_depth_m(&ground->surface,
                                                   vec3_from_lat_lon(latitude_rad, longitude_rad));
}

double ground_wave_m(const struct ground *ground, double latitude_rad, double longitude_rad,
                     double time_s)
{
    if (!ground->has_waves) {
        return 0;
    }
    const struct vec3 place =
        vec3_scale(vec3_from_lat_lon(latitude_rad, longitude_rad), ground->surface.radius_m);
    const double fetch_m = fetch_find_m(&ground->surface, &ground->waves.wind, place);
    waves_view_make_within(&ground->waves, &(struct waves_eye){place, time_s, fetch_m},
                           ground->stand);
    return waves_stand_find(ground->stand, ground->waves.radius_m, BOAT_M, 1).height_m;
}

double ground_highest_m(const struct ground *ground)
{
    return surface_max_altitude(&ground->surface);
}
