// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "gpu/mesh.h"
#include "gpu/internal.h"

struct component_info {
    GLenum type;
    uint32_t bytes;
    GLboolean is_normalized;
};

static struct component_info describe_component(enum gpu_component type)
{
    switch (type) {
    case GPU_COMPONENT_FLOAT:
        return (struct component_info){GL_FLOAT, 4, GL_FALSE};
    case GPU_COMPONENT_UNORM8:
        return (struct component_info){GL_UNSIGNED_BYTE, 1, GL_TRUE};
    case GPU_COMPONENT_INT16:
        return (struct component_info){GL_SHORT, 2, GL_FALSE};
    }
    return (struct component_info){GL_FLOAT, 4, GL_FALSE};
}

static trl_result check_mesh(const struct gpu *gpu, const struct gpu_mesh_desc *desc)
{
    bool is_good = desc->vertex_count <= INT32_MAX && desc->index_count <= INT32_MAX &&
                   desc->attribute_count <= GPU_MESH_MAX_ATTRIBUTES &&
                   (desc->index_count == 0 || desc->indices);
    for (uint32_t i = 0; is_good && i < desc->attribute_count; i++) {
        const struct gpu_attribute *a = &desc->attributes[i];
        const uint32_t stride = a->is_per_instance ? desc->instance_stride : desc->vertex_stride;
        const uint64_t end =
            (uint64_t)a->offset + (uint64_t)a->components * describe_component(a->type).bytes;
        is_good = a->components >= 1 && a->components <= 4 && end <= stride && a->location < 16;
    }
    for (uint32_t i = 0; is_good && i < desc->index_count; i++) {
        is_good = desc->indices[i] < desc->vertex_count;
    }
    if (is_good) {
        return TRL_OK;
    }
    return trl_fail(gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                    "%s: an attribute is outside its vertex, or an index beyond the vertices",
                    desc->label ? desc->label : "mesh");
}

static void set_attributes(const struct gpu_mesh *mesh, const struct gpu_mesh_desc *desc)
{
    for (uint32_t i = 0; i < desc->attribute_count; i++) {
        const struct gpu_attribute *a = &desc->attributes[i];
        const struct component_info info = describe_component(a->type);
        glBindBuffer(GL_ARRAY_BUFFER,
                     a->is_per_instance ? mesh->instance_buffer : mesh->vertex_buffer);
        glEnableVertexAttribArray(a->location);
        glVertexAttribPointer(
            a->location, (GLint)a->components, info.type, info.is_normalized,
            (GLsizei)(a->is_per_instance ? desc->instance_stride : desc->vertex_stride),
            (const void *)(uintptr_t)a->offset);
        glVertexAttribDivisor(a->location, a->is_per_instance ? 1 : 0);
    }
}

trl_result gpu_mesh_init(struct gpu *gpu, const struct gpu_mesh_desc *desc, struct gpu_mesh *out)
{
    *out = (struct gpu_mesh){0};
    trl_result result = check_mesh(gpu, desc);
    if (result != TRL_OK) {
        return result;
    }
    *out = (struct gpu_mesh){.gpu = gpu,
                             .primitive = desc->primitive,
                             .patch_vertices = desc->patch_vertices,
                             .vertex_count = desc->vertex_count,
                             .index_count = desc->index_count,
                             .vertex_stride = desc->vertex_stride,
                             .instance_stride = desc->instance_stride};
    gpu->live_objects++;
    glGenVertexArrays(1, &out->vertex_array);
    glBindVertexArray(out->vertex_array);
    if (desc->vertex_stride > 0) {
        glGenBuffers(1, &out->vertex_buffer);
        glBindBuffer(GL_ARRAY_BUFFER, out->vertex_buffer);
        glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)desc->vertex_count * desc->vertex_stride,
                     desc->vertices, desc->vertices ? GL_STATIC_DRAW : GL_DYNAMIC_DRAW);
    }
    if (desc->index_count > 0) {
        glGenBuffers(1, &out->index_buffer);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, out->index_buffer);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)desc->index_count * 4, desc->indices,
                     GL_STATIC_DRAW);
    }
    if (desc->instance_stride > 0) {
        glGenBuffers(1, &out->instance_buffer);
    }
    set_attributes(out, desc);
    glBindVertexArray(0);
    gpu_label(gpu, GL_VERTEX_ARRAY, out->vertex_array, desc->label);
    result = gpu_check(gpu, desc->label ? desc->label : "gpu_mesh_init");
    if (result != TRL_OK) {
        gpu_mesh_finish(out);
    }
    return result;
}

void gpu_mesh_finish(struct gpu_mesh *mesh)
{
    if (mesh->gpu) {
        const GLuint buffers[] = {mesh->vertex_buffer, mesh->index_buffer, mesh->instance_buffer};
        glDeleteBuffers(3, buffers); // 0 is ignored
        glDeleteVertexArrays(1, &mesh->vertex_array);
        mesh->gpu->live_objects--;
    }
    *mesh = (struct gpu_mesh){0};
}

static trl_result replace_data(struct gpu *gpu, GLuint buffer, size_t bytes, const void *data)
{
    if (buffer == 0) {
        return trl_fail(gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                        "the mesh was made without such data");
    }
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)bytes, data, GL_DYNAMIC_DRAW);
    return gpu_check(gpu, "gpu_mesh_update");
}

trl_result gpu_mesh_update_vertices(struct gpu_mesh *mesh, const void *vertices)
{
    return replace_data(mesh->gpu, mesh->vertex_buffer,
                        (size_t)mesh->vertex_count * mesh->vertex_stride, vertices);
}

trl_result gpu_mesh_update_instances(struct gpu_mesh *mesh, const void *instances, uint32_t count)
{
    return replace_data(mesh->gpu, mesh->instance_buffer, (size_t)count * mesh->instance_stride,
                        instances);
}

trl_result gpu_buffer_init(struct gpu *gpu, const char *label, size_t size, struct gpu_buffer *out)
{
    *out = (struct gpu_buffer){0};
    GLint limit = 0;
    glGetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &limit);
    if (size == 0 || size > (size_t)limit) {
        return trl_fail(gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                        "%s: a uniform block of %zu bytes; this GPU has 1 to %d",
                        label ? label : "buffer", size, limit);
    }
    *out = (struct gpu_buffer){.gpu = gpu, .size = size};
    gpu->live_objects++;
    glGenBuffers(1, &out->name);
    glBindBuffer(GL_UNIFORM_BUFFER, out->name);
    glBufferData(GL_UNIFORM_BUFFER, (GLsizeiptr)size, NULL, GL_DYNAMIC_DRAW);
    gpu_label(gpu, GL_BUFFER, out->name, label);
    const trl_result result = gpu_check(gpu, label ? label : "gpu_buffer_init");
    if (result != TRL_OK) {
        gpu_buffer_finish(out);
    }
    return result;
}

trl_result gpu_buffer_update(struct gpu_buffer *buffer, const void *data)
{
    // New storage rather than a change of the old: earlier draws may still read that.
    glBindBuffer(GL_UNIFORM_BUFFER, buffer->name);
    glBufferData(GL_UNIFORM_BUFFER, (GLsizeiptr)buffer->size, data, GL_DYNAMIC_DRAW);
    return gpu_check(buffer->gpu, "gpu_buffer_update");
}

void gpu_buffer_finish(struct gpu_buffer *buffer)
{
    if (buffer->gpu) {
        glDeleteBuffers(1, &buffer->name);
        buffer->gpu->live_objects--;
    }
    *buffer = (struct gpu_buffer){0};
}
