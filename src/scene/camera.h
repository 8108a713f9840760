// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCENE_CAMERA_H
#define SCENE_CAMERA_H
// From a view, as people describe it, to a camera in the planet frame, as the passes need it.
//
// The local frame of a place is east, north and up, where up leads away from the planet's centre.
// At a pole the longitude still says where east is, so headings stay defined there.

#include "base/camera.h"
#include <terrella/scene.h>

// No camera stands nearer to the ground than this, in metres.
#define CAMERA_MIN_HEIGHT_M 0.01

struct scene_body;

// What a view stands on, and what is around.
struct camera_place {
    double radius_m;                 // of the reference sphere
    double ground_altitude_m;        // above the sphere, below the camera
    double water_depth_m;            // of water there into which eyes may go; 0: none
    double wave_m;                   // of the sea there, above its level; 0 where nobody knows
    const struct scene_body *bodies; // of the scene; NULL when there are none
    size_t body_count;
};

// Whether the bodies can be where the view has them. TRL_ERROR_INVALID: the camera would be inside
// one, or so far away that it cannot be seen in that direction at its distance from the planet.
TRL_MUST_USE trl_result camera_check(const trl_context *ctx, const trl_view *view,
                                     const struct camera_place *place);

// Altitude above the sphere, lifted above the ground or the water's bed.
double camera_altitude_m(const trl_view *view, const struct camera_place *place);

// The camera of a view whose numbers are in range and which camera_check lets pass; `aspect` is
// width over height.
struct camera camera_resolve(const trl_view *view, const struct camera_place *place, double aspect);

// The same view given by altitude above the sphere, subsolar point, and bodies by the points below
// them.
trl_view camera_view_resolve(const trl_view *view, const struct camera_place *place);

#endif // SCENE_CAMERA_H
