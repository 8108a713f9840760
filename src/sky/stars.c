// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/stars.h"

#include "spectrum/starlight.h"

#include <math.h>

// A star of the catalogue with its spectrum.
struct star {
    struct vec3 direction; // ICRS
    double illuminance_lx; // above the air
    lanes irradiance;      // W m^-2 nm^-1
};

// What is drawn of one, as star.vert reads it.
struct star_sprite {
    float centre_px[2]; // from the lower left corner
    float light[3];     // linear sRGB, cd m^-2 if all of it were in one pixel
    float halo;         // share that goes into the wide part of the spread
};

// Half widths in pixels of what is drawn: of the kernel, and of the same kernel HALO_WIDTH times
// as wide.
static const float CORE_HALF_PX = 1.5f;
enum { HALO_WIDTH = 4 };

// Lens and eye scatter a part of the light around a point: it is what makes bright stars look
// large. Below this illuminance nobody could see it, and it stays in the core.
static const double HALO_SHARE = 0.2;
static const double HALO_FROM_LX = 2.54e-6 * 0.025; // magnitude 4

static void set_axes(struct stars *stars, double right_ascension_rad, double declination_rad)
{
    stars->pole = vec3_from_lat_lon(declination_rad, right_ascension_rad);
    stars->node_right_ascension_rad = right_ascension_rad + M_PI / 2;
    stars->node = vec3_from_lat_lon(0, stars->node_right_ascension_rad);
}

static void add_star(const struct catalogue_star *from, const struct extinction *extinction,
                     struct star *out)
{
    const struct spectrum body = {.kind = SPECTRUM_BLACKBODY,
                                  .blackbody = {starlight_temperature_K(from->colour_index), 1}};
    const lanes light = extinction_sample(extinction, &body);
    const double illuminance_lx = starlight_illuminance_lx(from->magnitude);
    const double unit_lx = cie_luminance(extinction_colour(extinction, &light));
    *out = (struct star){.direction = from->direction,
                         .illuminance_lx = illuminance_lx,
                         .irradiance = light * (float)(illuminance_lx / unit_lx)};
}

static trl_result make_mesh(struct stars *stars)
{
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const struct gpu_mesh_desc desc = {
        .label = "stars",
        .primitive = GPU_PRIMITIVE_TRIANGLE_STRIP,
        .vertex_count = 4,
        .vertex_stride = sizeof corners[0],
        .vertices = corners,
        .instance_stride = sizeof(struct star_sprite),
        .attribute_count = 3,
        .attributes = {
            {.location = 0, .components = 2, .type = GPU_COMPONENT_FLOAT},
            {.location = 1,
             .components = 2,
             .type = GPU_COMPONENT_FLOAT,
             .offset = offsetof(struct star_sprite, centre_px),
             .is_per_instance = true},
            {.location = 2,
             .components = 4,
             .type = GPU_COMPONENT_FLOAT,
             .offset = offsetof(struct star_sprite, light),
             .is_per_instance = true},
        }};
    return gpu_mesh_init(stars->gpu, &desc, &stars->mesh);
}

trl_result stars_init(const struct stars_desc *desc, struct stars *out)
{
    const trl_context *ctx = desc->gpu->ctx;
    const size_t count = desc->catalogue->count;
    *out = (struct stars){.ctx = ctx,
                          .gpu = desc->gpu,
                          .count = count,
                          .stars = mem_alloc(ctx, count, sizeof *out->stars),
                          .sprites = mem_alloc(ctx, count, sizeof *out->sprites)};
    set_axes(out, desc->pole_right_ascension_rad, desc->pole_declination_rad);
    trl_result result = out->stars && out->sprites ? TRL_OK : TRL_ERROR_MEMORY;
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        add_star(&desc->catalogue->stars[i], desc->extinction, &out->stars[i]);
    }
    const struct gpu_program_desc program = {.vertex = "sky/star.vert",
                                             .fragment = "sky/star.frag"};
    if (result == TRL_OK) {
        result = gpu_program_init(desc->gpu, &program, &out->program);
    }
    if (result == TRL_OK) {
        result = make_mesh(out);
    }
    if (result != TRL_OK) {
        stars_finish(out);
    }
    return result;
}

void stars_finish(struct stars *stars)
{
    if (stars->ctx) {
        gpu_mesh_finish(&stars->mesh);
        gpu_program_finish(&stars->program);
        mem_free(stars->ctx, stars->stars);
        mem_free(stars->ctx, stars->sprites);
    }
    *stars = (struct stars){0};
}

struct stars_axes stars_turn(const struct stars *stars, double sidereal_rad)
{
    const double turned_rad = sidereal_rad - stars->node_right_ascension_rad;
    const struct vec3 ahead = vec3_cross(stars->pole, stars->node);
    const struct vec3 x =
        vec3_add(vec3_scale(stars->node, cos(turned_rad)), vec3_scale(ahead, sin(turned_rad)));
    return (struct stars_axes){x, vec3_cross(stars->pole, x), stars->pole};
}

static struct vec3 turn(const struct stars_axes *axes, struct vec3 v)
{
    return vec3_add(vec3_scale(axes->x, v.x),
                    vec3_add(vec3_scale(axes->y, v.y), vec3_scale(axes->z, v.z)));
}

// A body as something that hides stars.
struct cover {
    struct vec3 direction;
    double cosine; // of its angular radius
};

// What one frame needs, in the ICRS.
struct sight {
    struct vec3 right, up, forward, zenith;
    double tan_half_x, tan_half_y; // of the picture
    double margin_x, margin_y;     // how far outside stars still reach in, relative to half of it
    double width_px, height_px;
    const struct extinction *extinction;
    size_t cover_count;
    struct cover covers[CAMERA_MAX_BODIES];
};

static void add_covers(const struct camera *camera, const struct stars_axes *axes,
                       struct sight *out)
{
    for (unsigned i = 0; i < camera->body_count; i++) {
        const struct camera_body *body = &camera->bodies[i];
        const struct vec3 way_m = vec3_sub(body->position_m, camera->position_m);
        const double sine = fmin(body->radius_m / vec3_length(way_m), 1);
        out->covers[out->cover_count++] =
            (struct cover){turn(axes, vec3_normalize(way_m)), sqrt(1 - sine * sine)};
    }
}

static struct sight find_sight(const struct stars *stars, const struct stars_view *view)
{
    const struct camera *camera = view->camera;
    const struct stars_axes axes = stars_turn(stars, view->sidereal_rad);
    const double reach_px = (double)CORE_HALF_PX * HALO_WIDTH;
    struct sight sight = {.right = turn(&axes, camera->right),
                          .up = turn(&axes, camera->up),
                          .forward = turn(&axes, camera->forward),
                          .zenith = turn(&axes, vec3_normalize(camera->position_m)),
                          .tan_half_x = camera->tan_half_fov_x,
                          .tan_half_y = camera->tan_half_fov_y,
                          .margin_x = 1 + 2 * reach_px / view->target->width,
                          .margin_y = 1 + 2 * reach_px / view->target->height,
                          .width_px = view->target->width,
                          .height_px = view->target->height,
                          .extinction = view->extinction};
    add_covers(camera, &axes, &sight);
    return sight;
}

static bool is_covered(const struct sight *sight, struct vec3 direction)
{
    for (size_t i = 0; i < sight->cover_count; i++) {
        if (vec3_dot(sight->covers[i].direction, direction) > sight->covers[i].cosine) {
            return true;
        }
    }
    return false;
}

// Share of the light that goes into the halo, rising with the logarithm of the light.
static float find_halo(double illuminance_lx)
{
    const double magnitudes = 2.5 * log10(fmax(illuminance_lx / HALO_FROM_LX, 1));
    return (float)(HALO_SHARE * fmin(magnitudes / 4, 1));
}

// Where the star is in the picture and how much of it gets through; false when it is not seen.
static bool make_sprite(const struct star *star, const struct sight *sight, struct star_sprite *out)
{
    const double along = vec3_dot(star->direction, sight->forward);
    const double x = vec3_dot(star->direction, sight->right);
    const double y = vec3_dot(star->direction, sight->up);
    if (along <= 1e-6 || fabs(x) > along * sight->tan_half_x * sight->margin_x ||
        fabs(y) > along * sight->tan_half_y * sight->margin_y) {
        return false;
    }
    const double mu = vec3_dot(star->direction, sight->zenith);
    if (extinction_is_hidden(sight->extinction, mu) || is_covered(sight, star->direction)) {
        return false;
    }
    const lanes left = star->irradiance * extinction_at(sight->extinction, mu);
    const struct cie_rgb rgb = extinction_colour(sight->extinction, &left);
    // A pixel's part of the image plane, seen from the eye at the angle whose cosine is `along`.
    const double pixel_sr = 4 * sight->tan_half_x * sight->tan_half_y /
                            (sight->width_px * sight->height_px) * along * along * along;
    *out = (struct star_sprite){
        .centre_px = {(float)(0.5 * sight->width_px * (1 + x / (along * sight->tan_half_x))),
                      (float)(0.5 * sight->height_px * (1 + y / (along * sight->tan_half_y)))},
        .light = {(float)(rgb.r / pixel_sr), (float)(rgb.g / pixel_sr), (float)(rgb.b / pixel_sr)},
        .halo = find_halo(cie_luminance(rgb))};
    return true;
}

trl_result stars_draw(struct stars *stars, const struct stars_view *view)
{
    const struct sight sight = find_sight(stars, view);
    uint32_t count = 0;
    for (size_t i = 0; i < stars->count; i++) {
        count += make_sprite(&stars->stars[i], &sight, &stars->sprites[count]);
    }
    if (count == 0) {
        return TRL_OK;
    }
    const struct gpu_pass pass = {.target = view->target,
                                  .state = {.depth = GPU_DEPTH_NEARER, .blend = GPU_BLEND_ADD}};
    const trl_result result = gpu_mesh_update_instances(&stars->mesh, stars->sprites, count);
    if (result != TRL_OK) {
        return result;
    }
    const float size[2] = {(float)sight.width_px, (float)sight.height_px};
    gpu_program_set_vec2(&stars->program, "u_size", size);
    gpu_pass_begin(stars->gpu, &pass);
    return gpu_draw_mesh(&stars->program, &stars->mesh, count, "stars");
}
