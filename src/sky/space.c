// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/space.h"

#include "sky/airglow.h"
#include "sky/pixels.h"

#include <math.h>
#include <string.h>

// With the star higher than this for the eye the faint light between stars cannot be seen.
static const double DAY_MU = 0.05;

static trl_result load_stars(const struct space_desc *desc, struct space *out)
{
    const trl_context *ctx = desc->gpu->ctx;
    struct catalogue catalogue;
    trl_result result =
        catalogue_load(ctx, desc->catalogue_path, desc->limit_magnitude, &catalogue);
    if (result != TRL_OK) {
        return result;
    }
    const struct stars_desc stars = {.ctx = ctx,
                                     .extinction = &out->extinction,
                                     .catalogue = &catalogue,
                                     .pole_right_ascension_rad = desc->pole_right_ascension_rad,
                                     .pole_declination_rad = desc->pole_declination_rad};
    result = stars_init(&stars, &out->stars);
    trl_log(ctx, TRL_LOG_DEBUG, TRL_LOG_ITEM_SCENE, "%zu stars", catalogue.count);
    catalogue_finish(ctx, &catalogue);
    return result;
}

static trl_result make_background(struct space *space)
{
    const char *const bare[] = {"GROUND"};
    const char *const surface[] = {"GROUND", "SURFACE"};
    struct gpu_program_desc desc = {.vertex = "lib/layer.vert", .fragment = "sky/background.frag"};
    trl_result result = gpu_program_init(space->gpu, &desc, &space->background);
    if (result == TRL_OK) {
        desc.defines = bare;
        desc.define_count = 1;
        result = gpu_program_init(space->gpu, &desc, &space->ground_bare);
    }
    if (result == TRL_OK) {
        desc.defines = surface;
        desc.define_count = 2;
        result = gpu_program_init(space->gpu, &desc, &space->ground_surface);
    }
    return result;
}

trl_result space_init(const struct space_desc *desc, struct space *out)
{
    *out = (struct space){.gpu = desc->gpu,
                          .ground_radius_m = desc->medium->ground_radius_m,
                          .background_cd_m2 = desc->background_cd_m2,
                          .airglow_share = desc->airglow_share};
    memcpy(out->ground_albedo, desc->ground_albedo, sizeof out->ground_albedo);
    trl_result result = extinction_init(desc->gpu->ctx, desc->medium, &out->extinction);
    if (result == TRL_OK && desc->catalogue_path) {
        result = load_stars(desc, out);
    }
    if (result == TRL_OK) {
        const struct bodies_desc bodies = {desc->gpu, &out->extinction, desc->body_count,
                                           desc->bodies};
        bodies_init(&bodies, &out->bodies);
    }
    const size_t points = out->stars.count + out->bodies.count;
    if (result == TRL_OK && points > 0) {
        result = sprites_init(desc->gpu, points, &out->sprites);
    }
    if (result == TRL_OK && desc->background_cd_m2 > 0) {
        result = make_background(out);
    }
    if (result != TRL_OK) {
        space_finish(out);
    }
    return result;
}

void space_finish(struct space *space)
{
    gpu_program_finish(&space->background);
    gpu_program_finish(&space->ground_bare);
    gpu_program_finish(&space->ground_surface);
    sprites_finish(&space->sprites);
    bodies_finish(&space->bodies);
    stars_finish(&space->stars);
    extinction_finish(&space->extinction);
    *space = (struct space){0};
}

void space_change(struct space *space)
{
    extinction_change(&space->extinction);
}

static void set_vec3(struct gpu_program *program, const char *name, const double values[3],
                     double scale)
{
    sky_set_vec3(program, name,
                 (struct vec3){scale * values[0], scale * values[1], scale * values[2]});
}

// For an eye outside the air it is the same from everywhere.
static struct airglow find_airglow(const struct space *space)
{
    const struct extinction *e = &space->extinction;
    return airglow_find(e->radius_m < e->optics->top_radius_m ? space->airglow_share : 0, e);
}

static trl_result draw_layer(struct space *space, struct gpu_program *program, enum gpu_depth depth,
                             const struct sky_view *view)
{
    const struct gpu_pass pass = {.target = view->target,
                                  .state = {.depth = depth, .blend = GPU_BLEND_ADD}};
    gpu_program_set_float(program, "u_depth", 0.75f);
    gpu_pass_begin(space->gpu, &pass);
    return gpu_draw_fullscreen(program, "sky background");
}

static trl_result draw_sky(struct space *space, const struct sky_view *view,
                           const struct airglow *airglow)
{
    struct gpu_program *program = &space->background;
    const struct camera *camera = view->camera;
    const double even[3] = {1, 1, 1}, none[3] = {0, 0, 0};
    const float tan_half[2] = {(float)camera->tan_half_fov_x, (float)camera->tan_half_fov_y};
    const float layer[2] = {(float)airglow->share, (float)airglow->layer};
    set_vec3(program, "u_background", even, space->background_cd_m2);
    set_vec3(program, "u_depth_rgb", airglow->share > 0 ? airglow->depth : none, 1);
    gpu_program_set_vec2(program, "u_airglow", layer);
    gpu_program_set_vec2(program, "u_tan", tan_half);
    sky_set_axis(program, "u_zenith", camera, vec3_normalize(camera->position_m));
    return draw_layer(space, program, GPU_DEPTH_NEARER, view);
}

static trl_result draw_ground(struct space *space, const struct sky_view *view,
                              const struct airglow *airglow)
{
    struct gpu_program *program =
        sky_view_is_bare(view) ? &space->ground_bare : &space->ground_surface;
    double mean[3];
    airglow_mean(airglow, mean);
    set_vec3(program, "u_background", mean, space->background_cd_m2);
    gpu_program_set_vec3(program, "u_ground_albedo", space->ground_albedo);
    if (view->surface.albedo) {
        gpu_program_set_texture(program, "u_albedo", view->surface.albedo);
    }
    return draw_layer(space, program, GPU_DEPTH_FARTHER, view);
}

static trl_result draw_background(struct space *space, const struct sky_view *view)
{
    const struct vec3 zenith = vec3_normalize(view->camera->position_m);
    if (!(space->background_cd_m2 > 0) || vec3_dot(zenith, view->camera->sun_direction) > DAY_MU) {
        return TRL_OK;
    }
    const struct airglow airglow = find_airglow(space);
    const trl_result result = draw_sky(space, view, &airglow);
    return result == TRL_OK ? draw_ground(space, view, &airglow) : result;
}

trl_result space_draw(struct space *space, const struct sky_view *view, double sidereal_rad)
{
    const struct camera *camera = view->camera;
    extinction_update(&space->extinction, fmax(vec3_length(camera->position_m),
                                               space->ground_radius_m + SKY_MIN_ALTITUDE_M));
    trl_result result = draw_background(space, view);
    if (result == TRL_OK) {
        const struct bodies_view bodies = {camera, view->target};
        result = bodies_draw(&space->bodies, &bodies);
        bodies_add(&space->bodies, &bodies, &space->sprites);
    }
    if (result == TRL_OK) {
        const struct stars_view stars = {.camera = camera,
                                         .sidereal_rad = sidereal_rad,
                                         .extinction = &space->extinction,
                                         .target = view->target};
        stars_add(&space->stars, &stars, &space->sprites);
        result = sprites_draw(&space->sprites, view->target);
    }
    return result;
}
