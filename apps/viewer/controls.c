// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// From keys and mouse to flight.
#include "session.h"

#include <math.h>
#include <stdio.h>

static const double longest_step_s = 0.25; // a slow frame must not throw the camera far
static const double sun_speed_rad_s = 0.35;
static const double amount_step = 1.189207115002721; // four make double
static const double asymmetry_step = 0.05;
static const double pi = 3.14159265358979323846;

static struct viewer *get_viewer(GLFWwindow *window)
{
    return glfwGetWindowUserPointer(window);
}

static bool is_down(const struct viewer *viewer, int key)
{
    return glfwGetKey(viewer->window, key) == GLFW_PRESS;
}

// ---- what is told by GLFW

static void note_damage(GLFWwindow *window)
{
    get_viewer(window)->is_changed = true;
}

static void note_size(GLFWwindow *window, int width, int height)
{
    (void)width;
    (void)height;
    note_damage(window);
}

static void note_scroll(GLFWwindow *window, double x, double y)
{
    (void)x;
    struct viewer *viewer = get_viewer(window);
    viewer->speed_factor = fmin(fmax(viewer->speed_factor * pow(1.25, y), 0.01), 100.0);
    viewer->last_title_s = 0.0;
}

static void note_cursor(GLFWwindow *window, double x, double y)
{
    struct viewer *viewer = get_viewer(window);
    const bool is_left = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    const bool is_right = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
    if (is_left || is_right) {
        viewer->drag_right_px += x - viewer->cursor_x;
        viewer->drag_up_px -= y - viewer->cursor_y;
        viewer->looks_only = is_right;
    }
    viewer->cursor_x = x;
    viewer->cursor_y = y;
}

static void toggle_fullscreen(struct viewer *viewer)
{
    GLFWwindow *window = viewer->window;
    if (glfwGetWindowMonitor(window)) {
        glfwSetWindowMonitor(window, NULL, viewer->saved[0], viewer->saved[1], viewer->saved[2],
                             viewer->saved[3], GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode *mode = monitor ? glfwGetVideoMode(monitor) : NULL;
    if (mode) {
        glfwGetWindowPos(window, &viewer->saved[0], &viewer->saved[1]);
        glfwGetWindowSize(window, &viewer->saved[2], &viewer->saved[3]);
        glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    }
}

bool controls_resolve(struct viewer *viewer, const trl_view *view, trl_view *out)
{
    viewer->result = trl_renderer_resolve(viewer->renderer, view, out);
    return viewer->result == TRL_OK;
}

static void fly_to_view(struct viewer *viewer, size_t index)
{
    const trl_scene *scene = viewer->desc->scene;
    trl_view view;
    if (index >= trl_scene_view_count(scene) ||
        trl_scene_view(scene, trl_scene_view_name(scene, index), &view) != TRL_OK ||
        !controls_resolve(viewer, &view, &view)) {
        return;
    }
    viewer->flight = fly_flight_plan(&viewer->view, &view, trl_scene_ground_radius_m(scene));
    viewer->flight.from_ground_m = trl_renderer_ground_altitude_m(
        viewer->renderer, viewer->view.latitude_rad, viewer->view.longitude_rad);
    viewer->flight.to_ground_m =
        trl_renderer_ground_altitude_m(viewer->renderer, view.latitude_rad, view.longitude_rad);
    viewer->flight_started_s = glfwGetTime();
}

static void change_exposure(struct viewer *viewer, int key)
{
    trl_view *view = &viewer->view;
    switch (key) {
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
        view->exposure_bias_ev = fmin(view->exposure_bias_ev + 0.25, 40.0);
        break;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
        view->exposure_bias_ev = fmax(view->exposure_bias_ev - 0.25, -40.0);
        break;
    case GLFW_KEY_0:
        view->exposure_bias_ev = 0.0;
        view->has_fixed_exposure = false;
        break;
    default:
        view->tone_curve =
            view->tone_curve == TRL_TONE_FILMIC ? TRL_TONE_EXPONENTIAL : TRL_TONE_FILMIC;
        break;
    }
    viewer->is_changed = true;
}

static void change_air(struct viewer *viewer, int key)
{
    struct edit *edit = &viewer->edit;
    switch (key) {
    case GLFW_KEY_C:
        edit_choose_next(edit);
        break;
    case GLFW_KEY_COMMA:
        edit_scale(edit, 1.0 / amount_step);
        break;
    case GLFW_KEY_PERIOD:
        edit_scale(edit, amount_step);
        break;
    default:
        edit_turn_asymmetry(edit, key == GLFW_KEY_APOSTROPHE ? asymmetry_step : -asymmetry_step);
        break;
    }
    viewer->is_changed = true;
    viewer->last_title_s = 0.0;
}

// The next one that pictures are made by.
static void change_model(struct viewer *viewer)
{
    const trl_sky_model now = trl_renderer_sky_model(viewer->renderer);
    const trl_sky_model next = now == TRL_SKY_RAYLEIGH ? TRL_SKY_SPECTRAL : now + 1;
    if (trl_renderer_set_sky_model(viewer->renderer, next) == TRL_OK) {
        viewer->is_changed = true;
    }
}

static void toggle_air(struct viewer *viewer)
{
    const trl_air other =
        trl_renderer_air(viewer->renderer) == TRL_AIR_MARCH ? TRL_AIR_TABLE : TRL_AIR_MARCH;
    viewer->result = trl_renderer_set_air(viewer->renderer, other);
    viewer->is_changed = true;
}

// The next one; behind the last comes the first.
static void change_mesher(struct viewer *viewer)
{
    trl_mesher next = trl_renderer_mesher(viewer->renderer);
    trl_result result = TRL_ERROR_UNSUPPORTED;
    while (result == TRL_ERROR_UNSUPPORTED) { // the present one at the latest is there
        next = trl_mesher_name(next + 1) ? next + 1 : (trl_mesher)0;
        result = trl_renderer_set_mesher(viewer->renderer, next);
    }
    viewer->is_changed = true;
    viewer->last_title_s = 0.0;
}

static void note_key(GLFWwindow *window, int key, int scancode, int action, int modifiers)
{
    (void)scancode;
    (void)modifiers;
    struct viewer *viewer = get_viewer(window);
    if (action == GLFW_RELEASE) {
        return;
    }
    switch (key) {
    case GLFW_KEY_ESCAPE:
        glfwSetWindowShouldClose(window, GLFW_TRUE);
        break;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
    case GLFW_KEY_0:
    case GLFW_KEY_T:
        change_exposure(viewer, key);
        break;
    case GLFW_KEY_C:
    case GLFW_KEY_COMMA:
    case GLFW_KEY_PERIOD:
    case GLFW_KEY_SEMICOLON:
    case GLFW_KEY_APOSTROPHE:
        change_air(viewer, key);
        break;
    case GLFW_KEY_M:
        change_model(viewer);
        break;
    case GLFW_KEY_G:
        toggle_air(viewer);
        break;
    case GLFW_KEY_N:
        change_mesher(viewer);
        break;
    case GLFW_KEY_F:
        toggle_fullscreen(viewer);
        break;
    case GLFW_KEY_P:
        viewer->wants_picture = true;
        break;
    case GLFW_KEY_H:
        printf("%s", VIEWER_KEYS);
        fflush(stdout);
        break;
    default:
        if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) {
            fly_to_view(viewer, (size_t)(key - GLFW_KEY_1));
        }
        break;
    }
}

void controls_attach(struct viewer *viewer)
{
    GLFWwindow *window = viewer->window;
    glfwSetWindowUserPointer(window, viewer);
    glfwSetWindowRefreshCallback(window, note_damage);
    glfwSetFramebufferSizeCallback(window, note_size);
    glfwSetScrollCallback(window, note_scroll);
    glfwSetCursorPosCallback(window, note_cursor);
    glfwSetKeyCallback(window, note_key);
    glfwGetCursorPos(window, &viewer->cursor_x, &viewer->cursor_y);
}

// ---- what moves

static bool steer_camera(struct viewer *viewer, double elapsed_s)
{
    const double right = is_down(viewer, GLFW_KEY_D) - is_down(viewer, GLFW_KEY_A);
    const double up = is_down(viewer, GLFW_KEY_E) - is_down(viewer, GLFW_KEY_Q);
    const double forward = is_down(viewer, GLFW_KEY_W) - is_down(viewer, GLFW_KEY_S);
    if (right == 0.0 && up == 0.0 && forward == 0.0) {
        return false;
    }
    const double ground_m = trl_renderer_ground_altitude_m(
        viewer->renderer, viewer->view.latitude_rad, viewer->view.longitude_rad);
    const double height_m = fly_camera_altitude_m(&viewer->camera) - ground_m;
    const bool is_fast =
        is_down(viewer, GLFW_KEY_LEFT_SHIFT) || is_down(viewer, GLFW_KEY_RIGHT_SHIFT);
    const double step_m =
        fly_speed_m_s(height_m) * viewer->speed_factor * (is_fast ? 4.0 : 1.0) * elapsed_s;
    fly_move(&viewer->camera, (struct fly_step){right * step_m, up * step_m, forward * step_m});
    return true;
}

static bool drag_camera(struct viewer *viewer)
{
    if (viewer->drag_right_px == 0.0 && viewer->drag_up_px == 0.0) {
        return false;
    }
    int width = 1;
    int height = 1;
    glfwGetWindowSize(viewer->window, &width, &height);
    const double rad_per_px = viewer->camera.vertical_fov_rad / fmax(height, 1.0);
    const double right_rad = viewer->drag_right_px * rad_per_px;
    const double up_rad = viewer->drag_up_px * rad_per_px;
    if (viewer->looks_only) {
        fly_look(&viewer->camera, right_rad, up_rad);
    } else {
        fly_drag(&viewer->camera, right_rad, up_rad);
    }
    viewer->drag_right_px = 0.0;
    viewer->drag_up_px = 0.0;
    return true;
}

static bool turn_sun(struct viewer *viewer, double elapsed_s)
{
    const bool is_later =
        is_down(viewer, GLFW_KEY_RIGHT) || is_down(viewer, GLFW_KEY_RIGHT_BRACKET);
    const bool is_earlier =
        is_down(viewer, GLFW_KEY_LEFT) || is_down(viewer, GLFW_KEY_LEFT_BRACKET);
    const double season = is_down(viewer, GLFW_KEY_UP) - is_down(viewer, GLFW_KEY_DOWN);
    const double hour = is_earlier - is_later; // later: the subsolar point is farther west
    if (hour == 0.0 && season == 0.0) {
        return false;
    }
    trl_view *view = &viewer->view;
    const double step_rad = sun_speed_rad_s * elapsed_s;
    view->sun_longitude_or_azimuth_rad =
        remainder(view->sun_longitude_or_azimuth_rad + hour * step_rad, 2.0 * pi);
    view->sidereal_rad = remainder(view->sidereal_rad - hour * step_rad, 2.0 * pi);
    for (int i = 0; i < TRL_VIEW_MAX_BODIES; i++) { // the planet turns below them all
        view->bodies[i].longitude_or_azimuth_rad =
            remainder(view->bodies[i].longitude_or_azimuth_rad + hour * step_rad, 2.0 * pi);
    }
    view->sun_latitude_or_elevation_rad =
        fmin(fmax(view->sun_latitude_or_elevation_rad + season * step_rad, -pi / 2.0), pi / 2.0);
    return true;
}

// Follows the planned flight unless the user takes over.
static bool follow_flight(struct viewer *viewer, bool is_steered)
{
    if (viewer->flight_started_s < 0.0) {
        return false;
    }
    if (is_steered) {
        viewer->flight_started_s = -1.0;
        return false;
    }
    const double since_s = glfwGetTime() - viewer->flight_started_s;
    viewer->view = fly_flight_view(&viewer->flight, since_s);
    viewer->camera =
        fly_camera_from_view(&viewer->view, trl_scene_ground_radius_m(viewer->desc->scene));
    if (since_s >= viewer->flight.duration_s) {
        viewer->flight_started_s = -1.0;
    }
    return true;
}

bool controls_advance(struct viewer *viewer, double elapsed_s)
{
    const double step_s = fmin(elapsed_s, longest_step_s);
    const bool is_dragged = drag_camera(viewer);
    const bool is_flown = steer_camera(viewer, step_s);
    const bool is_followed = follow_flight(viewer, is_dragged || is_flown);
    const bool is_sun_turned = !is_followed && turn_sun(viewer, step_s);
    if (is_flown && !is_dragged) {
        fly_level(&viewer->camera, step_s);
    }
    fly_camera_to_view(&viewer->camera, &viewer->view);
    const double ground_m = trl_renderer_ground_altitude_m(
        viewer->renderer, viewer->view.latitude_rad, viewer->view.longitude_rad);
    if (fly_stay_above(&viewer->camera, ground_m)) {
        fly_camera_to_view(&viewer->camera, &viewer->view);
    }
    return is_dragged || is_flown || is_followed || is_sun_turned;
}
