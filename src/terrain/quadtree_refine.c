// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/quadtree_refine.h"

#include "terrain/quadtree_corners.h"
#include "terrain/quadtree_sight.h"

#include <math.h>

// C of Eq. 13: a square is no longer than its distance, whatever the ground is like.
static const double MIN_RESOLUTION = 1;
// But that ends where its cells are smaller than this part of the data's.
static const double SMALLEST_TEXELS = 0.25;
// A square is split in full when it is nearer than its range by this power of two, and the range of
// a square is smaller than its parent's by at least as much; so one morphs after the other.
static const double MORPH_OCTAVES = 0.5;
// Squares in view or nearly, of which about two thirds are drawn. Where more would be needed, the
// tolerance grows by a power of how many times more: as it falls, their number grows like this on
// rough ground. The number changes little from frame to frame, and so does the tolerance.
static const double BUDGET = 1650;
static const double BUDGET_POWER = 1.2;
// Of the tolerance, when there are more squares than can be.
static const double RELIEF = 1.25;
// Squares outside of the view are chosen, too, when balls as much larger would be seen: when they
// come into view, the levels at corners have been theirs for some time.
static const double NEAR_VIEW = 2;
// No nearer than this, so that the number of levels has an end.
static const double MIN_DISTANCE_M = 1e-3;

enum { LIST_MAX = 4 * QUADTREE_MAX_LEAVES };

struct list {
    uint32_t count;
    uint32_t nodes[LIST_MAX];
};

struct refinement {
    struct quadtree_nodes *nodes;
    struct quadtree_sight sight;
    double tolerance_rad;
    bool is_too_much;
    struct list front, next; // squares of a level; squares to be made
};

static bool is_split(const struct refinement *r, const struct quadtree_node *n)
{
    return n->split_frame == r->nodes->frame;
}

static void put(struct refinement *r, struct list *list, uint32_t node)
{
    if (list->count < LIST_MAX) {
        list->nodes[list->count++] = node;
    } else {
        r->is_too_much = true;
    }
}

// How much nearer than its range a node is, in octaves; its children are wanted above 0.
static double find_octaves(const struct refinement *r, const struct quadtree_node *n)
{
    double distance = quadtree_sight_distance_m(&r->sight, n);
    distance = fmax(distance, MIN_DISTANCE_M);
    return log2(n->range_m / distance);
}

// Eq. 13 with f = 1, solved for the distance l: C d max(c d2, 1), and with d2 = max |dh| / d and
// c = 1 / (C tolerance) that is the larger of C d and max |dh| / tolerance. Here dh is the
// difference from the ground itself and not from the next level only.
static double find_range(const struct refinement *r, const struct quadtree_node *n)
{
    const double side = n->cell_m * QUADTREE_CELLS;
    const double flat = n->cell_m > SMALLEST_TEXELS * n->finest_m ? MIN_RESOLUTION * side : 0;
    const double rough = n->error_m / r->tolerance_rad;
    double range = fmax(flat, rough);
    if (n->parent != 0) {
        range = fmin(range, r->nodes->all[n->parent].range_m * exp2(-MORPH_OCTAVES));
    }
    return n->place.level < TILES_MAX_LEVEL ? range : 0;
}

// What a frame has to know of a square that is ready.
static void enter(struct refinement *r, uint32_t index, double lod)
{
    struct quadtree_node *n = &r->nodes->all[index];
    n->is_near = quadtree_sight_shows(&r->sight, n, NEAR_VIEW);
    n->range_m = find_range(r, n);
    n->lod = lod;
}

// Marks a square as split and lists those children that are to be made.
static bool split(struct refinement *r, uint32_t index, struct list *unmade)
{
    struct quadtree_node *n = &r->nodes->all[index];
    n->used = r->nodes->frame;
    if (n->children == 0 && !quadtree_nodes_add_children(r->nodes, index)) {
        r->is_too_much = true;
        return false;
    }
    n->split_frame = r->nodes->frame;
    for (uint32_t i = 0; i < 4; i++) {
        r->nodes->all[n->children + i].used = r->nodes->frame;
        put(r, unmade, n->children + i);
    }
    return true;
}

static trl_result enter_roots(struct refinement *r)
{
    r->next.count = 0;
    for (int32_t i = 0; i < TILES_COUNT; i++) {
        put(r, &r->next, quadtree_root(i));
    }
    const trl_result result = quadtree_nodes_make(r->nodes, r->next.nodes, r->next.count);
    r->front.count = 0;
    for (uint32_t i = 0; i < r->next.count && result == TRL_OK; i++) {
        enter(r, r->next.nodes[i], 0);
        if (r->nodes->all[r->next.nodes[i]].is_near) {
            put(r, &r->front, r->next.nodes[i]);
        }
    }
    return result;
}

// Splits the squares of a level as they need it.
static trl_result refine_level(struct refinement *r)
{
    r->next.count = 0;
    for (uint32_t i = 0; i < r->front.count && !r->is_too_much; i++) {
        const struct quadtree_node *n = &r->nodes->all[r->front.nodes[i]];
        if (find_octaves(r, n) > 0) {
            split(r, r->front.nodes[i], &r->next);
        }
    }
    const trl_result result = quadtree_nodes_make(r->nodes, r->next.nodes, r->next.count);
    r->front.count = 0;
    for (uint32_t i = 0; i < r->next.count && result == TRL_OK; i++) {
        const struct quadtree_node *parent = &r->nodes->all[r->nodes->all[r->next.nodes[i]].parent];
        const double morph = fmin(1, find_octaves(r, parent) / MORPH_OCTAVES);
        enter(r, r->next.nodes[i], parent->lod + morph);
        if (r->nodes->all[r->next.nodes[i]].is_near) {
            put(r, &r->front, r->next.nodes[i]);
        }
    }
    return result;
}

// The leaf that covers a place, or the square there whose children are leaves.
static uint32_t find_leaf(const struct refinement *r, const struct tiles_place *place)
{
    uint32_t index = quadtree_root(tiles_root_index(place));
    const struct quadtree_node *n = &r->nodes->all[index];
    while (is_split(r, n) && n->place.level < place->level) {
        const int32_t down = place->level - n->place.level - 1;
        index = n->children + (uint32_t)((place->x >> down & 1) + 2 * (place->y >> down & 1));
        n = &r->nodes->all[index];
    }
    return index;
}

static void list_leaves(struct refinement *r, struct list *out)
{
    uint32_t stack[4 * TILES_MAX_LEVEL];
    out->count = 0;
    for (int32_t tile = 0; tile < TILES_COUNT; tile++) {
        uint32_t depth = 0;
        stack[depth++] = quadtree_root(tile);
        while (depth > 0) {
            const uint32_t index = stack[--depth];
            const struct quadtree_node *n = &r->nodes->all[index];
            if (!n->is_near) {
                continue;
            }
            if (!is_split(r, n)) {
                put(r, out, index);
            }
            for (uint32_t i = 0; i < 4 && is_split(r, n); i++) {
                stack[depth++] = n->children + i;
            }
        }
    }
}

// Raises the square next to a leaf to a level less than one below it; true when that changes it.
// Where its own grid is too coarse for that, it is listed to be split, as it stands: children that
// nothing raises further show the same surface.
static bool raise(struct refinement *r, uint32_t index, const struct quadtree_node *leaf)
{
    struct quadtree_node *n = &r->nodes->all[index];
    if (!n->is_near || is_split(r, n)) {
        return false;
    }
    const double wanted = fmin(leaf->lod - 1, n->place.level);
    const bool is_raised = wanted > n->lod + 1e-9;
    n->lod = fmax(n->lod, wanted);
    if (leaf->lod - 1 > n->place.level + 1e-9 || leaf->place.level > n->place.level + 1) {
        n->lod = n->place.level;
        split(r, index, &r->next);
        return true;
    }
    return is_raised;
}

// Until neighbours differ by no more than one level, in squares and in continuous levels.
static trl_result balance(struct refinement *r)
{
    trl_result result = TRL_OK;
    bool is_changed = true;
    while (is_changed && result == TRL_OK && !r->is_too_much) {
        is_changed = false;
        list_leaves(r, &r->front);
        r->next.count = 0;
        for (uint32_t i = 0; i < r->front.count; i++) {
            const struct quadtree_node *leaf = &r->nodes->all[r->front.nodes[i]];
            for (int32_t k = 0; k < 9; k++) {
                struct tiles_place place;
                if (k != 4 && tiles_neighbour(&leaf->place, k % 3 - 1, k / 3 - 1, &place)) {
                    is_changed = raise(r, find_leaf(r, &place), leaf) || is_changed;
                }
            }
        }
        result = quadtree_nodes_make(r->nodes, r->next.nodes, r->next.count);
        for (uint32_t i = 0; i < r->next.count && result == TRL_OK; i++) {
            const uint32_t index = r->next.nodes[i];
            enter(r, index, r->nodes->all[r->nodes->all[index].parent].lod);
        }
    }
    return result;
}

static void take_leaves(struct refinement *r, struct quadtree_leaves *out)
{
    static const int32_t DX[QUADTREE_SIDES] = {-1, 1, 0, 0};
    static const int32_t DY[QUADTREE_SIDES] = {0, 0, -1, 1};
    out->count = 0;
    out->nearest_m = INFINITY;
    for (uint32_t i = 0; i < r->front.count; i++) {
        struct quadtree_node *n = &r->nodes->all[r->front.nodes[i]];
        struct quadtree_leaf *leaf = &out->all[out->count++];
        *leaf = (struct quadtree_leaf){.node = r->front.nodes[i]};
        out->nearest_m = fmin(out->nearest_m, quadtree_sight_distance_m(&r->sight, n));
        for (int side = 0; side < QUADTREE_SIDES; side++) {
            struct tiles_place place;
            if (tiles_neighbour(&n->place, DX[side], DY[side], &place)) {
                const struct quadtree_node *beyond = &r->nodes->all[find_leaf(r, &place)];
                leaf->is_coarser[side] = beyond->is_near && beyond->place.level < n->place.level;
            }
        }
    }
}

static void drop_unseen(const struct refinement *r, struct quadtree_leaves *leaves)
{
    uint32_t seen = 0;
    for (uint32_t i = 0; i < leaves->count; i++) {
        if (quadtree_sight_shows(&r->sight, &r->nodes->all[leaves->all[i].node], 1)) {
            leaves->all[seen++] = leaves->all[i];
        }
    }
    leaves->count = seen;
}

static trl_result refine_once(struct refinement *r)
{
    r->is_too_much = false;
    r->nodes->frame++;
    trl_result result = enter_roots(r);
    while (r->front.count > 0 && result == TRL_OK && !r->is_too_much) {
        result = refine_level(r);
    }
    if (result == TRL_OK) {
        result = balance(r);
    }
    if (result == TRL_OK) {
        list_leaves(r, &r->front);
        r->is_too_much = r->is_too_much || r->front.count > QUADTREE_MAX_LEAVES;
    }
    return result;
}

static trl_result refine_as_can_be(struct refinement *r)
{
    trl_result result = refine_once(r);
    while (result == TRL_OK && r->is_too_much) {
        r->tolerance_rad *= RELIEF;
        result = refine_once(r);
    }
    return result;
}

trl_result quadtree_refine(struct quadtree_nodes *nodes, const struct camera *camera,
                           double tolerance_rad, struct quadtree_leaves *out)
{
    struct refinement *r = mem_alloc(nodes->ctx, 1, sizeof *r);
    if (!r) {
        return TRL_ERROR_MEMORY;
    }
    *r = (struct refinement){.nodes = nodes,
                             .sight = quadtree_sight_make(nodes->surface, camera),
                             .tolerance_rad = tolerance_rad};
    quadtree_nodes_follow_surface(nodes);
    trl_result result = refine_as_can_be(r);
    const double excess = r->front.count / BUDGET;
    if (result == TRL_OK && excess > 1) {
        r->tolerance_rad *= pow(excess, BUDGET_POWER);
        result = refine_as_can_be(r);
    }
    if (result == TRL_OK) {
        take_leaves(r, out);
        result = quadtree_corners_find(nodes, out);
        drop_unseen(r, out);
    }
    mem_free(nodes->ctx, r);
    return result;
}
