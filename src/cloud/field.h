// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUD_FIELD_H
#define CLOUD_FIELD_H
// The clouds of a scene as a field over space: layers of a noise volume that tiles it, thinned by
// height and by the weather. In double; shaders/cloud/field.glsl is the same on the GPU.

#include "base/vec3.h"
#include "cloud/cloud.h"
#include "cloud/volume.h"
#include "raster/grid.h"
#include "shared/cloud.glsl"

struct cloud_field {
    const trl_context *ctx;
    struct cloud_desc desc; // but for the path
    double ground_radius_m;
    // Cosine and sine of how far east the wind has turned a layer.
    double turn[CLOUD_MAX_LAYERS][2];
    struct cloud_volume volume;
    // Of cover, in [0, 1]: none, one for all layers, or one for each. Owned.
    size_t map_count;
    struct raster_grid maps[CLOUD_MAX_LAYERS];
};

// Loads the maps, computes or loads the noise. What those return. *out is zeroed on failure.
TRL_MUST_USE trl_result cloud_field_init(const trl_context *ctx, const struct cloud_desc *desc,
                                         double ground_radius_m, struct cloud_field *out);
void cloud_field_finish(struct cloud_field *field);

// Layers stand where the wind has them then. At the beginning after init.
void cloud_field_set_time(struct cloud_field *field, double time_s);
// A place as the layer had it at the beginning.
struct vec3 cloud_field_unturned(const struct cloud_field *field, size_t layer,
                                 struct vec3 position_m);

double cloud_field_highest_m(const struct cloud_field *field); // the uppermost top

// How far the nearest layer is above or below a place; 0 in one.
double cloud_field_far_m(const struct cloud_field *field, struct vec3 position_m);

// The part of each height that a layer may cover over a place, from the planet's centre.
double cloud_field_cover(const struct cloud_field *field, size_t layer, struct vec3 position_m);

// Mean extinction, per m, at a place of a box whose side is a texel of the level: 0 for those of
// the noise, -2.6 for those of the finer, as fine as there is.
double cloud_field_extinction(const struct cloud_field *field, size_t layer, struct vec3 position_m,
                              double level);

// The cover of one height there, with clouds gathered into fields as a box of that level sees them.
double cloud_field_gathered(const struct cloud_field *field, size_t layer, struct vec3 position_m,
                            double level);

// Where the noise and the finer one are looked at for a place, in tiles (place.c).
struct cloud_place {
    double noise[3], finer[3];
};
struct cloud_place cloud_field_place(const struct cloud_field *field, size_t layer,
                                     struct vec3 position_m);
// The noise of a box around there whose side is a texel of the level.
CloudNoise cloud_field_noise(const struct cloud_field *field, const double place[3], double level);
// By at most how much noise moves faster than places do, away from the axis of fibres.
double cloud_field_strain(const struct cloud_layer *layer);
bool cloud_field_has_fibres(enum cloud_type type);
// Tiles of fibres for each radian about the planet's axis; whole ones fit around.
double cloud_field_fibre_turns(const struct cloud_layer *layer, double ground_radius_m);
// A place as the layer had it at the beginning, bent, for noise of such tiles; and the phase of
// what bends it.
struct vec3 cloud_field_bent(struct vec3 unturned_m, double tile_m);
void cloud_field_bend_phase(struct vec3 unturned_m, double tile_m, double out[3]);

// What a layer's cover is a part of; NULL: the same everywhere.
const struct raster_grid *cloud_field_map(const struct cloud_field *field, size_t layer);

// Tiles of the noise of weather systems in the planet's radius; 0: there are none, or a map knows.
double cloud_field_system_tiles(const struct cloud_field *field);
// Where it is looked at for a place; false where there are none.
bool cloud_field_system_place(const struct cloud_field *field, size_t layer, struct vec3 position_m,
                              double tiles[3]);

// Where the widest noise is looked at for a place: along other axes, so that its tiles do not line
// up with the others.
struct vec3 cloud_field_wide_place(struct vec3 position_m);

// Unit vectors to its eye, to the east there, and to where it turns from that.
void cloud_cyclone_axes(const struct cloud_cyclone *cyclone, struct vec3 *at, struct vec3 *east,
                        struct vec3 *turn);

// Weight of the finer noise and the place of the greatest width, by type.
double cloud_field_detail(enum cloud_type type);
double cloud_field_peak(enum cloud_type type);
double cloud_field_edge(enum cloud_type type); // for cloud_density
// For cloud_level_cover.
double cloud_field_overlap(enum cloud_type type);

#endif // CLOUD_FIELD_H
