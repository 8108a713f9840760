// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_SURFACE_H
#define TERRAIN_SURFACE_H
// What the ground is: height, colour, water and night lights at any direction, from ordered layers
// of rasters. Height is answered on the CPU in double and on the GPU in float; the rest on the GPU,
// or, where there is none, by look.h.
//
// Rasters are held whole, with their mip chains. (Streaming of larger ones will stand behind
// struct terrain_layer: nobody else sees how texels come to be there.)

#include "terrain/anchor.h"
#include "terrain/detail.h"
#include "terrain/layer.h"

enum surface_kind {
    SURFACE_ELEVATION,
    SURFACE_COLOUR,
    SURFACE_WATER, // 1 is open water
    SURFACE_LIGHTS,
    SURFACE_KIND_COUNT
};

// Of each kind, and together: a fragment shader surely has 16 samplers, and three are taken.
enum { SURFACE_MAX_LAYERS = 4, SURFACE_MAX_ALL_LAYERS = 13 };

struct surface_layer_desc {
    enum surface_kind kind;
    const char *path;
    bool is_optional;   // a missing file is passed over
    double scale;       // elevation: metres per unit of the raster
    double offset_m;    // elevation
    double feather_rad; // width of the blend at the layer's borders
};

struct surface_desc {
    double radius_m; // of the reference sphere
    size_t layer_count;
    const struct surface_layer_desc *layers; // later ones lie over earlier ones of their kind
    float default_albedo[3];                 // linear sRGB, where no picture is
    struct detail_desc detail;               // all 0: none
    double max_bytes; // rasters that would need more are refused; see default
};

// An empty surface of radius 1, albedo 0.3, at most 3 GB.
struct surface_desc surface_desc_default(void);

// Lowest and highest altitude in a cell of an equirectangular table, reconstruction included.
struct surface_bounds {
    float min, max;
};
enum { SURFACE_BOUNDS_COLUMNS = 256, SURFACE_BOUNDS_ROWS = 128 };

// Owner: caller. Must outlive the passes made for it. Threads: altitude queries from any.
struct surface {
    const trl_context *ctx;
    struct gpu *gpu; // NULL: on the CPU only
    double radius_m;
    float default_albedo[3];
    size_t counts[SURFACE_KIND_COUNT];
    struct terrain_layer layers[SURFACE_KIND_COUNT][SURFACE_MAX_LAYERS];
    struct detail detail;
    struct surface_bounds *bounds; // owned; north row first, from 180 W
    double min_altitude_m, max_altitude_m;
};

// Reads and uploads all rasters. Returns TRL_OK; TRL_ERROR_INVALID (too many layers, or a raster
// beyond max_bytes or not fit); TRL_ERROR_IO; TRL_ERROR_MEMORY; TRL_ERROR_GPU. *out is zeroed on
// failure.
TRL_MUST_USE trl_result surface_init(struct gpu *gpu, const struct surface_desc *desc,
                                     struct surface *out);

// The same without a GPU: pictures are held on the CPU (look.h), there is no detail, and no pass
// can be made for it. Never TRL_ERROR_GPU.
TRL_MUST_USE trl_result surface_init_on_cpu(const trl_context *ctx, const struct surface_desc *desc,
                                            struct surface *out);

void surface_finish(struct surface *surface);

// False: the passes of this folder have nothing to show that a bare sphere does not.
bool surface_has_layers(const struct surface *surface);

// Metres above the reference sphere in a direction from the planet's centre (of any length but 0).
double surface_altitude(const struct surface *surface, struct vec3 direction);

// Bounds of all altitudes.
double surface_min_altitude(const struct surface *surface);
double surface_max_altitude(const struct surface *surface);

// Bounds of the altitudes within `angle_rad` around a unit direction; wider than the truth.
struct surface_bounds surface_bounds_around(const struct surface *surface, struct vec3 direction,
                                            double angle_rad);

// How many elevation layers, from the first, a program must look at to see all that reach within
// `angle_rad` of a unit direction.
size_t surface_count_elevations(const struct surface *surface, struct vec3 direction,
                                double angle_rad);

// "#define"s of the numbers of layers, for programs that include terrain/layers.glsl.
enum { SURFACE_DEFINE_COUNT = 6, SURFACE_DEFINE_LENGTH = 48 };
struct surface_defines {
    char text[SURFACE_DEFINE_COUNT][SURFACE_DEFINE_LENGTH];
    const char *list[SURFACE_DEFINE_COUNT + 2]; // into text; two free for the caller
    size_t count;
};
// `elevations`: how many of the elevation layers the program looks at, from the first.
void surface_get_defines(const struct surface *surface, size_t elevations,
                         struct surface_defines *out);

// Hands a program the layers and where they lie as seen from an anchor.
void surface_bind(const struct surface *surface, const struct anchor *anchor,
                  struct gpu_program *program);

#endif // TERRAIN_SURFACE_H
