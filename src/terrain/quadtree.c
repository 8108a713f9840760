// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The quadtree mesher, Schafhitzel 2007, Section 5: tiles over the sphere, each a quadtree, refined
// where the viewpoint is near and the ground is rough, morphed between levels, clipped as whole
// tiles and then down the tree. Squares of the tree are grids, and all of a frame are one draw.
// Resources: u_vertices, RGBA32F, 32 x 32 slots of a square each, three grids side by side.
#include "terrain/mesher.h"

#include "gpu/mesh.h"
#include "gpu/pass.h"
#include "terrain/depth.h"
#include "terrain/quadtree_refine.h"

#include <math.h>
#include <stddef.h>

enum {
    SLOTS_X = 32,
    SLOTS = QUADTREE_MAX_LEAVES,
    SLOT_WIDTH = QUADTREE_GRIDS * QUADTREE_SIDE,
    SLOT_HEIGHT = QUADTREE_SIDE,
    BORDER = 4 * QUADTREE_SIDE,
    VERTICES = QUADTREE_VERTICES + 2 * BORDER, // of the grid, and the curtain's upper and lower
    MESHES = 4 // of every vertex, every second, every fourth, every eighth
};
// Neighbours agree at their borders but for the last digit of a float. A curtain, this part of the
// distance long, fills the gaps that this leaves between pixels. It is drawn at infinite distance,
// so that nothing of it is seen but there.
static const double CURTAIN = 2e-3;

struct place { // of a vertex: column and row; 1 or 2 at a curtain's upper or lower end
    int16_t x, y, depth, none;
};

struct instance {
    float origin_m[3]; // relative to the camera
    float down_m[3];   // a curtain's depth
    float lod[4];      // above the grid of the parent's parent
    float slot[2];     // texels
    uint8_t is_coarser[4];
};

struct slot {
    uint32_t node, serial; // serial 0: empty
    uint32_t used;         // frame
};

struct quadtree {
    struct mesher base;
    struct gpu *gpu;
    struct camera camera;
    struct quadtree_nodes nodes;
    struct quadtree_leaves leaves;
    struct gpu_texture vertices;
    struct gpu_program program;
    struct gpu_mesh meshes[MESHES];
    struct slot slots[SLOTS];
    uint32_t oldest; // slot to look at next for one to take
    struct instance instances[QUADTREE_MAX_LEAVES];
};

static uint32_t *put_quad(uint32_t *to, const uint32_t corners[4])
{
    static const int ORDER[6] = {0, 1, 2, 0, 2, 3};
    for (int i = 0; i < 6; i++) {
        *to++ = corners[ORDER[i]];
    }
    return to;
}

// Vertex number `k` along a border, counter-clockwise around the grid.
static uint32_t border_vertex(int side, uint32_t k)
{
    const uint32_t last = QUADTREE_CELLS;
    const uint32_t x[4] = {k, last, last - k, 0};
    const uint32_t y[4] = {0, k, last, last - k};
    return y[side] * QUADTREE_SIDE + x[side];
}

// Of the grid, which is first, and of the curtain.
static uint32_t count_grid_indices(uint32_t step)
{
    return 6 * (QUADTREE_CELLS / step) * (QUADTREE_CELLS / step);
}

static uint32_t count_curtain_indices(uint32_t step)
{
    return 6 * 4 * (QUADTREE_CELLS / step);
}

static void put_indices(uint32_t step, uint32_t *to)
{
    for (uint32_t y = 0; y < QUADTREE_CELLS; y += step) {
        for (uint32_t x = 0; x < QUADTREE_CELLS; x += step) {
            const uint32_t a = y * QUADTREE_SIDE + x;
            const uint32_t d = a + step * QUADTREE_SIDE;
            to = put_quad(to, (const uint32_t[4]){a, a + step, d + step, d});
        }
    }
    for (int side = 0; side < 4; side++) {
        const uint32_t high = QUADTREE_VERTICES + (uint32_t)side * QUADTREE_SIDE;
        const uint32_t low = high + BORDER;
        for (uint32_t k = 0; k < QUADTREE_CELLS; k += step) {
            to = put_quad(to,
                          (const uint32_t[4]){low + k, low + k + step, high + k + step, high + k});
        }
    }
}

static void put_places(struct place *to)
{
    for (uint32_t k = 0; k < QUADTREE_VERTICES; k++) {
        to[k] = (struct place){(int16_t)(k % QUADTREE_SIDE), (int16_t)(k / QUADTREE_SIDE), 0, 0};
    }
    for (uint32_t k = 0; k < BORDER; k++) {
        struct place top = to[border_vertex((int)(k / QUADTREE_SIDE), k % QUADTREE_SIDE)];
        top.depth = 1;
        to[QUADTREE_VERTICES + k] = top;
        top.depth = 2;
        to[QUADTREE_VERTICES + BORDER + k] = top;
    }
}

static trl_result make_mesh(struct quadtree *q, uint32_t step, struct gpu_mesh *out)
{
    struct place places[VERTICES];
    uint32_t indices[6 * (QUADTREE_CELLS * QUADTREE_CELLS + 4 * QUADTREE_CELLS)];
    put_places(places);
    put_indices(step, indices);
#define OFFSET(member) (uint32_t) offsetof(struct instance, member)
    const struct gpu_mesh_desc desc = {
        .label = "quadtree",
        .primitive = GPU_PRIMITIVE_TRIANGLES,
        .vertex_count = VERTICES,
        .vertex_stride = sizeof(struct place),
        .vertices = places,
        .index_count = count_grid_indices(step) + count_curtain_indices(step),
        .indices = indices,
        .instance_stride = sizeof(struct instance),
        .attribute_count = 6,
        .attributes = {{0, 3, GPU_COMPONENT_INT16, 0, false},
                       {1, 3, GPU_COMPONENT_FLOAT, OFFSET(origin_m), true},
                       {2, 3, GPU_COMPONENT_FLOAT, OFFSET(down_m), true},
                       {3, 4, GPU_COMPONENT_FLOAT, OFFSET(lod), true},
                       {4, 2, GPU_COMPONENT_FLOAT, OFFSET(slot), true},
                       {5, 4, GPU_COMPONENT_UNORM8, OFFSET(is_coarser), true}}};
#undef OFFSET
    return gpu_mesh_init(q->gpu, &desc, out);
}

static trl_result make_vertices(struct quadtree *q)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "quadtree vertices";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = SLOTS_X * SLOT_WIDTH;
    desc.height = SLOTS / SLOTS_X * SLOT_HEIGHT;
    return gpu_texture_init(q->gpu, &desc, &q->vertices);
}

static bool holds(const struct quadtree *q, uint32_t slot, uint32_t node)
{
    return q->slots[slot].node == node && q->slots[slot].serial == q->nodes.all[node].serial;
}

// A slot that this frame does not show: there are as many as squares at most. Around the clock.
static uint32_t take_slot(struct quadtree *q)
{
    while (q->slots[q->oldest].used == q->nodes.frame) {
        q->oldest = (q->oldest + 1) % SLOTS;
    }
    const uint32_t slot = q->oldest;
    q->oldest = (q->oldest + 1) % SLOTS;
    return slot;
}

static trl_result fill_slot(struct quadtree *q, uint32_t slot, uint32_t node)
{
    float texels[QUADTREE_SIDE][QUADTREE_GRIDS][QUADTREE_SIDE][4];
    quadtree_node_vertices(&q->nodes, node, texels);
    const struct gpu_region region = {.x = slot % SLOTS_X * SLOT_WIDTH,
                                      .y = slot / SLOTS_X * SLOT_HEIGHT,
                                      .width = SLOT_WIDTH,
                                      .height = SLOT_HEIGHT,
                                      .depth = 1};
    q->slots[slot] = (struct slot){node, q->nodes.all[node].serial, q->nodes.frame};
    q->nodes.all[node].slot = slot;
    return gpu_texture_upload(&q->vertices, &region, texels);
}

// Squares that are still there are marked first, so that none of them is overwritten.
static trl_result fill_slots(struct quadtree *q)
{
    for (uint32_t i = 0; i < q->leaves.count; i++) {
        const uint32_t node = q->leaves.all[i].node;
        const uint32_t slot = q->nodes.all[node].slot;
        if (holds(q, slot, node)) {
            q->slots[slot].used = q->nodes.frame;
        }
    }
    trl_result result = TRL_OK;
    for (uint32_t i = 0; i < q->leaves.count && result == TRL_OK; i++) {
        const uint32_t node = q->leaves.all[i].node;
        if (!holds(q, q->nodes.all[node].slot, node)) {
            result = fill_slot(q, take_slot(q), node);
        }
    }
    return result;
}

static void put_instance(const struct quadtree *q, const struct quadtree_leaf *leaf,
                         struct instance *to)
{
    const struct quadtree_node *n = &q->nodes.all[leaf->node];
    const struct vec3 origin = vec3_sub(n->origin_m, q->camera.position_m);
    const double depth = CURTAIN * (vec3_length(origin) + n->radius_m);
    const struct vec3 down = vec3_scale(n->up, -depth);
    *to = (struct instance){.origin_m = {(float)origin.x, (float)origin.y, (float)origin.z},
                            .down_m = {(float)down.x, (float)down.y, (float)down.z},
                            .slot = {(float)(n->slot % SLOTS_X * SLOT_WIDTH),
                                     (float)(n->slot / SLOTS_X * SLOT_HEIGHT)}};
    for (int k = 0; k < 4; k++) {
        const double lod = leaf->lod[k] - (n->place.level - 2);
        to->lod[k] = (float)fmax(0, fmin(2, lod));
        to->is_coarser[k] = leaf->is_coarser[k] ? 255 : 0;
    }
}

// From afar all squares are whole tiles, and fewer of their vertices are enough: errors grow with
// the square of a cell's size at most.
static int find_level(const struct quadtree *q, double tolerance_rad)
{
    static const double SHARE = 0.1; // a change that nobody sees
    double error_m = 0;
    for (uint32_t i = 0; i < q->leaves.count; i++) {
        const struct quadtree_node *n = &q->nodes.all[q->leaves.all[i].node];
        if (n->place.level > 0) {
            return 0;
        }
        error_m = fmax(error_m, n->error_m);
    }
    int level = 0;
    while (level + 1 < MESHES &&
           error_m * ldexp(1, 2 * (level + 1)) < SHARE * tolerance_rad * q->leaves.nearest_m) {
        level++;
    }
    return level;
}

static void set_camera(struct quadtree *q)
{
    const struct camera *c = &q->camera;
    const struct vec3 rows[3] = {vec3_scale(c->right, 1 / c->tan_half_fov_x),
                                 vec3_scale(c->up, 1 / c->tan_half_fov_y), c->forward};
    float view[9];
    for (int i = 0; i < 3; i++) {
        view[i] = (float)rows[i].x;
        view[3 + i] = (float)rows[i].y;
        view[6 + i] = (float)rows[i].z;
    }
    gpu_program_set_mat3(&q->program, "u_view", view);
    gpu_program_set_texture(&q->program, "u_vertices", &q->vertices);
}

static trl_result update(struct mesher *base, const struct camera *camera)
{
    ((struct quadtree *)base)->camera = *camera;
    return TRL_OK;
}

// Those that a range may show go first; how many they are.
static uint32_t put_instances(struct quadtree *q, const struct depth_range *range)
{
    uint32_t count = 0;
    uint32_t inside = 0;
    for (int is_outside = 0; is_outside < 2; is_outside++) {
        for (uint32_t i = 0; i < q->leaves.count; i++) {
            const struct quadtree_node *n = &q->nodes.all[q->leaves.all[i].node];
            const double along =
                vec3_dot(q->camera.forward, vec3_sub(n->origin_m, q->camera.position_m));
            if (depth_range_holds(range, along, n->radius_m) == (is_outside == 0)) {
                put_instance(q, &q->leaves.all[i], &q->instances[count++]);
            }
        }
        inside = is_outside ? inside : count;
    }
    return inside;
}

// The first range has all squares, and their curtains: these stand behind all ground, also that of
// a nearer range. The last one has what reaches into it.
static trl_result draw_leaves(struct quadtree *q, int level, const struct gpu_target *target)
{
    struct gpu_mesh *mesh = &q->meshes[level];
    const struct depth_ranges ranges = depth_ranges_make(q->nodes.surface, &q->camera);
    const uint32_t near = put_instances(q, &ranges.of[ranges.count - 1]);
    struct mesher_stats *stats = &q->base.stats;
    stats->triangles = stats->draws = 0;
    stats->chunks = q->leaves.count;
    stats->projections = q->nodes.made;
    set_camera(q);
    trl_result result = q->leaves.count > 0
                            ? gpu_mesh_update_instances(mesh, q->instances, q->leaves.count)
                            : TRL_OK;
    for (int i = 0; i < ranges.count && result == TRL_OK; i++) {
        const struct gpu_draw_range all = {0, mesh->index_count, q->leaves.count};
        const struct gpu_draw_range some = {0, count_grid_indices(1u << level), near};
        const struct gpu_draw_range range = i == 0 ? all : some;
        depth_range_begin(&ranges, i, target, GPU_CULL_BACK);
        depth_range_bind(&ranges.of[i], &q->program);
        result = gpu_draw_mesh_range(&q->program, mesh, range, "terrain mesh");
        stats->triangles += range.count / 3 * range.instances;
        stats->draws += range.instances > 0;
    }
    return result;
}

// Squares are chosen here and not when the camera moves: only the target knows what a pixel is.
static trl_result draw(struct mesher *base, const struct gpu_target *target)
{
    struct quadtree *q = (struct quadtree *)base;
    // A pixel's side; where pixels are not square, the root of its area.
    const double pixel_rad = 2 * sqrt(q->camera.tan_half_fov_x / target->width *
                                      q->camera.tan_half_fov_y / target->height);
    const double error_px = base->error_px > 0 ? base->error_px : MESHER_ERROR_PX;
    const double tolerance_rad = error_px * pixel_rad;
    trl_result result = quadtree_refine(&q->nodes, &q->camera, tolerance_rad, &q->leaves);
    if (result == TRL_OK) {
        result = fill_slots(q);
    }
    return result == TRL_OK ? draw_leaves(q, find_level(q, tolerance_rad), target) : result;
}

static void destroy(struct mesher *base)
{
    struct quadtree *q = (struct quadtree *)base;
    for (int i = 0; i < MESHES; i++) {
        gpu_mesh_finish(&q->meshes[i]);
    }
    gpu_program_finish(&q->program);
    gpu_texture_finish(&q->vertices);
    quadtree_nodes_finish(&q->nodes);
    mem_free(q->gpu->ctx, q);
}

trl_result quadtree_create(const struct surface *surface, struct mesher **out)
{
    static const struct mesher_ops OPS = {update, draw, destroy};
    struct quadtree *q = mem_alloc(surface->gpu->ctx, 1, sizeof *q);
    *out = NULL;
    if (!q) {
        return TRL_ERROR_MEMORY;
    }
    q->base.ops = &OPS;
    q->gpu = surface->gpu;
    trl_result result = quadtree_nodes_init(surface, &q->nodes);
    result = result == TRL_OK ? make_vertices(q) : result;
    if (result == TRL_OK) {
        const struct gpu_program_desc program = {.vertex = "terrain/quadtree.vert",
                                                 .fragment = "terrain/mesh.frag"};
        result = gpu_program_init(q->gpu, &program, &q->program);
    }
    for (uint32_t i = 0; i < MESHES && result == TRL_OK; i++) {
        result = make_mesh(q, 1u << i, &q->meshes[i]);
    }
    if (result != TRL_OK) {
        destroy(&q->base);
        return result;
    }
    q->base.stats.bytes = sizeof *q + (uint64_t)q->nodes.capacity * sizeof(struct quadtree_node) +
                          (uint64_t)q->vertices.width * q->vertices.height * sizeof(float[4]) +
                          q->nodes.heights.bytes;
    *out = &q->base;
    return TRL_OK;
}
