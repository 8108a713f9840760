// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Mars, the Moon, Venus and Titan: what their archives' numbers mean. docs/data.md tells the same
// in words.
#include "prepare.h"

// Elevation above the areoid. The Mars Orbiter Laser Altimeter's grid of 4 cells a degree is right
// to metres; its 8 cells a degree are at hand in steps of 115 m only, which give the shapes within
// the cells of the first.
static trl_result prepare_mars_heights(const struct places *places)
{
    const struct grid16 grid = {"mars/megt90n000cb.img", 1440, 720, true, 1};
    const struct greys greys = {"mars/mars_height_8bit_2880x1440.png", -8177, 115.09};
    struct heights coarse = {0}, fine = {0};
    trl_result result = heights_read_grid(places, &grid, &coarse);
    if (result == TRL_OK && !source_exists(places, greys.file)) {
        result = heights_write(places, &coarse, "elevation.tif", "mars");
    } else if (result == TRL_OK) {
        result = heights_read_greys(places, &greys, &fine);
        if (result == TRL_OK && (fine.width != 2 * grid.width || fine.height != 2 * grid.height)) {
            result = trl_fail(places->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                              "%s: is %u x %u; must be 2880 x 1440", greys.file, fine.width,
                              fine.height);
        }
        if (result == TRL_OK) {
            result = heights_undo_steps(places, &fine, greys.step_m, &coarse);
        }
        if (result == TRL_OK) {
            result = heights_write(places, &fine, "elevation.tif", "mars");
        }
    }
    heights_finish(places, &coarse);
    heights_finish(places, &fine);
    return result;
}

// The Viking mosaic is stretched: its dark ground is blue, its range three times nature's. Albedos
// of dark and bright ground follow from spectra (McCord and Westphal 1971, Astrophys. J. 168; Bell
// et al. 1990, J. Geophys. Res. 95): 0.055 and 0.07 at 450 nm, 0.09 and 0.145 at 550, 0.13 and
// 0.275 at 650, good to 0.02.
trl_result mars_prepare(const struct places *places)
{
    const struct albedo_map map = {.file = "mars/mars_color_5400x2700.jpg",
                                   .name = "colour.tif",
                                   .latitude_deg = 60,
                                   .dark = {0.130, 0.087, 0.052},
                                   .bright = {0.263, 0.138, 0.062},
                                   .white = {0.55, 0.50, 0.45},
                                   .polar = "mars"};
    trl_result result = prepare_mars_heights(places);
    if (result == TRL_OK && source_exists(places, map.file)) {
        result = albedo_prepare(places, &map);
    }
    return result == TRL_OK ? mars_prepare_insets(places) : result;
}

// Elevation above 1737.4 km. Maria and highlands have normal albedos of about 0.07 and 0.14 at
// 550 nm, and redden by 40 % from 450 to 650 nm (Velikodsky et al. 2011, Icarus 214).
trl_result moon_prepare(const struct places *places)
{
    const struct grid16 grid = {"moon/LDEM_4.IMG", 1440, 720, false, 0.5};
    const struct albedo_map map = {.file = "moon/moon_color_4096x2048.jpg",
                                   .name = "colour.tif",
                                   .latitude_deg = 70,
                                   .dark = {0.082, 0.072, 0.060},
                                   .bright = {0.167, 0.145, 0.118},
                                   .white = {0.32, 0.28, 0.24}};
    struct heights heights = {0};
    trl_result result = heights_read_grid(places, &grid, &heights);
    if (result == TRL_OK) {
        result = heights_write(places, &heights, "elevation.tif", NULL);
    }
    heights_finish(places, &heights);
    return result == TRL_OK && source_exists(places, map.file) ? albedo_prepare(places, &map)
                                                               : result;
}

// Elevation above 6051.877 km. The radar picture is left alone: it shows roughness, not colour.
trl_result venus_prepare(const struct places *places)
{
    const struct greys greys = {"venus/venus_height_8bit_2700x1350.png", -3790, 56.6};
    struct heights heights = {0};
    trl_result result = heights_read_greys(places, &greys, &heights);
    if (result == TRL_OK) {
        result = heights_undo_steps(places, &heights, greys.step_m, NULL);
    }
    if (result == TRL_OK) {
        result = heights_write(places, &heights, "elevation.tif", NULL);
    }
    heights_finish(places, &heights);
    return result;
}

// There is no map of Titan's colours. Brightness at 938 nm, where the haze is thin, gives the
// pattern; the mean, 0.041 at 400 nm to 0.15 at 800, is what the Huygens probe saw (Karkoschka and
// Schroeder 2016, Icarus 270), and so is a range of about two.
trl_result titan_prepare(const struct places *places)
{
    const struct albedo_map map = {.file = "titan/titan_iss938nm_2048x1024.jpg",
                                   .name = "colour.tif",
                                   .latitude_deg = 60,
                                   .dark = {0.085, 0.066, 0.042},
                                   .bright = {0.165, 0.128, 0.082},
                                   .white = {0.25, 0.19, 0.12}};
    return albedo_prepare(places, &map);
}
