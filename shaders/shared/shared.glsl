// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Prelude of the formulas that the C compiler and GLSL both read: scalars with the names of quantities, and
// functions. In C a scalar is a double, in GLSL a float.
#ifndef SHARED_SHARED_GLSL
#define SHARED_SHARED_GLSL

#ifdef GL_core_profile
#define SHARED_IS_GLSL 1
#endif
#ifdef GL_ES
#define SHARED_IS_GLSL 1
#endif

#ifdef SHARED_IS_GLSL
#define SHARED_FN
#define Number float
#define Length float
#else
#include <math.h>
#define SHARED_FN static inline
typedef double Number;
typedef double Length;
#endif

#endif
