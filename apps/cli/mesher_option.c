// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "mesher_option.h"

#include "app.h"

struct mesher_option mesher_option_default(void)
{
    struct mesher_option option = {.mesher = -1};
    for (int i = 0; i < MESHER_OPTION_WORDS && trl_mesher_name((trl_mesher)i); i++) {
        option.words[i] = trl_mesher_name((trl_mesher)i);
    }
    return option;
}

struct option mesher_option_make(struct mesher_option *target, const char *help)
{
    return (struct option){.name = "mesher",
                           .kind = OPTION_CHOICE,
                           .target.choice = &target->mesher,
                           .choices = target->words,
                           .metavar = "NAME",
                           .help = help};
}

trl_mesher mesher_option_get(const struct mesher_option *option)
{
    return option->mesher < 0 ? trl_renderer_desc_default().mesher : (trl_mesher)option->mesher;
}

struct option mesher_option_make_grid(struct mesher_option *target)
{
    return (struct option){.name = "grid",
                           .kind = OPTION_SIZE,
                           .target.size = &target->grid,
                           .metavar = "COLUMNSxROWS",
                           .help = "Vertices of the projective mesh, even numbers from 16 to 2048, "
                                   "whatever the picture's size. Default: 400x400."};
}

struct option mesher_option_make_error(struct mesher_option *target)
{
    return (struct option){.name = "mesh-error",
                           .kind = OPTION_NUMBER,
                           .target.number = &target->error_px,
                           .metavar = "PX",
                           .range = {TRL_MESH_ERROR_MIN_PX, TRL_MESH_ERROR_MAX_PX},
                           .help = "Error of the quadtree's mesh that may be seen, in pixels. Less "
                                   "takes more triangles, up to a budget. Default: 1.5."};
}

static bool is_side_good(uint32_t side)
{
    return side >= TRL_PROJECTIVE_MIN_SIDE && side <= TRL_PROJECTIVE_MAX_SIDE && side % 2 == 0;
}

enum exit_status mesher_option_check(const struct mesher_option *option, const char *command)
{
    const struct number_size grid = option->grid;
    if (option->error_px.is_given && mesher_option_get(option) != TRL_MESHER_QUADTREE) {
        return report_error(EXIT_USAGE, "%s: --mesh-error is for --mesher quadtree", command);
    }
    if (grid.width == 0) {
        return EXIT_OK;
    }
    if (mesher_option_get(option) != TRL_MESHER_PROJECTIVE) {
        return report_error(EXIT_USAGE, "%s: --grid is for --mesher projective", command);
    }
    return is_side_good(grid.width) && is_side_good(grid.height)
               ? EXIT_OK
               : report_error(EXIT_USAGE,
                              "%s: --grid: %ux%u: both sides must be even, from %d to %d", command,
                              grid.width, grid.height, TRL_PROJECTIVE_MIN_SIDE,
                              TRL_PROJECTIVE_MAX_SIDE);
}

trl_projective_desc mesher_option_get_projective(const struct mesher_option *option)
{
    trl_projective_desc desc = trl_renderer_desc_default().projective;
    if (option->grid.width > 0) {
        desc.columns = option->grid.width;
        desc.rows = option->grid.height;
    }
    return desc;
}

double mesher_option_get_error_px(const struct mesher_option *option)
{
    return option->error_px.is_given ? option->error_px.value
                                     : trl_renderer_desc_default().mesh_error_px;
}
