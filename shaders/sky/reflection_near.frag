// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How near the nearest land of a square of pixels is: the greatest 1 / distance along the view's
// axis in it, 0 where there is none. Water hides no ray that rises from it; land that clouds hide
// is not drawn. With SEEN only squares with land are drawn, to be counted.
// validate:
// validate: SURFACE
// validate: SEEN

#ifdef SURFACE
uniform sampler2D u_position;    // as in sky/ground.glsl
uniform sampler2D u_albedo;      // a: part that is open water
uniform highp sampler2D u_kinds; // of terrain/kinds.frag
uniform vec3 u_forward;
#else
uniform sampler2D u_nearest; // what this file has drawn, of smaller squares
uniform vec4 u_source;       // where those are: first texel; how many
#endif
uniform vec3 u_square; // where its texels begin in the target, pixels of the source a side

layout(location = 0) out float o_nearness;

float nearness_at(ivec2 place)
{
#ifdef SURFACE
    vec4 ground = texelFetch(u_position, place, 0);
    float water = texelFetch(u_albedo, place, 0).a;
    bool is_land = texelFetch(u_kinds, place, 0).x > 0.5 && water < 0.5;
    return is_land ? 1.0 / max(dot(ground.xyz, u_forward), 1.0e-3) : 0.0;
#else
    return texelFetch(u_nearest, ivec2(u_source.xy) + place, 0).x;
#endif
}

void main()
{
#ifdef SURFACE
    ivec2 size = textureSize(u_position, 0);
#else
    ivec2 size = ivec2(u_source.zw);
#endif
    int side = int(u_square.z);
    ivec2 first = (ivec2(gl_FragCoord.xy) - ivec2(u_square.xy)) * side;
    float nearest = 0.0;
    int i = 0;
    do {
        nearest = max(nearest, nearness_at(min(first + ivec2(i % side, i / side), size - 1)));
        i++;
    } while (i < side * side);
#ifdef SEEN
    if (nearest <= 0.0) {
        discard;
    }
#endif
    o_nearness = nearest;
}
