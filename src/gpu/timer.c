// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "gpu/timer.h"

#include "gpu/internal.h"
#include "gpu/target.h"

// llvmpipe notes when a query begins in the tiles of the framebuffer that it drew to last. A
// context without a window has none before its first clear or draw, and a query that begins before
// that gives the time since the machine was started.
static trl_result clear_something(struct gpu *gpu)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "timer";
    struct gpu_texture texture;
    struct gpu_target target = {0};
    GLint before = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
    trl_result result = gpu_texture_init(gpu, &desc, &texture);
    if (result == TRL_OK) {
        const struct gpu_target_desc only = {
            .label = "timer", .color_count = 1, .colors[0].texture = &texture};
        result = gpu_target_init(gpu, &only, &target);
    }
    if (result == TRL_OK) {
        const float black[4] = {0};
        glBindFramebuffer(GL_FRAMEBUFFER, target.name);
        glClearBufferfv(GL_COLOR, 0, black);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)before);
    gpu_target_finish(&target);
    gpu_texture_finish(&texture);
    return result;
}

trl_result gpu_timer_init(struct gpu *gpu, struct gpu_timer *out)
{
    *out = (struct gpu_timer){.gpu = gpu};
    gpu->live_objects++;
    if (!gpu->caps.has_timer_query) {
        return TRL_OK;
    }
    glGenQueries(GPU_TIMER_MAX_SCOPES, out->queries);
    trl_result result = clear_something(gpu);
    if (result == TRL_OK) {
        result = gpu_check(gpu, "gpu_timer_init");
    }
    if (result != TRL_OK) {
        gpu_timer_finish(out);
    }
    return result;
}

void gpu_timer_finish(struct gpu_timer *timer)
{
    if (timer->gpu) {
        gpu_timer_end(timer);
        if (timer->gpu->caps.has_timer_query) {
            glDeleteQueries(GPU_TIMER_MAX_SCOPES, timer->queries);
        }
        timer->gpu->live_objects--;
    }
    *timer = (struct gpu_timer){0};
}

void gpu_timer_begin(struct gpu_timer *timer, const char *name)
{
    if (!timer || !timer->gpu->caps.has_timer_query) {
        return;
    }
    gpu_timer_end(timer);
    if (timer->count == GPU_TIMER_MAX_SCOPES) {
        return;
    }
    glBeginQuery(GL_TIME_ELAPSED, timer->queries[timer->count]);
    timer->names[timer->count++] = name;
    timer->is_open = true;
}

void gpu_timer_end(struct gpu_timer *timer)
{
    if (timer && timer->is_open) {
        glEndQuery(GL_TIME_ELAPSED);
        timer->is_open = false;
    }
}

static uint64_t read_ns(const struct gpu *gpu, GLuint query)
{
    GLuint64 ns = 0;
    if (gpu->caps.is_es) {
        glGetQueryObjectui64vEXT(query, GL_QUERY_RESULT, &ns);
    } else {
        glGetQueryObjectui64v(query, GL_QUERY_RESULT, &ns);
    }
    return ns;
}

size_t gpu_timer_collect(struct gpu_timer *timer, struct gpu_timer_row *rows, size_t capacity)
{
    if (!timer) {
        return 0;
    }
    gpu_timer_end(timer);
    const size_t count = timer->count < capacity ? timer->count : capacity;
    for (size_t i = 0; i < count; i++) {
        const uint64_t ns = read_ns(timer->gpu, timer->queries[i]);
        rows[i] = (struct gpu_timer_row){timer->names[i], (double)ns * 1e-6};
    }
    timer->count = 0;
    return count;
}
