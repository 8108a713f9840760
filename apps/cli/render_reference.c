// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "render_reference.h"

#include "common_options.h"
#include "output.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

void traced_make_options(struct traced_arguments *arguments, struct option out[TRACED_OPTIONS])
{
    const struct option options[TRACED_OPTIONS] = {
        {.name = "reference",
         .kind = OPTION_FLAG,
         .target.flag = &arguments->is_wanted,
         .help = "Trace paths on the CPU instead of drawing: slow, without bias, no OpenGL. To "
                 "judge the other pictures by."},
        option_paths(
            &arguments->paths, 1,
            "Of --reference, for each pixel: four times as many halve the noise. Rounded up "
            "to a multiple of 16 and to 32. Default: 64."),
        option_seed(&arguments->seed,
                    "Of --reference: the same seed gives the same picture. Default: 0."),
        {.name = "orders",
         .kind = OPTION_NUMBER,
         .target.number = &arguments->orders,
         .metavar = "K",
         .range = {1, TRL_SKY_MAX_ORDERS},
         .is_whole = true,
         .word = "all",
         .help = "Scatterings and reflections by the ground that light may have, of the spectral "
                 "sky and of --reference. Default: all."},
        {.name = "error",
         .kind = OPTION_TEXT,
         .target.text = &arguments->error,
         .metavar = "FILE.exr",
         .help = "Of --reference: also write the standard error of each value, in cd/m2."},
    };
    memcpy(out, options, sizeof options);
}

uint32_t traced_max_orders(const struct traced_arguments *arguments)
{
    const bool is_number = arguments->orders.is_given && !arguments->orders.is_word;
    return is_number ? (uint32_t)arguments->orders.value : 0;
}

enum exit_status traced_check(const struct traced_arguments *arguments)
{
    const bool has_other =
        arguments->paths.is_given || arguments->seed.is_given || arguments->error;
    if (has_other && !arguments->is_wanted) {
        return report_error(EXIT_USAGE,
                            "render: --paths, --seed and --error belong to --reference");
    }
    if (arguments->error && strcasecmp(output_suffix(arguments->error), "exr") != 0) {
        return report_error(EXIT_USAGE, "render: --error: '%s' does not end with .exr",
                            arguments->error);
    }
    return EXIT_OK;
}

// What a picture is made in.
struct sheets {
    float *radiance, *error; // owned; 4 floats a pixel
    uint8_t *codes;          // owned; 4 bytes a pixel
};

static trl_result allocate_sheets(const struct number_size *size, struct sheets *out)
{
    const size_t values = (size_t)size->width * size->height * 4;
    *out = (struct sheets){malloc(values * sizeof(float)), malloc(values * sizeof(float)),
                           malloc(values)};
    if (out->radiance && out->error && out->codes) {
        return TRL_OK;
    }
    report_error(EXIT_FAILED, "%ux%u: out of memory", size->width, size->height);
    return TRL_ERROR_MEMORY;
}

static void free_sheets(struct sheets *sheets)
{
    free(sheets->radiance);
    free(sheets->error);
    free(sheets->codes);
}

static trl_result trace(struct app *app, const struct traced_arguments *arguments,
                        const struct traced_picture *picture, struct sheets *sheets)
{
    trl_reference_desc desc = trl_reference_desc_default();
    desc.scene = picture->scene;
    if (arguments->paths.is_given) {
        desc.paths = (uint64_t)arguments->paths.value;
    }
    if (arguments->seed.is_given) {
        desc.seed = (uint64_t)arguments->seed.value;
    }
    desc.max_orders = traced_max_orders(arguments);
    return trl_reference_render(app->ctx, &desc, picture->view, picture->size.width,
                                picture->size.height, sheets->radiance, sheets->error);
}

static trl_result write_picture(struct app *app, const struct traced_picture *picture,
                                const struct sheets *sheets)
{
    const uint32_t width = picture->size.width, height = picture->size.height;
    if (picture->is_exr) {
        return trl_image_write_exr(app->ctx, picture->output, width, height, sheets->radiance);
    }
    const trl_result result = trl_radiance_develop(app->ctx, picture->scene, picture->view, width,
                                                   height, sheets->radiance, sheets->codes);
    return result == TRL_OK
               ? trl_image_write_png(app->ctx, picture->output, width, height, sheets->codes)
               : result;
}

trl_result traced_draw(struct app *app, const struct traced_arguments *arguments,
                       const struct traced_picture *picture)
{
    struct sheets sheets;
    trl_result result = allocate_sheets(&picture->size, &sheets);
    if (result == TRL_OK) {
        result = trace(app, arguments, picture, &sheets);
    }
    if (result == TRL_OK) {
        result = write_picture(app, picture, &sheets);
    }
    if (result == TRL_OK && arguments->error) {
        result = trl_image_write_exr(app->ctx, arguments->error, picture->size.width,
                                     picture->size.height, sheets.error);
    }
    free_sheets(&sheets);
    return result;
}
