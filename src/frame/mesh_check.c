// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/mesh_check.h"

#include <math.h>
#include <time.h>

// A column of places is drawn with so many rows that a pixel of the target is as large as one of
// the picture, nearly, for meshers may look at that; no more rows than this.
enum { MAX_DRAWN_ROWS = 8192 };
// Silhouettes steeper than this in the picture are left out: they are looked for along columns.
static const double MAX_EDGE_SLOPE = 3;

// What is known while a view is checked.
struct checker {
    const struct mesh_check_desc *desc;
    const struct mesh_truth *truth; // NULL: shifts only
    struct mesh_check *check;
    float *drawn; // owned; columns x fine_rows x 4, lowest row first
    uint32_t finer, fine_rows;
};

void mesh_check_size(const struct mesh_check_desc *desc, uint32_t size[2])
{
    size[0] = desc->width / desc->step > 2 ? desc->width / desc->step : 2;
    size[1] = desc->height / desc->step > 2 ? desc->height / desc->step : 2;
}

static double processor_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static trl_result draw_once(struct checker *c, const struct gpu_target *target, double *cpu_ms)
{
    struct mesher *mesher = c->desc->mesher;
    gpu_wait(c->desc->gpu);
    const double begun = processor_ms();
    trl_result result = mesher_update(mesher, c->desc->truth.camera);
    if (result == TRL_OK) {
        result = mesher_draw(mesher, target);
    }
    gpu_wait(c->desc->gpu);
    *cpu_ms = processor_ms() - begun;
    return result;
}

static trl_result draw_mesh(struct checker *c, const struct gpu_target *target)
{
    const trl_result result = draw_once(c, target, &c->check->error.new_cpu_ms);
    return result == TRL_OK ? draw_once(c, target, &c->check->error.cpu_ms) : result;
}

struct canvas {
    struct gpu_texture position, depth;
    struct gpu_target target;
};

static void canvas_finish(struct canvas *canvas)
{
    gpu_target_finish(&canvas->target);
    gpu_texture_finish(&canvas->position);
    gpu_texture_finish(&canvas->depth);
}

static trl_result canvas_init(struct gpu *gpu, uint32_t width, uint32_t height, struct canvas *out)
{
    *out = (struct canvas){0};
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "mesh check";
    desc.width = width;
    desc.height = height;
    desc.filter = GPU_FILTER_NEAREST;
    desc.format = GPU_FORMAT_DEPTH32F;
    const trl_result result = gpu_texture_init(gpu, &desc, &out->depth);
    if (result != TRL_OK) {
        return result;
    }
    desc.format = GPU_FORMAT_RGBA32F;
    return gpu_target_init_texture(gpu, &desc, &out->depth, &out->position, &out->target);
}

static trl_result draw(struct checker *c)
{
    struct canvas canvas;
    trl_result result = canvas_init(c->desc->gpu, c->check->columns, c->fine_rows, &canvas);
    if (result == TRL_OK) {
        result = draw_mesh(c, &canvas.target);
    }
    if (result == TRL_OK) {
        const struct gpu_region all = gpu_texture_region(&canvas.position, 0);
        result = gpu_texture_read(&canvas.position, &all, c->drawn);
    }
    canvas_finish(&canvas);
    return result;
}

// ---- the ground's shift

static struct reference_point find_point(const struct mesh_check *check, uint32_t column,
                                         double row)
{
    return reference_caster_point((const uint32_t[2]){check->columns, check->rows}, column, row);
}

// Where the camera sees a position relative to it; false: behind it.
static bool project(const struct camera *camera, struct vec3 at_m, struct reference_point *out)
{
    const double z = vec3_dot(camera->forward, at_m);
    out->x = vec3_dot(camera->right, at_m) / (z * camera->tan_half_fov_x);
    out->y = vec3_dot(camera->up, at_m) / (z * camera->tan_half_fov_y);
    return z > 0;
}

static double pixels_between(const struct mesh_check *check, struct reference_point a,
                             struct reference_point b)
{
    return hypot((a.x - b.x) * check->camera.tan_half_fov_x,
                 (a.y - b.y) * check->camera.tan_half_fov_y) /
           check->pixel;
}

static const float *drawn_at(const struct checker *c, uint32_t column, uint32_t fine_row)
{
    return c->drawn + 4 * ((size_t)fine_row * c->check->columns + column);
}

static bool is_ground(const float *pixel)
{
    return pixel[3] > 0.5f * MESHER_NO_SURFACE;
}

static struct vec3 position_of(const float *pixel)
{
    return (struct vec3){(double)pixel[0], (double)pixel[1], (double)pixel[2]};
}

// What is drawn at a place of the picture belongs to a direction from the planet's centre. Returns
// how far from there, in pixels, the truth shows the ground of that direction.
static double check_place(const struct checker *c, uint32_t column, uint32_t row, float *place)
{
    const struct mesh_check *check = c->check;
    const struct reference_surface *surface = c->desc->truth.surface;
    const float *pixel = drawn_at(c, column, row * c->finer + c->finer / 2);
    place[3] = NAN;
    if (!is_ground(pixel)) {
        return (double)NAN;
    }
    const struct vec3 drawn = vec3_add(check->camera.position_m, position_of(pixel));
    const double radius = vec3_length(drawn);
    const double altitude = surface->altitude_m(surface->user, drawn);
    const struct vec3 truth = vec3_scale(drawn, (check->radius_m + altitude) / radius);
    for (int i = 0; i < 3; i++) {
        place[i] = pixel[i];
    }
    place[3] = (float)(radius - check->radius_m - altitude);
    struct reference_point seen;
    const bool is_seen = project(&check->camera, vec3_sub(truth, check->camera.position_m), &seen);
    return is_seen ? pixels_between(check, seen, find_point(check, column, row)) : (double)NAN;
}

static void check_places(struct checker *c)
{
    struct mesh_check *check = c->check;
    double sum = 0, most = 0;
    uint32_t count = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : sum, count) reduction(max : most)
    for (uint32_t row = 0; row < check->rows; row++) {
        for (uint32_t column = 0; column < check->columns; column++) {
            const size_t i = (size_t)row * check->columns + column;
            const double shift = check_place(c, column, row, check->places + 4 * i);
            if (!isnan(shift)) {
                sum += shift * shift;
                most = fmax(most, shift);
                count++;
            }
        }
    }
    check->error.places = count;
    check->error.shift_rms = count > 0 ? sqrt(sum / count) : 0;
    check->error.shift_max = most;
}

// ---- holes

static bool has_ground(const struct checker *c, uint32_t column, uint32_t row)
{
    return isfinite(c->truth->hits[(size_t)row * c->check->columns + column].distance_m);
}

// Places whose eight neighbours are alike in truth, and that are drawn otherwise.
static void count_holes(struct checker *c)
{
    struct mesh_check *check = c->check;
    for (uint32_t row = 1; row + 1 < check->rows; row++) {
        for (uint32_t column = 1; column + 1 < check->columns; column++) {
            const bool truth = has_ground(c, column, row);
            bool is_inside = true;
            for (uint32_t k = 0; k < 9; k++) {
                is_inside =
                    is_inside && has_ground(c, column + k % 3 - 1, row + k / 3 - 1) == truth;
            }
            const bool drawn = is_ground(drawn_at(c, column, row * c->finer + c->finer / 2));
            check->error.holes += is_inside && drawn != truth;
        }
    }
}

// ---- silhouettes

static double fine_pixel(const struct checker *c) // height of a row of `drawn`, in pixels
{
    return 2 * c->check->camera.tan_half_fov_y / c->check->pixel / c->fine_rows;
}

// Of a silhouette, in pixels from the lower border; NAN: there is none.
static double edge_px(const struct checker *c, const struct mesh_edge *edge)
{
    return edge->row * c->finer * fine_pixel(c);
}

static bool is_near(const struct checker *c, uint32_t column, uint32_t fine_row, double parting_m)
{
    const float *pixel = drawn_at(c, column, fine_row);
    return is_ground(pixel) && (isinf(parting_m) || vec3_length(position_of(pixel)) < parting_m);
}

// How far the drawn silhouette of the same kind is along the column, in pixels; more than the most
// that is looked for: there is none.
static double find_drawn_edge(const struct checker *c, uint32_t column,
                              const struct mesh_edge *edge)
{
    const double fine = fine_pixel(c), y = edge_px(c, edge);
    const int64_t reach = (int64_t)(MESH_CHECK_MAX_EDGE / fine) + 1;
    const int64_t middle = (int64_t)(y / fine);
    double nearest = (double)INFINITY;
    for (int64_t r = middle - reach; r <= middle + reach; r++) {
        if (r < 0 || r + 1 >= c->fine_rows) {
            continue;
        }
        const bool below = is_near(c, column, (uint32_t)r, edge->parting_m);
        const bool above = is_near(c, column, (uint32_t)r + 1, edge->parting_m);
        if (below != above && below == edge->is_near_below) {
            nearest = fmin(nearest, fabs((double)(r + 1) * fine - y));
        }
    }
    return nearest;
}

// The silhouette of the next column that continues one; NAN: none within the steepest slope.
static double find_continued(const struct checker *c, uint32_t column, double y)
{
    const double reach = MAX_EDGE_SLOPE * c->desc->step;
    double nearest = (double)NAN;
    for (uint32_t row = 0; row + 1 < c->check->rows; row++) {
        const double other = edge_px(c, &c->truth->edges[(size_t)row * c->check->columns + column]);
        if (fabs(other - y) <= reach && !(fabs(other - y) > fabs(nearest - y))) {
            nearest = other;
        }
    }
    return nearest;
}

// Cosine of the silhouette's slope in the picture, from the columns beside it; 0: unknown.
static double find_cosine(const struct checker *c, uint32_t column, double y)
{
    double slope = 0;
    int count = 0;
    for (int side = -1; side <= 1; side += 2) {
        if ((side < 0 && column == 0) || (side > 0 && column + 1 == c->check->columns)) {
            continue;
        }
        const double other = find_continued(c, (uint32_t)((int64_t)column + side), y);
        if (!isnan(other)) {
            slope += side * (other - y) / c->desc->step;
            count++;
        }
    }
    return count > 0 ? 1 / hypot(1, slope / count) : 0;
}

static void check_edges(struct checker *c)
{
    struct mesh_check *check = c->check;
    struct mesh_error *error = &check->error;
    double sum = 0;
    for (size_t i = 0; i < (size_t)check->columns * (check->rows - 1); i++) {
        const struct mesh_edge *edge = &c->truth->edges[i];
        const uint32_t column = (uint32_t)(i % check->columns);
        const double cosine = isnan(edge->row) ? 0 : find_cosine(c, column, edge_px(c, edge));
        if (!(cosine > 0)) {
            continue;
        }
        const double along = find_drawn_edge(c, column, edge);
        const bool is_lost = along > MESH_CHECK_MAX_EDGE;
        const double off = is_lost ? MESH_CHECK_MAX_EDGE : along * cosine;
        error->lost_edges += is_lost;
        error->edges++;
        error->edge_max = fmax(error->edge_max, off);
        sum += off * off;
    }
    error->edge_rms = error->edges > 0 ? sqrt(sum / error->edges) : 0;
}

// ---- all

static trl_result checker_init(const struct mesh_check_desc *desc, struct checker *c)
{
    const size_t count = (size_t)c->check->columns * c->check->rows;
    const uint32_t most = MAX_DRAWN_ROWS / c->check->rows;
    const uint32_t wanted = desc->step * desc->step;
    c->finer = (wanted < most ? wanted : most) | 1; // odd: one of the rows goes through the places
    c->fine_rows = c->check->rows * c->finer;
    c->drawn = mem_alloc(desc->ctx, count * c->finer, 4 * sizeof *c->drawn);
    return c->drawn ? TRL_OK : TRL_ERROR_MEMORY;
}

trl_result mesh_check_init(const struct mesh_check_desc *desc, const struct mesh_truth *truth,
                           struct mesh_check *out)
{
    uint32_t size[2];
    mesh_check_size(desc, size);
    *out = (struct mesh_check){.ctx = desc->ctx,
                               .camera = *desc->truth.camera,
                               .radius_m = desc->truth.radius_m,
                               .columns = size[0],
                               .rows = size[1],
                               .pixel = 2 * desc->truth.camera->tan_half_fov_y / desc->height};
    out->places = mem_alloc(desc->ctx, (size_t)size[0] * size[1], 4 * sizeof *out->places);
    struct checker c = {.desc = desc, .truth = truth, .check = out};
    trl_result result = out->places ? checker_init(desc, &c) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = draw(&c);
    }
    if (result == TRL_OK) {
        check_places(&c);
    }
    if (result == TRL_OK && truth) {
        count_holes(&c);
        check_edges(&c);
    }
    mem_free(desc->ctx, c.drawn);
    if (result != TRL_OK) {
        mesh_check_finish(out);
    }
    return result;
}

void mesh_check_finish(struct mesh_check *check)
{
    if (check->ctx) {
        mem_free(check->ctx, check->places);
    }
    *check = (struct mesh_check){0};
}
