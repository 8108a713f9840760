// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_INTERRUPT_H
#define CLI_INTERRUPT_H
// Ctrl-C: the first one asks the work to stop, a second one kills.

#include <stdbool.h>

void interrupt_arm(void);

// Whether Ctrl-C was pressed (or the program was told to end) since then.
bool interrupt_is_pending(void);

#endif // CLI_INTERRUPT_H
