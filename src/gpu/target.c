// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "gpu/target.h"
#include "gpu/internal.h"

static trl_result fail_invalid(const struct gpu *gpu, const char *label, const char *what)
{
    return trl_fail(gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT, "%s: %s",
                    label ? label : "target", what);
}

// Takes over the size of the first attachment and compares the others with it.
static bool fit_size(struct gpu_target *target, const struct gpu_attachment *attachment)
{
    const struct gpu_texture *texture = attachment->texture;
    if (attachment->level >= texture->levels) {
        return false;
    }
    const struct gpu_region all = gpu_texture_region(texture, attachment->level);
    if (target->width == 0) {
        target->width = all.width;
        target->height = all.height;
    }
    return all.width == target->width && all.height == target->height &&
           attachment->layer < all.depth;
}

static trl_result check_attachments(struct gpu_target *target, const struct gpu_target_desc *desc)
{
    if (desc->color_count > GPU_TARGET_MAX_COLORS ||
        (desc->color_count == 0 && !desc->depth.texture)) {
        return fail_invalid(target->gpu, desc->label, "no attachments, or too many");
    }
    for (uint32_t i = 0; i < desc->color_count; i++) {
        const struct gpu_texture *texture = desc->colors[i].texture;
        if (!texture || texture->format == GPU_FORMAT_DEPTH32F ||
            !fit_size(target, &desc->colors[i])) {
            return fail_invalid(target->gpu, desc->label,
                                "a color is missing, no color, or of another size");
        }
        target->is_srgb = target->is_srgb || texture->format == GPU_FORMAT_SRGB8_A8;
    }
    if (desc->depth.texture &&
        (desc->depth.texture->format != GPU_FORMAT_DEPTH32F || !fit_size(target, &desc->depth))) {
        return fail_invalid(target->gpu, desc->label, "the depth is no depth, or of another size");
    }
    return TRL_OK;
}

static void attach(GLenum point, const struct gpu_attachment *attachment)
{
    gpu_texture_attach(attachment->texture, GL_FRAMEBUFFER, point, (GLint)attachment->level,
                       (GLint)attachment->layer);
}

trl_result gpu_target_init(struct gpu *gpu, const struct gpu_target_desc *desc,
                           struct gpu_target *out)
{
    *out = (struct gpu_target){
        .gpu = gpu, .color_count = desc->color_count, .has_depth = desc->depth.texture != NULL};
    trl_result result = check_attachments(out, desc);
    if (result != TRL_OK) {
        *out = (struct gpu_target){0};
        return result;
    }
    gpu->live_objects++;
    glGenFramebuffers(1, &out->name);
    glBindFramebuffer(GL_FRAMEBUFFER, out->name);
    GLenum draw_buffers[GPU_TARGET_MAX_COLORS] = {GL_NONE};
    for (uint32_t i = 0; i < desc->color_count; i++) {
        out->colors[i] = desc->colors[i];
        draw_buffers[i] = GL_COLOR_ATTACHMENT0 + i;
        attach(draw_buffers[i], &desc->colors[i]);
    }
    if (out->has_depth) {
        attach(GL_DEPTH_ATTACHMENT, &desc->depth);
    }
    glDrawBuffers(desc->color_count > 0 ? (GLsizei)desc->color_count : 1, draw_buffers);
    glReadBuffer(desc->color_count > 0 ? GL_COLOR_ATTACHMENT0 : GL_NONE);
    gpu_label(gpu, GL_FRAMEBUFFER, out->name, desc->label);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        result = trl_fail(gpu->ctx, TRL_ERROR_GPU, TRL_LOG_ITEM_GPU_OBJECT,
                          "%s: this GPU cannot draw to these textures",
                          desc->label ? desc->label : "target");
    } else {
        result = gpu_check(gpu, "gpu_target_init");
    }
    if (result != TRL_OK) {
        gpu_target_finish(out);
    }
    return result;
}

trl_result gpu_target_init_texture(struct gpu *gpu, const struct gpu_texture_desc *desc,
                                   const struct gpu_texture *depth, struct gpu_texture *texture,
                                   struct gpu_target *out)
{
    *out = (struct gpu_target){0};
    const struct gpu_target_desc target = {.label = desc->label,
                                           .color_count = 1,
                                           .colors[0].texture = texture,
                                           .depth.texture = depth};
    trl_result result = gpu_texture_init(gpu, desc, texture);
    if (result == TRL_OK) {
        result = gpu_target_init(gpu, &target, out);
    }
    if (result != TRL_OK) {
        gpu_texture_finish(texture);
    }
    return result;
}

void gpu_target_finish(struct gpu_target *target)
{
    if (target->name != 0) {
        glDeleteFramebuffers(1, &target->name);
        target->gpu->live_objects--;
    }
    *target = (struct gpu_target){0};
}

struct gpu_target gpu_target_window(struct gpu *gpu, uint32_t width, uint32_t height)
{
    return (struct gpu_target){
        .gpu = gpu, .width = width, .height = height, .color_count = 1, .has_depth = true};
}

trl_result gpu_target_set_layer(struct gpu_target *target, uint32_t color, uint32_t layer)
{
    if (color >= target->color_count || target->name == 0) {
        return fail_invalid(target->gpu, "gpu_target_set_layer", "no such color");
    }
    struct gpu_attachment *attachment = &target->colors[color];
    if (layer >= gpu_texture_region(attachment->texture, attachment->level).depth) {
        return fail_invalid(target->gpu, "gpu_target_set_layer", "no such layer");
    }
    attachment->layer = layer;
    glBindFramebuffer(GL_FRAMEBUFFER, target->name);
    attach(GL_COLOR_ATTACHMENT0 + color, attachment);
    return gpu_check(target->gpu, "gpu_target_set_layer");
}

trl_result gpu_target_read_rgba8(const struct gpu_target *target, struct gpu_rect rect,
                                 uint8_t *rgba)
{
    if (rect.width < 1 || rect.height < 1 || rect.x >= target->width ||
        rect.width > target->width - rect.x || rect.y >= target->height ||
        rect.height > target->height - rect.y) {
        return fail_invalid(target->gpu, "gpu_target_read_rgba8", "not inside the target");
    }
    gpu_pack_reset();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target->name);
    glReadPixels((GLint)rect.x, (GLint)rect.y, (GLsizei)rect.width, (GLsizei)rect.height, GL_RGBA,
                 GL_UNSIGNED_BYTE, rgba);
    return gpu_check(target->gpu, "gpu_target_read_rgba8");
}
