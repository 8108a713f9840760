// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_PIXELS_H
#define SKY_PIXELS_H
// What models of the sky share. Pixels are first sorted into ground, air and space, and each kind
// is drawn by a program of its own with a depth test: a software rasteriser runs both sides of a
// branch. Programs have the vertex shader lib/layer.vert, include sky/ray.glsl, and for the ground
// sky/ground.glsl (with SURFACE where there are surface buffers).

#include "gpu/hide.h"
#include "scatter/bands.h"
#include "sky/sky.h"

enum sky_kind {
    SKY_KIND_AIR,    // no ground: air before space
    SKY_KIND_STAR,   // the same where the star's disc may be, and space: drawn over the air
    SKY_KIND_GROUND, // lit ground behind air
    SKY_KIND_SEA     // the part of it that is open water: drawn over the ground
};

struct sky_pixels {
    struct gpu *gpu;
    double ground_radius_m, top_radius_m;
    double disc_rad;  // angular radius of the star
    double shown_rad; // up to where its pixels show more than air: the disc, or a corona
    bool has_sea;
    struct gpu_program sort_bare, sort_surface;
    struct gpu_hide hide;
};

TRL_MUST_USE trl_result sky_pixels_init(const struct sky_desc *desc, double disc_rad,
                                        struct sky_pixels *out);
void sky_pixels_finish(struct sky_pixels *pixels);

// Whether the view has no surface buffers.
bool sky_view_is_bare(const struct sky_view *view);

// The eye's distance from the centre, never below the reference sphere.
double sky_pixels_eye_radius(const struct sky_pixels *pixels, const struct camera *camera);

// How far around the point below an eye things of that height above the ground are seen, as an
// angle at the planet's centre. `eye_m` counts from there, too.
double sky_reach_rad(double ground_radius_m, double eye_m, double height_m);

// The uniforms of ray.glsl, for programs that are not drawn by sky_pixels_draw.
void sky_pixels_set_view(const struct sky_pixels *pixels, struct gpu_program *program,
                         const struct sky_view *view);

// The uniforms of deck.glsl, where there are clouds.
void sky_pixels_set_deck(struct gpu_program *program, const struct sky_view *view);

// First of all: clears the target and marks each pixel's kind; what is hidden is of none.
TRL_MUST_USE trl_result sky_pixels_sort(struct sky_pixels *pixels, const struct sky_view *view);

// Draws the pixels of one kind. Uniforms of ray.glsl and textures of ground.glsl are set here; the
// caller has set the others.
TRL_MUST_USE trl_result sky_pixels_draw(const struct sky_pixels *pixels,
                                        struct gpu_program *program, enum sky_kind kind,
                                        const struct sky_view *view);

// Uniforms of models that keep light in bands: u_rgb_from_bands (rows), u_bands_from_rgb (columns),
// u_ground_albedo, u_bands_of_light (columns: lights at night of which white has `lights_cd_m2`).
void sky_set_bands(struct gpu_program *program, const struct bands *bands,
                   const struct optics *optics, double lights_cd_m2);

// Uniform u_rgb_from_xyz (rows): light in XYZ as linear sRGB, times a factor for each primary.
void sky_set_primaries(struct gpu_program *program, const double factors[3]);

// Sets the uniforms of ray.glsl, for programs that draw something else than a kind of pixels.
void sky_pixels_set_view(const struct sky_pixels *pixels, struct gpu_program *program,
                         const struct sky_view *view);

// Pixels in which a disc of that angular radius may show; none: a width of 0.
struct gpu_rect sky_find_disc(const struct camera *camera, const struct gpu_target *target,
                              struct vec3 direction, double radius_rad);

// A direction as seen from the picture: its component in a ray is the dot product with (1, x, y),
// (x, y) in [-1, 1]^2. In double, since discs may be small.
void sky_set_axis(struct gpu_program *program, const char *name, const struct camera *camera,
                  struct vec3 axis);

// RGBA32F, 3D where it is deeper than 1. Texels may be NULL.
TRL_MUST_USE trl_result sky_make_map(struct gpu *gpu, const char *label, const uint32_t size[3],
                                     const float *texels, struct gpu_texture *out);

void sky_set_vec3(struct gpu_program *program, const char *name, struct vec3 v);
void sky_set_vec4(struct gpu_program *program, const char *name, double x, double y, double z,
                  double w);

#endif // SKY_PIXELS_H
