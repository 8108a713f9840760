// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// terrella info: what this build is, what this machine offers, what data is there.
#include "app.h"
#include "commands.h"
#include "viewer/viewer.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

static const char about[] =
    "Shows the versions of the program and its libraries, the folders it uses, what\n"
    "OpenGL offers without a window (and whether there is any), and which of the\n"
    "rasters that SCENE names are found. Without SCENE: those of Earth.\n";
static const char examples[] = "  terrella info\n"
                               "  terrella info scenes/earth.json\n";

static const char *say_yes(bool is_so)
{
    return is_so ? "yes" : "no";
}

static void print_versions(void)
{
    printf("terrella        %s\n", trl_version());
    printf("libraries       %s\n", TERRELLA_LIBRARIES);
    printf("viewer          %s\n", viewer_library());
}

// Number and bytes of the regular files of a folder.
static void print_cache(const char *folder)
{
    if (!*folder) {
        printf("cache           none\n");
        return;
    }
    size_t count = 0;
    double bytes = 0.0;
    DIR *dir = opendir(folder);
    for (struct dirent *entry = dir ? readdir(dir) : NULL; entry; entry = readdir(dir)) {
        struct stat file;
        if (fstatat(dirfd(dir), entry->d_name, &file, 0) == 0 && S_ISREG(file.st_mode)) {
            count++;
            bytes += (double)file.st_size;
        }
    }
    if (dir) {
        closedir(dir);
    }
    printf("cache           %s (%zu files, %.1f MB)\n", folder, count, bytes / 1e6);
}

static void print_gpu(struct app *app)
{
    trl_gpu_info gpu;
    if (trl_gpu_info_read(app->ctx, &gpu) != TRL_OK) {
        printf("OpenGL          none without a window: %s\n", app->held_error);
        return;
    }
    printf("OpenGL          %s\n", gpu.version);
    printf("renderer        %s (%s)%s\n", gpu.renderer, gpu.vendor,
           gpu.is_software ? ", on the CPU" : "");
    printf("textures        2D to %u, 3D to %u, %u layers, anisotropy %.0f\n", gpu.max_texture_size,
           gpu.max_3d_size, gpu.max_array_layers, (double)gpu.max_anisotropy);
    printf(
        "capabilities    clip control %s, timer queries %s, tessellation %s, float filtering %s, "
        "debug output %s\n",
        say_yes(gpu.has_clip_control), say_yes(gpu.has_timer_query), say_yes(gpu.has_tessellation),
        say_yes(gpu.has_float_linear), say_yes(gpu.has_debug));
}

static enum exit_status print_scene(struct app *app, const char *path)
{
    trl_scene *scene = NULL;
    if (trl_scene_load(app->ctx, path, &scene) != TRL_OK) {
        return report_error(EXIT_FAILED, "%s", app->held_error);
    }
    printf("scene           %s (%s): %zu views\n", trl_scene_name(scene), path,
           trl_scene_view_count(scene));
    size_t missing = 0;
    for (size_t i = 0; i < trl_scene_layer_count(scene); i++) {
        missing += !trl_scene_layer_is_present(scene, i);
        printf("  %-7s       %s: %s\n", trl_scene_layer_is_present(scene, i) ? "found" : "missing",
               trl_scene_layer_name(scene, i), trl_scene_layer_path(scene, i));
    }
    if (missing > 0) {
        printf("  %zu missing: \"make data\" in the source tree fetches those of its scenes\n",
               missing);
    }
    trl_scene_destroy(&scene);
    return EXIT_OK;
}

static enum exit_status print_everything(const char *given_scene)
{
    struct app app;
    enum exit_status status = app_init(&app, &(struct app_desc){.holds_errors = true});
    if (status != EXIT_OK) {
        return status;
    }
    print_versions();
    printf("data            %s\n", trl_context_data_dir(app.ctx));
    print_cache(trl_context_cache_dir(app.ctx));
    print_gpu(&app);
    char *shipped = given_scene ? NULL : app_find_scene("earth.json");
    if (given_scene || shipped) {
        status = print_scene(&app, given_scene ? given_scene : shipped);
    }
    free(shipped);
    app_finish(&app);
    return status;
}

enum exit_status command_info(int argc, char **argv)
{
    const struct option_spec spec = {.command = "info",
                                     .positional = "[SCENE]",
                                     .max_positionals = 1,
                                     .about = about,
                                     .examples = examples};
    struct option_arguments words;
    const enum options_outcome outcome = options_read(&spec, argc, argv, &words);
    if (outcome != OPTIONS_READ) {
        return outcome == OPTIONS_HELP ? EXIT_OK : EXIT_USAGE;
    }
    return print_everything(words.positionals[0]);
}
