// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The noise is Perlin's (2002, "Improving noise", with a hash in place of his table), on a lattice
// that repeats with the tile; four octaves, the longer two folded into ridges. A solid texture: the
// ground cuts it at a slant, and so neither seams nor poles nor the tile's period show.
#include "terrain/detail.h"

#include <math.h>

enum { SIDE = 64, OCTAVES = 4, LEVELS = 7, LONGEST = 32, SHORTEST = 4 };
// Octaves of one size reach from LONGEST to SHORTEST texels; the next size is smaller by that and a
// little, so that no two lattices fall together.
static const double SIZE_RATIO = 8.3;

static uint32_t hash(uint32_t x)
{
    // The finaliser of MurmurHash3 (Appleby 2011).
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    return x ^ (x >> 16);
}

// Component along one of the 12 directions to a cube's edges, chosen by the lattice point.
static float corner_part(uint32_t seed, const float d[3])
{
    const uint32_t h = hash(seed) % 12;
    const float a = d[h / 4 == 0 ? 1 : 0];
    const float b = d[h / 4 == 2 ? 1 : 2];
    return (h & 1 ? a : -a) + (h & 2 ? b : -b);
}

// In about [-1, 1]; `cells` of the lattice to a tile.
static float noise_at(const float p[3], uint32_t cells, uint32_t octave)
{
    uint32_t base[3];
    float f[3], w[3];
    for (int i = 0; i < 3; i++) {
        const float floored = floorf(p[i]);
        base[i] = (uint32_t)floored;
        f[i] = p[i] - floored;
        w[i] = f[i] * f[i] * f[i] * (f[i] * (f[i] * 6 - 15) + 10);
    }
    float sum = 0;
    for (uint32_t k = 0; k < 8; k++) {
        uint32_t seed = octave;
        float d[3];
        float weight = 1;
        for (int i = 0; i < 3; i++) {
            const uint32_t step = k >> i & 1;
            seed = seed * 64 + (base[i] + step) % cells;
            d[i] = f[i] - (float)step;
            weight *= step ? w[i] : 1 - w[i];
        }
        sum += weight * corner_part(seed, d);
    }
    return sum;
}

// Heights whose octaves have slopes alike, and values whose octaves have ranges alike.
static void fill_plane(uint32_t z, float *heights, float *values)
{
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t texel[3] = {i % SIDE, i / SIDE, z};
        float height = 0;
        float value = 0;
        for (uint32_t octave = 0; octave < OCTAVES; octave++) {
            const uint32_t wave = LONGEST >> octave;
            float p[3];
            for (int c = 0; c < 3; c++) {
                // Texels lie between lattice points, where the noise is 0.
                p[c] = ((float)texel[c] + 0.5f) / (float)wave;
            }
            const float n = noise_at(p, SIDE / wave, octave);
            height += (float)wave * (octave < 2 ? 0.25f - fabsf(n) : n);
            value += n;
        }
        heights[(size_t)z * SIDE * SIDE + i] = height;
        values[(size_t)z * SIDE * SIDE + i] = value;
    }
}

static uint8_t encode(float v)
{
    return (uint8_t)lrintf(127.5f + 127.5f * fmaxf(-1, fminf(1, v)));
}

// Gradients by central differences, in parts of GRADIENT_RANGE.
static const float GRADIENT_RANGE = 6;
static const float VALUE_RANGE = 1.5f;

static void encode_plane(uint32_t z, const float *heights, const float *values, uint8_t *rgba)
{
    static const uint32_t STEP[3] = {1, SIDE, SIDE * SIDE};
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t at[3] = {i % SIDE, i / SIDE, z};
        const uint32_t here = z * SIDE * SIDE + i;
        for (int c = 0; c < 3; c++) {
            const uint32_t next = at[c] + 1 < SIDE ? here + STEP[c] : here - (SIDE - 1) * STEP[c];
            const uint32_t last = at[c] > 0 ? here - STEP[c] : here + (SIDE - 1) * STEP[c];
            rgba[4 * here + c] = encode((heights[next] - heights[last]) / (2 * GRADIENT_RANGE));
        }
        rgba[4 * here + 3] = encode(values[here] / VALUE_RANGE);
    }
}

static void halve(const uint8_t *from, uint32_t side, uint8_t *to)
{
    const uint32_t half = side / 2;
    for (uint32_t i = 0; i < half * half * half; i++) {
        const uint32_t x = 2 * (i % half), y = 2 * (i / half % half), z = 2 * (i / (half * half));
        for (uint32_t c = 0; c < 4; c++) {
            uint32_t sum = 4;
            for (uint32_t k = 0; k < 8; k++) {
                const uint32_t texel =
                    ((z + (k >> 2)) * side + y + (k >> 1 & 1)) * side + x + (k & 1);
                sum += from[4 * texel + c];
            }
            to[4 * i + c] = (uint8_t)(sum / 8);
        }
    }
}

static trl_result upload(struct gpu *gpu, uint8_t *levels[2], struct gpu_texture *out)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "detail";
    desc.shape = GPU_SHAPE_3D;
    desc.width = desc.height = desc.depth = SIDE;
    desc.levels = LEVELS;
    desc.filter = GPU_FILTER_TRILINEAR;
    desc.wrap_x = desc.wrap_y = desc.wrap_z = GPU_WRAP_REPEAT;
    desc.data = levels[0];
    trl_result result = gpu_texture_init(gpu, &desc, out);
    for (uint32_t i = 1; i < LEVELS && result == TRL_OK; i++) {
        halve(levels[(i - 1) % 2], SIDE >> (i - 1), levels[i % 2]);
        const struct gpu_region all = gpu_texture_region(out, i);
        result = gpu_texture_upload(out, &all, levels[i % 2]);
    }
    return result;
}

static trl_result make_noise(struct gpu *gpu, struct gpu_texture *out)
{
    const size_t count = (size_t)SIDE * SIDE * SIDE;
    float *heights = mem_alloc(gpu->ctx, count, sizeof *heights);
    float *values = mem_alloc(gpu->ctx, count, sizeof *values);
    uint8_t *levels[2] = {mem_alloc(gpu->ctx, count, 4), mem_alloc(gpu->ctx, count / 8, 4)};
    trl_result result = TRL_ERROR_MEMORY;
    if (heights && values && levels[0] && levels[1]) {
#pragma omp parallel for
        for (uint32_t z = 0; z < SIDE; z++) {
            fill_plane(z, heights, values);
        }
        for (uint32_t z = 0; z < SIDE; z++) {
            encode_plane(z, heights, values, levels[0]);
        }
        result = upload(gpu, levels, out);
    }
    mem_free(gpu->ctx, heights);
    mem_free(gpu->ctx, values);
    mem_free(gpu->ctx, levels[0]);
    mem_free(gpu->ctx, levels[1]);
    return result;
}

trl_result detail_init(struct gpu *gpu, const struct detail_desc *desc, double coarsest_m,
                       struct detail *out)
{
    *out = (struct detail){.desc = *desc};
    if (!(desc->smallest_m > 0) || (desc->roughness <= 0 && desc->albedo_variation <= 0)) {
        return TRL_OK;
    }
    // From waves of two texels of the data down.
    double tile = fmax(coarsest_m, desc->smallest_m) * 2 * SIDE / LONGEST;
    do {
        out->tile_m[out->size_count++] = tile;
        tile /= SIZE_RATIO;
    } while (out->size_count < DETAIL_MAX_SIZES && tile * LONGEST / SIDE > desc->smallest_m);
    const trl_result result = make_noise(gpu, &out->noise);
    if (result != TRL_OK) {
        detail_finish(out);
    }
    return result;
}

void detail_finish(struct detail *detail)
{
    gpu_texture_finish(&detail->noise);
    *detail = (struct detail){0};
}

bool detail_is_seen(const struct detail *detail, double footprint_m)
{
    // As terrain/detail.glsl fades it out: at a texel of level 5.
    return detail->size_count > 0 && footprint_m < detail->tile_m[0] / SIDE * 32;
}

// Axes of the noise along the planet's: orthonormal, and slanted to all of them.
static const struct vec3 LATTICE[3] = {
    {0.6804, 0.4127, 0.6055}, {-0.7128, 0.5596, 0.4226}, {-0.1644, -0.7191, 0.6751}};

void detail_bind(const struct detail *detail, const struct anchor *anchor, struct vec3 camera_m,
                 struct gpu_program *program)
{
    // Gram and Schmidt: the digits above are few.
    const struct vec3 x = vec3_normalize(LATTICE[0]);
    const struct vec3 z = vec3_normalize(vec3_cross(x, LATTICE[1]));
    const struct vec3 rows[3] = {x, vec3_cross(z, x), z};
    float matrix[9];
    float sizes[DETAIL_MAX_SIZES][4] = {0};
    for (int i = 0; i < 3; i++) {
        matrix[i] = (float)vec3_dot(rows[i], anchor->east);
        matrix[3 + i] = (float)vec3_dot(rows[i], anchor->north);
        matrix[6 + i] = (float)vec3_dot(rows[i], anchor->up);
        for (int k = 0; k < detail->size_count; k++) {
            // In double, since tiles are small and planets large.
            const double tiles = vec3_dot(rows[i], camera_m) / detail->tile_m[k];
            sizes[k][i] = (float)(tiles - floor(tiles));
        }
    }
    for (int k = 0; k < detail->size_count; k++) {
        sizes[k][3] = (float)(1 / detail->tile_m[k]);
    }
    const float shape[4] = {(float)detail->size_count, (float)detail->desc.roughness,
                            (float)detail->desc.albedo_variation,
                            (float)log2(detail->desc.smallest_m / SHORTEST)};
    gpu_program_set_mat3(program, "u_detail_from_local", matrix);
    gpu_program_set_vec4s(program, "u_detail_sizes", sizes[0], DETAIL_MAX_SIZES);
    gpu_program_set_vec4(program, "u_detail", shape);
    gpu_program_set_texture(program, "u_detail_noise", &detail->noise);
}
