// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Runs a fuzz target over a folder of inputs without libFuzzer: each input whole, cut short at many
// places, and with single bytes changed.

#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { PATH_BYTES = 4096, INPUT_MAX = 1 << 16, CUTS = 64, CHANGES = 64 };

// From a block of exactly the input's size, so that a sanitizer sees reads behind it.
static void run_copy(const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size > 0 ? size : 1);
    if (!copy) {
        abort();
    }
    memcpy(copy, data, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

static void run_input(uint8_t *data, size_t size)
{
    run_copy(data, size);
    for (size_t i = 0; i < CUTS; i++) {
        run_copy(data, size * i / CUTS);
    }
    for (size_t i = 0; i < CHANGES && size > 0; i++) {
        const size_t at = i * 2654435761U % size; // scattered, the same in every run
        const uint8_t kept = data[at];
        data[at] = (uint8_t)(kept ^ (1U << i % 8));
        run_copy(data, size);
        data[at] = kept;
    }
}

static int run_file(const char *path)
{
    static uint8_t data[INPUT_MAX];
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        return 1;
    }
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    run_input(data, size);
    return 0;
}

int main(int argc, char **argv)
{
    DIR *folder = argc == 2 ? opendir(argv[1]) : NULL;
    if (!folder) {
        fprintf(stderr, "usage: replay FOLDER\n");
        return 2;
    }
    int inputs = 0;
    int failures = 0;
    for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        if (entry->d_name[0] != '.') {
            char path[PATH_BYTES];
            snprintf(path, sizeof path, "%s/%s", argv[1], entry->d_name);
            failures += run_file(path);
            inputs++;
        }
    }
    closedir(folder);
    printf("%d inputs\n", inputs);
    return inputs == 0 || failures > 0;
}
