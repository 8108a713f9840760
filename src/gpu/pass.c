// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "gpu/pass.h"
#include "gpu/internal.h"

static void set_enabled(GLenum key, bool is_enabled)
{
    if (is_enabled) {
        glEnable(key);
    } else {
        glDisable(key);
    }
}

static void set_depth(enum gpu_depth depth)
{
    GLenum function = GL_ALWAYS;
    switch (depth) {
    case GPU_DEPTH_ALWAYS:
        break;
    case GPU_DEPTH_NEARER:
        function = GL_GREATER;
        break;
    case GPU_DEPTH_NEARER_OR_EQUAL:
        function = GL_GEQUAL;
        break;
    case GPU_DEPTH_EQUAL:
        function = GL_EQUAL;
        break;
    case GPU_DEPTH_FARTHER:
        function = GL_LESS;
        break;
    case GPU_DEPTH_LESS_EQUAL:
        function = GL_LEQUAL;
        break;
    }
    glDepthFunc(function);
}

static void set_blend(enum gpu_blend blend)
{
    set_enabled(GL_BLEND, blend != GPU_BLEND_NONE);
    glBlendEquation(GL_FUNC_ADD);
    switch (blend) {
    case GPU_BLEND_NONE:
        break;
    case GPU_BLEND_ALPHA:
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        break;
    case GPU_BLEND_PREMULTIPLIED:
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        break;
    case GPU_BLEND_ADD:
        glBlendFunc(GL_ONE, GL_ONE);
        break;
    }
}

// What no pass uses, but an embedder may have switched on.
static void disable_unused(const struct gpu *gpu)
{
    static const GLenum everywhere[] = {GL_STENCIL_TEST,
                                        GL_DITHER,
                                        GL_POLYGON_OFFSET_FILL,
                                        GL_RASTERIZER_DISCARD,
                                        GL_SAMPLE_ALPHA_TO_COVERAGE,
                                        GL_SAMPLE_COVERAGE};
    static const GLenum desktop[] = {GL_COLOR_LOGIC_OP, GL_DEPTH_CLAMP, GL_PRIMITIVE_RESTART,
                                     GL_PROGRAM_POINT_SIZE};
    for (size_t i = 0; i < sizeof everywhere / sizeof *everywhere; i++) {
        glDisable(everywhere[i]);
    }
    if (!gpu->caps.is_es) {
        for (size_t i = 0; i < sizeof desktop / sizeof *desktop; i++) {
            glDisable(desktop[i]);
        }
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    }
}

static void set_state(const struct gpu *gpu, const struct gpu_pass *pass)
{
    const struct gpu_state *state = &pass->state;
    // Depth is not written while the test is off, so ALWAYS with writing is a test that passes.
    set_enabled(GL_DEPTH_TEST, state->depth != GPU_DEPTH_ALWAYS || state->writes_depth);
    set_depth(state->depth);
    glDepthMask(state->writes_depth ? GL_TRUE : GL_FALSE);
    set_enabled(GL_CULL_FACE, state->cull != GPU_CULL_NONE);
    glCullFace(state->cull == GPU_CULL_FRONT ? GL_FRONT : GL_BACK);
    glFrontFace(GL_CCW);
    set_blend(state->blend);
    const GLboolean shows = state->hides_color ? GL_FALSE : GL_TRUE;
    glColorMask(shows, shows, shows, shows);
    if (!gpu->caps.is_es) {
        set_enabled(GL_FRAMEBUFFER_SRGB, pass->target->is_srgb); // always on in ES
    }
    if (gpu->caps.has_clip_control) {
        if (gpu->caps.is_es) {
            glClipControlEXT(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        } else {
            glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        }
    }
}

static void clear(const struct gpu *gpu, const struct gpu_pass *pass)
{
    if (pass->clears_color) {
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        for (uint32_t i = 0; i < pass->target->color_count; i++) {
            glClearBufferfv(GL_COLOR, (GLint)i, pass->color);
        }
    }
    if (pass->clears_depth && pass->target->has_depth) {
        // The value stands for clip z; without clip control the window's depth is the middle of
        // that and 1.
        const float depth = gpu->caps.has_clip_control ? pass->depth : 0.5f + 0.5f * pass->depth;
        glDepthMask(GL_TRUE);
        glClearBufferfv(GL_DEPTH, 0, &depth);
    }
}

static bool is_empty(struct gpu_rect rect)
{
    return rect.width == 0 || rect.height == 0;
}

void gpu_pass_begin(struct gpu *gpu, const struct gpu_pass *pass)
{
    const struct gpu_target *target = pass->target;
    const struct gpu_rect all = {0, 0, target->width, target->height};
    const struct gpu_rect view = is_empty(pass->viewport) ? all : pass->viewport;
    glBindFramebuffer(GL_FRAMEBUFFER, target->name);
    glViewport((GLint)view.x, (GLint)view.y, (GLsizei)view.width, (GLsizei)view.height);
    glDepthRangef(0, 1);
    set_enabled(GL_SCISSOR_TEST, !is_empty(pass->scissor));
    if (!is_empty(pass->scissor)) {
        glScissor((GLint)pass->scissor.x, (GLint)pass->scissor.y, (GLsizei)pass->scissor.width,
                  (GLsizei)pass->scissor.height);
    }
    disable_unused(gpu);
    if (!gpu->caps.is_es) {
        set_enabled(GL_FRAMEBUFFER_SRGB, target->is_srgb); // clears convert too
    }
    clear(gpu, pass);
    set_state(gpu, pass);
}

trl_result gpu_draw_fullscreen(struct gpu_program *program, const char *where)
{
    const trl_result result = gpu_program_bind(program);
    if (result != TRL_OK) {
        return result;
    }
    glBindVertexArray(program->gpu->empty_vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    return gpu_check(program->gpu, where);
}

static GLenum gl_primitive(enum gpu_primitive primitive)
{
    switch (primitive) {
    case GPU_PRIMITIVE_TRIANGLES:
        return GL_TRIANGLES;
    case GPU_PRIMITIVE_TRIANGLE_STRIP:
        return GL_TRIANGLE_STRIP;
    case GPU_PRIMITIVE_LINES:
        return GL_LINES;
    case GPU_PRIMITIVE_POINTS:
        return GL_POINTS;
    case GPU_PRIMITIVE_PATCHES:
        return GL_PATCHES;
    }
    return GL_TRIANGLES;
}

static trl_result check_draw(const struct gpu_program *program, const struct gpu_mesh *mesh,
                             struct gpu_draw_range range, const char *where)
{
    const uint32_t all = mesh->index_count > 0 ? mesh->index_count : mesh->vertex_count;
    if (range.first > all || range.count > all - range.first || range.instances > INT32_MAX) {
        return trl_fail(program->gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s: %u from %u of a mesh of %u", where, range.count, range.first, all);
    }
    if (program->has_tessellation != (mesh->primitive == GPU_PRIMITIVE_PATCHES)) {
        return trl_fail(program->gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s: patches and tessellation go together", where);
    }
    return TRL_OK;
}

trl_result gpu_draw_mesh_range(struct gpu_program *program, const struct gpu_mesh *mesh,
                               struct gpu_draw_range range, const char *where)
{
    trl_result result = check_draw(program, mesh, range, where);
    if (result != TRL_OK || range.count == 0 || range.instances == 0) {
        return result;
    }
    if ((result = gpu_program_bind(program)) != TRL_OK) {
        return result;
    }
    const GLenum primitive = gl_primitive(mesh->primitive);
    glBindVertexArray(mesh->vertex_array);
    if (primitive == GL_PATCHES) {
        glPatchParameteri(GL_PATCH_VERTICES, (GLint)mesh->patch_vertices);
    }
    if (mesh->index_count > 0) {
        glDrawElementsInstanced(primitive, (GLsizei)range.count, GL_UNSIGNED_INT,
                                (const void *)((uintptr_t)range.first * 4),
                                (GLsizei)range.instances);
    } else {
        glDrawArraysInstanced(primitive, (GLint)range.first, (GLsizei)range.count,
                              (GLsizei)range.instances);
    }
    glBindVertexArray(0);
    return gpu_check(program->gpu, where);
}

trl_result gpu_draw_mesh(struct gpu_program *program, const struct gpu_mesh *mesh,
                         uint32_t instances, const char *where)
{
    const uint32_t all = mesh->index_count > 0 ? mesh->index_count : mesh->vertex_count;
    return gpu_draw_mesh_range(program, mesh, (struct gpu_draw_range){0, all, instances}, where);
}
