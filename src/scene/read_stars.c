// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

static trl_result read_catalogue(const struct scene_node *stars, struct scene_stars *out)
{
    const struct scene_node file = scene_node_member(stars, "catalogue");
    const struct scene_node optional = scene_node_member(stars, "optional");
    trl_result result = scene_node_bool_or(&optional, &out->is_optional);
    if (result != TRL_OK || !file.value) {
        return result;
    }
    result = scene_read_path(&file, &out->path);
    if (result == TRL_OK) {
        out->file = mem_strdup(stars->doc->ctx, json_string_value(file.value));
        result = out->file ? TRL_OK : TRL_ERROR_MEMORY;
    }
    return result;
}

static trl_result read_pole(const struct scene_node *stars, struct scene_stars *out)
{
    const struct scene_node pole = scene_node_member(stars, "pole");
    if (!pole.value) {
        return TRL_OK;
    }
    const struct scene_range turns_deg = {.min = -360, .max = 360};
    const struct scene_range latitudes_deg = {.min = -90, .max = 90};
    const struct scene_angle angles[] = {
        {"right_ascension_deg", &turns_deg, &out->pole_right_ascension_rad, false},
        {"declination_deg", &latitudes_deg, &out->pole_declination_rad, false},
    };
    const trl_result result = scene_node_check_keys(
        &pole, (const char *const[]){"right_ascension_deg", "declination_deg", NULL});
    return result == TRL_OK ? scene_read_angles(&pole, angles, 2) : result;
}

trl_result scene_read_stars(const struct scene_node *root, struct trl_scene *out)
{
    const struct scene_node stars = scene_node_member(root, "stars");
    if (!stars.value) {
        return TRL_OK;
    }
    const char *const keys[] = {"catalogue", "optional",         "limit_magnitude",
                                "pole",      "background_cd_m2", "airglow_share",
                                NULL};
    const struct scene_range magnitudes = {.min = -30, .max = 30};
    const struct scene_range luminances = {.min = 0, .max = 1e6};
    const struct scene_range shares = {.min = 0, .max = 1};
    const struct scene_node limit = scene_node_member(&stars, "limit_magnitude");
    const struct scene_node background = scene_node_member(&stars, "background_cd_m2");
    const struct scene_node airglow = scene_node_member(&stars, "airglow_share");
    out->stars = (struct scene_stars){.limit_magnitude = magnitudes.max,
                                      .pole_declination_rad = 90 * SCENE_RADIANS_PER_DEGREE};
    trl_result result = scene_node_check_keys(&stars, keys);
    if (result == TRL_OK) {
        result = read_catalogue(&stars, &out->stars);
    }
    if (result == TRL_OK) {
        result = scene_node_number_or(&limit, &magnitudes, &out->stars.limit_magnitude);
    }
    if (result == TRL_OK) {
        result = read_pole(&stars, &out->stars);
    }
    if (result == TRL_OK) {
        result = scene_node_number_or(&background, &luminances, &out->stars.background_cd_m2);
    }
    return result == TRL_OK ? scene_node_number_or(&airglow, &shares, &out->stars.airglow_share)
                            : result;
}
