// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_CANVAS_H
#define CLI_CANVAS_H
// A sheet on which pictures, areas and words are put. 8-bit sRGB, rows from the top. What does not
// fit is cut off.

#include <stdbool.h>
#include <stdint.h>

struct canvas_color {
    uint8_t red, green, blue;
};

struct canvas_rect {
    int x, y, width, height; // of the upper left corner, in pixels
};

struct canvas {
    int width, height;
    uint8_t *rgba; // owned; width x height x 4, alpha 255
};

// False when memory is out.
bool canvas_init(int width, int height, struct canvas_color paper, struct canvas *out);
// A finished or zeroed one is a no-op.
void canvas_finish(struct canvas *canvas);

void canvas_fill(struct canvas *canvas, struct canvas_rect rect, struct canvas_color color);

// A picture of the rectangle's size; alpha is not looked at.
void canvas_put(struct canvas *canvas, struct canvas_rect rect, const uint8_t *rgba);

// Words of `scale` pixels a dot, from the rectangle's upper left corner on; its height is that of
// the letters, and what is wider than the rectangle is cut off.
struct canvas_text {
    int scale;
    struct canvas_color color;
    const char *words;
};
void canvas_write(struct canvas *canvas, struct canvas_rect rect, const struct canvas_text *text);

// Width of such words in pixels.
int canvas_text_width(const struct canvas_text *text);

#endif // CLI_CANVAS_H
