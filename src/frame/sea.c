// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/sea.h"

#include "frame/daylight.h"
#include "ocean/sea.h"
#include "ocean/water.h"
#include "shared/sea.glsl"

// Where the eye sees most.
static const double MIDDLE_NM = 555;

enum { WAVELENGTHS = 48, FIRST_NM = 360, STEP_NM = 10 };

void frame_describe_sea(const struct trl_scene *scene, struct sky_sea *out)
{
    const struct ocean_desc *ocean = &scene->ocean;
    *out = (struct sky_sea){.is_there = ocean->is_there,
                            .mean_square_slope = sea_mean_square_slope(&ocean->waves),
                            .index = water_refractive_index(&ocean->water, MIDDLE_NM),
                            .white_share = sea_whitecap_share(&ocean->waves),
                            .white_albedo = SEA_WHITECAP_ALBEDO};
    for (int i = 0; ocean->is_there && i < SKY_SEA_DEPTHS; i++) {
        double nm[WAVELENGTHS], albedo[WAVELENGTHS];
        // The code 0 stands for all that is deeper.
        const double depth_m = i > 0 ? sea_code_depth((double)i / (SKY_SEA_DEPTHS - 1)) : 1e6;
        for (int k = 0; k < WAVELENGTHS; k++) {
            nm[k] = FIRST_NM + STEP_NM * k;
            albedo[k] = sea_water_albedo(ocean, depth_m, nm[k]);
        }
        const struct spectrum spectrum = {.kind = SPECTRUM_TABLE,
                                          .table = {nm, albedo, WAVELENGTHS}};
        daylight_albedo(&scene->medium, &spectrum, out->water[i]);
    }
}
