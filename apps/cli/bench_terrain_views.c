// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "bench_terrain.h"

#include <math.h>
#include <string.h>

static const double RAD_PER_DEG = 3.14159265358979323846 / 180;
static const double FLIGHT_FROM_M = 1e7;

struct place {
    const char *name;
    double latitude_deg, longitude_deg;
    double height_m;
    bool is_above_ground; // else above the sphere
    double heading_deg, pitch_deg, fov_deg;
};

static const struct place EARTH[] = {
    {"orbit", 22, 25, 1e7, false, 0, -90, 54},
    // The Himalaya.
    {"100 km", 26, 86, 1e5, false, 10, -25, 45},
    {"10 km", 27, 86.6, 1e4, false, 12, -8, 45},
    // Along the Sangre de Cristo Mountains, in data of 3 arc seconds.
    {"100 m", 37.38, -105, 100, true, 325, -4, 45},
    // Below Blanca Peak.
    {"valley", 37.64, -105.43, 20, true, 200, 6, 50},
    // The South Pole's plateau, toward the Transantarctic Mountains.
    {"pole", -89.8, 30, 2000, true, 180, -10, 50},
    // Of Toba's caldera.
    {"crater rim", 2.4, 98.95, 50, true, 330, -6, 50},
    // From the Gulf of Alaska, mountains of 5000 m behind the horizon.
    {"horizon at 0 m", 58.6, -141.5, 0, true, 10, 0.5, 20},
};
static const struct place EARTH_LANDING = {"", 37.38, -105, 30, true, 325, -2.5, 45};

static const struct place MARS[] = {
    {"orbit", -4, -80, 8e6, false, 0, -90, 40},
    // Olympus Mons.
    {"100 km", 12, -136, 1e5, false, 25, -20, 45},
    // Along Coprates Chasma.
    {"10 km", -13.5, -58, 1e4, true, 290, -8, 45},
    {"100 m", -4.55, 137.45, 100, true, 145, 2, 50},
    // The floor of Melas Chasma.
    {"valley", -10.5, -73, 20, true, 180, 4, 50},
    {"pole", 89.5, 30, 2000, true, 180, -10, 50},
    // Of the caldera of Olympus Mons.
    {"crater rim", 18.0, -132.5, 50, true, 300, -4, 50},
    {"horizon at 0 m", 40, -160, 0, true, 90, 0.5, 20},
};
static const struct place MARS_LANDING = {"", -4.55, 137.45, 30, true, 145, 2, 50};

enum { PLACES = sizeof EARTH / sizeof *EARTH };
_Static_assert(PLACES == sizeof MARS / sizeof *MARS, "the same views of both");

static trl_view make_view(const struct place *place)
{
    trl_view view = trl_view_default();
    view.latitude_rad = place->latitude_deg * RAD_PER_DEG;
    view.longitude_rad = place->longitude_deg * RAD_PER_DEG;
    view.altitude_m = place->height_m;
    view.altitude_mode = place->is_above_ground ? TRL_ALTITUDE_GROUND : TRL_ALTITUDE_SPHERE;
    view.heading_rad = place->heading_deg * RAD_PER_DEG;
    view.pitch_rad = place->pitch_deg * RAD_PER_DEG;
    view.vertical_fov_rad = place->fov_deg * RAD_PER_DEG;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 40 * RAD_PER_DEG;
    view.sun_longitude_or_azimuth_rad = 180 * RAD_PER_DEG;
    return view;
}

trl_result bench_terrain_choose_views(const trl_scene *scene, struct bench_terrain_views *out)
{
    *out = (struct bench_terrain_views){.count = 0};
    const bool is_mars = strcmp(trl_scene_name(scene), "Mars") == 0;
    if (is_mars || strcmp(trl_scene_name(scene), "Earth") == 0) {
        for (; out->count < PLACES; out->count++) {
            const struct place *place = &(is_mars ? MARS : EARTH)[out->count];
            out->of[out->count] = (struct bench_terrain_view){place->name, make_view(place)};
        }
        out->has_flight = true;
        out->landing = make_view(is_mars ? &MARS_LANDING : &EARTH_LANDING);
        return TRL_OK;
    }
    const size_t all = trl_scene_view_count(scene);
    trl_result result = TRL_OK;
    for (size_t i = 0; i < all && i < BENCH_TERRAIN_MAX_VIEWS && result == TRL_OK; i++) {
        struct bench_terrain_view *view = &out->of[out->count++];
        view->name = trl_scene_view_name(scene, i);
        result = trl_scene_view(scene, view->name, &view->view);
    }
    return result;
}

trl_view bench_terrain_flight(const struct bench_terrain_views *views, int index, int count)
{
    const double part = count > 1 ? (double)index / (count - 1) : 1;
    trl_view view = views->landing;
    view.altitude_m = FLIGHT_FROM_M * pow(view.altitude_m / FLIGHT_FROM_M, part);
    const double nadir_rad = -90 * RAD_PER_DEG;
    view.pitch_rad = nadir_rad + (view.pitch_rad - nadir_rad) * part * part;
    return view;
}
