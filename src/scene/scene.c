// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/scene.h"

#include "raster/remote.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "scene/read.h"

#define PI 3.14159265358979323846

enum { SCENE_MAX_BYTES = 16 << 20, FORMAT_VERSION = 1 };

// Three radii of a planet like Earth; the scene's own radius when it gives a default view.
#define DEFAULT_RADIUS_M 6371000.0

trl_view trl_view_default(void)
{
    return (trl_view){.altitude_m = 3 * DEFAULT_RADIUS_M,
                      .pitch_rad = -PI / 2,
                      .vertical_fov_rad = 40 * PI / 180,
                      .sun_mode = TRL_SUN_SUBSOLAR,
                      .sun_longitude_or_azimuth_rad = PI / 2};
}

static trl_result check_version(const struct scene_node *root)
{
    const struct scene_node version = scene_node_member(root, "terrella");
    const struct scene_range only = {.min = FORMAT_VERSION, .max = FORMAT_VERSION};
    if (json_is_number(version.value) &&
        !scene_range_holds(&only, json_number_value(version.value))) {
        return scene_node_fail(&version, "format %g is unknown; must be %d",
                               json_number_value(version.value), FORMAT_VERSION);
    }
    double ignored = 0;
    return scene_node_number(&version, &only, &ignored);
}

// Without a name, the file's.
static trl_result read_name(const struct scene_node *root, struct trl_scene *scene)
{
    const struct scene_node node = scene_node_member(root, "name");
    const char *name = root->doc->name;
    const trl_result result = node.value ? scene_node_string(&node, &name) : TRL_OK;
    if (result != TRL_OK) {
        return result;
    }
    scene->name = mem_strdup(scene->ctx, name);
    return scene->name ? TRL_OK : TRL_ERROR_MEMORY;
}

static trl_result read_root(const struct scene_node *root, struct trl_scene *scene)
{
    // Editors find the schema by "$schema"; it says nothing to the reader.
    const char *const keys[] = {"$schema",    "terrella", "name",   "star",      "planet",
                                "atmosphere", "surface",  "views",  "sky_model", "bodies",
                                "rayleigh",   "stars",    "clouds", "ocean",     NULL};
    const struct scene_node schema = scene_node_member(root, "$schema");
    const char *ignored = NULL;
    trl_result result = scene_node_check_keys(root, keys);
    if (result == TRL_OK && schema.value) {
        result = scene_node_string(&schema, &ignored);
    }
    if (result == TRL_OK) {
        result = check_version(root);
    }
    if (result == TRL_OK) {
        result = read_name(root, scene);
    }
    if (result == TRL_OK) {
        result = scene_read_medium(root, &scene->medium);
    }
    if (result == TRL_OK) {
        result = scene_read_sky_model(root, scene);
    }
    if (result == TRL_OK) {
        result = scene_read_rayleigh(root, &scene->rayleigh);
    }
    if (result == TRL_OK) {
        result = scene_read_layers(root, scene);
    }
    if (result == TRL_OK) {
        result = scene_read_ocean(root, &scene->ocean);
    }
    if (result == TRL_OK) {
        result = scene_read_clouds(root, scene);
    }
    if (result == TRL_OK) {
        result = scene_read_stars(root, scene);
    }
    if (result == TRL_OK) {
        result = scene_read_bodies(root, scene);
    }
    return result == TRL_OK ? scene_read_views(root, scene) : result;
}

static trl_result parse(const struct scene_doc *doc, trl_scene **out)
{
    struct scene_node root;
    json_t *value = NULL;
    trl_result result = scene_node_parse(doc, &root, &value);
    if (result != TRL_OK) {
        return result;
    }
    trl_scene *scene = mem_alloc(doc->ctx, 1, sizeof *scene);
    if (scene) {
        scene->ctx = doc->ctx;
        result = read_root(&root, scene);
    } else {
        result = TRL_ERROR_MEMORY;
    }
    if (result != TRL_OK) {
        trl_scene_destroy(&scene);
    }
    json_decref(value);
    *out = scene;
    return result;
}

trl_result trl_scene_parse(trl_context *ctx, const char *text, size_t length, const char *name,
                           const char *base_dir, trl_scene **out)
{
    if (out) {
        *out = NULL;
    }
    if (!ctx || !text || !name || !base_dir || !out) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "trl_scene_parse: an argument is NULL");
    }
    const struct scene_doc doc = {
        .ctx = ctx, .name = name, .base_dir = base_dir, .text = text, .length = length};
    return parse(&doc, out);
}

// The folder of a file, "." when the path has none.
static char *find_folder(const trl_context *ctx, const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash) {
        return mem_strdup(ctx, ".");
    }
    return slash == path ? mem_strdup(ctx, "/")
                         : mem_printf(ctx, "%.*s", (int)(slash - path), path);
}

trl_result trl_scene_load(trl_context *ctx, const char *path, trl_scene **out)
{
    if (out) {
        *out = NULL;
    }
    if (!ctx || !path || !out) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "trl_scene_load: an argument is NULL");
    }
    char *text = NULL;
    size_t length = 0;
    trl_result result = file_read(ctx, path, SCENE_MAX_BYTES, &text, &length);
    if (result != TRL_OK) {
        return result;
    }
    char *folder = find_folder(ctx, path);
    result = folder ? trl_scene_parse(ctx, text, length, path, folder, out) : TRL_ERROR_MEMORY;
    mem_free(ctx, folder);
    mem_free(ctx, text);
    return result;
}

void trl_scene_destroy(trl_scene **scene)
{
    if (!scene || !*scene) {
        return;
    }
    trl_scene *s = *scene;
    const trl_context *ctx = s->ctx;
    medium_finish(ctx, &s->medium);
    ocean_desc_finish(ctx, &s->ocean);
    for (size_t i = 0; i < s->layer_count; i++) {
        mem_free(ctx, s->layers[i].name);
        mem_free(ctx, s->layers[i].file);
        mem_free(ctx, s->layers[i].path);
        spectrum_finish(ctx, &s->layers[i].albedo);
    }
    for (size_t i = 0; i < s->body_count; i++) {
        mem_free(ctx, s->bodies[i].name);
        spectrum_finish(ctx, &s->bodies[i].geometric_albedo);
    }
    for (size_t i = 0; i < s->biome_count; i++) {
        spectrum_finish(ctx, &s->biomes[i].albedo);
    }
    spectrum_finish(ctx, &s->detail.rock.albedo);
    for (size_t i = 0; i < s->view_count; i++) {
        mem_free(ctx, s->view_names[i]);
    }
    mem_free(ctx, s->clouds.map_path);
    mem_free(ctx, s->stars.file);
    mem_free(ctx, s->stars.path);
    mem_free(ctx, s->name);
    mem_free(ctx, s);
    *scene = NULL;
}

const char *trl_scene_name(const trl_scene *scene)
{
    return scene->name;
}

double trl_scene_ground_radius_m(const trl_scene *scene)
{
    return scene->medium.ground_radius_m;
}

double trl_scene_top_radius_m(const trl_scene *scene)
{
    return scene->medium.top_radius_m;
}

trl_sky_model trl_scene_sky_model(const trl_scene *scene)
{
    return scene->sky_model;
}

trl_rayleigh_desc trl_scene_rayleigh(const trl_scene *scene)
{
    return scene->rayleigh;
}

size_t trl_scene_constituent_count(const trl_scene *scene)
{
    return scene->medium.constituent_count;
}

const char *trl_scene_constituent_name(const trl_scene *scene, size_t index)
{
    const struct medium *medium = &scene->medium;
    return index < medium->constituent_count ? medium->constituents[index].name : NULL;
}

double trl_scene_constituent_asymmetry(const trl_scene *scene, size_t index)
{
    const struct medium *medium = &scene->medium;
    if (index >= medium->constituent_count) {
        return (double)NAN;
    }
    const struct phase *phase = &medium->constituents[index].phase;
    const bool has_one =
        phase->kind == PHASE_HENYEY_GREENSTEIN || phase->kind == PHASE_CORNETTE_SHANKS;
    return has_one ? phase->g : (double)NAN;
}

size_t trl_scene_view_count(const trl_scene *scene)
{
    return scene->view_count;
}

const char *trl_scene_view_name(const trl_scene *scene, size_t index)
{
    return index < scene->view_count ? scene->view_names[index] : NULL;
}

static trl_result fail_no_view(const trl_scene *scene, const char *name)
{
    char names[1024] = "";
    size_t length = 0;
    for (size_t i = 0; i < scene->view_count && length < sizeof names - 1; i++) {
        snprintf(names + length, sizeof names - length, "%s%s", i > 0 ? ", " : "",
                 scene->view_names[i]);
        length = strlen(names);
    }
    return trl_fail(scene->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SCENE,
                    "there is no view \"%.64s\" in %s; there is: %s", name, scene->name,
                    length > 0 ? names : "none");
}

trl_result trl_scene_view(const trl_scene *scene, const char *name, trl_view *out)
{
    *out = trl_view_default();
    if (!name) {
        out->altitude_m = 3 * scene->medium.ground_radius_m;
        if (scene->view_count > 0) {
            *out = scene->views[0];
        }
        return TRL_OK;
    }
    for (size_t i = 0; i < scene->view_count; i++) {
        if (strcmp(scene->view_names[i], name) == 0) {
            *out = scene->views[i];
            return TRL_OK;
        }
    }
    return fail_no_view(scene, name);
}

size_t trl_scene_layer_count(const trl_scene *scene)
{
    return scene->layer_count;
}

const char *trl_scene_layer_name(const trl_scene *scene, size_t index)
{
    return index < scene->layer_count ? scene->layers[index].name : NULL;
}

const char *trl_scene_layer_path(const trl_scene *scene, size_t index)
{
    return index < scene->layer_count ? scene->layers[index].path : NULL;
}

bool trl_scene_layer_is_present(const trl_scene *scene, size_t index)
{
    return index < scene->layer_count && (remote_is_path(scene->layers[index].path) ||
                                          scene_path_exists(scene->layers[index].path));
}
