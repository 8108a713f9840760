// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/tone.h"

#include "gpu/pass.h"

trl_result tone_init(struct gpu *gpu, struct tone *out)
{
    *out = (struct tone){.gpu = gpu};
    struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert", .fragment = "frame/tone.frag"};
    trl_result result = gpu_program_init(gpu, &desc, &out->filmic);
    if (result == TRL_OK) {
        const char *const exponential[] = {"TONE_IS_EXPONENTIAL"};
        desc.defines = exponential;
        desc.define_count = 1;
        result = gpu_program_init(gpu, &desc, &out->exponential);
    }
    if (result == TRL_OK) {
        const struct gpu_program_desc present = {.vertex = "lib/fullscreen.vert",
                                                 .fragment = "frame/present.frag"};
        result = gpu_program_init(gpu, &present, &out->present);
    }
    if (result != TRL_OK) {
        tone_finish(out);
    }
    return result;
}

void tone_finish(struct tone *tone)
{
    gpu_program_finish(&tone->filmic);
    gpu_program_finish(&tone->exponential);
    gpu_program_finish(&tone->present);
    *tone = (struct tone){0};
}

static struct gpu_program *choose_program(struct tone *tone, trl_tone_curve curve)
{
    switch (curve) {
    case TRL_TONE_EXPONENTIAL:
        return &tone->exponential;
    case TRL_TONE_FILMIC:
        break;
    }
    return &tone->filmic;
}

trl_result tone_draw(struct tone *tone, const struct tone_source *source,
                     const struct gpu_target *target)
{
    struct gpu_program *program = choose_program(tone, source->curve);
    const struct gpu_pass pass = {.target = target};
    gpu_pass_begin(tone->gpu, &pass);
    gpu_program_set_texture(program, "u_radiance", source->radiance);
    gpu_program_set_texture(program, "u_exposure", source->exposure);
    return gpu_draw_fullscreen(program, "tone");
}

trl_result tone_present(struct tone *tone, const struct gpu_texture *picture, struct gpu_rect rect)
{
    const struct gpu_target window =
        gpu_target_window(tone->gpu, rect.x + rect.width, rect.y + rect.height);
    const struct gpu_pass pass = {.target = &window, .viewport = rect};
    gpu_pass_begin(tone->gpu, &pass);
    gpu_program_set_texture(&tone->present, "u_picture", picture);
    return gpu_draw_fullscreen(&tone->present, "present");
}
