// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_AERIAL_H
#define SCATTER_AERIAL_H
// Aerial perspective for one eye and sun: the light that the air adds and takes between the eye and
// any point before the ground, marched through the solved source. It needs no difference of table
// values, which bands on near terrain.
//
// Stored are means over the way through the air: in-scattered radiance per metre (channels as in
// table.h) and extinction per metre, which are smooth down to no distance at all. Rows by
// shared/sky_map.glsl: first those that meet the reference sphere, then those that pass above it.
//
// For marching along the rays (sky/march.h) there is also, where it is asked for, the source: light
// that each cell of a ray sends to the eye per metre, dimmed by the air before it, with the first
// order apart from the others. The sources of all cells make what is scattered.
//
// From outside the sun's height changes from noon to night along a row, and the air is densest
// where rays end, or pass closest, or where it hides the ground. There the grid has more azimuths
// and fewer depths, both where light changes.

#include "scatter/atmosphere.h"

enum {
    AERIAL_LONG = 32,  // depths of a ray; from outside azimuths
    AERIAL_SHORT = 16, // azimuths; from outside depths
    AERIAL_GROUND_ROWS = 64,
    AERIAL_AIR_ROWS = 32,
    AERIAL_ROWS = AERIAL_GROUND_ROWS + AERIAL_AIR_ROWS,
    AERIAL_LEVELS = 65,
    AERIAL_MULTIPLE = 1 + TABLE_MAX_PEAKED, // in `source`: all orders but the first
    AERIAL_SOURCES
};

struct aerial {
    const struct atmosphere *atmosphere;
    double eye_radius_m;
    double nearest_m, farthest_m;           // of the rows on the ground: nadir, horizon
    double horizon_mu, highest_mu;          // of the rows above
    double opaque_m;                        // altitude below which the air hides the ground; or 0
    bool is_outside;                        // the air
    int depths, azimuths;                   // 32 and 16; from outside 16 and 32
    float *scattered[1 + TABLE_MAX_PEAKED]; // [row][azimuth][depth][TEXEL_FLOATS]; from outside
                                            // [row][depth][azimuth][TEXEL_FLOATS]
    float *extinction;                      // [row][AERIAL_LONG][BAND_COUNT], the first `depths`
    // What level ground of radiance 1 sends to the eye by way of the air before it, per metre:
    // layout and means as `extinction`. By two streams; see docs/physics.md, section 12.
    float *bounce;
    // Layout of `scattered`, depth d standing for the cell that ends at depth d: the first order in
    // its channels, and AERIAL_MULTIPLE, divided by the Rayleigh phase function. NULL: not asked
    // for
    float *source[AERIAL_SOURCES];
    struct streams *streams;
    struct aerial_worker *workers;
    int worker_count;
};

TRL_MUST_USE trl_result aerial_init(const struct atmosphere *atmosphere, struct aerial *out);
void aerial_finish(struct aerial *aerial);
// From the next update on there is a source.
TRL_MUST_USE trl_result aerial_add_source(struct aerial *aerial);

// Computes all for an eye; about 10 ms on two cores. An eye below AERIAL_MIN_ALTITUDE_M counts as
// there.
#define AERIAL_MIN_ALTITUDE_M 0.5
void aerial_update(struct aerial *aerial, double radius_m, double sun_mu);

// What the air above an altitude sends back of diffuse light from below.
void aerial_air_albedo(const struct aerial *aerial, double altitude_m, float bands[BAND_COUNT]);

#endif // SCATTER_AERIAL_H
