// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/quadtree_node.h"

#include "shared/shared.glsl"

#include <math.h>

// Enough for what is in view, the squares above it, and as much again of the way there.
enum { CAPACITY = 1 + TILES_COUNT + 4 * 4000 };
// A grid this much finer than the data shows nothing that floats could not lose.
static const double EXACT_TEXELS = 0.25;
// The ground leaves what was found of it by less than this times the error that was found.
static const double MARGIN_ERRORS = 2;
static const double MARGIN_M = 0.1;

static struct vec3 direction_at(const struct tiles_place *p, double i, double j)
{
    double uv[2];
    quadtree_vertex_uv(p, i, j, uv);
    const struct tiles_geo geo = tiles_geo_at(p->face, uv[0], uv[1]);
    return vec3_from_lat_lon(geo.latitude_rad, geo.longitude_rad);
}

static void place_node(const struct quadtree_nodes *nodes, struct quadtree_node *n,
                       struct tiles_place place, uint32_t parent)
{
    const double side = tiles_side_rad(place.face) * nodes->surface->radius_m;
    *n = (struct quadtree_node){.place = place,
                                .parent = parent,
                                .used = nodes->frame,
                                .cell_m = ldexp(side / QUADTREE_CELLS, -place.level)};
}

trl_result quadtree_nodes_init(const struct surface *surface, struct quadtree_nodes *out)
{
    *out = (struct quadtree_nodes){
        .ctx = surface->ctx, .surface = surface, .capacity = CAPACITY, .end = 1 + TILES_COUNT};
    out->all = mem_alloc(out->ctx, CAPACITY, sizeof *out->all);
    const trl_result result =
        out->all ? quadtree_heights_init(surface, &out->heights) : TRL_ERROR_MEMORY;
    if (result != TRL_OK) {
        quadtree_nodes_finish(out);
        return result;
    }
    for (int32_t i = 0; i < TILES_COUNT; i++) {
        place_node(out, &out->all[quadtree_root(i)], tiles_root(i), 0);
    }
    return TRL_OK;
}

void quadtree_nodes_finish(struct quadtree_nodes *nodes)
{
    quadtree_heights_finish(&nodes->heights);
    if (nodes->ctx) {
        mem_free(nodes->ctx, nodes->all);
    }
    *nodes = (struct quadtree_nodes){0};
}

// The block of four leaves that was looked at longest ago, and not in this frame; 0 when there is
// none. Nodes have few frames of life, so a look at all of them is rare.
static uint32_t find_oldest_block(const struct quadtree_nodes *nodes)
{
    uint32_t oldest = 0;
    uint32_t when = nodes->frame;
    for (uint32_t block = 1 + TILES_COUNT; block < nodes->end; block += 4) {
        uint32_t last = 0;
        bool is_free = true;
        for (uint32_t i = block; i < block + 4; i++) {
            is_free = is_free && nodes->all[i].children == 0;
            last = nodes->all[i].used > last ? nodes->all[i].used : last;
        }
        if (is_free && last < when) {
            when = last;
            oldest = block;
        }
    }
    return oldest;
}

bool quadtree_nodes_add_children(struct quadtree_nodes *nodes, uint32_t parent)
{
    uint32_t block = nodes->end;
    if (block + 4 <= nodes->capacity) {
        nodes->end += 4;
    } else {
        block = find_oldest_block(nodes);
        if (block == 0) {
            return false;
        }
        nodes->all[nodes->all[block].parent].children = 0;
    }
    for (int32_t quarter = 0; quarter < 4; quarter++) {
        place_node(nodes, &nodes->all[block + (uint32_t)quarter],
                   tiles_child(&nodes->all[parent].place, quarter), parent);
    }
    nodes->all[parent].children = block;
    return true;
}

// The node of a place, if it is ready.
static const struct quadtree_node *find_node(const struct quadtree_nodes *nodes,
                                             const struct tiles_place *place)
{
    const struct quadtree_node *n = &nodes->all[quadtree_root(tiles_root_index(place))];
    while (n->place.level < place->level) {
        const int32_t down = place->level - n->place.level - 1;
        if (n->children == 0) {
            return NULL;
        }
        n = &nodes->all[n->children +
                        (uint32_t)((place->x >> down & 1) + 2 * (place->y >> down & 1))];
    }
    return n->is_ready ? n : NULL;
}

// Takes the heights of a neighbour at the border that both share. Floats that count from two
// anchors are not the same to the last digit, and from nearby it would show.
static void copy_border(const struct quadtree_node *from, struct quadtree_node *to)
{
    const int64_t scale = (int64_t)QUADTREE_CELLS << to->place.level;
    const int64_t around = TILES_COLUMNS * scale;
    for (int32_t k = 0; k < QUADTREE_VERTICES; k++) {
        const int32_t i = k % QUADTREE_SIDE;
        const int32_t j = k / QUADTREE_SIDE;
        if (i % QUADTREE_CELLS != 0 && j % QUADTREE_CELLS != 0) {
            continue;
        }
        const struct tiles_point mine = {to->place.face, to->place.x * QUADTREE_CELLS + i,
                                         to->place.y * QUADTREE_CELLS + j};
        struct tiles_point theirs;
        if (!tiles_point_on(&mine, scale, from->place.face, &theirs)) {
            continue;
        }
        int64_t x = theirs.x - from->place.x * QUADTREE_CELLS;
        const int64_t y = theirs.y - from->place.y * QUADTREE_CELLS;
        x += from->place.face == TILES_BAND && x < 0 ? around : 0;
        if (x >= 0 && x <= QUADTREE_CELLS && y >= 0 && y <= QUADTREE_CELLS) {
            to->heights_m[k] = from->heights_m[y * QUADTREE_SIDE + x];
        }
    }
}

static void match_borders(const struct quadtree_nodes *nodes, struct quadtree_node *n)
{
    for (int32_t k = 0; k < 9; k++) {
        struct tiles_place place;
        if (k == 4 || !tiles_neighbour(&n->place, k % 3 - 1, k / 3 - 1, &place)) {
            continue;
        }
        const struct quadtree_node *other = find_node(nodes, &place);
        if (other) {
            copy_border(other, n);
        }
    }
}

// How far the grid is from the ground, as found at the middles of its cells, and from the sphere's
// curve: a chord of length c lies c^2 / 8R below its arc.
static void find_error(struct quadtree_node *n, const double *middles, double radius_m)
{
    double error = 0;
    double low = INFINITY;
    double high = -INFINITY;
    for (int32_t k = 0; k < QUADTREE_CELLS * QUADTREE_CELLS; k++) {
        const double *corner =
            n->heights_m + k / QUADTREE_CELLS * QUADTREE_SIDE + k % QUADTREE_CELLS;
        const double flat = 0.5 * (corner[0] + corner[QUADTREE_SIDE + 1]);
        error = fmax(error, fabs(middles[k] - flat));
        low = fmin(low, middles[k]);
        high = fmax(high, middles[k]);
    }
    for (int32_t k = 0; k < QUADTREE_VERTICES; k++) {
        low = fmin(low, n->heights_m[k]);
        high = fmax(high, n->heights_m[k]);
    }
    const double sagitta = 2 * n->cell_m * n->cell_m / (8 * radius_m);
    n->error_m = error + sagitta;
    n->low_m = low - MARGIN_ERRORS * error - MARGIN_M - sagitta;
    n->high_m = high + MARGIN_ERRORS * error + MARGIN_M;
}

static double middle_m(const struct quadtree_node *n)
{
    return 0.5 * (n->low_m + n->high_m);
}

static void bound_node(struct quadtree_node *n, double radius_m)
{
    enum { STEPS = 4 };
    const double middle = QUADTREE_CELLS / 2.0;
    n->up = direction_at(&n->place, middle, middle);
    n->origin_m = vec3_scale(n->up, radius_m + middle_m(n));
    double chord = 0;
    double distance = 0;
    for (int32_t k = 0; k < (STEPS + 1) * (STEPS + 1); k++) {
        const struct vec3 d =
            direction_at(&n->place, (double)QUADTREE_CELLS / STEPS * (k % (STEPS + 1)),
                         (double)QUADTREE_CELLS / STEPS * (k / (STEPS + 1)));
        chord = fmax(chord, vec3_length(vec3_sub(d, n->up)));
        for (int side = 0; side < 2; side++) {
            const struct vec3 at = vec3_scale(d, radius_m + (side ? n->high_m : n->low_m));
            distance = fmax(distance, vec3_length(vec3_sub(at, n->origin_m)));
        }
    }
    // Borders bend between the samples.
    n->angle_rad = 1.02 * 2 * asin(fmin(1, chord / 2));
    n->radius_m = 1.02 * distance;
}

// A square's corners are less than its side away from its middle.
static struct surface_eye eye_of(const struct tiles_place *place)
{
    const double side = ldexp(tiles_side_rad(place->face), -place->level);
    return (struct surface_eye){.up =
                                    direction_at(place, QUADTREE_CELLS / 2.0, QUADTREE_CELLS / 2.0),
                                .reach_rad = side,
                                .height_rad = side / QUADTREE_CELLS};
}

static double find_finest(const struct surface *surface, const struct surface_eye *eye)
{
    const struct surface_selection seen = surface_select(surface, eye);
    double finest = tiles_side_rad(TILES_BAND);
    for (size_t i = 0; i < seen.counts[SURFACE_ELEVATION]; i++) {
        const size_t index = seen.indices[SURFACE_ELEVATION][i];
        const struct terrain_layer *layer = &surface->layers[SURFACE_ELEVATION][index];
        finest = fmin(finest, layer_finest_frame(layer)->texel_height);
    }
    finest *= surface->radius_m;
    return noise_is_there(&surface->noise) ? fmin(finest, noise_shortest_m(&surface->noise) / 4)
                                           : finest;
}

static trl_result make_batch(struct quadtree_nodes *nodes, const uint32_t *indices, size_t count,
                             struct quadtree_sample *samples)
{
    for (size_t i = 0; i < count; i++) {
        struct quadtree_node *n = &nodes->all[indices[i]];
        const struct surface_eye eye = eye_of(&n->place);
        const struct quadtree_node *parent = n->parent != 0 ? &nodes->all[n->parent] : NULL;
        n->finest_m = find_finest(nodes->surface, &eye);
        samples[i] = (struct quadtree_sample){.place = &n->place,
                                              .eye = eye,
                                              .is_exact = n->cell_m < EXACT_TEXELS * n->finest_m,
                                              .datum_m = parent ? middle_m(parent) : 0,
                                              .cell_m = n->cell_m,
                                              .vertices = n->heights_m};
    }
    const trl_result result = quadtree_heights_sample(&nodes->heights, samples, count);
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        struct quadtree_node *n = &nodes->all[indices[i]];
        match_borders(nodes, n);
        find_error(n, samples[i].middles, nodes->surface->radius_m);
        bound_node(n, nodes->surface->radius_m);
        n->is_ready = true;
        n->serial = ++nodes->made;
    }
    return result;
}

trl_result quadtree_nodes_make(struct quadtree_nodes *nodes, const uint32_t *indices, size_t count)
{
    struct quadtree_sample *samples = mem_alloc(nodes->ctx, QUADTREE_BATCH, sizeof *samples);
    if (!samples) {
        return TRL_ERROR_MEMORY;
    }
    uint32_t batch[QUADTREE_BATCH];
    trl_result result = TRL_OK;
    for (size_t i = 0; i < count && result == TRL_OK;) {
        size_t size = 0;
        for (; i < count && size < QUADTREE_BATCH; i++) {
            if (!nodes->all[indices[i]].is_ready) {
                batch[size++] = indices[i];
            }
        }
        result = size > 0 ? make_batch(nodes, batch, size, samples) : TRL_OK;
    }
    mem_free(nodes->ctx, samples);
    return result;
}

void quadtree_nodes_follow_surface(struct quadtree_nodes *nodes)
{
    const uint64_t revision = surface_revision(nodes->surface);
    if (revision == nodes->revision) {
        return;
    }
    for (uint32_t i = 1; i < nodes->end; i++) {
        struct quadtree_node *n = &nodes->all[i];
        n->is_ready = n->is_ready &&
                      !surface_has_changed(nodes->surface, nodes->revision, n->up, n->angle_rad);
    }
    // Vertices also tell of the grids of two ancestors.
    for (uint32_t i = 1; i < nodes->end; i++) {
        struct quadtree_node *n = &nodes->all[i];
        const struct quadtree_node *parent = &nodes->all[n->parent];
        const bool is_old =
            n->parent != 0 &&
            (!parent->is_ready || (parent->parent != 0 && !nodes->all[parent->parent].is_ready));
        n->serial = is_old && n->is_ready ? ++nodes->made : n->serial;
    }
    nodes->revision = revision;
}

// A part of an ancestor's grid that covers a node.
struct patch {
    struct vec3 at[QUADTREE_VERTICES]; // from the node's origin, (cells + 1)^2 of them
    double altitude_m[QUADTREE_VERTICES];
    int32_t cells;
};

static void fill_patch(const struct quadtree_nodes *nodes, const struct quadtree_node *node,
                       const struct quadtree_node *ancestor, struct patch *patch)
{
    const int32_t up = node->place.level - ancestor->place.level;
    const int32_t x = (int32_t)((node->place.x - (ancestor->place.x << up)) * QUADTREE_CELLS) >> up;
    const int32_t y = (int32_t)((node->place.y - (ancestor->place.y << up)) * QUADTREE_CELLS) >> up;
    patch->cells = QUADTREE_CELLS >> up;
    const int32_t side = patch->cells + 1;
    for (int32_t k = 0; k < side * side; k++) {
        const int32_t i = x + k % side;
        const int32_t j = y + k / side;
        const double altitude = ancestor->heights_m[j * QUADTREE_SIDE + i];
        const struct vec3 at =
            vec3_scale(direction_at(&ancestor->place, i, j), nodes->surface->radius_m + altitude);
        patch->at[k] = vec3_sub(at, node->origin_m);
        patch->altitude_m[k] = altitude;
    }
}

// On the ancestor's triangles, whose diagonals run from a cell's first corner.
static void put_vertex(const struct patch *patch, int32_t i, int32_t j, float out[4])
{
    const int32_t step = QUADTREE_CELLS / patch->cells;
    const int32_t side = patch->cells + 1;
    const double fx = (double)(i % step) / step;
    const double fy = (double)(j % step) / step;
    const int32_t a = j / step * side + i / step;
    const int32_t b = fx > fy ? a + 1 : fy > 0 ? a + side : a;
    const int32_t c = fmin(fx, fy) > 0 ? a + side + 1 : a;
    const double wb = fabs(fx - fy);
    const double wc = fmin(fx, fy);
    const double wa = 1 - wb - wc;
    const struct vec3 p =
        vec3_add(vec3_scale(patch->at[a], wa),
                 vec3_add(vec3_scale(patch->at[b], wb), vec3_scale(patch->at[c], wc)));
    out[0] = (float)p.x;
    out[1] = (float)p.y;
    out[2] = (float)p.z;
    out[3] =
        (float)(patch->altitude_m[a] * wa + patch->altitude_m[b] * wb + patch->altitude_m[c] * wc);
}

void quadtree_node_vertices(const struct quadtree_nodes *nodes, uint32_t index,
                            float out[QUADTREE_SIDE][QUADTREE_GRIDS][QUADTREE_SIDE][4])
{
    const struct quadtree_node *node = &nodes->all[index];
    const struct quadtree_node *ancestor = node;
    struct patch patch;
    for (int32_t grid = 0; grid < QUADTREE_GRIDS; grid++) {
        if (grid == 0 || ancestor->parent != 0) {
            ancestor = grid == 0 ? node : &nodes->all[ancestor->parent];
            fill_patch(nodes, node, ancestor, &patch);
        }
        for (int32_t k = 0; k < QUADTREE_VERTICES; k++) {
            const int32_t i = k % QUADTREE_SIDE;
            const int32_t j = k / QUADTREE_SIDE;
            put_vertex(&patch, i, j, out[j][grid][i]);
        }
    }
}
