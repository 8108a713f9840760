// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/georeference.h"

#include <gdal.h>
#include <math.h>
#include <ogr_srs_api.h>

// Borders may stick out by this part of a pixel: georeferences are written with few digits.
static const double BORDER_SLACK = 1e-3;

static trl_result fail_raster(const struct raster *raster, const char *why)
{
    return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER, "%s: %s", raster->path,
                    why);
}

static trl_result assume_whole_globe(struct raster *raster)
{
    if (GDALGetGCPCount(raster->dataset) > 0) {
        return fail_raster(raster, "only some of its points have places (ground control points); "
                                   "make a map of it (gdalwarp -t_srs EPSG:4326)");
    }
    if (raster->width != 2 * raster->height) {
        return trl_fail(
            raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
            "%s: no georeference, and %u x %u is not the 2:1 of a whole globe; say where "
            "it lies (gdal_translate -a_srs EPSG:4326 -a_ullr WEST NORTH EAST SOUTH)",
            raster->path, raster->width, raster->height);
    }
    raster->west_deg = -180;
    raster->north_deg = 90;
    raster->pixel_width_deg = 360.0 / raster->width;
    raster->pixel_height_deg = 180.0 / raster->height;
    return TRL_OK;
}

static trl_result check_borders(struct raster *raster)
{
    const double across = raster->pixel_width_deg * raster->width;
    const double down = raster->pixel_height_deg * raster->height;
    // Grids whose nodes lie on the borders stick out by half a pixel on either side.
    const double slack_x = raster->pixel_width_deg * (1 + BORDER_SLACK);
    const double slack_y = raster->pixel_height_deg * (0.5 + BORDER_SLACK);
    if (across > 360 + slack_x || raster->north_deg > 90 + slack_y ||
        raster->north_deg - down < -90 - slack_y || fabs(raster->west_deg) > 720) {
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: its borders are outside the globe (%g to %g E, %g to %g N)%s",
                        raster->path, raster->west_deg, raster->west_deg + across,
                        raster->north_deg - down, raster->north_deg,
                        raster->body_radius_m > 0
                            ? ""
                            : "; if they are not degrees, say what they are (gdal_edit.py -a_srs)");
    }
    // Rounding may put 180 W a little west of itself.
    raster->west_deg -= 360 * floor((raster->west_deg + 180) / 360 + 1e-12);
    raster->east_deg = raster->west_deg + across;
    raster->south_deg = raster->north_deg - down;
    raster->is_whole_circle = fabs(across - 360) < raster->pixel_width_deg * BORDER_SLACK * 10;
    return TRL_OK;
}

static bool is_north_up(const double t[6])
{
    return t[2] == 0 && t[4] == 0 && t[1] > 0 && t[5] < 0;
}

static trl_result check_transform(const struct raster *raster, const double t[6])
{
    for (int i = 0; i < 6; i++) {
        if (!isfinite(t[i])) {
            return fail_raster(raster, "its georeference is not finite; give it another one "
                                       "(gdal_translate -a_ullr WEST NORTH EAST SOUTH)");
        }
    }
    return t[1] * t[5] - t[2] * t[4] != 0
               ? TRL_OK
               : fail_raster(raster,
                             "its georeference gives its pixels no area; give it another one "
                             "(gdal_translate -a_ullr WEST NORTH EAST SOUTH)");
}

static void place_geographic(struct raster *raster, const double t[6])
{
    raster->west_deg = t[0];
    raster->north_deg = t[3];
    raster->pixel_width_deg = t[1];
    raster->pixel_height_deg = -t[5];
}

static trl_result warp_and_place(struct raster *raster)
{
    trl_result result = raster_warp(raster);
    double t[6] = {0};
    if (result == TRL_OK) {
        result = raster_read_facts(raster);
    }
    if (result == TRL_OK && GDALGetGeoTransform(raster->dataset, t) != CE_None) {
        result = fail_raster(raster, "GDAL does not say where it warped it to");
    }
    if (result != TRL_OK || (OSRIsProjected(GDALGetSpatialRef(raster->dataset)) &&
                             raster_recognise_projection(raster, t))) {
        return result; // a plane about a pole
    }
    place_geographic(raster, t);
    return check_borders(raster);
}

static double find_body_radius(OGRSpatialReferenceH srs)
{
    OGRErr error = OGRERR_FAILURE;
    const double radius_m = srs ? OSRGetSemiMajor(srs, &error) : 0;
    return error == OGRERR_NONE ? radius_m : 0;
}

trl_result raster_read_georeference(struct raster *raster)
{
    double t[6];
    if (GDALGetGeoTransform(raster->dataset, t) != CE_None) {
        const trl_result result = assume_whole_globe(raster);
        return result == TRL_OK ? check_borders(raster) : result;
    }
    const trl_result result = check_transform(raster, t);
    if (result != TRL_OK) {
        return result;
    }
    const OGRSpatialReferenceH srs = GDALGetSpatialRef(raster->dataset);
    raster->body_radius_m = find_body_radius(srs);
    const bool is_geographic = !srs || OSRIsGeographic(srs) || OSRIsDerivedGeographic(srs);
    if (is_geographic && is_north_up(t)) {
        place_geographic(raster, t);
        return check_borders(raster);
    }
    if (!srs) {
        return fail_raster(raster, "it is turned, and does not say in which coordinates; say it "
                                   "(gdal_edit.py -a_srs EPSG:4326)");
    }
    if (is_geographic || !is_north_up(t) || !raster_recognise_projection(raster, t)) {
        return warp_and_place(raster);
    }
    return raster->plane.pole != 0 ? TRL_OK : check_borders(raster);
}
