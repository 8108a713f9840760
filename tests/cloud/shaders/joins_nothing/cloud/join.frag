// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// In place of cloud/join.frag: what is behind clouds is left as it was drawn.
layout(location = 0) out vec4 out_clouds;

void main()
{
    out_clouds = vec4(0.0);
}
