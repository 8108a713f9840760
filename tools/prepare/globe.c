// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Elevation and open water of the globe. The land map is right on land but vague within 30 m of sea
// level; ETOPO5 is right at sea but displaced on land; the mask of water is right but coarse. The
// coast is drawn where the land map crosses a height that depends on the mask, so that it has the
// land map's detail.
#include "prepare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    ETOPO_COLUMNS = 4320, // nodes from 0 E
    ETOPO_ROWS = 2161,    // nodes from the south pole
    ETOPO_OFFSET = 52552  // bytes of the netCDF-3 header and coordinates before the values
};
static const size_t CELLS = (size_t)GLOBE_WIDTH * GLOBE_HEIGHT;

enum { CELL_LAND = 0, CELL_INLAND_WATER = 1, CELL_OCEAN = 2 };

struct globe {
    const struct places *places;
    const struct picture *snow;
    struct land land;
    float *etopo;
    struct picture mask; // 255: water; or a colour picture to guess it from
    bool is_colour;
    uint8_t *cells;    // of the enumeration above
    uint8_t *distance; // thirds of a cell to the coast of the ocean, at most 255
    int16_t *elevation;
    uint8_t *water;
};

static trl_result read_big_endian_floats(const struct places *places, const char *relative,
                                         long offset, size_t count, float *out)
{
    char *path = source_path(places, relative);
    if (!path) {
        return TRL_ERROR_MEMORY;
    }
    FILE *file = fopen(path, "rb");
    const bool is_read =
        file && fseek(file, offset, SEEK_SET) == 0 && fread(out, sizeof *out, count, file) == count;
    if (file) {
        fclose(file);
    }
    trl_result result = TRL_OK;
    if (!is_read) {
        result = trl_fail(places->ctx, TRL_ERROR_IO, TRL_LOG_ITEM_FILE_READ,
                          "cannot read %s: missing or ends early", path);
    }
    for (size_t i = 0; i < count && is_read; i++) {
        uint32_t word;
        memcpy(&word, out + i, sizeof word);
        word = __builtin_bswap32(word);
        memcpy(out + i, &word, sizeof word);
    }
    mem_free(places->ctx, path);
    return result;
}

// Metres of ETOPO5 at a cell's centre, bilinear between its nodes.
static double sea_floor(const float *etopo, int column, int row)
{
    const double east =
        fmod((column + 0.5) / 30 + 180, 360) * 12; // in nodes; 30 cells, 12 nodes a degree
    const double north = (180 - (row + 0.5) / 30) * 12;
    const int x = (int)east;
    const int y = (int)north;
    const double fx = east - x;
    const double fy = north - y;
    const float *south = etopo + (size_t)y * ETOPO_COLUMNS;
    const float *above = south + (y + 1 < ETOPO_ROWS ? ETOPO_COLUMNS : 0);
    const int next = (x + 1) % ETOPO_COLUMNS;
    return (1 - fy) * ((1 - fx) * (double)south[x] + fx * (double)south[next]) +
           fy * ((1 - fx) * (double)above[x] + fx * (double)above[next]);
}

// 0 to 1: how much the picture says that there is water. From colour, water is what is bluer than
// red and green together; the dark green of forests and the white of ice are not.
static double water_likelihood(const struct globe *globe, int column, int row)
{
    const double u = (column + 0.5) / GLOBE_WIDTH;
    const double v = (row + 0.5) / GLOBE_HEIGHT;
    if (!globe->is_colour) {
        return picture_sample(&globe->mask, 0, u, v) / 255;
    }
    const double red = picture_sample(&globe->mask, 0, u, v);
    const double green = picture_sample(&globe->mask, 1, u, v);
    const double blue = picture_sample(&globe->mask, 2, u, v);
    return fmin(1, fmax(0, (blue - (red + green) / 2) / 30));
}

// The grey below which a cell is water. With the picture undecided it is that of 13 m below the
// sea, in the middle of the land map's uncertainty; sure land must lie 90 m below the sea to be
// taken for it (a fjord the picture does not show), sure sea 50 m above (an island).
static const double GREY_SURE_LAND = 76;
static const double GREY_SURE_SEA = 110;

static void mark_water(struct globe *globe)
{
#pragma omp parallel for schedule(dynamic, 16)
    for (int row = 0; row < GLOBE_HEIGHT; row++) {
        for (int column = 0; column < GLOBE_WIDTH; column++) {
            const size_t i = (size_t)row * GLOBE_WIDTH + column;
            const double likely = water_likelihood(globe, column, row);
            const double limit = GREY_SURE_LAND + likely * (GREY_SURE_SEA - GREY_SURE_LAND);
            globe->cells[i] = globe->land.grey[i] < limit ? CELL_INLAND_WATER : CELL_LAND;
            globe->water[i] = (uint8_t)lrint(255 * fmin(1, fmax(0, (likely - 0.4) / 0.4)));
        }
    }
}

// Every sea at sea level, by one place in it: straits narrower than a cell part them.
static const struct {
    double lat_deg, lon_deg;
} OCEANS[] = {{0, -30}, {43, 34},  {40.7, 28}, {46, 36.5}, {57, 19}, {26.5, 52},
              {20, 38}, {40, 4},   {61.5, 19}, {60, -85},  {75, 0},  {44, 15},
              {0, 160}, {-20, 80}, {40, 135},  {28, 50.2}};

// Cells yet to look at, as indices.
struct stack {
    uint32_t *items;
    size_t count;
};

static void push_water(struct globe *globe, struct stack *stack, int column, int row)
{
    if (row < 0 || row >= GLOBE_HEIGHT) {
        return;
    }
    const int wrapped = (column + GLOBE_WIDTH) % GLOBE_WIDTH;
    const size_t i = (size_t)row * GLOBE_WIDTH + wrapped;
    if (globe->cells[i] == CELL_INLAND_WATER) {
        globe->cells[i] = CELL_OCEAN;
        stack->items[stack->count++] = (uint32_t)i; // each cell once, so the stack holds them all
    }
}

static trl_result flood_oceans(struct globe *globe)
{
    struct stack stack = {mem_alloc(globe->places->ctx, CELLS, sizeof(uint32_t)), 0};
    if (!stack.items) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < sizeof OCEANS / sizeof OCEANS[0]; i++) {
        push_water(globe, &stack, (int)((OCEANS[i].lon_deg + 180) * 30),
                   (int)((90 - OCEANS[i].lat_deg) * 30));
    }
    while (stack.count > 0) {
        const uint32_t i = stack.items[--stack.count];
        const int column = (int)(i % GLOBE_WIDTH);
        const int row = (int)(i / GLOBE_WIDTH);
        for (int dy = -1; dy <= 1; dy++) {
            for (int dx = -1; dx <= 1; dx++) {
                push_water(globe, &stack, column + dx, row + dy);
            }
        }
    }
    mem_free(globe->places->ctx, stack.items);
    return TRL_OK;
}

// One look of the distance transform at a neighbour: a cell of the other kind is a step away, one
// of the same kind a step further than itself.
static void look_at(const struct globe *globe, size_t i, int column, int row, int step)
{
    if (row < 0 || row >= GLOBE_HEIGHT) {
        return;
    }
    const size_t n = (size_t)row * GLOBE_WIDTH + (column + GLOBE_WIDTH) % GLOBE_WIDTH;
    const bool is_other = (globe->cells[n] == CELL_OCEAN) != (globe->cells[i] == CELL_OCEAN);
    const int distance = is_other ? step : globe->distance[n] + step;
    if (distance < globe->distance[i]) {
        globe->distance[i] = (uint8_t)distance;
    }
}

// Chamfer distances in thirds of a cell (3 along, 4 across), from the north-west and back.
static void measure_distances(struct globe *globe)
{
    memset(globe->distance, 255, CELLS);
    for (int pass = 0; pass < 2; pass++) {
        const int back = pass == 0 ? -1 : 1;
        for (size_t k = 0; k < CELLS; k++) {
            const size_t i = pass == 0 ? k : CELLS - 1 - k;
            const int column = (int)(i % GLOBE_WIDTH);
            const int row = (int)(i / GLOBE_WIDTH);
            look_at(globe, i, column + back, row, 3);
            look_at(globe, i, column - 1, row + back, 4);
            look_at(globe, i, column, row + back, 3);
            look_at(globe, i, column + 1, row + back, 4);
        }
    }
}

static double smoothstep(double edge0, double edge1, double x)
{
    const double t = fmin(1, fmax(0, (x - edge0) / (edge1 - edge0)));
    return t * t * (3 - 2 * t);
}

// A shelf that falls 6 m a cell from the coast, until ETOPO5 can be trusted not to mean the land.
static double ocean_metres(double floor_m, double cells_from_coast)
{
    const double shelf = -2 - 6 * cells_from_coast;
    return shelf + smoothstep(0, 6, cells_from_coast) * (fmin(floor_m, -4) - shelf);
}

// Nearer to the ocean than this no dry land is deep below it: there it is the map that is wrong,
// mostly on ice-covered coasts.
static const double LAND_CELLS_FROM_COAST = 15;

// The land map cannot tell the Netherlands, an ice shelf or the Caspian's shore from a shallow sea:
// what it puts within 60 m below the sea is pressed into the 20 m above it. What is deeper (the
// Dead Sea, Death Valley) is so indeed; between -60 and -200 m the two meet.
static double land_metres(double metres, double cells_from_coast)
{
    if (metres > 20) {
        return metres;
    }
    if (metres <= -60 && cells_from_coast < LAND_CELLS_FROM_COAST) {
        return 1;
    }
    if (metres > -60) {
        return 1 + 19 * (metres + 60) / 80;
    }
    return metres > -200 ? 1 + 201 * (metres + 60) / 140 : metres;
}

// Lakes of the coarse mask are kept away from the coast, where it spills over the land.
static const double LAKE_CELLS_FROM_COAST = 9;

static void merge_row(struct globe *globe, int row)
{
    for (int column = 0; column < GLOBE_WIDTH; column++) {
        const size_t i = (size_t)row * GLOBE_WIDTH + column;
        const double cells = globe->distance[i] / 3.0;
        double metres = (double)globe->land.metres[i];
        if (globe->cells[i] == CELL_OCEAN) {
            metres = ocean_metres(sea_floor(globe->etopo, column, row), cells);
        } else {
            metres = land_metres(metres, cells);
        }
        globe->elevation[i] = (int16_t)lrint(metres);
        if (globe->cells[i] != CELL_LAND) {
            globe->water[i] = 255;
        } else if (cells < LAKE_CELLS_FROM_COAST) {
            globe->water[i] = 0;
        }
    }
}

static trl_result write_globe(const struct globe *globe)
{
    struct geotiff g = {.name = "elevation.tif",
                        .width = GLOBE_WIDTH,
                        .height = GLOBE_HEIGHT,
                        .bands = 1,
                        .kind = PIXEL_INT16,
                        .west_deg = -180,
                        .north_deg = 90,
                        .pixel_width_deg = 360.0 / GLOBE_WIDTH,
                        .pixel_height_deg = 180.0 / GLOBE_HEIGHT,
                        .pixels = globe->elevation,
                        .unit = "metre"};
    const struct globe_values heights = {GLOBE_WIDTH, GLOBE_HEIGHT, 1, globe->elevation, NULL};
    trl_result result = geotiff_write(globe->places, &g);
    if (result == TRL_OK) {
        result = polar_prepare(globe->places, "earth", "elevation", &heights);
    }
    if (result == TRL_OK) {
        g.name = "water.tif";
        g.kind = PIXEL_UINT8;
        g.pixels = globe->water;
        g.unit = NULL;
        result = geotiff_write(globe->places, &g);
    }
    if (result == TRL_OK) {
        result = snow_write(globe->places, globe->snow, globe->elevation);
    }
    return result;
}

static trl_result read_sources(struct globe *globe)
{
    const struct places *places = globe->places;
    globe->is_colour = !source_exists(places, WATER_COARSE);
    trl_result result =
        picture_read(places, globe->is_colour ? BLUE_MARBLE_SMALL : WATER_COARSE, &globe->mask);
    if (result == TRL_OK) {
        result = read_big_endian_floats(places, ETOPO5, ETOPO_OFFSET,
                                        (size_t)ETOPO_COLUMNS * ETOPO_ROWS, globe->etopo);
    }
    return result == TRL_OK ? land_read(places, &globe->land) : result;
}

static trl_result merge_globe(struct globe *globe)
{
    mark_water(globe);
    trl_result result = flood_oceans(globe);
    if (result != TRL_OK) {
        return result;
    }
    measure_distances(globe);
#pragma omp parallel for schedule(dynamic, 16)
    for (int row = 0; row < GLOBE_HEIGHT; row++) {
        merge_row(globe, row);
    }
    // Distances are not needed any more.
    for (size_t i = 0; i < CELLS; i++) {
        globe->distance[i] = globe->cells[i] == CELL_OCEAN;
    }
    result = lakes_make_level(globe->places, globe->distance, globe->elevation, globe->water);
    return result == TRL_OK ? write_globe(globe) : result;
}

trl_result earth_prepare_globe(const struct places *places, const struct picture *snow)
{
    const trl_context *ctx = places->ctx;
    struct globe globe = {.places = places, .snow = snow};
    globe.etopo = mem_alloc(ctx, (size_t)ETOPO_COLUMNS * ETOPO_ROWS, sizeof(float));
    globe.cells = mem_alloc(ctx, CELLS, 1);
    globe.distance = mem_alloc(ctx, CELLS, 1);
    globe.elevation = mem_alloc(ctx, CELLS, sizeof(int16_t));
    globe.water = mem_alloc(ctx, CELLS, 1);
    trl_result result =
        globe.etopo && globe.cells && globe.distance && globe.elevation && globe.water
            ? read_sources(&globe)
            : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = merge_globe(&globe);
    }
    mem_free(ctx, globe.etopo);
    mem_free(ctx, globe.cells);
    mem_free(ctx, globe.distance);
    mem_free(ctx, globe.elevation);
    mem_free(ctx, globe.water);
    picture_finish(places, &globe.mask);
    land_finish(places, &globe.land);
    return result;
}

enum { COLORADO_COLUMNS = 2401, COLORADO_ROWS = 1201, COLORADO_OFFSET = 628 };
static const double METRES_PER_FOOT = 0.3048;
static const float COLORADO_NODATA = -999; // _FillValue of the file

// Rows come south first; the values are nodes at multiples of 3 seconds, so that the borders lie
// half a cell outside.
static void turn_and_scale(float *values)
{
    for (size_t row = 0; row < COLORADO_ROWS / 2; row++) {
        float *south = values + row * COLORADO_COLUMNS;
        float *north = values + (COLORADO_ROWS - 1 - row) * COLORADO_COLUMNS;
        for (size_t i = 0; i < COLORADO_COLUMNS; i++) {
            const float kept = south[i];
            south[i] = north[i];
            north[i] = kept;
        }
    }
    for (size_t i = 0; i < (size_t)COLORADO_COLUMNS * COLORADO_ROWS; i++) {
        const float feet = values[i];
        values[i] = feet > COLORADO_NODATA ? (float)((double)feet * METRES_PER_FOOT) : NAN;
    }
}

trl_result earth_prepare_colorado(const struct places *places)
{
    const size_t count = (size_t)COLORADO_COLUMNS * COLORADO_ROWS;
    float *values = mem_alloc(places->ctx, count, sizeof *values);
    trl_result result =
        values ? read_big_endian_floats(places, TRINIDAD, COLORADO_OFFSET, count, values)
               : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        turn_and_scale(values);
        const double cell = 1.0 / 1200;
        const struct geotiff g = {.name = "colorado.tif",
                                  .width = COLORADO_COLUMNS,
                                  .height = COLORADO_ROWS,
                                  .bands = 1,
                                  .kind = PIXEL_FLOAT,
                                  .west_deg = -106 - cell / 2,
                                  .north_deg = 38 + cell / 2,
                                  .pixel_width_deg = cell,
                                  .pixel_height_deg = cell,
                                  .pixels = values,
                                  .unit = "metre"};
        result = geotiff_write(places, &g);
    }
    mem_free(places->ctx, values);
    return result;
}
