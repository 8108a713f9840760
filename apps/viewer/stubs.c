// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The viewer of a build without GLFW.
#include "viewer.h"

#include <stdio.h>

trl_result viewer_run(const struct viewer_desc *desc, char message[VIEWER_MESSAGE_MAX])
{
    (void)desc;
    snprintf(message, VIEWER_MESSAGE_MAX,
             "this build has no viewer: install GLFW (Debian: libglfw3-dev) and build again");
    return TRL_ERROR_UNSUPPORTED;
}

const char *viewer_library(void)
{
    return "none (GLFW was not found when this was built)";
}
