// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_QUADTREE_SIGHT_H
#define TERRAIN_QUADTREE_SIGHT_H
// What a camera can see of the quadtree's squares, and how far away they are.

#include "base/camera.h"
#include "terrain/quadtree_node.h"

struct quadtree_sight {
    const struct camera *camera;
    double radius_m;   // of the reference sphere
    double distance_m; // of the camera from the centre
    double solid_m;    // radius of a ball that is all below the ground that matters
    struct tiles_geo geo;
};

struct quadtree_sight quadtree_sight_make(const struct surface *surface,
                                          const struct camera *camera);

// Both stages of clipping: the horizon, and the four planes of the view. `margin` 1: all that may
// be seen is; more: balls around squares are larger by it.
bool quadtree_sight_shows(const struct quadtree_sight *sight, const struct quadtree_node *node,
                          double margin);

// From the camera to the nearest place of a square, l of Eq. 13: the viewpoint is mapped back to
// the flat domain, where the nearest place is easily found, and the distance is that in space.
double quadtree_sight_distance_m(const struct quadtree_sight *sight,
                                 const struct quadtree_node *node);

#endif // TERRAIN_QUADTREE_SIGHT_H
