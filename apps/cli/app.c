// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "app.h"

#include "interrupt.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Messages must not stand behind a progress line.
static void log_line(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct app *app = user;
    if (level == TRL_LOG_ERROR && app->holds_errors) {
        snprintf(app->held_error, sizeof app->held_error, "%s", message);
        return;
    }
    if (level <= TRL_LOG_WARN) {
        progress_clear(&app->progress);
    }
    trl_log_stderr(NULL, level, item, message);
}

enum exit_status app_init(struct app *app, const struct app_desc *desc)
{
    *app = (struct app){.holds_errors = desc->holds_errors};
    progress_begin(&app->progress, desc->is_quiet);
    interrupt_arm();
    trl_context_desc context = trl_context_desc_default();
    context.log = log_line;
    context.log_user = app;
    context.progress = progress_report;
    context.progress_user = &app->progress;
    if (desc->is_uncached) {
        context.cache_dir = "";
    }
    if (desc->data) {
        context.allows_remote = desc->data->allows_remote;
        context.raster_mb = desc->data->memory_mb.is_given ? (uint32_t)desc->data->memory_mb.value
                                                           : context.raster_mb;
    }
    const trl_result result = trl_context_create(&context, &app->ctx);
    if (result != TRL_OK) {
        return report_error(EXIT_FAILED, "the library cannot start: %s", trl_result_name(result));
    }
    return EXIT_OK;
}

void app_finish(struct app *app)
{
    progress_clear(&app->progress);
    trl_context_destroy(&app->ctx);
}

static char *join_if_readable(const char *folder, const char *file)
{
    const size_t size = strlen(folder) + strlen(file) + 2;
    char *path = malloc(size);
    if (path) {
        snprintf(path, size, "%s/%s", folder, file);
        if (access(path, R_OK) == 0) {
            return path;
        }
    }
    free(path);
    return NULL;
}

char *app_find_scene(const char *file)
{
    char *path = join_if_readable(TERRELLA_SOURCE_SCENES, file);
    if (path) {
        return path;
    }
    char folder[4096];
    const ssize_t length =
        readlink("/proc/self/exe", folder, sizeof folder - sizeof "/../share/terrella/scenes");
    if (length < 0) {
        return NULL;
    }
    folder[length] = '\0';
    char *slash = strrchr(folder, '/');
    if (slash) {
        memcpy(slash, "/../share/terrella/scenes", sizeof "/../share/terrella/scenes");
    }
    return join_if_readable(folder, file);
}
