// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCENE_READ_H
#define SCENE_READ_H
// The parts of a scene file, each read and checked from its node. What has been read before an
// error stays in `out`, which the caller finishes. docs/scenes.md is the reference of the format.

#include "scene/node.h"
#include "scene/scene.h"

#define SCENE_RADIANS_PER_DEGREE (3.14159265358979323846 / 180)

// star, planet and atmosphere of the root.
TRL_MUST_USE trl_result scene_read_medium(const struct scene_node *root, struct medium *out);

TRL_MUST_USE trl_result scene_read_spectrum(const struct scene_node *node,
                                            const struct scene_range *range, struct spectrum *out);
TRL_MUST_USE trl_result scene_read_profile(const struct scene_node *node, struct profile *out);
TRL_MUST_USE trl_result scene_read_phase(const struct scene_node *node, struct phase *out);

// Phase functions at ascending wavelengths, linear between them; one alone holds at all.
struct scene_phases {
    size_t count;
    double nm[MEDIUM_MAX_CONSTITUENTS];
    struct phase phase[MEDIUM_MAX_CONSTITUENTS]; // owned
};
TRL_MUST_USE trl_result scene_read_phases(const struct scene_node *node, struct scene_phases *out);
void scene_phases_finish(const trl_context *ctx, struct scene_phases *phases);

// atmosphere.constituents; the medium's radii are known.
TRL_MUST_USE trl_result scene_read_constituents(const struct scene_node *node, struct medium *out);

// The coefficients and phase functions of spheres. `out` has its profile, `height_m` is that of the
// air.
TRL_MUST_USE trl_result scene_read_mie(const struct scene_node *node, double height_m,
                                       struct constituent *out, struct scene_phases *phases);

// sky_model of the root; it may be missing.
TRL_MUST_USE trl_result scene_read_sky_model(const struct scene_node *root, struct trl_scene *out);

// rayleigh of the root, or the default.
TRL_MUST_USE trl_result scene_read_rayleigh(const struct scene_node *root, trl_rayleigh_desc *out);

// surface.layers and views of the root; both may be missing.
TRL_MUST_USE trl_result scene_read_layers(const struct scene_node *root, struct trl_scene *out);
TRL_MUST_USE trl_result scene_read_views(const struct scene_node *root, struct trl_scene *out);

// surface.noise, which may be missing; climate and biomes of surface, which may be too.
TRL_MUST_USE trl_result scene_read_noise(const struct scene_node *node, struct scene_noise *out);
TRL_MUST_USE trl_result scene_read_biomes(const struct scene_node *surface, struct trl_scene *out);

// ocean and planet.gravity_m_s2 of the root; both may be missing.
TRL_MUST_USE trl_result scene_read_ocean(const struct scene_node *root, struct ocean_desc *out);

// stars of the root; they may be missing.
TRL_MUST_USE trl_result scene_read_stars(const struct scene_node *root, struct trl_scene *out);

// clouds of the root; they may be missing. The medium's radii are known.
TRL_MUST_USE trl_result scene_read_clouds(const struct scene_node *root, struct trl_scene *out);

// bodies of the root, which may be missing, and those of a view.
TRL_MUST_USE trl_result scene_read_bodies(const struct scene_node *root, struct trl_scene *out);
TRL_MUST_USE trl_result scene_read_body_places(const struct scene_node *node,
                                               const struct trl_scene *scene, trl_view *out);

// Numbers of an object, each of which may be missing and then stays as it is.
struct scene_number {
    const char *key;
    struct scene_range range;
    double *out;
};
TRL_MUST_USE trl_result scene_read_numbers(const struct scene_node *object,
                                           const struct scene_number *numbers, size_t count);

// Angles of a view, given in degrees, kept in radians.
struct scene_angle {
    const char *key;
    const struct scene_range *range_deg;
    double *out_rad;
    bool is_optional;
};
TRL_MUST_USE trl_result scene_read_angles(const struct scene_node *object,
                                          const struct scene_angle *angles, size_t count);

// The path of a file that a scene names: as it is when absolute, else beside the scene when it is
// there, else in the data folder, whether it is there or not. Free *out with mem_free.
TRL_MUST_USE trl_result scene_read_path(const struct scene_node *node, char **out);

// The same of a raster, which may also be behind a network where the context allows that; such a
// path stays as it is.
TRL_MUST_USE trl_result scene_read_raster_path(const struct scene_node *node, char **out);

// Is there a file?
bool scene_path_exists(const char *path);

#endif // SCENE_READ_H
