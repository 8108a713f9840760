// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/bodies.h"

#include "sky/pixels.h"

#include <math.h>

// Discs of a smaller radius are points.
static const double SMALLEST_PX = 2;

// Samples on the radius of a disc, so that a thin crescent keeps its light, and at least so many
// across a pixel.
enum { RADIUS_SAMPLES = 64, PIXEL_SAMPLES = 2 };

void bodies_init(const struct bodies_desc *desc, struct bodies *out)
{
    *out = (struct bodies){.gpu = desc->gpu, .extinction = desc->extinction, .count = desc->count};
    const struct medium *medium = desc->extinction->optics->medium;
    const lanes star = extinction_sample(desc->extinction, &medium->star_irradiance);
    for (size_t i = 0; i < desc->count; i++) {
        const lanes albedo = extinction_sample(desc->extinction, desc->bodies[i].geometric_albedo);
        out->bodies[i] = (struct body){.reflected = star * albedo, .law = desc->bodies[i].law};
    }
}

void bodies_finish(struct bodies *bodies)
{
    for (size_t i = 0; i < bodies->count; i++) {
        gpu_texture_finish(&bodies->bodies[i].light);
    }
    gpu_program_finish(&bodies->program);
    *bodies = (struct bodies){0};
}

// Radius in pixels; the picture's axis has the smallest ones.
static bool is_disc(const struct bodies_view *view, const struct body_sight *sight)
{
    const double pixel = 2 * view->camera->tan_half_fov_y / view->target->height;
    return sight->sine >= SMALLEST_PX * pixel;
}

static trl_result make_light(struct bodies *bodies, struct body *body)
{
    if (body->light.name) {
        return TRL_OK;
    }
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "light of a body";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = EXTINCTION_ROWS;
    desc.height = 1;
    return gpu_texture_init(bodies->gpu, &desc, &body->light);
}

static trl_result update_light(struct bodies *bodies, struct body *body)
{
    const struct extinction *extinction = bodies->extinction;
    if (body->version == extinction->version) {
        return TRL_OK;
    }
    trl_result result = make_light(bodies, body);
    float texels[EXTINCTION_ROWS][4];
    for (int row = 0; row < EXTINCTION_ROWS; row++) {
        const lanes left = body->reflected * lanes_exp_negative(-extinction->depth[row]);
        const struct cie_rgb rgb = extinction_colour(extinction, &left);
        texels[row][0] = (float)rgb.r;
        texels[row][1] = (float)rgb.g;
        texels[row][2] = (float)rgb.b;
        texels[row][3] = 1;
    }
    if (result == TRL_OK) {
        const struct gpu_region all = gpu_texture_region(&body->light, 0);
        result = gpu_texture_upload(&body->light, &all, texels);
    }
    body->version = result == TRL_OK ? extinction->version : 0;
    return result;
}

// Toward the star, at a right angle to the line of sight; any such direction at full and new.
static struct vec3 find_lit_side(const struct camera *camera, const struct body_sight *sight)
{
    const struct vec3 across =
        vec3_sub(camera->sun_direction,
                 vec3_scale(sight->direction, vec3_dot(sight->direction, camera->sun_direction)));
    const struct vec3 other =
        fabs(sight->direction.z) < 0.7 ? (struct vec3){0, 0, 1} : (struct vec3){1, 0, 0};
    return vec3_normalize(vec3_length(across) > 1e-9 ? across
                                                     : vec3_cross(sight->direction, other));
}

static void set_view(struct bodies *bodies, const struct body *body, const struct bodies_view *view,
                     const struct body_sight *sight)
{
    struct gpu_program *program = &bodies->program;
    const struct camera *camera = view->camera;
    const struct extinction *extinction = bodies->extinction;
    const struct vec3 lit = find_lit_side(camera, sight);
    const float pixel[2] = {2.0f / (float)view->target->width, 2.0f / (float)view->target->height};
    const float law[2] = {(float)(body_phase_scale(body->law, sight->phase_angle_rad) / M_PI),
                          body->law == BODY_LAMBERT};
    const double pixel_radii = 2 * camera->tan_half_fov_y / view->target->height / sight->sine;
    const int samples = (int)fmax(ceil(RADIUS_SAMPLES * pixel_radii), PIXEL_SAMPLES);
    sky_set_axis(program, "u_lit", camera, lit);
    sky_set_axis(program, "u_side", camera, vec3_cross(sight->direction, lit));
    sky_set_axis(program, "u_centre", camera, sight->direction);
    sky_set_axis(program, "u_zenith", camera, vec3_normalize(camera->position_m));
    gpu_program_set_vec2(program, "u_pixel", pixel);
    gpu_program_set_int(program, "u_samples", samples);
    sky_set_vec4(program, "u_body", sight->sine, pixel_radii / samples, sin(sight->phase_angle_rad),
                 cos(sight->phase_angle_rad));
    sky_set_vec3(program, "u_rows",
                 (struct vec3){extinction->horizon_mu,
                               fmax(extinction->highest_mu - extinction->horizon_mu, 1e-12),
                               EXTINCTION_ROWS - 1});
    gpu_program_set_vec2(program, "u_law", law);
    gpu_program_set_texture(program, "u_light", &body->light);
    gpu_program_set_float(program, "u_depth", 0.75f);
}

static trl_result draw_disc(struct bodies *bodies, struct body *body,
                            const struct bodies_view *view, const struct body_sight *sight)
{
    const struct gpu_pass pass = {
        .target = view->target,
        .scissor = sky_find_disc(view->camera, view->target, sight->direction, asin(sight->sine)),
        .state = {.depth = GPU_DEPTH_NEARER, .blend = GPU_BLEND_ADD}};
    if (pass.scissor.width == 0) {
        return TRL_OK;
    }
    trl_result result = update_light(bodies, body);
    if (result == TRL_OK && !bodies->program.name) {
        const struct gpu_program_desc desc = {.vertex = "lib/layer.vert",
                                              .fragment = "sky/body.frag"};
        result = gpu_program_init(bodies->gpu, &desc, &bodies->program);
    }
    if (result != TRL_OK) {
        return result;
    }
    set_view(bodies, body, view, sight);
    gpu_pass_begin(bodies->gpu, &pass);
    return gpu_draw_fullscreen(&bodies->program, "body");
}

trl_result bodies_draw(struct bodies *bodies, const struct bodies_view *view)
{
    trl_result result = TRL_OK;
    for (unsigned i = 0; i < view->camera->body_count && result == TRL_OK; i++) {
        const struct camera_body *place = &view->camera->bodies[i];
        const struct body_sight sight = body_see(view->camera, place);
        if (is_disc(view, &sight)) {
            result = draw_disc(bodies, &bodies->bodies[place->index], view, &sight);
        }
    }
    return result;
}

void bodies_add(const struct bodies *bodies, const struct bodies_view *view,
                struct sprites *sprites)
{
    const struct sprite_frame frame = sprite_frame_make(view->camera, view->target);
    const struct vec3 zenith = vec3_normalize(view->camera->position_m);
    for (unsigned i = 0; i < view->camera->body_count; i++) {
        const struct body *body = &bodies->bodies[view->camera->bodies[i].index];
        const struct body_sight sight = body_see(view->camera, &view->camera->bodies[i]);
        const double mu = vec3_dot(sight.direction, zenith);
        struct sprite_place place;
        if (is_disc(view, &sight) || extinction_is_hidden(bodies->extinction, mu) ||
            !sprite_find(&frame, sight.direction, &place)) {
            continue;
        }
        const lanes left = body->reflected * extinction_at(bodies->extinction, mu) *
                           (float)body_share(body->law, &sight);
        sprites_add(sprites, &frame, &place, extinction_colour(bodies->extinction, &left));
    }
}
