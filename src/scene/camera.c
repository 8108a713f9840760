// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/camera.h"

#include "scene/scene.h"

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
    double base_m = view->altitude_mode == TRL_ALTITUDE_SPHERE ? 0 : place->ground_altitude_m;
    base_m += view->altitude_mode == TRL_ALTITUDE_WAVES ? place->wave_m : 0;
    return fmax(base_m + view->altitude_m,
                place->ground_altitude_m - place->water_depth_m + CAMERA_MIN_HEIGHT_M);
}

static struct vec3 find_position(const trl_view *view, const struct camera_place *place,
                                 const struct local_frame *frame)
{
    return vec3_scale(frame->up, place->radius_m + camera_altitude_m(view, place));
}

// By angles up and to the right of the star, for an observer who faces it and is held level. With
// the star at the zenith right is east.
static struct vec3 point_from_sun(const struct local_frame *frame, struct vec3 sun,
                                  const trl_body_place *body)
{
    const double east = vec3_dot(sun, frame->east), north = vec3_dot(sun, frame->north);
    const double level = hypot(east, north);
    const double s = level > 0 ? east / level : 0, c = level > 0 ? north / level : 1;
    const struct vec3 right = vec3_sub(vec3_scale(frame->east, c), vec3_scale(frame->north, s));
    const struct vec3 up = vec3_cross(right, sun);
    const double right_rad = body->longitude_or_azimuth_rad;
    const double up_rad = body->latitude_or_elevation_rad;
    const double angle_rad = hypot(right_rad, up_rad);
    if (angle_rad == 0) {
        return sun;
    }
    const struct vec3 aside =
        vec3_add(vec3_scale(right, right_rad / angle_rad), vec3_scale(up, up_rad / angle_rad));
    return vec3_add(vec3_scale(sun, cos(angle_rad)), vec3_scale(aside, sin(angle_rad)));
}

// Where a ray from the camera reaches the distance from the planet's centre; the camera is nearer.
static struct vec3 reach(struct vec3 from_m, struct vec3 direction, double distance_m)
{
    const double along = vec3_dot(from_m, direction);
    const double rest =
        (distance_m - vec3_length(from_m)) * (distance_m + vec3_length(from_m)) + along * along;
    return vec3_add(from_m, vec3_scale(direction, sqrt(fmax(rest, 0)) - along));
}

static double find_distance(const trl_body_place *body, const struct scene_body *scene_body)
{
    return body->distance_m > 0 ? body->distance_m : scene_body->distance_m;
}

static struct vec3 find_body(const trl_view *view, const struct camera_place *place, size_t index)
{
    const trl_body_place *body = &view->bodies[index];
    const struct local_frame frame = find_local_frame(view->latitude_rad, view->longitude_rad);
    const struct vec3 from_m = find_position(view, place, &frame);
    const double distance_m = find_distance(body, &place->bodies[index]);
    switch (body->mode) {
    case TRL_BODY_LOCAL:
        return reach(
            from_m,
            point_at(&frame, body->longitude_or_azimuth_rad, body->latitude_or_elevation_rad),
            distance_m);
    case TRL_BODY_FROM_SUN:
        return reach(from_m, point_from_sun(&frame, find_sun(view, &frame), body), distance_m);
    case TRL_BODY_ABSENT:
    case TRL_BODY_SUBPOINT:
        break;
    }
    return vec3_scale(
        vec3_from_lat_lon(body->latitude_or_elevation_rad, body->longitude_or_azimuth_rad),
        distance_m);
}

_Static_assert((int)CAMERA_MAX_BODIES == (int)TRL_VIEW_MAX_BODIES, "each has its place");

static void add_bodies(const trl_view *view, const struct camera_place *place, struct camera *out)
{
    for (size_t i = 0; i < place->body_count; i++) {
        if (view->bodies[i].mode != TRL_BODY_ABSENT) {
            out->bodies[out->body_count++] =
                (struct camera_body){.position_m = find_body(view, place, i),
                                     .radius_m = place->bodies[i].radius_m,
                                     .index = (unsigned)i};
        }
    }
}

static trl_result check_body(const trl_context *ctx, const trl_view *view,
                             const struct camera_place *place, size_t index)
{
    const struct scene_body *body = &place->bodies[index];
    const struct local_frame frame = find_local_frame(view->latitude_rad, view->longitude_rad);
    const struct vec3 from_m = find_position(view, place, &frame);
    const bool is_seen_from_camera =
        view->bodies[index].mode == TRL_BODY_LOCAL || view->bodies[index].mode == TRL_BODY_FROM_SUN;
    if (is_seen_from_camera && !(vec3_length(from_m) < find_distance(&view->bodies[index], body))) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "view: from beyond the distance of body \"%s\" its place must be given by "
                        "latitude and longitude",
                        body->name);
    }
    const struct vec3 way_m = vec3_sub(find_body(view, place, index), from_m);
    if (!(vec3_length(way_m) > body->radius_m)) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "view: the camera is inside the body \"%s\"", body->name);
    }
    return TRL_OK;
}

trl_result camera_check(const trl_context *ctx, const trl_view *view,
                        const struct camera_place *place)
{
    trl_result result = TRL_OK;
    for (size_t i = 0; result == TRL_OK && i < place->body_count; i++) {
        if (view->bodies[i].mode != TRL_BODY_ABSENT) {
            result = check_body(ctx, view, place, i);
        }
    }
    return result;
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
    struct camera camera = {
        .position_m = find_position(view, place, &frame),
        .right = vec3_sub(vec3_scale(level_right, c), vec3_scale(level_up, s)),
        .up = vec3_add(vec3_scale(level_up, c), vec3_scale(level_right, s)),
        .forward = forward,
        .tan_half_fov_x = tan_half_fov * aspect,
        .tan_half_fov_y = tan_half_fov,
        .sun_direction = find_sun(view, &frame),
    };
    add_bodies(view, place, &camera);
    return camera;
}

static trl_body_place resolve_body(struct vec3 position_m)
{
    return (trl_body_place){.mode = TRL_BODY_SUBPOINT,
                            .latitude_or_elevation_rad =
                                atan2(position_m.z, hypot(position_m.x, position_m.y)),
                            .longitude_or_azimuth_rad = atan2(position_m.y, position_m.x),
                            .distance_m = vec3_length(position_m)};
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
    for (size_t i = 0; i < place->body_count; i++) {
        if (view->bodies[i].mode != TRL_BODY_ABSENT) {
            resolved.bodies[i] = resolve_body(find_body(view, place, i));
        }
    }
    return resolved;
}
