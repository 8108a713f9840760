// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_REFERENCE_H
#define TRL_REFERENCE_H

/// @file
/// Pictures by brute force: a Monte Carlo path tracer on the CPU that follows all orders of
/// scattering and reflection, to judge pictures of a trl_renderer by. Slow and without bias; each
/// value comes with its standard error. Nothing here touches OpenGL.
///
///     trl_reference_desc desc = trl_reference_desc_default();
///     desc.scene = scene;
///     trl_reference_render(ctx, &desc, &view, 320, 180, radiance, error);
///     trl_radiance_develop(ctx, scene, &view, 320, 180, radiance, pixels);

#include <terrella/scene.h>

TRL_BEGIN

typedef struct trl_reference_desc {
    uint32_t canary; ///< set by trl_reference_desc_default(); never touch
    const trl_scene *scene;
    uint64_t paths;      ///< for each pixel, [1, 1e12]: four times as many halve the noise; default
                         ///< 64. Rounded up to a multiple of 16, and to at least 32: wavelengths
                         ///< are spread over the paths
    uint64_t seed;       ///< same seed, same picture, on any number of threads; default 0
    uint32_t max_orders; ///< scatterings and reflections that light may have, at most 1000; 0
                         ///< (default): all
    double pixel_width;  ///< of the square that a pixel's paths spread over, in pixels, [0, 16]: 1
                         ///< (default) averages over the pixel, 0 looks through its middle only
} trl_reference_desc;

/// A desc with every default set; the caller adds the scene. Threads: any.
TRL_API trl_reference_desc trl_reference_desc_default(void);

/// Traces a picture of a view: the camera, the star, ground and air of the scene as
/// trl_renderer_draw shows them; bodies of the view hide the star where they stand before it, and
/// are black. Ground is as high and as coloured as the scene's rasters say, casts shadows, and has
/// its lights; made-up detail is left out, and clouds are as fine as there is. The sea of an ocean
/// is its mean rough surface over its water; without an ocean water reflects as land does. There
/// are no stars but the planet's own, no moonlight and no airglow. Colour is integrated over the
/// whole visible spectrum. Blocks for long, uses every core, tells the context's progress function
/// how far it is.
/// @param view            as for trl_renderer_draw
/// @param width           with height within TRL_RENDERER_MAX_SIDE and TRL_RENDERER_MAX_PIXELS
/// @param[out] rgba       width x height x 4 floats: linear sRGB primaries in cd m^-2, alpha 1, top
///                        row first, finite, as trl_renderer_read_radiance
/// @param[out] error      the standard error of each value, alpha 1; may be NULL
/// @return TRL_OK; TRL_ERROR_INVALID (an argument, or a raster's content); TRL_ERROR_IO (raster);
///         TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED
TRL_API TRL_MUST_USE trl_result trl_reference_render(trl_context *ctx,
                                                     const trl_reference_desc *desc,
                                                     const trl_view *view, uint32_t width,
                                                     uint32_t height, float *rgba, float *error);

/// Exposes and tone-maps radiance on the CPU, as a renderer does: automatic exposure is metered
/// from the radiance unless the view fixes it. Threads: any.
/// @param radiance   width x height x 4 floats, linear sRGB in cd m^-2, top row first, finite
/// @param[out] rgba  width x height x 4 bytes, sRGB, alpha 255, top row first
/// @return TRL_OK; TRL_ERROR_INVALID (an argument)
TRL_API TRL_MUST_USE trl_result trl_radiance_develop(trl_context *ctx, const trl_scene *scene,
                                                     const trl_view *view, uint32_t width,
                                                     uint32_t height, const float *radiance,
                                                     uint8_t *rgba);

TRL_END
#endif // TRL_REFERENCE_H
