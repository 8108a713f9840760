// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// reference_sky [--paths N] [--seed S] [--max-order K] SCENE.json QUERIES.csv
//
// Answers the queries of a file with the path tracer, as `terrella sky` does with the solver, and
// adds the standard error. Not installed: it is for whoever checks the solver.
#include "base/file.h"
#include "reference/path_tracer.h"
#include "scene/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const header =
    "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg,wavelength_nm";

enum { MAX_FILE_BYTES = 1 << 26, COLUMNS = 5 };

struct query_list {
    trl_sky_query *queries;
    size_t count;
};

struct options {
    struct reference_desc desc;
    const char *scene, *queries;
};

static double rad(double degrees)
{
    return degrees * (3.14159265358979323846 / 180);
}

static trl_sky_query make_query(const double *column)
{
    return (trl_sky_query){.altitude_m = column[0],
                           .sun_zenith_rad = rad(column[1]),
                           .view_zenith_rad = rad(column[2]),
                           .azimuth_rad = rad(column[3]),
                           .wavelength_nm = column[4]};
}

// Five numbers with commas between them and nothing else.
static bool read_line(const char *line, double *column)
{
    int end = -1;
    const int got = sscanf(line, "%lf ,%lf ,%lf ,%lf ,%lf %n", &column[0], &column[1], &column[2],
                           &column[3], &column[4], &end);
    return got == COLUMNS && end >= 0 && line[end] == 0;
}

// `text` loses its line ends.
static trl_result parse_queries(const trl_context *ctx, char *text, struct query_list *list)
{
    size_t lines = 1;
    for (const char *at = text; *at; ++at) {
        lines += *at == '\n';
    }
    list->queries = mem_alloc(ctx, lines, sizeof(trl_sky_query));
    if (!list->queries) {
        return TRL_ERROR_MEMORY;
    }
    int number = 0;
    char *rest = text;
    for (char *line = strsep(&rest, "\n"); line; line = strsep(&rest, "\n")) {
        line[strcspn(line, "\r")] = 0;
        double column[COLUMNS];
        if (++number == 1) {
            if (strcmp(line, header) != 0) {
                return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                                "the first line of the queries must be %s", header);
            }
        } else if (read_line(line, column)) {
            list->queries[list->count++] = make_query(column);
        } else if (*line) {
            return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                            "line %d of the queries is not five numbers", number);
        }
    }
    return TRL_OK;
}

static trl_result read_queries(const trl_context *ctx, const char *path, struct query_list *list)
{
    char *text;
    size_t size;
    trl_result result = file_read(ctx, path, MAX_FILE_BYTES, &text, &size);
    if (result == TRL_OK) {
        result = parse_queries(ctx, text, list);
        mem_free(ctx, text);
    }
    return result;
}

static trl_result answer(const trl_context *ctx, const struct medium *medium,
                         const struct query_list *list, const struct reference_desc *desc)
{
    double *radiance = mem_alloc(ctx, list->count, 2 * sizeof(double));
    if (!radiance) {
        return TRL_ERROR_MEMORY;
    }
    double *error = radiance + list->count;
    const trl_result result =
        reference_sky_radiance(ctx, medium, list->queries, list->count, desc, radiance, error);
    if (result == TRL_OK) {
        printf("%s,radiance_W_m2_sr_nm,standard_error\n", header);
        for (size_t i = 0; i < list->count; ++i) {
            const trl_sky_query *q = &list->queries[i];
            printf("%.10g,%.10g,%.10g,%.10g,%.10g,%.6e,%.2e\n", q->altitude_m,
                   q->sun_zenith_rad / rad(1), q->view_zenith_rad / rad(1), q->azimuth_rad / rad(1),
                   q->wavelength_nm, radiance[i], error[i]);
        }
    }
    mem_free(ctx, radiance);
    return result;
}

static bool read_options(int argc, char **argv, struct options *options)
{
    *options = (struct options){.desc = {.paths = 100000, .seed = 1}};
    for (int i = 1; i < argc; ++i) {
        const bool has_value = i + 1 < argc;
        if (has_value && strcmp(argv[i], "--paths") == 0) {
            options->desc.paths = strtoull(argv[++i], NULL, 10);
        } else if (has_value && strcmp(argv[i], "--seed") == 0) {
            options->desc.seed = strtoull(argv[++i], NULL, 10);
        } else if (has_value && strcmp(argv[i], "--max-order") == 0) {
            options->desc.max_order = atoi(argv[++i]);
        } else if (!options->scene) {
            options->scene = argv[i];
        } else if (!options->queries) {
            options->queries = argv[i];
        } else {
            return false;
        }
    }
    return options->queries != NULL;
}

static trl_result run(trl_context *ctx, const struct options *options)
{
    trl_scene *scene;
    trl_result result = trl_scene_load(ctx, options->scene, &scene);
    if (result != TRL_OK) {
        return result;
    }
    struct query_list list = {0};
    result = read_queries(ctx, options->queries, &list);
    if (result == TRL_OK) {
        result = answer(ctx, &scene->medium, &list, &options->desc);
    }
    mem_free(ctx, list.queries);
    trl_scene_destroy(&scene);
    return result;
}

int main(int argc, char **argv)
{
    struct options options;
    if (!read_options(argc, argv, &options)) {
        fprintf(stderr, "usage: reference_sky [--paths N] [--seed S] [--max-order K] "
                        "SCENE.json QUERIES.csv\n");
        return 2;
    }
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    trl_context *ctx;
    if (trl_context_create(&desc, &ctx) != TRL_OK) {
        return 1;
    }
    const trl_result result = run(ctx, &options);
    trl_context_destroy(&ctx);
    return result == TRL_OK ? 0 : 1;
}
