// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/noise.h"

#include "terrain/noise_parts.h"

#include <math.h>

// Contrast of ridges and valleys (relief_add).
static const double CONTRAST = 2.5;
static const double SMALLEST_SLOPE_M = 15;
// What waves longer than mountains gain, up to so many times their length: ranges. The map has what
// is longer.
static const double LONG_HURST = 0.2;
static const double LONGEST_RANGE = 4;
// What those shorter than gullies lose.
static const double FINE_HURST = 0.25;
// Gullies are of so many octaves.
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

static float amplitude_of(const struct noise_texel *t)
{
    return t->amplitude_m;
}

trl_result noise_init(struct gpu *gpu, const struct noise_desc *desc, struct noise_map *map,
                      struct terrain_noise *out)
{
    out->desc = *desc;
    out->map = *map;
    *map = (struct noise_map){0};
    place_octaves(out);
    turn_lattices(out);
    trl_result result = noise_map_level_poles(out->ctx, &out->map);
    out->steepest_spread = noise_map_find_steepest(out, amplitude_of);
    if (result == TRL_OK && gpu) {
        result = noise_map_upload(gpu, out);
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

bool noise_is_there(const struct terrain_noise *noise)
{
    return noise->map.texels != NULL;
}

double noise_shortest_m(const struct terrain_noise *noise)
{
    return noise->wave_m[noise->ends[2] - 1];
}

double noise_unseen_m(const struct terrain_noise *noise)
{
    // relief_seen: from two footprints on.
    return noise_is_there(noise) && noise->ends[2] > 0 ? noise->wave_m[0] / 2 : 0;
}

bool noise_is_seen(const struct terrain_noise *noise, double footprint_m)
{
    const double unseen_m = noise_unseen_m(noise);
    return unseen_m > 0 && footprint_m < unseen_m; // below a mountain's top footprints are negative
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
    const double lacking = relief_lacking_of(log2_wave, place->data);
    const double level = i < noise->ends[1] ? 1 : noise->desc.level_roughness;
    const double size =
        g->amplitude_m * noise->size[i] * lacking * (level + (1 - level) * r.cutting);
    const double rough = relief_soil_size(size, log2_wave, relief_soil(g->amplitude_m) * lacking);
    r = relief_add(r, relief_fold(turn_back(noise, i, n), g->ridged), size * seen, rough * seen,
                   CONTRAST);
    const double value = size > 0 ? seen * n.value : 0;
    r.tone += value * relief_tone(log2_wave);
    r.shore += value * noise->wave_m[i];
    return log2_wave > RELIEF_STAND_LOG2 ? relief_stand(r) : r;
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
    const double size = place->ground.amplitude_m * noise->size[i] * NOISE_GULLIES *
                        relief_seen(log2_wave, place->log2_footprint) *
                        relief_lacking_of(log2_wave, place->data) * relief_cutting(slope2);
    return relief_cut(r, turn_back(noise, i, n), size);
}

Relief noise_relief_at(const struct terrain_noise *noise, const struct noise_place *place)
{
    const struct noise_ground *g = &place->ground;
    struct noise_place p = *place;
    const double full = relief_fullness(g->height_m, noise->desc.full_height_m);
    p.ground.amplitude_m *= full * g->dry;
    Relief r = relief_of(g->height_m, g->slope.x, g->slope.y, g->slope.z);
    if (!(p.ground.amplitude_m > 0)) {
        return r; // at sea
    }
    for (int i = 0; i < noise->ends[2] && i < place->octaves; i++) {
        if (noise->log2_wave[i] - place->log2_footprint < 1) {
            break;
        }
        const bool is_gully = i >= noise->ends[0] && i < noise->ends[1];
        if (i == noise->ends[1]) {
            r = i > noise->ends[0] ? relief_stand(r) : r;
            const struct vec3 slope = slope_of(&r, p.up);
            r.cutting = relief_cutting(vec3_dot(slope, slope));
        }
        r = is_gully ? add_gullies(noise, &p, i, r) : add_noise(noise, &p, i, r);
    }
    const double made = (r.height - g->height_m) / fmax(g->amplitude_m, 1e-6);
    return relief_lean(r, g->spread.x * made, g->spread.y * made, g->spread.z * made);
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
    const double amplitude = place->ground.amplitude_m * place->ground.dry *
                             relief_fullness(place->ground.height_m, noise->desc.full_height_m);
    NoiseValue rock = {0, 0, 0, 0};
    for (int i = first_of_rock(noise); i < noise->ends[2] && part > 0; i++) {
        const NoiseValue n = turn_back(noise, i, noise_simplex(find_place(noise, i, at)));
        const double wave = noise->log2_wave[i];
        const double lacking = relief_lacking_of(wave, place->data);
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
    const float form[4] = {(float)CONTRAST, (float)NOISE_GULLIES, (float)desc->full_height_m,
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
