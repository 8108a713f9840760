// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_WAVES_H
#define OCEAN_WAVES_H
// The waves of a planet's sea: drawn from a spectrum with a seed, laid on the sphere, and, for an
// eye and a time, as the shaders take them (shared/gerstner.glsl).
//
// A wave has one direction near a place only. So the planet has cells, in each of which the waves
// are those of the wind as it blows at its middle: their origins lie a quarter of the planet's
// circumference away. Near a border an eye has the waves of both cells, with their energy shared:
// which waves there are depends on where the eye is alone, and continuously
// (docs/decisions/033-waves-in-cells.md).

#include "base/vec3.h"
#include "ocean/ocean.h"
#include "ocean/sea.h"
#include "shared/gerstner.glsl"

// One of the spectrum.
struct wave_component {
    double amplitude_m, wavenumber_per_m, omega_per_s;
    double bearing_rad; // where it travels to, clockwise from north
};

// Owner: caller. Threads: any, unchanged after waves_init.
struct waves {
    const trl_context *ctx;
    double radius_m; // of the sea's level
    struct ocean_waves wind;
    double gravity_m_s2;
    uint32_t seed;
    uint32_t count;
    struct wave_component *components; // owned; the longest first
    double mean_square_slope;          // of the components
    double rest_square;                // of all shorter waves, beyond them
    double breaking_per_m;             // of sea_breaking
    struct sea_surf surf;              // foam
};

// `total_square`: mean square slope of the whole surface. The shortest components are left out
// where they alone would make more than it. TRL_ERROR_MEMORY.
struct waves_desc {
    const trl_context *ctx;
    const struct ocean_desc *ocean;
    double radius_m;
    double total_square;
};
TRL_MUST_USE trl_result waves_init(const struct waves_desc *desc, struct waves *out);
void waves_finish(struct waves *waves);

// Four times the deviation of the height.
double waves_significant_height_m(const struct waves *waves);

// Waves as an eye has them: 28 bytes each, four side by side in seven texels of RGBA32F (their
// numbers in the order of GerstnerWave), the longest first. What is beyond the count has amplitude
// 0.
enum { WAVES_MAX_CELLS = 4, WAVES_LANES = 4, WAVES_FIELDS = 7 };
enum { WAVES_MAX_GROUPS = WAVES_MAX_CELLS * OCEAN_MAX_WAVES / WAVES_LANES };
struct waves_view {
    uint32_t count, groups;
    double height_part; // significant height, over that of the waves' own fetch
    float texels[WAVES_MAX_GROUPS][WAVES_FIELDS][WAVES_LANES];
};

struct waves_eye {
    struct vec3 place; // any length but 0
    double time_s;
    double fetch_m;
};

// For an eye above that place (any length but 0), which is the anchor; axes east, north and up.
// Phases are found in double: after any number of days they are right to 1e-16 of the angle turned
// through. Q is 1 from the longest wave on, as far as no sum of crests makes a loop, and 0 of the
// others.
void waves_view_make(const struct waves *waves, struct vec3 place, double time_s,
                     struct waves_view *out);

// The same where the wind has blown over no more than that: what it could not have raised is
// missing, and the height is that of such a sea.
void waves_view_make_within(const struct waves *waves, const struct waves_eye *eye,
                            struct waves_view *out);

// Where the sea stands below the anchor: which place waves move there (a long one moves all water
// near it by metres), and how high. `side_m`: of what floats there, and follows no shorter waves.
// `part`: of all displacement.
struct waves_stand {
    double east_m, north_m, height_m;
};
struct waves_stand waves_stand_find(const struct waves_view *view, double radius_m, double side_m,
                                    double part);

// Column-major mat3 from planet axes to those of the anchor.
void waves_local_from_planet(struct vec3 place, float matrix[9]);

// One of them as C's formulas take it.
GerstnerWave waves_view_get(const struct waves_view *view, uint32_t index);

#endif // OCEAN_WAVES_H
