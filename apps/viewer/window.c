// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The viewer with GLFW: draws when something changed, sleeps otherwise.
#include "session.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static const double settle_s = 2.0;    // automatic exposure follows for about this long
static const double idle_wait_s = 0.5; // between looks at whether to stop
static const double title_interval_s = 0.5;
static const double file_interval_s = 0.5; // between looks at the scene's file

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
    char edited[EDIT_TEXT_MAX];
    edit_describe(&viewer->edit, edited);
    char title[384];
    snprintf(title, sizeof title,
             "%s: %s%s%s%.1f ms at %ux%u, %s, %.*f %s, EV %.1f%+.2f, speed %.3g, H: keys",
             trl_scene_name(viewer->desc->scene), edited, *edited ? ", " : "",
             trl_renderer_is_settled(viewer->renderer) ? "" : "solving, ", 1e3 * viewer->frame_s,
             viewer->drawn_width, viewer->drawn_height,
             trl_mesher_name(trl_renderer_mesher(viewer->renderer)), altitude_m < 1e5 ? 1 : 0,
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

static void follow_file(struct viewer *viewer, double now_s)
{
    if (now_s - viewer->last_look_s < file_interval_s) {
        return;
    }
    viewer->last_look_s = now_s;
    if (edit_follow_file(&viewer->edit)) {
        viewer->is_changed = true;
    }
}

// One turn of the loop. A frame is drawn while something moves (fewer pixels if need be), once more
// with all of them when it stops, and until the automatic exposure has settled.
static bool run_turn(struct viewer *viewer)
{
    const double now_s = glfwGetTime();
    const double elapsed_s = now_s - viewer->last_frame_s;
    const bool is_moving = controls_advance(viewer, elapsed_s);
    viewer->view.time_s = now_s; // waves run while frames are drawn
    if (is_moving || viewer->is_changed) {
        viewer->last_change_s = now_s;
    }
    follow_file(viewer, now_s);
    const bool is_solved = trl_renderer_is_settled(viewer->renderer);
    if (!is_solved || viewer->was_solving) {
        viewer->last_change_s = now_s; // what comes of it has to be exposed for
    }
    viewer->was_solving = !is_solved;
    const bool is_settling =
        !viewer->view.has_fixed_exposure && now_s - viewer->last_change_s < settle_s;
    const bool is_due = !is_solved || is_moving || viewer->was_moving || viewer->is_changed ||
                        is_settling || viewer->desc->frame_limit > 0;
    viewer->last_frame_s = now_s;
    if (is_due) {
        viewer->is_changed = false;
        const double scale = is_moving ? pace_scale(&viewer->pace) : 1.0;
        viewer->result = trl_renderer_accumulate_clouds(viewer->renderer, is_moving);
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
    controls_attach(viewer);
    return true;
}

static void fly_scene(struct viewer *viewer)
{
    trl_renderer_desc desc = trl_renderer_desc_default();
    // A flight goes on with what is there; a picture shall be complete.
    desc.waits_for_rasters = viewer->desc->screenshot != NULL;
    desc.scene = viewer->desc->scene;
    desc.gl = TRL_GL_CURRENT;
    desc.sky_model = viewer->desc->sky_model;
    desc.air = viewer->desc->air;
    desc.mesher = viewer->desc->mesher;
    desc.projective = viewer->desc->projective;
    desc.mesh_error_px = viewer->desc->mesh_error_px;
    desc.rayleigh = viewer->desc->rayleigh;
    viewer->result = trl_renderer_create(viewer->desc->ctx, &desc, &viewer->renderer);
    if (viewer->result != TRL_OK || !controls_resolve(viewer, &viewer->desc->view, &viewer->view)) {
        return;
    }
    viewer->camera =
        fly_camera_from_view(&viewer->view, trl_scene_ground_radius_m(viewer->desc->scene));
    edit_init(&viewer->edit, viewer->desc->ctx, viewer->renderer, viewer->desc->scene_path,
              viewer->desc->scene);
    run_loop(viewer);
    edit_finish(&viewer->edit);
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
