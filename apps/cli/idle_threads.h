// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_IDLE_THREADS_H
#define CLI_IDLE_THREADS_H

// Threads of OpenMP sleep between their works instead of spinning (docs/decisions/
// 052-idle-threads-sleep.md). OpenMP reads its settings when the program is loaded: where they say
// nothing, the program starts once more with them, and this does not return. `argv` is main's.
void idle_threads_sleep(char **argv);

#endif
