// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "canvas.h"

#include "font.h"

#include <stdlib.h>
#include <string.h>

bool canvas_init(int width, int height, struct canvas_color paper, struct canvas *out)
{
    *out = (struct canvas){.width = width, .height = height};
    out->rgba = malloc((size_t)width * (size_t)height * 4);
    if (out->rgba) {
        canvas_fill(out, (struct canvas_rect){0, 0, width, height}, paper);
    }
    return out->rgba != NULL;
}

void canvas_finish(struct canvas *canvas)
{
    free(canvas->rgba);
    *canvas = (struct canvas){0};
}

static int min_int(int a, int b)
{
    return a < b ? a : b;
}

static int max_int(int a, int b)
{
    return a > b ? a : b;
}

// The part of the rectangle that is on the sheet.
static struct canvas_rect clip(const struct canvas *canvas, struct canvas_rect rect)
{
    const int left = max_int(rect.x, 0);
    const int top = max_int(rect.y, 0);
    const int right = min_int(rect.x + rect.width, canvas->width);
    const int bottom = min_int(rect.y + rect.height, canvas->height);
    return (struct canvas_rect){left, top, max_int(right - left, 0), max_int(bottom - top, 0)};
}

static uint8_t *pixel_at(const struct canvas *canvas, int x, int y)
{
    return canvas->rgba + 4 * ((size_t)y * (size_t)canvas->width + (size_t)x);
}

void canvas_fill(struct canvas *canvas, struct canvas_rect rect, struct canvas_color color)
{
    const struct canvas_rect part = clip(canvas, rect);
    const uint8_t rgba[4] = {color.red, color.green, color.blue, 255};
    for (int y = part.y; y < part.y + part.height; y++) {
        for (int x = part.x; x < part.x + part.width; x++) {
            memcpy(pixel_at(canvas, x, y), rgba, sizeof rgba);
        }
    }
}

void canvas_put(struct canvas *canvas, struct canvas_rect rect, const uint8_t *rgba)
{
    const struct canvas_rect part = clip(canvas, rect);
    for (int y = part.y; y < part.y + part.height && part.width > 0; y++) {
        const size_t skipped =
            (size_t)(y - rect.y) * (size_t)rect.width + (size_t)(part.x - rect.x);
        uint8_t *row = pixel_at(canvas, part.x, y);
        memcpy(row, rgba + 4 * skipped, 4 * (size_t)part.width);
        for (int x = 0; x < part.width; x++) {
            row[4 * x + 3] = 255;
        }
    }
}

void canvas_write(struct canvas *canvas, struct canvas_rect rect, const struct canvas_text *text)
{
    const int scale = text->scale;
    for (size_t i = 0; text->words[i]; i++) {
        const int left = rect.x + (int)i * (FONT_WIDTH + 1) * scale;
        if (left + FONT_WIDTH * scale > rect.x + rect.width) {
            return;
        }
        for (int dot = 0; dot < FONT_WIDTH * FONT_HEIGHT; dot++) {
            const int x = dot % FONT_WIDTH;
            const int y = dot / FONT_WIDTH;
            if (font_has_dot(text->words[i], x, y)) {
                canvas_fill(
                    canvas,
                    (struct canvas_rect){left + x * scale, rect.y + y * scale, scale, scale},
                    text->color);
            }
        }
    }
}

int canvas_text_width(const struct canvas_text *text)
{
    const int signs = (int)strlen(text->words);
    return signs > 0 ? (signs * (FONT_WIDTH + 1) - 1) * text->scale : 0;
}
