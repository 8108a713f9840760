// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SKY_H
#define SKY_SKY_H
// The sky behind one interface: a model is made for a medium, prepared for a view, and draws every
// pixel, either lit ground behind air, or sky with the star's disc. What models share is in
// pixels.h; each has a file of its own and a folder below shaders/sky/.
//
//     in   surface buffers (frame/ground.h), or none for a bare sphere
//     out  radiance   RGBA32F     linear sRGB, cd m^-2
//     out  kinds      DEPTH32F    scratch; see sort.frag

#include "base/camera.h"
#include "gpu/condition.h"
#include "gpu/pass.h"
#include "scatter/medium.h"
#include "sky/body_light.h"
#include "sky/sea.h"
#include <terrella/renderer.h>

struct bands;

struct sky_desc {
    struct gpu *gpu;
    const struct medium *medium;       // must outlive the sky
    uint32_t wavelengths;              // to solve for, by models that solve
    uint32_t orders;                   // of scattering, by models that know several; 0: all
    const trl_rayleigh_desc *rayleigh; // needed during create only, checked
    const struct sky_sea *sea;         // NULL: none; must outlive the sky
    size_t body_count;                 // CAMERA_MAX_BODIES at most
    const struct body_desc *bodies; // needed during create only, but for the spectra in it, which
                                    // must outlive the sky
};

// A body that lights ground and air so that it can be seen, beside the star.
struct sky_moon {
    bool is_there;
    // It lights the ground below the eye more than the star does, which shines on no ground in
    // sight: then terrain's shadow is the body's.
    bool is_main;
    unsigned index;          // in the scene's list
    struct body_sight sight; // from the ground below the eye
};

struct sky_surface {
    const struct gpu_texture *position; // NULL: bare sphere, and the others too
    const struct gpu_texture *albedo, *normal, *lights, *region; // see frame/ground.h
    const struct gpu_texture *kinds;                             // DEPTH32F, see terrain/kinds.h
    const struct gpu_texture *facets;      // of open water, as of ocean/facets.h; NULL: no ocean
    const struct gpu_condition *has_water; // some pixel has; NULL: not known
    double lights_cd_m2;                   // luminance of white lights
};

// How the model single draws a bare sphere.
struct sky_spheres {
    uint32_t side;      // vertices a side of each sphere; 0: by pixels, as all else is drawn
    bool has_integrals; // the vertices integrate, else fragments look up
    uint32_t steps;     // of each integral
};

// Terrain's shadow on the air.
struct sky_shadow {
    // Hands it to a program that includes terrain/shadow.glsl; with a bare sphere never called.
    void (*bind)(const void *self, const struct camera *camera, struct gpu_program *program);
    const void *self;
    double highest_m; // altitude of the highest ground that can be seen
};

// One picture.
struct sky_view {
    const struct camera *camera;
    double highest_m; // altitude of the highest ground
    struct sky_surface surface;
    struct sky_spheres spheres;

    // See cloud/shade.h: of the body that is main, else of the star; NULL: no clouds.
    const struct gpu_texture *cloud_shade;
    // As cloud/deck.h makes it, where there is cloud_shade: toward the star until clouds are drawn,
    // then toward the moon, if that is main.
    const struct gpu_texture *cloud_deck;
    const float *cloud_deck_place;    // and its u_deck_map
    double cloud_top_m;               // altitude of the highest
    const struct gpu_texture *hidden; // by clouds, as gpu/hide.h has it; NULL: nothing is
    struct sky_shadow shadow;         // of the body that is main, else of the star
    struct sky_moon moon;
    bool is_added; // to what the target holds
    trl_air air;
    const struct gpu_target *target; // with a depth texture that nobody else uses meanwhile
};

// An eye below this altitude counts as there, for every model (AERIAL_MIN_ALTITUDE_M is the same).
#define SKY_MIN_ALTITUDE_M 0.5

// What a program that includes sky/spectral/air.glsl takes from a model that has such air.
struct sky_air {
    int peaked_count;
    const struct bands *bands;
    bool has_march;   // with the define MARCH
    bool has_eclipse; // with the define ECLIPSE
    // Sets what sky/ray.glsl needs, with `whole` also the maps of the air and of light on the
    // ground.
    void (*bind)(const void *self, const struct sky_view *view, bool whole,
                 struct gpu_program *program);
    // The same, whole, for light of the view's moon, which is added, with the define MOON in place
    // of those above. NULL: there is none.
    void (*bind_moon)(const void *self, const struct sky_view *view, struct gpu_program *program);
    const void *self;
};

struct sky_model {
    // TRL_ERROR_GPU, TRL_ERROR_MEMORY, TRL_ERROR_UNSUPPORTED (a texture format), what solving may
    // return. *self is NULL on failure.
    trl_result (*create)(const struct sky_desc *desc, void **self);
    void (*destroy)(void **self);
    // Makes the maps of this eye and star; nothing when neither has changed.
    trl_result (*prepare)(void *self, const struct sky_view *view);
    // Between both, where there is get_air: what terrain and clouds shade of it. NULL: nothing.
    trl_result (*shade)(void *self, const struct sky_view *view);
    // Draws all pixels of the target that are not hidden.
    trl_result (*draw)(void *self, const struct sky_view *view);
    // Goes over to another medium of the same planet and star, which need live only until the call
    // returns, while draws go on with the old one. NULL: the sky is made anew instead.
    trl_result (*change)(void *self, const struct medium *medium);
    // Whether draws show the medium last changed to, as fine as it gets. NULL: always.
    bool (*is_settled)(const void *self);
    // The body whose light counts in this view. NULL: the model knows no light but the star's.
    struct sky_moon (*find_moon)(const void *self, const struct camera *camera, double highest_m);
    // NULL: the model has no such air. For a view that was prepared, and of which it was shaded.
    struct sky_air (*get_air)(const void *self, const struct sky_view *view);
    // What it looks at in the surface; what no model looks at need not be drawn.
    bool reads_sky_view; // alpha of region, and of lights where there is no water
};

extern const struct sky_model sky_spectral; // spectral.c
extern const struct sky_model sky_single;   // single.c
extern const struct sky_model sky_rayleigh; // rayleigh.c

enum { SKY_MODELS = TRL_SKY_RAYLEIGH + 1 }; // that make pictures

// Any of the models.
struct sky {
    const struct sky_model *model;
    void *self;
};

// TRL_ERROR_INVALID: pictures are not made by that model; else as sky_model.create.
TRL_MUST_USE trl_result sky_init(const struct sky_desc *desc, trl_sky_model model, struct sky *out);
void sky_finish(struct sky *sky);
TRL_MUST_USE trl_result sky_prepare(struct sky *sky, const struct sky_view *view);
TRL_MUST_USE trl_result sky_shade(struct sky *sky, const struct sky_view *view);
TRL_MUST_USE trl_result sky_draw(struct sky *sky, const struct sky_view *view);
// The desc as for sky_init, with the new medium.
TRL_MUST_USE trl_result sky_change(struct sky *sky, const struct sky_desc *desc);
// None where the model knows none.
struct sky_moon sky_find_moon(const struct sky *sky, const struct camera *camera, double highest_m);
bool sky_is_settled(const struct sky *sky);
// `bind` is NULL where the model has none.
struct sky_air sky_get_air(const struct sky *sky, const struct sky_view *view);

#endif // SKY_SKY_H
