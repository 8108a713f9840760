// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef API_RENDERER_H
#define API_RENDERER_H
// What a trl_renderer is, for the public functions that look into it.

#include "frame/frame.h"

struct trl_renderer {
    const trl_context *ctx;
    struct frame frame;
};

#endif // API_RENDERER_H
