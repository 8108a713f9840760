// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Bounds of the composed altitudes, cell by cell: those of each layer, laid over each other as the
// layers are.
#include "terrain/bounds.h"

#include "shared/blend.glsl"
#include "shared/cubic.glsl"
#include "terrain/make.h"

#include <math.h>

enum { COLUMNS = SURFACE_BOUNDS_COLUMNS, ROWS = SURFACE_BOUNDS_ROWS, CELLS = COLUMNS * ROWS };
// Texels of a stereographic layer that are looked at together, in each direction.
enum { BLOCK = 8 };
static const double CELL_RAD = SHARED_PI / SURFACE_BOUNDS_ROWS; // square, in degrees
static const struct surface_bounds EMPTY = {INFINITY, -INFINITY};

static size_t cell_index(double latitude, double longitude)
{
    const double u = (longitude + SHARED_PI) / (2 * SHARED_PI);
    const double x = floor((u - floor(u)) * COLUMNS);
    const double y = floor((0.5 - latitude / SHARED_PI) * ROWS);
    return (size_t)fmax(0, fmin(y, ROWS - 1)) * COLUMNS + (size_t)fmin(x, COLUMNS - 1);
}

static void join(struct surface_bounds *a, const struct surface_bounds *b)
{
    a->min = fminf(a->min, b->min);
    a->max = fmaxf(a->max, b->max);
}

// Bounds of a run of texels of a row.
static struct surface_bounds bound_run(const struct layer_heights *h, size_t first, size_t count)
{
    double low = INFINITY;
    double high = -INFINITY;
    if (h->shorts) {
        int16_t a = INT16_MAX;
        int16_t b = INT16_MIN;
        for (size_t i = first; i < first + count; i++) {
            const int16_t v = h->shorts[i];
            a = v < a ? v : a;
            b = v > b ? v : b;
        }
        low = a;
        high = b;
    } else {
        for (size_t i = first; i < first + count; i++) {
            low = fmin(low, (double)h->floats[i]);
            high = fmax(high, (double)h->floats[i]);
        }
    }
    const double m[2] = {h->offset_m + h->scale * low, h->offset_m + h->scale * high};
    return (struct surface_bounds){(float)fmin(m[0], m[1]), (float)fmax(m[0], m[1])};
}

// Runs of texels of a row that are as long as a cell are scanned at once.
static void bound_row(const struct terrain_layer *layer, uint32_t y, struct surface_bounds *cells)
{
    const struct layer_frame *f = &layer->frame;
    const uint32_t run = (uint32_t)fmax(1, CELL_RAD / f->texel_width);
    for (uint32_t x = 0; x < f->width; x += run) {
        const uint32_t end = x + run < f->width ? x + run : f->width;
        const struct surface_bounds b =
            bound_run(&layer->heights, (size_t)y * f->width + x, end - x);
        // A run may straddle two cells.
        for (int side = 0; side < 2; side++) {
            const struct layer_geo g = layer_geo_of(f, side ? end - 1 : x, y);
            join(&cells[cell_index(g.latitude, g.longitude)], &b);
        }
    }
}

// A cap's extent as cells: rows, and columns beside the middle's meridian.
struct cap {
    double south, north, longitude, half_width;
    int rows, columns;
};

static struct cap cap_around(double latitude, double longitude, double angle_rad)
{
    struct cap cap = {
        .south = latitude - angle_rad, .north = latitude + angle_rad, .longitude = longitude};
    // A cap of angle a spans asin(sin a / cos latitude) of longitude to either side.
    const double ratio = sin(fmin(angle_rad, SHARED_PI / 2)) / fmax(cos(latitude), 1e-9);
    const bool holds_pole = cap.north >= SHARED_PI / 2 || cap.south <= -SHARED_PI / 2 || ratio >= 1;
    cap.half_width = holds_pole ? SHARED_PI : asin(ratio);
    cap.rows = (int)ceil((cap.north - cap.south) / CELL_RAD) + 1;
    cap.columns = (int)fmin(ceil(2 * cap.half_width / CELL_RAD) + 1, COLUMNS);
    return cap;
}

// Cell of row j, column i of the cap; they may repeat.
static size_t cap_cell(const struct cap *cap, int i, int j)
{
    const double y = fmin(cap->south + j * CELL_RAD, cap->north);
    return cell_index(fmax(-SHARED_PI / 2, fmin(SHARED_PI / 2, y)),
                      cap->longitude - cap->half_width + fmin(i * CELL_RAD, 2 * cap->half_width));
}

static void bound_block(const struct terrain_layer *layer, uint32_t x, uint32_t y,
                        struct surface_bounds *cells)
{
    const struct layer_frame *f = &layer->frame;
    const uint32_t width = f->width - x < BLOCK ? f->width - x : BLOCK;
    const uint32_t height = f->height - y < BLOCK ? f->height - y : BLOCK;
    struct surface_bounds b = EMPTY;
    for (uint32_t row = y; row < y + height; row++) {
        const struct surface_bounds run =
            bound_run(&layer->heights, (size_t)row * f->width + x, width);
        join(&b, &run);
    }
    // The map is largest at the pole: an angle is at most its distance there.
    const struct layer_geo middle = layer_geo_of(f, x + width / 2.0, y + height / 2.0);
    const double angle = BLOCK * hypot(f->texel_width, f->texel_height) / 2;
    const struct cap cap = cap_around(middle.latitude, middle.longitude, angle);
    for (int j = 0; j <= cap.rows; j++) {
        for (int i = 0; i <= cap.columns; i++) {
            join(&cells[cap_cell(&cap, i, j)], &b);
        }
    }
}

static void bound_layer(const struct terrain_layer *layer, struct surface_bounds *cells)
{
    const struct layer_frame *f = &layer->frame;
    for (uint32_t y = 0; y < f->height; y += f->pole == 0 ? 1 : BLOCK) {
        if (f->pole == 0) {
            bound_row(layer, y, cells);
            continue;
        }
        for (uint32_t x = 0; x < f->width; x += BLOCK) {
            bound_block(layer, x, y, cells);
        }
    }
}

// Beyond the range of a coarse level of a layer that is held in tiles, its finer texels reach: how
// far is not known before they are read. Peaks rise above the means of their surroundings by less
// than those differ among each other, nearly always; what is read later corrects it.
static const float UNSEEN_RANGE = 1;

// The cubic reaches two texels beyond a cell and overshoots a little: each cell widened by its
// neighbours and by that part of its range.
static struct surface_bounds widen(const struct surface_bounds *cells, int x, int y, bool is_tiled)
{
    struct surface_bounds b = EMPTY;
    for (int k = 0; k < 9; k++) {
        const int column = (x + k % 3 - 1 + COLUMNS) % COLUMNS;
        const int row = y + k / 3 - 1;
        const int inside = row < 0 ? 0 : row > ROWS - 1 ? ROWS - 1 : row;
        join(&b, &cells[inside * COLUMNS + column]);
    }
    const float slack = ((float)CUBIC_OVERSHOOT + (is_tiled ? UNSEEN_RANGE : 0)) * (b.max - b.min);
    return b.min <= b.max ? (struct surface_bounds){b.min - slack, b.max + slack} : EMPTY;
}

// Lays a layer over what is known: nowhere does it cover a cell for sure, so what was possible
// stays possible.
static void lay_over(double mode, const struct surface_bounds *layer, struct surface_bounds *cell)
{
    if (layer->min > layer->max) {
        return;
    }
    const struct surface_bounds below = *cell;
    const float ends[2] = {layer->min, layer->max};
    for (int i = 0; i < 2; i++) {
        const struct surface_bounds whole = {
            (float)blend_whole(mode, (double)below.min, (double)ends[i]),
            (float)blend_whole(mode, (double)below.max, (double)ends[i])};
        const struct surface_bounds sorted = {fminf(whole.min, whole.max),
                                              fmaxf(whole.min, whole.max)};
        join(cell, &sorted);
    }
}

// What the noise's map says, before layers are laid over it.
static void start_with_ground(struct surface *s)
{
    for (int i = 0; i < CELLS && s->is_invented; i++) {
        s->bounds[i] = make_bound_ground(s, i % COLUMNS, i / COLUMNS);
    }
}

// After the layers. Water lies over all that is below the sea.
static void add_octaves(struct surface *s)
{
    for (int i = 0; i < CELLS && noise_is_there(&s->noise); i++) {
        struct surface_bounds *b = &s->bounds[i];
        const struct noise_reach reach = make_bound_octaves(s, i % COLUMNS, i / COLUMNS);
        b->min += (float)reach.down_m;
        b->max += (float)reach.up_m;
        b->min = s->noise.desc.has_sea ? fmaxf(b->min, 0) : b->min;
        b->max = s->noise.desc.has_sea ? fmaxf(b->max, 0) : b->max;
    }
}

trl_result surface_find_bounds(struct surface *s)
{
    s->bounds = mem_alloc(s->ctx, CELLS, sizeof *s->bounds); // zeroed: sea level
    struct surface_bounds *cells = mem_alloc(s->ctx, CELLS, sizeof *cells);
    const trl_result result = s->bounds && cells ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        start_with_ground(s);
    }
    for (size_t k = 0; k < s->counts[SURFACE_ELEVATION] && result == TRL_OK; k++) {
        const struct terrain_layer *layer = &s->layers[SURFACE_ELEVATION][k];
        for (int i = 0; i < CELLS; i++) {
            cells[i] = EMPTY;
        }
        bound_layer(layer, cells);
        for (int i = 0; i < CELLS; i++) {
            struct surface_bounds wide =
                widen(cells, i % COLUMNS, i / COLUMNS, layer->tiles != NULL);
            if (layer->heights.has_bed && wide.min <= wide.max) {
                wide = (struct surface_bounds){fmaxf(wide.min, 0), fmaxf(wide.max, 0)};
            }
            lay_over(layer->mode, &wide, &s->bounds[i]);
        }
    }
    if (result == TRL_OK) {
        add_octaves(s);
    }
    for (int i = 0; i < CELLS && result == TRL_OK; i++) {
        s->min_altitude_m = fmin(s->min_altitude_m, (double)s->bounds[i].min);
        s->max_altitude_m = fmax(s->max_altitude_m, (double)s->bounds[i].max);
    }
    mem_free(s->ctx, cells);
    return result;
}

void surface_bound_rectangle(const struct layer_frame *f, const struct layer_rectangle *r,
                             struct vec3 *direction, double *angle_rad)
{
    const struct layer_geo middle =
        layer_geo_of(f, r->x + r->width / 2 - 0.5, r->y + r->height / 2 - 0.5);
    double chord = 0;
    *direction = vec3_from_lat_lon(middle.latitude, middle.longitude);
    // Nine of its places say how far it reaches; between them a parallel bends by less than 10 %.
    for (int i = 0; i < 9; i++) {
        const struct layer_geo g = layer_geo_of(f, r->x + r->width * (i % 3) / 2 - 0.5,
                                                r->y + r->height * (i / 3) / 2 - 0.5);
        const struct vec3 at = vec3_from_lat_lon(g.latitude, g.longitude);
        chord = fmax(chord, vec3_length(vec3_sub(at, *direction)));
    }
    *angle_rad = fmin(1.1 * 2 * asin(fmin(1, chord / 2)), SHARED_PI);
}

void surface_grow_bounds(struct surface *s, const struct layer_frame *frame,
                         const struct layer_rectangle *rectangle, float min_m, float max_m)
{
    struct vec3 d;
    double angle_rad;
    surface_bound_rectangle(frame, rectangle, &d, &angle_rad);
    const struct cap cap = cap_around(atan2(d.z, hypot(d.x, d.y)), atan2(d.y, d.x), angle_rad);
    const float slack = (float)CUBIC_OVERSHOOT * (max_m - min_m);
    const struct surface_bounds b = {min_m - slack, max_m + slack};
    for (int j = 0; j <= cap.rows; j++) {
        for (int i = 0; i <= cap.columns; i++) {
            join(&s->bounds[cap_cell(&cap, i, j)], &b);
        }
    }
    s->min_altitude_m = fmin(s->min_altitude_m, (double)b.min);
    s->max_altitude_m = fmax(s->max_altitude_m, (double)b.max);
}

struct surface_bounds surface_bounds_around(const struct surface *s, struct vec3 direction,
                                            double angle_rad)
{
    const struct cap cap = cap_around(atan2(direction.z, hypot(direction.x, direction.y)),
                                      atan2(direction.y, direction.x), angle_rad);
    struct surface_bounds b = EMPTY;
    for (int j = 0; j <= cap.rows; j++) {
        for (int i = 0; i <= cap.columns; i++) {
            join(&b, &s->bounds[cap_cell(&cap, i, j)]);
        }
    }
    return b;
}
