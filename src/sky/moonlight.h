// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_MOONLIGHT_H
#define SKY_MOONLIGHT_H
// The light of a body on ground and air, in the model spectral: the solved atmosphere is linear in
// the star's light and holds for any place of the star, so a body is a second star of another
// colour. It is drawn after the star's light and added, by programs of its own, and only where it
// can be seen beside the star's. docs/physics.md, section 24.

#include "sky/pixels.h"
#include "sky/spectral_maps.h"
#include "sky/spectral_sea.h"

struct moonlight {
    struct gpu *gpu;
    struct spectral_sea *sea; // the star's; mirrors the same for any light
    size_t body_count;
    struct body_desc bodies[CAMERA_MAX_BODIES];
    struct spectral_maps maps; // with the atmosphere of others; made when first asked for
    bool has_programs;         // the same, with those for:
    bool has_clouds;
    struct gpu_program air, ground_bare, ground_surface;
};

// The sea must outlive it, and be prepared before a draw, also without an eclipse.
void moonlight_init(const struct sky_desc *desc, struct spectral_sea *sea, struct moonlight *out);
void moonlight_finish(struct moonlight *moonlight);

// Before the atmosphere goes away: what was made for it.
void moonlight_drop(struct moonlight *moonlight);

// The body whose light is the strongest, if it matters: at the place in view that is most
// favourable for it, it adds more than can be overlooked to the star's light where that is weakest.
struct sky_moon moonlight_find(const struct moonlight *moonlight,
                               const struct atmosphere *atmosphere, const struct camera *camera,
                               double highest_m);

// Makes the maps of the view's moon, if there is one, beside the star's.
TRL_MUST_USE trl_result moonlight_prepare(struct moonlight *moonlight,
                                          const struct spectral_maps *star,
                                          const struct sky_view *view);

// The uniforms of sky/ray.glsl, and of sky/spectral/air.glsl with light on ground and clouds, for
// programs with the define MOON.
void moonlight_bind(const struct moonlight *moonlight, const struct sky_pixels *pixels,
                    const struct sky_view *view, struct gpu_program *program);

// Adds its light to the target.
TRL_MUST_USE trl_result moonlight_draw(struct moonlight *moonlight, const struct sky_pixels *pixels,
                                       const struct sky_view *view);

#endif // SKY_MOONLIGHT_H
