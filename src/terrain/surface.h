// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_SURFACE_H
#define TERRAIN_SURFACE_H
// What the ground is: height, colour, water and night lights at any direction, from ordered layers
// of rasters. Height is answered on the CPU in double and on the GPU in float; the rest on the GPU,
// or, where there is none, by look.h.
//
// Rasters are held whole, with their mip chains, or, where they need more memory than they may
// have, in tiles that views load as they show them (stream.h). Nobody else sees which.

#include "terrain/anchor.h"
#include "terrain/biomes.h"
#include "terrain/continents.h"
#include "terrain/layer.h"
#include "terrain/noise.h"

enum surface_kind {
    SURFACE_ELEVATION,
    SURFACE_COLOUR,
    SURFACE_WATER, // 1 is open water
    SURFACE_LIGHTS,
    SURFACE_NORMAL, // laid over the slopes of the heights
    SURFACE_KIND_COUNT
};

// Of each kind that a surface holds, and that a program looks at: a fragment shader surely has 16
// samplers, and three are taken. surface_select chooses.
enum { SURFACE_MAX_LAYERS = 16, SURFACE_SEEN_LAYERS = 4 };

struct surface_layer_desc {
    enum surface_kind kind;
    const char *path;
    bool is_optional;   // a missing file is passed over
    double scale;       // elevation: metres per unit of the raster
    double offset_m;    // elevation
    double feather_rad; // width of the blend at the layer's borders and gaps
    double mode;        // of shared/blend.glsl; normals: over or add only
    bool has_bed;       // elevation: below the sphere is the sea's bed, whatever masks say
    // Colour: a mask instead of a picture, of what covers the ground with one linear sRGB.
    bool is_cover;
    float cover_rgb[3];
};

// What made-up relief leaves bare: nothing below the lower slope, all above the upper.
struct surface_rock {
    float albedo[3];  // linear sRGB
    double tint;      // part of its colour that is that of the pictures
    double slopes[2]; // tangents; both 0: no rock
};

// Made-up relief and colour below the resolution of the data.
struct surface_detail {
    double roughness;        // relative to the data's; 1 is as natural
    double albedo_variation; // standard deviation relative to a dark albedo, nearly
    double smallest_m;       // its shortest wavelength, > 0
    struct surface_rock rock;
};

// Whether the surface tells how deep open water is, by codes of shared/sea.glsl.
struct surface_depth {
    bool is_told;
    double everywhere_m; // below 0: from the heights below the masks that are held whole
};

struct surface_desc {
    double radius_m; // of the reference sphere
    size_t layer_count;
    const struct surface_layer_desc *layers; // later ones lie over earlier ones of their kind
    float default_albedo[3];                 // linear sRGB, where no picture is
    double exaggeration;                     // of all heights, > 0
    bool is_strict;                          // a raster that is no good is an error, not left out
    struct surface_detail detail;            // all 0: none
    struct noise_desc noise;                 // octaves: 0: none
    struct biomes biomes;                    // colours of invented ground
    struct continents_desc continents;       // height_m > 0: the ground is the noise's own
    struct surface_depth depth;
    double max_bytes; // of all rasters; what would need more is held in tiles
    bool waits;       // for tiles: every answer and frame is exact
};

// An empty surface of radius 1, albedo 0.3, at most 3 GB, that waits.
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
    struct terrain_noise noise;
    struct biomes biomes;
    struct surface_rock rock;
    bool is_invented;              // the noise's map is the ground below all layers
    struct surface_bounds *bounds; // owned; north row first, from 180 W
    double min_altitude_m, max_altitude_m;
    struct stream *stream; // owned; NULL: all layers are held whole
    struct surface_depth depth;
    // Owned, as masks: codes for their texels.
    uint8_t *depths[SURFACE_MAX_LAYERS];
    uint8_t *masks[SURFACE_MAX_LAYERS]; // owned, as long as somebody looks; of the water layers
};

// Reads and uploads all rasters. One that is there but no good (too many, beyond max_bytes, not
// fit, broken) is told in a line of the log and left out, or, where the surface is strict, an
// error.
// Returns TRL_OK; TRL_ERROR_IO (a file is missing that is not optional); TRL_ERROR_INVALID or
// TRL_ERROR_IO (strict); TRL_ERROR_MEMORY; TRL_ERROR_GPU. *out is zeroed on failure.
TRL_MUST_USE trl_result surface_init(struct gpu *gpu, const struct surface_desc *desc,
                                     struct surface *out);

// The same without a GPU: pictures are held on the CPU (look.h), and no pass can be made for it.
// Never TRL_ERROR_GPU.
TRL_MUST_USE trl_result surface_init_on_cpu(const trl_context *ctx, const struct surface_desc *desc,
                                            struct surface *out);

void surface_finish(struct surface *surface);

// Before a view is drawn: loads the tiles that it shows, as far as they are there, or all of them
// where the surface waits. TRL_ERROR_MEMORY; TRL_ERROR_GPU; TRL_ERROR_CANCELLED.
struct camera;
TRL_MUST_USE trl_result surface_update(struct surface *surface, const struct camera *camera,
                                       double pixel_rad);

// Grows whenever heights on the GPU have become others, because tiles came.
uint64_t surface_revision(const struct surface *surface);

// Whether that happened since a revision within `angle_rad` of a unit direction. What was made
// there of heights is to be made anew.
bool surface_has_changed(const struct surface *surface, uint64_t since, struct vec3 direction,
                         double angle_rad);

// Whether the last view that was updated shows all that it could.
bool surface_is_settled(const struct surface *surface);

// False: the passes of this folder have nothing to show that a bare sphere does not.
bool surface_has_layers(const struct surface *surface);

// Metres above the reference sphere in a direction from the planet's centre (of any length but 0).
double surface_altitude(const struct surface *surface, struct vec3 direction);

// The same without noise that goes on below the data, as layers hold it.
double surface_altitude_of_data(const struct surface *surface, struct vec3 direction);
// The same, of layers in tiles by the level that is held whole: it reads nothing.
double surface_altitude_of_held(const struct surface *surface, struct vec3 direction);

// What the octaves of the noise are added to there. Only where there is noise.
void surface_find_place(const struct surface *surface, struct vec3 direction,
                        struct noise_place *place);

// Of the masks of water that are held, the nearest texels, laid over each other: 255 is water; and
// one texel over what is below it.
uint8_t surface_mask(const struct surface *surface, double latitude, double longitude);
uint8_t surface_blend_mask(const struct terrain_layer *mask, uint8_t below, uint8_t value);

// Part that is a lake, linear between the texels of masks; 0 where none tells the depth of water,
// and with tiles.
double surface_lake(const struct surface *surface, double latitude, double longitude);

// Relief with noise there, before water, with its gradient along planet axes, and what it is made
// of. Only where there is noise.
Relief surface_relief(const struct surface *surface, struct vec3 direction,
                      struct noise_place *place);

// Bounds of all altitudes.
double surface_min_altitude(const struct surface *surface);
double surface_max_altitude(const struct surface *surface);

// Bounds of the altitudes within `angle_rad` around a unit direction; wider than the truth.
struct surface_bounds surface_bounds_around(const struct surface *surface, struct vec3 direction,
                                            double angle_rad);

size_t surface_count_layers(const struct surface *surface);

// From where layers are looked at.
struct surface_eye {
    struct vec3 up;    // unit, to it from the planet's centre
    double reach_rad;  // what is farther from there does not matter
    double height_rad; // above the ground, over the radius
    double least_rad;  // layers that look smaller are left out
    // How far a sphere that hides what is behind it is seen, and its radius, with no higher ground
    // than a layer has itself; 0: all that is in reach matters.
    double horizon_rad, solid_m;
};

// The layers of each kind that programs look at, in their order. Elevations: those in reach; of
// these and of other kinds as many as a program holds, the smallest left out first.
struct surface_selection {
    size_t counts[SURFACE_KIND_COUNT];
    size_t left_out[SURFACE_KIND_COUNT]; // of those in reach
    uint8_t indices[SURFACE_KIND_COUNT][SURFACE_MAX_LAYERS];
};
struct surface_selection surface_select(const struct surface *surface,
                                        const struct surface_eye *eye);

// How many layers of a kind a program can be asked to look at.
size_t surface_count_seen(const struct surface *surface, enum surface_kind kind);

// "#define"s of the numbers of layers, for programs that include terrain/layers.glsl.
enum { SURFACE_DEFINE_COUNT = 12, SURFACE_DEFINE_LENGTH = 48 };
struct surface_defines {
    char text[SURFACE_DEFINE_COUNT][SURFACE_DEFINE_LENGTH];
    const char *list[SURFACE_DEFINE_COUNT + 2]; // into text; two free for the caller
    size_t count;
};
// `elevations`: how many elevation layers the program looks at, up to surface_count_seen(). It is
// to be drawn with selections of as many.
void surface_get_defines(const struct surface *surface, size_t elevations,
                         struct surface_defines *out);

// Hands a program the selected layers and where they lie as seen from an anchor.
void surface_bind(const struct surface *surface, const struct surface_selection *selection,
                  const struct anchor *anchor, struct gpu_program *program);

#endif // TERRAIN_SURFACE_H
