// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/impostor.h"

#include "shared/shared.glsl"
#include "terrain/depth.h"

#include <math.h>

// Of the ground's whole range of heights, as seen from the viewer.
static const double MOST_PIXELS_OF_RELIEF = 0.25;

trl_result impostor_init(const struct surface *surface, struct impostor *out)
{
    *out = (struct impostor){.surface = surface};
    return height_programs_init(surface, "terrain/impostor.frag", &out->programs);
}

void impostor_finish(struct impostor *impostor)
{
    height_programs_finish(&impostor->programs);
    *impostor = (struct impostor){0};
}

bool impostor_is_enough(const struct impostor *impostor, const struct sampling_camera *sampling,
                        double pixel_rad, double pixels)
{
    const struct surface *surface = impostor->surface;
    const double relief_m = surface_max_altitude(surface) - surface_min_altitude(surface);
    const double nearest_m =
        sampling->distance_m - surface->radius_m - surface_max_altitude(surface);
    const double disc = sampling->top_rad / pixel_rad;
    return nearest_m > 0 && relief_m < MOST_PIXELS_OF_RELIEF * pixel_rad * nearest_m &&
           SHARED_PI * disc * disc < pixels;
}

// Picture coordinates, -1 to 1, between which a cone around `axis` lies along one axis of the
// picture; `aside` and `ahead` are components of `axis`.
static void bound_cone(double aside, double ahead, double cone_rad, double tan_half, double out[2])
{
    const double length = hypot(aside, ahead);
    const double half = asin(fmin(1, sin(cone_rad) / fmax(length, 1e-9)));
    const double middle = atan2(aside, ahead);
    const double most = 1.5; // rad; beyond, it reaches out of any picture
    out[0] = tan(fmax(-most, fmin(most, middle - half))) / tan_half;
    out[1] = tan(fmax(-most, fmin(most, middle + half))) / tan_half;
}

static void clip_pixels(const double range[2], uint32_t size, uint32_t *first, uint32_t *count)
{
    const double low = floor((0.5 + 0.5 * range[0]) * size) - 1;
    const double high = ceil((0.5 + 0.5 * range[1]) * size) + 1;
    const double from = fmin(fmax(low, 0), size - 1.0);
    *first = (uint32_t)from;
    *count = (uint32_t)fmax(fmin(high, size) - from, 1);
}

// Pixels that may show the planet.
static struct gpu_rect find_rect(const struct impostor_view *view, const struct gpu_target *target)
{
    const struct sampling_camera *s = view->sampling;
    double x[2];
    double y[2];
    bound_cone(-s->right.z, -s->forward.z, s->top_rad, s->tan_half_fov_x, x);
    bound_cone(-s->up.z, -s->forward.z, s->top_rad, s->tan_half_fov_y, y);
    struct gpu_rect rect;
    clip_pixels(x, target->width, &rect.x, &rect.width);
    clip_pixels(y, target->height, &rect.y, &rect.height);
    return rect;
}

static void bind_view(const struct impostor *impostor, const struct impostor_view *view,
                      double pixel_rad, struct gpu_program *program)
{
    const struct surface *surface = impostor->surface;
    const struct sampling_camera *s = view->sampling;
    const struct vec3 columns[3] = {vec3_scale(s->right, s->tan_half_fov_x),
                                    vec3_scale(s->up, s->tan_half_fov_y), s->forward};
    float local_from_view[9];
    for (int i = 0; i < 3; i++) {
        local_from_view[3 * i] = (float)columns[i].x;
        local_from_view[3 * i + 1] = (float)columns[i].y;
        local_from_view[3 * i + 2] = (float)columns[i].z;
    }
    float planet_from_local[9];
    anchor_planet_from_local(&s->anchor, planet_from_local);
    const double altitude_m = s->distance_m - surface->radius_m;
    const float distance[3] = {
        (float)altitude_m, (float)surface->radius_m,
        (float)(0.5 * (surface_min_altitude(surface) + surface_max_altitude(surface)))};
    gpu_program_set_vec3(program, "u_distance", distance);
    gpu_program_set_float(program, "u_log2_footprint", (float)log2(altitude_m * pixel_rad));
    gpu_program_set_mat3(program, "u_local_from_view", local_from_view);
    gpu_program_set_mat3(program, "u_planet_from_local", planet_from_local);
}

trl_result impostor_draw(struct impostor *impostor, const struct impostor_view *view,
                         const struct gpu_target *target)
{
    const struct depth_ranges ranges = depth_ranges_make(impostor->surface, view->camera);
    depth_range_begin(&ranges, 0, target, GPU_CULL_NONE); // the far one, if there are two
    const double pixel_rad = 2 * view->camera->tan_half_fov_y / target->height;
    struct surface_eye layers = sampling_camera_eye(view->sampling, impostor->surface);
    layers.least_rad = pixel_rad;
    struct gpu_program *program =
        height_programs_bind(&impostor->programs, &layers, &view->sampling->anchor);
    depth_range_bind(&ranges.of[0], program);
    bind_view(impostor, view, pixel_rad, program);
    const struct gpu_pass pass = {.target = target,
                                  .scissor = find_rect(view, target),
                                  .state = {.depth = GPU_DEPTH_NEARER, .writes_depth = true}};
    gpu_pass_begin(impostor->surface->gpu, &pass);
    return gpu_draw_fullscreen(program, "impostor");
}
