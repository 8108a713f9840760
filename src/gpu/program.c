// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "gpu/program.h"
#include "gpu/internal.h"
#include "gpu/mesh.h"
#include "gpu/shader_source.h"

#include <string.h>

enum { UNIFORM_NAME_MAX = 64, STAGE_MAX = 4 };

enum uniform_kind { UNIFORM_VALUE, UNIFORM_SAMPLER, UNIFORM_BLOCK };

// What a linked program asks for: a value, a texture or a buffer.
struct gpu_uniform {
    char name[UNIFORM_NAME_MAX];
    enum uniform_kind kind;
    GLint slot;         // location of a value, unit of a texture, binding of a block
    GLint size;         // elements of an array of values, else 1
    GLenum bind_target; // of a texture
    GLuint bound;       // name of the texture or buffer, 0: never set
};

struct stage {
    GLenum kind;
    const char *file;
};

static struct shader_language choose_language(const struct gpu *gpu,
                                              const struct gpu_program_desc *desc)
{
    const bool has_tessellation = desc->tess_control != NULL;
    const int version =
        gpu->caps.is_es ? (has_tessellation ? 320 : 300) : (has_tessellation ? 400 : 330);
    return (struct shader_language){version, gpu->caps.is_es, gpu->caps.has_clip_control};
}

static void log_numbered(const struct gpu *gpu, const char *text)
{
    int number = 1;
    for (const char *at = text; *at; number++) {
        const size_t length = strcspn(at, "\n");
        trl_log(gpu->ctx, TRL_LOG_DEBUG, TRL_LOG_ITEM_SHADER, "%4d  %.*s", number, (int)length, at);
        at += length + (at[length] == '\n');
    }
}

// The driver's words about a shader or a program, freed with mem_free.
static char *read_log(const struct gpu *gpu, GLuint name, bool is_program)
{
    GLint length = 0;
    if (is_program) {
        glGetProgramiv(name, GL_INFO_LOG_LENGTH, &length);
    } else {
        glGetShaderiv(name, GL_INFO_LOG_LENGTH, &length);
    }
    char *text = mem_alloc(gpu->ctx, (size_t)(length > 0 ? length : 0) + 1, 1);
    if (text && length > 0 && is_program) {
        glGetProgramInfoLog(name, length, NULL, text);
    } else if (text && length > 0) {
        glGetShaderInfoLog(name, length, NULL, text);
    }
    return text;
}

static trl_result fail_compile(const struct gpu *gpu, GLuint shader,
                               const struct shader_source *source)
{
    char *raw = read_log(gpu, shader, false);
    char *text = raw ? shader_source_explain(source, raw) : NULL;
    const trl_result result =
        trl_fail(gpu->ctx, TRL_ERROR_GPU, TRL_LOG_ITEM_SHADER, "%s does not compile: %s",
                 source->files[0], text && *text ? text : "the driver gives no reason");
    log_numbered(gpu, source->text);
    mem_free(gpu->ctx, text);
    mem_free(gpu->ctx, raw);
    return result;
}

// Compiles one stage and attaches it; the program keeps it alive.
static trl_result add_stage(const struct gpu_program *program, const struct gpu_program_desc *desc,
                            struct stage stage)
{
    const struct gpu *gpu = program->gpu;
    const struct shader_request request = {stage.file, desc->defines, desc->define_count,
                                           choose_language(gpu, desc)};
    struct shader_source source;
    trl_result result = shader_source_init(gpu->ctx, &request, &source);
    if (result != TRL_OK) {
        return result;
    }
    const GLuint shader = glCreateShader(stage.kind);
    const GLchar *text = source.text;
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    GLint is_compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
    if (is_compiled) {
        glAttachShader(program->name, shader);
    } else {
        result = fail_compile(gpu, shader, &source);
    }
    glDeleteShader(shader);
    shader_source_finish(&source);
    return result;
}

static trl_result link_program(const struct gpu_program *program,
                               const struct gpu_program_desc *desc)
{
    glLinkProgram(program->name);
    GLint is_linked = GL_FALSE;
    glGetProgramiv(program->name, GL_LINK_STATUS, &is_linked);
    if (is_linked) {
        return TRL_OK;
    }
    char *text = read_log(program->gpu, program->name, true);
    const trl_result result =
        trl_fail(program->gpu->ctx, TRL_ERROR_GPU, TRL_LOG_ITEM_SHADER, "%s and %s do not link: %s",
                 desc->vertex, desc->fragment, text && *text ? text : "the driver gives no reason");
    mem_free(program->gpu->ctx, text);
    return result;
}

static GLenum sampler_target(GLenum type)
{
    switch (type) {
    case GL_SAMPLER_2D:
    case GL_INT_SAMPLER_2D:
        return GL_TEXTURE_2D;
    case GL_SAMPLER_3D:
    case GL_INT_SAMPLER_3D:
        return GL_TEXTURE_3D;
    case GL_SAMPLER_2D_ARRAY:
    case GL_INT_SAMPLER_2D_ARRAY:
        return GL_TEXTURE_2D_ARRAY;
    default:
        return GL_NONE;
    }
}

// Values and samplers. Members of blocks are active uniforms too, but have no location.
static void list_uniforms(struct gpu_program *program, GLint count)
{
    GLint unit = 0;
    for (GLint i = 0; i < count; i++) {
        struct gpu_uniform uniform = {0};
        GLenum type = GL_NONE;
        glGetActiveUniform(program->name, (GLuint)i, UNIFORM_NAME_MAX, NULL, &uniform.size, &type,
                           uniform.name);
        const GLint location = glGetUniformLocation(program->name, uniform.name);
        if (location < 0) {
            continue;
        }
        uniform.name[strcspn(uniform.name, "[")] = '\0';
        uniform.bind_target = sampler_target(type);
        uniform.kind = uniform.bind_target == GL_NONE ? UNIFORM_VALUE : UNIFORM_SAMPLER;
        uniform.slot = uniform.kind == UNIFORM_SAMPLER ? unit++ : location;
        if (uniform.kind == UNIFORM_SAMPLER) {
            glUniform1i(location, uniform.slot);
        }
        program->uniforms[program->uniform_count++] = uniform;
    }
}

static void list_blocks(struct gpu_program *program, GLint count)
{
    for (GLint i = 0; i < count; i++) {
        struct gpu_uniform uniform = {.kind = UNIFORM_BLOCK, .slot = i, .size = 1};
        glGetActiveUniformBlockName(program->name, (GLuint)i, UNIFORM_NAME_MAX, NULL, uniform.name);
        glUniformBlockBinding(program->name, (GLuint)i, (GLuint)i);
        program->uniforms[program->uniform_count++] = uniform;
    }
}

static trl_result list_interface(struct gpu_program *program)
{
    GLint uniforms = 0, blocks = 0;
    glGetProgramiv(program->name, GL_ACTIVE_UNIFORMS, &uniforms);
    glGetProgramiv(program->name, GL_ACTIVE_UNIFORM_BLOCKS, &blocks);
    program->uniforms =
        mem_alloc(program->gpu->ctx, (size_t)uniforms + (size_t)blocks, sizeof *program->uniforms);
    if (!program->uniforms) {
        return TRL_ERROR_MEMORY;
    }
    glUseProgram(program->name);
    list_uniforms(program, uniforms);
    list_blocks(program, blocks);
    return gpu_check(program->gpu, "gpu_program_init");
}

trl_result gpu_program_init(struct gpu *gpu, const struct gpu_program_desc *desc,
                            struct gpu_program *out)
{
    *out = (struct gpu_program){0};
    if (desc->tess_control && !gpu->caps.has_tessellation) {
        return trl_fail(gpu->ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_SHADER,
                        "%s needs tessellation, which this GPU does not have", desc->tess_control);
    }
    const struct stage stages[STAGE_MAX] = {{GL_VERTEX_SHADER, desc->vertex},
                                            {GL_TESS_CONTROL_SHADER, desc->tess_control},
                                            {GL_TESS_EVALUATION_SHADER, desc->tess_evaluate},
                                            {GL_FRAGMENT_SHADER, desc->fragment}};
    *out = (struct gpu_program){
        .gpu = gpu, .name = glCreateProgram(), .has_tessellation = desc->tess_control != NULL};
    gpu->live_objects++;
    trl_result result = TRL_OK;
    for (size_t i = 0; result == TRL_OK && i < STAGE_MAX; i++) {
        if (stages[i].file) {
            result = add_stage(out, desc, stages[i]);
        }
    }
    if (result != TRL_OK || (result = link_program(out, desc)) != TRL_OK ||
        (result = list_interface(out)) != TRL_OK) {
        gpu_program_finish(out);
        return result;
    }
    gpu_label(gpu, GL_PROGRAM, out->name, desc->fragment);
    return TRL_OK;
}

void gpu_program_finish(struct gpu_program *program)
{
    if (program->gpu) {
        glDeleteProgram(program->name);
        mem_free(program->gpu->ctx, program->uniforms);
        program->gpu->live_objects--;
    }
    *program = (struct gpu_program){0};
}

static struct gpu_uniform *find_uniform(const struct gpu_program *program, const char *name,
                                        enum uniform_kind kind)
{
    for (size_t i = 0; i < program->uniform_count; i++) {
        struct gpu_uniform *uniform = &program->uniforms[i];
        if (uniform->kind == kind && strcmp(uniform->name, name) == 0) {
            return uniform;
        }
    }
    return NULL;
}

// Makes the program current, as setting a value needs below GL 4.1, and finds the value's location
// or -1.
static GLint use_value(const struct gpu_program *program, const char *name)
{
    const struct gpu_uniform *uniform = find_uniform(program, name, UNIFORM_VALUE);
    if (!uniform) {
        return -1;
    }
    glUseProgram(program->name);
    return uniform->slot;
}

// As many elements as the array has, so that a larger C array is no GL error.
static GLsizei clamp_count(const struct gpu_program *program, const char *name, size_t count)
{
    const struct gpu_uniform *uniform = find_uniform(program, name, UNIFORM_VALUE);
    const size_t size = uniform ? (size_t)uniform->size : 0;
    return (GLsizei)(count < size ? count : size);
}

void gpu_program_set_float(struct gpu_program *program, const char *name, float value)
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniform1f(location, value);
    }
}

void gpu_program_set_int(struct gpu_program *program, const char *name, int32_t value)
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniform1i(location, value);
    }
}

void gpu_program_set_vec2(struct gpu_program *program, const char *name, const float value[2])
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniform2fv(location, 1, value);
    }
}

void gpu_program_set_vec3(struct gpu_program *program, const char *name, const float value[3])
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniform3fv(location, 1, value);
    }
}

void gpu_program_set_vec4(struct gpu_program *program, const char *name, const float value[4])
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniform4fv(location, 1, value);
    }
}

void gpu_program_set_mat3(struct gpu_program *program, const char *name, const float value[9])
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniformMatrix3fv(location, 1, GL_FALSE, value);
    }
}

void gpu_program_set_mat4(struct gpu_program *program, const char *name, const float value[16])
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniformMatrix4fv(location, 1, GL_FALSE, value);
    }
}

void gpu_program_set_floats(struct gpu_program *program, const char *name, const float *values,
                            size_t count)
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniform1fv(location, clamp_count(program, name, count), values);
    }
}

void gpu_program_set_vec4s(struct gpu_program *program, const char *name, const float *values,
                           size_t count)
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniform4fv(location, clamp_count(program, name, count), values);
    }
}

void gpu_program_set_ivec4s(struct gpu_program *program, const char *name, const int32_t *values,
                            size_t count)
{
    const GLint location = use_value(program, name);
    if (location >= 0) {
        glUniform4iv(location, clamp_count(program, name, count), values);
    }
}

void gpu_program_set_texture(struct gpu_program *program, const char *name,
                             const struct gpu_texture *texture)
{
    struct gpu_uniform *uniform = find_uniform(program, name, UNIFORM_SAMPLER);
    if (uniform) {
        // A texture of another shape counts as none, which the next draw reports.
        uniform->bound = uniform->bind_target == gpu_texture_gl_target(texture) ? texture->name : 0;
    }
}

void gpu_program_set_block(struct gpu_program *program, const char *name,
                           const struct gpu_buffer *buffer)
{
    struct gpu_uniform *uniform = find_uniform(program, name, UNIFORM_BLOCK);
    if (uniform) {
        uniform->bound = buffer->name;
    }
}

bool gpu_program_has(const struct gpu_program *program, const char *name)
{
    for (size_t i = 0; i < program->uniform_count; i++) {
        if (strcmp(program->uniforms[i].name, name) == 0) {
            return true;
        }
    }
    return false;
}

trl_result gpu_program_bind(const struct gpu_program *program)
{
    glUseProgram(program->name);
    for (size_t i = 0; i < program->uniform_count; i++) {
        const struct gpu_uniform *uniform = &program->uniforms[i];
        if (uniform->kind == UNIFORM_VALUE) {
            continue;
        }
        if (uniform->bound == 0) {
            return trl_fail(program->gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_GPU_OBJECT,
                            "%s of a program was never set, or to another kind of texture",
                            uniform->name);
        }
        if (uniform->kind == UNIFORM_BLOCK) {
            glBindBufferBase(GL_UNIFORM_BUFFER, (GLuint)uniform->slot, uniform->bound);
        } else {
            glActiveTexture(GL_TEXTURE0 + (GLenum)uniform->slot);
            glBindTexture(uniform->bind_target, uniform->bound);
            glBindSampler((GLuint)uniform->slot, 0); // an embedder may have left one
        }
    }
    return TRL_OK;
}
