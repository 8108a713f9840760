// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// A name beside `path` for mkstemp; owned by the caller; NULL when memory is out.
static char *name_temporary(const char *path)
{
    const size_t size = strlen(path) + sizeof ".XXXXXX";
    char *name = malloc(size);
    if (name) {
        snprintf(name, size, "%s.XXXXXX", path);
    }
    return name;
}

static enum exit_status refuse(const char *path, const char *why)
{
    return report_error(EXIT_FAILED, "%s: cannot be written: %s", path, why);
}

// Makes the temporary file; *descriptor and *temp_path are the caller's on success.
static enum exit_status open_temporary(const char *path, int *descriptor, char **temp_path)
{
    struct stat existing;
    // Renaming over a device such as /dev/null would replace it for everyone.
    if (stat(path, &existing) == 0 && !S_ISREG(existing.st_mode)) {
        return refuse(path, S_ISDIR(existing.st_mode) ? "it is a folder" : "it is not a file");
    }
    char *name = name_temporary(path);
    if (!name) {
        return refuse(path, strerror(ENOMEM));
    }
    const int opened = mkstemp(name);
    if (opened < 0) {
        free(name);
        return refuse(path, strerror(errno));
    }
    *descriptor = opened;
    *temp_path = name;
    return EXIT_OK;
}

enum exit_status output_check_writable(const char *path)
{
    int descriptor = -1;
    char *temp_path = NULL;
    const enum exit_status status = open_temporary(path, &descriptor, &temp_path);
    if (status == EXIT_OK) {
        close(descriptor);
        unlink(temp_path);
        free(temp_path);
    }
    return status;
}

const char *output_suffix(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash ? slash : path, '.');
    return dot ? dot + 1 : "";
}

enum exit_status output_text_begin(const char *path, struct output_text *out)
{
    *out = (struct output_text){.path = path, .stream = stdout};
    if (!path) {
        return EXIT_OK;
    }
    int descriptor = -1;
    const enum exit_status status = open_temporary(path, &descriptor, &out->temp_path);
    if (status != EXIT_OK) {
        *out = (struct output_text){0};
        return status;
    }
    // mkstemp keeps others out; a result gets the permissions that any new file would have.
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor, 0666 & ~mask);
    out->stream = fdopen(descriptor, "w");
    if (!out->stream) {
        close(descriptor);
        output_text_abort(out);
        return refuse(path, strerror(ENOMEM));
    }
    return EXIT_OK;
}

enum exit_status output_text_commit(struct output_text *text)
{
    const char *path = text->path;
    FILE *stream = text->stream;
    bool is_good = fflush(stream) == 0 && !ferror(stream);
    int why = errno;
    if (path) {
        is_good = fclose(stream) == 0 && is_good;
        text->stream = NULL;
        if (is_good && rename(text->temp_path, path) != 0) {
            is_good = false;
            why = errno;
        }
    }
    if (!is_good) {
        output_text_abort(text);
        return refuse(path ? path : "(standard output)", strerror(why));
    }
    free(text->temp_path);
    *text = (struct output_text){0};
    return EXIT_OK;
}

void output_text_abort(struct output_text *text)
{
    if (text->temp_path) {
        if (text->stream) {
            fclose(text->stream);
        }
        unlink(text->temp_path);
        free(text->temp_path);
    }
    *text = (struct output_text){0};
}
