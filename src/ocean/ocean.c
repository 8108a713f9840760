// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/ocean.h"

void ocean_desc_finish(const trl_context *ctx, struct ocean_desc *desc)
{
    spectrum_finish(ctx, &desc->water.absorption_per_m);
    spectrum_finish(ctx, &desc->water.scattering_per_m);
    spectrum_finish(ctx, &desc->water.refractive_index);
    spectrum_finish(ctx, &desc->bed.albedo);
    *desc = (struct ocean_desc){0};
}
