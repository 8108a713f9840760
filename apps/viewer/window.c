// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The viewer with GLFW: turns input into flight, draws when something changed, sleeps otherwise.
#include "fly.h"
#include "pace.h"
#include "viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double settle_s = 2.0;    // automatic exposure follows for about this long
static const double idle_wait_s = 0.5; // between looks at whether to stop
static const double title_interval_s = 0.5;
static const double longest_step_s = 0.25; // a slow frame must not throw the camera far
static const double sun_speed_rad_s = 0.35;
static const double pi = 3.14159265358979323846;

struct viewer {
    const struct viewer_desc *desc;
    GLFWwindow *window;
    trl_renderer *renderer;
    struct fly_camera camera;
    trl_view view; // sun and exposure, and the camera as last drawn
    struct fly_flight flight;
    double flight_started_s; // negative: not flying by itself
    struct pace pace;
    double speed_factor;
    double drag_right_px, drag_up_px; // since the last frame
    bool looks_only;                  // dragged with the right button
    double cursor_x, cursor_y;
    double last_frame_s, last_change_s, last_title_s, frame_s;
    bool is_changed;    // a frame is due
    bool was_moving;    // the last frame was
    bool wants_picture; // P was pressed
    uint64_t frame_count;
    uint32_t drawn_width, drawn_height;
    int saved[4]; // window's place and size before full screen
    trl_result result;
};

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

// The view as the renderer sees it, fit to start or end a flight.
static bool resolve(struct viewer *viewer, const trl_view *view, trl_view *out)
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
        !resolve(viewer, &view, &view)) {
        return;
    }
    viewer->flight = fly_flight_plan(&viewer->view, &view, trl_scene_ground_radius_m(scene));
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

// Everything that time and input do to the view. True while something moves.
static bool advance(struct viewer *viewer, double elapsed_s)
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

// ---- what is drawn

static void show_title(struct viewer *viewer, double now_s)
{
    if (now_s - viewer->last_title_s < title_interval_s) {
        return;
    }
    viewer->last_title_s = now_s;
    double ev100 = 0.0;
    if (trl_renderer_exposure(viewer->renderer, &ev100) != TRL_OK) {
        return;
    }
    const double altitude_m = viewer->view.altitude_m;
    char title[256];
    snprintf(title, sizeof title,
             "%s: %.1f ms at %ux%u, %.*f %s, EV %.1f%+.2f, speed %.3g, H: keys",
             trl_scene_name(viewer->desc->scene), 1e3 * viewer->frame_s, viewer->drawn_width,
             viewer->drawn_height, altitude_m < 1e5 ? 1 : 0,
             altitude_m < 1e4 ? altitude_m : 1e-3 * altitude_m, altitude_m < 1e4 ? "m" : "km",
             ev100, viewer->view.exposure_bias_ev, viewer->speed_factor);
    glfwSetWindowTitle(viewer->window, title);
}

// Draws at a part of the framebuffer's size and shows it. False on failure.
static bool draw_frame(struct viewer *viewer, double scale, double elapsed_s)
{
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(viewer->window, &width, &height);
    if (width < 1 || height < 1) {
        return true; // minimised
    }
    viewer->drawn_width = pace_pixels((uint32_t)width, scale);
    viewer->drawn_height = pace_pixels((uint32_t)height, scale);
    const double begun_s = glfwGetTime();
    viewer->result =
        trl_renderer_draw(viewer->renderer, &viewer->view, viewer->drawn_width,
                          viewer->drawn_height, viewer->frame_count == 0 ? 0.0 : elapsed_s);
    if (viewer->result == TRL_OK) {
        viewer->result =
            trl_renderer_present(viewer->renderer, 0, 0, (uint32_t)width, (uint32_t)height);
    }
    if (viewer->result != TRL_OK) {
        return false;
    }
    trl_renderer_wait(viewer->renderer);
    viewer->frame_s = glfwGetTime() - begun_s;
    glfwSwapBuffers(viewer->window);
    viewer->frame_count++;
    return true;
}

// Writes what was drawn last. False on failure.
static bool save_picture(struct viewer *viewer, const char *path)
{
    uint8_t *pixels = malloc((size_t)viewer->drawn_width * viewer->drawn_height * 4 + 4);
    if (!pixels) {
        viewer->result = TRL_ERROR_MEMORY;
        return false;
    }
    viewer->result = trl_renderer_read_rgba8(viewer->renderer, pixels);
    if (viewer->result == TRL_OK) {
        viewer->result = trl_image_write_png(viewer->desc->ctx, path, viewer->drawn_width,
                                             viewer->drawn_height, pixels);
    }
    free(pixels);
    return viewer->result == TRL_OK;
}

// A picture of all the window's pixels under the first free name. That it could not be written (the
// log says why) is no reason to stop flying.
static void save_numbered_picture(struct viewer *viewer)
{
    viewer->wants_picture = false;
    char path[32] = "";
    for (int i = 1; i < 10000; i++) {
        snprintf(path, sizeof path, "terrella-%04d.png", i);
        if (access(path, F_OK) != 0) {
            break;
        }
    }
    if (draw_frame(viewer, 1.0, 0.0) && viewer->frame_count > 0 && save_picture(viewer, path)) {
        printf("wrote %s\n", path);
        fflush(stdout);
    }
    viewer->result = TRL_OK;
}

static bool is_minimised(const struct viewer *viewer)
{
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(viewer->window, &width, &height);
    return width < 1 || height < 1 || glfwGetWindowAttrib(viewer->window, GLFW_ICONIFIED);
}

// One turn of the loop. A frame is drawn while something moves (fewer pixels if need be), once more
// with all of them when it stops, and until the automatic exposure has settled.
static bool run_turn(struct viewer *viewer)
{
    const double now_s = glfwGetTime();
    const double elapsed_s = now_s - viewer->last_frame_s;
    const bool is_moving = advance(viewer, elapsed_s);
    if (is_moving || viewer->is_changed) {
        viewer->last_change_s = now_s;
    }
    const bool is_settling =
        !viewer->view.has_fixed_exposure && now_s - viewer->last_change_s < settle_s;
    const bool is_due = is_moving || viewer->was_moving || viewer->is_changed || is_settling ||
                        viewer->desc->frame_limit > 0;
    viewer->last_frame_s = now_s;
    if (is_due) {
        viewer->is_changed = false;
        const double scale = is_moving ? pace_scale(&viewer->pace) : 1.0;
        if (!draw_frame(viewer, scale, elapsed_s)) {
            return false;
        }
        if (is_moving) {
            pace_learn(&viewer->pace, viewer->frame_s);
        }
        viewer->was_moving = is_moving;
    }
    if (viewer->wants_picture) {
        save_numbered_picture(viewer);
    }
    show_title(viewer, now_s);
    if (is_due) {
        glfwPollEvents();
    } else {
        glfwWaitEventsTimeout(idle_wait_s);
        // Time asleep is no time of flight.
        viewer->last_frame_s = glfwGetTime();
    }
    return true;
}

static bool is_finished(const struct viewer *viewer)
{
    const struct viewer_desc *desc = viewer->desc;
    return glfwWindowShouldClose(viewer->window) || desc->is_stopped() ||
           (desc->frame_limit > 0 && viewer->frame_count >= desc->frame_limit);
}

static void run_loop(struct viewer *viewer)
{
    viewer->last_frame_s = glfwGetTime();
    viewer->last_change_s = viewer->last_frame_s;
    while (!is_finished(viewer)) {
        if (is_minimised(viewer)) {
            glfwWaitEventsTimeout(idle_wait_s);
            viewer->is_changed = true;
        } else if (!run_turn(viewer)) {
            return;
        }
    }
    if (viewer->desc->screenshot && viewer->frame_count > 0) {
        save_picture(viewer, viewer->desc->screenshot);
    }
}

// ---- beginning and end

static bool open_window(struct viewer *viewer, char message[VIEWER_MESSAGE_MAX])
{
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    // The renderer has its own targets; the window's is only copied to.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    viewer->window = glfwCreateWindow((int)viewer->desc->width, (int)viewer->desc->height,
                                      "Terrella: preparing", NULL, NULL);
    if (!viewer->window) {
        const char *why = NULL;
        glfwGetError(&why);
        snprintf(message, VIEWER_MESSAGE_MAX, "no window with OpenGL 3.3: %s",
                 why ? why : "unknown reason");
        return false;
    }
    glfwMakeContextCurrent(viewer->window);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(viewer->window, viewer);
    glfwSetWindowRefreshCallback(viewer->window, note_damage);
    glfwSetFramebufferSizeCallback(viewer->window, note_size);
    glfwSetScrollCallback(viewer->window, note_scroll);
    glfwSetCursorPosCallback(viewer->window, note_cursor);
    glfwSetKeyCallback(viewer->window, note_key);
    glfwGetCursorPos(viewer->window, &viewer->cursor_x, &viewer->cursor_y);
    return true;
}

static void fly_scene(struct viewer *viewer)
{
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = viewer->desc->scene;
    desc.gl = TRL_GL_CURRENT;
    viewer->result = trl_renderer_create(viewer->desc->ctx, &desc, &viewer->renderer);
    if (viewer->result != TRL_OK || !resolve(viewer, &viewer->desc->view, &viewer->view)) {
        return;
    }
    viewer->camera =
        fly_camera_from_view(&viewer->view, trl_scene_ground_radius_m(viewer->desc->scene));
    run_loop(viewer);
}

trl_result viewer_run(const struct viewer_desc *desc, char message[VIEWER_MESSAGE_MAX])
{
    message[0] = '\0';
    if (!glfwInit()) {
        const char *why = NULL;
        glfwGetError(&why);
        snprintf(message, VIEWER_MESSAGE_MAX,
                 "no display to open a window on (%s); xvfb-run gives a virtual one",
                 why ? why : "unknown reason");
        return TRL_ERROR_UNSUPPORTED;
    }
    struct viewer viewer = {.desc = desc,
                            .flight_started_s = -1.0,
                            .speed_factor = 1.0,
                            .is_changed = true,
                            .result = TRL_ERROR_UNSUPPORTED};
    if (open_window(&viewer, message)) {
        fly_scene(&viewer);
        trl_renderer_destroy(&viewer.renderer); // while its context is current
        glfwDestroyWindow(viewer.window);
    }
    glfwTerminate();
    return viewer.result;
}

const char *viewer_library(void)
{
    return glfwGetVersionString();
}
