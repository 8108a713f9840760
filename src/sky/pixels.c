// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/pixels.h"

#include "spectrum/cie.h"

#include <math.h>

trl_result sky_pixels_init(const struct sky_desc *desc, double disc_rad, struct sky_pixels *out)
{
    *out = (struct sky_pixels){.gpu = desc->gpu,
                               .ground_radius_m = desc->medium->ground_radius_m,
                               .top_radius_m = desc->medium->top_radius_m,
                               .has_sea = desc->sea && desc->sea->is_there,
                               .disc_rad = disc_rad,
                               .shown_rad = disc_rad};
    const char *const surface[] = {"SURFACE", "SEA"};
    struct gpu_program_desc program = {.vertex = "lib/layer.vert", .fragment = "sky/sort.frag"};
    trl_result result = gpu_program_init(desc->gpu, &program, &out->sort_bare);
    if (result == TRL_OK) {
        program.defines = surface;
        program.define_count = out->has_sea ? 2 : 1;
        result = gpu_program_init(desc->gpu, &program, &out->sort_surface);
    }
    if (result == TRL_OK) {
        result = gpu_hide_init(desc->gpu, &out->hide);
    }
    if (result != TRL_OK) {
        sky_pixels_finish(out);
    }
    return result;
}

void sky_pixels_finish(struct sky_pixels *pixels)
{
    gpu_program_finish(&pixels->sort_bare);
    gpu_program_finish(&pixels->sort_surface);
    gpu_hide_finish(&pixels->hide);
    *pixels = (struct sky_pixels){0};
}

bool sky_view_is_bare(const struct sky_view *view)
{
    return !view->surface.position;
}

double sky_pixels_eye_radius(const struct sky_pixels *pixels, const struct camera *camera)
{
    return fmax(vec3_length(camera->position_m), pixels->ground_radius_m + SKY_MIN_ALTITUDE_M);
}

double sky_reach_rad(double ground_radius_m, double eye_m, double height_m)
{
    return acos(fmin(ground_radius_m / eye_m, 1)) +
           acos(ground_radius_m / (ground_radius_m + fmax(height_m, 0)));
}

void sky_set_vec3(struct gpu_program *program, const char *name, struct vec3 v)
{
    const float values[3] = {(float)v.x, (float)v.y, (float)v.z};
    gpu_program_set_vec3(program, name, values);
}

void sky_set_vec4(struct gpu_program *program, const char *name, double x, double y, double z,
                  double w)
{
    const float values[4] = {(float)x, (float)y, (float)z, (float)w};
    gpu_program_set_vec4(program, name, values);
}

void sky_set_bands(struct gpu_program *program, const struct bands *bands,
                   const struct optics *optics, double lights_cd_m2)
{
    float rgb_from_bands[12];
    float bands_from_rgb[12];
    float bands_of_light[12];
    for (int k = 0; k < 3; k++) {
        double star_cd_m2 = 0; // what all bands together show
        for (int r = 0; r < BAND_COUNT; r++) {
            star_cd_m2 += (double)bands->rgb_from_bands[k][r];
        }
        const float scale = star_cd_m2 > 0 ? (float)(lights_cd_m2 / star_cd_m2) : 0;
        for (int r = 0; r < BAND_COUNT; r++) {
            rgb_from_bands[4 * k + r] = bands->rgb_from_bands[k][r];
            bands_from_rgb[4 * k + r] = bands->bands_from_rgb[r][k];
            bands_of_light[4 * k + r] = scale * bands->bands_from_rgb[r][k];
        }
    }
    gpu_program_set_vec4s(program, "u_rgb_from_bands", rgb_from_bands, 3);
    gpu_program_set_vec4s(program, "u_bands_from_rgb", bands_from_rgb, 3);
    gpu_program_set_vec4s(program, "u_bands_of_light", bands_of_light, 3);
    const lanes *albedo = &optics->ground_albedo;
    sky_set_vec4(program, "u_ground_albedo", (double)(*albedo)[bands->lane[0]],
                 (double)(*albedo)[bands->lane[1]], (double)(*albedo)[bands->lane[2]],
                 (double)(*albedo)[bands->lane[3]]);
}

void sky_set_primaries(struct gpu_program *program, const double factors[3])
{
    float rgb_from_xyz[12] = {0};
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            rgb_from_xyz[4 * k + i] = (float)(factors[k] * cie_rgb_from_xyz[k][i]);
        }
    }
    gpu_program_set_vec4s(program, "u_rgb_from_xyz", rgb_from_xyz, 3);
}

void sky_set_axis(struct gpu_program *program, const char *name, const struct camera *camera,
                  struct vec3 axis)
{
    sky_set_vec3(program, name,
                 (struct vec3){vec3_dot(axis, camera->forward),
                               vec3_dot(axis, camera->right) * camera->tan_half_fov_x,
                               vec3_dot(axis, camera->up) * camera->tan_half_fov_y});
}

trl_result sky_make_map(struct gpu *gpu, const char *label, const uint32_t size[3],
                        const float *texels, struct gpu_texture *out)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = label;
    desc.shape = size[2] > 1 ? GPU_SHAPE_3D : GPU_SHAPE_2D;
    desc.format = GPU_FORMAT_RGBA32F;
    desc.width = size[0];
    desc.height = size[1];
    desc.depth = size[2];
    desc.data = texels;
    return gpu_texture_init(gpu, &desc, out);
}

void sky_pixels_set_deck(struct gpu_program *program, const struct sky_view *view)
{
    gpu_program_set_texture(program, "u_deck", view->cloud_deck);
    gpu_program_set_vec4(program, "u_deck_map", view->cloud_deck_place);
}

void sky_pixels_set_view(const struct sky_pixels *pixels, struct gpu_program *program,
                         const struct sky_view *view)
{
    const struct camera *camera = view->camera;
    const double ground = pixels->ground_radius_m;
    const double top = pixels->top_radius_m;
    const double radius_m = sky_pixels_eye_radius(pixels, camera);
    const struct vec3 up = vec3_normalize(camera->position_m);
    sky_set_vec3(program, "u_eye_up", up);
    sky_set_vec3(program, "u_sun", camera->sun_direction);
    sky_set_vec3(program, "u_forward", camera->forward);
    sky_set_vec3(program, "u_right", vec3_scale(camera->right, camera->tan_half_fov_x));
    sky_set_vec3(program, "u_up", vec3_scale(camera->up, camera->tan_half_fov_y));
    sky_set_vec4(program, "u_eye", radius_m, radius_m - ground, vec3_dot(up, camera->sun_direction),
                 radius_m > top);
    sky_set_vec4(program, "u_planet", ground, top - ground, sqrt((top - ground) * (top + ground)),
                 0);
    sky_set_vec3(program, "u_disc",
                 (struct vec3){cos(pixels->disc_rad), sin(pixels->disc_rad),
                               2 * camera->tan_half_fov_y / view->target->height});
}

static void set_surface(struct gpu_program *program, const struct sky_surface *surface)
{
    gpu_program_set_texture(program, "u_position", surface->position);
    gpu_program_set_texture(program, "u_albedo", surface->albedo);
    gpu_program_set_texture(program, "u_normal", surface->normal);
    gpu_program_set_texture(program, "u_lights", surface->lights);
    gpu_program_set_texture(program, "u_region", surface->region);
}

// From far off the axis a disc looks longer: outward it reaches from the tangent of the angle to
// that of the angle and the disc's.
struct gpu_rect sky_find_disc(const struct camera *camera, const struct gpu_target *target,
                              struct vec3 direction, double radius_rad)
{
    const double pixel_rad = 2 * camera->tan_half_fov_y / target->height;
    const double disc_rad = radius_rad + pixel_rad;
    const double along = vec3_dot(direction, camera->forward);
    const double off_rad = acos(fmax(-1, fmin(1, along)));
    if (off_rad - disc_rad > M_PI / 2) {
        return (struct gpu_rect){0};
    }
    if (off_rad + disc_rad > 0.49 * M_PI) {
        return (struct gpu_rect){0, 0, target->width, target->height};
    }
    const double reach = tan(off_rad + disc_rad) - tan(off_rad);
    const double x = vec3_dot(direction, camera->right) / along;
    const double y = vec3_dot(direction, camera->up) / along;
    const double half_width = 0.5 * target->width / camera->tan_half_fov_x; // pixels
    const double half_height = 0.5 * target->height / camera->tan_half_fov_y;
    const double left = fmax(0, 0.5 * target->width + (x - reach) * half_width - 1);
    const double right = fmin(target->width, 0.5 * target->width + (x + reach) * half_width + 1);
    const double low = fmax(0, 0.5 * target->height + (y - reach) * half_height - 1);
    const double high = fmin(target->height, 0.5 * target->height + (y + reach) * half_height + 1);
    if (left >= right || low >= high) {
        return (struct gpu_rect){0};
    }
    return (struct gpu_rect){(uint32_t)left, (uint32_t)low, (uint32_t)ceil(right) - (uint32_t)left,
                             (uint32_t)ceil(high) - (uint32_t)low};
}

// Of sort.frag, between those at which sky_pixels_draw draws.
static const float HIDDEN_DEPTH = 0.8125f;

trl_result sky_pixels_sort(struct sky_pixels *pixels, const struct sky_view *view)
{
    const bool is_bare = sky_view_is_bare(view);
    struct gpu_program *program = is_bare ? &pixels->sort_bare : &pixels->sort_surface;
    const struct gpu_pass pass = {.target = view->target,
                                  .state = {.writes_depth = true, .hides_color = true},
                                  .clears_color = true,
                                  .color = {0, 0, 0, 1}};
    sky_pixels_set_view(pixels, program, view);
    if (!is_bare) {
        gpu_program_set_texture(program, "u_position", view->surface.position);
        gpu_program_set_texture(program, "u_albedo", view->surface.albedo);
    }
    gpu_program_set_float(program, "u_depth", 0.5f);
    gpu_pass_begin(pixels->gpu, &pass);
    const trl_result result = gpu_draw_fullscreen(program, "sky");
    return result == TRL_OK ? gpu_hide_draw(&pixels->hide, view->hidden, HIDDEN_DEPTH, view->target)
                            : result;
}

trl_result sky_pixels_draw(const struct sky_pixels *pixels, struct gpu_program *program,
                           enum sky_kind kind, const struct sky_view *view)
{
    struct gpu_pass pass = {.target = view->target,
                            .state = {.depth = GPU_DEPTH_NEARER,
                                      .blend = view->is_added || kind == SKY_KIND_SEA
                                                   ? GPU_BLEND_ADD
                                                   : GPU_BLEND_NONE}};
    if (kind == SKY_KIND_STAR) {
        const struct camera *camera = view->camera;
        pass.scissor =
            sky_find_disc(camera, view->target, camera->sun_direction, pixels->shown_rad);
        if (pass.scissor.width == 0) {
            return TRL_OK;
        }
    }
    sky_pixels_set_view(pixels, program, view);
    if (kind == SKY_KIND_GROUND || kind == SKY_KIND_SEA) {
        pass.state.depth = GPU_DEPTH_FARTHER;
        if (!sky_view_is_bare(view)) {
            set_surface(program, &view->surface);
        }
    }
    // Between the depths of sort.frag: air is at 0, space at 1/2, what is hidden at 13/16, ground
    // at 7/8 or above, water at 1.
    static const float DEPTHS[] = {[SKY_KIND_AIR] = 0.25f,
                                   [SKY_KIND_STAR] = 0.75f,
                                   [SKY_KIND_GROUND] = 0.84375f,
                                   [SKY_KIND_SEA] = 0.9375f};
    gpu_program_set_float(program, "u_depth", DEPTHS[kind]);
    const struct gpu_condition *condition = kind == SKY_KIND_SEA ? view->surface.has_water : NULL;
    gpu_condition_begin(condition);
    gpu_pass_begin(pixels->gpu, &pass);
    const trl_result result = gpu_draw_fullscreen(program, "sky");
    gpu_condition_end(condition);
    return result;
}
