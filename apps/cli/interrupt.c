// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "interrupt.h"

#include <signal.h>
#include <stddef.h>

// A signal handler has no other way to tell: the one variable of the program that is not passed
// along.
static volatile sig_atomic_t is_pending;

static void note_interrupt(int number)
{
    (void)number;
    is_pending = 1;
}

void interrupt_arm(void)
{
    struct sigaction action = {.sa_handler = note_interrupt};
    sigemptyset(&action.sa_mask);
    action.sa_flags = (int)SA_RESETHAND;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

bool interrupt_is_pending(void)
{
    return is_pending != 0;
}
