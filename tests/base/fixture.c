// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "fixture.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void receive(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct fixture *f = user;
    (void)level;
    f->messages++;
    f->last_item = item;
    snprintf(f->last_message, sizeof f->last_message, "%s", message);
}

static bool may_allocate(struct fixture *f)
{
    if (f->allocations_left == 0) {
        return false;
    }
    f->allocations_left -= f->allocations_left > 0;
    return true;
}

static void *allocate(void *user, size_t bytes)
{
    struct fixture *f = user;
    void *block = may_allocate(f) ? malloc(bytes) : NULL;
    f->live += block != NULL;
    return block;
}

static void *reallocate(void *user, void *block, size_t bytes)
{
    if (!block) {
        return allocate(user, bytes);
    }
    return may_allocate(user) ? realloc(block, bytes) : NULL;
}

static void release(void *user, void *block)
{
    ((struct fixture *)user)->live -= block != NULL;
    free(block);
}

trl_context_desc fixture_desc(struct fixture *f)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.log = receive;
    desc.log_user = f;
    desc.allocator = (trl_allocator){allocate, reallocate, release, f};
    return desc;
}

const char *fixture_path(struct fixture *f, const char *name)
{
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", f->folder, name);
    return path;
}

int fixture_set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    if (!f) {
        return 1;
    }
    *state = f;
    f->allocations_left = -1;
    const char *temp = getenv("TMPDIR");
    snprintf(f->folder, sizeof f->folder, "%s/terrella-base-XXXXXX",
             temp && strlen(temp) < 32 ? temp : "/tmp");
    const trl_context_desc desc = fixture_desc(f);
    return mkdtemp(f->folder) && trl_context_create(&desc, &f->ctx) == TRL_OK ? 0 : 1;
}

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *at)
{
    (void)info;
    (void)kind;
    (void)at;
    return remove(path);
}

int fixture_tear_down(void **state)
{
    struct fixture *f = *state;
    trl_context_destroy(&f->ctx);
    nftw(f->folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    const bool is_clean = f->live == 0;
    free(f);
    return is_clean ? 0 : 1;
}
