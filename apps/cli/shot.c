// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "shot.h"

#include "shrink.h"

#include <stdlib.h>

void shot_finish(struct shot *shot)
{
    free(shot->picture);
    free(shot->radiance);
    *shot = (struct shot){0};
}

static trl_result read_shot(const struct shot_desc *desc, struct shot *out)
{
    trl_result result = trl_renderer_read_rgba8(desc->renderer, out->picture);
    if (result == TRL_OK) {
        result = trl_renderer_read_radiance(desc->renderer, out->radiance);
    }
    if (result == TRL_OK) {
        result = trl_renderer_exposure(desc->renderer, &out->ev100);
    }
    if (result == TRL_OK && desc->samples > 1) {
        shrink_srgb(out->picture, out->width, out->height, desc->samples);
        shrink_radiance(out->radiance, out->width, out->height, desc->samples);
    }
    return result;
}

trl_result shot_take(const struct shot_desc *desc, struct shot *out)
{
    *out = (struct shot){.width = desc->size.width, .height = desc->size.height};
    const uint32_t width = desc->size.width * desc->samples;
    const uint32_t height = desc->size.height * desc->samples;
    out->picture = malloc((size_t)width * height * 4);
    out->radiance = malloc((size_t)width * height * 4 * sizeof *out->radiance);
    trl_result result = TRL_ERROR_MEMORY;
    if (out->picture && out->radiance) {
        result = trl_renderer_set_sky_model(desc->renderer, desc->model);
        if (result == TRL_OK) {
            result = trl_renderer_draw(desc->renderer, desc->view, width, height, 0.0);
        }
        if (result == TRL_OK) {
            result = read_shot(desc, out);
        }
    } else {
        report_error(EXIT_FAILED, "%ux%u: out of memory", width, height);
    }
    if (result != TRL_OK) {
        shot_finish(out);
    }
    return result;
}
