// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_COMMANDS_H
#define CLI_COMMANDS_H
// The commands of the program. Each reads the words behind its name and returns the program's exit
// status.

#include "report.h"

enum exit_status command_render(int argc, char **argv);
enum exit_status command_sky(int argc, char **argv);
enum exit_status command_sea(int argc, char **argv);
enum exit_status command_view(int argc, char **argv);
enum exit_status command_info(int argc, char **argv);
enum exit_status command_bench(int argc, char **argv);
enum exit_status command_validate(int argc, char **argv);

#endif // CLI_COMMANDS_H
