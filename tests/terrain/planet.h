// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_TERRAIN_PLANET_H
#define TESTS_TERRAIN_PLANET_H
// A small planet of elevations alone, by any mesher, and the truth about it.

#include "fixture.h"

#include "frame/mesh_check.h"
#include "frame/relief.h"

static const double PLANET_RADIUS_M = 1e6;

struct planet {
    struct fixture *f;
    struct relief relief; // its surface is the one that is drawn
    struct reference_surface truth;
    struct mesher *mesher;
};

typedef double planet_heights(double latitude_deg, double longitude_deg);

// `inset`, between 38 and 42 N, 28 and 32 E in texels of 350 m, may be NULL; the globe's texels are
// of half a degree, 8.7 km.
void planet_make(struct fixture *f, planet_heights *globe, planet_heights *inset,
                 struct planet *out);
// With relief that is made up below the texels.
void planet_make_detailed(struct fixture *f, planet_heights *globe, planet_heights *inset,
                          const struct surface_detail *detail, struct planet *out);
// False: this GL has not what the mesher needs.
bool planet_use(struct planet *planet, trl_mesher mesher);
void planet_destroy(struct planet *planet);

// `height_m` above the ground of the place.
struct camera planet_camera(const struct planet *planet, struct camera_place place,
                            double height_m);

// Checks a view, silhouettes and all, in pixels of `side` x `side`, each step-th of them.
struct mesh_error planet_check(const struct planet *planet, const struct camera *camera,
                               uint32_t side, uint32_t step);

#endif // TESTS_TERRAIN_PLANET_H
