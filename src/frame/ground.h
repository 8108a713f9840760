// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_GROUND_H
#define FRAME_GROUND_H
// The ground of a scene in the frame: rasters, mesh, and the surface buffers that the sky pass
// lights. A scene without rasters is a bare sphere: it has no buffers, and the sky pass finds it by
// itself.
//
// - position, RGBA32F: xyz relative to the camera, planet axes, m; w altitude, m, -1e9 where is no
//   ground
// - depth, DEPTH32F: reversed, then kinds (terrain/kinds.h)
// - albedo, RGBA8: square root of the linear albedo; a: water
// - normal, RGBA16F: xyz planet axes; w: how much of the sun is not hidden by terrain
// - lights, RGBA8: square root of artificial light at night; a: of water its depth, of land the
//   root of the star's light on the ground around
// - region, RGBA8: square root of the albedo, averaged as the light of the air does; a: sky view
//   factor

#include "base/camera.h"
#include "frame/clock.h"
#include "gpu/hide.h"
#include "gpu/target.h"
#include "ocean/facets.h"
#include "ocean/sea_mesh.h"
#include "scene/scene.h"
#include "sky/sky.h"
#include "terrain/compose.h"
#include "terrain/kinds.h"
#include "terrain/mesher.h"
#include "terrain/open_sea.h"
#include "terrain/sky_view.h"

struct ground {
    struct gpu *gpu;
    bool is_bare;
    double lights_cd_m2; // luminance of white in `lights`
    double region_m;     // width of the averages in `region`
    struct surface surface;
    trl_mesher mesher;                        // that frames are drawn with
    trl_projective_desc projective;           // options of that mesher
    uint32_t hemisphere_cells;                // of those two; 0: their own
    double mesh_error_px;                     // wanted of meshers that follow one
    struct mesher *meshers[MESHER_MAX_KINDS]; // by trl_mesher; made when first asked for; none when
                                              // bare, as the passes below
    struct terrain_shadow shadow;
    struct terrain_kinds kinds;
    struct gpu_hide hide;
    struct terrain_open_sea open_sea; // where there are waves
    struct terrain_compose compose;
    struct waves waves;
    struct waves_view *stand; // owned; room for ground_wave_m
    struct facets facets;
    struct sea_mesh sea_mesh; // the positions of the last frame are its own where it is seen
    bool has_waves;
    struct terrain_sky_view sky_view;
    struct gpu_texture position, depth, albedo, normal, lights, region;
    struct gpu_target mesh_target, kinds_target, surface_target;
    struct gpu_target sky_view_target; // lights and region
};

// What the surface of a scene is made of; `layers` belongs to it.
void ground_describe(const trl_context *ctx, const struct trl_scene *scene,
                     struct surface_layer_desc layers[SCENE_MAX_LAYERS], struct surface_desc *out);

// Luminance of white in the lights of a scene: that of the brightest layer.
double ground_find_lights_cd_m2(const struct trl_scene *scene);

struct ground_meshing {
    trl_mesher mesher;
    trl_projective_desc projective;
    double error_px; // see trl_renderer_desc.mesh_error_px
};

struct ground_desc {
    const struct trl_scene *scene; // needs to live only until the call returns
    struct ground_meshing meshing;
    bool waits_for_rasters; // see struct surface_desc
};
TRL_MUST_USE trl_result ground_init(struct gpu *gpu, const struct ground_desc *desc,
                                    struct ground *out);
void ground_finish(struct ground *ground);

// Draws with that mesher from now on; makes it when it is asked for first. A failure leaves the old
// one.
TRL_MUST_USE trl_result ground_set_mesher(struct ground *ground, trl_mesher mesher);

// Makes the projective mesher with other options, now if it is there already. A failure leaves the
// old one.
TRL_MUST_USE trl_result ground_set_projective(struct ground *ground,
                                              const trl_projective_desc *desc);

// Makes the hemisphere and its tessellated form with another grid, now where they are there
// already. A failure leaves the old ones.
TRL_MUST_USE trl_result ground_set_hemisphere(struct ground *ground, uint32_t cells);

// What meshers aim at from now on.
void ground_set_mesh_error(struct ground *ground, double error_px);

// Of the mesher that frames are drawn with; zeroed when bare.
struct mesher_stats ground_mesher_stats(const struct ground *ground);

// Makes the buffers anew. After a failure there are none, and it must be called again.
TRL_MUST_USE trl_result ground_resize(struct ground *ground, uint32_t width, uint32_t height);

// Beside what every picture has.
struct ground_extras {
    bool has_sky_view;       // else the alphas of lights and region are what terrain/compose.h says
    const float *sea_albedo; // linear sRGB, of the ocean in light of an even sky
    double time_s;           // of the ocean's waves
};
// Where the ground is: position. What follows needs the other as well.
TRL_MUST_USE trl_result ground_draw_shape(struct ground *ground, const struct camera *camera,
                                          const struct ground_extras *extras,
                                          struct frame_clock *clock);
// How it looks, where it is not hidden (gpu/hide.h; NULL: nothing is).
TRL_MUST_USE trl_result ground_draw_look(struct ground *ground, const struct camera *camera,
                                         const struct ground_extras *extras,
                                         const struct gpu_texture *hidden,
                                         struct frame_clock *clock);

// What the sky pass lights, after ground_draw_shape: all NULL for a bare sphere.
struct sky_surface ground_surface(const struct ground *ground);

// What shades the air, after ground_draw_shape.
struct sky_shadow ground_shadow(const struct ground *ground);

double ground_altitude_m(const struct ground *ground, double latitude_rad, double longitude_rad);
// As surface_water_depth_m.
double ground_water_depth_m(const struct ground *ground, double latitude_rad, double longitude_rad);
// Of the sea above its level, as a boat feels it; 0 without waves.
double ground_wave_m(const struct ground *ground, double latitude_rad, double longitude_rad,
                     double time_s);
double ground_highest_m(const struct ground *ground);

#endif // FRAME_GROUND_H
