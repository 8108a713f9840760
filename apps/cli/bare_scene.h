// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_BARE_SCENE_H
#define CLI_BARE_SCENE_H
// The scene that ships as bare-sphere.json, with one thing more to be measured.

#include "app.h"

// With more keys, as `"key": value`. Failures are reported.
trl_result bare_scene_make(const struct app *app, const char *name, const char *keys,
                           trl_scene **out);

// With cumulus of that cover.
trl_result bare_scene_make_cloudy(const struct app *app, double cover, trl_scene **out);

#endif // CLI_BARE_SCENE_H
