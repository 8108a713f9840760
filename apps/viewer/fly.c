// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "fly.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

// Heights, in radii, between which the laws of the ground give way to those of orbit.
static const double orbit_begins = 0.03;
static const double orbit_reigns = 0.3;

static double clamp(double x, double low, double high)
{
    return fmin(fmax(x, low), high);
}

static double smooth(double t)
{
    const double x = clamp(t, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

static struct vector from_lat_lon(double latitude_rad, double longitude_rad)
{
    return (struct vector){cos(latitude_rad) * cos(longitude_rad),
                           cos(latitude_rad) * sin(longitude_rad), sin(latitude_rad)};
}

struct fly_camera fly_camera_from_view(const trl_view *view, double radius_m)
{
    const double longitude = view->longitude_rad;
    const struct vector zenith = from_lat_lon(view->latitude_rad, longitude);
    const struct vector east = {-sin(longitude), cos(longitude), 0.0};
    const struct vector north = vector_cross(zenith, east);
    // Facing north and level, then roll, pitch and heading are turned on in this order.
    const struct rotation level = rotation_from_axes(east, zenith, vector_scale(north, -1.0));
    const struct rotation heading = rotation_about(zenith, -view->heading_rad);
    const struct rotation pitch = rotation_about(east, view->pitch_rad);
    const struct rotation roll = rotation_about(north, view->roll_rad);
    return (struct fly_camera){
        .radius_m = radius_m,
        .position_m = vector_scale(zenith, radius_m + view->altitude_m),
        .planet_from_camera =
            rotation_multiply(heading, rotation_multiply(pitch, rotation_multiply(roll, level))),
        .vertical_fov_rad = view->vertical_fov_rad};
}

struct vector fly_camera_right(const struct fly_camera *camera)
{
    return rotation_apply(camera->planet_from_camera, (struct vector){1.0, 0.0, 0.0});
}

struct vector fly_camera_up(const struct fly_camera *camera)
{
    return rotation_apply(camera->planet_from_camera, (struct vector){0.0, 1.0, 0.0});
}

struct vector fly_camera_forward(const struct fly_camera *camera)
{
    return rotation_apply(camera->planet_from_camera, (struct vector){0.0, 0.0, -1.0});
}

struct vector fly_camera_zenith(const struct fly_camera *camera)
{
    return vector_normalize(camera->position_m);
}

double fly_camera_altitude_m(const struct fly_camera *camera)
{
    return vector_length(camera->position_m) - camera->radius_m;
}

double fly_camera_orbit_weight(const struct fly_camera *camera)
{
    const double height = fly_camera_altitude_m(camera) / camera->radius_m;
    return smooth((height - orbit_begins) / (orbit_reigns - orbit_begins));
}

double fly_speed_m_s(double height_m)
{
    const double least_m_s = 15.0; // a brisk car, so that valleys can be explored
    return fmax(least_m_s, 0.8 * height_m);
}

// Angle of the line of sight above the horizontal.
static double find_pitch(const struct fly_camera *camera)
{
    const struct vector zenith = fly_camera_zenith(camera);
    const struct vector forward = fly_camera_forward(camera);
    return atan2(vector_dot(forward, zenith), vector_length(vector_cross(forward, zenith)));
}

void fly_camera_to_view(const struct fly_camera *camera, trl_view *out)
{
    const struct vector zenith = fly_camera_zenith(camera);
    out->latitude_rad = atan2(zenith.z, hypot(zenith.x, zenith.y));
    out->longitude_rad = atan2(zenith.y, zenith.x);
    const struct vector east = {-sin(out->longitude_rad), cos(out->longitude_rad), 0.0};
    const struct vector north = vector_cross(zenith, east);
    const struct vector forward = fly_camera_forward(camera);
    const struct vector up = fly_camera_up(camera);
    out->pitch_rad = clamp(find_pitch(camera), -pi / 2.0, pi / 2.0);
    // Straight up or down the heading is where the picture's upper (lower) edge points.
    const double level = hypot(vector_dot(forward, east), vector_dot(forward, north));
    const struct vector ahead =
        level > 1e-7 ? forward : vector_scale(up, out->pitch_rad > 0.0 ? -1.0 : 1.0);
    out->heading_rad = atan2(vector_dot(ahead, east), vector_dot(ahead, north));
    // Right of a level camera with this heading; roll is what is missing to ours.
    const struct vector right = vector_add(vector_scale(east, cos(out->heading_rad)),
                                           vector_scale(north, -sin(out->heading_rad)));
    out->roll_rad = atan2(vector_dot(up, right), vector_dot(fly_camera_right(camera), right));
    out->altitude_m = fly_camera_altitude_m(camera);
    out->altitude_mode = TRL_ALTITUDE_SPHERE;
    out->vertical_fov_rad = camera->vertical_fov_rad;
}

static void turn_frame(struct fly_camera *camera, struct rotation turn)
{
    camera->planet_from_camera = rotation_multiply(turn, camera->planet_from_camera);
}

// The scene follows the hand, so the camera turns against it. Pitch is limited where up is the
// zenith.
void fly_look(struct fly_camera *camera, double right_rad, double up_rad)
{
    const double weight = fly_camera_orbit_weight(camera);
    const struct vector zenith = fly_camera_zenith(camera);
    const struct vector up = fly_camera_up(camera);
    // Straight up the picture's upper edge is level, give or take a rounding.
    const bool is_upright = vector_dot(up, zenith) > -1e-6;
    const struct vector axis = vector_normalize(vector_add(
        vector_scale(zenith, is_upright ? 1.0 - weight : weight - 1.0), vector_scale(up, weight)));
    double pitch_rad = -up_rad;
    if (weight < 1.0 && is_upright) {
        // Beyond the zenith by a rounding counts as beyond, or the roundings would double with each
        // call.
        const double nearest = find_pitch(camera);
        const double now = vector_dot(up, zenith) < 0.0 ? copysign(pi, nearest) - nearest : nearest;
        pitch_rad = clamp(now + pitch_rad, -pi / 2.0, pi / 2.0) - now;
    }
    turn_frame(camera, rotation_about(fly_camera_right(camera), pitch_rad));
    turn_frame(camera, rotation_about(axis, right_rad));
}

void fly_drag(struct fly_camera *camera, double right_rad, double up_rad)
{
    const double weight = fly_camera_orbit_weight(camera);
    fly_look(camera, right_rad * (1.0 - weight), up_rad * (1.0 - weight));
    // An angle at the camera is one of height / radius at the planet's centre; no more than half a
    // turn of the hand's own angle from afar, where that would spin the planet.
    const double gain = weight * fmin(2.0, fly_camera_altitude_m(camera) / camera->radius_m);
    const struct rotation turn =
        rotation_multiply(rotation_about(fly_camera_up(camera), -right_rad * gain),
                          rotation_about(fly_camera_right(camera), up_rad * gain));
    camera->position_m = rotation_apply(turn, camera->position_m);
    turn_frame(camera, turn);
}

void fly_move(struct fly_camera *camera, struct fly_step step)
{
    const struct vector before = fly_camera_zenith(camera);
    const struct vector across =
        vector_add(vector_scale(fly_camera_right(camera), step.right_m),
                   vector_scale(fly_camera_forward(camera), step.forward_m));
    const struct vector way = vector_add(across, vector_scale(before, step.up_m));
    // The sideways part runs along the sphere and not off it along the tangent, or level flight
    // would climb.
    const double rise_m = vector_dot(way, before);
    const struct vector level = vector_add(way, vector_scale(before, -rise_m));
    const double distance_m = vector_length(camera->position_m);
    const double angle_rad = vector_length(level) / distance_m;
    const struct vector axis = vector_normalize(vector_cross(before, level));
    const struct rotation travel = rotation_about(axis, clamp(angle_rad, 0.0, 0.5));
    const struct vector zenith = rotation_apply(travel, before);
    // Beyond this distance a planet is a point and doubles still have metres.
    const double farthest_m = 1e4 * camera->radius_m;
    camera->position_m =
        vector_scale(zenith, clamp(distance_m + rise_m, 1e-3 * camera->radius_m, farthest_m));
    turn_frame(camera, travel);
}

void fly_level(struct fly_camera *camera, double elapsed_s)
{
    trl_view view;
    fly_camera_to_view(camera, &view);
    // Straight up or down there is no horizon to be level with.
    const double seen = cos(view.pitch_rad) * cos(view.pitch_rad);
    const double nearness = 1.0 - fly_camera_orbit_weight(camera);
    const double share = 1.0 - exp(-4.0 * elapsed_s * nearness * seen);
    turn_frame(camera, rotation_about(fly_camera_forward(camera), -view.roll_rad * share));
}

bool fly_stay_above(struct fly_camera *camera, double ground_altitude_m)
{
    const double lowest_m = camera->radius_m + ground_altitude_m + fly_clearance_m;
    if (vector_length(camera->position_m) >= lowest_m) {
        return false;
    }
    camera->position_m = vector_scale(fly_camera_zenith(camera), lowest_m);
    return true;
}

static double mix(double a, double b, double t)
{
    return a + (b - a) * t;
}

// Angle between two unit vectors, exact for small ones.
static double find_angle(struct vector a, struct vector b)
{
    return atan2(vector_length(vector_cross(a, b)), vector_dot(a, b));
}

struct fly_flight fly_flight_plan(const trl_view *from, const trl_view *to, double radius_m)
{
    struct fly_flight flight = {.from = fly_camera_from_view(from, radius_m),
                                .to = fly_camera_from_view(to, radius_m),
                                .from_view = *from,
                                .to_view = *to};
    const double arc_rad =
        find_angle(fly_camera_zenith(&flight.from), fly_camera_zenith(&flight.to));
    const double heights =
        fabs(log((fmax(to->altitude_m, 0.0) + 100.0) / (fmax(from->altitude_m, 0.0) + 100.0)));
    // Long enough to follow, short enough not to wait: 2 to 7 s.
    flight.duration_s = fmin(7.0, 2.0 + 1.5 * arc_rad + 0.25 * heights);
    return flight;
}

// Heights change by factors, and on a long way the camera rises so that it looks down on where it
// goes.
static double find_flight_altitude(const struct fly_flight *flight, double arc_rad, double t)
{
    const double floor_m = 100.0; // below it the way is linear, where logarithms would dwell
    const double ground_m = mix(flight->from_ground_m, flight->to_ground_m, t) - floor_m;
    const double from_m = fly_camera_altitude_m(&flight->from) - flight->from_ground_m + floor_m;
    const double to_m = fly_camera_altitude_m(&flight->to) - flight->to_ground_m + floor_m;
    const double base_m =
        ground_m +
        (from_m > 0.0 && to_m > 0.0 ? exp(mix(log(from_m), log(to_m), t)) : mix(from_m, to_m, t));
    const double arch = 4.0 * t * (1.0 - t);
    return base_m + 0.15 * arc_rad * flight->from.radius_m * arch * arch;
}

// How far the camera has turned. On a way down it turns late and on a way up early, so that the
// place that is far below stays in the picture: by a factor of 1000 in height, with the cube.
static double find_flight_turn(const struct fly_flight *flight, double t)
{
    const double from_m = fly_camera_altitude_m(&flight->from) - flight->from_ground_m;
    const double to_m = fly_camera_altitude_m(&flight->to) - flight->to_ground_m;
    const double fall = log(fmax(from_m, 1.0) / fmax(to_m, 1.0)) / log(1000.0);
    const double late = fall > 0.0 ? t * t * t : 1.0 - (1.0 - t) * (1.0 - t) * (1.0 - t);
    return mix(t, late, fmin(fabs(fall), 1.0));
}

static void set_flight_sun(const struct fly_flight *flight, double t, trl_view *out)
{
    const struct vector from = from_lat_lon(flight->from_view.sun_latitude_or_elevation_rad,
                                            flight->from_view.sun_longitude_or_azimuth_rad);
    const struct vector to = from_lat_lon(flight->to_view.sun_latitude_or_elevation_rad,
                                          flight->to_view.sun_longitude_or_azimuth_rad);
    const struct rotation still = {1.0, 0.0, 0.0, 0.0};
    const struct vector sun =
        rotation_apply(rotation_blend(still, rotation_between(from, to), t), from);
    out->sun_latitude_or_elevation_rad = atan2(sun.z, hypot(sun.x, sun.y));
    out->sun_longitude_or_azimuth_rad = atan2(sun.y, sun.x);
}

trl_view fly_flight_view(const struct fly_flight *flight, double elapsed_s)
{
    if (elapsed_s >= flight->duration_s) {
        return flight->to_view;
    }
    const double t = smooth(elapsed_s / flight->duration_s);
    const struct vector start = fly_camera_zenith(&flight->from);
    const struct vector goal = fly_camera_zenith(&flight->to);
    const struct rotation whole_way = rotation_between(start, goal);
    const struct rotation still = {1.0, 0.0, 0.0, 0.0};
    const struct rotation travel = rotation_blend(still, whole_way, t);
    // The camera turns relative to a frame that travels along, so a level flight stays level.
    const struct rotation goal_at_start =
        rotation_multiply(rotation_invert(whole_way), flight->to.planet_from_camera);
    const struct rotation turned =
        rotation_blend(flight->from.planet_from_camera, goal_at_start, find_flight_turn(flight, t));
    const double altitude_m = find_flight_altitude(flight, find_angle(start, goal), t);
    const struct fly_camera camera = {
        .radius_m = flight->from.radius_m,
        .position_m =
            vector_scale(rotation_apply(travel, start), flight->from.radius_m + altitude_m),
        .planet_from_camera = rotation_multiply(travel, turned),
        .vertical_fov_rad = mix(flight->from.vertical_fov_rad, flight->to.vertical_fov_rad, t)};
    trl_view view = flight->from_view;
    fly_camera_to_view(&camera, &view);
    set_flight_sun(flight, t, &view);
    view.sidereal_rad =
        flight->from_view.sidereal_rad +
        t * remainder(flight->to_view.sidereal_rad - flight->from_view.sidereal_rad, 2 * pi);
    memcpy(view.bodies, t < 0.5 ? flight->from_view.bodies : flight->to_view.bodies,
           sizeof view.bodies);
    view.exposure_bias_ev =
        mix(flight->from_view.exposure_bias_ev, flight->to_view.exposure_bias_ev, t);
    return view;
}
