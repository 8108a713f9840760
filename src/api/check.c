// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "api/check.h"

#include "scene/scene.h"
#include <terrella/renderer.h>

#include <float.h>
#include <math.h>

struct range {
    const char *name;
    double value, min, max;
};

static trl_result check_range(const trl_context *ctx, const struct range *range)
{
    if (range->value >= range->min && range->value <= range->max) { // a NaN is in no range
        return TRL_OK;
    }
    if (range->max == DBL_MAX) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "view: %s is %g, but must be finite", range->name, range->value);
    }
    return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                    "view: %s is %g, but must be from %g to %g", range->name, range->value,
                    range->min, range->max);
}

static trl_result check_choices(const trl_context *ctx, const trl_view *view)
{
    TRL_REQUIRE(ctx, view->altitude_mode == TRL_ALTITUDE_SPHERE ||
                         view->altitude_mode == TRL_ALTITUDE_GROUND ||
                         view->altitude_mode == TRL_ALTITUDE_WAVES);
    TRL_REQUIRE(ctx, view->sun_mode == TRL_SUN_SUBSOLAR || view->sun_mode == TRL_SUN_LOCAL);
    TRL_REQUIRE(ctx,
                view->tone_curve == TRL_TONE_FILMIC || view->tone_curve == TRL_TONE_EXPONENTIAL);
    return TRL_OK;
}

static trl_result check_body(const trl_context *ctx, const trl_body_place *place,
                             const struct trl_scene *scene, const struct scene_body *body)
{
    const double any = DBL_MAX;
    const struct range ranges[] = {
        {"latitude_or_elevation_rad of a body", place->latitude_or_elevation_rad, -any, any},
        {"longitude_or_azimuth_rad of a body", place->longitude_or_azimuth_rad, -any, any},
        {"distance_m of a body", place->distance_m, 0, 1e13},
    };
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const trl_result result = check_range(ctx, &ranges[i]);
        if (result != TRL_OK) {
            return result;
        }
    }
    const double nearest_m = scene_body_nearest_m(scene, body);
    if (place->distance_m > 0 && !(place->distance_m > nearest_m)) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "view: distance_m of body \"%s\" is %g, but must be above %g: it would "
                        "reach into the planet or its air",
                        body->name, place->distance_m, nearest_m);
    }
    return TRL_OK;
}

static trl_result check_bodies(const trl_context *ctx, const trl_view *view,
                               const struct trl_scene *scene)
{
    for (size_t i = 0; i < TRL_VIEW_MAX_BODIES; i++) {
        const trl_body_place *place = &view->bodies[i];
        TRL_REQUIRE(ctx, (unsigned)place->mode <= TRL_BODY_FROM_SUN);
        if (place->mode == TRL_BODY_ABSENT) {
            continue;
        }
        if (i >= scene->body_count) {
            return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                            "view: body %zu has a place, but the scene has %zu bodies", i,
                            scene->body_count);
        }
        const trl_result result = check_body(ctx, place, scene, &scene->bodies[i]);
        if (result != TRL_OK) {
            return result;
        }
    }
    return TRL_OK;
}

trl_result check_view(const trl_context *ctx, const trl_view *view, const trl_scene *scene)
{
    const double radius_m = scene->medium.ground_radius_m;
    const double quarter = M_PI / 2 * (1 + 1e-9); // a right angle that came through degrees
    const double any = DBL_MAX;
    const double exposures = 64; // stops: 2^64 is far within floats
    const struct range ranges[] = {
        {"latitude_rad", view->latitude_rad, -quarter, quarter},
        {"longitude_rad", view->longitude_rad, -any, any},
        {"altitude_m", view->altitude_m, -radius_m, 1e4 * radius_m},
        {"heading_rad", view->heading_rad, -any, any},
        {"pitch_rad", view->pitch_rad, -any, any},
        {"roll_rad", view->roll_rad, -any, any},
        {"vertical_fov_rad", view->vertical_fov_rad, 1e-6, M_PI - 1e-6},
        {"sun_latitude_or_elevation_rad", view->sun_latitude_or_elevation_rad, -quarter, quarter},
        {"sun_longitude_or_azimuth_rad", view->sun_longitude_or_azimuth_rad, -any, any},
        {"sidereal_rad", view->sidereal_rad, -any, any},
        {"time_s", view->time_s, -1e12, 1e12},
        {"exposure_ev100", view->has_fixed_exposure ? view->exposure_ev100 : 0, -exposures,
         exposures},
        {"exposure_bias_ev", view->exposure_bias_ev, -exposures, exposures},
    };
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const trl_result result = check_range(ctx, &ranges[i]);
        if (result != TRL_OK) {
            return result;
        }
    }
    const trl_result result = check_choices(ctx, view);
    return result == TRL_OK ? check_bodies(ctx, view, scene) : result;
}

trl_result check_size(const trl_context *ctx, uint32_t width, uint32_t height)
{
    if (width < 1 || height < 1 || width > TRL_RENDERER_MAX_SIDE ||
        height > TRL_RENDERER_MAX_SIDE || width * height > TRL_RENDERER_MAX_PIXELS) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "a picture of %u x %u cannot be drawn: sides must be from 1 to %d pixels, "
                        "all pixels together at most %d",
                        width, height, TRL_RENDERER_MAX_SIDE, TRL_RENDERER_MAX_PIXELS);
    }
    return TRL_OK;
}
