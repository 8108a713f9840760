// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Reversed depth: 1 near, 0 infinitely far.

// Clip z / w from what a depth texture holds; see src/gpu/pass.h.
float depth_from_window(float window_depth)
{
#if TRL_CLIP_CONTROL
    return window_depth;
#else
    return 2.0 * window_depth - 1.0;
#endif
}
