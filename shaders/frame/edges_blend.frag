// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The radiance of a pixel at an edge, as the mean over what it shows of both sides. Where an edge
// of the surface runs between pixels is told by the steps that it makes (Reshetov 2009,
// Morphological antialiasing): over a straight piece between two steps it goes from the middle of
// one to the middle of the other.
// validate:
// validate: SURFACE

#include "frame/edges.glsl"

uniform sampler2D u_radiance;
uniform float u_strength; // of the blending, in [0, 1]

layout(location = 0) out vec4 out_radiance;

#ifdef SURFACE
const int REACH = 160; // pixels to either side in which steps are looked for

// Along the edge between a row of pixels and the next, which is one `side` away: x, how many more
// pixels it goes on; y, 1 where it then turns into the row, so that the other side begins there.
vec2 follow(ivec2 pixel, ivec2 side, ivec2 along)
{
    int count = 0;
    bool goes_on = true;
    for (int i = 0; i < REACH && goes_on; i++) {
        goes_on = is_edge_between(pixel + (i + 1) * along, side);
        count = goes_on ? i + 1 : count;
    }
    ivec2 end = pixel + count * along;
    bool turns = !goes_on && is_edge_between(end, along) && !is_edge_between(end + side, along);
    return vec2(float(count), turns ? 1.0 : 0.0);
}

// What lies beyond an edge of one piece that starts from half a pixel at its end and comes to
// nothing at the middle of the piece, within a pixel `count` from that end.
float piece_share(float count, float length)
{
    float a = min(count, 0.5 * length);
    float b = min(count + 1.0, 0.5 * length);
    return 0.5 * ((b - a) - (b * b - a * a) / length);
}

// How much of a pixel the neighbour on one side covers.
float covered(ivec2 pixel, ivec2 side)
{
    if (!is_edge_between(pixel, side)) {
        return 0.0;
    }
    ivec2 along = side.yx;
    vec2 one = follow(pixel, side, along);
    vec2 other = follow(pixel, side, -along);
    float length = one.x + other.x + 1.0;
    return one.y * piece_share(one.x, length) + other.y * piece_share(other.x, length);
}
#else
// The sphere's horizon is known: it is the zero of a function that changes evenly over some pixels.
float covered(ivec2 pixel, ivec2 side)
{
    float own = ray_of(pixel).inside_m2;
    float x = 0.5 * (ray_of(pixel + ivec2(1, 0)).inside_m2 - ray_of(pixel - ivec2(1, 0)).inside_m2);
    float y = 0.5 * (ray_of(pixel + ivec2(0, 1)).inside_m2 - ray_of(pixel - ivec2(0, 1)).inside_m2);
    // How much of a square lies beyond a line: until the line leaves the square's first corner, a
    // part of its side, then a triangle.
    float steep = max(max(abs(x), abs(y)), 1.0e-9);
    float tilt = min(abs(x), abs(y)) / steep;
    float from = abs(own) / steep; // from the pixel's middle, along the axis
    float corner = max(0.5 * (1.0 + tilt) - from, 0.0);
    float share =
        from < 0.5 * (1.0 - tilt) ? 0.5 - from : corner * corner / max(2.0 * tilt, 1.0e-6);
    vec2 away = (own > 0.0 ? -1.0 : 1.0) * vec2(x, y);
    vec2 steepest = abs(away.x) > abs(away.y) ? vec2(sign(away.x), 0.0) : vec2(0.0, sign(away.y));
    return ivec2(steepest) == side ? share : 0.0;
}
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    float others = 0.0;
    for (int i = 0; i < 4; i++) {
        int sense = 1 - 2 * (i & 1);
        ivec2 side = i < 2 ? ivec2(0, sense) : ivec2(sense, 0);
        float share = u_strength * covered(pixel, side);
        sum += share * texelFetch(u_radiance, inside(pixel + side), 0);
        others += share;
    }
    out_radiance = sum + (1.0 - others) * texelFetch(u_radiance, pixel, 0);
}
