// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/sea_mesh.h"

#include "gpu/pass.h"
#include "shared/sea.glsl"
#include "terrain/depth.h"

#include <math.h>

// Vertices to a side; the shore is looked at for every second one.
enum {
    COLUMNS = SEA_GRID_SPOKES + 1,
    ROWS = SEA_GRID_RINGS + 1,
    SHORE_COLUMNS = SEA_GRID_SPOKES / 2 + 1,
    SHORE_ROWS = SEA_GRID_RINGS / 2 + 1
};

static trl_result make_texture(struct gpu *gpu, const struct gpu_texture_desc *wanted,
                               struct gpu_texture *out)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = wanted->label;
    desc.format = wanted->format;
    desc.filter = wanted->filter;
    desc.width = wanted->width;
    desc.height = wanted->height;
    return gpu_texture_init(gpu, &desc, out);
}

static trl_result make_grid_targets(struct sea_mesh *m)
{
    const struct gpu_texture_desc shore = {.label = "shore of the sea's mesh",
                                           .format = GPU_FORMAT_RGBA16F,
                                           .filter = GPU_FILTER_LINEAR,
                                           .width = SHORE_COLUMNS,
                                           .height = SHORE_ROWS};
    const struct gpu_texture_desc crests = {.label = "vertices of the sea's mesh",
                                            .format = GPU_FORMAT_RGBA32F,
                                            .filter = GPU_FILTER_NEAREST,
                                            .width = COLUMNS,
                                            .height = ROWS};
    trl_result result = make_texture(m->gpu, &shore, &m->shore);
    result = result == TRL_OK ? make_texture(m->gpu, &crests, &m->crests) : result;
    result = result == TRL_OK ? make_texture(m->gpu, &crests, &m->normals) : result;
    const struct gpu_target_desc shores = {
        .label = "shore", .color_count = 1, .colors[0].texture = &m->shore};
    const struct gpu_target_desc vertices = {
        .label = "vertices of the sea",
        .color_count = 2,
        .colors = {{.texture = &m->crests}, {.texture = &m->normals}}};
    result = result == TRL_OK ? gpu_target_init(m->gpu, &shores, &m->shore_target) : result;
    return result == TRL_OK ? gpu_target_init(m->gpu, &vertices, &m->crest_target) : result;
}

static trl_result make_mesh(struct sea_mesh *m)
{
    const uint32_t count = 6 * SEA_GRID_SPOKES * SEA_GRID_RINGS;
    uint32_t *indices = mem_alloc(m->gpu->ctx, count, sizeof *indices);
    if (!indices) {
        return TRL_ERROR_MEMORY;
    }
    // The nearest first, so that what they hide is not shaded.
    uint32_t *to = indices;
    for (uint32_t ring = 0; ring < SEA_GRID_RINGS; ring++) {
        for (uint32_t spoke = 0; spoke < SEA_GRID_SPOKES; spoke++, to += 6) {
            const uint32_t a = ring * COLUMNS + spoke, b = a + 1;
            const uint32_t d = a + COLUMNS, c = d + 1;
            const bool is_rising = (ring + spoke) % 2 == 0; // no direction is preferred
            const uint32_t rising[6] = {a, b, c, a, c, d}, falling[6] = {a, b, d, b, c, d};
            for (int i = 0; i < 6; i++) {
                to[i] = is_rising ? rising[i] : falling[i];
            }
        }
    }
    const struct gpu_mesh_desc desc = {.label = "sea",
                                       .primitive = GPU_PRIMITIVE_TRIANGLES,
                                       .vertex_count = COLUMNS * ROWS,
                                       .index_count = count,
                                       .indices = indices};
    const trl_result result = gpu_mesh_init(m->gpu, &desc, &m->mesh);
    mem_free(m->gpu->ctx, indices);
    return result;
}

static trl_result make_programs(struct sea_mesh *m)
{
    const struct gpu_program_desc open = {.vertex = "lib/fullscreen.vert",
                                          .fragment = "ocean/open.frag"};
    const struct gpu_program_desc crests = {.vertex = "lib/fullscreen.vert",
                                            .fragment = "ocean/crests.frag"};
    const struct gpu_program_desc join = {.vertex = "lib/fullscreen.vert",
                                          .fragment = "ocean/join.frag"};
    const struct gpu_program_desc mesh = {.vertex = "ocean/mesh.vert",
                                          .fragment = "ocean/mesh.frag"};
    trl_result result = height_programs_init(m->surface, "ocean/shore.frag", &m->shore_programs);
    result = result == TRL_OK ? gpu_program_init(m->gpu, &open, &m->open_program) : result;
    result = result == TRL_OK ? gpu_program_init(m->gpu, &crests, &m->crest_program) : result;
    result = result == TRL_OK ? gpu_program_init(m->gpu, &join, &m->join_program) : result;
    return result == TRL_OK ? gpu_program_init(m->gpu, &mesh, &m->mesh_program) : result;
}

trl_result sea_mesh_init(const struct surface *surface, struct wave_texture *waves,
                         struct sea_mesh *out)
{
    *out = (struct sea_mesh){.gpu = surface->gpu, .surface = surface, .waves = waves};
    trl_result result = make_grid_targets(out);
    result = result == TRL_OK ? make_mesh(out) : result;
    result = result == TRL_OK ? make_programs(out) : result;
    result = result == TRL_OK ? gpu_condition_init(out->gpu, &out->is_open) : result;
    if (result != TRL_OK) {
        sea_mesh_finish(out);
    }
    return result;
}

static void finish_picture(struct sea_mesh *m)
{
    gpu_target_finish(&m->target);
    gpu_texture_finish(&m->position);
    gpu_texture_finish(&m->level);
}

void sea_mesh_finish(struct sea_mesh *m)
{
    finish_picture(m);
    gpu_mesh_finish(&m->mesh);
    height_programs_finish(&m->shore_programs);
    gpu_condition_finish(&m->is_open);
    gpu_program_finish(&m->open_program);
    gpu_program_finish(&m->crest_program);
    gpu_program_finish(&m->join_program);
    gpu_program_finish(&m->mesh_program);
    gpu_target_finish(&m->shore_target);
    gpu_target_finish(&m->crest_target);
    gpu_texture_finish(&m->shore);
    gpu_texture_finish(&m->crests);
    gpu_texture_finish(&m->normals);
    *m = (struct sea_mesh){0};
}

trl_result sea_mesh_resize(struct sea_mesh *m, const struct gpu_texture *depth)
{
    finish_picture(m);
    struct gpu_texture_desc desc = {.label = "position with the sea",
                                    .format = GPU_FORMAT_RGBA32F,
                                    .filter = GPU_FILTER_NEAREST,
                                    .width = depth->width,
                                    .height = depth->height};
    trl_result result = make_texture(m->gpu, &desc, &m->position);
    desc.label = "level place of the sea";
    result = result == TRL_OK ? make_texture(m->gpu, &desc, &m->level) : result;
    const struct gpu_target_desc target = {
        .label = "sea",
        .color_count = 2,
        .colors = {{.texture = &m->position}, {.texture = &m->level}},
        .depth.texture = depth};
    result = result == TRL_OK ? gpu_target_init(m->gpu, &target, &m->target) : result;
    if (result != TRL_OK) {
        finish_picture(m);
    }
    return result;
}

static void set_grid(const struct sea_mesh *m, struct gpu_program *program)
{
    const SeaGrid *g = &m->plan.grid;
    const float grid[4] = {(float)g->inner, (float)g->growth, (float)g->begin, (float)g->step};
    const float eye[4] = {(float)g->reach, (float)m->plan.eye_height_m, (float)m->plan.east_m,
                          (float)m->plan.north_m};
    gpu_program_set_vec4(program, "u_sea_grid", grid);
    gpu_program_set_vec4(program, "u_sea_eye", eye);
}

static trl_result draw_shore(struct sea_mesh *m, const struct anchor *anchor)
{
    const double reach_m = sea_grid_radius(m->plan.grid, SEA_GRID_RINGS);
    const struct surface_eye eye = {.up = anchor->up,
                                    .reach_rad = reach_m / m->surface->radius_m,
                                    .height_rad = m->plan.eye_height_m / m->surface->radius_m};
    struct gpu_program *program = height_programs_bind(&m->shore_programs, &eye, anchor);
    set_grid(m, program);
    const double depth_m = m->surface->depth.everywhere_m;
    gpu_program_set_float(program, "u_sea_depth",
                          depth_m < 0 ? -1 : (float)sea_depth_code(depth_m));
    const struct gpu_pass pass = {.target = &m->shore_target};
    gpu_pass_begin(m->gpu, &pass);
    return gpu_draw_fullscreen(program, "shore of the sea");
}

// Counts the vertices that have open water.
static trl_result find_open(struct sea_mesh *m)
{
    gpu_program_set_texture(&m->open_program, "u_shore", &m->shore);
    const struct gpu_pass pass = {.target = &m->crest_target,
                                  .viewport = {0, 0, SHORE_COLUMNS, SHORE_ROWS},
                                  .state = {.hides_color = true}};
    gpu_condition_count(&m->is_open);
    gpu_pass_begin(m->gpu, &pass);
    const trl_result result = gpu_draw_fullscreen(&m->open_program, "open water");
    gpu_condition_counted(&m->is_open);
    return result;
}

static trl_result draw_crests(struct sea_mesh *m)
{
    struct gpu_program *program = &m->crest_program;
    set_grid(m, program);
    gpu_program_set_texture(program, "u_shore", &m->shore);
    wave_texture_bind(m->waves, program);
    const struct gpu_pass pass = {.target = &m->crest_target};
    gpu_pass_begin(m->gpu, &pass);
    return gpu_draw_fullscreen(program, "vertices of the sea");
}

static void set_view(struct sea_mesh *m, const struct camera *c, const struct anchor *anchor)
{
    const struct vec3 rows[3] = {vec3_scale(c->right, 1 / c->tan_half_fov_x),
                                 vec3_scale(c->up, 1 / c->tan_half_fov_y), c->forward};
    float view[9], planet_from_local[9];
    for (int i = 0; i < 3; i++) {
        view[i] = (float)rows[i].x;
        view[3 + i] = (float)rows[i].y;
        view[6 + i] = (float)rows[i].z;
    }
    anchor_planet_from_local(anchor, planet_from_local);
    struct gpu_program *program = &m->mesh_program;
    set_grid(m, program);
    gpu_program_set_texture(program, "u_crests", &m->crests);
    gpu_program_set_texture(program, "u_normals", &m->normals);
    gpu_program_set_mat3(program, "u_view", view);
    gpu_program_set_mat3(program, "u_planet_from_local", planet_from_local);
    gpu_program_set_float(program, "u_planet_radius", (float)m->surface->radius_m);
}

static trl_result draw_ground(struct sea_mesh *m, const struct sea_mesh_inputs *in)
{
    gpu_program_set_texture(&m->join_program, "u_ground", in->ground);
    const struct gpu_pass pass = {.target = &m->target};
    gpu_pass_begin(m->gpu, &pass);
    return gpu_draw_fullscreen(&m->join_program, "ground below the sea");
}

static trl_result draw_sea(struct sea_mesh *m, const struct sea_mesh_inputs *in)
{
    trl_result result = TRL_OK;
    gpu_program_set_texture(&m->mesh_program, "u_ground", in->ground);
    const struct depth_ranges ranges = depth_ranges_make(m->surface, in->camera);
    for (int i = 0; i < ranges.count && result == TRL_OK; i++) {
        const struct gpu_pass pass = {.target = &m->target,
                                      .state = {.depth = GPU_DEPTH_NEARER, .writes_depth = true},
                                      .clears_depth = true,
                                      .depth = m->gpu->caps.has_clip_control ? 0 : -1};
        gpu_pass_begin(m->gpu, &pass);
        depth_range_bind(&ranges.of[i], &m->mesh_program);
        result = gpu_draw_mesh(&m->mesh_program, &m->mesh, 1, "sea");
    }
    return result;
}

static void centre_rings(struct sea_mesh *m)
{
    const double shown = sea_grid_shown(m->plan.grid, m->plan.eye_height_m);
    const struct waves_stand stand =
        waves_stand_find(m->waves->view, m->surface->radius_m, 0, shown);
    m->plan.east_m = stand.east_m;
    m->plan.north_m = stand.north_m;
}

trl_result sea_mesh_draw(struct sea_mesh *m, const struct sea_mesh_inputs *in)
{
    const double pixel_rad = 2 * in->camera->tan_half_fov_y / in->ground->height;
    trl_result result = wave_texture_update(m->waves, in->camera->position_m, in->time_s);
    m->wave_height_m = wave_texture_height_m(m->waves);
    m->plan = sea_mesh_plan_make(in->camera, m->surface->radius_m, m->wave_height_m, pixel_rad);
    if (result != TRL_OK || !m->plan.is_seen) {
        return result;
    }
    const struct anchor anchor = anchor_below(in->camera->position_m);
    centre_rings(m);
    result = result == TRL_OK ? draw_shore(m, &anchor) : result;
    result = result == TRL_OK ? find_open(m) : result;
    result = result == TRL_OK ? draw_ground(m, in) : result;
    gpu_condition_begin(&m->is_open);
    result = result == TRL_OK ? draw_crests(m) : result;
    set_view(m, in->camera, &anchor);
    result = result == TRL_OK ? draw_sea(m, in) : result;
    gpu_condition_end(&m->is_open);
    return result;
}
