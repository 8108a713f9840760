// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/noise.h"

#include "shared/spline.glsl"

#include <math.h>
#include <string.h>

// Contrast of ridges and valleys (relief_add); size of gullies relative to that of noise.
static const double CONTRAST = 2.5;
static const double GULLIES = 0.35;
// Gullies are of so many octaves.
// How much less folded the ground may be within reach of where it was looked at.
static const double RIDGED_SLACK = 0.3;
static const double SMALLEST_SLOPE_M = 15;
// What waves longer than mountains gain, up to so many times their length: ranges. The map has what
// is longer.
static const double LONG_HURST = 0.2;
static const double LONGEST_RANGE = 4;
// What those shorter than gullies lose.
static const double FINE_HURST = 0.25;
enum { GULLY_OCTAVES = 5 };

// Three orientations of the lattice: none of its planes lies along the planet's axes, or along
// another's.
static const struct vec3 LATTICE[3][2] = {{{0.6804, 0.4127, 0.6055}, {-0.7128, 0.5596, 0.4226}},
                                          {{-0.2311, 0.8874, 0.3990}, {0.6418, -0.1672, 0.7484}},
                                          {{0.3714, -0.5308, 0.7618}, {0.9013, 0.3935, -0.1810}}};

// Numbers from the seed: the hash of a counter.
static uint32_t draw_number(uint32_t seed, uint32_t index)
{
    return noise_hash(seed, index, 0x51ed270bu);
}

// Relative to that of mountains. Waves shorter than gullies are smoothed by soil and scree.
static double find_size(const struct noise_desc *desc, double wave_m)
{
    const double ratio = wave_m / desc->mountain_m;
    const double fine = desc->gully_m / desc->mountain_m / pow(desc->lacunarity, GULLY_OCTAVES);
    if (ratio > 1) {
        return pow(fmin(ratio, LONGEST_RANGE), LONG_HURST) / fmax(ratio / LONGEST_RANGE, 1);
    }
    return pow(ratio, desc->hurst) * pow(fmin(ratio / fine, 1), FINE_HURST);
}

static void place_octaves(struct terrain_noise *noise)
{
    const struct noise_desc *desc = &noise->desc;
    double wave = desc->wavelength_m;
    int count = 0;
    for (; count < desc->octaves && wave >= desc->smallest_m; count++) {
        noise->wave_m[count] = wave;
        noise->log2_wave[count] = log2(wave);
        noise->size[count] = find_size(desc, wave);
        for (uint32_t c = 0; c < 3; c++) {
            noise->shift[count][c] = draw_number(desc->seed, 3 * (uint32_t)count + c);
        }
        wave /= desc->lacunarity;
    }
    const bool is_eroded = desc->form == NOISE_ERODED;
    int first = 0;
    while (first < count && (!is_eroded || noise->wave_m[first] > desc->gully_m)) {
        first++;
    }
    noise->ends[0] = first;
    noise->ends[1] = first + GULLY_OCTAVES < count && is_eroded ? first + GULLY_OCTAVES : first;
    noise->ends[2] = count;
}

static void turn_lattices(struct terrain_noise *noise)
{
    for (int k = 0; k < 3; k++) {
        // Gram and Schmidt: the digits above are few.
        const struct vec3 x = vec3_normalize(LATTICE[k][0]);
        const struct vec3 z = vec3_normalize(vec3_cross(x, LATTICE[k][1]));
        noise->lattice[k][0] = x;
        noise->lattice[k][1] = vec3_cross(z, x);
        noise->lattice[k][2] = z;
    }
}

static size_t texel_index(const struct noise_map *map, int64_t x, int64_t y)
{
    const int64_t width = map->width, height = map->height;
    if (y < 0 || y >= height) {
        y = y < 0 ? -1 - y : 2 * height - 1 - y;
        x += width / 2;
    }
    x = ((x % width) + width) % width;
    return (size_t)(y * width + x);
}

static void halve(const struct noise_map *from, struct noise_map *to)
{
    for (uint32_t i = 0; i < to->width * to->height; i++) {
        const uint32_t x = 2 * (i % to->width), y = 2 * (i / to->width);
        float sum[4] = {0};
        for (uint32_t k = 0; k < 4; k++) {
            const struct noise_texel *t = &from->texels[(y + k / 2) * from->width + x + k % 2];
            sum[0] += t->height_m;
            sum[1] += t->amplitude_m;
            sum[2] += t->ridged;
            sum[3] += t->climate;
        }
        to->texels[i] = (struct noise_texel){sum[0] / 4, sum[1] / 4, sum[2] / 4, sum[3] / 4};
    }
}

// Mean over as many columns as a texel is narrower than high: all of them in the last two rows,
// which are what the spline sees at the pole, so that it has one height and is level.
static void level_row(const struct noise_map *map, uint32_t y, struct noise_texel *copy)
{
    const double latitude = SHARED_PI * (0.5 - (y + 0.5) / map->height);
    const double columns = map->width / (2.0 * map->height * cos(latitude));
    const int64_t width = map->width;
    const int64_t half = columns >= (double)width / 10 ? width / 2 : (int64_t)(columns / 2);
    struct noise_texel *row = map->texels + (size_t)y * map->width;
    memcpy(copy, row, map->width * sizeof *copy);
    for (int64_t x = 0; x < width; x++) {
        double sum[4] = {0};
        for (int64_t i = x - half; i <= x + half; i++) {
            const struct noise_texel *t = &copy[(i + width) % width];
            sum[0] += (double)t->height_m;
            sum[1] += (double)t->amplitude_m;
            sum[2] += (double)t->ridged;
            sum[3] += (double)t->climate;
        }
        const double n = (double)(2 * half + 1);
        row[x] = (struct noise_texel){(float)(sum[0] / n), (float)(sum[1] / n), (float)(sum[2] / n),
                                      (float)(sum[3] / n)};
    }
}

// From 3.6 degrees of the poles, where a texel is 16 times as high as wide.
static trl_result level_poles(const trl_context *ctx, const struct noise_map *map)
{
    struct noise_texel *copy = mem_alloc(ctx, map->width, sizeof *copy);
    const uint32_t rows = map->height / 50;
    for (uint32_t y = 0; copy && y < rows; y++) {
        level_row(map, y, copy);
        level_row(map, map->height - 1 - y, copy);
    }
    mem_free(ctx, copy);
    return copy ? TRL_OK : TRL_ERROR_MEMORY;
}

static trl_result upload(struct gpu *gpu, struct terrain_noise *noise)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "noise map";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.width = noise->map.width;
    desc.height = noise->map.height;
    desc.filter = GPU_FILTER_NEAREST;
    desc.levels = 0;
    desc.data = noise->map.texels;
    trl_result result = gpu_texture_init(gpu, &desc, &noise->texture);
    struct noise_map levels[2] = {noise->map};
    struct noise_texel *owned[2];
    const size_t quarter = (size_t)noise->map.width * noise->map.height / 4;
    owned[0] = mem_alloc(gpu->ctx, quarter, sizeof **owned);
    owned[1] = mem_alloc(gpu->ctx, quarter, sizeof **owned);
    result = owned[0] && owned[1] ? result : TRL_ERROR_MEMORY;
    for (uint32_t i = 1; i < noise->texture.levels && result == TRL_OK; i++) {
        struct noise_map *to = &levels[i % 2];
        const struct noise_map *from = &levels[(i + 1) % 2];
        *to = (struct noise_map){from->width / 2, from->height / 2, owned[i % 2]};
        if (to->height == 0) {
            *to = (struct noise_map){1, 1, owned[i % 2]};
            to->texels[0] = from->texels[0];
        } else {
            halve(from, to);
        }
        const struct gpu_region all = gpu_texture_region(&noise->texture, i);
        result = gpu_texture_upload(&noise->texture, &all, to->texels);
    }
    mem_free(gpu->ctx, owned[0]);
    mem_free(gpu->ctx, owned[1]);
    return result;
}

static float amplitude_of(const struct noise_texel *t)
{
    return t->amplitude_m;
}

static float height_of(const struct noise_texel *t)
{
    return t->height_m;
}

// The spline's slope is at most the steepest difference of texels along each direction, and both
// together root 2 of it. Rows near poles are level.
static double find_steepest(const struct terrain_noise *noise,
                            float (*value)(const struct noise_texel *))
{
    const struct noise_map *map = &noise->map;
    double most = 0;
    for (uint32_t y = 0; y + 1 < map->height; y++) {
        const double cosine = cos(SHARED_PI * (0.5 - (y + 0.5) / map->height));
        const double narrow = fmax(cosine * 2 * map->height / map->width, 0.05);
        for (uint32_t x = 0; x < map->width; x++) {
            const size_t i = (size_t)y * map->width + x;
            const size_t right = x + 1 < map->width ? i + 1 : i + 1 - map->width;
            const double here = (double)value(&map->texels[i]);
            most = fmax(most, fabs((double)value(&map->texels[i + map->width]) - here));
            most = fmax(most, fabs((double)value(&map->texels[right]) - here) / narrow);
        }
    }
    return sqrt(2) * most / (SHARED_PI * noise->radius_m / map->height);
}

trl_result noise_init(struct gpu *gpu, const struct noise_desc *desc, struct noise_map *map,
                      struct terrain_noise *out)
{
    out->desc = *desc;
    out->map = *map;
    *map = (struct noise_map){0};
    place_octaves(out);
    turn_lattices(out);
    trl_result result = level_poles(out->ctx, &out->map);
    out->steepest_spread = find_steepest(out, amplitude_of);
    if (result == TRL_OK && gpu) {
        result = upload(gpu, out);
    }
    if (result != TRL_OK) {
        noise_finish(out);
    }
    return result;
}

void noise_finish(struct terrain_noise *noise)
{
    gpu_texture_finish(&noise->texture);
    if (noise->ctx) {
        mem_free(noise->ctx, noise->map.texels);
    }
    *noise = (struct terrain_noise){0};
}

double noise_find_steepest(const struct terrain_noise *noise)
{
    return find_steepest(noise, height_of);
}

bool noise_is_there(const struct terrain_noise *noise)
{
    return noise->map.texels != NULL;
}

double noise_shortest_m(const struct terrain_noise *noise)
{
    return noise->wave_m[noise->ends[2] - 1];
}

bool noise_is_seen(const struct terrain_noise *noise, double footprint_m)
{
    // relief_seen: from two footprints on.
    return noise_is_there(noise) && noise->ends[2] > 0 && footprint_m < noise->wave_m[0] / 2;
}

struct noise_ground noise_ground_at(const struct terrain_noise *noise, struct vec3 up)
{
    const struct noise_map *map = &noise->map;
    const double flat = hypot(up.x, up.y);
    const double per_radian[2] = {map->width / (2 * SHARED_PI), map->height / SHARED_PI};
    const double x = (atan2(up.y, up.x) + SHARED_PI) * per_radian[0] - 0.5;
    const double y = (SHARED_PI / 2 - atan2(up.z, flat)) * per_radian[1] - 0.5;
    const int64_t column = (int64_t)floor(x + 0.5), row = (int64_t)floor(y + 0.5);
    const double fx = x - (double)column, fy = y - (double)row;
    double rows[3][4], slopes[3][2];
    for (int j = 0; j < 3; j++) {
        const struct noise_texel *t[3];
        for (int i = 0; i < 3; i++) {
            t[i] = &map->texels[texel_index(map, column - 1 + i, row - 1 + j)];
        }
#define BLEND(blend, part) blend(fx, (double)t[0]->part, (double)t[1]->part, (double)t[2]->part)
        rows[j][0] = BLEND(spline_blend, height_m);
        rows[j][1] = BLEND(spline_blend, amplitude_m);
        rows[j][2] = BLEND(spline_blend, ridged);
        rows[j][3] = BLEND(spline_blend, climate);
        slopes[j][0] = BLEND(spline_slope, height_m);
        slopes[j][1] = BLEND(spline_slope, amplitude_m);
#undef BLEND
    }
    double blended[4];
    struct vec3 slope[2];
    const struct vec3 east = {-up.y / fmax(flat, 1e-12), up.x / fmax(flat, 1e-12), 0};
    const struct vec3 north = vec3_cross(up, east);
    for (int c = 0; c < 4; c++) {
        blended[c] = spline_blend(fy, rows[0][c], rows[1][c], rows[2][c]);
    }
    for (int c = 0; c < 2; c++) {
        const double along = spline_blend(fy, slopes[0][c], slopes[1][c], slopes[2][c]) *
                             per_radian[0] / (noise->radius_m * fmax(flat, 1e-4));
        const double south =
            spline_slope(fy, rows[0][c], rows[1][c], rows[2][c]) * per_radian[1] / noise->radius_m;
        slope[c] = vec3_sub(vec3_scale(east, along), vec3_scale(north, south));
    }
    return (struct noise_ground){blended[0], blended[1], blended[2],
                                 blended[3], slope[0],   slope[1]};
}

// Of a point in m from the planet's centre.
static NoisePlace find_place(const struct terrain_noise *noise, int octave, struct vec3 point)
{
    const struct vec3 *rows = noise->lattice[octave % 3];
    const double scale = 1 / noise->wave_m[octave];
    const double q[3] = {vec3_dot(rows[0], point) * scale, vec3_dot(rows[1], point) * scale,
                         vec3_dot(rows[2], point) * scale};
    const double skew = (q[0] + q[1] + q[2]) * NOISE_SKEW;
    const double whole[3] = {floor(q[0] + skew), floor(q[1] + skew), floor(q[2] + skew)};
    const double unskew = (whole[0] + whole[1] + whole[2]) * NOISE_UNSKEW;
    return (NoisePlace){.x = q[0] - (whole[0] - unskew),
                        .y = q[1] - (whole[1] - unskew),
                        .z = q[2] - (whole[2] - unskew),
                        .i = noise->shift[octave][0] + shared_whole(whole[0]),
                        .j = noise->shift[octave][1] + shared_whole(whole[1]),
                        .k = noise->shift[octave][2] + shared_whole(whole[2])};
}

// With its gradient along planet axes, per m.
static NoiseValue turn_back(const struct terrain_noise *noise, int octave, NoiseValue n)
{
    const struct vec3 *rows = noise->lattice[octave % 3];
    const struct vec3 g =
        vec3_scale(vec3_add(vec3_scale(rows[0], n.x),
                            vec3_add(vec3_scale(rows[1], n.y), vec3_scale(rows[2], n.z))),
                   1 / noise->wave_m[octave]);
    return (NoiseValue){n.value, g.x, g.y, g.z};
}

static struct vec3 slope_of(const Relief *r, struct vec3 up)
{
    const struct vec3 s = {r->x, r->y, r->z};
    return vec3_sub(s, vec3_scale(up, vec3_dot(s, up)));
}

static Relief add_noise(const struct terrain_noise *noise, const struct noise_place *place, int i,
                        Relief r)
{
    const struct noise_ground *g = &place->ground;
    const NoiseValue n =
        noise_simplex(find_place(noise, i, vec3_scale(place->up, noise->radius_m)));
    const double log2_wave = noise->log2_wave[i];
    const double seen = relief_seen(log2_wave, place->log2_footprint);
    double size = g->amplitude_m * noise->size[i] * relief_lacking(log2_wave, place->log2_texel);
    if (i >= noise->ends[1]) {
        const double level = noise->desc.level_roughness;
        size *= level + (1 - level) * r.cutting;
    }
    r = relief_add(r, relief_fold(turn_back(noise, i, n), g->ridged), size * seen, CONTRAST);
    r.tone += size > 0 ? seen * relief_tone(log2_wave) * n.value : 0;
    return r;
}

static Relief add_gullies(const struct terrain_noise *noise, const struct noise_place *place, int i,
                          Relief r)
{
    const struct vec3 fall = {r.fall_x, r.fall_y, r.fall_z};
    const struct vec3 slope = vec3_sub(fall, vec3_scale(place->up, vec3_dot(fall, place->up)));
    const double slope2 = vec3_dot(slope, slope);
    const struct vec3 along = vec3_scale(vec3_cross(place->up, slope), 1 / sqrt(slope2 + 1e-12));
    const struct vec3 *rows = noise->lattice[i % 3];
    const NoiseValue n =
        noise_stripes(find_place(noise, i, vec3_scale(place->up, noise->radius_m)),
                      vec3_dot(rows[0], along), vec3_dot(rows[1], along), vec3_dot(rows[2], along));
    const double log2_wave = noise->log2_wave[i];
    const double size = place->ground.amplitude_m * noise->size[i] * GULLIES *
                        relief_seen(log2_wave, place->log2_footprint) *
                        relief_lacking(log2_wave, place->log2_texel) * relief_cutting(slope2);
    return relief_cut(r, turn_back(noise, i, n), size);
}

Relief noise_relief_at(const struct terrain_noise *noise, const struct noise_place *place)
{
    const struct noise_ground *g = &place->ground;
    struct noise_place p = *place;
    const double full = relief_fullness(g->height_m, noise->desc.full_height_m);
    p.ground.amplitude_m *= full;
    Relief r = relief_of(g->height_m, g->slope.x, g->slope.y, g->slope.z);
    if (!(p.ground.amplitude_m > 0)) {
        return r; // at sea
    }
    for (int i = 0; i < noise->ends[2] && i < place->octaves; i++) {
        if (noise->log2_wave[i] - place->log2_footprint < 1) {
            break;
        }
        const bool is_gully = i >= noise->ends[0] && i < noise->ends[1];
        if (i == noise->ends[0]) {
            r.fall_x = r.x;
            r.fall_y = r.y;
            r.fall_z = r.z;
        }
        if (i == noise->ends[1]) {
            const struct vec3 slope = slope_of(&r, p.up);
            r.cutting = relief_cutting(vec3_dot(slope, slope));
        }
        r = is_gully ? add_gullies(noise, &p, i, r) : add_noise(noise, &p, i, r);
    }
    const double made = (r.height - g->height_m) / fmax(g->amplitude_m, 1e-6);
    r.x += g->spread.x * made;
    r.y += g->spread.y * made;
    r.z += g->spread.z * made;
    return r;
}

static int first_of_rock(const struct terrain_noise *noise)
{
    int i = 0;
    while (i < noise->ends[2] && noise->log2_wave[i] > RELIEF_ROCK_LOG2) {
        i++;
    }
    return i;
}

struct vec3 noise_rock_normal(const struct terrain_noise *noise, const struct noise_place *place,
                              const struct noise_stand *stand)
{
    const double part = relief_rock(stand->slope);
    const struct vec3 at = vec3_scale(place->up, noise->radius_m + stand->height_m);
    const double amplitude = place->ground.amplitude_m *
                             relief_fullness(place->ground.height_m, noise->desc.full_height_m);
    NoiseValue rock = {0, 0, 0, 0};
    for (int i = first_of_rock(noise); i < noise->ends[2] && part > 0; i++) {
        const NoiseValue n = turn_back(noise, i, noise_simplex(find_place(noise, i, at)));
        const double wave = noise->log2_wave[i];
        const double lacking = relief_lacking(wave, place->log2_texel);
        const double size = part * relief_seen(wave, place->log2_footprint) * lacking *
                            relief_rock_size(amplitude * noise->size[i] * lacking, wave);
        rock.x += size * n.x;
        rock.y += size * n.y;
        rock.z += size * n.z;
    }
    const RockNormal normal = {stand->normal.x, stand->normal.y, stand->normal.z};
    const RockNormal r = relief_rock_normal(normal, rock);
    return (struct vec3){r.x, r.y, r.z};
}

struct noise_reach noise_find_reach(const struct terrain_noise *noise, double amplitude_m,
                                    double ridged)
{
    double noises = 0, gullies = 0;
    for (int i = 0; i < noise->ends[2]; i++) {
        const bool is_gully = i >= noise->ends[0] && i < noise->ends[1];
        *(is_gully ? &gullies : &noises) += noise->size[i];
    }
    // relief_fold: from 1 and -1 of plain noise to 0.23 and -1.33 of ridges.
    const double weight = RELIEF_WEIGHT_BOUND;
    return (struct noise_reach){
        -amplitude_m * (noises * weight * (1 + 0.35 * ridged) + gullies * GULLIES),
        amplitude_m * (noises * weight * (1 - 0.77 * ridged) + gullies * GULLIES)};
}

// Slopes per wavelength of octaves of size 1. Of a million random places one octave alone is never
// steeper than 13, ten together than 30: one is let be the steepest, and the others a third of it.
// Gullies are steeper about their forks only, where they are no higher than elsewhere.
static const double STEEPEST_NOISE = 13;
static const double NEXT_STEEPEST = 4;
static const double STEEPEST_GULLY = 20;

// The least, the given and the largest of what octaves are multiplied by, within a reach.
struct noise_range {
    double least, here, most;
};

static struct noise_range find_amplitudes(const struct terrain_noise *noise,
                                          const struct noise_place *place,
                                          const struct noise_around *around)
{
    const struct noise_ground *g = &place->ground;
    const double full = noise->desc.full_height_m;
    const double spread = noise->steepest_spread * around->reach_m;
    const double rise = around->steepest * around->reach_m;
    const double height = fabs(g->height_m);
    return (struct noise_range){fmax(g->amplitude_m - spread, 0) *
                                    relief_fullness(fmax(height - rise, 0), full),
                                g->amplitude_m * relief_fullness(height, full),
                                (g->amplitude_m + spread) * relief_fullness(height + rise, full)};
}

// Of an octave, with what data leave of it; `texels` are what they may resolve (log2).
static struct noise_range find_sizes(const struct terrain_noise *noise, int octave,
                                     const struct noise_range *amplitudes, const double texels[3])
{
    const double size = noise->size[octave], wave = noise->log2_wave[octave];
    return (struct noise_range){amplitudes->least * size * relief_lacking(wave, texels[0]),
                                amplitudes->here * size * relief_lacking(wave, texels[1]),
                                amplitudes->most * size * relief_lacking(wave, texels[2])};
}

struct noise_rise noise_find_rise(const struct terrain_noise *noise,
                                  const struct noise_place *place,
                                  const struct noise_around *around)
{
    // relief_fold: between -1.35 and 1 of plain noise, 0.23 of ridges.
    const double ridged = fmax(place->ground.ridged - RIDGED_SLACK, 0);
    const double up = RELIEF_WEIGHT_BOUND * (1 - 0.77 * ridged);
    const double any = RELIEF_WEIGHT_BOUND * RELIEF_VALUE_BOUND;
    const struct noise_range amplitudes = find_amplitudes(noise, place, around);
    const double texels[3] = {around->log2_texel[0], place->log2_texel, around->log2_texel[1]};
    struct noise_rise rise = {0, 0, 0};
    bool is_long = true;
    double steepest = 0;
    for (int i = 0; i < noise->ends[2]; i++) {
        const bool is_gully = i >= noise->ends[0] && i < noise->ends[1];
        const struct noise_range size = find_sizes(noise, i, &amplitudes, texels);
        const double most = size.most * (is_gully ? GULLIES : up);
        const double slope = size.most * (is_gully ? GULLIES * STEEPEST_GULLY : STEEPEST_NOISE);
        const double change = slope * around->reach_m / noise->wave_m[i];
        is_long = is_long && (change < most || !(most > 0));
        rise.octaves += is_long;
        rise.most_m += most;
        const double part = is_gully ? 1 : NEXT_STEEPEST / STEEPEST_NOISE;
        rise.rise_m += is_long ? part * change : most;
        steepest = is_long && !is_gully ? fmax(steepest, change) : steepest;
        // What is there grows, or sinks, with what it is multiplied by.
        const double grown = fmax(size.most - size.here, size.here - size.least);
        rise.rise_m += is_long ? (is_gully ? GULLIES : any) * grown : 0;
    }
    rise.rise_m += steepest * (1 - NEXT_STEEPEST / STEEPEST_NOISE);
    return rise;
}

double noise_find_most(const struct terrain_noise *noise, const struct noise_ground *ground,
                       double reach_m)
{
    const double amplitude = ground->amplitude_m + noise->steepest_spread * reach_m;
    return noise_find_reach(noise, amplitude, fmax(ground->ridged - RIDGED_SLACK, 0)).up_m;
}

static void bind_map(const struct terrain_noise *noise, const struct anchor *anchor,
                     struct gpu_program *program)
{
    const struct noise_map *map = &noise->map;
    const double per_radian[2] = {map->width / (2 * SHARED_PI), map->height / SHARED_PI};
    const double x = (anchor->longitude_rad + SHARED_PI) * per_radian[0] - 0.5;
    const double y = (SHARED_PI / 2 - anchor->latitude_rad) * per_radian[1] - 0.5;
    const double column = fmin(fmax(floor(x), 0), map->width - 1.0);
    const double row = fmin(fmax(floor(y), 0), map->height - 1.0);
    const int32_t base[4] = {(int32_t)column, (int32_t)row, 0, 0};
    const float place[4] = {(float)(x - column), (float)(y - row), (float)per_radian[0],
                            (float)per_radian[1]};
    gpu_program_set_ivec4s(program, "u_noise_map_base", base, 1);
    gpu_program_set_vec4(program, "u_noise_map_place", place);
    gpu_program_set_texture(program, "u_noise_map", &noise->texture);
}

static void bind_octaves(const struct terrain_noise *noise, const struct anchor *anchor,
                         struct gpu_program *program)
{
    float places[NOISE_MAX_OCTAVES][4], sizes[NOISE_MAX_OCTAVES][4];
    int32_t bases[NOISE_MAX_OCTAVES][4];
    const size_t count = (size_t)noise->ends[2];
    double tail = 0, tail_height = 0;
    for (int i = noise->ends[2] - 1; i >= 0; i--) {
        const NoisePlace p = find_place(noise, i, vec3_scale(anchor->up, noise->radius_m));
        const float place[4] = {(float)p.x, (float)p.y, (float)p.z, (float)(1 / noise->wave_m[i])};
        const int32_t base[4] = {(int32_t)p.i, (int32_t)p.j, (int32_t)p.k, 0};
        // Stones do not make a slope.
        tail += noise->wave_m[i] < SMALLEST_SLOPE_M ? 0 : pow(noise->size[i] / noise->wave_m[i], 2);
        tail_height += pow(noise->size[i], 2);
        const float size[4] = {(float)log2(noise->wave_m[i]), (float)noise->size[i], (float)tail,
                               (float)tail_height};
        for (int c = 0; c < 4; c++) {
            places[i][c] = place[c];
            bases[i][c] = base[c];
            sizes[i][c] = size[c];
        }
    }
    gpu_program_set_vec4s(program, "u_noise_place", places[0], count);
    gpu_program_set_vec4s(program, "u_noise_size", sizes[0], count);
    gpu_program_set_ivec4s(program, "u_noise_base", bases[0], count);
}

void noise_bind(const struct terrain_noise *noise, const struct anchor *anchor,
                struct gpu_program *program)
{
    if (!noise_is_there(noise)) {
        return;
    }
    float rows[9][4] = {0};
    for (int i = 0; i < 9; i++) {
        const struct vec3 local = anchor_local(anchor, noise->lattice[i / 3][i % 3]);
        rows[i][0] = (float)local.x;
        rows[i][1] = (float)local.y;
        rows[i][2] = (float)local.z;
    }
    const struct noise_desc *desc = &noise->desc;
    const int32_t ends[4] = {noise->ends[0], noise->ends[1], noise->ends[2], first_of_rock(noise)};
    const float form[4] = {(float)CONTRAST, (float)GULLIES, (float)desc->full_height_m,
                           desc->has_sea ? 0.0f : -1e9f};
    const float more[4] = {(float)desc->level_roughness,
                           (float)log2(SHARED_PI * noise->radius_m / noise->map.height),
                           (float)desc->albedo_variation, 0};
    bind_map(noise, anchor, program);
    bind_octaves(noise, anchor, program);
    gpu_program_set_vec4s(program, "u_noise_lattice", rows[0], 9);
    gpu_program_set_ivec4s(program, "u_noise_ends", ends, 1);
    gpu_program_set_vec4(program, "u_noise_form", form);
    gpu_program_set_vec4(program, "u_noise_more", more);
}
