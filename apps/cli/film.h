// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_FILM_H
#define CLI_FILM_H
// Where the frames of a flight go: numbered pictures, or a video that the program ffmpeg makes of
// what is piped to it.

#include "app.h"

#include <sys/types.h>

enum film_kind { FILM_PNG, FILM_EXR, FILM_VIDEO };

struct film_desc {
    const char *path; // "DIR/NAME-%04d.png", .exr, or NAME.mp4, .mkv, .mov, .webm
    enum film_kind kind;
    struct number_size size;
    double fps;
};

// The kind by the path alone. EXIT_USAGE is reported.
enum exit_status film_choose(const char *path, enum film_kind *out);

// EXIT_USAGE (reported) when no video can have that size.
enum exit_status film_check_size(enum film_kind kind, struct number_size size);

struct film {
    trl_context *ctx;
    struct film_desc desc;
    uint32_t frames; // added
    char *part_path; // owned; of a video until it is complete
    pid_t encoder;   // 0: none
    int pipe;        // to it; -1: none
};

// Fails (reported) when nothing can be written there, or there is no ffmpeg.
enum exit_status film_begin(trl_context *ctx, const struct film_desc *desc, struct film *out);

// Bytes that a frame has: 8-bit sRGB RGBA, or floats of linear RGBA for FILM_EXR; rows from the
// top.
size_t film_frame_bytes(const struct film_desc *desc);
enum exit_status film_add(struct film *film, const void *pixels);

// Completes it; EXIT_FAILED is reported, and no video is left then.
enum exit_status film_commit(struct film *film);
// Drops a video that is not complete; numbered pictures stay. A finished or zeroed one is a no-op.
void film_abort(struct film *film);

#endif // CLI_FILM_H
