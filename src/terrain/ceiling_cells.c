// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/ceiling_cells.h"

#include <math.h>
#include <string.h>

enum { SLOTS = 1 << 20, MAX_LEVEL = 26 };
// Neighbourhoods that are wider are asked for as they are.
static const double WIDEST_RAD = 0.1;

trl_result ceiling_cells_init(const trl_context *ctx, struct ceiling_cells *cells)
{
    cells->slots = mem_alloc(ctx, SLOTS, sizeof *cells->slots);
    return cells->slots ? TRL_OK : TRL_ERROR_MEMORY;
}

void ceiling_cells_finish(const trl_context *ctx, struct ceiling_cells *cells)
{
    mem_free(ctx, cells->slots);
    *cells = (struct ceiling_cells){.slots = NULL};
}

// A cell of a face. Faces go on a little beyond their borders, so that no neighbour is looked for.
struct cell {
    int face, level;
    int64_t column, row;
};

// The face's axis is the largest component; the others over it are u and v, within -1 and 1.
static void find_face(struct vec3 up, int *face, double uv[2])
{
    const double c[3] = {up.x, up.y, up.z};
    int axis = fabs(c[1]) > fabs(c[0]) ? 1 : 0;
    axis = fabs(c[2]) > fabs(c[axis]) ? 2 : axis;
    *face = 2 * axis + (c[axis] < 0);
    uv[0] = c[(axis + 1) % 3] / fabs(c[axis]);
    uv[1] = c[(axis + 2) % 3] / fabs(c[axis]);
}

static struct vec3 leave_face(int face, double u, double v)
{
    const int axis = face / 2;
    double c[3];
    c[axis] = face % 2 ? -1 : 1;
    c[(axis + 1) % 3] = u;
    c[(axis + 2) % 3] = v;
    return vec3_normalize((struct vec3){c[0], c[1], c[2]});
}

// Never 0.
static uint64_t name_cell(const struct cell *cell)
{
    const uint64_t column = (uint64_t)(cell->column + 8), row = (uint64_t)(cell->row + 8);
    return ((uint64_t)(cell->level + 1) << 59) | ((uint64_t)cell->face << 56) | (column << 28) |
           row;
}

// A finaliser of splitmix64 (Steele, Lea and Flood 2014).
static size_t find_slot(uint64_t name)
{
    name = (name ^ (name >> 30)) * 0xbf58476d1ce4e5b9u;
    name = (name ^ (name >> 27)) * 0x94d049bb133111ebu;
    return (size_t)((name ^ (name >> 31)) % SLOTS);
}

static double bound_cell(const struct ceiling_cells *cells, const struct cell *cell)
{
    const double side = ldexp(2, -cell->level);
    const double u = side * ((double)cell->column + 0.5) - 1;
    const double v = side * ((double)cell->row + 0.5) - 1;
    const struct vec3 middle = leave_face(cell->face, u, v);
    double chord = 0; // sides are parts of great circles: corners are the farthest
    for (int k = 0; k < 4; k++) {
        const struct vec3 corner =
            leave_face(cell->face, u + (k % 2 - 0.5) * side, v + (k / 2 - 0.5) * side);
        chord = fmax(chord, vec3_length(vec3_sub(corner, middle)));
    }
    return cells->bound(cells->user, middle, 2 * asin(fmin(1, chord / 2)));
}

static double ask_cell(const struct ceiling_cells *cells, const struct cell *cell)
{
    const uint64_t name = name_cell(cell);
    struct ceiling_slot *slot = &cells->slots[find_slot(name)];
    uint64_t bits = atomic_load_explicit(&slot->value, memory_order_relaxed);
    const uint64_t mixed = atomic_load_explicit(&slot->mixed, memory_order_relaxed);
    double value;
    if ((mixed ^ bits) == name) {
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    value = bound_cell(cells, cell);
    memcpy(&bits, &value, sizeof bits);
    atomic_store_explicit(&slot->value, bits, memory_order_relaxed);
    atomic_store_explicit(&slot->mixed, name ^ bits, memory_order_relaxed);
    return value;
}

struct neighbourhood {
    struct vec3 up;
    double angle_rad;
};

// The highest of the cells that it touches; the first that is not below `enough_m` will do.
static double ask_until(const struct ceiling_cells *cells, const struct neighbourhood *around,
                        double enough_m)
{
    const struct vec3 up = around->up;
    const double angle_rad = around->angle_rad;
    if (angle_rad > WIDEST_RAD) {
        return cells->bound(cells->user, up, angle_rad);
    }
    struct cell cell;
    double uv[2], reach[2];
    find_face(up, &cell.face, uv);
    // A place of the sphere with the largest component m lies at q / m on the face; one that is no
    // farther than the angle: |q'/m' - q/m| = |dq - (q/m) dm| / m'
    //                                      <= angle sqrt(1 + (q/m)^2) / (m - angle).
    const double m = 1 / sqrt(1 + uv[0] * uv[0] + uv[1] * uv[1]);
    for (int c = 0; c < 2; c++) {
        reach[c] = angle_rad * sqrt(1 + uv[c] * uv[c]) / (m - angle_rad);
    }
    // As wide as half the neighbourhood at the least.
    const double widest = fmax(fmax(reach[0], reach[1]), 1e-12);
    cell.level = (int)fmin(fmax(floor(1 - log2(widest)), 0), MAX_LEVEL);
    const double per_side = ldexp(0.5, cell.level);
    const int64_t first[2] = {(int64_t)floor((uv[0] - reach[0] + 1) * per_side),
                              (int64_t)floor((uv[1] - reach[1] + 1) * per_side)};
    const int64_t last[2] = {(int64_t)floor((uv[0] + reach[0] + 1) * per_side),
                             (int64_t)floor((uv[1] + reach[1] + 1) * per_side)};
    double highest = -INFINITY;
    for (cell.row = first[1]; cell.row <= last[1]; cell.row++) {
        for (cell.column = first[0]; cell.column <= last[0]; cell.column++) {
            highest = fmax(highest, ask_cell(cells, &cell));
            if (highest >= enough_m) {
                return highest;
            }
        }
    }
    return highest;
}

bool ceiling_cells_are_below(const struct ceiling_cells *cells, struct vec3 up, double angle_rad,
                             double altitude_m)
{
    return ask_until(cells, &(struct neighbourhood){up, angle_rad}, altitude_m) < altitude_m;
}

double ceiling_cells_ask(const struct ceiling_cells *cells, struct vec3 up, double angle_rad)
{
    return ask_until(cells, &(struct neighbourhood){up, angle_rad}, INFINITY);
}
