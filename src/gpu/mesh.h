// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_MESH_H
#define GPU_MESH_H
// Vertices and indices in GPU memory, and buffers of uniforms.

#include "gpu/gpu.h"

enum { GPU_MESH_MAX_ATTRIBUTES = 8 };

enum gpu_primitive {
    GPU_PRIMITIVE_TRIANGLES,
    GPU_PRIMITIVE_TRIANGLE_STRIP,
    GPU_PRIMITIVE_LINES,
    GPU_PRIMITIVE_POINTS,
    GPU_PRIMITIVE_PATCHES // of mesh_desc.patch_vertices, with a tessellation program
};

enum gpu_component {
    GPU_COMPONENT_FLOAT,
    GPU_COMPONENT_UNORM8, // bytes, read as [0, 1]
    GPU_COMPONENT_INT16   // read as floats of the same value
};

struct gpu_attribute {
    uint32_t location;   // `layout(location = n) in` of the vertex shader
    uint32_t components; // 1 to 4
    enum gpu_component type;
    uint32_t offset;      // bytes into the vertex, or into the instance
    bool is_per_instance; // taken from the instance data
};

struct gpu_mesh_desc {
    const char *label;
    enum gpu_primitive primitive;
    uint32_t patch_vertices;  // for patches
    uint32_t vertex_count;    // also without data: the shader then has gl_VertexID only
    uint32_t vertex_stride;   // bytes; 0: no vertex data
    const void *vertices;     // NULL: undefined until updated
    uint32_t index_count;     // 0: drawn in order
    const uint32_t *indices;  // copied; primitive restart is off
    uint32_t instance_stride; // bytes; 0: no instance data
    uint32_t attribute_count;
    struct gpu_attribute attributes[GPU_MESH_MAX_ATTRIBUTES];
};

struct gpu_mesh {
    struct gpu *gpu;
    uint32_t vertex_array, vertex_buffer, index_buffer, instance_buffer;
    enum gpu_primitive primitive;
    uint32_t patch_vertices, vertex_count, index_count, vertex_stride, instance_stride;
};

// TRL_ERROR_INVALID: an attribute outside its vertex, or sizes that overflow; TRL_ERROR_GPU.
TRL_MUST_USE trl_result gpu_mesh_init(struct gpu *gpu, const struct gpu_mesh_desc *desc,
                                      struct gpu_mesh *out);
void gpu_mesh_finish(struct gpu_mesh *mesh);

// Replaces all vertices (as many as at init), or the instances (any number).
TRL_MUST_USE trl_result gpu_mesh_update_vertices(struct gpu_mesh *mesh, const void *vertices);
TRL_MUST_USE trl_result gpu_mesh_update_instances(struct gpu_mesh *mesh, const void *instances,
                                                  uint32_t count);

// A std140 uniform block; its C struct comes from SHARED_BLOCK in a shaders/shared/ file.
struct gpu_buffer {
    struct gpu *gpu;
    uint32_t name;
    size_t size;
};

TRL_MUST_USE trl_result gpu_buffer_init(struct gpu *gpu, const char *label, size_t size,
                                        struct gpu_buffer *out);
// Replaces all of its `size` bytes; may be called between draws that see different contents.
TRL_MUST_USE trl_result gpu_buffer_update(struct gpu_buffer *buffer, const void *data);
void gpu_buffer_finish(struct gpu_buffer *buffer);

#endif // GPU_MESH_H
