// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_GRID_H
#define RASTER_GRID_H
// One band of a raster resident in memory as floats, sampled bilinearly in double anywhere on the
// sphere: across the antimeridian, and over a pole to the opposite meridian.

#include "raster/raster.h"

// Owner: whoever loaded it. Threads: const calls from any.
struct raster_grid {
    const trl_context *ctx;
    uint32_t width, height;
    double west_deg, north_deg;               // outer edges of the first pixel
    double pixel_width_deg, pixel_height_deg; // of this grid, not of the file
    bool is_whole_circle;
    bool touches_north, touches_south; // a border is the pole
    float *values;                     // owned; width x height, north row first; NaN: no data
};

// Reads a band, from 0, at no more than `max_side` pixels in either direction (0: all of them).
// Returns TRL_OK; TRL_ERROR_IO; TRL_ERROR_INVALID (also: stereographic); TRL_ERROR_MEMORY. *out is
// zeroed on failure.
TRL_MUST_USE trl_result raster_grid_load(const struct raster *raster, uint32_t band,
                                         uint32_t max_side, struct raster_grid *out);

// Frees it. A zeroed grid is a no-op.
void raster_grid_finish(struct raster_grid *grid);

// What the grid says at one place. The gradient is that of the bilinear patch, per radian of
// latitude and of longitude (divide by the radius, and by the cosine of the latitude, for a slope).
struct raster_sample {
    bool is_valid; // false outside the grid's borders, or where all four neighbours lack data
    double value;
    double per_latitude_rad, per_longitude_rad;
};

// Any longitude; latitude in [-pi/2, pi/2]. Neighbours without data are replaced by the mean of
// those that have it.
struct raster_sample raster_grid_sample(const struct raster_grid *grid, double latitude_rad,
                                        double longitude_rad);

// Smallest and largest value with data; both 0 when there is none.
void raster_grid_range(const struct raster_grid *grid, float *min, float *max);

#endif // RASTER_GRID_H
