// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/quadtree_tiles.h"

#include "shared/shared.glsl"

#include <math.h>

static const double TILE_RAD = 2 * SHARED_PI / TILES_COLUMNS;
static const double CAP_RAD = SHARED_PI / 6;     // from the pole to its border
static const double QUARTER_RAD = SHARED_PI / 2; // a side of the cap
static const int64_t CAP_HALF = TILES_CAP_SIDE / 2;

int64_t tiles_width(int32_t face, int32_t level)
{
    return (int64_t)(face == TILES_BAND ? TILES_COLUMNS : TILES_CAP_SIDE) << level;
}

int64_t tiles_height(int32_t face, int32_t level)
{
    return (int64_t)(face == TILES_BAND ? TILES_BAND_ROWS : TILES_CAP_SIDE) << level;
}

struct tiles_place tiles_root(int32_t index)
{
    int32_t face = TILES_BAND;
    while (index >= tiles_width(face, 0) * tiles_height(face, 0)) {
        index -= (int32_t)(tiles_width(face, 0) * tiles_height(face, 0));
        face++;
    }
    const int64_t width = tiles_width(face, 0);
    return (struct tiles_place){face, 0, index % width, index / width};
}

int32_t tiles_root_index(const struct tiles_place *p)
{
    int64_t first = 0;
    for (int32_t face = TILES_BAND; face < p->face; face++) {
        first += tiles_width(face, 0) * tiles_height(face, 0);
    }
    return (int32_t)(first + (p->y >> p->level) * tiles_width(p->face, 0) + (p->x >> p->level));
}

struct tiles_place tiles_child(const struct tiles_place *p, int32_t quarter)
{
    return (struct tiles_place){p->face, p->level + 1, 2 * p->x + quarter % 2,
                                2 * p->y + quarter / 2};
}

static int64_t wrap(int64_t x, int64_t width)
{
    return x < 0 ? x + width : x >= width ? x - width : x;
}

// Square number `along` of the cap's border, counted along the band, `side` squares to a side.
static struct tiles_place enter_cap(int32_t face, int32_t level, int64_t along)
{
    const int64_t side = tiles_width(face, level);
    const int64_t q = along % side;
    const int64_t last = side - 1;
    const int64_t x[4] = {q, last, last - q, 0};
    const int64_t y[4] = {0, q, last, last - q};
    const int64_t which = along / side;
    return (struct tiles_place){face, level, x[which],
                                face == TILES_SOUTH ? last - y[which] : y[which]};
}

static bool leave_cap(const struct tiles_place *p, int64_t x, int64_t y, struct tiles_place *out)
{
    const int64_t side = tiles_width(p->face, p->level);
    const bool is_x_out = x < 0 || x >= side;
    const bool is_y_out = y < 0 || y >= side;
    if (is_x_out && is_y_out) {
        return false;
    }
    const int64_t t = p->face == TILES_SOUTH ? side - 1 - y : y; // as the north cap counts
    const int64_t along = t < 0       ? x
                          : x >= side ? side + t
                          : t >= side ? 2 * side + side - 1 - x
                                      : 3 * side + side - 1 - t;
    const int64_t row = p->face == TILES_SOUTH ? 0 : tiles_height(TILES_BAND, p->level) - 1;
    *out = (struct tiles_place){TILES_BAND, p->level, along, row};
    return true;
}

bool tiles_neighbour(const struct tiles_place *p, int32_t dx, int32_t dy, struct tiles_place *out)
{
    int64_t x = p->x + dx;
    const int64_t y = p->y + dy;
    const int64_t width = tiles_width(p->face, p->level);
    const int64_t height = tiles_height(p->face, p->level);
    if (p->face == TILES_BAND) {
        x = wrap(x, width);
        if (y < 0 || y >= height) {
            *out = enter_cap(y < 0 ? TILES_SOUTH : TILES_NORTH, p->level, x);
            return true;
        }
    } else if (x < 0 || y < 0 || x >= width || y >= height) {
        return leave_cap(p, x, y, out);
    }
    *out = (struct tiles_place){p->face, p->level, x, y};
    return true;
}

// Steps along the cap's border, from its first corner, of a point that lies on it; else -1.
static int64_t find_along(const struct tiles_point *p, int64_t scale)
{
    const int64_t side = TILES_CAP_SIDE * scale;
    const int64_t y = p->face == TILES_SOUTH ? side - p->y : p->y;
    return y == 0         ? p->x
           : p->x == side ? side + y
           : y == side    ? 2 * side + side - p->x
           : p->x == 0    ? 3 * side + side - y
                          : -1;
}

static struct tiles_point point_on_cap(int32_t face, int64_t along, int64_t scale)
{
    const int64_t side = TILES_CAP_SIDE * scale;
    const int64_t q = along % side;
    const int64_t x[4] = {q, side, side - q, 0};
    const int64_t y[4] = {0, q, side, side - q};
    const int64_t which = along / side;
    return (struct tiles_point){face, x[which], face == TILES_SOUTH ? side - y[which] : y[which]};
}

bool tiles_point_on(const struct tiles_point *p, int64_t scale, int32_t face,
                    struct tiles_point *out)
{
    *out = *p;
    const int64_t around = TILES_COLUMNS * scale;
    const int64_t top = TILES_BAND_ROWS * scale;
    if (p->face != TILES_BAND && face == p->face) {
        return true;
    }
    struct tiles_point band = *p;
    if (p->face != TILES_BAND) {
        const int64_t along = find_along(p, scale);
        if (along < 0) {
            return false;
        }
        band = (struct tiles_point){TILES_BAND, along, p->face == TILES_SOUTH ? 0 : top};
    }
    band.x = wrap(band.x, around);
    *out = band;
    if (face == TILES_BAND) {
        return true;
    }
    if (band.y != (face == TILES_SOUTH ? 0 : top)) {
        return false;
    }
    *out = point_on_cap(face, band.x, scale);
    return true;
}

struct tiles_point tiles_point_name(const struct tiles_point *p, int64_t scale)
{
    struct tiles_point name;
    return tiles_point_on(p, scale, TILES_BAND, &name) ? name : *p;
}

struct tiles_geo tiles_geo_at(int32_t face, double u, double v)
{
    if (face == TILES_BAND) {
        return (struct tiles_geo){(v - TILES_BAND_ROWS / 2.0) * TILE_RAD, u * TILE_RAD - SHARED_PI};
    }
    const double s = u / (double)CAP_HALF - 1;
    const double t = face == TILES_SOUTH ? 1 - v / (double)CAP_HALF : v / (double)CAP_HALF - 1;
    const double ring = fmax(fabs(s), fabs(t));
    double turns = 0; // sides of the square, from its first corner
    if (ring > 0) {
        turns = t == -ring  ? (s / ring + 1) / 2
                : s == ring ? 1 + (t / ring + 1) / 2
                : t == ring ? 2 + (1 - s / ring) / 2
                            : 3 + (1 - t / ring) / 2;
    }
    const double latitude = SHARED_PI / 2 - ring * CAP_RAD;
    return (struct tiles_geo){face == TILES_SOUTH ? -latitude : latitude,
                              turns * QUARTER_RAD - SHARED_PI};
}

void tiles_map_back(int32_t face, struct tiles_geo geo, double near_u, double uv[2])
{
    double u = (geo.longitude_rad + SHARED_PI) / TILE_RAD;
    if (face == TILES_BAND) {
        u -= TILES_COLUMNS * floor((u - near_u) / TILES_COLUMNS + 0.5);
        uv[0] = u;
        uv[1] = geo.latitude_rad / TILE_RAD + TILES_BAND_ROWS / 2.0;
        return;
    }
    u -= TILES_COLUMNS * floor(u / TILES_COLUMNS);
    const double latitude = face == TILES_SOUTH ? -geo.latitude_rad : geo.latitude_rad;
    const double ring = (SHARED_PI / 2 - latitude) / CAP_RAD;
    const int side = (int)fmin(u / TILES_CAP_SIDE, 3);
    const double q = ring * (2 * (u / TILES_CAP_SIDE - side) - 1);
    const double s[4] = {q, ring, -q, -ring};
    const double t[4] = {-ring, q, ring, -q};
    uv[0] = (double)CAP_HALF * (s[side] + 1);
    uv[1] = (double)CAP_HALF * (face == TILES_SOUTH ? 1 - t[side] : t[side] + 1);
}

double tiles_side_rad(int32_t face)
{
    return face == TILES_BAND ? TILE_RAD : CAP_RAD / (double)CAP_HALF;
}
