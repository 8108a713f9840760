// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "cloud/history.h"

#include <string.h>

// A frame that shows another part of the sky, other light or later clouds is a cut. Turns: cosine
// of 30 degrees; the star: 0.01 degrees.
static const double LEAST_TURN_COSINE = 0.866, LEAST_SUN_COSINE = 1 - 1.5e-8;
static const double MOST_PAUSE_S = 10, LEAST_MOVE_M = 200, MOST_MOVE = 0.5, MOST_ZOOM = 0.02;

static double find_zoom(const struct camera *a, const struct camera *b)
{
    return fabs(a->tan_half_fov_y / b->tan_half_fov_y - 1) +
           fabs(a->tan_half_fov_x / b->tan_half_fov_x - 1);
}

bool cloud_history_holds(const struct cloud_history *history, const struct cloud_moment *moment)
{
    if (!history->is_kept) {
        return false;
    }
    const struct camera *now = moment->camera;
    const struct camera *past = &history->camera;
    const double moved_m = vec3_length(vec3_sub(now->position_m, past->position_m));
    return moved_m <= fmax(LEAST_MOVE_M, MOST_MOVE * moment->far_m) &&
           vec3_dot(now->forward, past->forward) >= LEAST_TURN_COSINE &&
           vec3_dot(now->up, past->up) >= LEAST_TURN_COSINE &&
           vec3_dot(now->sun_direction, past->sun_direction) >= LEAST_SUN_COSINE &&
           find_zoom(now, past) <= MOST_ZOOM &&
           fabs(moment->time_s - history->time_s) <= MOST_PAUSE_S;
}

void cloud_history_keep(struct cloud_history *history, const struct cloud_moment *moment)
{
    history->is_kept = true;
    history->camera = *moment->camera;
    history->time_s = moment->time_s;
}

void cloud_history_forget(struct cloud_history *history)
{
    cloud_rays_finish(&history->fresh);
    history->is_kept = false;
}

trl_result cloud_history_begin(struct gpu *gpu, struct cloud_history *history,
                               const struct cloud_rays *whole, float grid[3])
{
    static const float quarters[4][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    grid[0] = quarters[history->turn % 4][0];
    grid[1] = quarters[history->turn % 4][1];
    grid[2] = 2;
    history->turn++;
    if (history->fresh.target.gpu) {
        return TRL_OK;
    }
    return cloud_rays_init(gpu, "a quarter of the clouds", (whole->clouds.width + 1) / 2,
                           (whole->clouds.height + 1) / 2, &history->fresh);
}

static void set_axis(struct gpu_program *program, const char *name, struct vec3 axis, double scale)
{
    const float value[3] = {(float)(axis.x * scale), (float)(axis.y * scale),
                            (float)(axis.z * scale)};
    gpu_program_set_vec3(program, name, value);
}

// To the bit, as where nothing moves.
static bool is_still(const struct camera *a, const struct camera *b)
{
    return memcmp(&a->position_m, &b->position_m, sizeof a->position_m) == 0 &&
           memcmp(&a->forward, &b->forward, sizeof a->forward) == 0 &&
           memcmp(&a->up, &b->up, sizeof a->up) == 0 && find_zoom(a, b) <= 0;
}

void cloud_history_set(struct cloud_history *history, const struct camera *camera,
                       const float grid[3], const struct cloud_rays *past)
{
    struct gpu_program *program = &history->gather;
    const struct camera *before = &history->camera;
    gpu_program_set_vec3(program, "u_grid", grid);
    gpu_program_set_texture(program, "u_fresh", &history->fresh.clouds);
    gpu_program_set_texture(program, "u_fresh_ends", &history->fresh.ends);
    gpu_program_set_texture(program, "u_past", &past->clouds);
    set_axis(program, "u_moved", vec3_sub(camera->position_m, before->position_m), 1);
    set_axis(program, "u_past_forward", before->forward, 1);
    set_axis(program, "u_past_right", before->right, 1 / before->tan_half_fov_x);
    set_axis(program, "u_past_up", before->up, 1 / before->tan_half_fov_y);
    gpu_program_set_float(program, "u_is_still", is_still(camera, before) ? 1.0f : 0.0f);
}
