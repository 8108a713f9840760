// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/camera.h"

struct local_frame {
    struct vec3 east, north, up;
};

static struct local_frame find_local_frame(double latitude_rad, double longitude_rad)
{
    const struct vec3 up = vec3_from_lat_lon(latitude_rad, longitude_rad);
    const struct vec3 east = {-sin(longitude_rad), cos(longitude_rad), 0};
    return (struct local_frame){east, vec3_cross(up, east), up};
}

// Unit vector at an azimuth clockwise from north and an elevation above the horizontal.
static struct vec3 point_at(const struct local_frame *frame, double azimuth_rad,
                            double elevation_rad)
{
    const struct vec3 level = vec3_add(vec3_scale(frame->north, cos(azimuth_rad)),
                                       vec3_scale(frame->east, sin(azimuth_rad)));
    return vec3_add(vec3_scale(level, cos(elevation_rad)),
                    vec3_scale(frame->up, sin(elevation_rad)));
}

static struct vec3 find_sun(const trl_view *view, const struct local_frame *frame)
{
    switch (view->sun_mode) {
    case TRL_SUN_SUBSOLAR:
        return vec3_from_lat_lon(view->sun_latitude_or_elevation_rad,
                                 view->sun_longitude_or_azimuth_rad);
    case TRL_SUN_LOCAL:
        break;
    }
    return point_at(frame, view->sun_longitude_or_azimuth_rad, view->sun_latitude_or_elevation_rad);
}

double camera_altitude_m(const trl_view *view, const struct camera_place *place)
{
    const double base_m = view->altitude_mode == TRL_ALTITUDE_GROUND ? place->ground_altitude_m : 0;
    return fmax(base_m + view->altitude_m, place->ground_altitude_m + CAMERA_MIN_HEIGHT_M);
}

struct camera camera_resolve(const trl_view *view, const struct camera_place *place, double aspect)
{
    const struct local_frame frame = find_local_frame(view->latitude_rad, view->longitude_rad);
    const struct vec3 forward = point_at(&frame, view->heading_rad, view->pitch_rad);
    // Level, at a right angle to the heading: defined also when looking straight up or down.
    const struct vec3 level_right = vec3_sub(vec3_scale(frame.east, cos(view->heading_rad)),
                                             vec3_scale(frame.north, sin(view->heading_rad)));
    const struct vec3 level_up = vec3_cross(level_right, forward);
    const double c = cos(view->roll_rad), s = sin(view->roll_rad);
    const double tan_half_fov = tan(0.5 * view->vertical_fov_rad);
    return (struct camera){
        .position_m = vec3_scale(frame.up, place->radius_m + camera_altitude_m(view, place)),
        .right = vec3_sub(vec3_scale(level_right, c), vec3_scale(level_up, s)),
        .up = vec3_add(vec3_scale(level_up, c), vec3_scale(level_right, s)),
        .forward = forward,
        .tan_half_fov_x = tan_half_fov * aspect,
        .tan_half_fov_y = tan_half_fov,
        .sun_direction = find_sun(view, &frame),
    };
}

trl_view camera_view_resolve(const trl_view *view, const struct camera_place *place)
{
    const struct local_frame frame = find_local_frame(view->latitude_rad, view->longitude_rad);
    const struct vec3 sun = find_sun(view, &frame);
    trl_view resolved = *view;
    resolved.altitude_mode = TRL_ALTITUDE_SPHERE;
    resolved.altitude_m = camera_altitude_m(view, place);
    resolved.sun_mode = TRL_SUN_SUBSOLAR;
    resolved.sun_latitude_or_elevation_rad = atan2(sun.z, hypot(sun.x, sun.y));
    resolved.sun_longitude_or_azimuth_rad = atan2(sun.y, sun.x);
    return resolved;
}
