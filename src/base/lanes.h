// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef BASE_LANES_H
#define BASE_LANES_H
// Sixteen wavelengths side by side: the vector type of the light transport. A compiler that has no such
// registers splits it; functions marked LANES_CLONES are compiled for several processors and chosen at load.

#include <stdint.h>

enum { LANES = 16 };

typedef float lanes __attribute__((vector_size(64), aligned(64)));
typedef int32_t lanes_int __attribute__((vector_size(64), aligned(64)));

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define LANES_CLONES                                                                               \
    __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LANES_CLONES
#endif

// Inlined into each clone, so that it is compiled for that clone's processor.
#define LANES_INLINE static inline __attribute__((always_inline))

LANES_INLINE lanes lanes_set(float value)
{
    return (lanes){0} + value;
}

LANES_INLINE lanes lanes_max(lanes a, lanes b)
{
    const lanes_int is_a = a > b;
    return (lanes)((is_a & (lanes_int)a) | (~is_a & (lanes_int)b));
}

// exp(x) for x <= 0 to 2 ulp; below -87 it is 0 within float range. Cody-Waite reduction by log 2, degree 6.
LANES_INLINE lanes lanes_exp_negative(lanes x)
{
    x = lanes_max(x, lanes_set(-87.0f));
    const lanes shifted = x * 1.44269504f + 12582912.0f; // 1.5 * 2^23: rounds to an integer
    const lanes n = shifted - 12582912.0f;
    const lanes r = (x - n * 0.693359375f) + n * 2.12194440e-4f;
    lanes p = r * 1.3888889e-3f + 8.3333333e-3f;
    p = p * r + 4.1666668e-2f;
    p = p * r + 1.6666667e-1f;
    p = p * r + 0.5f;
    p = p * r + 1.0f;
    p = p * r + 1.0f;
    const lanes_int exponent = (__builtin_convertvector(n, lanes_int) + 127) << 23;
    return p * (lanes)exponent;
}

#endif // BASE_LANES_H
