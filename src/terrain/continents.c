// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A continent is where a fractal noise is above a level, which follows from the share of oceans.
// Ranges follow the curves on which another noise is 0: long, connected and branching, as the edges
// of plates are. Places are moved by a third noise before, so that no shape is a noise's own.
#include "terrain/continents.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Of moisture: wet at the equator and in the middle latitudes, dry between and at the poles, as
// three cells of air to a hemisphere make it.
static const double RAIN_BANDS = 0.35;

// Fields that are independent of each other.
enum salt {
    SALT_WARP,
    SALT_LAND = 3,
    SALT_RANGE,
    SALT_OLD_RANGE,
    SALT_PATCH,
    SALT_HILLS,
    SALT_WET
};

struct field {
    uint32_t seed;
    double wave; // of the first octave, in radii
    int octaves;
    double hurst;
};

// Sum of octaves, each on a lattice turned from the one before; deviation about 1/4.
static double sum_octaves(const struct field *field, struct vec3 p)
{
    double sum = 0, size = 1, total = 0;
    struct vec3 q = vec3_scale(p, 1 / field->wave);
    const double ratio = pow(2, -field->hurst);
    for (int i = 0; i < field->octaves; i++) {
        const uint32_t n = 3 * (uint32_t)i;
        // A rotation: 3 rows of length 1 that are orthogonal.
        q = (struct vec3){0.36 * q.x + 0.48 * q.y - 0.8 * q.z, -0.8 * q.x + 0.6 * q.y,
                          0.48 * q.x + 0.64 * q.y + 0.6 * q.z};
        const NoisePlace place = {q.x,
                                  q.y,
                                  q.z,
                                  noise_hash(field->seed, n, 1),
                                  noise_hash(field->seed, n + 1, 1),
                                  noise_hash(field->seed, n + 2, 1)};
        sum += size * noise_simplex(place).value;
        total += size * size;
        size *= ratio;
        q = vec3_scale(q, 2.03);
    }
    return sum / sqrt(total);
}

static struct field make_field(const struct continents_desc *desc, enum salt salt, double wave)
{
    return (struct field){noise_hash(desc->seed, (uint32_t)salt, 2),
                          wave * desc->wavelength_m / desc->radius_m, 3, 0.9};
}

// Octaves down to four texels.
static int count_octaves(double wave)
{
    const double texel = SHARED_PI / CONTINENTS_HEIGHT;
    return (int)fmax(1, floor(log2(wave / (4 * texel)) + 1));
}

static struct vec3 warp(const struct continents_desc *desc, struct vec3 p)
{
    double moved[3];
    for (uint32_t c = 0; c < 3; c++) {
        struct field field = make_field(desc, (enum salt)(SALT_WARP + c), 0.6);
        field.hurst = 0.8;
        moved[c] = sum_octaves(&field, p);
    }
    return vec3_scale((struct vec3){moved[0], moved[1], moved[2]},
                      0.3 * desc->wavelength_m / desc->radius_m);
}

static double smooth(double low, double high, double x)
{
    return relief_smooth(low, high, x);
}

// What a texel needs besides the level of the sea.
struct draft {
    float land, range, old_range, hills, wet;
};

static struct draft draft_texel(const struct continents_desc *desc, struct vec3 p)
{
    const struct vec3 w = warp(desc, p);
    const struct vec3 bent = vec3_add(p, vec3_scale(w, 0.5));
    struct field land = make_field(desc, SALT_LAND, 1);
    land.octaves = count_octaves(land.wave);
    land.hurst = 0.85;
    struct field range = make_field(desc, SALT_RANGE, 0.6);
    range.octaves = 4;
    struct field old_range = make_field(desc, SALT_OLD_RANGE, 0.3);
    const struct field patch = make_field(desc, SALT_PATCH, 0.7);
    struct field hills = make_field(desc, SALT_HILLS, 0.3);
    hills.octaves = 4;
    hills.hurst = 0.6;
    struct field wet = make_field(desc, SALT_WET, 0.5);
    wet.octaves = count_octaves(wet.wave);
    wet.hurst = 0.55;
    const double line = sum_octaves(&range, bent) / 0.08;
    const double old_line = sum_octaves(&old_range, bent) / 0.10;
    const double patches = sum_octaves(&patch, p);
    return (struct draft){(float)sum_octaves(&land, vec3_add(p, w)),
                          (float)(exp(-line * line) * smooth(-0.25, 0.15, patches)),
                          (float)(exp(-old_line * old_line) * smooth(-0.1, 0.25, -patches)),
                          (float)smooth(-0.25, 0.4, sum_octaves(&hills, bent)),
                          (float)sum_octaves(&wet, bent)};
}

static struct noise_texel finish_texel(const struct continents_desc *desc, const struct draft *d,
                                       double latitude, double sea)
{
    // In deviations of the land's noise.
    const double inland = ((double)d->land - sea) / 0.22;
    const double is_land = desc->ocean_share > 0 ? smooth(-0.25, 0.35, inland) : 1;
    // Nobody sees how rough the floor of an ocean is, and octaves that are not there cost nothing.
    const double is_seen = desc->ocean_share > 0 ? smooth(-1, -0.4, inland) : 1;
    const double rise = desc->ocean_share > 0 ? inland : 0.8 * (inland + 1.2);
    const double plains = rise > 0 ? 0.14 * (1 - exp(-1.2 * rise))
                                   : -(1 - exp(-2 * rise * rise)) - 0.05 * tanh(-rise);
    const double range = (double)d->range, old_range = 0.35 * (double)d->old_range;
    const double mountains = fmax(range, old_range) * (0.25 + 0.75 * is_land);
    const double hills = (double)d->hills;
    return (struct noise_texel){
        .height_m = (float)(desc->height_m * (plains + 0.55 * mountains * is_land)),
        .amplitude_m = (float)(desc->amplitude_m * (0.02 + 0.16 * hills * hills + 0.9 * mountains) *
                               (0.3 + 0.7 * is_land) * is_seen),
        .ridged = desc->form == NOISE_PLAIN
                      ? 0.0f
                      : (float)(0.15 + 0.75 * smooth(0.05, 0.5, mountains + 0.2 * hills)),
        .climate = (float)(1.5 * (double)d->wet + RAIN_BANDS * cos(6 * latitude))};
}

static double row_latitude(uint32_t i)
{
    return SHARED_PI * (0.5 - ((double)(i / CONTINENTS_WIDTH) + 0.5) / CONTINENTS_HEIGHT);
}

static struct vec3 texel_direction(uint32_t i)
{
    const double longitude =
        SHARED_PI * (2 * ((double)(i % CONTINENTS_WIDTH) + 0.5) / CONTINENTS_WIDTH - 1);
    return vec3_from_lat_lon(row_latitude(i), longitude);
}

// The value below which a share of the sphere lies, by a histogram; texels count by their area.
static double find_level(const struct draft *drafts, double share)
{
    enum { BINS = 4096 };
    double areas[BINS] = {0};
    double all = 0;
    for (uint32_t i = 0; i < CONTINENTS_WIDTH * CONTINENTS_HEIGHT; i++) {
        const double area = cos(row_latitude(i));
        const double bin = (1.5 + (double)drafts[i].land) / 3 * BINS;
        areas[(int)fmin(fmax(bin, 0), BINS - 1)] += area;
        all += area;
    }
    int bin = 0;
    for (double sum = areas[0]; bin < BINS - 1 && sum < share * all; sum += areas[++bin]) {
    }
    return -1.5 + 3.0 * (bin + 0.5) / BINS;
}

trl_result continents_make(const trl_context *ctx, const struct continents_desc *desc,
                           struct noise_map *out)
{
    const size_t count = (size_t)CONTINENTS_WIDTH * CONTINENTS_HEIGHT;
    *out = (struct noise_map){CONTINENTS_WIDTH, CONTINENTS_HEIGHT, NULL};
    struct draft *drafts = mem_alloc(ctx, count, sizeof *drafts);
    out->texels = mem_alloc(ctx, count, sizeof *out->texels);
    if (!drafts || !out->texels) {
        mem_free(ctx, drafts);
        mem_free(ctx, out->texels);
        *out = (struct noise_map){0};
        return TRL_ERROR_MEMORY;
    }
#pragma omp parallel for schedule(dynamic, 4096)
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        drafts[i] = draft_texel(desc, texel_direction(i));
    }
    const double sea = desc->ocean_share > 0 ? find_level(drafts, desc->ocean_share) : 0;
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        out->texels[i] = finish_texel(desc, &drafts[i], row_latitude(i), sea);
    }
    mem_free(ctx, drafts);
    return TRL_OK;
}
