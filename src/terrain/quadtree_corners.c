// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/quadtree_corners.h"

#include <math.h>

// Of a hash table: a power of two, twice what all leaves' corners can be at most.
enum { SLOTS = 16384 };
_Static_assert((int)SLOTS >= 8 * (int)QUADTREE_MAX_LEAVES, "the table is never full");

struct corner {
    struct tiles_point point;
    bool is_used;
    double lod;
};

static uint64_t mix_bits(uint64_t h)
{
    h = (h ^ (h >> 31)) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
    return h ^ (h >> 32);
}

// Steps of the finest squares.
static const int64_t SCALE = (int64_t)1 << TILES_MAX_LEVEL;

static struct corner *find_corner(struct corner *table, const struct tiles_place *p, int64_t x,
                                  int64_t y)
{
    const int32_t up = TILES_MAX_LEVEL - p->level;
    const struct tiles_point here = {p->face, x << up, y << up};
    const struct tiles_point name = tiles_point_name(&here, SCALE);
    uint64_t slot =
        mix_bits((uint64_t)name.x ^ mix_bits((uint64_t)name.y * 4 + (uint64_t)name.face));
    for (;; slot++) {
        struct corner *c = &table[slot % SLOTS];
        if (!c->is_used) {
            *c = (struct corner){name, true, INFINITY};
            return c;
        }
        if (c->point.face == name.face && c->point.x == name.x && c->point.y == name.y) {
            return c;
        }
    }
}

// Where a coarser square's border runs past the middle of its side, two squares here meet, and
// there the level is what that border has. `side`: of QUADTREE_SIDES.
static void halve_side(struct corner *table, const struct tiles_place *p, int side)
{
    // The parent's side, in steps of this level.
    const int64_t x = p->x & ~(int64_t)1;
    const int64_t y = p->y & ~(int64_t)1;
    const bool is_along_y = side == QUADTREE_WEST || side == QUADTREE_EAST;
    const int64_t ax = side == QUADTREE_EAST ? x + 2 : x;
    const int64_t ay = side == QUADTREE_NORTH ? y + 2 : y;
    const int64_t dx = is_along_y ? 0 : 1;
    const int64_t dy = is_along_y ? 1 : 0;
    const double a = find_corner(table, p, ax, ay)->lod;
    const double b = find_corner(table, p, ax + 2 * dx, ay + 2 * dy)->lod;
    find_corner(table, p, ax + dx, ay + dy)->lod = 0.5 * (a + b);
}

static struct corner *leaf_corner(struct corner *table, const struct tiles_place *p, int which)
{
    return find_corner(table, p, p->x + which % 2, p->y + which / 2);
}

trl_result quadtree_corners_find(const struct quadtree_nodes *nodes, struct quadtree_leaves *leaves)
{
    struct corner *table = mem_alloc(nodes->ctx, SLOTS, sizeof *table);
    if (!table) {
        return TRL_ERROR_MEMORY;
    }
    for (uint32_t i = 0; i < leaves->count; i++) {
        const struct quadtree_node *n = &nodes->all[leaves->all[i].node];
        for (int k = 0; k < 4; k++) {
            struct corner *c = leaf_corner(table, &n->place, k);
            c->lod = fmin(c->lod, n->lod);
        }
    }
    // From coarse to fine: a border's ends are known before its middle.
    for (int32_t level = 1; level <= TILES_MAX_LEVEL; level++) {
        for (uint32_t i = 0; i < leaves->count; i++) {
            const struct quadtree_node *n = &nodes->all[leaves->all[i].node];
            for (int side = 0; side < QUADTREE_SIDES && n->place.level == level; side++) {
                if (leaves->all[i].is_coarser[side]) {
                    halve_side(table, &n->place, side);
                }
            }
        }
    }
    for (uint32_t i = 0; i < leaves->count; i++) {
        struct quadtree_leaf *leaf = &leaves->all[i];
        for (int k = 0; k < 4; k++) {
            leaf->lod[k] = leaf_corner(table, &nodes->all[leaf->node].place, k)->lod;
        }
    }
    mem_free(nodes->ctx, table);
    return TRL_OK;
}
