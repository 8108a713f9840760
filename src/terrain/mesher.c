// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/mesher.h"

trl_result mesher_create(const struct surface *surface, enum mesher_kind kind, struct mesher **out)
{
    *out = NULL;
    switch (kind) {
    case MESHER_HEMISPHERE:
        return hemisphere_create(surface, out);
    case MESHER_KIND_COUNT:
        break;
    }
    return trl_fail(surface->gpu->ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GENERAL,
                    "there is no mesher number %d", (int)kind);
}

void mesher_destroy(struct mesher **mesher)
{
    if (*mesher) {
        (*mesher)->ops->destroy(*mesher);
    }
    *mesher = NULL;
}

trl_result mesher_update(struct mesher *mesher, const struct camera *camera)
{
    return mesher->ops->update(mesher, camera);
}

trl_result mesher_draw(struct mesher *mesher, const struct gpu_target *target)
{
    return mesher->ops->draw(mesher, target);
}
