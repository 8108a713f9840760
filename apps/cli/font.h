// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_FONT_H
#define CLI_FONT_H
// Letters of five by seven dots, and one row of dots below the base line, for labels in pictures.

#include <stdbool.h>

enum { FONT_WIDTH = 5, FONT_HEIGHT = 8 };

// Whether the dot at column x and row y (from the top) of the sign is set. What is not printable
// ASCII looks like a question mark.
bool font_has_dot(char sign, int x, int y);

#endif // CLI_FONT_H
