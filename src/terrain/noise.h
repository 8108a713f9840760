// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_NOISE_H
#define TERRAIN_NOISE_H
// Relief made of noise: as the ground of an invented planet, and below the resolution of data. A
// map of the whole planet, made once, says how high the ground is without it, and how rough it is;
// octaves from a few of its texels, or of the data's, down to decimetres are added where they are
// asked for, by the same formulas on the CPU (here, in double) and the GPU (terrain/noise.glsl).

#include "gpu/program.h"
#include "gpu/texture.h"
#include "shared/relief.glsl"
#include "terrain/anchor.h"

enum noise_form {
    NOISE_PLAIN,  // hills alike everywhere
    NOISE_RIDGED, // ridges along which the noise is 0, rougher than the valleys between
    NOISE_ERODED, // ridges, and gullies down their slopes
    NOISE_FORM_COUNT
};

enum { NOISE_MAX_OCTAVES = 24 };

struct noise_desc {
    uint32_t seed;
    enum noise_form form;
    int octaves;             // at most NOISE_MAX_OCTAVES of them; 0: no noise
    double wavelength_m;     // of the first
    double mountain_m;       // longer waves are hardly higher; sizes are relative to this one
    double gully_m;          // the longest of NOISE_ERODED
    double lacunarity;       // ratio of wavelengths, > 1
    double hurst;            // sizes go with the wavelength to this power
    double smallest_m;       // shorter waves are left out
    double level_roughness;  // of level ground relative to steep, below the gullies
    double full_height_m;    // nearer to altitude 0 it is less rough; 0: everywhere alike
    double albedo_variation; // of the colours of data
    bool has_sea;            // ground below altitude 0 is level water
};

// What the map says at a texel; the order is the texture's.
struct noise_texel {
    float height_m;
    float amplitude_m; // of an octave of the wavelength of mountains
    float ridged;      // 0 plain, 1 ridged
    float climate;     // -1 dry to 1 wet
};

// Equirectangular, north row first, from 180 W.
struct noise_map {
    uint32_t width, height;
    struct noise_texel *texels; // owned
};

// Owner: whoever made it. Must not outlive its gpu. Threads: queries from any.
struct terrain_noise {
    const trl_context *ctx;
    struct noise_desc desc;
    double radius_m;
    int ends[3]; // octaves of noise, of gullies after them, of noise after those: the last is all
    double wave_m[NOISE_MAX_OCTAVES];
    double log2_wave[NOISE_MAX_OCTAVES];
    double size[NOISE_MAX_OCTAVES];       // relative to that of mountains
    uint32_t shift[NOISE_MAX_OCTAVES][3]; // lattice points, by the seed
    struct vec3 lattice[3][3];            // rows; octaves take turns
    struct noise_map map;
    double steepest_spread;     // of the map's amplitude, m per m
    struct gpu_texture texture; // none without a GPU
};

// Takes the map, which is freed with it, also on failure. `gpu`: NULL for none. TRL_ERROR_GPU;
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result noise_init(struct gpu *gpu, const struct noise_desc *desc,
                                   struct noise_map *map, struct terrain_noise *out);
void noise_finish(struct terrain_noise *noise);

bool noise_is_there(const struct terrain_noise *noise);

// The map at a place, smooth between texels. Vectors along planet axes, tangential, m per m.
struct noise_ground {
    double height_m, amplitude_m, ridged, climate;
    struct vec3 slope;  // of the height
    struct vec3 spread; // of the amplitude
    double dry;         // part of the octaves that water leaves: shore_dry; and of that, what it
    double dry_per_m;   // changes by in a m at most
};
// All dry.
struct noise_ground noise_ground_at(const struct terrain_noise *noise, struct vec3 up);

// log2 of a footprint that sees all octaves.
#define NOISE_ALL (-100.0)

// What is below octaves: the ground without them at a unit direction, what its data resolve, and
// log2 of the size in m of what is asked for (a large negative number: all).
struct noise_place {
    struct vec3 up;
    struct noise_ground ground;
    ReliefData data;
    double log2_footprint;
    int octaves; // so many of the longest; NOISE_MAX_OCTAVES: all
};

// With the octaves, before water; vectors along planet axes.
Relief noise_relief_at(const struct terrain_noise *noise, const struct noise_place *place);

// The normal of ground that stands so (altitude with its octaves, slope as a tangent, unit normal),
// with what is too small for heights where it is steep.
struct noise_stand {
    double height_m, slope;
    struct vec3 normal;
};
struct vec3 noise_rock_normal(const struct terrain_noise *noise, const struct noise_place *place,
                              const struct noise_stand *stand);

// Altitudes that octaves can add to ground of an amplitude and fold: down (negative) and up.
struct noise_reach {
    double down_m, up_m;
};
struct noise_reach noise_find_reach(const struct terrain_noise *noise, double amplitude_m,
                                    double ridged);

// What is known of the ground around a place, without octaves.
struct noise_around {
    double reach_m;       // how far from it
    double range_m;       // how much heights differ there at most
    double steepest;      // m per m
    double log2_texel[2]; // between what log2 of the size in m of what it resolves stays
};

// Upper bounds of how much higher ground may be, anywhere within a reach of a place: than the
// relief of the longest octaves there, and how many those are; than the ground without octaves.
struct noise_rise {
    int octaves;
    double rise_m, most_m;
};
double noise_find_most(const struct terrain_noise *noise, const struct noise_ground *ground,
                       double reach_m); // the latter alone, whatever data resolve
struct noise_rise noise_find_rise(const struct terrain_noise *noise,
                                  const struct noise_place *place,
                                  const struct noise_around *around);

// The steepest slope of the map's heights, at most.
double noise_find_steepest(const struct terrain_noise *noise);

// The shortest wavelength, m.
double noise_shortest_m(const struct terrain_noise *noise);

// The footprint in m from which on no octave is seen; 0: there is none.
double noise_unseen_m(const struct terrain_noise *noise);

// Whether pixels of this size on the ground show any octave.
bool noise_is_seen(const struct terrain_noise *noise, double footprint_m);

// Hands it to a program that includes terrain/noise.glsl.
void noise_bind(const struct terrain_noise *noise, const struct anchor *anchor,
                struct gpu_program *program);

#endif // TERRAIN_NOISE_H
