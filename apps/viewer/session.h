// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef VIEWER_SESSION_H
#define VIEWER_SESSION_H
// One open window: what window.c draws and controls.c moves.

#include "edit.h"
#include "fly.h"
#include "pace.h"
#include "viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

struct viewer {
    const struct viewer_desc *desc;
    GLFWwindow *window;
    trl_renderer *renderer;
    struct edit edit;
    struct fly_camera camera;
    trl_view view; // sun and exposure, and the camera as last drawn
    struct fly_flight flight;
    double flight_started_s; // negative: not flying by itself
    struct pace pace;
    double speed_factor;
    double drag_right_px, drag_up_px; // since the last frame
    bool looks_only;                  // dragged with the right button
    double cursor_x, cursor_y;
    double last_frame_s, last_change_s, last_title_s, last_look_s, frame_s;
    bool is_changed;    // a frame is due
    bool was_moving;    // the last frame was
    bool was_solving;   // an atmosphere was not finished at the last frame
    bool wants_picture; // P was pressed
    uint64_t frame_count;
    uint32_t drawn_width, drawn_height;
    int saved[4]; // window's place and size before full screen
    trl_result result;
};

// Lets the window's input reach the viewer.
void controls_attach(struct viewer *viewer);

// Everything that time and input do to the view. True while something moves.
bool controls_advance(struct viewer *viewer, double elapsed_s);

// The view with what the renderer knows of the ground, fit to start or end a flight. False on
// failure.
bool controls_resolve(struct viewer *viewer, const trl_view *view, trl_view *out);

#endif // VIEWER_SESSION_H
