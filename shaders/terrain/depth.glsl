// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clip coordinates of the ground's mesh. The C side is src/terrain/depth.c.

uniform vec4 u_depth_range; // scale and offset (m) of clip z

// `view`: position from the camera along right / tan, up / tan, forward; m.
vec4 depth_clip(vec3 view)
{
    return vec4(view.xy, u_depth_range.x * view.z + u_depth_range.y, view.z);
}
