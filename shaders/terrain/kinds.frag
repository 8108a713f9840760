// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What a pixel shows, as depth, so that passes over the ground are spared the sky and those over
// the water all else: 0 sky, 3/4 ground, 1 ground with water in it.
// validate:
// validate: WATER

#ifdef WATER
uniform sampler2D u_albedo; // a: part that is open water
#else
uniform highp sampler2D u_position; // w: altitude, m, or below -1e8
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#ifdef WATER
    if (!(texelFetch(u_albedo, pixel, 0).a > 0.0)) {
        discard;
    }
    gl_FragDepth = 1.0;
#else
    gl_FragDepth = texelFetch(u_position, pixel, 0).w > -1.0e8 ? 0.75 : 0.0;
#endif
}
