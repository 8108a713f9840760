// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/march.h"

#include "sky/eclipse.h"

#include <math.h>
#include <stdio.h>

// Pixels of the picture to a cell of the grid, each way: half a degree of a usual view. No shadow
// in the air has a sharper edge than the star is wide, save one that is looked at along its length.
enum { CELL = 8, FINEST_CELL = 3, UMBRA_CELLS = 5 };

// Layers that a pass marches through and fills: as many as there are targets of a program at least.
// The last sums before space are in one of the two textures.
enum { PASS_LAYERS = 2, FILL_LAYERS = 4, LAST_SUMS = MARCH_LAYERS / PASS_LAYERS & 1 };
static const double SKY_M = 1e29; // a ray that is looked at so far meets no ground

void sky_march_init(const struct sky_pixels *pixels, struct sky_march *out)
{
    *out = (struct sky_march){.gpu = pixels->gpu,
                              .top_radius_m = pixels->top_radius_m,
                              .ground_radius_m = pixels->ground_radius_m};
}

static void finish_maps(struct sky_march *m)
{
    gpu_target_finish(&m->filled);
    gpu_target_finish(&m->last);
    for (int i = 0; i < 2; i++) {
        gpu_target_finish(&m->sums[i]);
        gpu_texture_finish(&m->lit[i]);
        gpu_texture_finish(&m->all[i]);
    }
    gpu_texture_finish(&m->marched);
    gpu_texture_finish(&m->share);
}

static void finish_programs(struct sky_march *m)
{
    gpu_program_finish(&m->begin);
    gpu_program_finish(&m->step);
    gpu_program_finish(&m->space);
    gpu_program_finish(&m->fill);
    m->is_made = false;
}

void sky_march_finish(struct sky_march *march)
{
    finish_maps(march);
    finish_programs(march);
    *march = (struct sky_march){0};
}

// With those of the defines that are not NULL.
enum { DEFINES = 4 };
static trl_result make_program(struct sky_march *m, const char *fragment,
                               const char *const wanted[DEFINES], struct gpu_program *out)
{
    const char *defines[DEFINES];
    size_t count = 0;
    for (size_t i = 0; i < DEFINES; i++) {
        if (wanted[i]) {
            defines[count++] = wanted[i];
        }
    }
    const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                          .fragment = fragment,
                                          .defines = defines,
                                          .define_count = count};
    return gpu_program_init(m->gpu, &desc, out);
}

static trl_result make_programs(struct sky_march *m, const struct sky_march_source *source,
                                const struct sky_view *view)
{
    const bool is_bare = sky_view_is_bare(view);
    const bool has_eclipse = source->eclipse != NULL;
    const bool has_clouds = view->cloud_deck != NULL;
    if (m->is_made && m->is_bare == is_bare && m->has_eclipse == has_eclipse &&
        m->has_clouds == has_clouds) {
        return TRL_OK;
    }
    finish_programs(m);
    char peaked[32];
    snprintf(peaked, sizeof peaked, "PEAKED_COUNT %d", source->peaked_count);
    const char *const surface = is_bare ? NULL : "SURFACE";
    const char *const eclipse = has_eclipse ? "ECLIPSE" : NULL;
    const char *const clouds = has_clouds ? "CLOUDS" : NULL;
    const struct {
        const char *fragment;
        const char *defines[DEFINES];
        struct gpu_program *program;
    } made[] = {{"sky/spectral/march_begin.frag", {surface}, &m->begin},
                {"sky/spectral/march.frag", {peaked, eclipse, clouds, surface}, &m->step},
                {"sky/spectral/march.frag", {peaked, "TO_SPACE", eclipse, clouds}, &m->space},
                {"sky/spectral/march_fill.frag", {NULL}, &m->fill}};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < sizeof made / sizeof *made && result == TRL_OK; i++) {
        result = make_program(m, made[i].fragment, made[i].defines, made[i].program);
    }
    m->is_bare = is_bare;
    m->has_eclipse = has_eclipse;
    m->has_clouds = has_clouds;
    m->is_made = result == TRL_OK;
    return result;
}

static trl_result make_map(struct sky_march *m, const struct gpu_region *size,
                           enum gpu_filter filter, struct gpu_texture *out)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "march";
    desc.shape = size->depth > 1 ? GPU_SHAPE_3D : GPU_SHAPE_2D;
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = filter;
    desc.width = size->width;
    desc.height = size->height;
    desc.depth = size->depth;
    return gpu_texture_init(m->gpu, &desc, out);
}

static trl_result make_targets(struct sky_march *m)
{
    trl_result result = TRL_OK;
    for (int i = 0; i < 2 && result == TRL_OK; i++) {
        const struct gpu_target_desc sums = {.label = "march sums",
                                             .color_count = 2 + PASS_LAYERS,
                                             .colors = {{.texture = &m->lit[i]},
                                                        {.texture = &m->all[i]},
                                                        {.texture = &m->marched, .layer = 0},
                                                        {.texture = &m->marched, .layer = 1}}};
        result = gpu_target_init(m->gpu, &sums, &m->sums[i]);
    }
    const struct gpu_target_desc last = {
        .label = "march into space",
        .color_count = 3,
        .colors = {{.texture = &m->lit[1 - LAST_SUMS]},
                   {.texture = &m->all[1 - LAST_SUMS]},
                   {.texture = &m->marched, .layer = MARCH_LAYERS}}};
    if (result == TRL_OK) {
        result = gpu_target_init(m->gpu, &last, &m->last);
    }
    struct gpu_target_desc filled = {.label = "march", .color_count = FILL_LAYERS};
    for (uint32_t i = 0; i < FILL_LAYERS; i++) {
        filled.colors[i] = (struct gpu_attachment){.texture = &m->share, .layer = i};
    }
    return result == TRL_OK ? gpu_target_init(m->gpu, &filled, &m->filled) : result;
}

// Finer where an umbra is small in the picture.
static unsigned find_cell(const struct sky_march_source *source, const struct sky_view *view)
{
    if (!source->eclipse) {
        return CELL;
    }
    const double umbra_rad = sky_eclipse_width(source->eclipse, view->camera);
    const double pixel_rad = 2 * view->camera->tan_half_fov_y / view->target->height;
    return (unsigned)fmin(fmax(umbra_rad / pixel_rad / UMBRA_CELLS, FINEST_CELL), CELL);
}

static trl_result fit_maps(struct sky_march *m, const struct gpu_target *picture, unsigned cell)
{
    struct gpu_region size = {.width = (picture->width + cell - 1) / cell,
                              .height = (picture->height + cell - 1) / cell,
                              .depth = 1};
    if (m->share.width == size.width && m->share.height == size.height) {
        return TRL_OK;
    }
    finish_maps(m);
    trl_result result = TRL_OK;
    for (int i = 0; i < 2 && result == TRL_OK; i++) {
        result = make_map(m, &size, GPU_FILTER_NEAREST, &m->lit[i]);
        if (result == TRL_OK) {
            result = make_map(m, &size, GPU_FILTER_NEAREST, &m->all[i]);
        }
    }
    size.depth = MARCH_LAYERS + 1;
    if (result == TRL_OK) {
        result = make_map(m, &size, GPU_FILTER_NEAREST, &m->marched);
    }
    if (result == TRL_OK) {
        result = make_map(m, &size, GPU_FILTER_LINEAR, &m->share);
    }
    if (result == TRL_OK) {
        result = make_targets(m);
    }
    if (result != TRL_OK) {
        finish_maps(m); // so that the next picture does not take half of them for whole
    }
    return result;
}

// From where a ray's air begins to the farthest ground and clouds that it can meet. Were steps
// counted from an eye in space, rays side by side would enter the air at other parts of one, which
// makes rings.
static void find_range(struct sky_march *m, const struct sky_march_source *source,
                       const struct sky_view *view)
{
    const double eye_m = sky_pixels_eye_radius(source->pixels, view->camera);
    const double first_m = fmin(eye_m, m->top_radius_m);
    const double ground_m = m->ground_radius_m;
    const double peak_m = ground_m + fmax(fmax(view->shadow.highest_m, view->cloud_top_m), 0);
    m->far_m = sqrt((first_m - ground_m) * (first_m + ground_m)) +
               sqrt((peak_m - ground_m) * (peak_m + ground_m)) + 1000;
}

static double layer_end(const struct sky_march *m, int layer)
{
    const double x = (double)layer / MARCH_LAYERS;
    return m->far_m * x * x;
}

static trl_result draw_begin(struct sky_march *m, const struct sky_march_source *source,
                             const struct sky_view *view)
{
    const struct gpu_pass pass = {.target = &m->sums[0]};
    const float grid[2] = {(float)m->share.width, (float)m->share.height};
    sky_pixels_set_view(source->pixels, &m->begin, view);
    gpu_program_set_vec2(&m->begin, "u_grid", grid);
    if (!m->is_bare) {
        gpu_program_set_texture(&m->begin, "u_position", view->surface.position);
    }
    gpu_pass_begin(m->gpu, &pass);
    return gpu_draw_fullscreen(&m->begin, "march");
}

// Takes its program's sums of before from one of the two textures of them.
static trl_result draw_steps(struct sky_march *m, struct gpu_program *program, int before,
                             const struct gpu_target *target)
{
    const struct gpu_pass pass = {.target = target};
    gpu_program_set_texture(program, "u_lit", &m->lit[before]);
    gpu_program_set_texture(program, "u_all", &m->all[before]);
    gpu_pass_begin(m->gpu, &pass);
    return gpu_draw_fullscreen(program, "march");
}

static trl_result draw_two(struct sky_march *m, int layer)
{
    const int before = layer / PASS_LAYERS & 1;
    const float steps[3] = {(float)layer_end(m, layer), (float)layer_end(m, layer + 1),
                            (float)layer_end(m, layer + 2)};
    struct gpu_target *sums = &m->sums[1 - before];
    trl_result result = TRL_OK;
    for (uint32_t i = 0; i < PASS_LAYERS && result == TRL_OK; i++) {
        result = gpu_target_set_layer(sums, 2 + i, (uint32_t)layer + i);
    }
    gpu_program_set_vec3(&m->step, "u_steps", steps);
    return result == TRL_OK ? draw_steps(m, &m->step, before, sums) : result;
}

static trl_result draw_space(struct sky_march *m)
{
    gpu_program_set_vec3(&m->space, "u_steps", (const float[]){(float)m->far_m, 1e30f, 1e30f});
    return draw_steps(m, &m->space, LAST_SUMS, &m->last);
}

static trl_result fill_four(struct sky_march *m, int layer)
{
    float distances[FILL_LAYERS];
    trl_result result = TRL_OK;
    for (int i = 0; i < FILL_LAYERS && result == TRL_OK; i++) {
        const bool is_space = layer + i == MARCH_LAYERS;
        distances[i] = (float)(is_space ? SKY_M : layer_end(m, layer + i));
        result = gpu_target_set_layer(&m->filled, (uint32_t)i, (uint32_t)(layer + i));
    }
    if (result != TRL_OK) {
        return result;
    }
    const struct gpu_pass pass = {.target = &m->filled};
    gpu_program_set_vec4(&m->fill, "u_distances", distances);
    gpu_program_set_int(&m->fill, "u_first", layer);
    gpu_pass_begin(m->gpu, &pass);
    return gpu_draw_fullscreen(&m->fill, "march");
}

// All layers and the one of space; the last four overlap those before.
static trl_result fill_all(struct sky_march *m)
{
    trl_result result = TRL_OK;
    gpu_program_set_texture(&m->fill, "u_shares", &m->marched);
    for (int layer = 0; layer <= MARCH_LAYERS && result == TRL_OK; layer += FILL_LAYERS) {
        const int last = MARCH_LAYERS + 1 - FILL_LAYERS;
        result = fill_four(m, layer < last ? layer : last);
    }
    return result;
}

static void set_program(struct sky_march *m, const struct sky_march_source *source,
                        const struct sky_view *view, struct gpu_program *program)
{
    sky_pixels_set_view(source->pixels, program, view);
    source->set_maps(source->self, program);
    if (m->has_eclipse) {
        sky_eclipse_set(source->pixels, source->eclipse, view->camera, program);
    }
    if (m->has_clouds) {
        sky_pixels_set_deck(program, view);
    }
    if (!m->is_bare) {
        view->shadow.bind(view->shadow.self, view->camera, program);
    }
}

trl_result sky_march_draw(struct sky_march *m, const struct sky_march_source *source,
                          const struct sky_view *view)
{
    trl_result result = make_programs(m, source, view);
    if (result == TRL_OK) {
        result = fit_maps(m, view->target, find_cell(source, view));
    }
    if (result == TRL_OK) {
        find_range(m, source, view);
        result = draw_begin(m, source, view);
    }
    set_program(m, source, view, &m->step);
    set_program(m, source, view, &m->space);
    for (int layer = 0; layer < MARCH_LAYERS && result == TRL_OK; layer += PASS_LAYERS) {
        result = draw_two(m, layer);
    }
    if (result == TRL_OK) {
        result = draw_space(m);
    }
    return result == TRL_OK ? fill_all(m) : result;
}

void sky_march_bind(const struct sky_march *m, struct gpu_program *program)
{
    gpu_program_set_vec2(program, "u_march", (const float[]){(float)m->far_m, MARCH_LAYERS});
    gpu_program_set_texture(program, "u_share", &m->share);
}
