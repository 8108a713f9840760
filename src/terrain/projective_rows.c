// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/projective_rows.h"

#include "gpu/pass.h"
#include "shared/projective.glsl"

#include <math.h>
#include <stdio.h>

enum { PROBE_COLUMNS = 32, RINGS = 384, BLOCK = 16 };
_Static_assert(RINGS % BLOCK == 0, "projective_blocks.frag takes whole blocks");

enum map { PROBES, HIGHEST, SEEN, WEIGHTS, ROWS };
_Static_assert((int)ROWS + 1 == (int)PROJECTIVE_MAPS, "a pass for each map");

// `near` of the rings, over the height above the ground.
static const double EVEN_WITHIN = 0.5;
// Rows: what follows the relief, what follows the picture; the rest is even over the rings.
static const float CHORD_SHARE = 0.7f;
static const float PIXEL_SHARE = 0.1f;
// zeta: rays below this part of the tangent meet the primary sphere only.
static const float BLEND_START = 0.5f;

static trl_result make_maps(struct projective_rows *rows)
{
    const struct {
        const char *label;
        enum gpu_format format;
        uint32_t width, height;
    } shapes[PROJECTIVE_MAPS] = {
        [PROBES] = {"projective probes", GPU_FORMAT_RG32F, PROBE_COLUMNS, RINGS},
        [HIGHEST] = {"projective highest", GPU_FORMAT_R32F, PROBE_COLUMNS, RINGS / BLOCK},
        [SEEN] = {"projective seen", GPU_FORMAT_RGBA32F, PROBE_COLUMNS, RINGS},
        [WEIGHTS] = {"projective weights", GPU_FORMAT_RGBA32F, RINGS, 1},
        [ROWS] = {"projective rows", GPU_FORMAT_R32F, rows->count, 1}};
    trl_result result = TRL_OK;
    for (int i = 0; i < PROJECTIVE_MAPS && result == TRL_OK; i++) {
        struct gpu_texture_desc desc = gpu_texture_desc_default();
        desc.label = shapes[i].label;
        desc.format = shapes[i].format;
        desc.filter = GPU_FILTER_NEAREST;
        desc.width = shapes[i].width;
        desc.height = shapes[i].height;
        result = gpu_target_init_texture(rows->gpu, &desc, NULL, &rows->maps[i].texture,
                                         &rows->maps[i].target);
    }
    return result;
}

static trl_result make_rings(struct projective_rows *rows)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "projective rings";
    desc.format = GPU_FORMAT_R32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = RINGS;
    return gpu_texture_init(rows->gpu, &desc, &rows->rings);
}

static double find_ring(double part, double near, double reach)
{
    double low = 0;
    double high = reach;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (projective_rings_within(middle, near, reach) < part) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

static trl_result upload_rings(struct projective_rows *rows, const struct sampling_camera *s)
{
    const double near = EVEN_WITHIN * s->height_m / rows->surface->radius_m;
    float angles[RINGS];
    for (int i = 0; i < RINGS; i++) {
        angles[i] = (float)find_ring(i / (RINGS - 1.0), near, s->reach_rad);
    }
    angles[0] = 0;
    angles[RINGS - 1] = (float)s->reach_rad;
    const struct gpu_region all = gpu_texture_region(&rows->rings, 0);
    return gpu_texture_upload(&rows->rings, &all, angles);
}

static trl_result make_programs(struct projective_rows *rows)
{
    static const char *const FILES[PROJECTIVE_MAPS] = {[HIGHEST] = "terrain/projective_blocks.frag",
                                                       [SEEN] = "terrain/projective_seen.frag",
                                                       [WEIGHTS] =
                                                           "terrain/projective_weights.frag",
                                                       [ROWS] = "terrain/projective_rows.frag"};
    char placing[32];
    snprintf(placing, sizeof placing, "ROWS_BY_SPHERES %d",
             rows->placing == TRL_PROJECTIVE_ROWS_SPHERES ? 1 : 0);
    const char *const placings[1] = {placing};
    trl_result result =
        height_programs_init(rows->surface, "terrain/projective_probe.frag", &rows->probes);
    for (int i = HIGHEST; i < PROJECTIVE_MAPS && result == TRL_OK; i++) {
        const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                              .fragment = FILES[i],
                                              .defines = placings,
                                              .define_count = 1};
        result = gpu_program_init(rows->gpu, &desc, &rows->programs[i]);
    }
    return result;
}

trl_result projective_rows_init(const struct surface *surface,
                                const struct projective_rows_desc *desc,
                                struct projective_rows *out)
{
    *out = (struct projective_rows){
        .gpu = surface->gpu, .surface = surface, .count = desc->count, .placing = desc->placing};
    trl_result result = make_maps(out);
    result = result == TRL_OK ? make_rings(out) : result;
    result = result == TRL_OK ? make_programs(out) : result;
    if (result != TRL_OK) {
        projective_rows_finish(out);
    }
    return result;
}

void projective_rows_finish(struct projective_rows *rows)
{
    height_programs_finish(&rows->probes);
    for (int i = 0; i < PROJECTIVE_MAPS; i++) {
        gpu_program_finish(&rows->programs[i]);
        gpu_target_finish(&rows->maps[i].target);
        gpu_texture_finish(&rows->maps[i].texture);
    }
    gpu_texture_finish(&rows->rings);
    *rows = (struct projective_rows){0};
}

void projective_rows_bind(const struct projective_rows *rows,
                          const struct projective_rows_inputs *in, struct gpu_program *program)
{
    const struct sampling_camera *s = in->camera;
    const double radius_m = rows->surface->radius_m;
    const double altitude_m = s->distance_m - radius_m;
    const float high = (float)altitude_m;
    const float eye[4] = {high, (float)(altitude_m - (double)high), (float)radius_m,
                          (float)s->reach_rad};
    gpu_program_set_vec4(program, "u_eye", eye);
    gpu_program_set_texture(program, "u_rings", &rows->rings);
    gpu_program_set_texture(program, "u_columns", in->columns);
}

static void set_inputs(struct projective_rows *rows, const struct projective_rows_inputs *in,
                       struct gpu_program *probes)
{
    const struct sampling_camera *s = in->camera;
    const float step = (float)in->column_count / PROBE_COLUMNS;
    const float probe[2] = {step, (float)((s->to_rad - s->from_rad) / in->column_count)};
    const float forward[3] = {(float)s->forward.x, (float)s->forward.y, (float)s->forward.z};
    const float placing[4] = {(float)rows->count, CHORD_SHARE, PIXEL_SHARE, BLEND_START};
    gpu_program_set_vec2(probes, "u_probe", probe);
    gpu_program_set_texture(&rows->programs[HIGHEST], "u_probes", &rows->maps[PROBES].texture);
    gpu_program_set_texture(&rows->programs[SEEN], "u_probes", &rows->maps[PROBES].texture);
    gpu_program_set_texture(&rows->programs[SEEN], "u_highest", &rows->maps[HIGHEST].texture);
    gpu_program_set_float(&rows->programs[SEEN], "u_probe_step", step);
    gpu_program_set_vec3(&rows->programs[SEEN], "u_forward", forward);
    gpu_program_set_texture(&rows->programs[WEIGHTS], "u_seen", &rows->maps[SEEN].texture);
    gpu_program_set_texture(&rows->programs[ROWS], "u_weights", &rows->maps[WEIGHTS].texture);
    gpu_program_set_vec4(&rows->programs[ROWS], "u_rows", placing);
}

trl_result projective_rows_draw(struct projective_rows *rows,
                                const struct projective_rows_inputs *in)
{
    const struct surface_eye layers = sampling_camera_eye(in->camera, rows->surface);
    struct gpu_program *probes = height_programs_bind(&rows->probes, &layers, &in->camera->anchor);
    set_inputs(rows, in, probes);
    trl_result result = upload_rings(rows, in->camera);
    for (int i = 0; i < PROJECTIVE_MAPS && result == TRL_OK; i++) {
        struct gpu_program *program = i == PROBES ? probes : &rows->programs[i];
        projective_rows_bind(rows, in, program);
        const struct gpu_pass pass = {.target = &rows->maps[i].target};
        gpu_pass_begin(rows->gpu, &pass);
        result = gpu_draw_fullscreen(program, "projective rows");
    }
    return result;
}

uint64_t projective_rows_bytes(const struct projective_rows *rows)
{
    uint64_t bytes = 0;
    for (int i = 0; i < PROJECTIVE_MAPS; i++) {
        const struct gpu_texture *t = &rows->maps[i].texture;
        bytes += (uint64_t)t->width * t->height * gpu_format_texel_bytes(t->format);
    }
    return bytes;
}

const struct gpu_texture *projective_rows_texture(const struct projective_rows *rows)
{
    return &rows->maps[ROWS].texture;
}
