// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef VIEWER_EDIT_H
#define VIEWER_EDIT_H
// The atmosphere changed while it is looked at: by keys, and by saving the scene's file.

#include <stdbool.h>
#include <terrella/terrella.h>

enum { EDIT_MAX_CONSTITUENTS = 16, EDIT_TEXT_MAX = 96 };

struct edit {
    trl_context *ctx;
    trl_renderer *renderer;
    const char *path;       // of the scene's file
    const trl_scene *first; // what the renderer was made for
    trl_scene *saved;       // owned: the file as it was saved last; NULL: as it was at first
    double stamp;           // of the file: when it was written, in seconds, and how large it was
    size_t chosen;          // constituent that keys change
    trl_constituent_change changes[EDIT_MAX_CONSTITUENTS];
};

void edit_init(struct edit *edit, trl_context *ctx, trl_renderer *renderer, const char *path,
               const trl_scene *scene);
void edit_finish(struct edit *edit);

// The scene that the keys change.
const trl_scene *edit_scene(const struct edit *edit);

// Keys: the next constituent; its amount times a factor; its asymmetry by a step, where it has one.
// False when nothing came of it (the log says why).
void edit_choose_next(struct edit *edit);
bool edit_scale(struct edit *edit, double factor);
bool edit_turn_asymmetry(struct edit *edit, double step);

// Looks at the file; true when it was saved since, and the renderer has gone over to its
// atmosphere. A file with mistakes is left alone until it is saved again; the log says where they
// are.
bool edit_follow_file(struct edit *edit);

// "haze x 1.41, g 0.70"; empty while nothing was chosen.
void edit_describe(const struct edit *edit, char text[EDIT_TEXT_MAX]);

#endif // VIEWER_EDIT_H
