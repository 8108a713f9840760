// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TEST_BASE_FIXTURE_H
#define TEST_BASE_FIXTURE_H
// A context that remembers its last message, whose memory can run out, and a folder to write into.

#include "base/context.h"

struct fixture {
    trl_context *ctx;
    char folder[64]; // empty when set up, removed with all that is in it
    char last_message[2048];
    trl_log_item last_item;
    size_t messages;
    long live;             // blocks that are not released
    long allocations_left; // < 0: any number
};

int fixture_set_up(void **state);
int fixture_tear_down(void **state); // fails when a block is left

// A desc whose log and memory are the fixture's.
trl_context_desc fixture_desc(struct fixture *f);

// FOLDER/name, valid until the next call.
const char *fixture_path(struct fixture *f, const char *name);

#endif // TEST_BASE_FIXTURE_H
