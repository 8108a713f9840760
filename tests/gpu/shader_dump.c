// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Prints shaders exactly as drivers get them, for validate_shaders.py.
//     shader_dump                            the names of all built-in shaders
//     shader_dump NAME VERSION [DEFINE...]   the text; VERSION 330, 400 (core), 300 or 320 (es)
#include "gpu/shader_source.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    if (argc == 1) {
        for (const struct gpu_shader_file *file = gpu_shader_files; file->name; file++) {
            puts(file->name);
        }
        return 0;
    }
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    trl_context *ctx = NULL;
    if (argc < 3 || trl_context_create(&desc, &ctx) != TRL_OK) {
        return 2;
    }
    const int version = atoi(argv[2]);
    const struct shader_request request = {.name = argv[1],
                                           .defines = (const char *const *)argv + 3,
                                           .define_count = (size_t)argc - 3,
                                           .language = {.version = version,
                                                        .is_es = version < 330,
                                                        .has_clip_control = version >= 330}};
    struct shader_source source;
    const trl_result result = shader_source_init(ctx, &request, &source);
    if (result == TRL_OK) {
        fputs(source.text, stdout);
        for (size_t i = 0; i < source.file_count; i++) {
            printf("// file %zu is %s\n", i, source.files[i]);
        }
        shader_source_finish(&source);
    }
    trl_context_destroy(&ctx);
    return result == TRL_OK ? 0 : 1;
}
