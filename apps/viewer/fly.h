// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef VIEWER_FLY_H
#define VIEWER_FLY_H
// How the camera moves: from orbit to the ground without a cut. No window and no OpenGL here.
//
// The camera is a position and an orthonormal frame in the planet frame (origin at the centre, z to
// the north pole). Latitude, longitude and heading exist only where a trl_view is made of it, so
// nothing jumps at the poles. When the camera travels over the sphere its frame turns with the
// local vertical; that keeps the horizon where it is and makes sideways flight from orbit a flight
// around the planet.

#include "rotation.h"
#include <terrella/scene.h>

struct fly_camera {
    double radius_m; // of the reference sphere
    struct vector position_m;
    struct rotation planet_from_camera; // camera axes: x right, y up, z backward
    double vertical_fov_rad;
};

// Metres that the camera keeps between itself and the ground.
static const double fly_clearance_m = 2.0;

// `view` counts its altitude from the reference sphere (see trl_renderer_resolve).
struct fly_camera fly_camera_from_view(const trl_view *view, double radius_m);
// Writes the camera's fields of the view; sun and exposure stay.
void fly_camera_to_view(const struct fly_camera *camera, trl_view *out);

struct vector fly_camera_right(const struct fly_camera *camera);
struct vector fly_camera_up(const struct fly_camera *camera);
struct vector fly_camera_forward(const struct fly_camera *camera);
struct vector fly_camera_zenith(const struct fly_camera *camera);
double fly_camera_altitude_m(const struct fly_camera *camera);

// 0 where the ground's laws hold (up is the zenith), 1 in orbit; smooth between.
double fly_camera_orbit_weight(const struct fly_camera *camera);

// Metres per second at this height above the ground.
double fly_speed_m_s(double height_m);

// Turns the camera as if the scene were taken and dragged by these angles, right and up positive.
// The pitch stops at the zenith and the nadir near the ground.
void fly_look(struct fly_camera *camera, double right_rad, double up_rad);

// As fly_look near the ground; from orbit the planet itself follows the hand.
void fly_drag(struct fly_camera *camera, double right_rad, double up_rad);

// Metres along the camera's right, the local vertical, and the line of sight.
struct fly_step {
    double right_m, up_m, forward_m;
};
void fly_move(struct fly_camera *camera, struct fly_step step);

// Turns the horizon level, the quicker the nearer the ground is. Leaves the line of sight.
void fly_level(struct fly_camera *camera, double elapsed_s);

// Lifts the camera to fly_clearance_m above the ground below it. True when it had to.
bool fly_stay_above(struct fly_camera *camera, double ground_altitude_m);

// A flight from one view to another. Both count altitudes from the sphere and give the sun by its
// subsolar point.
struct fly_flight {
    struct fly_camera from, to;
    trl_view from_view, to_view;
    double duration_s;
    double from_ground_m, to_ground_m; // of the ground below both, from which heights are counted;
                                       // planned as 0, to be set where it is known
};
struct fly_flight fly_flight_plan(const trl_view *from, const trl_view *to, double radius_m);
// The view `elapsed_s` after the start; from the duration on it is `to`.
trl_view fly_flight_view(const struct fly_flight *flight, double elapsed_s);

#endif // VIEWER_FLY_H
