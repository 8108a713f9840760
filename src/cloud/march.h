// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUD_MARCH_H
#define CLOUD_MARCH_H
// Draws clouds: first, since what they hide need not be drawn; their shade; and, into a picture
// that has all else, themselves. docs/physics.md, section 29.
//
//     in   position   RGBA32F  of the ground (frame/ground.h), or none for a bare sphere
//          radiance   RGBA32F  as the sky and what is beyond the air left it
//     out  clouds              of every second pixel (cloud/rays.h); scratch
//          joined              of each four of those; scratch
//          sharpened  RGBA32F  the same with edges as they were; scratch
//          hidden     R8       of squares of pixels (gpu/hide.h): what clouds hide of
//                              it, see cloud/hidden.frag
//          radiance            with clouds

#include "base/camera.h"
#include "cloud/deck.h"
#include "cloud/field.h"
#include "cloud/history.h"
#include "cloud/rays.h"
#include "cloud/shade.h"
#include "gpu/hide.h"
#include "gpu/pass.h"

// The air of the model of the sky: what programs that include sky/spectral/air.glsl need.
struct cloud_air {
    int peaked_count;
    bool has_march;   // with shadows in the air
    bool has_eclipse; // with a body before the star
    // Sets the uniforms of sky/ray.glsl, and with `whole` those of sky/spectral/air.glsl and the
    // light on the ground.
    void (*bind)(const void *self, bool whole, struct gpu_program *program);
    // The same, whole, for the light of a moon, which is added. NULL: there is none.
    void (*bind_moon)(const void *self, struct gpu_program *program);
    const void *self;
};

struct cloud_march {
    struct gpu *gpu;
    const struct cloud_field *field;
    struct gpu_texture noise, map;
    bool is_made; // with the programs for:
    bool is_bare, has_march, has_eclipse, has_moon;
    int peaked_count;
    struct gpu_program march, moonlit, filter, sharpen, join, find_hidden;
    uint32_t width, height;      // of the last picture
    struct cloud_rays clouds[2]; // this frame's and the one before
    struct cloud_rays joined;
    struct gpu_texture sharpened, hidden;
    struct gpu_target sharpened_target, hidden_target;
    int now; // which of both is this frame's
    struct cloud_history history;
    struct cloud_deck deck;
    struct cloud_shade shade;
};

// Uploads noise and map. The field must outlive it. TRL_ERROR_GPU, TRL_ERROR_MEMORY,
// TRL_ERROR_UNSUPPORTED.
TRL_MUST_USE trl_result cloud_march_init(struct gpu *gpu, const struct cloud_field *field,
                                         struct cloud_march *out);
void cloud_march_finish(struct cloud_march *march);

// The uniforms of cloud/field.glsl.
void cloud_march_set_field(const struct cloud_march *march, const struct camera *camera,
                           struct gpu_program *program);

struct cloud_view {
    const struct camera *camera;
    const struct gpu_texture *position; // NULL: bare sphere
    const struct gpu_target *target;
    const struct cloud_air *air;
    double time_s;
    bool is_moonlit;  // the ground has the moon's light, and clouds shade that
    bool accumulates; // marches a quarter, with the rest from frames before where it was seen
};

// A frame calls these in this order. The map of `deck`, which the air's own shadows ask for:
TRL_MUST_USE trl_result cloud_march_deck(struct cloud_march *march, const struct cloud_view *view);
// `clouds` and `hidden`; with a moon's light the deck is then that toward it;
TRL_MUST_USE trl_result cloud_march_draw(struct cloud_march *march, const struct cloud_view *view);
// what `shade` has, before ground is lit;
TRL_MUST_USE trl_result cloud_march_shade(struct cloud_march *march, const struct cloud_view *view);
// and after all that is behind, clouds into the picture.
TRL_MUST_USE trl_result cloud_march_join(struct cloud_march *march, const struct cloud_view *view);

#endif // CLOUD_MARCH_H
