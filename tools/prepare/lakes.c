// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Lakes are level. The land map is vague by tens of metres where they are, and the mask of water
// spills over their shores: each lake takes the median of the heights in it, and ends where the
// land is much higher than that; where the mask is sure, only where it is far higher, since such
// heights are wrong by as much (the Dead Sea's by hundreds of metres).
#include "prepare.h"

#include <stdlib.h>
#include <string.h>

// So much above a lake is land, so much below it another valley.
enum { WATER = 128, SURE = 255, SHORE_M = 60, SURE_SHORE_M = 240 };

struct lakes {
    const struct places *places;
    int16_t *elevation;
    uint8_t *water;
    uint32_t *cells; // owned: of one lake
    int16_t *sorted; // owned: their heights
    uint8_t *marks;  // owned: 1 where a lake has been
};

// Index of a cell's neighbour, or the cell's own beyond a pole.
static size_t find_neighbour(size_t i, int dx, int dy)
{
    const int row = (int)(i / GLOBE_WIDTH) + dy;
    const int column = ((int)(i % GLOBE_WIDTH) + dx + GLOBE_WIDTH) % GLOBE_WIDTH;
    return row < 0 || row >= GLOBE_HEIGHT ? i : (size_t)row * GLOBE_WIDTH + (size_t)column;
}

static bool is_lake(const struct lakes *lakes, const uint8_t *oceans, size_t i)
{
    return lakes->water[i] >= WATER && !oceans[i] && !lakes->marks[i];
}

// Marks all cells of the lake that a cell belongs to; how many there are.
static size_t flood(struct lakes *lakes, const uint8_t *oceans, size_t first)
{
    size_t count = 0;
    lakes->marks[first] = 1;
    lakes->cells[count++] = (uint32_t)first;
    for (size_t next = 0; next < count; next++) {
        for (int k = 0; k < 9; k++) {
            const size_t i = find_neighbour(lakes->cells[next], k % 3 - 1, k / 3 - 1);
            if (is_lake(lakes, oceans, i)) {
                lakes->marks[i] = 1;
                lakes->cells[count++] = (uint32_t)i;
            }
        }
    }
    return count;
}

static int compare(const void *a, const void *b)
{
    return *(const int16_t *)a - *(const int16_t *)b;
}

// Median of what is surely water, or of all.
static int find_level(struct lakes *lakes, size_t count)
{
    size_t sure = 0;
    for (int least = 255; sure == 0; least = 0) {
        for (size_t n = 0; n < count; n++) {
            if (lakes->water[lakes->cells[n]] >= least) {
                lakes->sorted[sure++] = lakes->elevation[lakes->cells[n]];
            }
        }
    }
    qsort(lakes->sorted, sure, sizeof *lakes->sorted, compare);
    return lakes->sorted[sure / 2];
}

// Land beside the lake holds it, but where it is a valley below.
static void hold(struct lakes *lakes, const uint8_t *oceans, size_t i, int level)
{
    if (lakes->water[i] >= WATER || oceans[i]) {
        return;
    }
    if (lakes->elevation[i] > level + SHORE_M) {
        lakes->water[i] = 0;
    } else if (lakes->elevation[i] < level && lakes->elevation[i] > level - SHORE_M) {
        lakes->elevation[i] = (int16_t)level;
    }
}

static void set_level(struct lakes *lakes, const uint8_t *oceans, size_t count, int level)
{
    for (size_t n = 0; n < count; n++) {
        const size_t i = lakes->cells[n];
        const int shore_m = lakes->water[i] == SURE ? SURE_SHORE_M : SHORE_M;
        if (lakes->elevation[i] > level + shore_m) {
            lakes->water[i] = 0;
        } else {
            lakes->elevation[i] = (int16_t)level;
        }
    }
    for (size_t n = 0; n < count; n++) {
        for (int k = 0; k < 9; k++) {
            hold(lakes, oceans, find_neighbour(lakes->cells[n], k % 3 - 1, k / 3 - 1), level);
        }
    }
}

trl_result lakes_make_level(const struct places *places, const uint8_t *oceans, int16_t *elevation,
                            uint8_t *water)
{
    const size_t count = (size_t)GLOBE_WIDTH * GLOBE_HEIGHT;
    struct lakes lakes = {.places = places, .elevation = elevation, .water = water};
    lakes.cells = mem_alloc(places->ctx, count, sizeof *lakes.cells);
    lakes.sorted = mem_alloc(places->ctx, count, sizeof *lakes.sorted);
    lakes.marks = mem_alloc(places->ctx, count, 1);
    const bool is_made = lakes.cells && lakes.sorted && lakes.marks;
    if (is_made) {
        memset(lakes.marks, 0, count);
    }
    for (size_t i = 0; i < count && is_made; i++) {
        if (is_lake(&lakes, oceans, i)) {
            const size_t cells = flood(&lakes, oceans, i);
            set_level(&lakes, oceans, cells, find_level(&lakes, cells));
        }
    }
    mem_free(places->ctx, lakes.cells);
    mem_free(places->ctx, lakes.sorted);
    mem_free(places->ctx, lakes.marks);
    return is_made ? TRL_OK : TRL_ERROR_MEMORY;
}
