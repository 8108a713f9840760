// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Values, textures and blocks arrive in shaders; mistakes in them are told with file and line.
#include "fixture.h"
#include "gpu/shader_source.h"
#include "shaders/test_block.glsl"

#include <math.h>
#include <string.h>

static const char vertex[] = "lib/fullscreen.vert";

static struct gpu_program make_program(struct fixture *f, const char *fragment)
{
    static const char *const defines[] = {"SCALE 2"};
    const struct gpu_program_desc desc = {
        .vertex = vertex, .fragment = fragment, .defines = defines, .define_count = 1};
    struct gpu_program program;
    const trl_result result = gpu_program_init(f->gpu, &desc, &program);
    if (result != TRL_OK) {
        print_error("%s\n", f->last_error);
    }
    assert_int_equal(result, TRL_OK);
    return program;
}

static void expect_texel(const struct gpu_texture *texture, const float wanted[4])
{
    const struct texel got = fixture_read(texture, 1, 2);
    for (int i = 0; i < 4; i++) {
        // All numbers of these tests are small integers or dyadic fractions, which float sums keep.
        assert_true(got.rgba[i] == wanted[i]);
    }
}

static void set_uniforms(struct gpu_program *program)
{
    const float two[2] = {0, 100}, three[3] = {0, 0, 5}, four[4] = {0, 0, 0, 7};
    // Columns after one another: row 2 of column 1, and row 3 of column 0.
    const float mat3[9] = {[5] = 9}, mat4[16] = {[3] = 11};
    const float floats[5] = {0, 0, 13}, vec4s[8] = {[4] = 17};
    gpu_program_set_float(program, "u_float", 0.5f);
    gpu_program_set_int(program, "u_int", -3);
    gpu_program_set_vec2(program, "u_vec2", two);
    gpu_program_set_vec3(program, "u_vec3", three);
    gpu_program_set_vec4(program, "u_vec4", four);
    gpu_program_set_mat3(program, "u_mat3", mat3);
    gpu_program_set_mat4(program, "u_mat4", mat4);
    gpu_program_set_floats(program, "u_floats", floats, 5); // more than the shader has
    gpu_program_set_vec4s(program, "u_vec4s", vec4s, 2);
    gpu_program_set_float(program, "u_unknown", 1);
}

static void every_kind_of_uniform_arrives(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f, "uniforms.frag");
    struct gpu_buffer buffer;
    assert_int_equal(gpu_buffer_init(f->gpu, "block", sizeof(struct TestBlock), &buffer), TRL_OK);
    const struct TestBlock block = {.block_matrix = {[4] = 1, [9] = 1},
                                    .block_vector = {0, 1000, 2000, 0},
                                    .block_array = {[4] = 1, 2, 3, 4}};
    assert_int_equal(gpu_buffer_update(&buffer, &block), TRL_OK);
    gpu_pass_begin(f->gpu, &(struct gpu_pass){.target = &f->target});
    fixture_expect_error(f, gpu_draw_fullscreen(&program, "no block"), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    assert_true(gpu_program_has(&program, "TestBlock"));
    assert_true(gpu_program_has(&program, "u_floats"));
    assert_false(gpu_program_has(&program, "u_unknown"));
    gpu_program_set_block(&program, "TestBlock", &buffer);
    set_uniforms(&program);
    assert_int_equal(gpu_draw_fullscreen(&program, "uniforms"), TRL_OK);
    // The matrix takes y to x and z to y; the array's second vector is added twice (SCALE).
    const float wanted[4] = {97.5f + 1000 + 2, 12 + 2000 + 4, 30 + 6, 20 + 8};
    expect_texel(&f->color, wanted);
    gpu_buffer_finish(&buffer);
    gpu_program_finish(&program);
}

static struct gpu_texture make_texture(struct fixture *f, enum gpu_shape shape,
                                       enum gpu_format format, const void *data)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.shape = shape;
    desc.format = format;
    desc.depth = shape == GPU_SHAPE_2D ? 1 : 2;
    desc.filter = format == GPU_FORMAT_R16F ? GPU_FILTER_LINEAR : GPU_FILTER_NEAREST;
    desc.data = data;
    struct gpu_texture texture;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
    return texture;
}

static void every_kind_of_sampler_arrives(void **state)
{
    struct fixture *f = *state;
    const float values[2] = {4, 8};
    const int16_t height = -1234;
    struct gpu_texture image = make_texture(f, GPU_SHAPE_2D, GPU_FORMAT_R32F, values);
    struct gpu_texture volume = make_texture(f, GPU_SHAPE_3D, GPU_FORMAT_R16F, values);
    struct gpu_texture layers = make_texture(f, GPU_SHAPE_2D_ARRAY, GPU_FORMAT_R32F, values);
    struct gpu_texture heights = make_texture(f, GPU_SHAPE_2D, GPU_FORMAT_R16I, &height);
    struct gpu_program program = make_program(f, "samplers.frag");
    gpu_program_set_texture(&program, "u_image", &volume); // of the wrong kind
    gpu_program_set_texture(&program, "u_volume", &volume);
    gpu_program_set_texture(&program, "u_layers", &layers);
    gpu_program_set_texture(&program, "u_heights", &heights);
    gpu_pass_begin(f->gpu, &(struct gpu_pass){.target = &f->target});
    fixture_expect_error(f, gpu_draw_fullscreen(&program, "wrong kind"), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    assert_non_null(strstr(f->last_error, "u_image"));
    gpu_program_set_texture(&program, "u_image", &image);
    assert_int_equal(gpu_draw_fullscreen(&program, "samplers"), TRL_OK);
    const float wanted[4] = {4, 6, 8, -1234}; // the volume between its two slices
    expect_texel(&f->color, wanted);
    gpu_texture_finish(&image);
    gpu_texture_finish(&volume);
    gpu_texture_finish(&layers);
    gpu_texture_finish(&heights);
    gpu_program_finish(&program);
}

static void expect_refused(struct fixture *f, const char *fragment, trl_result why,
                           const char *words)
{
    const struct gpu_program_desc desc = {.vertex = vertex, .fragment = fragment};
    struct gpu_program program;
    fixture_expect_error(f, gpu_program_init(f->gpu, &desc, &program), why, TRL_LOG_ITEM_SHADER);
    assert_null(program.gpu);
    if (!strstr(f->last_error, words)) {
        print_error("no \"%s\" in: %s\n", words, f->last_error);
    }
    assert_non_null(strstr(f->last_error, words));
}

static void errors_name_file_and_line(void **state)
{
    struct fixture *f = *state;
    expect_refused(f, "broken.frag", TRL_ERROR_GPU, "broken_part.glsl:5");
    expect_refused(f, "broken_after_include.frag", TRL_ERROR_GPU, "broken_after_include.frag:8");
    expect_refused(f, "missing_include.frag", TRL_ERROR_INVALID, "missing_include.frag:4");
    expect_refused(f, "no_such.frag", TRL_ERROR_INVALID, "no_such.frag");
    expect_refused(f, "unlinkable.frag", TRL_ERROR_GPU, "link");
}

// The forms of Mesa, NVIDIA and ANGLE; what has no place, or that of no file, stays as it is.
static void every_drivers_places_are_understood(void **state)
{
    struct fixture *f = *state;
    const struct shader_request request = {.name = "broken.frag", .language = {.version = 330}};
    struct shader_source source;
    assert_int_equal(shader_source_init(f->ctx, &request, &source), TRL_OK);
    assert_int_equal(source.file_count, 2);
    static const char *const cases[][2] = {
        {"1:5(12): error: x", "broken_part.glsl:5(12): error: x"},
        {"0(7) : error C1: x", "broken.frag:7 : error C1: x"},
        {"ERROR: 1:5: 'x' : y\nERROR: 0:7: z\n", "broken_part.glsl:5: 'x' : y\nbroken.frag:7: z"},
        {"WARNING: 0:3: x\n\n", "broken.frag:3: x"},
        {"2:5: no such file", "2:5: no such file"},
        {"3 errors generated\n1:", "3 errors generated\n1:"},
        {"12:\n34", "12:\n34"},
        {"", ""}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = shader_source_explain(&source, cases[i][0]);
        assert_non_null(text);
        assert_string_equal(text, cases[i][1]);
        mem_free(f->ctx, text);
    }
    shader_source_finish(&source);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_uniform_arrives),
        cmocka_unit_test(every_kind_of_sampler_arrives),
        cmocka_unit_test(errors_name_file_and_line),
        cmocka_unit_test(every_drivers_places_are_understood),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
