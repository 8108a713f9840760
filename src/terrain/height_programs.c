// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/height_programs.h"

trl_result height_programs_init(const struct surface *surface, const char *fragment,
                                struct height_programs *out)
{
    *out = (struct height_programs){.surface = surface};
    trl_result result = TRL_OK;
    const size_t most = surface_count_seen(surface, SURFACE_ELEVATION);
    for (size_t i = 0; i <= most && result == TRL_OK; i++) {
        struct surface_defines defines;
        surface_get_defines(surface, i, &defines);
        const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                              .fragment = fragment,
                                              .defines = defines.list,
                                              .define_count = defines.count};
        result = gpu_program_init(surface->gpu, &desc, &out->of[i]);
    }
    if (result != TRL_OK) {
        height_programs_finish(out);
    }
    return result;
}

void height_programs_finish(struct height_programs *programs)
{
    for (size_t i = 0; i <= SURFACE_SEEN_LAYERS; i++) {
        gpu_program_finish(&programs->of[i]);
    }
    *programs = (struct height_programs){0};
}

struct gpu_program *height_programs_bind(struct height_programs *programs,
                                         const struct surface_eye *eye, const struct anchor *anchor)
{
    const struct surface_selection seen = surface_select(programs->surface, eye);
    struct gpu_program *program = &programs->of[seen.counts[SURFACE_ELEVATION]];
    surface_bind(programs->surface, &seen, anchor, program);
    return program;
}
