// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

trl_result scene_read_numbers(const struct scene_node *object, const struct scene_number *numbers,
                              size_t count)
{
    trl_result result = TRL_OK;
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        const struct scene_node node = scene_node_member(object, numbers[i].key);
        result = scene_node_number_or(&node, &numbers[i].range, numbers[i].out);
    }
    return result;
}
