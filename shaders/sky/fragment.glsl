// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The ray of a fragment: through its pixel, or with SPHERE to the point of a sphere that is drawn.
#ifndef SKY_FRAGMENT_GLSL
#define SKY_FRAGMENT_GLSL

#include "sky/ray.glsl"

#ifdef SPHERE
in vec3 v_position; // relative to the eye, m

Ray fragment_ray()
{
    return make_ray(normalize(v_position));
}
#else
in vec2 v_uv;

Ray fragment_ray()
{
    return make_pixel_ray(v_uv);
}
#endif

#endif // SKY_FRAGMENT_GLSL
