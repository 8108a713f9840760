// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_SHELLS_H
#define REFERENCE_SHELLS_H
// What shells.c, which makes the shells, and air.c, which walks through them, both know.

#include "reference/air.h"

// Intervals of the linear density table within a shell: with the bend allowed there it is exact to
// 5e-5 of the shell's extinction at worst and 1e-5 in the mean.
enum { SHELL_INTERVALS = 32 };

#endif // REFERENCE_SHELLS_H
