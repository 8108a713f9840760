// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The depth of open water beside its mask: heights below sea level are lost when they are raised.
#include "terrain/load.h"

#include "shared/blend.glsl"
#include "shared/sea.glsl"

#include <math.h>
#include <string.h>

trl_result load_mask(struct surface *surface, const struct raster *raster,
                     struct terrain_layer *layer)
{
    const size_t index = surface->counts[SURFACE_WATER];
    struct gpu *gpu = surface->depth.is_told ? NULL : surface->gpu;
    trl_result result = layer_load_mask(gpu, raster, layer, &surface->masks[index]);
    if (result == TRL_OK && surface->depth.is_told) {
        // All 0: as deep as can be.
        surface->depths[index] =
            mem_alloc(surface->ctx, (size_t)layer->frame.width * layer->frame.height, 1);
        result = surface->depths[index] ? TRL_OK : TRL_ERROR_MEMORY;
    }
    return result;
}

// Water that does not lie below the sphere is no sea, and how deep it is nobody knows: 0, which
// tells it from the sea. False: no depth is found there.
static bool note_altitude(double altitude_m, uint8_t *code)
{
    if (altitude_m < 0) {
        const uint8_t depth = (uint8_t)lrint(255 * sea_depth_code(-altitude_m));
        *code = depth > 0 ? depth : 1;
    }
    return altitude_m < 0;
}

// The codes of all heights that shorts can be, 0 where none is: a globe has fifty million.
static uint8_t *make_codes(const struct surface *surface, const struct terrain_layer *layer)
{
    uint8_t *codes = mem_alloc(surface->ctx, UINT16_MAX + 1, 1);
    for (int i = INT16_MIN; codes && i <= INT16_MAX; i++) {
        note_altitude(layer->heights.scale * i + layer->heights.offset_m, &codes[(uint16_t)i]);
    }
    return codes;
}

// Whether a row of a mask along a circle of latitude can meet the layer at all.
static bool is_met(const struct layer_frame *mask, const struct layer_frame *f, uint32_t y)
{
    const double latitude = layer_geo_of(mask, 0, y).latitude;
    return mask->pole != 0 ||
           (!layer_is_beyond(f, latitude) && fabs(latitude - asin(f->direction.z)) <= f->reach_rad);
}

// The row of the layer whose texels are those of the mask's row, or none.
static int64_t find_same_row(const struct layer_frame *mask, const struct layer_frame *f,
                             uint32_t y)
{
    if (f->pole != 0 || mask->pole != 0 || !f->is_whole_circle || f->width != mask->width ||
        fabs(f->centre_x - mask->centre_x) > 1e-9) {
        return -1;
    }
    const struct layer_geo at = layer_geo_of(mask, 0, y);
    const struct layer_place p = layer_locate(f, at.latitude, at.longitude);
    return p.weight > 0 && fabs(p.y - rint(p.y)) < 0.01 ? lrint(p.y) : -1;
}

// Of a mask: its frame, and texels from the row's first on.
struct mask_row {
    const struct layer_frame *frame;
    uint32_t y;
    const uint8_t *water;
    uint8_t *codes;
};

// To a texel's neighbours, in columns and rows; itself first, those across last.
struct step {
    int x, y;
};
static const struct step STEPS[] = {{0, 0},   {-1, 0}, {1, 0},  {0, -1}, {0, 1},
                                    {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
enum { STEP_COUNT = sizeof STEPS / sizeof STEPS[0] };

static bool is_water(const struct mask_row *row, uint32_t x, struct step step)
{
    const int64_t width = row->frame->width, height = row->frame->height;
    const int64_t column = (int64_t)x + step.x, line = (int64_t)row->y + step.y;
    return column >= 0 && column < width && line >= 0 && line < height &&
           row->water[(int64_t)x + step.x + step.y * width];
}

static struct layer_place find_place(const struct mask_row *row, const struct layer_frame *f,
                                     double x, double y)
{
    const struct layer_geo at = layer_geo_of(row->frame, x, y);
    return layer_locate(f, at.latitude, at.longitude);
}

// A stretch of a mask's row and where it lies in a map about a pole. A circle of latitude bends
// little over so few texels: chords leave it by an eighth of the radius times the angle squared,
// which is a tenth of a texel for masks of half a degree. Elsewhere places jump where the circle
// closes.
enum { STRETCH = 16 };
struct stretch {
    uint32_t begin, end;
    struct layer_place ends[2];
    bool is_straight; // else each place is found by itself
};

static struct stretch stretch_make(const struct mask_row *row, const struct layer_frame *f,
                                   uint32_t begin, double y)
{
    const uint32_t end = begin + STRETCH;
    struct stretch s = {.begin = begin, .end = end};
    if (f->pole != 0 && row->frame->pole == 0) {
        s.ends[0] = find_place(row, f, begin, y);
        s.ends[1] = find_place(row, f, end, y);
        s.is_straight = s.ends[0].weight > 0 && s.ends[1].weight > 0;
    }
    return s;
}

static struct layer_place place_along(const struct stretch *s, double x)
{
    const double part = (x - s->begin) / STRETCH;
    return (struct layer_place){s->ends[0].x + part * (s->ends[1].x - s->ends[0].x),
                                s->ends[0].y + part * (s->ends[1].y - s->ends[0].y),
                                s->ends[0].weight};
}

struct noter {
    const struct mask_row *row;
    const struct terrain_layer *layer;
    int64_t same;
    const int16_t *shorts;       // of the same row, where there are codes of them; or NULL
    struct stretch stretches[3]; // of this row and those beside it
};

// NaN: the layer is not there.
static double find_altitude(struct noter *n, uint32_t x, struct step step)
{
    if (n->same >= 0) {
        return layer_texel(n->layer, (int64_t)x + step.x, n->same + step.y);
    }
    const struct layer_frame *f = &n->layer->frame;
    struct stretch *stretch = &n->stretches[1 + step.y];
    const double at_x = (double)x + step.x, at_y = (double)n->row->y + step.y;
    if (x >= stretch->end) {
        *stretch = stretch_make(n->row, f, x, at_y);
    }
    const struct layer_place p =
        stretch->is_straight ? place_along(stretch, at_x) : find_place(n->row, f, at_x, at_y);
    return p.weight > 0 ? layer_sample_held_linear(n->layer, p.x, p.y) : (double)NAN;
}

// Whether there is no water in the BLOCK texels from one on, nor beside them, as on most of land.
enum { BLOCK = 14 };
static bool is_dry(const struct mask_row *row, uint32_t x)
{
    const uint32_t width = row->frame->width;
    if (x == 0 || x + BLOCK + 1 > width || row->y == 0 || row->y + 1 >= row->frame->height) {
        return false;
    }
    uint64_t any = 0;
    for (int i = -1; i <= 1; i++) {
        uint64_t words[2]; // BLOCK and one on either side
        memcpy(words, row->water + x - 1 + i * (int64_t)width, sizeof words);
        any |= words[0] | words[1];
    }
    return any == 0;
}

// Texels of the mask take the depth where they are. Codes are interpolated, so land beside the sea
// takes that of the sea there, and so does what rises out of it.
static void note_row(const struct mask_row *row, const struct terrain_layer *layer,
                     const uint8_t *codes)
{
    struct noter n = {
        .row = row, .layer = layer, .same = find_same_row(row->frame, &layer->frame, row->y)};
    if (codes && n.same >= 0) {
        n.shorts = layer->heights.shorts + layer_texel_index(&layer->frame, 0, n.same);
    }
    for (uint32_t x = 0; x < row->frame->width; x++) {
        bool is_noted = is_dry(row, x);
        x += is_noted ? BLOCK - 1 : 0;
        if (!is_noted && n.shorts && row->water[x]) {
            const uint8_t code = codes[(uint16_t)n.shorts[x]];
            row->codes[x] = code > 0 ? code : row->codes[x];
            is_noted = code > 0;
        }
        for (int i = 0; i < STEP_COUNT && !is_noted; i++) {
            if (is_water(row, x, STEPS[i])) {
                is_noted = note_altitude(find_altitude(&n, x, STEPS[i]), row->codes + x);
            }
        }
    }
}

// Whether a layer below has a height for each texel of the mask. One that is not thrice as fine as
// the mask need not bend them: the mask could not hold what it knows better.
static bool is_known(const struct surface *surface, const struct layer_frame *mask,
                     const struct terrain_layer *layer)
{
    bool is_filled = false;
    for (size_t i = 0; i < surface->counts[SURFACE_ELEVATION]; i++) {
        const struct terrain_layer *below = &surface->layers[SURFACE_ELEVATION][i];
        is_filled = is_filled || find_same_row(mask, &below->frame, mask->height / 2) >= 0;
    }
    return is_filled && 3 * layer->frame.texel_height > mask->texel_height;
}

void load_note_depths(struct surface *surface, const struct terrain_layer *layer)
{
    if (blend_is_change(layer->mode) || !surface->depth.is_told ||
        surface->counts[SURFACE_WATER] == 0) {
        return;
    }
    uint8_t *codes = layer->heights.shorts ? make_codes(surface, layer) : NULL;
    for (size_t i = 0; i < surface->counts[SURFACE_WATER]; i++) {
        const struct layer_frame *mask = &surface->layers[SURFACE_WATER][i].frame;
        uint8_t *depths = is_known(surface, mask, layer) ? NULL : surface->depths[i];
#pragma omp parallel for schedule(dynamic, 16) if (depths)
        for (uint32_t y = 0; y < (depths ? mask->height : 0); y++) {
            if (is_met(mask, &layer->frame, y)) {
                const size_t first = layer_texel_index(mask, 0, y);
                const struct mask_row row = {mask, y, surface->masks[i] + first, depths + first};
                note_row(&row, layer, codes);
            }
        }
    }
    mem_free(surface->ctx, codes);
}

trl_result load_upload_depths(struct surface *surface)
{
    trl_result result = TRL_OK;
    for (size_t i = 0; surface->gpu && i < surface->counts[SURFACE_WATER] && result == TRL_OK;
         i++) {
        if (surface->depths[i]) {
            result = layer_upload_mask(surface->gpu, surface->masks[i], surface->depths[i],
                                       &surface->layers[SURFACE_WATER][i]);
        }
    }
    return result;
}
