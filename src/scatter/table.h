// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_TABLE_H
#define SCATTER_TABLE_H
// The 4D table of the sky (Elek 2010 Section 4.1; Bruneton and Neyret 2008): radiance of every ray
// that misses the ground, over the eye's altitude, the ray's zenith angle, the star's zenith angle
// and the azimuth between them. Spectral inside, converted last: a texel is X, Y, Z in cd m^-2 and
// a 0.
//
// Channel 0 holds all orders of all constituents whose phase function is smooth, and all but the
// first order of the others; it is divided by the Rayleigh phase function, which leaves less to
// interpolate. Each constituent with a peaked phase function has a channel of its own for the first
// order, without the phase function: it is applied per pixel.

#include "scatter/bands.h"
#include "scatter/solver.h"

enum { TABLE_MAX_PEAKED = 3, TABLE_MOST_SUNS = 48, TEXEL_FLOATS = 4 };

// Which constituents are peaked; the strongest ones when there are more than channels.
struct peaked {
    int count;
    int constituent[TABLE_MAX_PEAKED];
};

struct peaked peaked_choose(const struct optics *optics);

// Single scattering sorted into channels: the phase function of the smooth ones over the family
// goes into `phase[i]` (each [family->count]).
struct transport_channels peaked_channels(const struct peaked *peaked, const struct optics *optics,
                                          const struct transport_family *family,
                                          float *const *phase);

struct table_size {
    int altitudes, views, suns, azimuths;
};

struct table {
    struct table_size size;
    int channels;
    double sun_centre, sun_width, sun_first, sun_last; // see sky_map_sun
    float *texels; // [channel][altitude][view][sun][azimuth][TEXEL_FLOATS]
};

struct table_size table_size_default(void);
struct table_size table_size_draft(void);       // a ninth of the work: soft at the horizon
size_t table_texels(const struct table *table); // floats in all channels

// The cosine of the star's zenith angle at a sun of the grid: the inverse of sky_map_sun.
double table_sun_mu(const struct table *table, int sun);

// A place between two of `count` grid points, from a coordinate in [0, 1].
struct table_cell {
    int below;
    float part;
};
struct table_cell table_cell_at(double coordinate, int count);

// Altitudes are uniform in sqrt(radius^2 - ground^2). The caller has set out->size.
TRL_MUST_USE trl_result table_init(const trl_context *ctx, const struct solution *solution,
                                   const struct peaked *peaked, const struct bands *bands,
                                   struct table *out);
// Allocates without computing, for a cache to fill; out->size as above.
TRL_MUST_USE trl_result table_reserve(const trl_context *ctx, const struct moments *moments,
                                      int channels, struct table *out);
void table_finish(const trl_context *ctx, struct table *table);

// One channel at one altitude: [view][sun][azimuth][TEXEL_FLOATS], the layout of a 3D texture.
void table_slice(const struct table *table, const struct optics *optics, int channel,
                 double radius_m, float *texels);

// The same at one sun: [view][azimuth][TEXEL_FLOATS]. Between suns the logarithm is interpolated,
// since twilight falls by a factor from sun to sun.
void table_slice_at_sun(const struct table *table, const struct optics *optics, int channel,
                        double radius_m, double sun_mu, float *texels);

#endif // SCATTER_TABLE_H
