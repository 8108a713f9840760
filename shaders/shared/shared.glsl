// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_SHARED_GLSL
#define SHARED_SHARED_GLSL
// What makes one text valid C11, C++17 and GLSL. Every file of shaders/shared/ includes this one
// first:
//
//     #include "shared/shared.glsl"
//     SHARED_FN Number phase_rayleigh(Number cos_angle) { ... }
//
// Rules: scalars and plain structs only (no vectors, overloads, `out` parameters or array
// parameters); literals like 1.0; constants by #define; loops with constant bounds; none of the
// words half, input, output, filter, common, active, this, template, sample; no two underscores in
// a row; no macro over several lines. C calculates in double, GLSL in float.
//
// Whole numbers are of 32 bits without sign and wrap around; literals like 0x1fu.
//
// Functions that have one name in both: sqrt exp log pow sin cos tan asin acos floor. For the
// others use the shared_ ones below.

#ifdef TRL_GLSL // defined by gpu/program.c

#define SHARED_FN
#define SHARED_STRUCT(name) struct name
#define Number float
#define Length float    // m
#define Area float      // m^2
#define PerLength float // m^-1
#define Angle float     // rad
#define Whole uint      // modulo 2^32

#define shared_abs abs
#define shared_min min
#define shared_max max
#define shared_clamp clamp
#define shared_atan2(y, x) atan(y, x)
#define shared_whole(floored) uint(int(floored)) // |floored| < 2^31
#define shared_number(whole) float(whole)

// GLSL 330 knows no continued lines, not even where it skips them, and the formatter makes them.
// clang-format off
#define SHARED_BLOCK(name) layout(std140) uniform name {
#define SHARED_MAT4(name) mat4 name;
#define SHARED_VEC4(name) vec4 name;
#define SHARED_VEC4_ARRAY(name, count) vec4 name[count];
#define SHARED_BLOCK_END(name) };
// clang-format on

#else // C and C++

#include <math.h>
#include <stdint.h>

#define SHARED_FN static inline
// clang-format off
#define SHARED_STRUCT(name) typedef struct name name; struct name
// clang-format on
typedef double Number;
typedef double Length;    // m
typedef double Area;      // m^2
typedef double PerLength; // m^-1
typedef double Angle;     // rad
typedef uint32_t Whole;   // modulo 2^32

#define shared_abs fabs
#define shared_min fmin
#define shared_max fmax
#define shared_atan2(y, x) atan2(y, x)
#define shared_whole(floored) ((uint32_t)(int64_t)(floored))
#define shared_number(whole) ((double)(whole))
static inline Number shared_clamp(Number value, Number low, Number high)
{
    return fmin(fmax(value, low), high);
}

// Members are of 16 or 64 bytes, so that the struct has the layout of std140 without rules to
// remember:
//     SHARED_BLOCK(FrameBlock)
//     SHARED_MAT4(clip_from_view)
//     SHARED_VEC4(sun_direction)
//     SHARED_BLOCK_END(FrameBlock)
// gives C `struct FrameBlock` for gpu_buffer_update.
// clang-format off
#define SHARED_BLOCK(name) struct name {
#define SHARED_MAT4(name) float name[16];
#define SHARED_VEC4(name) float name[4];
#define SHARED_VEC4_ARRAY(name, count) float name[(count)*4];
#define SHARED_BLOCK_END(name) };
// clang-format on

#endif

#define SHARED_PI 3.14159265358979323846

#endif // SHARED_SHARED_GLSL
