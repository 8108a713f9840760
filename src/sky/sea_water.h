// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SEA_WATER_H
#define SKY_SEA_WATER_H
// What every model looks up of open water: the uniforms of shaders/sky/sea.glsl.

#include "gpu/program.h"
#include "sky/pixels.h"
#include "sky/reflection.h"

struct sea_water {
    const struct sky_sea *sea;    // NULL: none
    double disc_slope;            // by which the star's disc makes its glint broader
    struct gpu_texture texture;   // what its surface reflects
    struct gpu_texture volume;    // of sky/sea_volume.h
    struct reflection reflection; // of terrain, in the last view
};

void sea_water_init(const struct sky_desc *desc, struct sea_water *out);
void sea_water_finish(struct sea_water *water);
// Forgets the textures: their bands are no longer those of the light.
void sea_water_drop(struct sea_water *water);

// Whether the view may show open water.
bool sea_water_is_seen(const struct sea_water *water, const struct sky_view *view);

// Makes the texture where it is not there yet: of light in these bands, or of colours (NULL).
TRL_MUST_USE trl_result sea_water_prepare(struct sea_water *water, struct gpu *gpu,
                                          const struct bands *bands);

// Finds the terrain that the water mirrors, when all else of the view is drawn; before
// sea_water_set.
TRL_MUST_USE trl_result sea_water_reflect(struct sea_water *water, const struct sky_pixels *pixels,
                                          const struct sky_view *view);

void sea_water_set(const struct sea_water *water, const struct sky_view *view,
                   struct gpu_program *program);

#endif // SKY_SEA_WATER_H
