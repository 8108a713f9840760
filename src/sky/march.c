// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/march.h"

#include "sky/eclipse.h"

#include <math.h>
#include <stdio.h>

// Pixels of the picture to a cell of the grid, each way: half a degree of a usual view. No shadow
// in the air has a sharper edge than the star is wide, save one that is looked at along its length.
enum { CELL = 8, FINEST_CELL = 3, UMBRA_CELLS = 5 };
static const double SKY_M = 1e29; // a ray that is looked at so far meets no ground

void sky_march_init(const struct sky_pixels *pixels, struct sky_march *out)
{
    *out = (struct sky_march){.gpu = pixels->gpu,
                              .top_radius_m = pixels->top_radius_m,
                              .ground_radius_m = pixels->ground_radius_m};
}

static void finish_maps(struct sky_march *m)
{
    gpu_target_finish(&m->layer);
    for (int i = 0; i < 2; i++) {
        gpu_target_finish(&m->sums[i]);
        gpu_texture_finish(&m->lit[i]);
        gpu_texture_finish(&m->all[i]);
    }
    gpu_texture_finish(&m->steps);
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
        const struct gpu_target_desc sums = {
            .label = "march sums",
            .color_count = 3,
            .colors = {{.texture = &m->lit[i]}, {.texture = &m->all[i]}, {.texture = &m->steps}}};
        result = gpu_target_init(m->gpu, &sums, &m->sums[i]);
    }
    const struct gpu_target_desc layer = {
        .label = "march", .color_count = 1, .colors[0].texture = &m->share};
    return result == TRL_OK ? gpu_target_init(m->gpu, &layer, &m->layer) : result;
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
    if (m->steps.width == size.width && m->steps.height == size.height) {
        return TRL_OK;
    }
    finish_maps(m);
    trl_result result = make_map(m, &size, GPU_FILTER_NEAREST, &m->steps);
    for (int i = 0; i < 2 && result == TRL_OK; i++) {
        result = make_map(m, &size, GPU_FILTER_NEAREST, &m->lit[i]);
        if (result == TRL_OK) {
            result = make_map(m, &size, GPU_FILTER_NEAREST, &m->all[i]);
        }
    }
    size.depth = MARCH_LAYERS + 1;
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
    const float grid[2] = {(float)m->steps.width, (float)m->steps.height};
    sky_pixels_set_view(source->pixels, &m->begin, view);
    gpu_program_set_vec2(&m->begin, "u_grid", grid);
    if (!m->is_bare) {
        gpu_program_set_texture(&m->begin, "u_position", view->surface.position);
    }
    gpu_pass_begin(m->gpu, &pass);
    return gpu_draw_fullscreen(&m->begin, "march");
}

struct step {
    int layer;
    double from_m, to_m;
};

static trl_result draw_step(struct sky_march *m, struct gpu_program *program,
                            const struct step *step)
{
    const int before = step->layer & 1; // of the two sums
    const float range[2] = {(float)step->from_m, (float)step->to_m};
    gpu_program_set_vec2(program, "u_step", range);
    gpu_program_set_texture(program, "u_lit", &m->lit[before]);
    gpu_program_set_texture(program, "u_all", &m->all[before]);
    const struct gpu_pass sum = {.target = &m->sums[1 - before]};
    gpu_pass_begin(m->gpu, &sum);
    trl_result result = gpu_draw_fullscreen(program, "march");
    if (result == TRL_OK) {
        result = gpu_target_set_layer(&m->layer, 0, (uint32_t)step->layer);
    }
    if (result == TRL_OK) {
        const struct gpu_pass fill = {.target = &m->layer};
        const double least_m = step->layer < MARCH_LAYERS ? step->from_m : SKY_M;
        gpu_program_set_float(&m->fill, "u_distance", (float)least_m);
        gpu_pass_begin(m->gpu, &fill);
        result = gpu_draw_fullscreen(&m->fill, "march");
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
    gpu_program_set_texture(&m->fill, "u_steps", &m->steps);
    for (int layer = 0; layer < MARCH_LAYERS && result == TRL_OK; layer++) {
        const struct step step = {layer, layer_end(m, layer), layer_end(m, layer + 1)};
        result = draw_step(m, &m->step, &step);
    }
    const struct step space = {MARCH_LAYERS, m->far_m, 1e30};
    return result == TRL_OK ? draw_step(m, &m->space, &space) : result;
}

void sky_march_bind(const struct sky_march *m, struct gpu_program *program)
{
    gpu_program_set_vec2(program, "u_march", (const float[]){(float)m->far_m, MARCH_LAYERS});
    gpu_program_set_texture(program, "u_share", &m->share);
}
