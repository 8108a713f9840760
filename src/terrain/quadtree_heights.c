// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Resources: u_places, RGBA32F, 16 x 16 blocks of 34 x 18 texels: place of each height from its
// square's middle; heights, R32F, of the same size. The left half of a block are the vertices, the
// right half, from an even column on, the middles of cells: footprints must be one for 2 x 2 pixels
// (terrain/layers.glsl).
#include "terrain/quadtree_heights.h"

#include "gpu/pass.h"
#include "shared/shared.glsl"

#include <math.h>

enum {
    MIDDLES_X = QUADTREE_SIDE + 1,
    BLOCK_WIDTH = MIDDLES_X + QUADTREE_CELLS,
    BLOCK_HEIGHT = QUADTREE_SIDE + 1,
    BLOCKS_X = 16,
    BLOCKS_Y = QUADTREE_BATCH / BLOCKS_X,
    WIDTH = BLOCKS_X * BLOCK_WIDTH,
    HEIGHT = BLOCKS_Y * BLOCK_HEIGHT
};
// Vertices see a cell's half: a whole one would round crests off.
static const double FOOTPRINT_CELLS = 0.5;
// Finer than any data.
static const double SMALL_FOOTPRINT_M = 1e-3;

void quadtree_vertex_uv(const struct tiles_place *p, double i, double j, double uv[2])
{
    const double side = ldexp(1, -p->level);
    uv[0] = ((double)p->x + i / QUADTREE_CELLS) * side;
    uv[1] = ((double)p->y + j / QUADTREE_CELLS) * side;
}

static struct tiles_geo vertex_geo(const struct tiles_place *p, double i, double j)
{
    double uv[2];
    quadtree_vertex_uv(p, i, j, uv);
    return tiles_geo_at(p->face, uv[0], uv[1]);
}

// Where each height of a block lies: x in columns of the block, y in rows.
static bool find_block_place(uint32_t x, uint32_t y, double ij[2])
{
    if (x < QUADTREE_SIDE && y < QUADTREE_SIDE) {
        ij[0] = x;
        ij[1] = y;
        return true;
    }
    ij[0] = x - MIDDLES_X + 0.5;
    ij[1] = y + 0.5;
    return x >= MIDDLES_X && y < QUADTREE_CELLS;
}

static struct anchor block_anchor(const struct quadtree_sample *s)
{
    const struct tiles_geo geo = vertex_geo(s->place, QUADTREE_CELLS / 2.0, QUADTREE_CELLS / 2.0);
    struct anchor anchor = anchor_below(vec3_from_lat_lon(geo.latitude_rad, geo.longitude_rad));
    anchor.datum_m = (double)(float)s->datum_m;
    return anchor;
}

static void put_places(const struct quadtree_sample *s, float *texels)
{
    const struct anchor anchor = block_anchor(s);
    for (uint32_t y = 0; y < BLOCK_HEIGHT; y++) {
        for (uint32_t x = 0; x < BLOCK_WIDTH; x++) {
            float *to = texels + 4 * ((size_t)y * WIDTH + x);
            const double size = x < MIDDLES_X ? FOOTPRINT_CELLS * s->cell_m : SMALL_FOOTPRINT_M;
            double ij[2];
            to[0] = to[1] = to[3] = 0;
            to[2] = (float)log2(size);
            if (find_block_place(x, y, ij)) {
                const struct tiles_geo geo = vertex_geo(s->place, ij[0], ij[1]);
                double east = geo.longitude_rad - anchor.longitude_rad;
                east -= 2 * SHARED_PI * floor(east / (2 * SHARED_PI) + 0.5);
                to[0] = (float)east;
                to[1] = (float)(geo.latitude_rad - anchor.latitude_rad);
            }
        }
    }
}

static void take_heights(const float *texels, struct quadtree_sample *s)
{
    const double datum = (double)(float)s->datum_m;
    for (uint32_t y = 0; y < QUADTREE_SIDE; y++) {
        for (uint32_t x = 0; x < QUADTREE_SIDE; x++) {
            s->vertices[y * QUADTREE_SIDE + x] = datum + (double)texels[(size_t)y * WIDTH + x];
        }
    }
    for (uint32_t y = 0; y < QUADTREE_CELLS; y++) {
        for (uint32_t x = 0; x < QUADTREE_CELLS; x++) {
            s->middles[y * QUADTREE_CELLS + x] =
                datum + (double)texels[(size_t)y * WIDTH + x + MIDDLES_X];
        }
    }
}

static double ground_at(const struct surface *surface, struct tiles_geo geo)
{
    return surface_altitude(surface, vec3_from_lat_lon(geo.latitude_rad, geo.longitude_rad));
}

static void sample_exactly(const struct surface *surface, struct quadtree_sample *s)
{
    for (uint32_t k = 0; k < QUADTREE_VERTICES; k++) {
        s->vertices[k] =
            ground_at(surface, vertex_geo(s->place, k % QUADTREE_SIDE, k / QUADTREE_SIDE));
    }
    for (uint32_t k = 0; k < QUADTREE_CELLS * QUADTREE_CELLS; k++) {
        s->middles[k] = ground_at(
            surface, vertex_geo(s->place, k % QUADTREE_CELLS + 0.5, k / QUADTREE_CELLS + 0.5));
    }
}

// The blocks of samples that the GPU makes, one after another: draws them all.
static trl_result draw_blocks(struct quadtree_heights *h, const struct quadtree_sample *samples,
                              size_t count, uint32_t rows)
{
    const struct gpu_region region = {.width = WIDTH, .height = rows * BLOCK_HEIGHT, .depth = 1};
    trl_result result = gpu_texture_upload(&h->places, &region, h->staging);
    uint32_t block = 0;
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        if (samples[i].is_exact) {
            continue;
        }
        const struct anchor anchor = block_anchor(&samples[i]);
        struct gpu_program *program = height_programs_bind(&h->programs, &samples[i].eye, &anchor);
        gpu_program_set_texture(program, "u_places", &h->places);
        const struct gpu_pass pass = {.target = &h->target,
                                      .viewport = {block % BLOCKS_X * BLOCK_WIDTH,
                                                   block / BLOCKS_X * BLOCK_HEIGHT, BLOCK_WIDTH,
                                                   BLOCK_HEIGHT}};
        gpu_pass_begin(h->surface->gpu, &pass);
        result = gpu_draw_fullscreen(program, "terrain heights");
        block++;
    }
    return result == TRL_OK ? gpu_texture_read(&h->heights, &region, h->staging) : result;
}

static size_t block_offset(uint32_t block)
{
    return (size_t)(block / BLOCKS_X) * BLOCK_HEIGHT * WIDTH +
           (size_t)(block % BLOCKS_X) * BLOCK_WIDTH;
}

trl_result quadtree_heights_sample(struct quadtree_heights *h, struct quadtree_sample *samples,
                                   size_t count)
{
#pragma omp parallel for schedule(dynamic) if (count > 4)
    for (size_t i = 0; i < count; i++) {
        if (samples[i].is_exact) {
            sample_exactly(h->surface, &samples[i]);
        }
    }
    uint32_t block = 0;
    for (size_t i = 0; i < count; i++) {
        if (!samples[i].is_exact) {
            put_places(&samples[i], h->staging + 4 * block_offset(block));
            block++;
        }
    }
    if (block == 0) {
        return TRL_OK;
    }
    const trl_result result = draw_blocks(h, samples, count, (block - 1) / BLOCKS_X + 1);
    block = 0;
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        if (!samples[i].is_exact) {
            take_heights(h->staging + block_offset(block), &samples[i]);
            block++;
        }
    }
    return result;
}

static trl_result make_textures(struct quadtree_heights *h)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = WIDTH;
    desc.height = HEIGHT;
    desc.label = "quadtree places";
    desc.format = GPU_FORMAT_RGBA32F;
    trl_result result = gpu_texture_init(h->surface->gpu, &desc, &h->places);
    if (result == TRL_OK) {
        desc.label = "quadtree heights";
        desc.format = GPU_FORMAT_R32F;
        result = gpu_texture_init(h->surface->gpu, &desc, &h->heights);
    }
    if (result == TRL_OK) {
        const struct gpu_target_desc target = {
            .label = "quadtree heights", .color_count = 1, .colors = {{.texture = &h->heights}}};
        result = gpu_target_init(h->surface->gpu, &target, &h->target);
    }
    return result;
}

trl_result quadtree_heights_init(const struct surface *surface, struct quadtree_heights *out)
{
    // Bytes of places, heights, and what is read or written of them.
    *out = (struct quadtree_heights){.surface = surface,
                                     .bytes = (uint64_t)WIDTH * HEIGHT * 9 * sizeof(float)};
    out->staging = mem_alloc(surface->ctx, (size_t)WIDTH * HEIGHT, 4 * sizeof *out->staging);
    trl_result result = out->staging ? make_textures(out) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = height_programs_init(surface, "terrain/quadtree_height.frag", &out->programs);
    }
    if (result != TRL_OK) {
        quadtree_heights_finish(out);
    }
    return result;
}

void quadtree_heights_finish(struct quadtree_heights *h)
{
    height_programs_finish(&h->programs);
    gpu_target_finish(&h->target);
    gpu_texture_finish(&h->heights);
    gpu_texture_finish(&h->places);
    if (h->surface) {
        mem_free(h->surface->ctx, h->staging);
    }
    *h = (struct quadtree_heights){0};
}
