// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The sea's bed beside the coast of an inset. Models of land have 0 m for the sea: a shore drawn
// where they rise goes around their cells in steps. So the bed is made up near the shore, as the
// smoothest continuation of the land that lies below the sea wherever the file says sea: where
// both together cross 0 is a line that bends no more than the file demands.
#include "prepare.h"

#include "raster/raster.h"
#include "shared/shore.glsl"

#include <math.h>
#include <string.h>

// Within so many cells of land the bed is made up; beyond, it is the globe's.
enum { BAND = 8, FAR = 255 };
// And so far land may move within what rounding hides of it, as far as two cells from the sea.
enum { LAND_BAND = 2 };
static const float ROUNDED_M = 0.5f;
// Sea and land are at least so far from 0.
static const float LEAST_M = 0.25f;
// Sweeps until nothing moves that is seen, and how far each goes beyond the balance (Young 1954).
enum { SWEEPS = 400 };
static const float OVER = 1.5f;
static const double METRES_PER_DEGREE = 111195;

enum { CELL_UNKNOWN, CELL_LAND, CELL_SEA };

// Of the inset with its margin.
struct coast {
    const struct inset_grid *grid;
    uint8_t *cells;    // owned: of the enumeration above
    uint8_t *steps;    // owned: cells to the nearest one of the other kind, FAR: farther
    float *floor;      // owned: the globe's heights
    uint32_t *queue;   // owned
    const float *file; // heights as the file has them
};

static trl_result read_floor(const struct places *places, struct coast *coast)
{
    const struct inset_grid *g = coast->grid;
    char *path = mem_printf(places->ctx, "%s/elevation.tif", places->out_dir);
    struct raster globe = {0};
    trl_result result = path ? raster_open(places->ctx, path, &globe) : TRL_ERROR_MEMORY;
    const double scale = globe.pixel_width_deg > 0 ? g->cell_deg / globe.pixel_width_deg : 0;
    const double left = (g->west_deg - globe.west_deg) / fmax(globe.pixel_width_deg, 1e-9);
    const double top = (globe.north_deg - g->north_deg) / fmax(globe.pixel_height_deg, 1e-9);
    const struct raster_window window = {(uint32_t)(left - 1),
                                         (uint32_t)(top - 1),
                                         (uint32_t)(g->width * scale) + 4,
                                         (uint32_t)(g->height * scale) + 4,
                                         (uint32_t)(g->width * scale) + 4,
                                         (uint32_t)(g->height * scale) + 4};
    float *around = mem_alloc(places->ctx, (size_t)window.width * window.height, sizeof *around);
    if (result == TRL_OK) {
        result = around ? raster_read_float(&globe, &window, 0, around) : TRL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < (size_t)g->width * g->height && result == TRL_OK; i++) {
        const double x = left + ((double)(i % g->width) + 0.5) * scale - 0.5 - window.x;
        const double y = top + ((double)(i / g->width) + 0.5) * scale - 0.5 - window.y;
        const float *at = around + (size_t)y * window.width + (size_t)x;
        const double fx = x - floor(x), fy = y - floor(y);
        const double upper = (1 - fx) * (double)at[0] + fx * (double)at[1];
        const double lower =
            (1 - fx) * (double)at[window.width] + fx * (double)at[window.width + 1];
        coast->floor[i] = (float)((1 - fy) * upper + fy * lower);
    }
    mem_free(places->ctx, around);
    mem_free(places->ctx, path);
    raster_finish(&globe);
    return result;
}

// Cells beside one, in its own row and column; how many there are.
static int find_beside(const struct inset_grid *g, uint32_t i, uint32_t beside[4])
{
    const uint32_t x = i % g->width, y = i / g->width;
    int count = 0;
    if (x > 0) {
        beside[count++] = i - 1;
    }
    if (x + 1 < g->width) {
        beside[count++] = i + 1;
    }
    if (y > 0) {
        beside[count++] = i - g->width;
    }
    if (y + 1 < g->height) {
        beside[count++] = i + g->width;
    }
    return count;
}

// Of the file's cells the sea are those at 0 and below that are joined to one where the globe has
// it; in the margin, where the globe has it.
static size_t flood(struct coast *c)
{
    const size_t count = (size_t)c->grid->width * c->grid->height;
    size_t first = 0, last = 0;
    for (uint32_t i = 0; i < count; i++) {
        const bool is_known = isfinite(c->file[i]);
        const bool is_low = is_known ? c->file[i] <= 0 : true;
        const bool is_sea = is_low && c->floor[i] < 0;
        c->cells[i] = is_sea ? CELL_SEA : is_known ? CELL_LAND : CELL_UNKNOWN;
        if (is_sea && is_known) {
            c->queue[last++] = i;
        }
    }
    while (first < last) {
        uint32_t beside[4];
        const int n = find_beside(c->grid, c->queue[first++], beside);
        for (int k = 0; k < n; k++) {
            if (c->cells[beside[k]] == CELL_LAND && c->file[beside[k]] <= 0) {
                c->cells[beside[k]] = CELL_SEA;
                c->queue[last++] = beside[k];
            }
        }
    }
    return last;
}

// A cell of sea between three of land is a harbour or an error: a shore around it would be all
// corners.
static void fill_ends(struct coast *c)
{
    for (uint32_t i = 0; i < c->grid->width * c->grid->height; i++) {
        uint32_t beside[4];
        const int n = find_beside(c->grid, i, beside);
        int land = 0;
        for (int k = 0; k < n; k++) {
            land += c->cells[beside[k]] == CELL_LAND;
        }
        c->cells[i] = c->cells[i] == CELL_SEA && land >= 3 ? CELL_LAND : c->cells[i];
    }
}

// Steps from each cell to the nearest of the other kind; the margin's land is none.
static void measure(struct coast *c)
{
    const size_t count = (size_t)c->grid->width * c->grid->height;
    size_t first = 0, last = 0;
    memset(c->steps, FAR, count);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t beside[4];
        const int n = find_beside(c->grid, i, beside);
        for (int k = 0; k < n && c->steps[i] > 1; k++) {
            if (c->cells[i] != CELL_UNKNOWN &&
                c->cells[beside[k]] + c->cells[i] == CELL_LAND + CELL_SEA) {
                c->steps[i] = 1;
                c->queue[last++] = i;
            }
        }
    }
    while (first < last) {
        const uint32_t i = c->queue[first++];
        uint32_t beside[4];
        const int n = find_beside(c->grid, i, beside);
        for (int k = 0; k < n && c->steps[i] + 1 < FAR; k++) {
            if (c->cells[beside[k]] == c->cells[i] && c->steps[beside[k]] == FAR) {
                c->steps[beside[k]] = (uint8_t)(c->steps[i] + 1);
                c->queue[last++] = beside[k];
            }
        }
    }
}

// The globe's floor, but as deep at least as waves make a bed of sand (shared/shore.glsl).
static void start(struct coast *c)
{
    const struct inset_grid *g = c->grid;
    const double cell_m = g->cell_deg * METRES_PER_DEGREE;
    for (size_t i = 0; i < (size_t)g->width * g->height; i++) {
        if (c->cells[i] == CELL_SEA) {
            const float sand = isfinite(c->file[i]) ? -(float)shore_bed(c->steps[i] * cell_m) : 0;
            g->metres[i] = fminf(c->floor[i], sand);
        } else if (c->cells[i] == CELL_LAND) {
            g->metres[i] = fmaxf(g->metres[i], LEAST_M);
        }
    }
}

// What a cell lacks to the balance of a thin plate under tension (Smith and Wessel 1990, Geophysics
// 55), which without that would fall too far below a cliff: of the sums of squared second and first
// differences the gradients, over the cell's own weight in them.
static const float TENSION = 0.05f;
static float find_bend(const float *at, int64_t row)
{
    const float beside = at[-1] + at[1] + at[-row] + at[row];
    const float across = at[-row - 1] + at[-row + 1] + at[row - 1] + at[row + 1];
    const float beyond = at[-2] + at[2] + at[-2 * row] + at[2 * row];
    const float plate = (8 * beside - 2 * across - beyond) / 20;
    return at[0] - plate - TENSION * (beside / 4 - plate);
}

static bool is_free(const struct coast *c, uint32_t i)
{
    const uint32_t x = i % c->grid->width, y = i / c->grid->width;
    const bool is_inside = x >= 2 && y >= 2 && x + 2 < c->grid->width && y + 2 < c->grid->height;
    const int band = c->cells[i] == CELL_SEA ? BAND : c->cells[i] == CELL_LAND ? LAND_BAND : 0;
    return is_inside && c->steps[i] <= band &&
           isfinite(find_bend(c->grid->metres + i, c->grid->width));
}

static void settle(struct coast *c)
{
    size_t count = 0;
    for (uint32_t i = 0; i < c->grid->width * c->grid->height; i++) {
        if (is_free(c, i)) {
            c->queue[count++] = i;
        }
    }
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        for (size_t n = 0; n < count; n++) {
            float *at = c->grid->metres + c->queue[n];
            const float wanted = *at - OVER * find_bend(at, c->grid->width);
            const float file = c->file[c->queue[n]];
            const bool is_sea = c->cells[c->queue[n]] == CELL_SEA;
            const float low = is_sea ? -INFINITY : fmaxf(file - ROUNDED_M, LEAST_M);
            const float high = is_sea ? -LEAST_M : fmaxf(file + ROUNDED_M, LEAST_M);
            *at = fminf(fmaxf(wanted, low), high);
        }
    }
}

trl_result coast_make_bed(const struct places *places, const struct inset_grid *grid)
{
    const trl_context *ctx = places->ctx;
    const size_t count = (size_t)grid->width * grid->height;
    float *file = mem_alloc(ctx, count, sizeof *file);
    struct coast c = {.grid = grid, .file = file};
    c.cells = mem_alloc(ctx, count, 1);
    c.steps = mem_alloc(ctx, count, 1);
    c.floor = mem_alloc(ctx, count, sizeof *c.floor);
    c.queue = mem_alloc(ctx, count, sizeof *c.queue);
    trl_result result = file && c.cells && c.steps && c.floor && c.queue ? read_floor(places, &c)
                                                                         : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        memcpy(file, grid->metres, count * sizeof *file);
        if (flood(&c) > 0) {
            fill_ends(&c);
            measure(&c);
            start(&c);
            settle(&c);
        }
    }
    mem_free(ctx, file);
    mem_free(ctx, c.cells);
    mem_free(ctx, c.steps);
    mem_free(ctx, c.floor);
    mem_free(ctx, c.queue);
    return result;
}
