// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "data_options.h"

#include <string.h>
#include <terrella/context.h>

void data_options_make(struct data_choice *choice, struct option out[DATA_OPTIONS])
{
    const struct option options[DATA_OPTIONS] = {
        {.name = "memory",
         .kind = OPTION_NUMBER,
         .target.number = &choice->memory_mb,
         .metavar = "MB",
         .range = {TRL_CONTEXT_MIN_RASTER_MB, 4e6},
         .is_whole = true,
         .help = "What rasters may take. When those of a scene need more together, they are read "
                 "in tiles as views show them. Default: 3000."},
        {.name = "allow-remote",
         .kind = OPTION_FLAG,
         .target.flag = &choice->allows_remote,
         .help = "Let the scene name GeoTIFFs behind a network (https://, s3://, gs://): of those, "
                 "the parts are fetched that views show. Without it such a scene is refused."},
    };
    memcpy(out, options, sizeof options);
}
