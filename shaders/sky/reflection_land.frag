// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Mean radiance of the land in flat rectangles of the picture, times the part of the rectangle that
// is land; that part. What rough water mirrors is drawn out along the view, not across.
uniform sampler2D u_radiance; // what is drawn but for open water
uniform sampler2D u_near;     // of sky/reflection_near.frag; here its pixels
uniform vec4 u_picture;       // width and height, those of a rectangle

layout(location = 0) out vec4 o_land;

void main()
{
    ivec2 size = ivec2(u_picture.xy);
    ivec2 extent = ivec2(u_picture.zw);
    ivec2 first = ivec2(gl_FragCoord.xy) * extent;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < extent.x * extent.y; i++) {
        ivec2 place = min(first + ivec2(i % extent.x, i / extent.x), size - 1);
        float land = texelFetch(u_near, place, 0).x > 0.0 ? 1.0 : 0.0;
        sum += vec4(texelFetch(u_radiance, place, 0).rgb, 1.0) * land;
    }
    o_land = sum / float(extent.x * extent.y);
}
