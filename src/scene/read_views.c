// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <string.h>

#include "scene/read.h"

static const struct scene_range latitudes_deg = {.min = -90, .max = 90};
static const struct scene_range turns_deg = {.min = -360, .max = 360};
static const struct scene_range distances = {.min = -1e6, .max = 1e11};
static const struct scene_range times_s = {.min = -1e12, .max = 1e12};
static const struct scene_range heights = {.min = 0, .max = 1e11};

static trl_result read_angle(const struct scene_node *object, const struct scene_angle *angle)
{
    const struct scene_node node = scene_node_member(object, angle->key);
    if (angle->is_optional && !node.value) {
        return TRL_OK;
    }
    double angle_deg = 0;
    const trl_result result = scene_node_number(&node, angle->range_deg, &angle_deg);
    if (result == TRL_OK) {
        *angle->out_rad = angle_deg * SCENE_RADIANS_PER_DEGREE;
    }
    return result;
}

trl_result scene_read_angles(const struct scene_node *object, const struct scene_angle *angles,
                             size_t count)
{
    trl_result result = TRL_OK;
    for (size_t i = 0; result == TRL_OK && i < count; i++) {
        result = read_angle(object, &angles[i]);
    }
    return result;
}

static trl_result read_altitude(const struct scene_node *camera, trl_view *out)
{
    const struct scene_node altitude = scene_node_member(camera, "altitude_m");
    const struct scene_node height = scene_node_member(camera, "height_above_ground_m");
    const struct scene_node boat = scene_node_member(camera, "height_above_waves_m");
    if (!!altitude.value + !!height.value + !!boat.value != 1) {
        return scene_node_fail(camera, "must have one of altitude_m, height_above_ground_m and "
                                       "height_above_waves_m");
    }
    if (altitude.value) {
        out->altitude_mode = TRL_ALTITUDE_SPHERE;
        return scene_node_number(&altitude, &distances, &out->altitude_m);
    }
    out->altitude_mode = height.value ? TRL_ALTITUDE_GROUND : TRL_ALTITUDE_WAVES;
    return scene_node_number(height.value ? &height : &boat, &heights, &out->altitude_m);
}

static trl_result read_camera(const struct scene_node *node, trl_view *out)
{
    const char *const keys[] = {"latitude_deg",
                                "longitude_deg",
                                "altitude_m",
                                "height_above_ground_m",
                                "height_above_waves_m",
                                "heading_deg",
                                "pitch_deg",
                                "roll_deg",
                                "vertical_fov_deg",
                                NULL};
    const struct scene_range fields_deg = {.min = 0.001, .max = 170};
    const struct scene_angle angles[] = {
        {"latitude_deg", &latitudes_deg, &out->latitude_rad, false},
        {"longitude_deg", &turns_deg, &out->longitude_rad, false},
        {"heading_deg", &turns_deg, &out->heading_rad, true},
        {"pitch_deg", &latitudes_deg, &out->pitch_rad, true},
        {"roll_deg", &turns_deg, &out->roll_rad, true},
        {"vertical_fov_deg", &fields_deg, &out->vertical_fov_rad, true},
    };
    trl_result result = scene_node_check_keys(node, keys);
    out->heading_rad = 0;
    out->pitch_rad = 0;
    out->roll_rad = 0;
    if (result == TRL_OK) {
        result = scene_read_angles(node, angles, sizeof angles / sizeof angles[0]);
    }
    return result == TRL_OK ? read_altitude(node, out) : result;
}

static trl_result read_sun(const struct scene_node *node, trl_view *out)
{
    const bool is_local = json_object_get(node->value, "elevation_deg") ||
                          json_object_get(node->value, "azimuth_deg");
    const char *const local[] = {"elevation_deg", "azimuth_deg", NULL};
    const char *const subsolar[] = {"subsolar_latitude_deg", "subsolar_longitude_deg", NULL};
    const char *const *keys = is_local ? local : subsolar;
    const struct scene_angle angles[] = {
        {keys[0], &latitudes_deg, &out->sun_latitude_or_elevation_rad, false},
        {keys[1], &turns_deg, &out->sun_longitude_or_azimuth_rad, false},
    };
    out->sun_mode = is_local ? TRL_SUN_LOCAL : TRL_SUN_SUBSOLAR;
    // Unknown keys are compared with both pairs, then one of the pairs has to be whole and alone.
    const char *const all[] = {local[0], local[1], subsolar[0], subsolar[1], NULL};
    trl_result result = scene_node_check_keys(node, all);
    if (result == TRL_OK) {
        result = scene_node_check_keys(node, keys);
    }
    return result == TRL_OK ? scene_read_angles(node, angles, 2) : result;
}

static trl_result read_exposure(const struct scene_node *node, trl_view *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    const struct scene_range values = {.min = -40, .max = 40};
    trl_result result =
        scene_node_check_keys(node, (const char *const[]){"ev100", "bias_ev", "tone", NULL});
    const struct scene_node ev100 = scene_node_member(node, "ev100");
    const struct scene_node bias = scene_node_member(node, "bias_ev");
    const struct scene_node tone = scene_node_member(node, "tone");
    out->has_fixed_exposure = ev100.value != NULL;
    if (result == TRL_OK) {
        result = scene_node_number_or(&ev100, &values, &out->exposure_ev100);
    }
    if (result == TRL_OK) {
        result = scene_node_number_or(&bias, &values, &out->exposure_bias_ev);
    }
    if (result == TRL_OK && tone.value) {
        size_t curve = 0;
        result =
            scene_node_word(&tone, (const char *const[]){"filmic", "exponential", NULL}, &curve);
        out->tone_curve = curve == 0 ? TRL_TONE_FILMIC : TRL_TONE_EXPONENTIAL;
    }
    return result;
}

static trl_result read_view(const struct scene_node *node, const struct trl_scene *scene,
                            trl_view *out)
{
    *out = trl_view_default();
    trl_result result =
        scene_node_check_keys(node, (const char *const[]){"camera", "sun", "sidereal_deg", "time_s",
                                                          "bodies", "exposure", NULL});
    const struct scene_node camera = scene_node_member(node, "camera");
    const struct scene_node sun = scene_node_member(node, "sun");
    const struct scene_node bodies = scene_node_member(node, "bodies");
    const struct scene_node exposure = scene_node_member(node, "exposure");
    if (result == TRL_OK) {
        result = read_camera(&camera, out);
    }
    if (result == TRL_OK) {
        result = read_sun(&sun, out);
    }
    if (result == TRL_OK) {
        const struct scene_angle sidereal = {"sidereal_deg", &turns_deg, &out->sidereal_rad, true};
        result = scene_read_angles(node, &sidereal, 1);
    }
    if (result == TRL_OK) {
        const struct scene_node time = scene_node_member(node, "time_s");
        result = scene_node_number_or(&time, &times_s, &out->time_s);
    }
    if (result == TRL_OK && bodies.value) {
        result = scene_read_body_places(&bodies, scene, out);
    }
    return result == TRL_OK ? read_exposure(&exposure, out) : result;
}

static trl_result read_named_view(const struct scene_node *views, const char *name,
                                  struct trl_scene *out)
{
    const struct scene_node node = scene_node_member(views, name);
    const size_t i = out->view_count;
    if (i == SCENE_MAX_VIEWS) {
        return scene_node_fail(&node, "is one view too many; at most %d are allowed",
                               SCENE_MAX_VIEWS);
    }
    const size_t length = strlen(name);
    if (length == 0 || length > 64) {
        return scene_node_fail(&node, "a view's name must have 1 to 64 bytes");
    }
    out->view_names[i] = mem_strdup(views->doc->ctx, name);
    if (!out->view_names[i]) {
        return TRL_ERROR_MEMORY;
    }
    out->view_count++;
    return read_view(&node, out, &out->views[i]);
}

trl_result scene_read_views(const struct scene_node *root, struct trl_scene *out)
{
    const struct scene_node views = scene_node_member(root, "views");
    if (!views.value) {
        return TRL_OK;
    }
    if (!json_is_object(views.value)) {
        return scene_node_fail(&views, "must be an object of named views");
    }
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)views.value, name, value)
    {
        if (strcmp(name, "comment") == 0 && json_is_string(value)) {
            continue;
        }
        const trl_result result = read_named_view(&views, name, out);
        if (result != TRL_OK) {
            return result;
        }
    }
    return TRL_OK;
}
