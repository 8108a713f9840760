// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_IMAGE_H
#define TRL_IMAGE_H

#include <terrella/context.h>

TRL_BEGIN

/// Writes an 8-bit sRGB PNG, whole or not at all.
/// @param rgba  width x height x 4 bytes, top row first; alpha is ignored
/// @return TRL_OK; TRL_ERROR_INVALID (a size of 0); TRL_ERROR_IO (cannot be written);
/// TRL_ERROR_MEMORY
TRL_API TRL_MUST_USE trl_result trl_image_write_png(trl_context *ctx, const char *path,
                                                    uint32_t width, uint32_t height,
                                                    const uint8_t *rgba);

/// Writes a 32-bit float RGB OpenEXR (ZIP), linear sRGB primaries in cd m^-2, whole or not at all.
/// @param rgba  width x height x 4 floats, top row first; alpha is ignored
/// @return as trl_image_write_png
TRL_API TRL_MUST_USE trl_result trl_image_write_exr(trl_context *ctx, const char *path,
                                                    uint32_t width, uint32_t height,
                                                    const float *rgba);

TRL_END
#endif // TRL_IMAGE_H
