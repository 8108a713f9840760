// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_FRAME_H
#define TERRAIN_FRAME_H
// Where the texels of a raster lie on the sphere, in its own map projection. Knows nothing of how
// texels are kept.

#include "base/vec3.h"
#include "raster/raster.h"

// Map coordinates are those of shared/projection.glsl turned into the raster: x to the right, y up.
// Equirectangular: longitude and latitude in radians; stereographic: radians at the pole.
struct layer_frame {
    uint32_t width, height;
    double centre_x, centre_y; // of the raster, on the map
    double half_width, half_height;
    double texel_width, texel_height;
    double feather; // on the map
    bool is_whole_circle, touches_north, touches_south;
    double pole;        // 1 north, -1 south; 0: equirectangular
    double longitude_0; // stereographic only: see struct raster_plane
    double e2;
    double least_latitude; // stereographic: no place of it is farther from its pole
    struct vec3 direction; // unit: middle of a cap that holds all of it
    double reach_rad;      // angle of that cap; pi: everywhere
};

// A place as columns and rows of a layer, (0, 0) the first texel's centre.
struct layer_place {
    double x, y;
    double weight; // 0 outside; grows to 1 over the feather
};

// Frame of an opened raster that is reduced to width x height texels.
struct layer_frame layer_frame_of(const struct raster *raster, uint32_t width, uint32_t height,
                                  double feather);

// True where a look at the latitude tells that a place is outside; spares layer_locate.
static inline bool layer_is_beyond(const struct layer_frame *frame, double latitude)
{
    return frame->pole != 0 && frame->pole * latitude < frame->least_latitude;
}

struct layer_place layer_locate(const struct layer_frame *frame, double latitude, double longitude);

// The inverse: latitude and longitude in radians of a column and row.
struct layer_geo {
    double latitude, longitude;
};
struct layer_geo layer_geo_of(const struct layer_frame *frame, double x, double y);

// Index of texel (x, y): columns wrap around and rows run over a pole where the layer does; beyond
// other borders stands the border's own.
size_t layer_texel_index(const struct layer_frame *frame, int64_t x, int64_t y);

// How the frame is seen from an anchor: the vectors of these names in shaders/terrain/layers.glsl.
struct layer_view {
    double place[4], shape[4], turn[4];
};
struct layer_view layer_view_from(const struct layer_frame *frame, double latitude,
                                  double longitude);

#endif // TERRAIN_FRAME_H
