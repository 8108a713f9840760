// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How finely a patch of the tessellated hemisphere is divided, and whether it is seen at all
// (Michelic 2019, Section 3: culling in the tessellation, with a slightly widened frustum).
layout(vertices = 4) out;

uniform mat3 u_view; // as in mesh.vert
uniform vec4 u_edge; // angle of a cell, rad; cells to a patch; width of the frustum's sides: x, y

in vec2 v_texel[];
in vec3 v_at[];
out vec2 c_texel[];

// From both ends of the edge alone, so that neighbours agree; a power of two, so that vertices are
// texels.
float level(int a, int b)
{
    float angle = length(v_at[a] - v_at[b]) / max(length(0.5 * (v_at[a] + v_at[b])), 1e-3);
    return clamp(exp2(ceil(log2(max(angle / u_edge.x, 1.0)))), 1.0, u_edge.y);
}

bool is_seen()
{
    vec3 middle = 0.25 * (v_at[0] + v_at[1] + v_at[2] + v_at[3]);
    float reach = 0.0;
    for (int i = 0; i < 4; i++) {
        reach = max(reach, length(v_at[i] - middle));
    }
    // What rises within the patch is hardly higher than half of its width.
    reach *= 1.5;
    vec3 view = u_view * middle; // sides of the frustum are |x| = z and |y| = z
    return view.z > -reach && abs(view.x) - view.z < reach * u_edge.z &&
           abs(view.y) - view.z < reach * u_edge.w;
}

void main()
{
    c_texel[gl_InvocationID] = v_texel[gl_InvocationID];
    if (gl_InvocationID == 0) {
        bool seen = is_seen();
        float left = seen ? level(0, 3) : 0.0;
        float below = seen ? level(0, 1) : 0.0;
        float right = seen ? level(1, 2) : 0.0;
        float above = seen ? level(3, 2) : 0.0;
        gl_TessLevelOuter[0] = left;
        gl_TessLevelOuter[1] = below;
        gl_TessLevelOuter[2] = right;
        gl_TessLevelOuter[3] = above;
        gl_TessLevelInner[0] = max(below, above);
        gl_TessLevelInner[1] = max(left, right);
    }
}
