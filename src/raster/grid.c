// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/grid.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

trl_result raster_grid_load(const struct raster *raster, uint32_t band, uint32_t max_side,
                            struct raster_grid *out)
{
    const struct raster_window window = raster_window_whole(raster, max_side);
    if (raster->plane.pole != 0) {
        *out = (struct raster_grid){0};
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: a map about a pole has no columns of longitude", raster->path);
    }
    *out = (struct raster_grid){
        .ctx = raster->ctx,
        .width = window.out_width,
        .height = window.out_height,
        .west_deg = raster->west_deg,
        .north_deg = raster->north_deg,
        .pixel_width_deg = raster->pixel_width_deg * raster->width / window.out_width,
        .pixel_height_deg = raster->pixel_height_deg * raster->height / window.out_height,
        .is_whole_circle = raster->is_whole_circle,
        // Half a pixel: what lies between the last row's centres and the pole must be bridged.
        .touches_north = raster->north_deg > 90 - raster->pixel_height_deg / 2,
        .touches_south = raster->south_deg < -90 + raster->pixel_height_deg / 2,
        .values =
            mem_alloc(raster->ctx, (size_t)window.out_width * window.out_height, sizeof(float))};
    const trl_result result =
        out->values ? raster_read_float(raster, &window, band, out->values) : TRL_ERROR_MEMORY;
    if (result != TRL_OK) {
        raster_grid_finish(out);
    }
    return result;
}

void raster_grid_finish(struct raster_grid *grid)
{
    if (grid->values) {
        mem_free(grid->ctx, grid->values);
    }
    *grid = (struct raster_grid){0};
}

static int64_t clamp_index(int64_t i, int64_t count)
{
    return i < 0 ? 0 : i >= count ? count - 1 : i;
}

// The value at a column and row that may lie one beyond a border: around the circle, over the pole
// to the opposite meridian, or the border's own value where neither applies.
static double fetch(const struct raster_grid *grid, int64_t column, int64_t row)
{
    const int64_t width = grid->width;
    const int64_t height = grid->height;
    const bool crosses_pole =
        (row < 0 && grid->touches_north) || (row >= height && grid->touches_south);
    if (crosses_pole && grid->is_whole_circle && width % 2 == 0) {
        row = row < 0 ? -1 - row : 2 * height - 1 - row;
        column += width / 2;
    }
    row = clamp_index(row, height);
    column =
        grid->is_whole_circle ? ((column % width) + width) % width : clamp_index(column, width);
    return (double)grid->values[row * width + column];
}

// Replaces corners without data by the mean of the others; false when there are none.
static bool fill_corners(double corner[4])
{
    double sum = 0;
    int count = 0;
    for (int i = 0; i < 4; i++) {
        if (!isnan(corner[i])) {
            sum += corner[i];
            count++;
        }
    }
    for (int i = 0; i < 4 && count > 0; i++) {
        corner[i] = isnan(corner[i]) ? sum / count : corner[i];
    }
    return count > 0;
}

struct raster_sample raster_grid_sample(const struct raster_grid *grid, double latitude_rad,
                                        double longitude_rad)
{
    const struct raster_sample outside = {0};
    const double latitude = latitude_rad * 180 / PI;
    double east = longitude_rad * 180 / PI - grid->west_deg;
    east -= 360 * floor(east / 360); // [0, 360) from the west border
    const double x = east / grid->pixel_width_deg;
    const double y = (grid->north_deg - latitude) / grid->pixel_height_deg;
    // Slack for rounding: a place on the border belongs to the grid.
    const bool is_inside_y = y >= -1e-9 * grid->height && y <= grid->height * (1 + 1e-9);
    const bool is_inside_x = grid->is_whole_circle || x <= grid->width * (1 + 1e-9);
    if (!is_inside_x || !is_inside_y || !isfinite(x + y)) {
        return outside;
    }
    const double left = floor(x - 0.5);
    const double top = floor(y - 0.5);
    const double fx = x - 0.5 - left;
    const double fy = y - 0.5 - top;
    const int64_t column = (int64_t)left;
    const int64_t row = (int64_t)top;
    double c[4] = {fetch(grid, column, row), fetch(grid, column + 1, row),
                   fetch(grid, column, row + 1), fetch(grid, column + 1, row + 1)};
    if (!fill_corners(c)) {
        return outside;
    }
    const double north = c[0] + fx * (c[1] - c[0]);
    const double south = c[2] + fx * (c[3] - c[2]);
    const double per_column = (1 - fy) * (c[1] - c[0]) + fy * (c[3] - c[2]);
    return (struct raster_sample){
        .is_valid = true,
        .value = north + fy * (south - north),
        .per_latitude_rad = -(south - north) / (grid->pixel_height_deg * PI / 180),
        .per_longitude_rad = per_column / (grid->pixel_width_deg * PI / 180)};
}

void raster_grid_range(const struct raster_grid *grid, float *min, float *max)
{
    const size_t count = (size_t)grid->width * grid->height;
    float low = INFINITY;
    float high = -INFINITY;
#pragma omp parallel for reduction(min : low) reduction(max : high)
    for (size_t i = 0; i < count; i++) {
        const float v = grid->values[i];
        low = v < low ? v : low; // false for NaN
        high = v > high ? v : high;
    }
    *min = low <= high ? low : 0;
    *max = low <= high ? high : 0;
}
