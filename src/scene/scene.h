// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H
// A scene as read from its file: physics, surface layers, named views.

#include "cloud/cloud.h"
#include "ocean/ocean.h"
#include "scatter/medium.h"
#include "sky/body_light.h"
#include <terrella/scene.h>

enum { SCENE_MAX_LAYERS = 32, SCENE_MAX_VIEWS = 256, SCENE_MAX_BODIES = TRL_VIEW_MAX_BODIES };

enum layer_kind {
    LAYER_ELEVATION, // metres above the reference sphere
    LAYER_COLOUR,    // sRGB picture of the ground's albedo
    LAYER_WATER,     // 1 = open water
    LAYER_LIGHTS,    // sRGB picture of artificial light at night
    LAYER_NORMAL,    // picture of normals of the map
    LAYER_SNOW       // 1 = covered by snow; lies over colours
};

// How a layer is laid over those of its kind below it, in the order of shared/blend.glsl.
enum layer_blend {
    LAYER_BLEND_OVER,
    LAYER_BLEND_ADD,
    LAYER_BLEND_MULTIPLY,
    LAYER_BLEND_MAX,
    LAYER_BLEND_MIN
};

// One raster of the surface; later layers of a kind lie over earlier ones where they have data.
struct layer {
    enum layer_kind kind;
    char *name; // owned
    char *file; // owned; as in the scene
    char *path; // owned; where it was found: beside the scene, else in the data folder; the latter
                // also when it is in neither
    bool is_optional;   // a missing file is no error
    double scale;       // elevation: metres per unit of the raster
    double offset_m;    // elevation
    bool has_bed;       // elevation: what is below the sphere is the sea's bed
    double feather_deg; // width of the blend at the layer's border and gaps
    enum layer_blend blend;
    double radiance_cd_m2;  // lights: luminance of white
    struct spectrum albedo; // snow: of what covers the ground
};

// What is left bare where the ground is steep.
struct scene_rock {
    bool is_there;
    struct spectrum albedo;
    double tint; // part of its colour that is that of the layers there, if that is no brighter
    double slope_deg, feather_deg;
};

// Made-up ground below the resolution of the layers; all 0: none.
struct scene_detail {
    double roughness; // slopes relative to the data's
    double albedo_variation;
    double smallest_m; // shortest wavelength
    struct scene_rock rock;
};

// Ground made of noise, below all layers.
struct scene_noise {
    bool is_there;
    int form; // enum noise_form
    double seed, octaves, lacunarity, hurst;
    double continents_m, height_m;   // wavelength; of ranges over plains
    double mountains_m, amplitude_m; // wavelength; of the noise in ranges
    double smallest_m, level_roughness, ocean_share;
};

enum { SCENE_BIOME_RANGES = 5, SCENE_MAX_BIOMES = 16 };
struct scene_biome_range {
    double low, high, feather;
};
struct scene_biome {
    struct spectrum albedo; // owned
    double variation;
    // Of altitude in m, slope, latitude and temperature in degrees, moisture.
    struct scene_biome_range ranges[SCENE_BIOME_RANGES];
};
struct scene_climate {
    double equator_C, pole_C, lapse_C_per_km;
};

// A moon or another planet; views say where it is.
struct scene_body {
    char *name; // owned
    double radius_m;
    double distance_m;                // of its centre from the planet's, where a view says no other
    struct spectrum geometric_albedo; // fully lit, relative to a Lambertian disc facing the star
    enum body_law phase_law;
};

// What a body's distance must be above, in metres: clear of the planet and its air.
double scene_body_nearest_m(const struct trl_scene *scene, const struct scene_body *body);

// The sky around.
struct scene_stars {
    char *file, *path; // owned, as those of a layer; NULL: no catalogue
    bool is_optional;
    double limit_magnitude;                                // fainter ones are left out
    double pole_right_ascension_rad, pole_declination_rad; // of the planet's north pole
    double background_cd_m2; // at the zenith, of everything that is no single star; 0: none
    double airglow_share;    // of it
};

struct trl_scene {
    const trl_context *ctx;
    char *name;
    struct medium medium;
    trl_sky_model sky_model;
    trl_rayleigh_desc rayleigh;
    size_t layer_count;
    struct layer layers[SCENE_MAX_LAYERS];
    double exaggeration; // of all heights
    struct scene_detail detail;
    struct scene_noise noise;
    struct scene_climate climate;
    size_t biome_count;
    struct scene_biome biomes[SCENE_MAX_BIOMES];
    struct ocean_desc ocean;
    struct cloud_desc clouds;
    struct scene_stars stars;
    size_t body_count;
    struct scene_body bodies[SCENE_MAX_BODIES];
    size_t view_count;
    char *view_names[SCENE_MAX_VIEWS];
    trl_view views[SCENE_MAX_VIEWS];
};

#endif // SCENE_SCENE_H
