// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The projective mesher, planetary projective grid mapping (PGM): in every frame a grid of rays
// around the camera is laid on the planet and lifted by its heights. In the plane of the vertical
// and a column of rays everything has two dimensions; positions come out relative to the camera. It
// differs from the paper in three ways. Columns are half planes through the vertical and not those
// of a perspective picture, which cannot hold both nadir and horizon of a wide view. Rows are
// placed by what a coarse look at the relief finds (projective_rows.h); by two reference spheres,
// as the paper has it, on request. And the radius of the primary one comes from the same frame.
// Vertices are made by a fragment pass into a texture (resources: u_positions, RGBA32F, columns + 1
// by rows), since vertex shaders are slow in software.
#include "terrain/projective.h"

#include "gpu/mesh.h"
#include "gpu/pass.h"
#include "terrain/depth.h"
#include "terrain/impostor.h"

#include <math.h>

struct projective {
    struct mesher base;
    struct gpu *gpu;
    const struct surface *surface;
    trl_projective_desc desc;
    struct camera camera;
    struct sampling_camera sampling;
    bool is_stale;          // the vertices are those of another camera
    uint32_t target_height; // of the last picture, 0 before
    struct projective_rows rows;
    float *column_values;       // owned
    struct gpu_texture columns; // RGBA32F; see sampling_camera.h
    struct gpu_texture positions;
    struct gpu_target target;
    struct height_programs grid_programs;
    struct gpu_program mesh_program;
    struct gpu_mesh mesh;
    struct impostor impostor;
};

trl_projective_desc projective_desc_default(void)
{
    return (trl_projective_desc){.columns = 400, .rows = 400};
}

static void put_cell(uint32_t *indices, uint32_t a, uint32_t width)
{
    // Counter-clockwise from above: columns go round against the clock, rows outward.
    const uint32_t cell[6] = {a, a + width, a + width + 1, a, a + width + 1, a + 1};
    for (int i = 0; i < 6; i++) {
        indices[i] = cell[i];
    }
}

static trl_result make_mesh(struct projective *p)
{
    const uint32_t width = p->desc.columns + 1;
    const uint32_t count = p->desc.columns * (p->desc.rows - 1) * 6;
    uint32_t *indices = mem_alloc(p->gpu->ctx, count, sizeof *indices);
    if (!indices) {
        return TRL_ERROR_MEMORY;
    }
    uint32_t *to = indices;
    for (uint32_t y = 0; y + 1 < p->desc.rows; y++) {
        for (uint32_t x = 0; x < p->desc.columns; x++, to += 6) {
            put_cell(to, y * width + x, width);
        }
    }
    const struct gpu_mesh_desc desc = {.label = "projective grid",
                                       .primitive = GPU_PRIMITIVE_TRIANGLES,
                                       .vertex_count = width * p->desc.rows,
                                       .index_count = count,
                                       .indices = indices};
    const trl_result result = gpu_mesh_init(p->gpu, &desc, &p->mesh);
    mem_free(p->gpu->ctx, indices);
    return result;
}

static trl_result make_programs(struct projective *p)
{
    const struct gpu_program_desc mesh = {.vertex = "terrain/mesh.vert",
                                          .fragment = "terrain/mesh.frag"};
    const trl_result result =
        height_programs_init(p->surface, "terrain/projective_grid.frag", &p->grid_programs);
    return result == TRL_OK ? gpu_program_init(p->gpu, &mesh, &p->mesh_program) : result;
}

static trl_result make_textures(struct projective *p)
{
    p->column_values = mem_alloc(p->gpu->ctx, p->desc.columns + 2, 4 * sizeof(float));
    if (!p->column_values) {
        return TRL_ERROR_MEMORY;
    }
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "projective columns";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = p->desc.columns + 2;
    trl_result result = gpu_texture_init(p->gpu, &desc, &p->columns);
    desc.label = "projective vertices";
    desc.width = p->desc.columns + 1;
    desc.height = p->desc.rows;
    result = result == TRL_OK ? gpu_texture_init(p->gpu, &desc, &p->positions) : result;
    const struct gpu_target_desc target = {
        .label = desc.label, .color_count = 1, .colors = {{.texture = &p->positions}}};
    return result == TRL_OK ? gpu_target_init(p->gpu, &target, &p->target) : result;
}

// Near the eye where that is near the ground, and never farther from heights than they are apart.
static double find_datum(const struct projective *p)
{
    const double eye_m = p->sampling.distance_m - p->surface->radius_m;
    return (double)(float)fmax(surface_min_altitude(p->surface),
                               fmin(eye_m, surface_max_altitude(p->surface)));
}

static trl_result draw_grid(struct projective *p, const struct projective_rows_inputs *in)
{
    struct anchor anchor = p->sampling.anchor;
    anchor.datum_m = find_datum(p);
    const struct surface_eye layers = sampling_camera_eye(&p->sampling, p->surface);
    struct gpu_program *program = height_programs_bind(&p->grid_programs, &layers, &anchor);
    float planet_from_local[9];
    anchor_planet_from_local(&anchor, planet_from_local);
    projective_rows_bind(&p->rows, in, program);
    gpu_program_set_texture(program, "u_rows", projective_rows_texture(&p->rows));
    gpu_program_set_mat3(program, "u_planet_from_local", planet_from_local);
    const float footprint[2] = {0.5f, 1};
    gpu_program_set_vec2(program, "u_footprint", footprint);
    const struct gpu_pass pass = {.target = &p->target};
    gpu_pass_begin(p->gpu, &pass);
    return gpu_draw_fullscreen(program, "projective vertices");
}

static trl_result make_vertices(struct projective *p)
{
    sampling_camera_columns(&p->sampling, p->desc.columns, p->column_values);
    const struct gpu_region all = gpu_texture_region(&p->columns, 0);
    trl_result result = gpu_texture_upload(&p->columns, &all, p->column_values);
    const struct projective_rows_inputs inputs = {&p->sampling, &p->columns, p->desc.columns};
    if (result == TRL_OK) {
        result = projective_rows_draw(&p->rows, &inputs);
    }
    if (result == TRL_OK) {
        result = draw_grid(p, &inputs);
    }
    p->base.stats.projections++;
    p->is_stale = result != TRL_OK;
    return result;
}

static bool is_impostor(const struct projective *p, uint32_t target_height)
{
    const double pixel_rad = 2 * p->camera.tan_half_fov_y / target_height;
    return impostor_is_enough(&p->impostor, &p->sampling, pixel_rad,
                              (double)p->desc.columns * p->desc.rows);
}

// Whether there are vertices at all depends on the picture's size, which is known when one is
// drawn; it mostly is the last one's.
static trl_result update(struct mesher *base, const struct camera *camera)
{
    struct projective *p = (struct projective *)base;
    p->camera = *camera;
    p->sampling = sampling_camera_make(p->surface, camera);
    p->is_stale = true;
    return p->target_height > 0 && !is_impostor(p, p->target_height) ? make_vertices(p) : TRL_OK;
}

static void set_camera(struct projective *p)
{
    const struct camera *c = &p->camera;
    const double tx = c->tan_half_fov_x;
    const double ty = c->tan_half_fov_y;
    const struct vec3 rows[3] = {vec3_scale(c->right, 1 / tx), vec3_scale(c->up, 1 / ty),
                                 c->forward};
    float view[9];
    for (int i = 0; i < 3; i++) {
        view[i] = (float)rows[i].x;
        view[3 + i] = (float)rows[i].y;
        view[6 + i] = (float)rows[i].z;
    }
    static const float nowhere[3] = {0, 0, 0}; // positions count from the camera already
    gpu_program_set_vec3(&p->mesh_program, "u_camera_offset", nowhere);
    gpu_program_set_mat3(&p->mesh_program, "u_view", view);
    gpu_program_set_texture(&p->mesh_program, "u_positions", &p->positions);
}

static trl_result draw_mesh(struct projective *p, const struct gpu_target *target)
{
    const struct depth_ranges ranges = depth_ranges_make(p->surface, &p->camera);
    struct mesher_stats *stats = &p->base.stats;
    set_camera(p);
    trl_result result = TRL_OK;
    for (int i = 0; i < ranges.count && result == TRL_OK; i++) {
        depth_range_begin(&ranges, i, target, GPU_CULL_BACK);
        depth_range_bind(&ranges.of[i], &p->mesh_program);
        result = gpu_draw_mesh(&p->mesh_program, &p->mesh, 1, "projective mesh");
        stats->triangles += p->mesh.index_count / 3;
        stats->draws++;
        stats->chunks++;
    }
    return result;
}

static trl_result draw(struct mesher *base, const struct gpu_target *target)
{
    struct projective *p = (struct projective *)base;
    struct mesher_stats *stats = &p->base.stats;
    stats->triangles = stats->draws = stats->chunks = 0;
    p->target_height = target->height;
    if (is_impostor(p, target->height)) {
        const struct impostor_view view = {&p->camera, &p->sampling};
        stats->draws = 1;
        return impostor_draw(&p->impostor, &view, target);
    }
    const trl_result result = p->is_stale ? make_vertices(p) : TRL_OK;
    return result == TRL_OK ? draw_mesh(p, target) : result;
}

static void destroy(struct mesher *base)
{
    struct projective *p = (struct projective *)base;
    impostor_finish(&p->impostor);
    gpu_mesh_finish(&p->mesh);
    height_programs_finish(&p->grid_programs);
    gpu_program_finish(&p->mesh_program);
    gpu_target_finish(&p->target);
    gpu_texture_finish(&p->positions);
    gpu_texture_finish(&p->columns);
    projective_rows_finish(&p->rows);
    mem_free(p->gpu->ctx, p->column_values);
    mem_free(p->gpu->ctx, p);
}

static uint64_t count_bytes(const struct projective *p)
{
    const uint64_t vertices = (uint64_t)(p->desc.columns + 1) * p->desc.rows;
    return sizeof *p + sizeof(float[4]) * (vertices + 2 * (p->desc.columns + 2)) +
           sizeof(uint32_t) * (uint64_t)p->mesh.index_count + projective_rows_bytes(&p->rows);
}

static bool is_side_good(uint32_t side)
{
    return side >= TRL_PROJECTIVE_MIN_SIDE && side <= TRL_PROJECTIVE_MAX_SIDE && side % 2 == 0;
}

bool projective_desc_is_good(const trl_projective_desc *desc)
{
    return is_side_good(desc->columns) && is_side_good(desc->rows) &&
           (unsigned)desc->placing <= TRL_PROJECTIVE_ROWS_SPHERES;
}

trl_result projective_create(const struct surface *surface, const trl_projective_desc *desc,
                             struct mesher **out)
{
    static const struct mesher_ops OPS = {update, draw, destroy};
    *out = NULL;
    if (!projective_desc_is_good(desc)) {
        return trl_fail(surface->gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "a grid of %u x %u: sides are even, from %d to %d", desc->columns,
                        desc->rows, TRL_PROJECTIVE_MIN_SIDE, TRL_PROJECTIVE_MAX_SIDE);
    }
    struct projective *p = mem_alloc(surface->gpu->ctx, 1, sizeof *p);
    if (!p) {
        return TRL_ERROR_MEMORY;
    }
    p->base.ops = &OPS;
    p->gpu = surface->gpu;
    p->surface = surface;
    p->desc = *desc;
    const struct projective_rows_desc rows = {desc->rows, desc->placing};
    trl_result result = projective_rows_init(surface, &rows, &p->rows);
    result = result == TRL_OK ? make_textures(p) : result;
    result = result == TRL_OK ? make_programs(p) : result;
    result = result == TRL_OK ? make_mesh(p) : result;
    result = result == TRL_OK ? impostor_init(surface, &p->impostor) : result;
    if (result != TRL_OK) {
        destroy(&p->base);
        return result;
    }
    p->base.stats.bytes = count_bytes(p);
    *out = &p->base;
    return TRL_OK;
}

trl_result projective_create_default(const struct surface *surface, struct mesher **out)
{
    const trl_projective_desc desc = projective_desc_default();
    return projective_create(surface, &desc, out);
}
