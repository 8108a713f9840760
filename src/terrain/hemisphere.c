// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The hemisphere mesher, Michelic 2019, Section 3: a square grid seen from the planet's centre,
// facing the camera, that reaches the highest mountain beyond the horizon. It differs from the
// paper in three ways. Rings of the grid are drawn toward the camera's ground point, so that cells
// have one size as seen from there, which takes the place of tessellation. Vertices are made once
// for a projection camera, by a fragment pass into a texture (resources: u_positions, RGBA32F,
// cells + 1 to a side), since vertex shaders are slow in software. The frustum and the horizon cull
// chunks of the grid on the CPU.
#include "terrain/mesher.h"

#include "gpu/mesh.h"
#include "gpu/pass.h"
#include "shared/hemisphere.glsl"
#include "terrain/depth.h"
#include "terrain/height_programs.h"
#include "terrain/projection.h"

#include <math.h>

// HEMISPHERE_CELLS to a side of the grid in chunks of CHUNK_CELLS: a sixth of it, as much as a view
// of 60 degrees along the ground sees, is 570 thousand triangles.
enum { CHUNK_CELLS = TRL_HEMISPHERE_STEP };
// Where no ground is in view the grid is made anew after this part of the way that the camera may
// go, so that it need not change when ground is. That is found with rays through the picture's
// lower border, in steps that grow, above the ground by a part of the way.
static const double UNSEEN_MOVE = 0.2, RAY_STEP = 1.2, RAY_MARGIN = 0.02;
enum { RAYS = 8 };
// The higher the camera, the more of the grid is in view at once, and the smaller it is there:
// above these parts of the radius every second and every fourth vertex is enough.
enum { MESHES = 3 };
// With tessellation: 100 x 100 patches, as in the paper, in draws of at most 64, beyond which a
// software rasteriser collapses. Edges are divided until a part is as long as CELL_PIXELS of a
// picture of PIXEL_ROWS rows.
enum {
    PATCH_CELLS = 8,
    CHUNK_PATCHES = (CHUNK_CELLS / PATCH_CELLS) * (CHUNK_CELLS / PATCH_CELLS),
    DRAW_CHUNKS = 64 / CHUNK_PATCHES
};
static const double CELL_PIXELS = 4;
static const double PIXEL_ROWS = 576;
static const double COARSER_ABOVE[MESHES] = {0, 0.05, 0.5};

// What must be in view for a chunk to be drawn.
struct chunk {
    struct vec3 direction; // unit, of its middle
    double angle_rad;      // its farthest vertex from there
    double max_altitude_m;
    struct vec3 centre_m; // of a ball around it
    double radius_m;
};

struct hemisphere {
    struct mesher base;
    struct gpu *gpu;
    const struct surface *surface;
    struct projection projection;
    HemisphereRings rings;
    double base_m;  // altitude from which positions count, above the anchor; a float
    uint32_t level; // of `meshes`
    struct camera camera;
    uint32_t cells;       // to a side of the grid
    uint32_t chunk_row;   // chunks to a side
    uint32_t chunk_count; // all of them
    struct chunk *chunks; // owned
    struct gpu_texture positions;
    struct gpu_target target;
    struct height_programs grid_programs;
    struct gpu_program mesh_program;
    struct gpu_mesh meshes[MESHES]; // of every vertex, every second, every fourth
    bool is_tessellated;
    struct gpu_mesh patches; // only then, and no `meshes`
};

// The vertices of a cell's two triangles: of the grid of `cells`, from (x, y), `step` wide.
struct cell {
    uint32_t cells, x, y, step;
};
static void put_cell(uint32_t *indices, const struct cell *cell)
{
    const uint32_t side = cell->cells + 1, half = cell->cells / 2;
    const uint32_t a = cell->y * side + cell->x;
    const uint32_t b = a + cell->step;
    const uint32_t d = a + cell->step * side;
    const uint32_t c = d + cell->step;
    // The diagonal runs away from the middle, so that all quadrants look alike.
    const bool is_rising = (cell->x < half) == (cell->y < half);
    const uint32_t rising[6] = {a, b, c, a, c, d};
    const uint32_t falling[6] = {a, b, d, b, c, d};
    for (int i = 0; i < 6; i++) {
        indices[i] = is_rising ? rising[i] : falling[i];
    }
}

static uint32_t chunk_indices(uint32_t step)
{
    return (CHUNK_CELLS / step) * (CHUNK_CELLS / step) * 6;
}

// Indices, chunk after chunk, of every `step`-th vertex.
static trl_result make_mesh(struct hemisphere *h, uint32_t step, struct gpu_mesh *out)
{
    const uint32_t count = h->chunk_count * chunk_indices(step);
    uint32_t *indices = mem_alloc(h->gpu->ctx, count, sizeof *indices);
    if (!indices) {
        return TRL_ERROR_MEMORY;
    }
    uint32_t *to = indices;
    for (uint32_t chunk = 0; chunk < h->chunk_count; chunk++) {
        const uint32_t x0 = chunk % h->chunk_row * CHUNK_CELLS;
        const uint32_t y0 = chunk / h->chunk_row * CHUNK_CELLS;
        for (uint32_t y = y0; y < y0 + CHUNK_CELLS; y += step) {
            for (uint32_t x = x0; x < x0 + CHUNK_CELLS; x += step, to += 6) {
                put_cell(to, &(struct cell){h->cells, x, y, step});
            }
        }
    }
    const struct gpu_mesh_desc desc = {.label = "hemisphere",
                                       .primitive = GPU_PRIMITIVE_TRIANGLES,
                                       .vertex_count = (h->cells + 1) * (h->cells + 1),
                                       .index_count = count,
                                       .indices = indices};
    const trl_result result = gpu_mesh_init(h->gpu, &desc, out);
    mem_free(h->gpu->ctx, indices);
    return result;
}

static trl_result make_patches(struct hemisphere *h)
{
    const uint32_t side = h->cells + 1, patches = h->chunk_count * CHUNK_PATCHES;
    uint32_t *indices = mem_alloc(h->gpu->ctx, (size_t)patches * 4, sizeof *indices);
    if (!indices) {
        return TRL_ERROR_MEMORY;
    }
    uint32_t *to = indices;
    for (uint32_t i = 0; i < patches; i++, to += 4) {
        const uint32_t chunk = i / CHUNK_PATCHES, part = i % CHUNK_PATCHES;
        const uint32_t row = CHUNK_CELLS / PATCH_CELLS;
        const uint32_t x = chunk % h->chunk_row * CHUNK_CELLS + part % row * PATCH_CELLS;
        const uint32_t y = chunk / h->chunk_row * CHUNK_CELLS + part / row * PATCH_CELLS;
        to[0] = y * side + x;
        to[1] = to[0] + PATCH_CELLS;
        to[2] = to[1] + PATCH_CELLS * side;
        to[3] = to[0] + PATCH_CELLS * side;
    }
    const struct gpu_mesh_desc desc = {.label = "hemisphere patches",
                                       .primitive = GPU_PRIMITIVE_PATCHES,
                                       .patch_vertices = 4,
                                       .vertex_count = side * side,
                                       .index_count = patches * 4,
                                       .indices = indices};
    const trl_result result = gpu_mesh_init(h->gpu, &desc, &h->patches);
    mem_free(h->gpu->ctx, indices);
    return result;
}

static trl_result make_programs(struct hemisphere *h)
{
    struct gpu_program_desc mesh = {.vertex = "terrain/mesh.vert", .fragment = "terrain/mesh.frag"};
    if (h->is_tessellated) {
        mesh.vertex = "terrain/patch.vert";
        mesh.tess_control = "terrain/patch.tesc";
        mesh.tess_evaluate = "terrain/patch.tese";
    }
    const trl_result result =
        height_programs_init(h->surface, "terrain/grid.frag", &h->grid_programs);
    return result == TRL_OK ? gpu_program_init(h->gpu, &mesh, &h->mesh_program) : result;
}

static trl_result make_target(struct hemisphere *h)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "hemisphere vertices";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = desc.height = h->cells + 1;
    trl_result result = gpu_texture_init(h->gpu, &desc, &h->positions);
    if (result == TRL_OK) {
        const struct gpu_target_desc target = {.label = "hemisphere vertices",
                                               .color_count = 1,
                                               .colors = {{.texture = &h->positions}}};
        result = gpu_target_init(h->gpu, &target, &h->target);
    }
    return result;
}

static struct vec3 grid_direction(const struct hemisphere *h, double x, double y)
{
    const LocalDirection d = hemisphere_direction(2 * x / h->cells - 1, 2 * y / h->cells - 1,
                                                  h->rings, h->projection.lift);
    return (struct vec3){d.x, d.y, d.z + 1};
}

// A ball around the shell between two radii and within an angle of an axis: its middle lies on the
// axis, and one of the shell's corners or poles is the farthest.
static void bound_chunk(struct chunk *c, double low_m, double high_m)
{
    const double cosine = cos(c->angle_rad);
    const double sine = sin(c->angle_rad);
    const double middle = (low_m * cosine + high_m) / 2;
    const double top = hypot(high_m * cosine - middle, high_m * sine);
    const double bottom = hypot(low_m * cosine - middle, low_m * sine);
    c->radius_m = fmax(fmax(top, bottom), high_m - middle);
    c->centre_m = vec3_scale(c->direction, middle);
}

static void place_chunk(struct hemisphere *h, uint32_t index)
{
    enum { STEPS = 4 };
    const double x0 = index % h->chunk_row * (double)CHUNK_CELLS;
    const double y0 = index / h->chunk_row * (double)CHUNK_CELLS;
    const struct vec3 middle = grid_direction(h, x0 + CHUNK_CELLS / 2.0, y0 + CHUNK_CELLS / 2.0);
    double chord = 0;
    for (int i = 0; i < (STEPS + 1) * (STEPS + 1); i++) {
        const double x = x0 + i % (STEPS + 1) * (double)CHUNK_CELLS / STEPS;
        const double y = y0 + i / (STEPS + 1) * (double)CHUNK_CELLS / STEPS;
        chord = fmax(chord, vec3_length(vec3_sub(grid_direction(h, x, y), middle)));
    }
    struct chunk *c = &h->chunks[index];
    c->direction = anchor_planet(&h->projection.anchor, middle);
    // Rings are squares from the centre and bend between the samples: 2 % more is ample.
    c->angle_rad = 1.02 * 2 * asin(fmin(1, chord / 2));
    const struct surface_bounds b = surface_bounds_around(h->surface, c->direction, c->angle_rad);
    c->max_altitude_m = (double)b.max;
    bound_chunk(c, h->surface->radius_m + (double)b.min, h->surface->radius_m + (double)b.max);
}

static trl_result draw_grid(struct hemisphere *h)
{
    const float grid[2] = {(float)h->cells, (float)h->projection.lift};
    const float rings[2] = {(float)h->rings.inner, (float)h->rings.power};
    float planet_from_local[9];
    struct anchor anchor = h->projection.anchor;
    anchor.datum_m = h->base_m;
    anchor_planet_from_local(&anchor, planet_from_local);
    const struct surface_eye eye = projection_eye(&h->projection, h->surface, 0);
    struct gpu_program *program = height_programs_bind(&h->grid_programs, &eye, &anchor);
    gpu_program_set_vec2(program, "u_grid", grid);
    gpu_program_set_vec2(program, "u_rings", rings);
    gpu_program_set_mat3(program, "u_planet_from_local", planet_from_local);
    const struct gpu_pass pass = {.target = &h->target};
    gpu_pass_begin(h->gpu, &pass);
    return gpu_draw_fullscreen(program, "terrain heights");
}

// Rings of one factor from where nothing nearer needs smaller cells. A camera that is far nearer to
// the ground than that, for the data are coarse there, has smaller cells below it all the same, and
// begins at twice the distance: flat ones would cut through the ground that it nearly touches.
static HemisphereRings find_rings(const struct hemisphere *h)
{
    const struct projection *p = &h->projection;
    const double power = 1 + fmax(0, fmin(1, 0.5 * log2(p->near_m / p->height_m)));
    // As grid coordinate: the apex of Eq. 2 is 1 above z_s.
    const double apex = fmax(1 + p->lift, 0.1);
    const double near = fmin(power * p->near_m / h->surface->radius_m * apex, 1);
    // ln near = power (inner - 1) / inner
    return (HemisphereRings){power / (power - log(near)), power};
}

// Whether a ray passes over the ground, as far as it is held, by a little.
static bool is_above_ground(const struct hemisphere *h, struct vec3 ray)
{
    const double radius_m = h->surface->radius_m;
    const double far = 2 * radius_m * h->projection.reach_rad + h->projection.height_m;
    bool is_above = true;
    for (double way = h->projection.height_m / 2; way < far && is_above; way *= RAY_STEP) {
        const struct vec3 at = vec3_add(h->camera.position_m, vec3_scale(ray, way));
        const double altitude = vec3_length(at) - radius_m;
        is_above = altitude > h->projection.max_altitude_m ||
                   altitude > surface_altitude_of_held(h->surface, at) + RAY_MARGIN * way;
    }
    return is_above;
}

// Section 3: while the camera sees no ground, as in the sky, nobody sees the grid change. Ground
// anywhere in a picture that is upright stands on its lower border.
static bool is_unseen(const struct hemisphere *h)
{
    const struct camera *c = &h->camera;
    bool is_above = vec3_dot(c->up, h->projection.anchor.up) > 0;
    for (int i = 0; i <= RAYS && is_above; i++) {
        const double x = (2.0 * i / RAYS - 1) * c->tan_half_fov_x;
        const struct vec3 aside =
            vec3_sub(vec3_scale(c->right, x), vec3_scale(c->up, c->tan_half_fov_y));
        is_above = is_above_ground(h, vec3_normalize(vec3_add(c->forward, aside)));
    }
    return is_above;
}

static bool is_due(const struct hemisphere *h)
{
    return projection_is_stale(&h->projection, h->surface, 0, &h->camera) ||
           (projection_moved(&h->projection, &h->camera) > UNSEEN_MOVE && is_unseen(h));
}

static trl_result update(struct mesher *base, const struct camera *camera)
{
    struct hemisphere *h = (struct hemisphere *)base;
    h->camera = *camera;
    if (!is_due(h)) {
        return TRL_OK;
    }
    h->projection = projection_make(h->surface, camera);
    h->base_m = (double)(float)surface_altitude(h->surface, camera->position_m);
    h->rings = find_rings(h);
    h->level = 0;
    while (h->level + 1 < MESHES &&
           h->projection.height_m > COARSER_ABOVE[h->level + 1] * h->surface->radius_m) {
        h->level++;
    }
    for (uint32_t i = 0; i < h->chunk_count; i++) {
        place_chunk(h, i);
    }
    h->base.stats.projections++;
    return draw_grid(h);
}

static bool is_in_frustum(const struct camera *camera, const struct chunk *c)
{
    const struct vec3 v = vec3_sub(c->centre_m, camera->position_m);
    const double z = vec3_dot(camera->forward, v);
    const double x = fabs(vec3_dot(camera->right, v));
    const double y = fabs(vec3_dot(camera->up, v));
    const double tx = camera->tan_half_fov_x;
    const double ty = camera->tan_half_fov_y;
    return z > -c->radius_m && x - z * tx <= c->radius_m * sqrt(1 + tx * tx) &&
           y - z * ty <= c->radius_m * sqrt(1 + ty * ty);
}

static bool is_above_horizon(const struct hemisphere *h, const struct chunk *c)
{
    const double distance = vec3_length(h->camera.position_m);
    const double cosine = vec3_dot(h->camera.position_m, c->direction) / distance;
    const double away = acos(fmax(-1, fmin(1, cosine))) - c->angle_rad;
    const double solid = h->projection.solid_m;
    const double peak = h->surface->radius_m + c->max_altitude_m;
    return away <= acos(fmin(1, solid / distance)) + acos(fmin(1, solid / fmax(peak, solid)));
}

static void set_camera(struct hemisphere *h)
{
    const struct camera *c = &h->camera;
    const struct vec3 ground =
        vec3_scale(h->projection.anchor.up, h->surface->radius_m + h->base_m);
    const struct vec3 offset = vec3_sub(ground, c->position_m);
    const struct vec3 rows[3] = {vec3_scale(c->right, 1 / c->tan_half_fov_x),
                                 vec3_scale(c->up, 1 / c->tan_half_fov_y), c->forward};
    float view[9];
    for (int i = 0; i < 3; i++) {
        view[i] = (float)rows[i].x;
        view[3 + i] = (float)rows[i].y;
        view[6 + i] = (float)rows[i].z;
    }
    const float camera_offset[3] = {(float)offset.x, (float)offset.y, (float)offset.z};
    gpu_program_set_vec3(&h->mesh_program, "u_camera_offset", camera_offset);
    gpu_program_set_mat3(&h->mesh_program, "u_view", view);
    const double tx = c->tan_half_fov_x, ty = c->tan_half_fov_y;
    const float edge[4] = {(float)(CELL_PIXELS * 2 * ty / PIXEL_ROWS), PATCH_CELLS,
                           (float)(sqrt(1 + tx * tx) / tx), (float)(sqrt(1 + ty * ty) / ty)};
    gpu_program_set_vec4(&h->mesh_program, "u_edge", edge);
    gpu_program_set_texture(&h->mesh_program, "u_positions", &h->positions);
}

static bool is_visible(const struct hemisphere *h, uint32_t chunk, const struct depth_range *range)
{
    const struct chunk *c = &h->chunks[chunk];
    const double along = vec3_dot(h->camera.forward, vec3_sub(c->centre_m, h->camera.position_m));
    return depth_range_holds(range, along, c->radius_m) && is_in_frustum(&h->camera, c) &&
           is_above_horizon(h, c);
}

static trl_result draw_run(struct hemisphere *h, uint32_t first, uint32_t count)
{
    const struct gpu_mesh *mesh = &h->meshes[h->level];
    const uint32_t size = chunk_indices(1u << h->level);
    const struct gpu_draw_range range = {first * size, count * size, 1};
    h->base.stats.triangles += range.count / 3;
    h->base.stats.chunks += count;
    h->base.stats.draws++;
    return gpu_draw_mesh_range(&h->mesh_program, mesh, range, "terrain mesh");
}

// Counts two triangles a patch: how many the GPU makes of it is not known here.
static trl_result draw_patches(struct hemisphere *h, uint32_t first, uint32_t count)
{
    enum { SIZE = CHUNK_PATCHES * 4 };
    trl_result result = TRL_OK;
    for (uint32_t at = first; at < first + count && result == TRL_OK; at += DRAW_CHUNKS) {
        const uint32_t left = first + count - at;
        const uint32_t chunks = left < DRAW_CHUNKS ? left : DRAW_CHUNKS;
        const struct gpu_draw_range range = {at * SIZE, chunks * SIZE, 1};
        h->base.stats.triangles += 2 * chunks * CHUNK_PATCHES;
        h->base.stats.chunks += chunks;
        h->base.stats.draws++;
        result = gpu_draw_mesh_range(&h->mesh_program, &h->patches, range, "terrain patches");
    }
    return result;
}

static trl_result draw_range(struct hemisphere *h, const struct depth_range *range)
{
    depth_range_bind(range, &h->mesh_program);
    trl_result result = TRL_OK;
    for (uint32_t i = 0; i < h->chunk_count && result == TRL_OK; i++) {
        const uint32_t first = i;
        while (i < h->chunk_count && is_visible(h, i, range)) {
            i++;
        }
        if (i > first) {
            result = h->is_tessellated ? draw_patches(h, first, i - first)
                                       : draw_run(h, first, i - first);
        }
    }
    return result;
}

static trl_result draw(struct mesher *base, const struct gpu_target *target)
{
    struct hemisphere *h = (struct hemisphere *)base;
    const struct depth_ranges ranges = depth_ranges_make(h->surface, &h->camera);
    struct mesher_stats *stats = &h->base.stats;
    stats->triangles = stats->draws = stats->chunks = 0;
    set_camera(h);
    trl_result result = TRL_OK;
    for (int i = 0; i < ranges.count && result == TRL_OK; i++) {
        depth_range_begin(&ranges, i, target, GPU_CULL_BACK);
        result = draw_range(h, &ranges.of[i]);
    }
    return result;
}

static void destroy(struct mesher *base)
{
    struct hemisphere *h = (struct hemisphere *)base;
    for (int i = 0; i < MESHES; i++) {
        gpu_mesh_finish(&h->meshes[i]);
    }
    gpu_mesh_finish(&h->patches);
    height_programs_finish(&h->grid_programs);
    gpu_program_finish(&h->mesh_program);
    gpu_target_finish(&h->target);
    gpu_texture_finish(&h->positions);
    mem_free(h->gpu->ctx, h->chunks);
    mem_free(h->gpu->ctx, h);
}

static trl_result make_parts(struct hemisphere *h)
{
    h->chunks = mem_alloc(h->gpu->ctx, h->chunk_count, sizeof *h->chunks);
    trl_result result = h->chunks ? make_target(h) : TRL_ERROR_MEMORY;
    result = result == TRL_OK ? make_programs(h) : result;
    if (h->is_tessellated && result == TRL_OK) {
        result = make_patches(h);
    }
    for (uint32_t i = 0; i < MESHES && result == TRL_OK && !h->is_tessellated; i++) {
        result = make_mesh(h, 1u << i, &h->meshes[i]);
    }
    return result;
}

static uint64_t count_bytes(const struct hemisphere *h)
{
    const uint64_t vertices = (uint64_t)(h->cells + 1) * (h->cells + 1);
    uint64_t bytes = sizeof *h + h->chunk_count * sizeof *h->chunks + sizeof(float[4]) * vertices;
    bytes += sizeof(uint32_t) * (uint64_t)h->patches.index_count;
    for (uint32_t i = 0; i < MESHES; i++) {
        bytes += sizeof(uint32_t) * (uint64_t)h->meshes[i].index_count;
    }
    return bytes;
}

bool hemisphere_cells_are_good(uint32_t cells)
{
    return cells >= TRL_HEMISPHERE_MIN_CELLS && cells <= TRL_HEMISPHERE_MAX_CELLS &&
           cells % TRL_HEMISPHERE_STEP == 0;
}

trl_result hemisphere_create_of(const struct surface *surface, const struct hemisphere_desc *desc,
                                struct mesher **out)
{
    static const struct mesher_ops OPS = {update, draw, destroy};
    struct hemisphere *h = mem_alloc(surface->gpu->ctx, 1, sizeof *h);
    *out = NULL;
    if (!h) {
        return TRL_ERROR_MEMORY;
    }
    h->base.ops = &OPS;
    h->gpu = surface->gpu;
    h->surface = surface;
    h->is_tessellated = desc->is_tessellated;
    const uint32_t own = desc->is_tessellated ? TESSELLATED_CELLS : HEMISPHERE_CELLS;
    h->cells = desc->cells > 0 ? desc->cells : own;
    h->chunk_row = h->cells / CHUNK_CELLS;
    h->chunk_count = h->chunk_row * h->chunk_row;
    const trl_result result = make_parts(h);
    if (result != TRL_OK) {
        destroy(&h->base);
        return result;
    }
    h->base.stats.bytes = count_bytes(h);
    *out = &h->base;
    return TRL_OK;
}

trl_result hemisphere_create(const struct surface *surface, struct mesher **out)
{
    return hemisphere_create_of(surface, &(struct hemisphere_desc){0, false}, out);
}

trl_result hemisphere_create_tessellated(const struct surface *surface, struct mesher **out)
{
    return hemisphere_create_of(surface, &(struct hemisphere_desc){0, true}, out);
}
