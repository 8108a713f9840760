// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef VIEWER_VIEWER_H
#define VIEWER_VIEWER_H
// The window in which a scene is flown through.

#include <terrella/terrella.h>

#define VIEWER_KEYS                                                                                \
    "  mouse drag        look around; from orbit: turn the planet (right button: look)\n"          \
    "  W S A D Q E       fly forward, back, left, right, down, up\n"                               \
    "  mouse wheel       faster or slower; Shift: four times as fast\n"                            \
    "  left, right       turn the sun by time of day (also [ and ])\n"                             \
    "  up, down          turn the sun by season\n"                                                 \
    "  + -  0            brighter, darker; automatic exposure without bias\n"                      \
    "  T  M              other tone curve; other model of the sky\n"                               \
    "  G  N              shadows in the air, or none; other mesh of the ground\n"                  \
    "  C                 choose a constituent of the air, one after the other\n"                   \
    "  , .               less, more of it\n"                                                       \
    "  ; '               scatter it less, more forward (asymmetry g)\n"                            \
    "  1 … 9             fly to a view of the scene\n"                                           \
    "  F  P  H           full screen; save a picture; print these keys\n"                          \
    "  Esc               quit\n"                                                                   \
    "\n"                                                                                           \
    "While something moves, fewer pixels are drawn if need be, and clouds come\n"                  \
    "together over four frames; when it stops, all at once.\n"

enum { VIEWER_MESSAGE_MAX = 256 };

struct viewer_desc {
    trl_context *ctx;
    const trl_scene *scene;
    const char *scene_path; // the file, which is followed when it is saved; NULL: not followed
    int sky_model;          // as in trl_renderer_desc
    trl_air air;            // to begin with
    trl_mesher mesher;      // to begin with
    trl_projective_desc projective;    // of that mesher
    double mesh_error_px;              // as in trl_renderer_desc
    const trl_rayleigh_desc *rayleigh; // as in trl_renderer_desc
    trl_view view;                     // where it begins
    uint32_t width, height;            // of the window
    uint64_t frame_limit;              // quit after so many frames; 0: never
    const char *screenshot; // PNG written from the last frame before it quits by itself; NULL: none
    bool (*is_stopped)(void); // asked once a frame: quit?
};

// Opens the window and returns when it is closed. What the library does not log itself is put into
// `message`, else that is empty.
trl_result viewer_run(const struct viewer_desc *desc, char message[VIEWER_MESSAGE_MAX]);

// The library that makes the window, with its version.
const char *viewer_library(void);

#endif // VIEWER_VIEWER_H
