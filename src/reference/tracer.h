// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_TRACER_H
#define REFERENCE_TRACER_H
// One path of light, followed backward from the eye. What the parts of it share; the parts are
//
//     collide.c   where the path's next event is: in the air, in a cloud, on the ground
//     scatter.c   into which direction it goes on
//     starlight.c what light of the star an event sends back along the path
//     tracer.c    the path as a whole
//
// A path carries up to four wavelengths. Each decision is drawn from the mixture of what each of
// them would want, in proportion to their weights, and each weight becomes what its own wavelength
// wants over that mixture: no choice can make the sum of the weights grow by more than the largest
// ratio of albedos, and none of them needs to be a "hero" (compare Wilkie et al. 2014, "Hero
// wavelength spectral sampling", whose balance heuristic this is, applied event by event).

#include "reference/air.h"
#include "reference/clouds.h"
#include "reference/optics.h"
#include "reference/phase_sampler.h"
#include "reference/star.h"
#include "reference/sun_guide.h"
#include "reference/surface.h"

// What there is: everything that does not depend on wavelength or observer.
struct reference_scene {
    const struct medium *medium;             // outlives the scene
    const struct reference_surface *surface; // NULL: the bare sphere of the medium
    const struct reference_clouds *clouds;   // NULL: none
    size_t occluder_count;
    const struct reference_occluder *occluders;
};

struct reference_world {
    struct reference_scene scene;
    struct reference_air air;
    struct phase_sampler samplers[MEDIUM_MAX_CONSTITUENTS];
    // How much a direction toward the star is worth more than others where this constituent
    // scatters next: 0 for smooth phase functions, to 1 for the sharpest.
    double sharpness[MEDIUM_MAX_CONSTITUENTS];
    double highest_phase; // of all constituents, sr^-1
    struct sun_guide guide;
};

TRL_MUST_USE trl_result reference_world_init(const trl_context *ctx,
                                             const struct reference_scene *scene,
                                             const struct reference_wavelengths *wavelengths,
                                             struct reference_world *world);
void reference_world_finish(const trl_context *ctx, struct reference_world *world);

// The world at up to four wavelengths.
struct reference_tracer {
    const struct reference_world *world;
    struct reference_optics optics;
    lanes4 nm;
    lanes4 colour_albedo[3]; // albedo of a red, a green and a blue surface
    lanes4 glow;             // radiance per unit irradiance of the star of ground with light 1
    int max_order;           // 0: all
};

// At `count` wavelengths. Colours are black until the caller sets colour_albedo and glow.
struct reference_tracer reference_tracer_make(const struct reference_world *world, const double *nm,
                                              int count);

// By what a piece of a ray is drawn: the scattering in it; that times the sunlight there; and in
// twilight the root of the first, for the thin air high up that sees more of the glow than its
// share.
enum reference_density { BY_SCATTERING, BY_SUNLIGHT, BY_HEIGHT, DENSITY_COUNT };

// A piece of a ray with what a collision in it is worth.
struct reference_stretch {
    struct reference_piece piece;
    lanes4 depth;         // optical
    lanes4 transmittance; // to its begin
    lanes4 passed;        // transmittance of the stretch itself
    lanes4 worth;         // the transmittance times the part of collisions that scatter, nearly
    lanes4 scattered;     // chance of a collision in it that scatters, nearly
    double density[DENSITY_COUNT];
};

// What one thread works with.
struct reference_scratch {
    struct reference_stretch *stretches;
};
size_t reference_max_stretches(const struct reference_air *air);

struct reference_path {
    struct random_stream random;
    struct reference_star star;
    struct vec3 position; // from the planet's centre
    struct vec3 direction;
    lanes4 weight;
    lanes4 radiance; // so far, per unit irradiance of the star
    int order;       // of the event that comes next, from 1
    bool is_on_ground;
    struct vec3 normal; // on the ground
    bool is_on_sea;     // it is open water; then:
    struct reference_facets facets;
    lanes4 albedo;
    struct reference_columns densities; // in the air
    bool is_in_cloud;                   // the event is a cloud's, not the air's: densities are 0
};

static inline double reference_next(struct reference_path *path)
{
    return random_next(&path->random);
}

// Shares of the wavelengths in a decision; their sum is 1.
static inline lanes4 reference_shares(const struct reference_path *path)
{
    return path->weight / lanes4_sum(&path->weight);
}

// The vector at a given angle about `axis`, a unit vector.
struct vec3 reference_turn(struct vec3 axis, double cosine, double azimuth);

// Radius of the path's place, between the bottom and the top of the air.
double reference_path_radius(const struct reference_tracer *tracer,
                             const struct reference_path *path);

// Where the sky is bright after sunset: a lobe toward the sun's side, a little above the
// horizontal. Its share is none by day.
struct reference_glow {
    struct vec3 axis;
    double share;
};
struct reference_glow reference_find_glow(const struct reference_path *path);

// Moves a path that starts above the air to where it enters; false if it never does.
bool reference_enter(const struct reference_world *world, struct reference_path *path);

// To the next event; false if the path comes to nothing. Adds the ground's own light.
bool reference_advance(const struct reference_tracer *tracer, struct reference_scratch *scratch,
                       struct reference_path *path);

// Adds sunlight that the event sends back along the path, from a random point of the star's disc.
void reference_add_starlight(const struct reference_tracer *tracer, struct reference_path *path);

// Chooses the direction in which the path goes on. Where directions may be drawn into the star's
// disc, adds its light if this one is.
void reference_redirect(const struct reference_tracer *tracer, struct reference_path *path);

// Density in sr^-1 with which reference_redirect draws a direction.
double reference_direction_density(const struct reference_tracer *tracer,
                                   const struct reference_path *path, struct vec3 direction);

// Whether light of the star's disc is shared between the two ways to find it: where phase
// functions are so sharp that one alone would rarely find much.
bool reference_shares_disc(const struct reference_tracer *tracer,
                           const struct reference_star *star);

// What is left of light on its way out of the air, from the path's place in a direction: 0 if the
// ground or a body is in the way. May be drawn at random, with the right mean, where it is small.
lanes4 reference_transmittance(const struct reference_tracer *tracer, struct reference_path *path,
                               struct vec3 direction);

// What the ground sends from a direction back along the path, times the cosine, over its albedo:
// the weight has that already, except of the sea's.
lanes4 reference_ground_value(const struct reference_tracer *tracer,
                              const struct reference_path *path, struct vec3 direction);

// Phase function of the mixture, or of the cloud, at the path's place, sr^-1.
lanes4 reference_phase(const struct reference_tracer *tracer, const struct reference_path *path,
                       double cosine);

// From the eye: position, direction, star and random stream are set; the rest becomes the path's.
void reference_trace(const struct reference_tracer *tracer, struct reference_scratch *scratch,
                     struct reference_path *path);

// One scratch per thread, in one array.
struct reference_scratches {
    struct reference_scratch *of;
    size_t count;
};
TRL_MUST_USE trl_result reference_scratches_init(const trl_context *ctx,
                                                 const struct reference_air *air,
                                                 struct reference_scratches *scratches);
void reference_scratches_finish(const trl_context *ctx, struct reference_scratches *scratches);

#endif // REFERENCE_TRACER_H
