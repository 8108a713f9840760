// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

#include <string.h>

// The words of trl_sky_model, in its order.
static const char *const names[] = {[TRL_SKY_SPECTRAL] = "spectral",
                                    [TRL_SKY_SINGLE] = "single",
                                    [TRL_SKY_RAYLEIGH] = "rayleigh",
                                    [TRL_SKY_REFERENCE] = "reference"};

enum { MODEL_COUNT = sizeof names / sizeof *names };

const char *trl_sky_model_name(trl_sky_model model)
{
    return (unsigned)model < MODEL_COUNT ? names[model] : NULL;
}

bool trl_sky_model_find(const char *name, trl_sky_model *out)
{
    for (int i = 0; name && i < MODEL_COUNT; i++) {
        if (strcmp(name, names[i]) == 0) {
            *out = (trl_sky_model)i;
            return true;
        }
    }
    return false;
}

trl_result scene_read_sky_model(const struct scene_node *root, struct trl_scene *out)
{
    const struct scene_node node = scene_node_member(root, "sky_model");
    if (!node.value) {
        return TRL_OK; // spectral
    }
    // Pictures are not made by paths, which come last.
    const char *words[MODEL_COUNT] = {NULL};
    memcpy(words, names, (MODEL_COUNT - 1) * sizeof *words);
    size_t model = 0;
    const trl_result result = scene_node_word(&node, words, &model);
    out->sky_model = (trl_sky_model)model;
    return result;
}
