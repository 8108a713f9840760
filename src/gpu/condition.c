// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "gpu/condition.h"

#include "gpu/internal.h"

trl_result gpu_condition_init(struct gpu *gpu, struct gpu_condition *out)
{
    *out = (struct gpu_condition){.gpu = gpu};
    gpu->live_objects++;
    if (gpu->caps.is_es) {
        return TRL_OK;
    }
    glGenQueries(1, &out->query);
    const trl_result result = gpu_check(gpu, "gpu_condition_init");
    if (result != TRL_OK) {
        gpu_condition_finish(out);
    }
    return result;
}

void gpu_condition_finish(struct gpu_condition *condition)
{
    if (condition->gpu) {
        if (condition->query) {
            glDeleteQueries(1, &condition->query);
        }
        condition->gpu->live_objects--;
    }
    *condition = (struct gpu_condition){0};
}

void gpu_condition_count(struct gpu_condition *condition)
{
    if (condition->query) {
        glBeginQuery(GL_ANY_SAMPLES_PASSED, condition->query);
    }
}

void gpu_condition_counted(struct gpu_condition *condition)
{
    if (condition->query) {
        glEndQuery(GL_ANY_SAMPLES_PASSED);
        condition->is_counted = true;
    }
}

void gpu_condition_begin(const struct gpu_condition *condition)
{
    if (condition && condition->is_counted) {
        glBeginConditionalRender(condition->query, GL_QUERY_WAIT);
    }
}

void gpu_condition_end(const struct gpu_condition *condition)
{
    if (condition && condition->is_counted) {
        glEndConditionalRender();
    }
}
