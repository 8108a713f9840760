// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_SHADOW_H
#define TERRAIN_SHADOW_H
// Shadow that terrain casts on terrain, and on the air above it: for each place around the camera,
// the altitude up to which the middle of the sun is hidden. That surface is smooth where the edge
// of a shadow is not, so it may be sampled coarsely; a pixel compares its own altitude with it.
// Independent of the mesher. Made anew when the projection camera or the sun moves.

#include "gpu/target.h"
#include "terrain/height_programs.h"
#include "terrain/projection.h"

struct terrain_shadow {
    struct gpu *gpu;
    const struct surface *surface;
    double sun_angular_radius_rad;
    struct projection projection;
    struct vec3 sun; // for which it was made
    double power, extent;
    double lowest_m, highest_m; // ground that may be on it
    // They grow whenever the heights, and whenever anything on it becomes another.
    uint64_t made, drawn;
    struct height_programs heights;
    struct gpu_program spread;
    // R = altitude, m; G = distance to what casts it, m; B = altitude of the ground, m. The two are
    // drawn from one another.
    struct gpu_texture maps[2];
    struct gpu_target targets[2];
    int current; // the finished one
};

// TRL_ERROR_GPU; TRL_ERROR_MEMORY. Must not outlive the surface.
TRL_MUST_USE trl_result terrain_shadow_init(const struct surface *surface,
                                            double sun_angular_radius_rad,
                                            struct terrain_shadow *out);
void terrain_shadow_finish(struct terrain_shadow *shadow);

// Makes it fit the camera and its sun.
TRL_MUST_USE trl_result terrain_shadow_update(struct terrain_shadow *shadow,
                                              const struct camera *camera);

// The finished map.
const struct gpu_texture *terrain_shadow_map(const struct terrain_shadow *shadow);

// Where the map lies, for shaders that know positions relative to `camera`: as in shadow.glsl.
struct terrain_shadow_place {
    float power, extent, radius_m;
    float local_from_planet[9];
    float offset_m[3]; // camera - the map's anchor on the sphere, local frame
};
struct terrain_shadow_place terrain_shadow_place(const struct terrain_shadow *shadow,
                                                 const struct camera *camera);

// Hands it to a program that includes terrain/shadow.glsl and knows positions relative to `camera`.
void terrain_shadow_bind(const struct terrain_shadow *shadow, const struct camera *camera,
                         struct gpu_program *program);

#endif // TERRAIN_SHADOW_H
