// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Bodies of a scene, and where a view has them.
#include "scene/read.h"

#include <string.h>

// Nearer than a parsec and the squares of such lengths stay far within floats.
static const struct scene_range distances = {.min = 1, .max = 1e13};

double scene_body_nearest_m(const struct trl_scene *scene, const struct scene_body *body)
{
    return scene->medium.top_radius_m + body->radius_m;
}

size_t trl_scene_body_count(const trl_scene *scene)
{
    return scene->body_count;
}

const char *trl_scene_body_name(const trl_scene *scene, size_t index)
{
    return index < scene->body_count ? scene->bodies[index].name : NULL;
}

static trl_result read_distance(const struct scene_node *node, const struct trl_scene *scene,
                                const struct scene_body *body, double *out)
{
    const trl_result result = scene_node_number(node, &distances, out);
    const double nearest_m = scene_body_nearest_m(scene, body);
    if (result == TRL_OK && !(*out > nearest_m)) {
        return scene_node_fail(node,
                               "is %.10g; must be above %.10g: the body would reach into the "
                               "planet or its air",
                               *out, nearest_m);
    }
    return result;
}

// Views name bodies by keys, where "comment" is something else.
static trl_result read_name(const struct scene_node *node, const struct trl_scene *scene,
                            struct scene_body *out)
{
    const char *name = NULL;
    const trl_result result = scene_node_string(node, &name);
    if (result != TRL_OK) {
        return result;
    }
    if (strlen(name) > 64 || strcmp(name, "comment") == 0) {
        return scene_node_fail(node, "must have at most 64 bytes and not be \"comment\"");
    }
    for (const struct scene_body *other = scene->bodies; other < out; other++) {
        if (strcmp(other->name, name) == 0) {
            return scene_node_fail(node, "is the name of an earlier body");
        }
    }
    out->name = mem_strdup(node->doc->ctx, name);
    return out->name ? TRL_OK : TRL_ERROR_MEMORY;
}

static trl_result read_law(const struct scene_node *node, struct scene_body *out)
{
    const char *const words[] = {[BODY_LOMMEL_SEELIGER] = "lommel_seeliger",
                                 [BODY_LAMBERT] = "lambert",
                                 [BODY_LUNAR] = "lunar",
                                 NULL};
    const struct scene_node law = scene_node_member(node, "phase_law");
    if (!law.value) {
        return TRL_OK; // lommel_seeliger
    }
    size_t word = 0;
    const trl_result result = scene_node_word(&law, words, &word);
    out->phase_law = (enum body_law)word;
    return result;
}

static trl_result read_body(const struct scene_node *node, const struct trl_scene *scene,
                            struct scene_body *out)
{
    const char *const keys[] = {"name",      "radius_m", "distance_m", "geometric_albedo",
                                "phase_law", NULL};
    const struct scene_range radii = {.min = 1, .max = 1e10};
    const struct scene_range albedos = {.min = 0, .max = 2};
    const struct scene_node name = scene_node_member(node, "name");
    const struct scene_node radius = scene_node_member(node, "radius_m");
    const struct scene_node distance = scene_node_member(node, "distance_m");
    const struct scene_node albedo = scene_node_member(node, "geometric_albedo");
    trl_result result = scene_node_check_keys(node, keys);
    if (result == TRL_OK) {
        result = read_name(&name, scene, out);
    }
    if (result == TRL_OK) {
        result = scene_node_number(&radius, &radii, &out->radius_m);
    }
    if (result == TRL_OK) {
        result = read_distance(&distance, scene, out, &out->distance_m);
    }
    if (result == TRL_OK) {
        result = scene_read_spectrum(&albedo, &albedos, &out->geometric_albedo);
    }
    return result == TRL_OK ? read_law(node, out) : result;
}

trl_result scene_read_bodies(const struct scene_node *root, struct trl_scene *out)
{
    const struct scene_node bodies = scene_node_member(root, "bodies");
    if (!bodies.value) {
        return TRL_OK;
    }
    trl_result result = scene_node_check_array(&bodies, SCENE_MAX_BODIES, "a list of bodies");
    for (size_t i = 0; result == TRL_OK && i < json_array_size(bodies.value); i++) {
        const struct scene_node element = scene_node_element(&bodies, i);
        out->body_count = i + 1;
        result = read_body(&element, out, &out->bodies[i]);
    }
    return result;
}

// Two numbers up and to the right.
static trl_result read_offset(const struct scene_node *node, trl_body_place *out)
{
    const struct scene_range offsets_deg = {.min = -180, .max = 180};
    if (!json_is_array(node->value) || json_array_size(node->value) != 2) {
        return scene_node_fail(node, "must be a pair [right, up]");
    }
    const struct scene_node right = scene_node_element(node, 0);
    const struct scene_node up = scene_node_element(node, 1);
    double right_deg = 0, up_deg = 0;
    trl_result result = scene_node_number(&right, &offsets_deg, &right_deg);
    if (result == TRL_OK) {
        result = scene_node_number(&up, &offsets_deg, &up_deg);
    }
    out->longitude_or_azimuth_rad = right_deg * SCENE_RADIANS_PER_DEGREE;
    out->latitude_or_elevation_rad = up_deg * SCENE_RADIANS_PER_DEGREE;
    return result;
}

static trl_result read_direction(const struct scene_node *node, trl_body_place *out)
{
    const struct scene_range latitudes_deg = {.min = -90, .max = 90};
    const struct scene_range turns_deg = {.min = -360, .max = 360};
    const bool is_local = json_object_get(node->value, "elevation_deg") ||
                          json_object_get(node->value, "azimuth_deg");
    const struct scene_angle angles[] = {
        {is_local ? "elevation_deg" : "latitude_deg", &latitudes_deg,
         &out->latitude_or_elevation_rad, false},
        {is_local ? "azimuth_deg" : "longitude_deg", &turns_deg, &out->longitude_or_azimuth_rad,
         false},
    };
    out->mode = is_local ? TRL_BODY_LOCAL : TRL_BODY_SUBPOINT;
    return scene_read_angles(node, angles, 2);
}

// One of three forms has to be whole and alone.
static trl_result check_form(const struct scene_node *node)
{
    static const char *const all[] = {
        "elevation_deg", "azimuth_deg", "latitude_deg", "longitude_deg", "offset_from_sun_deg",
        "distance_m",    NULL};
    const trl_result result = scene_node_check_keys(node, all);
    if (result != TRL_OK) {
        return result;
    }
    size_t forms = 0;
    for (size_t i = 0; i < 5; i += 2) {
        forms += json_object_get(node->value, all[i]) ||
                 (i < 4 && json_object_get(node->value, all[i + 1]));
    }
    return forms == 1 ? TRL_OK
                      : scene_node_fail(node, "must have one of elevation_deg with azimuth_deg, "
                                              "latitude_deg with longitude_deg, and "
                                              "offset_from_sun_deg");
}

static trl_result read_place(const struct scene_node *node, const struct trl_scene *scene,
                             const struct scene_body *body, trl_body_place *out)
{
    const struct scene_node offset = scene_node_member(node, "offset_from_sun_deg");
    const struct scene_node distance = scene_node_member(node, "distance_m");
    trl_result result = check_form(node);
    if (result == TRL_OK && offset.value) {
        out->mode = TRL_BODY_FROM_SUN;
        result = read_offset(&offset, out);
    } else if (result == TRL_OK) {
        result = read_direction(node, out);
    }
    return result == TRL_OK && distance.value
               ? read_distance(&distance, scene, body, &out->distance_m)
               : result;
}

trl_result scene_read_body_places(const struct scene_node *node, const struct trl_scene *scene,
                                  trl_view *out)
{
    const char *names[SCENE_MAX_BODIES + 1] = {NULL};
    for (size_t i = 0; i < scene->body_count; i++) {
        names[i] = scene->bodies[i].name;
    }
    trl_result result = scene_node_check_keys(node, names);
    for (size_t i = 0; result == TRL_OK && i < scene->body_count; i++) {
        const struct scene_node place = scene_node_member(node, names[i]);
        if (place.value) {
            result = read_place(&place, scene, &scene->bodies[i], &out->bodies[i]);
        }
    }
    return result;
}
