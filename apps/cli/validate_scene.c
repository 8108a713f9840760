// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Which views are compared, and in which scenes.
#include "validate.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double rad_per_deg = 3.14159265358979323846 / 180.0;

// From noon to the end of civil twilight.
static const double suns_deg[VALIDATE_SUNS] = {60, 20, 3, -2, -6};
static const double quick_suns_deg[] = {60, 3, -6};
static const double wavelengths_nm[VALIDATE_WAVELENGTHS] = {450, 550, 650};

struct direction {
    double zenith_deg, azimuth_deg;
};

static const struct direction from_ground[VALIDATE_DIRECTIONS] = {{20, 90}, {45, 0},  {60, 180},
                                                                  {75, 45}, {85, 90}, {88, 150}};
static const struct direction from_air[VALIDATE_DIRECTIONS] = {{20, 90}, {70, 0},   {85, 180},
                                                               {93, 20}, {100, 90}, {150, 135}};
// From outside: down, aslant, and past the limb, whose zenith angles depend on the planet.
static const double limb_azimuths_deg[] = {30, 90, 150};
static const double limb_heights[] = {0.03, 0.1,
                                      0.25}; // of the lowest point, in heights of the air
static const struct direction from_orbit[] = {{178, 90}, {150, 30}, {130, 150}};

static const char *const places[VALIDATE_PLACES] = {"ground", "10 km", "orbit"};

static double place_altitude_m(const trl_scene *scene, int place)
{
    const double height_m = trl_scene_top_radius_m(scene) - trl_scene_ground_radius_m(scene);
    const double altitudes_m[VALIDATE_PLACES] = {2, fmin(1e4, 0.5 * height_m), 4 * height_m};
    return altitudes_m[place];
}

static struct direction choose_direction(const trl_scene *scene, int place, int index)
{
    if (place == 0) {
        return from_ground[index];
    }
    if (place == 1) {
        return from_air[index];
    }
    const int limb = index - (int)(sizeof from_orbit / sizeof *from_orbit);
    const double ground_m = trl_scene_ground_radius_m(scene);
    const double height_m = trl_scene_top_radius_m(scene) - ground_m;
    const double eye_m = ground_m + place_altitude_m(scene, place);
    if (limb < 0) {
        // Between straight down and the horizon, at the same shares for every planet.
        const double horizon_deg = asin(ground_m / eye_m) / rad_per_deg;
        const struct direction d = from_orbit[index];
        return (struct direction){180 - (180 - d.zenith_deg) * horizon_deg / 70, d.azimuth_deg};
    }
    const double lowest_m = ground_m + limb_heights[limb] * height_m;
    return (struct direction){180 - asin(lowest_m / eye_m) / rad_per_deg, limb_azimuths_deg[limb]};
}

static void fill_case(const trl_scene *scene, int place, double sun_deg, struct validate_case *out)
{
    *out = (struct validate_case){.place = places[place],
                                  .altitude_m = place_altitude_m(scene, place),
                                  .sun_elevation_deg = sun_deg};
    for (int d = 0; d < VALIDATE_DIRECTIONS; d++) {
        const struct direction direction = choose_direction(scene, place, d);
        for (int w = 0; w < VALIDATE_WAVELENGTHS; w++) {
            out->queries[out->count++] =
                (trl_sky_query){.altitude_m = out->altitude_m,
                                .sun_zenith_rad = (90 - sun_deg) * rad_per_deg,
                                .view_zenith_rad = direction.zenith_deg * rad_per_deg,
                                .azimuth_rad = direction.azimuth_deg * rad_per_deg,
                                .wavelength_nm = wavelengths_nm[w]};
        }
    }
}

static void fill_cases(const struct validate *v, struct validate_scene *out)
{
    const double *suns = v->is_quick ? quick_suns_deg : suns_deg;
    const int sun_count = v->is_quick ? (int)(sizeof quick_suns_deg / sizeof *suns) : VALIDATE_SUNS;
    for (int place = 0; place < VALIDATE_PLACES; place++) {
        for (int s = 0; s < sun_count; s++) {
            fill_case(out->scene, place, suns[s], &out->cases[out->case_count++]);
        }
    }
}

// The scene without its layers. The file has been read before, so failures are those of memory.
static trl_result load_bare(trl_context *ctx, const char *path, trl_scene **out)
{
    json_error_t error;
    json_t *root = json_load_file(path, 0, &error);
    json_object_del(root, "surface");
    char *text = root ? json_dumps(root, JSON_COMPACT) : NULL;
    json_decref(root);
    char folder[4096];
    const char *slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path) : 1, slash ? path : ".");
    trl_result result = TRL_ERROR_MEMORY;
    if (text) {
        result = trl_scene_parse(ctx, text, strlen(text), path, folder, out);
    } else {
        report_error(EXIT_FAILED, "%s: out of memory", path);
    }
    free(text);
    return result;
}

enum exit_status validate_load(struct validate *v, const char *path)
{
    struct validate_scene *scene = &v->scenes[v->scene_count];
    *scene = (struct validate_scene){.path = path};
    trl_result result = trl_scene_load(v->app->ctx, path, &scene->scene);
    if (result == TRL_OK && trl_scene_layer_count(scene->scene) > 0) {
        trl_scene_destroy(&scene->scene);
        result = load_bare(v->app->ctx, path, &scene->scene);
    }
    if (result != TRL_OK) {
        return EXIT_FAILED;
    }
    v->scene_count++;
    fill_cases(v, scene);
    return EXIT_OK;
}

enum exit_status validate_load_shipped(struct validate *v)
{
    static const char *const files[] = {"earth.json", "mars.json", "venus.json", "titan.json",
                                        "earth-dense.json"};
    enum exit_status status = EXIT_OK;
    for (size_t i = 0; status == EXIT_OK && i < sizeof files / sizeof *files; i++) {
        char *path = app_find_scene(files[i]);
        status = path ? validate_load(v, path) : EXIT_OK;
        if (path && status == EXIT_OK) {
            v->scenes[v->scene_count - 1].path = files[i]; // where it lies is of no interest
        }
        free(path);
    }
    if (status == EXIT_OK && v->scene_count == 0) {
        return report_error(EXIT_FAILED, "validate: the scenes are not where the program was built "
                                         "or installed; give some");
    }
    return status;
}

void validate_finish(struct validate *v)
{
    for (int s = 0; s < v->scene_count; s++) {
        struct validate_scene *scene = &v->scenes[s];
        for (int c = 0; c < scene->case_count; c++) {
            free(scene->cases[c].traced.picture);
            for (int m = 0; m < VALIDATE_MODELS; m++) {
                free(scene->cases[c].answers[m].pictures.picture);
                free(scene->cases[c].answers[m].pictures.map);
            }
        }
        trl_scene_destroy(&scene->scene);
    }
    for (int look = 0; look < CLOUD_LOOKS; look++) {
        free(v->clouds.looks[look].drawn);
        free(v->clouds.looks[look].traced);
        free(v->clouds.looks[look].map);
    }
    v->scene_count = 0;
}
