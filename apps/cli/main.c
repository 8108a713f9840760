// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella: finds the command and lets it run.
#include "commands.h"
#include "idle_threads.h"

#include <terrella/base.h>

#include <stdio.h>
#include <string.h>

struct command {
    const char *name;
    const char *summary;
    enum exit_status (*run)(int argc, char **argv);
};

static const struct command commands[] = {
    {"render", "Write a picture of a scene (PNG or OpenEXR); needs no display.", command_render},
    {"sky", "Print spectral radiances of the sky as CSV; needs no OpenGL.", command_sky},
    {"sea", "Print light in the water of a scene as CSV; needs no OpenGL.", command_sea},
    {"view", "Fly through a scene in a window.", command_view},
    {"info", "Show versions, what OpenGL offers, and data found and missing.", command_info},
    {"bench", "Measure speed and memory.", command_bench},
    {"validate", "Compare the models of the sky with a path tracer; makes a report.",
     command_validate},
};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static void print_help(void)
{
    printf("terrella %s: real and imagined planets, from the ground to space\n\n"
           "Usage: terrella COMMAND [arguments] [options]\n\nCommands:\n",
           trl_version());
    for (int i = 0; i < COMMAND_COUNT; i++) {
        printf("  %-8s %s\n", commands[i].name, commands[i].summary);
    }
    printf("\n`terrella COMMAND --help` teaches the command; `terrella --version` prints the "
           "version.\n"
           "Exit status: 0 done, 1 failed, 2 wrong command line.\n\nExamples:\n"
           "  terrella render scenes/earth.json --view himalaya-morning -o himalaya.png\n"
           "  terrella sky scenes/earth.json --altitude 0 --sun-zenith 60 \\\n"
           "      --view-zenith 0:90:10 --azimuth 0,180 --wavelength 450,550,650\n");
}

static enum exit_status report_unknown(const char *word)
{
    const char *names[COMMAND_COUNT];
    for (int i = 0; i < COMMAND_COUNT; i++) {
        names[i] = commands[i].name;
    }
    const char *nearest = report_nearest(word, names, COMMAND_COUNT);
    if (nearest) {
        return report_error(EXIT_USAGE, "unknown command '%.60s'; did you mean %s?", word, nearest);
    }
    return report_error(EXIT_USAGE, "unknown command '%.60s'; see terrella --help", word);
}

// Output that could not be delivered must not look like success.
static enum exit_status finish_output(enum exit_status status)
{
    if ((fflush(stdout) != 0 || ferror(stdout)) && status == EXIT_OK) {
        return report_error(EXIT_FAILED, "(standard output): cannot be written");
    }
    return status;
}

static enum exit_status run(int argc, char **argv)
{
    if (argc < 2) {
        return report_error(EXIT_USAGE, "a command is missing; see terrella --help");
    }
    const char *word = argv[1];
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0) {
        print_help();
        return EXIT_OK;
    }
    if (strcmp(word, "--version") == 0) {
        printf("terrella %s\n", trl_version());
        return EXIT_OK;
    }
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(word, commands[i].name) == 0) {
            return commands[i].run(argc - 2, argv + 2);
        }
    }
    return report_unknown(word);
}

int main(int argc, char **argv)
{
    idle_threads_sleep(argv);
    return finish_output(run(argc, argv));
}
