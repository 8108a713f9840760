// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/mesh_truth.h"

#include "reference/rows.h"

#include <math.h>

// Neighbouring places whose distances differ by more than this factor may have a silhouette between
// them; what still does so at a hundredth of a pixel is one.
static const double EDGE_RATIO = 1.25;
static const double SURE_EDGE_RATIO = 1.1;
static const double EDGE_PRECISION_PX = 0.01;

trl_result mesh_truth_init(const trl_context *ctx, const struct reference_caster *caster,
                           const uint32_t size[2], struct mesh_truth *out)
{
    *out = (struct mesh_truth){.ctx = ctx, .columns = size[0], .rows = size[1]};
    out->hits = mem_alloc(ctx, (size_t)size[0] * size[1], sizeof *out->hits);
    const trl_result result =
        out->hits ? reference_caster_picture(ctx, caster, size, out->hits) : TRL_ERROR_MEMORY;
    if (result != TRL_OK) {
        mesh_truth_finish(out);
    }
    return result;
}

void mesh_truth_finish(struct mesh_truth *truth)
{
    if (truth->ctx) {
        mem_free(truth->ctx, truth->hits);
        mem_free(truth->ctx, truth->edges);
    }
    *truth = (struct mesh_truth){0};
}

// The two neighbouring places that a silhouette is looked for between.
struct search {
    const struct reference_caster *caster;
    const struct mesh_truth *truth;
    uint32_t column;
    double row[2];
    double distance_m[2]; // INFINITY: none, or none that is near
    struct mesh_edge edge;
};

static double cast_between(const struct search *s, double row, double length_m)
{
    const uint32_t size[2] = {s->truth->columns, s->truth->rows};
    return reference_caster_ray(s->caster, reference_caster_point(size, s->column, row), length_m);
}

// Halves until the sides are as near as can be seen. What is far of a side is known when nothing is
// near: its rays need not be followed to their end.
static void close_in(struct search *s)
{
    const double rows_per_px =
        s->truth->rows * s->caster->pixel_rad / (2 * s->caster->camera->tan_half_fov_y);
    while (s->row[1] - s->row[0] > EDGE_PRECISION_PX * rows_per_px) {
        const double middle = 0.5 * (s->row[0] + s->row[1]);
        const double distance_m = cast_between(s, middle, s->edge.parting_m);
        const bool is_near = distance_m < s->edge.parting_m;
        const int side = is_near == s->edge.is_near_below ? 0 : 1;
        s->row[side] = middle;
        s->distance_m[side] = distance_m;
    }
}

// Whether what parts the places is a silhouette and no slope.
static bool is_sure(struct search *s)
{
    const int far = s->edge.is_near_below ? 1 : 0;
    if (isinf(s->distance_m[far]) && isfinite(s->edge.parting_m)) {
        const double reach_m = SURE_EDGE_RATIO * s->distance_m[1 - far];
        s->distance_m[far] = cast_between(s, s->row[far], reach_m);
    }
    return s->distance_m[far] > SURE_EDGE_RATIO * s->distance_m[1 - far];
}

static struct mesh_edge find_edge(const struct reference_caster *caster,
                                  const struct mesh_truth *truth, uint32_t column, uint32_t row)
{
    const struct reference_hit *hit = &truth->hits[(size_t)row * truth->columns + column];
    struct search s = {.caster = caster,
                       .truth = truth,
                       .column = column,
                       .row = {row, row + 1.0},
                       .distance_m = {hit->distance_m, hit[truth->columns].distance_m}};
    const double low = fmin(s.distance_m[0], s.distance_m[1]);
    const double high = fmax(s.distance_m[0], s.distance_m[1]);
    s.edge.row = (double)NAN;
    if (!(high > EDGE_RATIO * low) || isinf(low)) {
        return s.edge;
    }
    s.edge.parting_m = isinf(high) ? (double)INFINITY : sqrt(low * high);
    s.edge.is_near_below = s.distance_m[0] < s.distance_m[1];
    close_in(&s);
    s.edge.row = is_sure(&s) ? (s.row[0] + s.row[1] + 1) / 2 : (double)NAN;
    return s.edge;
}

struct silhouettes {
    const struct reference_caster *caster;
    struct mesh_truth *truth;
};

static void find_row(void *user, uint32_t row)
{
    const struct silhouettes *s = user;
    for (uint32_t column = 0; column < s->truth->columns; column++) {
        s->truth->edges[(size_t)row * s->truth->columns + column] =
            row + 1 < s->truth->rows ? find_edge(s->caster, s->truth, column, row)
                                     : (struct mesh_edge){.row = (double)NAN};
    }
}

trl_result mesh_truth_find_edges(struct mesh_truth *truth, const struct reference_caster *caster)
{
    if (truth->edges) {
        return TRL_OK;
    }
    const size_t count = (size_t)truth->columns * truth->rows;
    truth->edges = mem_alloc(truth->ctx, count, sizeof *truth->edges);
    if (!truth->edges) {
        return TRL_ERROR_MEMORY;
    }
    struct silhouettes s = {caster, truth};
    const trl_result result =
        reference_rows(truth->ctx, "looking for silhouettes", truth->rows, find_row, &s);
    if (result != TRL_OK) {
        mem_free(truth->ctx, truth->edges);
        truth->edges = NULL;
    }
    return result;
}
