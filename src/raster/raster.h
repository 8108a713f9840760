// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_RASTER_H
#define RASTER_RASTER_H
// Rasters in files, read through GDAL: where they lie on the sphere and what their pixels hold.
//
// A raster is equirectangular (columns run east along a parallel, rows run south along a meridian,
// both in equal steps of degrees) or stereographic about a pole. Of both, borders are those of the
// outer pixels' outer edges, whatever the file's registration. In any other projection that GDAL
// knows a file is warped to one of these two, of its own resolution, while it is read. A
// file without georeference is taken for the whole globe, left edge at 180 W, when it is exactly
// twice as wide as high; anything else is an error.
//
// Latitudes are those of the file's own geographic system; on Earth, other data than WGS 84 are
// shifted to it where a file is warped.

#include "base/context.h"

// Larger pictures are refused: no offset of a pixel then overflows, and a broken header cannot ask
// for more memory than there is.
enum { RASTER_MAX_SIDE = 1 << 20, RASTER_MAX_BANDS = 64 };

enum raster_type {
    RASTER_UINT8, // colour, masks
    RASTER_INT16, // elevations
    RASTER_FLOAT  // everything else, as GDAL converts it
};

// What a pixel's number means: offset + scale * number, in units.
struct raster_values {
    double scale, offset; // 1 and 0 where the file says nothing
    char unit[32];        // as the file names it; empty: nothing
    double unit_m;        // metres; 1 where the file says nothing, 0 where the name is none of ours
};

// The plane of shared/projection.glsl, in radians at the pole: x to the right, y up.
struct raster_plane {
    double pole;          // 1 north, -1 south; 0: equirectangular
    double longitude_deg; // which meridian runs straight down from the north pole, up from the
                          // south pole
    double e2;            // squared eccentricity of the ellipsoid
    double left, top;     // outer edges of the first pixel
    double pixel_width, pixel_height;
};

// Owner: whoever opened it. Threads: one at a time (GDAL's datasets are not shareable); open it
// twice to read from two.
struct raster {
    const trl_context *ctx;
    char *path; // owned
    bool is_remote;
    void *dataset; // GDALDatasetH, owned
    void *source;  // GDALDatasetH, owned: what `dataset` is warped from, or NULL
    uint32_t width, height;
    uint32_t file_width, file_height; // more than these where it is reduced
    uint32_t band_count;
    enum raster_type type; // of the first band's file type
    bool has_palette;      // numbers of colours, read as those colours
    bool has_mask;         // the file says beside its numbers where it has data
    bool has_alpha;        // a band of 8 bits, of the file's own, says what is covered
    int colour_bands[4];   // from 0: red, green, blue, the same one of grey; alpha or -1
    struct raster_values values;
    double body_radius_m;      // semi-major axis of the coordinates; 0: they name none
    struct raster_plane plane; // of a stereographic raster, else zeroed
    // Of an equirectangular one, else 0.
    double west_deg, east_deg, south_deg,
        north_deg;                            // west in [-180, 180); east > west, to west + 360
    double pixel_width_deg, pixel_height_deg; // both > 0
    bool is_whole_circle;                     // east and west borders meet: columns wrap around
    bool has_nodata;
    double nodata;
};

// Opens a local file, or one behind a URL where the context allows that. Nothing of its pixels is
// read yet.
// Returns TRL_OK; TRL_ERROR_IO (missing or unreadable); TRL_ERROR_INVALID (not a raster, no
// georeference that can be read or warped, beyond the bounds above, not allowed); TRL_ERROR_MEMORY.
// *out is zeroed on failure.
TRL_MUST_USE trl_result raster_open(const trl_context *ctx, const char *path, struct raster *out);

// Opens the file of an open raster once more, so that another thread can read from it. What it
// says of itself is not looked at again. Returns as raster_open.
TRL_MUST_USE trl_result raster_open_again(const struct raster *raster, struct raster *out);

// The same raster seen as fewer pixels: reads give those of the overview of just that size where
// the file has one, else means. Borrows from `raster`: not to be finished, and good no longer than
// that.
struct raster raster_reduced(const struct raster *raster, uint32_t width, uint32_t height);

// Whether there is an overview of this size in the file.
bool raster_has_overview(const struct raster *raster, uint32_t width, uint32_t height);

// Closes it. A zeroed raster is a no-op.
void raster_finish(struct raster *raster);

// A rectangle of pixels of the file, delivered at `out_width` x `out_height`: the same size, or
// smaller by averaging (from overviews where the file has them). Must lie inside the raster.
struct raster_window {
    uint32_t x, y, width, height;
    uint32_t out_width, out_height;
};

// The whole raster, no larger than `max_side` in either direction (0: as it is).
struct raster_window raster_window_whole(const struct raster *raster, uint32_t max_side);

// Reads one band (from 0) as floats, north row first: the file's numbers, without scale and offset.
// Pixels without data become NaN, and numbers beyond 1e30, which nothing that is measured has.
// Returns TRL_OK; TRL_ERROR_INVALID (window or band outside); TRL_ERROR_IO (the file is broken).
TRL_MUST_USE trl_result raster_read_float(const struct raster *raster,
                                          const struct raster_window *window, uint32_t band,
                                          float *out);

// Reads 8-bit pixels as RGBA, north row first: the bands that say that they are red, green, blue
// and alpha; where none says so the first three, or the first as grey. A missing alpha is 255, or 0
// where a pixel has no data. Returns as above; TRL_ERROR_INVALID also when the raster is not 8-bit.
TRL_MUST_USE trl_result raster_read_rgba8(const struct raster *raster,
                                          const struct raster_window *window, uint8_t *out);

// Reads one 8-bit band (from 0). Returns as raster_read_rgba8.
TRL_MUST_USE trl_result raster_read_uint8(const struct raster *raster,
                                          const struct raster_window *window, uint32_t band,
                                          uint8_t *out);

// Reads a band of integers as int16, clamped; for height maps kept at half the memory. Pixels
// without data keep the file's own value. Returns TRL_OK; TRL_ERROR_INVALID; TRL_ERROR_IO.
TRL_MUST_USE trl_result raster_read_int16(const struct raster *raster,
                                          const struct raster_window *window, uint32_t band,
                                          int16_t *out);

#endif // RASTER_RASTER_H
