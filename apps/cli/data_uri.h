// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_DATA_URI_H
#define CLI_DATA_URI_H
// Pictures as text, to stand inside a page.

#include <terrella/terrella.h>

// "data:image/png;base64,…" of a picture as trl_image_write_png takes it; free() it. NULL
// (reported) when it could not be made.
char *data_uri_of_picture(trl_context *ctx, uint32_t width, uint32_t height, const uint8_t *rgba);

#endif // CLI_DATA_URI_H
