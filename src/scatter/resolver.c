// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/resolver.h"

#include "scatter/medium_edit.h"

#include <pthread.h>
#include <stdatomic.h>

struct resolver {
    const trl_context *ctx;
    trl_context quiet; // of the thread: progress asks whether to stop, and stopping is no error
    struct medium medium;
    struct atmosphere_desc desc; // of the fine one
    pthread_t thread;
    pthread_mutex_t lock; // of `solved`
    struct atmosphere *solved;
    atomic_bool is_cancelled, is_done;
};

static bool goes_on(void *user, const char *stage, double fraction)
{
    (void)stage;
    (void)fraction;
    struct resolver *r = user;
    return !atomic_load(&r->is_cancelled);
}

// False when nothing came of it, for whatever reason.
static bool solve(struct resolver *r, const struct atmosphere_desc *desc)
{
    struct atmosphere *a = NULL;
    if (atmosphere_create(&r->quiet, &r->medium, desc, &a) != TRL_OK || !a) {
        return false;
    }
    a->ctx = r->ctx; // from here on it is anybody's
    pthread_mutex_lock(&r->lock);
    struct atmosphere *late = r->solved;
    r->solved = a;
    pthread_mutex_unlock(&r->lock);
    atmosphere_destroy(&late);
    return true;
}

static void *run(void *user)
{
    struct resolver *r = user;
    struct atmosphere_desc desc = r->desc;
    desc.only_from_cache = true;
    if (!solve(r, &desc)) {
        desc.only_from_cache = false;
        desc.quality = ATMOSPHERE_DRAFT;
        if (solve(r, &desc)) {
            (void)solve(r, &r->desc);
        }
    }
    atomic_store(&r->is_done, true);
    return NULL;
}

static void log_but_cancellation(void *user, trl_log_level level, trl_log_item item,
                                 const char *message)
{
    const struct resolver *r = user;
    if (item != TRL_LOG_ITEM_CANCELLED && r->ctx->desc.log) {
        r->ctx->desc.log(r->ctx->desc.log_user, level, item, message);
    }
}

trl_result resolver_start(const trl_context *ctx, const struct medium *medium,
                          const struct atmosphere_desc *desc, struct resolver **out)
{
    *out = NULL;
    struct resolver *r = mem_alloc(ctx, 1, sizeof *r);
    if (!r) {
        return TRL_ERROR_MEMORY;
    }
    r->ctx = ctx;
    r->quiet = *ctx;
    r->quiet.desc.progress = goes_on;
    r->quiet.desc.progress_user = r;
    r->quiet.desc.log = log_but_cancellation;
    r->quiet.desc.log_user = r;
    r->desc = *desc;
    trl_result result = medium_copy(ctx, medium, &r->medium);
    if (result == TRL_OK) {
        pthread_mutex_init(&r->lock, NULL);
        if (pthread_create(&r->thread, NULL, run, r) != 0) {
            pthread_mutex_destroy(&r->lock);
            result = trl_fail(ctx, TRL_ERROR_MEMORY, TRL_LOG_ITEM_SOLVER,
                              "no thread can be started to solve the atmosphere");
        }
    }
    if (result != TRL_OK) {
        medium_finish(ctx, &r->medium);
        mem_free(ctx, r);
        return result;
    }
    *out = r;
    return TRL_OK;
}

struct atmosphere *resolver_take(struct resolver *resolver)
{
    pthread_mutex_lock(&resolver->lock);
    struct atmosphere *solved = resolver->solved;
    resolver->solved = NULL;
    pthread_mutex_unlock(&resolver->lock);
    return solved;
}

bool resolver_is_done(struct resolver *resolver)
{
    return atomic_load(&resolver->is_done);
}

void resolver_destroy(struct resolver **resolver)
{
    struct resolver *r = *resolver;
    if (!r) {
        return;
    }
    atomic_store(&r->is_cancelled, true);
    pthread_join(r->thread, NULL);
    pthread_mutex_destroy(&r->lock);
    atmosphere_destroy(&r->solved);
    medium_finish(r->ctx, &r->medium);
    mem_free(r->ctx, r);
    *resolver = NULL;
}
