// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A uniform block read by the test's C file as well.
#ifndef TEST_BLOCK_GLSL
#define TEST_BLOCK_GLSL
#include "shared/shared.glsl"

SHARED_BLOCK(TestBlock)
SHARED_MAT4(block_matrix)
SHARED_VEC4(block_vector)
SHARED_VEC4_ARRAY(block_array, 2)
SHARED_BLOCK_END(TestBlock)

#endif
