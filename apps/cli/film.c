// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "film.h"

#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static const char *const video_suffixes[] = {"mp4", "mkv", "mov", "webm"};
enum { VIDEO_SUFFIXES = sizeof video_suffixes / sizeof *video_suffixes, DIGITS_MAX = 9 };

// The number's place in a path: "%d" or "%04d", once, in the file's name.
struct place {
    size_t begin, end; // of its letters
    int digits;
};

static bool find_place(const char *path, struct place *out)
{
    const char *percent = strchr(path, '%');
    const char *slash = strrchr(path, '/');
    if (!percent || (slash && slash > percent) || strchr(percent + 1, '%')) {
        return false;
    }
    char *end = NULL;
    const long digits = percent[1] == '0' ? strtol(percent + 1, &end, 10) : 0;
    const char *letter = digits > 0 ? end : percent + 1;
    if (*letter != 'd' || digits > DIGITS_MAX) {
        return false;
    }
    *out = (struct place){(size_t)(percent - path), (size_t)(letter + 1 - path), (int)digits};
    return true;
}

enum exit_status film_choose(const char *path, enum film_kind *out)
{
    const char *suffix = output_suffix(path);
    for (size_t i = 0; i < VIDEO_SUFFIXES; i++) {
        if (strcasecmp(suffix, video_suffixes[i]) == 0) {
            *out = FILM_VIDEO;
            return EXIT_OK;
        }
    }
    *out = strcasecmp(suffix, "exr") == 0 ? FILM_EXR : FILM_PNG;
    if (*out == FILM_PNG && strcasecmp(suffix, "png") != 0) {
        return report_error(EXIT_USAGE,
                            "render: --output: '%s' ends neither with .png or .exr (numbered "
                            "pictures) nor with .mp4, .mkv, .mov or .webm (a video)",
                            path);
    }
    struct place place;
    if (!find_place(path, &place)) {
        return report_error(EXIT_USAGE,
                            "render: --output: '%s' has no place for the number of a frame; write "
                            "it as in flight-%%04d.%s",
                            path, suffix);
    }
    return EXIT_OK;
}

enum exit_status film_check_size(enum film_kind kind, struct number_size size)
{
    if (kind == FILM_VIDEO && (size.width % 2 != 0 || size.height % 2 != 0)) {
        return report_error(EXIT_USAGE,
                            "render: --size: a video needs an even width and height; %ux%u is not",
                            size.width, size.height);
    }
    return EXIT_OK;
}

// The path of a frame; free() it.
static char *make_path(const char *pattern, uint32_t frame)
{
    struct place place;
    if (!find_place(pattern, &place)) {
        return NULL;
    }
    const size_t size = strlen(pattern) + 2 * DIGITS_MAX;
    char *path = malloc(size);
    if (path) {
        snprintf(path, size, "%.*s%0*u%s", (int)place.begin, pattern, place.digits, frame,
                 pattern + place.end);
    }
    return path;
}

// "NAME.part.mp4": ffmpeg knows the kind by the end of the name.
static char *make_part_path(const char *path)
{
    const size_t size = strlen(path) + sizeof ".part";
    const size_t stem = (size_t)(output_suffix(path) - path) - 1;
    char *part = malloc(size);
    if (part) {
        snprintf(part, size, "%.*s.part%s", (int)stem, path, path + stem);
    }
    return part;
}

static int spawn_encoder(struct film *film, const char *const words[], int input)
{
    posix_spawn_file_actions_t actions;
    if (posix_spawn_file_actions_init(&actions) != 0) {
        return ENOMEM;
    }
    int error = posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    if (error == 0) {
        // The words are not written to; the type is older than const.
        char *const *arguments = (char *const *)(uintptr_t)words;
        error = posix_spawnp(&film->encoder, "ffmpeg", &actions, NULL, arguments, environ);
    }
    posix_spawn_file_actions_destroy(&actions);
    film->encoder = error == 0 ? film->encoder : 0;
    return error;
}

static enum exit_status start_encoder(struct film *film)
{
    char size[32], rate[32];
    snprintf(size, sizeof size, "%ux%u", film->desc.size.width, film->desc.size.height);
    snprintf(rate, sizeof rate, "%.6g", film->desc.fps);
    const char *const words[] = {"ffmpeg",
                                 "-loglevel",
                                 "error",
                                 "-nostats",
                                 "-y",
                                 "-f",
                                 "rawvideo",
                                 "-pix_fmt",
                                 "rgba",
                                 "-s",
                                 size,
                                 "-r",
                                 rate,
                                 "-i",
                                 "-",
                                 "-an",
                                 "-pix_fmt",
                                 "yuv420p",
                                 "-colorspace",
                                 "bt709",
                                 "-vf",
                                 "scale=out_color_matrix=bt709:out_range=tv",
                                 film->part_path,
                                 NULL};
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
        return report_error(EXIT_FAILED, "no pipe to ffmpeg: %s", strerror(errno));
    }
    const int error = spawn_encoder(film, words, ends[0]);
    close(ends[0]);
    film->pipe = ends[1];
    if (error == ENOENT) {
        return report_error(EXIT_FAILED,
                            "%s: the program ffmpeg, which makes videos, is not installed; write "
                            "numbered pictures instead: -o flight-%%04d.png",
                            film->desc.path);
    }
    if (error != 0) {
        return report_error(EXIT_FAILED, "ffmpeg cannot be started: %s", strerror(error));
    }
    return EXIT_OK;
}

enum exit_status film_begin(trl_context *ctx, const struct film_desc *desc, struct film *out)
{
    *out = (struct film){.ctx = ctx, .desc = *desc, .pipe = -1};
    char *first = desc->kind == FILM_VIDEO ? NULL : make_path(desc->path, 0);
    enum exit_status status = output_check_writable(first ? first : desc->path);
    free(first);
    if (status == EXIT_OK && desc->kind == FILM_VIDEO) {
        signal(SIGPIPE, SIG_IGN); // an encoder that ended is told by write
        out->part_path = make_part_path(desc->path);
        status = out->part_path ? start_encoder(out)
                                : report_error(EXIT_FAILED, "%s: out of memory", desc->path);
    }
    if (status != EXIT_OK) {
        film_abort(out);
    }
    return status;
}

size_t film_frame_bytes(const struct film_desc *desc)
{
    const size_t values = (size_t)desc->size.width * desc->size.height * 4;
    return desc->kind == FILM_EXR ? values * sizeof(float) : values;
}

static enum exit_status pipe_frame(struct film *film, const uint8_t *bytes)
{
    size_t left = film_frame_bytes(&film->desc);
    while (left > 0) {
        const ssize_t done = write(film->pipe, bytes, left);
        if (done < 0 && errno == EINTR) {
            continue;
        }
        if (done <= 0) {
            return report_error(EXIT_FAILED, "%s: ffmpeg takes no more frames: %s", film->desc.path,
                                strerror(errno));
        }
        bytes += done;
        left -= (size_t)done;
    }
    return EXIT_OK;
}

static enum exit_status write_frame(struct film *film, const void *pixels)
{
    const struct number_size size = film->desc.size;
    char *path = make_path(film->desc.path, film->frames);
    if (!path) {
        return report_error(EXIT_FAILED, "%s: out of memory", film->desc.path);
    }
    const trl_result result =
        film->desc.kind == FILM_EXR
            ? trl_image_write_exr(film->ctx, path, size.width, size.height, pixels)
            : trl_image_write_png(film->ctx, path, size.width, size.height, pixels);
    free(path);
    return report_result(result);
}

enum exit_status film_add(struct film *film, const void *pixels)
{
    const enum exit_status status =
        film->desc.kind == FILM_VIDEO ? pipe_frame(film, pixels) : write_frame(film, pixels);
    film->frames += status == EXIT_OK ? 1 : 0;
    return status;
}

// Whether it ended well.
static bool end_encoder(struct film *film)
{
    int state = 0;
    if (film->pipe >= 0) {
        close(film->pipe); // the end of its input
    }
    film->pipe = -1;
    pid_t ended = film->encoder > 0 ? -1 : 0;
    while (film->encoder > 0 && (ended = waitpid(film->encoder, &state, 0)) < 0 && errno == EINTR) {
    }
    const bool is_good =
        film->encoder > 0 && ended == film->encoder && WIFEXITED(state) && WEXITSTATUS(state) == 0;
    film->encoder = 0;
    return is_good;
}

enum exit_status film_commit(struct film *film)
{
    enum exit_status status = EXIT_OK;
    if (film->desc.kind == FILM_VIDEO) {
        if (!end_encoder(film)) {
            status = report_error(EXIT_FAILED, "%s: ffmpeg made no video", film->desc.path);
        } else if (rename(film->part_path, film->desc.path) != 0) {
            status = report_error(EXIT_FAILED, "%s: %s", film->desc.path, strerror(errno));
        } else {
            free(film->part_path);
            film->part_path = NULL;
        }
    }
    film_abort(film);
    return status;
}

void film_abort(struct film *film)
{
    if (film->encoder > 0) {
        kill(film->encoder, SIGTERM);
    }
    end_encoder(film);
    if (film->part_path) {
        unlink(film->part_path);
    }
    free(film->part_path);
    film->part_path = NULL;
}
