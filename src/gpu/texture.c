// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "gpu/internal.h"

struct format_info {
    const char *name;
    GLenum internal, external, type;
    uint32_t channels;
};

// `type` is the one of the CPU's side: half floats travel as floats, which is what callers
// calculate in.
static const struct format_info format_infos[GPU_FORMAT_COUNT] = {
    [GPU_FORMAT_R8] = {"R8", GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1},
    [GPU_FORMAT_RG8] = {"RG8", GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2},
    [GPU_FORMAT_RGBA8] = {"RGBA8", GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
    [GPU_FORMAT_SRGB8_A8] = {"SRGB8_A8", GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
    [GPU_FORMAT_R16F] = {"R16F", GL_R16F, GL_RED, GL_FLOAT, 1},
    [GPU_FORMAT_RG16F] = {"RG16F", GL_RG16F, GL_RG, GL_FLOAT, 2},
    [GPU_FORMAT_RGBA16F] = {"RGBA16F", GL_RGBA16F, GL_RGBA, GL_FLOAT, 4},
    [GPU_FORMAT_R32F] = {"R32F", GL_R32F, GL_RED, GL_FLOAT, 1},
    [GPU_FORMAT_RG32F] = {"RG32F", GL_RG32F, GL_RG, GL_FLOAT, 2},
    [GPU_FORMAT_RGBA32F] = {"RGBA32F", GL_RGBA32F, GL_RGBA, GL_FLOAT, 4},
    [GPU_FORMAT_R16] = {"R16", GL_R16, GL_RED, GL_UNSIGNED_SHORT, 1},
    [GPU_FORMAT_R16I] = {"R16I", GL_R16I, GL_RED_INTEGER, GL_SHORT, 1},
    [GPU_FORMAT_DEPTH32F] = {"DEPTH32F", GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 1},
};

uint32_t gpu_format_channels(enum gpu_format format)
{
    return format_infos[format].channels;
}

const char *gpu_format_name(enum gpu_format format)
{
    return format_infos[format].name;
}

size_t gpu_format_texel_bytes(enum gpu_format format)
{
    const struct format_info *info = &format_infos[format];
    const size_t component = info->type == GL_UNSIGNED_BYTE                              ? 1
                             : info->type == GL_SHORT || info->type == GL_UNSIGNED_SHORT ? 2
                                                                                         : 4;
    return component * info->channels;
}

struct gpu_texture_desc gpu_texture_desc_default(void)
{
    return (struct gpu_texture_desc){.shape = GPU_SHAPE_2D,
                                     .format = GPU_FORMAT_RGBA8,
                                     .width = 1,
                                     .height = 1,
                                     .depth = 1,
                                     .levels = 1,
                                     .filter = GPU_FILTER_LINEAR,
                                     .anisotropy = 1};
}

static bool is_float32(enum gpu_format format)
{
    return format == GPU_FORMAT_R32F || format == GPU_FORMAT_RG32F || format == GPU_FORMAT_RGBA32F;
}

static bool is_filterable(enum gpu_format format)
{
    return format != GPU_FORMAT_R16I && format != GPU_FORMAT_DEPTH32F;
}

static uint32_t level_size(uint32_t size, uint32_t level)
{
    return size >> level > 0 ? size >> level : 1;
}

static uint32_t count_levels(const struct gpu_texture_desc *desc)
{
    uint32_t longest = desc->width > desc->height ? desc->width : desc->height;
    if (desc->shape == GPU_SHAPE_3D && desc->depth > longest) {
        longest = desc->depth;
    }
    uint32_t levels = 1;
    while (longest >> levels > 0) {
        levels++;
    }
    return levels;
}

GLenum gpu_texture_gl_target(const struct gpu_texture *texture)
{
    switch (texture->shape) {
    case GPU_SHAPE_2D:
        return GL_TEXTURE_2D;
    case GPU_SHAPE_3D:
        return GL_TEXTURE_3D;
    case GPU_SHAPE_2D_ARRAY:
        return GL_TEXTURE_2D_ARRAY;
    }
    return GL_NONE;
}

void gpu_texture_attach(const struct gpu_texture *texture, GLenum framebuffer_target,
                        GLenum attachment, GLint level, GLint layer)
{
    if (texture->shape == GPU_SHAPE_2D) {
        glFramebufferTexture2D(framebuffer_target, attachment, GL_TEXTURE_2D, texture->name, level);
    } else {
        glFramebufferTextureLayer(framebuffer_target, attachment, texture->name, level, layer);
    }
}

static trl_result check_desc(const struct gpu *gpu, const struct gpu_texture_desc *desc)
{
    const char *label = desc->label ? desc->label : "texture";
    const bool is_3d = desc->shape == GPU_SHAPE_3D;
    const uint32_t side = is_3d ? gpu->caps.max_3d_size : gpu->caps.max_texture_size;
    const uint32_t depth = is_3d                               ? gpu->caps.max_3d_size
                           : desc->shape == GPU_SHAPE_2D_ARRAY ? gpu->caps.max_array_layers
                                                               : 1;
    if (desc->width < 1 || desc->width > side || desc->height < 1 || desc->height > side ||
        desc->depth < 1 || desc->depth > depth) {
        return trl_fail(gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s: %u x %u x %u texels; this GPU has 1 to %u x %u x %u", label,
                        desc->width, desc->height, desc->depth, side, side, depth);
    }
    const char *name = gpu_format_name(desc->format);
    if (desc->levels > count_levels(desc)) {
        return trl_fail(gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s: %u levels, at most %u", label, desc->levels, count_levels(desc));
    }
    if (desc->filter != GPU_FILTER_NEAREST && !is_filterable(desc->format)) {
        return trl_fail(gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s: %s cannot be filtered", label, name);
    }
    if (desc->format == GPU_FORMAT_DEPTH32F && desc->shape != GPU_SHAPE_2D) {
        return trl_fail(gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s: %s has two dimensions only", label, name);
    }
    if (desc->filter != GPU_FILTER_NEAREST && is_float32(desc->format) &&
        !gpu->caps.has_float_linear) {
        return trl_fail(gpu->ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s: this GPU does not filter %s", label, name);
    }
    if (desc->format == GPU_FORMAT_R16 && !gpu->caps.has_norm16) {
        return trl_fail(gpu->ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s: this GPU does not have %s", label, name);
    }
    return TRL_OK;
}

static GLint gl_wrap(enum gpu_wrap wrap)
{
    switch (wrap) {
    case GPU_WRAP_CLAMP:
        return GL_CLAMP_TO_EDGE;
    case GPU_WRAP_REPEAT:
        return GL_REPEAT;
    case GPU_WRAP_MIRROR:
        return GL_MIRRORED_REPEAT;
    }
    return GL_CLAMP_TO_EDGE;
}

static GLint gl_min_filter(enum gpu_filter filter)
{
    switch (filter) {
    case GPU_FILTER_NEAREST:
        return GL_NEAREST;
    case GPU_FILTER_LINEAR:
        return GL_LINEAR;
    case GPU_FILTER_TRILINEAR:
        return GL_LINEAR_MIPMAP_LINEAR;
    }
    return GL_NEAREST;
}

static void set_sampling(const struct gpu *gpu, GLenum target, const struct gpu_texture_desc *desc)
{
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, gl_min_filter(desc->filter));
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER,
                    desc->filter == GPU_FILTER_NEAREST ? GL_NEAREST : GL_LINEAR);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, gl_wrap(desc->wrap_x));
    glTexParameteri(target, GL_TEXTURE_WRAP_T, gl_wrap(desc->wrap_y));
    glTexParameteri(target, GL_TEXTURE_WRAP_R, gl_wrap(desc->wrap_z));
    if (gpu->caps.max_anisotropy > 1 && desc->anisotropy > 1) {
        glTexParameterf(target, GL_TEXTURE_MAX_ANISOTROPY_EXT,
                        desc->anisotropy < gpu->caps.max_anisotropy ? desc->anisotropy
                                                                    : gpu->caps.max_anisotropy);
    }
}

static void unpack_reset(void)
{
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, 0);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
    glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
    glPixelStorei(GL_UNPACK_SKIP_IMAGES, 0);
}

// glTexStorage is not in 3.3, so each level is made by itself.
static void allocate_levels(const struct gpu_texture *texture, const void *data)
{
    const GLenum target = gpu_texture_gl_target(texture);
    const struct format_info *info = &format_infos[texture->format];
    unpack_reset();
    for (uint32_t i = 0; i < texture->levels; i++) {
        const struct gpu_region r = gpu_texture_region(texture, i);
        const void *texels = i == 0 ? data : NULL;
        if (texture->shape == GPU_SHAPE_2D) {
            glTexImage2D(target, (GLint)i, (GLint)info->internal, (GLsizei)r.width,
                         (GLsizei)r.height, 0, info->external, info->type, texels);
        } else {
            glTexImage3D(target, (GLint)i, (GLint)info->internal, (GLsizei)r.width,
                         (GLsizei)r.height, (GLsizei)r.depth, 0, info->external, info->type,
                         texels);
        }
    }
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, (GLint)texture->levels - 1);
}

trl_result gpu_texture_init(struct gpu *gpu, const struct gpu_texture_desc *desc,
                            struct gpu_texture *out)
{
    *out = (struct gpu_texture){0};
    trl_result result = check_desc(gpu, desc);
    if (result != TRL_OK) {
        return result;
    }
    *out = (struct gpu_texture){.gpu = gpu,
                                .shape = desc->shape,
                                .format = desc->format,
                                .width = desc->width,
                                .height = desc->height,
                                .depth = desc->depth,
                                .levels = desc->levels ? desc->levels : count_levels(desc)};
    gpu->live_objects++;
    glGenTextures(1, &out->name);
    const GLenum target = gpu_texture_gl_target(out);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(target, out->name);
    allocate_levels(out, desc->data);
    set_sampling(gpu, target, desc);
    gpu_label(gpu, GL_TEXTURE, out->name, desc->label);
    result = gpu_check(gpu, desc->label ? desc->label : "gpu_texture_init");
    if (result != TRL_OK) {
        gpu_texture_finish(out);
    }
    return result;
}

void gpu_texture_finish(struct gpu_texture *texture)
{
    if (texture->gpu) {
        glDeleteTextures(1, &texture->name);
        texture->gpu->live_objects--;
    }
    *texture = (struct gpu_texture){0};
}

struct gpu_region gpu_texture_region(const struct gpu_texture *texture, uint32_t level)
{
    return (struct gpu_region){.level = level,
                               .width = level_size(texture->width, level),
                               .height = level_size(texture->height, level),
                               .depth = texture->shape == GPU_SHAPE_3D
                                            ? level_size(texture->depth, level)
                                            : texture->depth};
}

static bool is_inside(uint32_t from, uint32_t count, uint32_t size)
{
    return count > 0 && from < size && count <= size - from;
}

static trl_result check_region(const struct gpu_texture *texture, const struct gpu_region *region,
                               const char *where)
{
    if (region->level < texture->levels) {
        const struct gpu_region all = gpu_texture_region(texture, region->level);
        if (is_inside(region->x, region->width, all.width) &&
            is_inside(region->y, region->height, all.height) &&
            is_inside(region->z, region->depth, all.depth)) {
            return TRL_OK;
        }
    }
    return trl_fail(texture->gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                    "%s: level %u, %u x %u x %u texels at (%u, %u, %u) are not inside the texture",
                    where, region->level, region->width, region->height, region->depth, region->x,
                    region->y, region->z);
}

trl_result gpu_texture_upload(struct gpu_texture *texture, const struct gpu_region *region,
                              const void *data)
{
    const trl_result result = check_region(texture, region, "gpu_texture_upload");
    if (result != TRL_OK) {
        return result;
    }
    const GLenum target = gpu_texture_gl_target(texture);
    const struct format_info *info = &format_infos[texture->format];
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(target, texture->name);
    unpack_reset();
    if (texture->shape == GPU_SHAPE_2D) {
        glTexSubImage2D(target, (GLint)region->level, (GLint)region->x, (GLint)region->y,
                        (GLsizei)region->width, (GLsizei)region->height, info->external, info->type,
                        data);
    } else {
        glTexSubImage3D(target, (GLint)region->level, (GLint)region->x, (GLint)region->y,
                        (GLint)region->z, (GLsizei)region->width, (GLsizei)region->height,
                        (GLsizei)region->depth, info->external, info->type, data);
    }
    return gpu_check(texture->gpu, "gpu_texture_upload");
}

trl_result gpu_texture_make_mips(struct gpu_texture *texture)
{
    if (!is_filterable(texture->format)) {
        return trl_fail(texture->gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s has no mips made by the GPU", gpu_format_name(texture->format));
    }
    if (is_float32(texture->format) && !texture->gpu->caps.has_float_linear) {
        return trl_fail(texture->gpu->ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GPU_OBJECT,
                        "this GPU does not filter %s", gpu_format_name(texture->format));
    }
    const GLenum target = gpu_texture_gl_target(texture);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(target, texture->name);
    glGenerateMipmap(target);
    return gpu_check(texture->gpu, "gpu_texture_make_mips");
}

// ES reads four channels only, of bytes, ints or floats, and of shorts where it has R16.
struct wide_texel {
    GLenum external, type;
    size_t bytes;
};

static struct wide_texel choose_wide(enum gpu_format format)
{
    switch (format_infos[format].type) {
    case GL_UNSIGNED_BYTE:
        return (struct wide_texel){GL_RGBA, GL_UNSIGNED_BYTE, 4};
    case GL_UNSIGNED_SHORT:
        return (struct wide_texel){GL_RGBA, GL_UNSIGNED_SHORT, 8};
    case GL_SHORT:
        return (struct wide_texel){GL_RGBA_INTEGER, GL_INT, 16};
    default:
        return (struct wide_texel){GL_RGBA, GL_FLOAT, 16};
    }
}

// Keeps the channels that the format has.
static void narrow_texels(enum gpu_format format, size_t count, const void *wide, void *narrow)
{
    const uint32_t channels = gpu_format_channels(format);
    for (size_t i = 0; i < count; i++) {
        for (uint32_t c = 0; c < channels; c++) {
            switch (format_infos[format].type) {
            case GL_UNSIGNED_BYTE:
                ((uint8_t *)narrow)[i * channels + c] = ((const uint8_t *)wide)[i * 4 + c];
                break;
            case GL_UNSIGNED_SHORT:
                ((uint16_t *)narrow)[i * channels + c] = ((const uint16_t *)wide)[i * 4 + c];
                break;
            case GL_SHORT:
                ((int16_t *)narrow)[i * channels + c] = (int16_t)((const int32_t *)wide)[i * 4 + c];
                break;
            default:
                ((float *)narrow)[i * channels + c] = ((const float *)wide)[i * 4 + c];
            }
        }
    }
}

static void read_slices(const struct gpu_texture *texture, const struct gpu_region *region,
                        void *wide, void *data)
{
    const struct format_info *info = &format_infos[texture->format];
    const struct wide_texel wide_texel = choose_wide(texture->format);
    const bool is_depth = texture->format == GPU_FORMAT_DEPTH32F;
    const size_t texels = (size_t)region->width * region->height;
    gpu_pack_reset();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, texture->gpu->read_framebuffer);
    const GLenum attachment = is_depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0;
    for (uint32_t z = 0; z < region->depth; z++) {
        gpu_texture_attach(texture, GL_READ_FRAMEBUFFER, attachment, (GLint)region->level,
                           (GLint)(region->z + z));
        glReadBuffer(is_depth ? GL_NONE : GL_COLOR_ATTACHMENT0);
        char *slice = (char *)data + z * texels * gpu_format_texel_bytes(texture->format);
        glReadPixels((GLint)region->x, (GLint)region->y, (GLsizei)region->width,
                     (GLsizei)region->height, wide ? wide_texel.external : info->external,
                     wide ? wide_texel.type : info->type, wide ? wide : slice);
        if (wide) {
            narrow_texels(texture->format, texels, wide, slice);
        }
    }
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, attachment, GL_TEXTURE_2D, 0, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

trl_result gpu_texture_read(const struct gpu_texture *texture, const struct gpu_region *region,
                            void *data)
{
    const trl_result result = check_region(texture, region, "gpu_texture_read");
    if (result != TRL_OK) {
        return result;
    }
    struct gpu *gpu = texture->gpu;
    void *wide = NULL;
    if (gpu->caps.is_es) {
        if (texture->format == GPU_FORMAT_DEPTH32F) {
            return trl_fail(gpu->ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GPU_OBJECT,
                            "OpenGL ES does not read depth back");
        }
        const size_t texels = (size_t)region->width * region->height;
        wide = mem_alloc(gpu->ctx, texels, choose_wide(texture->format).bytes);
        if (!wide) {
            return TRL_ERROR_MEMORY;
        }
    }
    read_slices(texture, region, wide, data);
    mem_free(gpu->ctx, wide);
    return gpu_check(gpu, "gpu_texture_read");
}
