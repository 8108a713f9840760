// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/mesher.h"

#include "terrain/projective.h"

struct kind {
    const char *name;
    trl_result (*create)(const struct surface *surface, struct mesher **out);
};

static const struct kind KINDS[MESHER_MAX_KINDS] = {
    [TRL_MESHER_HEMISPHERE] = {"hemisphere", hemisphere_create},
    [TRL_MESHER_PROJECTIVE] = {"projective", projective_create_default},
    [TRL_MESHER_QUADTREE] = {"quadtree", quadtree_create},
    [TRL_MESHER_TESSELLATED] = {"tessellated", hemisphere_create_tessellated},
};

const char *mesher_name(trl_mesher kind)
{
    return (unsigned)kind < MESHER_MAX_KINDS ? KINDS[kind].name : NULL;
}

trl_result mesher_create(const struct surface *surface, trl_mesher kind, struct mesher **out)
{
    *out = NULL;
    if (!mesher_name(kind)) {
        return trl_fail(surface->gpu->ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GENERAL,
                        "there is no mesher number %d", (int)kind);
    }
    return KINDS[kind].create(surface, out);
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
