// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/frame.h"

#include "shared/projection.glsl"

#include <math.h>

static const double UNBOUNDED = 9; // radians: more than any distance on a sphere

static double radians(double degrees)
{
    return degrees * (SHARED_PI / 180);
}

static double wrap(double longitude)
{
    return longitude - 2 * SHARED_PI * floor(longitude / (2 * SHARED_PI) + 0.5);
}

static void place_equirectangular(const struct raster *raster, struct layer_frame *f)
{
    const double width = raster->pixel_width_deg * raster->width;
    const double height = raster->pixel_height_deg * raster->height;
    f->centre_x = radians(raster->west_deg + width / 2);
    f->centre_y = radians(raster->north_deg - height / 2);
    f->half_width = radians(width / 2);
    f->half_height = radians(height / 2);
    f->is_whole_circle = raster->is_whole_circle;
    // Half a pixel: rasters whose nodes lie on the poles, and those that end just before.
    f->touches_north = raster->north_deg > 90 - raster->pixel_height_deg / 2;
    f->touches_south = raster->south_deg < -90 + raster->pixel_height_deg / 2;
}

static void place_stereographic(const struct raster_plane *plane, const struct raster *raster,
                                struct layer_frame *f)
{
    f->half_width = plane->pixel_width * raster->width / 2;
    f->half_height = plane->pixel_height * raster->height / 2;
    f->centre_x = plane->left + f->half_width;
    f->centre_y = plane->top - f->half_height;
    f->pole = plane->pole;
    f->longitude_0 = radians(plane->longitude_deg);
    f->e2 = plane->e2;
}

// tan(theta / 2) is half the distance from the pole over the ellipsoid's factor, which depends on
// the latitude that is sought: three steps leave 1e-10 of Earth's 0.3 %: a millimetre.
static double find_angle_from_pole(const struct layer_frame *f, double distance)
{
    double tangent = distance / 2;
    for (int i = 0; i < 3 && f->e2 > 0; i++) {
        const double sine = (1 - tangent * tangent) / (1 + tangent * tangent);
        tangent = distance / 2 / (1 + projection_ellipsoid(sine - 1, sine, 1, f->e2));
    }
    return 2 * atan(tangent);
}

// Corners and middles of the sides are the farthest from the middle, or nearly: 1 % more is ample.
static void bound_frame(struct layer_frame *f)
{
    const struct layer_geo middle = layer_geo_of(f, f->width / 2.0 - 0.5, f->height / 2.0 - 0.5);
    f->direction = vec3_from_lat_lon(middle.latitude, middle.longitude);
    f->reach_rad = 0;
    for (int i = 0; i < 9; i++) {
        const struct layer_geo g =
            layer_geo_of(f, i % 3 * 0.5 * f->width - 0.5, i / 3 * 0.5 * f->height - 0.5);
        const struct vec3 at = vec3_from_lat_lon(g.latitude, g.longitude);
        const double chord = vec3_length(vec3_sub(at, f->direction));
        f->reach_rad = fmax(f->reach_rad, 1.01 * 2 * asin(fmin(1, chord / 2)));
    }
    if (f->pole != 0) {
        const double farthest =
            hypot(fabs(f->centre_x) + f->half_width, fabs(f->centre_y) + f->half_height);
        f->least_latitude = SHARED_PI / 2 - 1.001 * find_angle_from_pole(f, farthest);
    }
    if (f->pole == 0 && f->half_width > 1) {
        f->reach_rad = SHARED_PI; // of wide ones the corners are not the farthest
    }
}

struct layer_frame layer_frame_of(const struct raster *raster, uint32_t width, uint32_t height,
                                  double feather)
{
    struct layer_frame f = {.width = width, .height = height, .feather = feather};
    if (raster->plane.pole != 0) {
        place_stereographic(&raster->plane, raster, &f);
    } else {
        place_equirectangular(raster, &f);
    }
    f.texel_width = 2 * f.half_width / width;
    f.texel_height = 2 * f.half_height / height;
    bound_frame(&f);
    return f;
}

// 0 at a border, 1 from the feather inward.
static double weigh_border(double inside, double feather)
{
    if (inside < 0) {
        return 0;
    }
    const double t = feather > 0 ? fmin(inside / feather, 1) : 1;
    return t * t * (3 - 2 * t);
}

// From the plane of the formulas, whose x runs along the meridian `longitude`, to the map.
static MapOffset turn_plane(const struct layer_frame *f, MapOffset m, double longitude)
{
    const double s = sin(longitude - f->longitude_0);
    const double c = cos(longitude - f->longitude_0);
    return (MapOffset){m.x * s + m.y * c, -f->pole * (m.x * c - m.y * s)};
}

// Map coordinates, seen from the pole or from longitude and latitude 0.
static MapOffset project(const struct layer_frame *f, double latitude, double longitude)
{
    if (f->pole == 0) {
        return (MapOffset){longitude, latitude};
    }
    const AxisOffset o = projection_axis_offset(f->pole, 0, longitude - f->longitude_0,
                                                latitude - f->pole * SHARED_PI / 2);
    return turn_plane(f, projection_stereographic(o, f->pole, 0, f->pole, f->e2, 1),
                      f->longitude_0);
}

struct layer_place layer_locate(const struct layer_frame *f, double latitude, double longitude)
{
    const MapOffset at = project(f, latitude, longitude);
    const double x = f->pole == 0 ? wrap(at.x - f->centre_x) : at.x - f->centre_x;
    const double y = at.y - f->centre_y;
    double inside = f->is_whole_circle ? UNBOUNDED : f->half_width - fabs(x);
    inside = fmin(inside, f->touches_north ? UNBOUNDED : f->half_height - y);
    inside = fmin(inside, f->touches_south ? UNBOUNDED : f->half_height + y);
    return (struct layer_place){.x = (x + f->half_width) / f->texel_width - 0.5,
                                .y = (f->half_height - y) / f->texel_height - 0.5,
                                .weight = weigh_border(inside, f->feather)};
}

struct layer_geo layer_geo_of(const struct layer_frame *f, double column, double row)
{
    const double x = f->centre_x - f->half_width + (column + 0.5) * f->texel_width;
    const double y = f->centre_y + f->half_height - (row + 0.5) * f->texel_height;
    if (f->pole == 0) {
        return (struct layer_geo){y, x};
    }
    return (struct layer_geo){f->pole * (SHARED_PI / 2 - find_angle_from_pole(f, hypot(x, y))),
                              f->longitude_0 + (x == 0 && y == 0 ? 0 : atan2(x, -f->pole * y))};
}

size_t layer_texel_index(const struct layer_frame *f, int64_t x, int64_t y)
{
    const int64_t width = f->width;
    const int64_t height = f->height;
    if (((y < 0 && f->touches_north) || (y >= height && f->touches_south)) && f->is_whole_circle) {
        y = y < 0 ? -1 - y : 2 * height - 1 - y;
        x += width / 2;
    }
    y = y < 0 ? 0 : y >= height ? height - 1 : y;
    if (f->is_whole_circle) {
        x = ((x % width) + width) % width;
    }
    x = x < 0 ? 0 : x >= width ? width - 1 : x;
    return (size_t)(y * width + x);
}

struct layer_view layer_view_from(const struct layer_frame *f, double latitude, double longitude)
{
    const MapOffset at = project(f, latitude, longitude);
    const double x = at.x - f->centre_x;
    const double sine = f->pole * sin(latitude);
    const double factor = 1 + projection_ellipsoid(sine - 1, sine, 1, f->e2);
    return (struct layer_view){.place = {f->pole == 0 ? wrap(x) : x, at.y - f->centre_y,
                                         0.5 / f->half_width, 0.5 / f->half_height},
                               .shape = {f->is_whole_circle ? UNBOUNDED : f->half_width,
                                         f->touches_north ? UNBOUNDED : f->half_height,
                                         f->touches_south ? UNBOUNDED : f->half_height,
                                         1 / fmax(f->feather, 1e-9)},
                               .turn = {sin(longitude - f->longitude_0),
                                        cos(longitude - f->longitude_0), f->pole * factor, f->e2}};
}
