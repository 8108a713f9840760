// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What a raster is warped to: longitude and latitude, with the middle of its longitudes where it
// lies across the antimeridian, so that it is not cut in two at the borders of a mostly empty
// globe; or a plane about the pole, where meridians would run together. PROJ is asked where a net
// of the raster's places lies.
#include "raster/warp_target.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A raster about a pole is warped to a plane when it ends before this latitude, beyond the equator.
static const double FARTHEST_DEG = -5;
// One beside a pole, when all of it is nearer than this and some nearer than the other.
static const double NEAR_DEG = 60, NEAREST_DEG = 80;
// From here on a raster is taken for one that goes around.
static const double WHOLE_CIRCLE_DEG = 350;

// Places to a side: of a raster around the globe two are nearer than what it may lack.
enum { NET = 65 };

struct coverage {
    double west_deg, east_deg;
    double south_deg, north_deg;
    bool has_north_pole, has_south_pole;
};

static OGRCoordinateTransformationH make_transformation(OGRSpatialReferenceH from,
                                                        OGRSpatialReferenceH to)
{
    OSRSetAxisMappingStrategy(from, OAMS_TRADITIONAL_GIS_ORDER);
    OSRSetAxisMappingStrategy(to, OAMS_TRADITIONAL_GIS_ORDER);
    return OCTNewCoordinateTransformation(from, to);
}

// Of the net's places those that lie on the globe: their longitudes and latitudes.
static size_t find_places(GDALDatasetH dataset, OGRCoordinateTransformationH to_degrees,
                          double places[NET * NET][2])
{
    double t[6];
    GDALGetGeoTransform(dataset, t);
    const double step_x = GDALGetRasterXSize(dataset) / (NET - 1.0);
    const double step_y = GDALGetRasterYSize(dataset) / (NET - 1.0);
    size_t count = 0;
    for (int i = 0; i < NET * NET; i++) {
        const double column = i % NET * step_x, row = i / NET * step_y;
        double x = t[0] + t[1] * column + t[2] * row;
        double y = t[3] + t[4] * column + t[5] * row;
        if (OCTTransform(to_degrees, 1, &x, &y, NULL) && isfinite(x) && isfinite(y)) {
            places[count][0] = x;
            places[count++][1] = y;
        }
    }
    return count;
}

static bool holds(GDALDatasetH dataset, OGRCoordinateTransformationH from_degrees, double latitude)
{
    double t[6], inverse[6], x = 0, y = latitude;
    if (!OCTTransform(from_degrees, 1, &x, &y, NULL) || !isfinite(x) || !isfinite(y) ||
        GDALGetGeoTransform(dataset, t) != CE_None || !GDALInvGeoTransform(t, inverse)) {
        return false;
    }
    double column, row;
    GDALApplyGeoTransform(inverse, x, y, &column, &row);
    return column >= 0 && column <= GDALGetRasterXSize(dataset) && row >= 0 &&
           row <= GDALGetRasterYSize(dataset);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// From the east side of the widest gap between longitudes to its west side; sorts `places`.
static struct coverage cover_places(double places[NET * NET][2], size_t count)
{
    struct coverage c = {.south_deg = 90, .north_deg = -90};
    for (size_t i = 0; i < count; i++) {
        places[i][0] -= 360 * floor(places[i][0] / 360);
        c.south_deg = fmin(c.south_deg, places[i][1]);
        c.north_deg = fmax(c.north_deg, places[i][1]);
    }
    qsort(places, count, sizeof *places, compare);
    double widest = -1;
    for (size_t i = 0; i < count; i++) {
        const double next = i + 1 < count ? places[i + 1][0] : places[0][0] + 360;
        if (next - places[i][0] > widest) {
            widest = next - places[i][0];
            c.west_deg = next;
            c.east_deg = places[i][0] + 360;
        }
    }
    const double turns = 360 * floor((c.west_deg + 180) / 360); // the west in [-180, 180)
    c.west_deg -= turns;
    c.east_deg -= turns;
    return c;
}

static bool find_coverage(GDALDatasetH dataset, OGRSpatialReferenceH degrees, struct coverage *out)
{
    const OGRSpatialReferenceH srs = OSRClone(GDALGetSpatialRef(dataset));
    const OGRCoordinateTransformationH inverse = make_transformation(srs, degrees);
    const OGRCoordinateTransformationH forward = make_transformation(degrees, srs);
    double places[NET * NET][2];
    const size_t count = inverse ? find_places(dataset, inverse, places) : 0;
    *out = cover_places(places, count);
    out->has_north_pole = forward && holds(dataset, forward, 90);
    out->has_south_pole = forward && holds(dataset, forward, -90);
    if (inverse) {
        OCTDestroyCoordinateTransformation(inverse);
    }
    if (forward) {
        OCTDestroyCoordinateTransformation(forward);
    }
    OSRDestroySpatialReference(srs);
    return count > 0;
}

// 1 or -1 where the raster is better seen on a plane about that pole, else 0.
static double choose_pole(const struct coverage *c)
{
    const bool is_north = c->south_deg + c->north_deg > 0;
    const double far = is_north ? c->south_deg : -c->north_deg;
    const double near = is_north ? c->north_deg : -c->south_deg;
    const bool has_pole = is_north ? c->has_north_pole : c->has_south_pole;
    const bool has_other = is_north ? c->has_south_pole : c->has_north_pole;
    const bool is_about = has_pole && !has_other && far > FARTHEST_DEG;
    const bool is_beside = far > NEAR_DEG && near > NEAREST_DEG;
    return is_about || is_beside ? (is_north ? 1 : -1) : 0;
}

// What GDAL needs to know to count longitudes up to 180 degrees from another than 0.
static char *set_middle(const char *wkt, double middle_deg)
{
    const size_t length = strlen(wkt);
    char *out = CPLMalloc(length + 64);
    memcpy(out, wkt, length + 1);
    char *end = strrchr(out, ']');
    if (end) {
        snprintf(end, 64, ",EXTENSION[\"CENTER_LONG\",\"%.0f\"]]", middle_deg);
    }
    return out;
}

static char *plane_about(OGRSpatialReferenceH degrees, double pole)
{
    const OGRSpatialReferenceH plane = OSRClone(degrees);
    char *wkt = NULL;
    if (OSRSetPS(plane, 90 * pole, 0, 1, 0, 0) == OGRERR_NONE) {
        OSRExportToWkt(plane, &wkt);
    }
    OSRDestroySpatialReference(plane);
    return wkt;
}

void warp_target_finish(struct warp_target *target)
{
    CPLFree(target->wkt);
    *target = (struct warp_target){0};
}

bool warp_target_choose(GDALDatasetH dataset, OGRSpatialReferenceH degrees, struct warp_target *out)
{
    *out = (struct warp_target){0};
    struct coverage c;
    if (OSRExportToWkt(degrees, &out->wkt) != OGRERR_NONE) {
        return false;
    }
    CPLPushErrorHandler(CPLQuietErrorHandler); // places that are not on the globe are no errors
    const bool is_placed = find_coverage(dataset, degrees, &c);
    CPLErrorReset();
    CPLPopErrorHandler();
    if (!is_placed) {
        return true; // warping will say why
    }
    const bool is_geographic = OSRIsGeographic(GDALGetSpatialRef(dataset));
    const double pole = is_geographic ? 0 : choose_pole(&c);
    char *other = NULL;
    if (pole != 0) {
        other = plane_about(degrees, pole);
    } else if (c.has_north_pole || c.has_south_pole || c.east_deg - c.west_deg > WHOLE_CIRCLE_DEG) {
        out->is_whole_circle = true;
        out->has_north_pole = c.has_north_pole;
        out->has_south_pole = c.has_south_pole;
    } else if (c.east_deg > 180) {
        other = set_middle(out->wkt, (c.west_deg + c.east_deg) / 2);
    }
    if (other) {
        CPLFree(out->wkt);
        out->wkt = other;
    }
    return true;
}
