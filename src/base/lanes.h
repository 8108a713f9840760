// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef BASE_LANES_H
#define BASE_LANES_H
// Sixteen wavelengths side by side: the vector type of the light transport. A compiler that has no
// such registers splits it; functions marked LANES_CLONES are compiled for several processors and
// chosen at load.

#include <stdint.h>

enum { LANES = 16 };

typedef float lanes __attribute__((vector_size(64), aligned(64)));
typedef int32_t lanes_int __attribute__((vector_size(64), aligned(64)));

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__)
#define LANES_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
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

// exp(x) for x <= 0 to a relative 3e-7; below -87 it is 0 within float range. Cody-Waite reduction
// by log 2, degree 6. -ffast-math joins the two steps of the reduction and adds 1e-7 |x| to the
// error.
LANES_INLINE lanes lanes_exp_negative(lanes x)
{
    x = lanes_max(x, lanes_set(-87.0f));
    // Conversion truncates toward 0, which rounds a negative number after half is taken away;
    // adding and taking away a large number would round too, but -ffast-math removes it.
    const lanes_int whole = __builtin_convertvector(x * 1.44269504f - 0.5f, lanes_int);
    const lanes n = __builtin_convertvector(whole, lanes);
    const lanes r = (x - n * 0.693359375f) + n * 2.12194440e-4f;
    lanes p = r * 1.3888889e-3f + 8.3333333e-3f;
    p = p * r + 4.1666668e-2f;
    p = p * r + 1.6666667e-1f;
    p = p * r + 0.5f;
    p = p * r + 1.0f;
    p = p * r + 1.0f;
    const lanes_int exponent = (whole + 127) << 23;
    return p * (lanes)exponent;
}

// Threads of a parallel loop, each with scratch memory of its own.
#ifdef _OPENMP
#include <omp.h>
static inline int lanes_max_threads(void)
{
    return omp_get_max_threads();
}

static inline int lanes_thread(void)
{
    return omp_get_thread_num();
}
#else
static inline int lanes_max_threads(void)
{
    return 1;
}

static inline int lanes_thread(void)
{
    return 0;
}
#endif

// Products of many transmittances sink below the smallest normal float, where processors are a
// hundred times slower: such numbers become 0 on this thread until the state returned is restored.
#if defined(__SSE__)
#include <xmmintrin.h>
static inline unsigned lanes_flush_denormals(void)
{
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040u); // flush to zero, denormals are zero
    return before;
}

static inline void lanes_restore(unsigned before)
{
    _mm_setcsr(before);
}
#else
static inline unsigned lanes_flush_denormals(void)
{
    return 0;
}

static inline void lanes_restore(unsigned before)
{
    (void)before;
}
#endif

#endif // BASE_LANES_H
