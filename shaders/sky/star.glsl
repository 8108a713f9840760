// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How the light of a point is spread over pixels.
#ifndef SKY_STAR_GLSL
#define SKY_STAR_GLSL

// Pixels. stars.c knows them too.
#define STAR_HALF_WIDTH 1.5
#define STAR_HALO 4.0

// Quadratic B-spline: its samples at distances of 1 sum to 1 wherever they lie, and so do those of
// a whole number of times the width.
float star_spline(float x)
{
    float far = max(1.5 - abs(x), 0.0);
    return abs(x) < 0.5 ? 0.75 - x * x : 0.5 * far * far;
}

float star_kernel(vec2 offset)
{
    return star_spline(offset.x) * star_spline(offset.y);
}

#endif // SKY_STAR_GLSL
