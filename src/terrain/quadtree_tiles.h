// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_QUADTREE_TILES_H
#define TERRAIN_QUADTREE_TILES_H
// The tiles of Schafhitzel 2007, Section 5, as flat domains of quadtrees, and who borders on whom.
//
// Of its 24 x 12 tiles in longitude and latitude, the 24 x 8 between 60 degrees south and north are
// as in the paper: the face "band". Toward the poles columns would pinch, so the 24 x 2 around each
// pole are merged into a cap: a square of 6 x 6 tiles whose border has the same 24 sides. Squares
// around its middle are parallels; along them longitude grows evenly, as it does in the band.
//
//     north cap, seen from above      band              south cap, seen from below
//          side 2                     row 7 (60 N)           side 0 (60 S)
//     side 3    side 1                 ...              side 3    side 1
//          side 0 (60 N)              row 0 (60 S)           side 2
//
// In each face x grows to the east or counter-clockwise and y leads to the left of it, seen from
// outside.

#include "base/vec3.h"

#include <stdbool.h>
#include <stdint.h>

enum { TILES_BAND, TILES_NORTH, TILES_SOUTH, TILES_FACES };
enum {
    TILES_COLUMNS = 24,
    TILES_BAND_ROWS = 8,
    TILES_CAP_SIDE = 6,
    TILES_COUNT = TILES_COLUMNS * TILES_BAND_ROWS + 2 * TILES_CAP_SIDE * TILES_CAP_SIDE,
    TILES_MAX_LEVEL = 24 // of quadtrees: 0.1 m on the Earth
};

// A square of a quadtree: at level n a tile has 2^n x 2^n of them.
struct tiles_place {
    int32_t face, level;
    int64_t x, y; // from the face's lower left corner
};

// Squares of a face in each direction.
int64_t tiles_width(int32_t face, int32_t level);
int64_t tiles_height(int32_t face, int32_t level);

// The tile number `index` of TILES_COUNT, a square of level 0, and back.
struct tiles_place tiles_root(int32_t index);
int32_t tiles_root_index(const struct tiles_place *place);

// A quarter of a square: 0 and 1 lie below, 1 and 3 to the right.
struct tiles_place tiles_child(const struct tiles_place *place, int32_t quarter);

// The square of the same level next to one, dx and dy in -1, 0, 1. False: three tiles meet at the
// corners of a cap, and there is none across.
bool tiles_neighbour(const struct tiles_place *place, int32_t dx, int32_t dy,
                     struct tiles_place *out);

// A corner of squares, or a vertex of finer grids: in a face, a raster of `scale` steps a tile.
struct tiles_point {
    int32_t face;
    int64_t x, y;
};

// The same point as another face counts it, or with its longitude counted once around the band.
// False: it does not lie on that face.
bool tiles_point_on(const struct tiles_point *point, int64_t scale, int32_t face,
                    struct tiles_point *out);

// Where faces share a point, one name for it: in the band, from 0 to 24 tiles' steps less one.
struct tiles_point tiles_point_name(const struct tiles_point *point, int64_t scale);

// The spherical mapping: latitude and longitude of a place in a face, in tiles from its corner.
struct tiles_geo {
    double latitude_rad, longitude_rad;
};
struct tiles_geo tiles_geo_at(int32_t face, double u, double v);

// The inverse mapping, of any place on the sphere: beyond a face's border as that continues.
// Columns of the band are those nearest to `near_u`.
void tiles_map_back(int32_t face, struct tiles_geo geo, double near_u, double uv[2]);

// Side of a square of level 0, as an angle at the centre.
double tiles_side_rad(int32_t face);

#endif // TERRAIN_QUADTREE_TILES_H
