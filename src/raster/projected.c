// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Projected systems that are drawn as they are. Names and parameters of projections come in a dozen
// dialects, so nothing reads them: PROJ is asked where some pixels lie, and what agrees everywhere
// with one of the two formulas is that projection.
#include "raster/georeference.h"

#include "shared/projection.glsl"

#include <gdal.h>
#include <ogr_srs_api.h>

// How far from PROJ's answer a pixel may be.
static const double TOLERANCE_PIXELS = 0.01;
static const double DEGREE = SHARED_PI / 180;
// Farther from its pole a stereographic map is all distortion: such a file is warped.
static const double LARGEST_ANGLE_DEG = 100;

struct system {
    OGRCoordinateTransformationH forward, inverse; // from degrees, to degrees
    double e2;
};

static void system_finish(struct system *s)
{
    if (s->forward) {
        OCTDestroyCoordinateTransformation(s->forward);
    }
    if (s->inverse) {
        OCTDestroyCoordinateTransformation(s->inverse);
    }
}

static bool system_init(OGRSpatialReferenceH srs, struct system *out)
{
    *out = (struct system){0};
    const OGRSpatialReferenceH from = OSRClone(srs);
    const OGRSpatialReferenceH to = OSRCloneGeogCS(srs);
    if (from && to) {
        OSRSetAxisMappingStrategy(from, OAMS_TRADITIONAL_GIS_ORDER);
        OSRSetAxisMappingStrategy(to, OAMS_TRADITIONAL_GIS_ORDER);
        OGRErr error = OGRERR_NONE;
        const double inverse_flattening = OSRGetInvFlattening(srs, &error);
        const double f = inverse_flattening > 1 ? 1 / inverse_flattening : 0;
        out->e2 = f * (2 - f);
        out->forward = OCTNewCoordinateTransformation(to, from);
        out->inverse = OCTNewCoordinateTransformation(from, to);
    }
    if (from) {
        OSRDestroySpatialReference(from);
    }
    if (to) {
        OSRDestroySpatialReference(to);
    }
    if (!out->forward || !out->inverse) {
        system_finish(out);
        return false;
    }
    return true;
}

static bool transform(OGRCoordinateTransformationH t, double *x, double *y)
{
    return OCTTransform(t, 1, x, y, NULL) && isfinite(*x) && isfinite(*y);
}

static double wrap_deg(double degrees)
{
    return degrees - 360 * floor((degrees + 180) / 360);
}

// Turns parts of the raster's width and height into longitude and latitude, degrees.
static bool find_place(const struct raster *raster, const struct system *s, const double t[6],
                       double place[2])
{
    double x = t[0] + t[1] * raster->width * place[0];
    double y = t[3] + t[5] * raster->height * place[1];
    const bool is_found = transform(s->inverse, &x, &y);
    place[0] = x;
    place[1] = y;
    return is_found;
}

// Columns in equal steps of longitude and rows in equal steps of latitude.
static bool fit_equirectangular(struct raster *raster, const struct system *s, const double t[6])
{
    static const double PARTS[] = {0.01, 0.3, 0.5, 0.7, 0.99};
    enum { COUNT = sizeof PARTS / sizeof PARTS[0], MIDDLE = 2 };
    double low[2] = {PARTS[1], PARTS[1]};
    double high[2] = {PARTS[3], PARTS[3]};
    double middle[2] = {PARTS[MIDDLE], PARTS[MIDDLE]};
    if (!find_place(raster, s, t, low) || !find_place(raster, s, t, high) ||
        !find_place(raster, s, t, middle)) {
        return false;
    }
    const double across = wrap_deg(high[0] - middle[0]) / (PARTS[3] - PARTS[MIDDLE]);
    const double down = (low[1] - high[1]) / (PARTS[3] - PARTS[1]);
    if (!(across > 0) || !(down > 0)) {
        return false;
    }
    for (int i = 0; i < COUNT * COUNT; i++) {
        const double part_x = PARTS[i % COUNT] - PARTS[MIDDLE];
        const double part_y = PARTS[i / COUNT] - PARTS[MIDDLE];
        double at[2] = {PARTS[i % COUNT], PARTS[i / COUNT]};
        if (!find_place(raster, s, t, at)) {
            return false;
        }
        const double off_x = wrap_deg(at[0] - middle[0] - across * part_x) / across;
        const double off_y = (at[1] - middle[1] + down * part_y) / down;
        if (fabs(off_x) * raster->width > TOLERANCE_PIXELS ||
            fabs(off_y) * raster->height > TOLERANCE_PIXELS) {
            return false;
        }
    }
    raster->pixel_width_deg = across / raster->width;
    raster->pixel_height_deg = down / raster->height;
    raster->west_deg = middle[0] - across / 2;
    raster->north_deg = middle[1] + down / 2;
    return true;
}

// Where shared/projection.glsl has a place on the plane about a pole.
static void project(const struct raster_plane *plane, double latitude_deg, double longitude_deg,
                    double *x, double *y)
{
    const double pole = plane->pole;
    const AxisOffset o =
        projection_axis_offset(pole, 0, (longitude_deg - plane->longitude_deg) * DEGREE,
                               latitude_deg * DEGREE - pole * SHARED_PI / 2);
    const MapOffset m = projection_stereographic(o, pole, 0, pole, plane->e2, 1);
    *x = m.y;
    *y = -pole * m.x;
}

// A plane that PROJ's answers for the pole and one more place fit; `scale` and `origin` lead from
// it to the file's coordinates.
struct fit {
    struct raster_plane plane;
    double origin[2];
    double scale;
};

static bool guess_plane(const struct system *s, double pole, struct fit *out)
{
    *out = (struct fit){.plane = {.pole = pole, .e2 = s->e2}, .origin = {0, 90 * pole}};
    double x = 0, y = 80 * pole;
    if (!transform(s->forward, &out->origin[0], &out->origin[1]) ||
        !transform(s->forward, &x, &y)) {
        return false;
    }
    double plane_x, plane_y;
    project(&out->plane, 80 * pole, 0, &plane_x, &plane_y);
    x -= out->origin[0];
    y -= out->origin[1];
    out->scale = hypot(x, y) / hypot(plane_x, plane_y);
    // (sin(longitude - plane's), -pole cos(...)) for longitude 0.
    out->plane.longitude_deg = atan2(-x, -pole * y) / DEGREE;
    return out->scale > 0 && isfinite(out->scale);
}

static bool fit_stereographic(struct raster *raster, const struct system *s, const double t[6])
{
    double middle[2] = {0.5, 0.5};
    struct fit fit;
    if (!find_place(raster, s, t, middle) || !guess_plane(s, middle[1] < 0 ? -1 : 1, &fit)) {
        return false;
    }
    const double pole = fit.plane.pole;
    for (int i = 0; i < 12; i++) {
        const double latitude = pole * (88 - 12.0 * (i % 6));
        const double longitude = -170 + 95.0 * (i / 2.0);
        double x = longitude, y = latitude, plane_x, plane_y;
        if (!transform(s->forward, &x, &y)) {
            return false;
        }
        project(&fit.plane, latitude, longitude, &plane_x, &plane_y);
        const double off_x = x - fit.origin[0] - fit.scale * plane_x;
        const double off_y = y - fit.origin[1] - fit.scale * plane_y;
        if (hypot(off_x, off_y) > TOLERANCE_PIXELS * fmin(t[1], -t[5])) {
            return false;
        }
    }
    fit.plane.left = (t[0] - fit.origin[0]) / fit.scale;
    fit.plane.top = (t[3] - fit.origin[1]) / fit.scale;
    fit.plane.pixel_width = t[1] / fit.scale;
    fit.plane.pixel_height = -t[5] / fit.scale;
    const double right = fit.plane.left + fit.plane.pixel_width * raster->width;
    const double bottom = fit.plane.top - fit.plane.pixel_height * raster->height;
    const double reach =
        hypot(fmax(fabs(fit.plane.left), fabs(right)), fmax(fabs(fit.plane.top), fabs(bottom)));
    raster->plane = fit.plane;
    return reach < 2 * tan(LARGEST_ANGLE_DEG * DEGREE / 2);
}

bool raster_recognise_projection(struct raster *raster, const double t[6])
{
    struct system system;
    if (!system_init(GDALGetSpatialRef(raster->dataset), &system)) {
        return false;
    }
    const bool is_known =
        fit_equirectangular(raster, &system, t) || fit_stereographic(raster, &system, t);
    if (!is_known) {
        raster->plane = (struct raster_plane){0};
    }
    system_finish(&system);
    return is_known;
}
