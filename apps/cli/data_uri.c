// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "data_uri.h"

#include "report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char head[] = "data:image/png;base64,";

// Base 64 (RFC 4648, with padding) behind the head. NULL when memory is out.
static char *encode(const uint8_t *bytes, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc(sizeof head + (count + 2) / 3 * 4);
    if (!text) {
        return NULL;
    }
    memcpy(text, head, sizeof head);
    char *out = text + strlen(head);
    for (size_t i = 0; i < count; i += 3) {
        const size_t left = count - i;
        const uint32_t word = (uint32_t)bytes[i] << 16 |
                              (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) |
                              (left > 2 ? (uint32_t)bytes[i + 2] : 0);
        *out++ = digits[word >> 18];
        *out++ = digits[word >> 12 & 63];
        *out++ = left > 1 ? digits[word >> 6 & 63] : '=';
        *out++ = left > 2 ? digits[word & 63] : '=';
    }
    *out = '\0';
    return text;
}

// The whole file behind the head; NULL (reported) when that fails.
static char *encode_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    long size = -1;
    if (file && fseek(file, 0, SEEK_END) == 0) {
        size = ftell(file);
        rewind(file);
    }
    uint8_t *bytes = size > 0 ? malloc((size_t)size) : NULL;
    char *text = NULL;
    if (bytes && fread(bytes, 1, (size_t)size, file) == (size_t)size) {
        text = encode(bytes, (size_t)size);
    }
    free(bytes);
    if (file) {
        fclose(file);
    }
    if (!text) {
        report_error(EXIT_FAILED, "%s: cannot be read back", path);
    }
    return text;
}

char *data_uri_of_picture(trl_context *ctx, uint32_t width, uint32_t height, const uint8_t *rgba)
{
    const char *folder = getenv("TMPDIR");
    char path[4096];
    snprintf(path, sizeof path, "%s/terrella-picture-XXXXXX", folder && *folder ? folder : "/tmp");
    const int descriptor = mkstemp(path);
    if (descriptor < 0) {
        report_error(EXIT_FAILED, "%s: cannot be made", path);
        return NULL;
    }
    close(descriptor);
    char *text = NULL;
    if (trl_image_write_png(ctx, path, width, height, rgba) == TRL_OK) {
        text = encode_file(path);
    }
    unlink(path);
    return text;
}
