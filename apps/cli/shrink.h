// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_SHRINK_H
#define CLI_SHRINK_H
// Smooth edges: a picture drawn larger is averaged down, block by block.

#include <stdint.h>

// A picture of `width` x `height` blocks of `samples` x `samples` pixels, RGBA, rows from the top.
// The result stands at the beginning of the same memory. Light is averaged, not its codes.
void shrink_radiance(float *rgba, uint32_t width, uint32_t height, uint32_t samples);
void shrink_srgb(uint8_t *rgba, uint32_t width, uint32_t height, uint32_t samples);

#endif // CLI_SHRINK_H
