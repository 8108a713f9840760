// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef PREPARE_PREPARE_H
#define PREPARE_PREPARE_H
// From files as their publishers pack them to the rasters that scenes name. This tool alone knows
// Earth and the other bodies: where each file lies in its package, what its numbers mean and where
// it cannot be trusted.

#include "base/context.h"

// Source paths, below the folder that the packages were unpacked into.
#define SRTM_TILE "usr/share/marble/data/maps/earth/srtm/3/%06d/%06d_%06d.jpg"
#define BLUE_MARBLE_SMALL "usr/share/marble/data/maps/earth/bluemarble/bluemarble.jpg"
#define CITY_LIGHTS_SMALL "usr/share/marble/data/maps/earth/citylights/citylights.jpg"
#define ETOPO5 "usr/share/ferret-vis/data/etopo5.cdf"
#define TRINIDAD "usr/share/ncarg/data/cdf/trinidad.nc"
#define BLUE_MARBLE_4K "package/example/img/earth-blue-marble.jpg"
#define CITY_LIGHTS_4K "package/example/img/earth-night.jpg"
#define WATER_COARSE "package/example/img/earth-water.png"
#define CLOUD_COVER_4K "package/example/clouds/clouds.png"
#define WORLD_8K "usr/share/games/flightgear/Models/Astro/Textures/world_%c%d.png"

// The land grid: 2 arc minutes, column 0 at 180 W, row 0 at 90 N.
enum { GLOBE_WIDTH = 10800, GLOBE_HEIGHT = 5400 };

struct places {
    const trl_context *ctx;
    const char *source_dir;
    const char *out_dir;
};

// "<source_dir>/<relative>", to be freed with mem_free; NULL when memory is out.
char *source_path(const struct places *places, const char *relative);
bool source_exists(const struct places *places, const char *relative);

// An 8-bit picture in memory, bands interleaved.
struct picture {
    uint32_t width, height, bands;
    uint8_t *pixels; // owned
};

TRL_MUST_USE trl_result picture_read(const struct places *places, const char *relative,
                                     struct picture *out);
// The same of a whole globe, which is twice as wide as high.
TRL_MUST_USE trl_result picture_read_globe(const struct places *places, const char *relative,
                                           struct picture *out);
// One band: how opaque each pixel is, of a picture whose palette says so.
TRL_MUST_USE trl_result picture_read_opacity(const struct places *places, const char *relative,
                                             struct picture *out);
// As a GeoTIFF of the whole globe, column 0 at 180 W.
TRL_MUST_USE trl_result picture_write(const struct places *places, const char *name,
                                      const struct picture *picture);
void picture_finish(const struct places *places, struct picture *picture);

// Bilinear, wrapped east to west; u and v in [0, 1] from the north-west corner.
double picture_sample(const struct picture *picture, uint32_t band, double u, double v);

// What is written: a GeoTIFF in degrees, or in metres of a map projection, uncompressed so that it
// opens at the speed of the disk, with overviews by averaging, whole or not at all.
enum pixel_kind { PIXEL_UINT8, PIXEL_INT16, PIXEL_FLOAT };

struct geotiff {
    const char *name; // in the out folder
    uint32_t width, height, bands;
    enum pixel_kind kind;
    double west_deg, north_deg, pixel_width_deg, pixel_height_deg;
    const char *projection; // NULL: degrees; else what OSRSetFromUserInput takes, and in place of
                            // the four above:
    double left_m, top_m, pixel_m;
    const void *pixels; // bands interleaved
    const char *unit;   // of the values, or NULL
};

TRL_MUST_USE trl_result geotiff_write(const struct places *places, const struct geotiff *geotiff);

// Land height as the Marble map says, in metres, and the map's own grey steps. Both GLOBE_WIDTH x
// GLOBE_HEIGHT, owned by the caller.
struct land {
    uint8_t *grey;
    float *metres;
};

TRL_MUST_USE trl_result land_read(const struct places *places, struct land *out);
void land_finish(const struct places *places, struct land *land);

// Elevation and open water of the whole globe, and its snow: the share of it that pictures have.
TRL_MUST_USE trl_result earth_prepare_globe(const struct places *places,
                                            const struct picture *snow);
// Makes the lakes of the globe's mask level, and ends them where land rises; `oceans` is not 0 in
// cells of the sea. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result lakes_make_level(const struct places *places, const uint8_t *oceans,
                                         int16_t *elevation, uint8_t *water);

// The inset in Colorado.
TRL_MUST_USE trl_result earth_prepare_colorado(const struct places *places);
// The best colour and night light pictures that are there, and the cover of clouds where it is.
// *snow: the caller's, also on failure.
TRL_MUST_USE trl_result earth_prepare_pictures(const struct places *places, struct picture *snow);

// The share of each pixel that is snow, as a picture of one band, and the colours without it.
// *share: the caller's, also on failure.
TRL_MUST_USE trl_result snow_take_out(const struct places *places, struct picture *colour,
                                      struct picture *share);
// As a mask, snow.tif, that is finer than the share: 5400 x 2700, by the heights of the globe.
TRL_MUST_USE trl_result snow_write(const struct places *places, const struct picture *share,
                                   const int16_t *elevation);

// A whole globe of one kind of number, column 0 at 180 W, row 0 at 90 N: one of the two arrays,
// bands interleaved.
struct globe_values {
    uint32_t width, height, bands;
    const int16_t *shorts;
    const uint8_t *bytes;
};

// Writes NAME-north.tif and NAME-south.tif: the same about the poles in stereographic projection,
// square, to 70 degrees of latitude in the middle of the sides, with pixels of half the height of
// the globe's cells. Each is the mean of what it covers, so nothing of the globe's narrow
// columns is left. `body` is earth or mars.
TRL_MUST_USE trl_result polar_prepare(const struct places *places, const char *body,
                                      const char *name, const struct globe_values *globe);

// A model of a small area, opened as any raster is and written in longitude and latitude, as
// floats, in the middle of a margin without data into which its rim can run out (docs/data.md).
struct inset {
    const char *file, *name;
    uint32_t margin; // pixels
    bool has_sea;    // at 0 m, in the file: it gets a bed
};
// Heights in it: NaN is not known.
struct inset_grid {
    uint32_t width, height;
    double west_deg, north_deg, cell_deg;
    float *metres;
};
// Puts the sea's bed below the sea, and the globe's about it; after the globe's heights.
TRL_MUST_USE trl_result coast_make_bed(const struct places *places, const struct inset_grid *grid);
TRL_MUST_USE trl_result inset_prepare(const struct places *places, const struct inset *inset);

// Insets of Earth that are there.
TRL_MUST_USE trl_result earth_prepare_insets(const struct places *places);
// The model in Gale crater and the colours over it, where they are there; after the globe's
// colours.
TRL_MUST_USE trl_result mars_prepare_insets(const struct places *places);

// sRGB codes and light, 0 to 255 and 0 to 1.
double light_of_code(double code);
double code_of_light(double light);

// Heights of a whole globe, column 0 at 180 W, row 0 at 90 N.
struct heights {
    uint32_t width, height;
    float *metres; // owned
};

TRL_MUST_USE trl_result heights_reserve(const struct places *places, uint32_t width,
                                        uint32_t height, struct heights *out);
void heights_finish(const struct places *places, struct heights *heights);

// A file of nothing but 16-bit integers, column 0 at 0 E.
struct grid16 {
    const char *file;
    uint32_t width, height;
    bool is_big_endian;
    double metres_per_unit;
};
TRL_MUST_USE trl_result heights_read_grid(const struct places *places, const struct grid16 *grid,
                                          struct heights *out);

// A picture whose greys are offset_m + step_m * grey.
struct greys {
    const char *file;
    double offset_m, step_m;
};
TRL_MUST_USE trl_result heights_read_greys(const struct places *places, const struct greys *greys,
                                           struct heights *out);

// Heights in steps become the smoothest ones that round to them. `coarse`, half as fine, or NULL:
// has the true means of 2 x 2 cells.
TRL_MUST_USE trl_result heights_undo_steps(const struct places *places, struct heights *heights,
                                           double step_m, const struct heights *coarse);
// Where `polar_body` is not NULL, also about the poles.
TRL_MUST_USE trl_result heights_write(const struct places *places, const struct heights *heights,
                                      const char *name, const char *polar_body);

// Pictures of the ground are not albedos: they are stretched, and taken through air. Each channel
// is mapped linearly, in light, so that its 10th and 90th percentile by area between the latitudes
// become the albedos of the dark and the bright ground as measured (linear sRGB), and the brightest
// code that of frost or fresh craters.
struct albedo_map {
    const char *file, *name;
    double latitude_deg; // percentiles are taken from here south to here north
    double dark[3], bright[3], white[3];
    const char *polar; // the body, where the poles are to be written too; or NULL
};
TRL_MUST_USE trl_result albedo_prepare(const struct places *places, const struct albedo_map *map);

TRL_MUST_USE trl_result mars_prepare(const struct places *places);
TRL_MUST_USE trl_result moon_prepare(const struct places *places);
TRL_MUST_USE trl_result venus_prepare(const struct places *places);
TRL_MUST_USE trl_result titan_prepare(const struct places *places);

#endif // PREPARE_PREPARE_H
