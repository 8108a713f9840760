// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static trl_result fail_read(const trl_context *ctx, const char *path, const char *why)
{
    return trl_fail(ctx, TRL_ERROR_IO, TRL_LOG_ITEM_FILE_READ, "cannot read %s: %s", path, why);
}

static trl_result fail_write(const trl_context *ctx, const char *path, const char *why)
{
    return trl_fail(ctx, TRL_ERROR_IO, TRL_LOG_ITEM_FILE_WRITE, "cannot write %s: %s", path, why);
}

// Reads until `bytes` are there; false (errno, 0 where the file ends early) otherwise.
static bool read_all(int fd, char *data, size_t bytes)
{
    for (size_t have = 0; have < bytes;) {
        errno = 0;
        const ssize_t got = read(fd, data + have, bytes - have);
        if (got <= 0 && errno != EINTR) {
            return false;
        }
        have += got > 0 ? (size_t)got : 0;
    }
    return true;
}

static trl_result read_open_file(const trl_context *ctx, const char *path, int fd, size_t max_bytes,
                                 char **data, size_t *size)
{
    struct stat info;
    if (fstat(fd, &info) != 0) {
        return fail_read(ctx, path, strerror(errno));
    }
    if (!S_ISREG(info.st_mode)) {
        return fail_read(ctx, path, "not a file");
    }
    const size_t bytes = info.st_size > 0 ? (size_t)info.st_size : 0;
    if (bytes > max_bytes) {
        return fail_read(ctx, path, "larger than allowed");
    }
    char *read_data = mem_alloc(ctx, bytes + 1, 1);
    if (!read_data) {
        return TRL_ERROR_MEMORY;
    }
    if (!read_all(fd, read_data, bytes)) {
        const trl_result result = fail_read(ctx, path, errno ? strerror(errno) : "it ends early");
        mem_free(ctx, read_data);
        return result;
    }
    *data = read_data;
    *size = bytes;
    return TRL_OK;
}

trl_result file_read(const trl_context *ctx, const char *path, size_t max_bytes, char **data,
                     size_t *size)
{
    *data = NULL;
    *size = 0;
    // Opening a pipe would wait for somebody to write into it.
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) {
        return fail_read(ctx, path, strerror(errno));
    }
    const trl_result result = read_open_file(ctx, path, fd, max_bytes, data, size);
    close(fd);
    return result;
}

trl_result file_replacement_begin(const trl_context *ctx, const char *path,
                                  struct file_replacement *out)
{
    *out = (struct file_replacement){0};
    out->path = mem_strdup(ctx, path);
    out->temp_path = mem_printf(ctx, "%s.%ld.partial", path, (long)getpid());
    if (!out->path || !out->temp_path) {
        mem_free(ctx, out->path);
        mem_free(ctx, out->temp_path);
        *out = (struct file_replacement){0};
        return TRL_ERROR_MEMORY;
    }
    struct stat info;
    const bool is_special = stat(path, &info) == 0 && !S_ISREG(info.st_mode);
    const int fd = is_special ? -1 : open(out->temp_path, O_CREAT | O_WRONLY | O_TRUNC, 0666);
    if (fd < 0) {
        const trl_result result =
            fail_write(ctx, path, is_special ? "not a regular file" : strerror(errno));
        mem_free(ctx, out->path);
        mem_free(ctx, out->temp_path);
        *out = (struct file_replacement){0};
        return result;
    }
    close(fd);
    return TRL_OK;
}

// The data must be on disk before the name is, or a power cut could leave a named empty file.
static bool sync_file(const char *path)
{
    const int fd = open(path, O_WRONLY);
    if (fd < 0) {
        return false;
    }
    const bool is_synced = fsync(fd) == 0;
    return close(fd) == 0 && is_synced;
}

trl_result file_replacement_commit(const trl_context *ctx, struct file_replacement *r)
{
    if (!sync_file(r->temp_path) || rename(r->temp_path, r->path) != 0) {
        const trl_result result = fail_write(ctx, r->path, strerror(errno));
        file_replacement_abort(ctx, r);
        return result;
    }
    mem_free(ctx, r->path);
    mem_free(ctx, r->temp_path);
    *r = (struct file_replacement){0};
    return TRL_OK;
}

void file_replacement_abort(const trl_context *ctx, struct file_replacement *r)
{
    if (r->temp_path) {
        unlink(r->temp_path);
    }
    mem_free(ctx, r->path);
    mem_free(ctx, r->temp_path);
    *r = (struct file_replacement){0};
}

trl_result file_write(const trl_context *ctx, const char *path, const void *data, size_t size)
{
    struct file_replacement r;
    trl_result result = file_replacement_begin(ctx, path, &r);
    if (result != TRL_OK) {
        return result;
    }
    FILE *file = fopen(r.temp_path, "wb");
    bool is_written = file != NULL && fwrite(data, 1, size, file) == size;
    if (file) {
        is_written = fclose(file) == 0 && is_written;
    }
    if (!is_written) {
        result = fail_write(ctx, path, strerror(errno));
        file_replacement_abort(ctx, &r);
        return result;
    }
    return file_replacement_commit(ctx, &r);
}

// One folder, there already or made now; false (errno) otherwise.
static bool make_dir(const char *path)
{
    struct stat info;
    if (mkdir(path, 0777) == 0) {
        return true;
    }
    if (errno != EEXIST || stat(path, &info) != 0) {
        return false;
    }
    errno = ENOTDIR;
    return S_ISDIR(info.st_mode);
}

trl_result file_make_dirs(const trl_context *ctx, const char *path)
{
    char *partial = mem_strdup(ctx, path);
    if (!partial) {
        return TRL_ERROR_MEMORY;
    }
    trl_result result = TRL_OK;
    for (char *at = partial + 1; result == TRL_OK; at++) {
        if (*at != '/' && *at != '\0') {
            continue;
        }
        const char kept = *at;
        *at = '\0';
        if (!make_dir(partial)) {
            result = fail_write(ctx, partial, strerror(errno));
        }
        *at = kept;
        if (kept == '\0') {
            break;
        }
    }
    mem_free(ctx, partial);
    return result;
}
