// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "idle_threads.h"

#include <limits.h>
#include <stdlib.h>
#include <unistd.h>

void idle_threads_sleep(char **argv)
{
    static const char policy[] = "OMP_WAIT_POLICY";
    if (getenv(policy) || getenv("GOMP_SPINCOUNT")) {
        return; // asked for otherwise, or started once more already
    }
    char path[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    if (length <= 0 || setenv(policy, "passive", 1) != 0) {
        return; // threads that spin are slower, no more
    }
    path[length] = '\0';
    execv(path, argv);
}
