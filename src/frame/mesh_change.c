// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/mesh_check.h"

#include <math.h>
#include <stdlib.h>

// Of `mesh_change.highest`.
static const double PART_BELOW = 0.999;
// The same ground is seen where distances agree this well; else something stands before it.
static const double SAME_RATIO = 0.05;

static const float *place_at(const struct mesh_check *check, size_t column, size_t row)
{
    return check->places + 4 * (row * check->columns + column);
}

// Drawn less true altitude at a point of the ground, between the four places around it; NAN where
// one of them shows something else.
static double rise_at(const struct mesh_check *check, struct vec3 point)
{
    const struct camera *camera = &check->camera;
    const struct vec3 at = vec3_sub(point, camera->position_m);
    const double z = vec3_dot(camera->forward, at);
    const double x = vec3_dot(camera->right, at) / (z * camera->tan_half_fov_x);
    const double y = vec3_dot(camera->up, at) / (z * camera->tan_half_fov_y);
    const double column = 0.5 * ((x + 1) * check->columns - 1);
    const double row = 0.5 * ((y + 1) * check->rows - 1);
    if (!(z > 0 && column >= 0 && row >= 0 && column < check->columns - 1.0 &&
          row < check->rows - 1.0)) {
        return (double)NAN;
    }
    const double distance = vec3_length(at);
    const size_t c = (size_t)column, r = (size_t)row;
    double sum = 0;
    for (size_t k = 0; k < 4; k++) {
        const float *place = place_at(check, c + k % 2, r + k / 2);
        const struct vec3 p = {(double)place[0], (double)place[1], (double)place[2]};
        if (!(fabs(vec3_length(p) - distance) < SAME_RATIO * distance)) {
            return (double)NAN;
        }
        const double across = k % 2 ? column - (double)c : 1 - (column - (double)c);
        const double along = k / 2 ? row - (double)r : 1 - (row - (double)r);
        sum += across * along * (double)place[3];
    }
    return sum;
}

// In pixels of `after`; NAN where the two show different things.
static double change_of(const struct mesh_check *before, const struct mesh_check *after,
                        const float *place)
{
    if (isnan(place[3])) {
        return (double)NAN;
    }
    const struct camera *camera = &after->camera;
    const struct vec3 at = {(double)place[0], (double)place[1], (double)place[2]};
    const struct vec3 drawn = vec3_add(camera->position_m, at);
    const struct vec3 up = vec3_normalize(drawn);
    const struct vec3 truth = vec3_sub(drawn, vec3_scale(up, (double)place[3]));
    const double change = (double)place[3] - rise_at(before, truth);
    const double distance = vec3_length(at);
    const double across = vec3_length(vec3_cross(up, at)) / distance;
    return fabs(change) * across / (vec3_dot(camera->forward, at) * after->pixel);
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

trl_result mesh_check_change(const struct mesh_check *before, const struct mesh_check *after,
                             struct mesh_change *out)
{
    *out = (struct mesh_change){0};
    const size_t count = (size_t)after->columns * after->rows;
    double *changes = mem_alloc(after->ctx, count, sizeof *changes);
    if (!changes) {
        return TRL_ERROR_MEMORY;
    }
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double change = change_of(before, after, after->places + 4 * i);
        if (!isnan(change)) {
            changes[out->places++] = change;
            sum += change * change;
        }
    }
    if (out->places > 0) {
        qsort(changes, out->places, sizeof *changes, compare_doubles);
        out->rms = sqrt(sum / out->places);
        out->highest = changes[(size_t)(PART_BELOW * (out->places - 1))];
    }
    mem_free(after->ctx, changes);
    return TRL_OK;
}
