// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_BENCH_TERRAIN_H
#define CLI_BENCH_TERRAIN_H
// The views from which meshes of the ground are judged.

#include "bench.h"

enum { BENCH_TERRAIN_MAX_VIEWS = 16 };

struct bench_terrain_view {
    const char *name;
    trl_view view;
};

struct bench_terrain_views {
    struct bench_terrain_view of[BENCH_TERRAIN_MAX_VIEWS];
    int count;
    bool has_flight;
    trl_view landing; // where a flight from orbit ends
};

// Those of Earth and of Mars, by the name of the scene; the first of its own views for any other
// scene, without a flight.
trl_result bench_terrain_choose_views(const trl_scene *scene, struct bench_terrain_views *out);

// Frame `index` of `count` of the flight from 10 000 km down to the landing: the height falls by
// the same factor from frame to frame, and the sight rises from the nadir.
trl_view bench_terrain_flight(const struct bench_terrain_views *views, int index, int count);

#endif // CLI_BENCH_TERRAIN_H
