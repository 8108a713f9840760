// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_GROUND_H
#define TRL_GROUND_H

/// @file
/// The ground of a scene as it is: by rays in double precision on the CPU, through all layers at
/// their finest. And how far from that the mesh of a trl_renderer is, in pixels.
///
///     trl_ground_create(ctx, scene, &ground);
///     trl_ground_cast(ground, &view, 320, 180, points);
///
///     trl_mesh_check_desc desc = trl_mesh_check_desc_default();
///     desc.view = &view;
///     trl_mesh_check_create(ground, renderer, &desc, &check);
///     trl_mesh_error error = trl_mesh_check_error(check);

#include <terrella/renderer.h>

TRL_BEGIN

/// The elevation of a scene on the CPU.
/// Owner: caller. Lifetime: destroy before its scene and context.
/// Threads: one call at a time; casting uses every core.
typedef struct trl_ground trl_ground;

/// Reads the rasters of elevation and water.
/// @return TRL_OK; TRL_ERROR_INVALID (argument, or a raster's content); TRL_ERROR_IO (raster);
///         TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED
TRL_API TRL_MUST_USE trl_result trl_ground_create(trl_context *ctx, const trl_scene *scene,
                                                  trl_ground **out);

/// Frees *ground and sets it to NULL.
TRL_API void trl_ground_destroy(trl_ground **ground);

/// As trl_renderer_ground_altitude_m. Threads: any.
TRL_API double trl_ground_altitude_m(const trl_ground *ground, double latitude_rad,
                                     double longitude_rad);

/// What the ray through the middle of a pixel meets first.
typedef struct trl_ground_point {
    double distance_m;    ///< along the ray; INFINITY where it meets nothing
    double position_m[3]; ///< from the camera, along the planet's axes: x to longitude 0, z north
    double normal[3];     ///< of the ground, unit, the same axes; 0 where there is none
} trl_ground_point;

/// Casts a ray through each pixel of a view. Hits are exact to a millionth of their distance;
/// ground that is narrower than a quarter of a pixel, or that rises above a ray by less than a
/// 10000th of its own height over a 64th of half a texel, may be passed by. Blocks, and tells the
/// context's progress function how far it is.
/// @param view         as for trl_renderer_draw; sun and exposure do not matter
/// @param[out] points  width x height of them, top row first
/// @return TRL_OK; TRL_ERROR_INVALID (an argument); TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED
TRL_API TRL_MUST_USE trl_result trl_ground_cast(trl_ground *ground, const trl_view *view,
                                                uint32_t width, uint32_t height,
                                                trl_ground_point *points);

typedef struct trl_mesh_check_desc {
    uint32_t canary; ///< set by trl_mesh_check_desc_default(); never touch
    const trl_view *view;
    uint32_t width, height; ///< of the picture whose pixels are counted; default 1024 x 576
    uint32_t step;          ///< every step-th pixel of a row and of a column is looked at, [1, 64];
                            ///< default 4
    bool has_edges; ///< casts rays for silhouettes and holes (default true); else only the shift is
                    ///< known
} trl_mesh_check_desc;

/// A desc with every default set; the caller adds the view. Threads: any.
TRL_API trl_mesh_check_desc trl_mesh_check_desc_default(void);

/// One view of a renderer's mesh held against the truth. Owner: caller. Lifetime: destroy before
/// the context of its ground.
typedef struct trl_mesh_check trl_mesh_check;

/// Draws the mesh of the view, as the renderer would for a frame, and measures it. The renderer's
/// last picture stays. The truth of the last view is kept in `ground`, so that further meshers cost
/// no further rays.
/// @param ground    of the renderer's scene
/// @param renderer  whose mesher is judged
/// @return TRL_OK; TRL_ERROR_INVALID (an argument; a scene without elevation has no mesh);
///         TRL_ERROR_MEMORY; TRL_ERROR_GPU; TRL_ERROR_CANCELLED
TRL_API TRL_MUST_USE trl_result trl_mesh_check_create(trl_ground *ground, trl_renderer *renderer,
                                                      const trl_mesh_check_desc *desc,
                                                      trl_mesh_check **out);

/// Frees *check and sets it to NULL.
TRL_API void trl_mesh_check_destroy(trl_mesh_check **check);

/// Errors of a mesh in pixels of the desc's picture.
///
/// Shift: what is drawn at a pixel belongs to a place of the planet; the shift is how far away in
/// the picture the truth shows that place. Edges: silhouettes (horizon, ridges before what is
/// behind them), and how far the drawn ones are from the true ones, at a right angle to them.
typedef struct trl_mesh_error {
    uint32_t places; ///< of the ground that were looked at
    double shift_rms_px, shift_max_px;
    uint32_t edges; ///< places of silhouettes that were looked at
    double edge_rms_px, edge_max_px;
    uint32_t lost_edges; ///< places with no drawn silhouette within 16 pixels; they count as that
    uint32_t holes; ///< places, not beside a silhouette, where ground is missing or is too much
    double
        new_cpu_ms; ///< processor time, all threads, of drawing the mesh, with all that had to be
                    ///< made for the view
    double cpu_ms;  ///< and of drawing it once more
} trl_mesh_error;

/// Threads: any. All 0 for NULL.
TRL_API trl_mesh_error trl_mesh_check_error(const trl_mesh_check *check);

/// What changed between two views beyond what the camera's motion explains: in pixels of the
/// second, over places of the ground that both show.
typedef struct trl_mesh_change {
    uint32_t places;
    double rms_px;
    double highest_px; ///< 999 of 1000 places moved by less
} trl_mesh_change;

/// @return TRL_OK; TRL_ERROR_INVALID (an argument is NULL); TRL_ERROR_MEMORY
TRL_API TRL_MUST_USE trl_result trl_mesh_check_change(const trl_mesh_check *before,
                                                      const trl_mesh_check *after,
                                                      trl_mesh_change *out);

TRL_END
#endif // TRL_GROUND_H
