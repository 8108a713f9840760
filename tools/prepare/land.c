// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Land height from the Marble globe's elevation map: 16 x 8 JPEG tiles of 675 x 675 grey pixels,
// whose grey is a curve of the height. A step of grey is 5 m near the sea and 50 to 90 m in high
// mountains, and where the land is even the compression leaves flat blocks that differ by a few
// steps; drawn as it is, all that would show. So the smoothest field is sought near the greys.
#include "prepare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TILE_COLUMNS = 16, TILE_ROWS = 8, TILE_SIDE = 675 };

// Knots of the curve, grey to metres. Found by comparing the map with ETOPO5 over flat areas
// (medians), as the map's publisher does not state it; good to about 30 m near sea level and 5 %
// above.
static const struct knot {
    double grey, metres;
} KNOTS[] = {{0, -9000},  {12, -7578}, {18, -6105}, {24, -5560}, {30, -4739}, {36, -4000},
             {42, -3284}, {48, -2558}, {54, -1849}, {60, -1280}, {66, -641},  {72, -192},
             {78, -61},   {84, -32},   {90, -19},   {96, -7},    {102, 30},   {108, 53},
             {114, 61},   {120, 93},   {126, 148},  {132, 202},  {138, 295},  {144, 404},
             {150, 495},  {156, 606},  {162, 720},  {168, 825},  {174, 931},  {180, 1158},
             {186, 1492}, {192, 1920}, {198, 2331}, {204, 2835}, {210, 3286}, {216, 3899},
             {222, 4464}, {228, 5105}, {234, 5447}, {247, 6500}};
enum { KNOT_COUNT = sizeof KNOTS / sizeof KNOTS[0] };

static double secant(int i)
{
    return (KNOTS[i + 1].metres - KNOTS[i].metres) / (KNOTS[i + 1].grey - KNOTS[i].grey);
}

// Slope at a knot: the harmonic mean of its neighbours' (Fritsch and Butland 1984), which keeps the
// curve monotonic and without kinks, so that knots leave no trace on a slope.
static double knot_slope(int i)
{
    if (i == 0) {
        return secant(0);
    }
    if (i == KNOT_COUNT - 1) {
        return secant(KNOT_COUNT - 2);
    }
    const double a = secant(i - 1);
    const double b = secant(i);
    return 2 * a * b / (a + b);
}

static double metres_of_grey(double grey)
{
    if (grey >= KNOTS[KNOT_COUNT - 1].grey) {
        return KNOTS[KNOT_COUNT - 1].metres +
               (grey - KNOTS[KNOT_COUNT - 1].grey) * secant(KNOT_COUNT - 2);
    }
    int i = 0;
    while (i < KNOT_COUNT - 2 && grey > KNOTS[i + 1].grey) {
        i++;
    }
    const double h = KNOTS[i + 1].grey - KNOTS[i].grey;
    const double t = (grey - KNOTS[i].grey) / h;
    const double s = 1 - t;
    // Cubic Hermite polynomial in Bernstein form.
    return s * s * (1 + 2 * t) * KNOTS[i].metres + t * t * (3 - 2 * t) * KNOTS[i + 1].metres +
           h * t * s * (s * knot_slope(i) - t * knot_slope(i + 1));
}

static trl_result read_tile(const struct places *places, int column, int row, uint8_t *grey)
{
    char relative[160];
    snprintf(relative, sizeof relative, SRTM_TILE, row, row, column);
    struct picture tile;
    trl_result result = picture_read(places, relative, &tile);
    if (result != TRL_OK) {
        return result;
    }
    if (tile.width == TILE_SIDE && tile.height == TILE_SIDE && tile.bands == 1) {
        for (size_t y = 0; y < TILE_SIDE; y++) {
            const size_t to =
                ((size_t)row * TILE_SIDE + y) * GLOBE_WIDTH + (size_t)column * TILE_SIDE;
            memcpy(grey + to, tile.pixels + y * TILE_SIDE, TILE_SIDE);
        }
    } else {
        result = trl_fail(places->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                          "%s: not the grey tile of %d x %d that is known", relative, TILE_SIDE,
                          TILE_SIDE);
    }
    picture_finish(places, &tile);
    return result;
}

static trl_result read_mosaic(const struct places *places, uint8_t *grey)
{
    trl_result result = TRL_OK;
    for (int i = 0; i < TILE_COLUMNS * TILE_ROWS && result == TRL_OK; i++) {
        result = read_tile(places, i % TILE_COLUMNS, i / TILE_COLUMNS, grey);
    }
    return result;
}

// Mean over 2r + 1 columns, around the globe.
static void blur_rows(const float *from, float *to, int radius)
{
    const float scale = 1.0f / (float)(2 * radius + 1);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < GLOBE_HEIGHT; y++) {
        const float *in = from + (size_t)y * GLOBE_WIDTH;
        float *out = to + (size_t)y * GLOBE_WIDTH;
        double sum = 0;
        for (int x = -radius; x <= radius; x++) {
            sum += (double)in[(x + GLOBE_WIDTH) % GLOBE_WIDTH];
        }
        for (int x = 0; x < GLOBE_WIDTH; x++) {
            out[x] = (float)sum * scale;
            const int enters = x + radius + 1;
            const int leaves = x - radius;
            sum += (double)in[enters < GLOBE_WIDTH ? enters : enters - GLOBE_WIDTH] -
                   (double)in[leaves >= 0 ? leaves : leaves + GLOBE_WIDTH];
        }
    }
}

static int clamp_row(int y)
{
    return y < 0 ? 0 : y >= GLOBE_HEIGHT ? GLOBE_HEIGHT - 1 : y;
}

// How far from its grey a value may go, in greys, where the land is even (no contrast) and where it
// is rough. Half a step is what rounding hides; the rest is what the compression adds, which rough
// land hides and even land does not. Found by eye on hillshades of Tibet, the Himalaya and the
// Alps.
static const float FREEDOM_EVEN = 2.0f;
static const float FREEDOM_ROUGH = 0.75f;
static const float CONTRAST_ROUGH = 4.0f; // mean distance from the mean about, in greys
enum {
    CONTRAST_RADIUS = 5,
    FREEDOM_UNIT = 64,
    WIDE_RADIUS = 6
}; // freedoms are kept in 64ths of a grey

enum { STRIPE = 400 }; // columns that go down together; divides GLOBE_WIDTH

struct smoothing {
    const uint8_t *grey, *freedom; // no freedom: nothing is held
    float *field, *scratch;
};

// Wide means keep to the rounding everywhere: they would pull an even plain up to the mountains
// beside it.
static float hold(const struct smoothing *s, size_t i, int radius, float value)
{
    const float freedom =
        radius > WIDE_RADIUS ? FREEDOM_ROUGH : (float)s->freedom[i] / FREEDOM_UNIT;
    const float low = (float)s->grey[i] - freedom;
    const float high = (float)s->grey[i] + freedom;
    return value < low ? low : value > high ? high : value;
}

// Mean over 2r + 1 rows of one stripe of columns, held within its freedom about the greys.
static void blur_stripe(const struct smoothing *s, int first, int radius)
{
    const float *from = s->scratch;
    float *to = s->field;
    double sum[STRIPE] = {0};
    const float scale = 1.0f / (float)(2 * radius + 1);
    for (int y = -radius; y <= radius; y++) {
        for (int x = 0; x < STRIPE; x++) {
            sum[x] += (double)from[(size_t)clamp_row(y) * GLOBE_WIDTH + first + x];
        }
    }
    for (int y = 0; y < GLOBE_HEIGHT; y++) {
        const size_t row = (size_t)y * GLOBE_WIDTH + first;
        const float *enters = from + (size_t)clamp_row(y + radius + 1) * GLOBE_WIDTH + first;
        const float *leaves = from + (size_t)clamp_row(y - radius) * GLOBE_WIDTH + first;
        for (int x = 0; x < STRIPE; x++) {
            const float mean = (float)sum[x] * scale;
            to[row + x] = s->freedom ? hold(s, row + x, radius, mean) : mean;
            sum[x] += (double)enters[x] - (double)leaves[x];
        }
    }
}

static void smooth_once(const struct smoothing *s, int radius)
{
    blur_rows(s->field, s->scratch, radius);
#pragma omp parallel for schedule(static)
    for (int first = 0; first < GLOBE_WIDTH; first += STRIPE) {
        blur_stripe(s, first, radius);
    }
}

static void copy_greys(const struct smoothing *s)
{
    for (size_t i = 0; i < (size_t)GLOBE_WIDTH * GLOBE_HEIGHT; i++) {
        s->field[i] = s->grey[i];
    }
}

// The freedom of every pixel from the contrast about it; uses the field as scratch.
static void find_freedom(struct smoothing *s, uint8_t *freedom)
{
    const size_t count = (size_t)GLOBE_WIDTH * GLOBE_HEIGHT;
    copy_greys(s);
    smooth_once(s, CONTRAST_RADIUS);
    for (size_t i = 0; i < count; i++) {
        s->field[i] = fabsf((float)s->grey[i] - s->field[i]);
    }
    smooth_once(s, CONTRAST_RADIUS);
    for (size_t i = 0; i < count; i++) {
        const float rough = fminf(1, fmaxf(0, s->field[i] / CONTRAST_ROUGH));
        const float grey = FREEDOM_EVEN + rough * (FREEDOM_ROUGH - FREEDOM_EVEN);
        freedom[i] = (uint8_t)(grey * FREEDOM_UNIT);
    }
    s->freedom = freedom;
}

// Wide means first, which reach across broad terraces, then narrow ones, which round what is left.
static trl_result undo_steps(const struct places *places, struct smoothing *s)
{
    static const int RADII[] = {24, 24, 12, 12, 6, 6, 4, 4, 3, 3, 2, 2, 1, 1, 1};
    uint8_t *freedom = mem_alloc(places->ctx, (size_t)GLOBE_WIDTH * GLOBE_HEIGHT, 1);
    if (!freedom) {
        return TRL_ERROR_MEMORY;
    }
    find_freedom(s, freedom);
    copy_greys(s);
    const size_t passes = sizeof RADII / sizeof RADII[0];
    trl_result result = TRL_OK;
    for (size_t i = 0; i < passes && result == TRL_OK; i++) {
        smooth_once(s, RADII[i]);
        result = trl_progress(places->ctx, "land", (double)(i + 1) / (double)(passes + 1));
    }
    mem_free(places->ctx, freedom);
    return result;
}

// The curve in steps fine enough for linear interpolation: 1/16 of a grey is at most 6 m.
enum { CURVE_STEPS = 16, CURVE_SIZE = 257 * CURVE_STEPS + 2 };

static void apply_curve(float *field)
{
    float curve[CURVE_SIZE];
    for (int i = 0; i < CURVE_SIZE; i++) {
        curve[i] = (float)metres_of_grey((double)i / CURVE_STEPS);
    }
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < (size_t)GLOBE_WIDTH * GLOBE_HEIGHT; i++) {
        const float at = fminf(fmaxf(field[i], 0), 256) * CURVE_STEPS;
        const int step = (int)at;
        field[i] = curve[step] + (at - (float)step) * (curve[step + 1] - curve[step]);
    }
}

trl_result land_read(const struct places *places, struct land *out)
{
    const size_t count = (size_t)GLOBE_WIDTH * GLOBE_HEIGHT;
    *out = (struct land){.grey = mem_alloc(places->ctx, count, 1),
                         .metres = mem_alloc(places->ctx, count, sizeof(float))};
    float *scratch = mem_alloc(places->ctx, count, sizeof(float));
    trl_result result = out->grey && out->metres && scratch ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = read_mosaic(places, out->grey);
    }
    if (result == TRL_OK) {
        struct smoothing s = {.grey = out->grey, .field = out->metres, .scratch = scratch};
        result = undo_steps(places, &s);
    }
    if (result == TRL_OK) {
        apply_curve(out->metres);
    } else {
        land_finish(places, out);
    }
    mem_free(places->ctx, scratch);
    return result;
}

void land_finish(const struct places *places, struct land *land)
{
    mem_free(places->ctx, land->grey);
    mem_free(places->ctx, land->metres);
    *land = (struct land){0};
}
