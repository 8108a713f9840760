// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What shaders/cloud/field.glsl and weather.glsl ask for.
#include "cloud/march.h"

#include "shared/cloud.glsl"

// A place in tiles of a size, without the whole ones, so that floats are enough.
static void set_anchor(float out[4], struct vec3 position_m, double tile_m)
{
    const double at[3] = {position_m.x / tile_m, position_m.y / tile_m, position_m.z / tile_m};
    for (int k = 0; k < 3; k++) {
        out[k] = (float)(at[k] - floor(at[k]));
    }
}

// The phase of what bends noise of such tiles, without whole turns.
static void set_bend(float out[4], struct vec3 position_m, double tile_m)
{
    double phase[3];
    cloud_field_bend_phase(position_m, tile_m, phase);
    for (int k = 0; k < 3; k++) {
        out[k] = (float)(phase[k] - 2 * SHARED_PI * floor(phase[k] / (2 * SHARED_PI)));
    }
}

static void set_vec3(float out[4], struct vec3 v, double w)
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
    out[3] = (float)w;
}

// What layers are, wherever the eye is.
static void set_layers(const struct cloud_field *field, struct gpu_program *program)
{
    float shell[CLOUD_MAX_LAYERS][4] = {{0}};
    float grain[CLOUD_MAX_LAYERS][4] = {{0}};
    float turn[CLOUD_MAX_LAYERS][4] = {{0}};
    float form[CLOUD_MAX_LAYERS][4] = {{0}};
    float belt[CLOUD_MAX_LAYERS][4] = {{0}};
    for (size_t i = 0; i < field->desc.layer_count; i++) {
        const struct cloud_layer *l = &field->desc.layers[i];
        shell[i][0] = (float)l->base_m;
        shell[i][1] = (float)l->top_m;
        shell[i][2] = (float)cloud_field_peak(l->type);
        shell[i][3] = (float)l->cover;
        grain[i][0] = (float)(1 / l->scale_m);
        grain[i][1] = (float)l->extinction_per_m;
        grain[i][2] = (float)cloud_field_detail(l->type);
        grain[i][3] = (float)cloud_field_overlap(l->type);
        turn[i][0] = (float)field->turn[i][0];
        turn[i][1] = (float)field->turn[i][1];
        form[i][0] = cloud_field_has_fibres(l->type)
                         ? (float)cloud_field_fibre_turns(l, field->ground_radius_m)
                         : 0.0f;
        form[i][1] = (float)l->shear_m;
        form[i][2] = (float)cloud_field_edge(l->type);
        form[i][3] = (float)(CLOUD_BORDER * l->scale_m / CLOUD_SIDE / cloud_field_strain(l));
        belt[i][0] = (float)l->belt.south_rad;
        belt[i][1] = (float)l->belt.north_rad;
        belt[i][2] = (float)l->belt.feather_rad;
        belt[i][3] = (float)l->cyclone_cover;
    }
    gpu_program_set_int(program, "u_cloud_layers", (int32_t)field->desc.layer_count);
    gpu_program_set_vec4s(program, "u_cloud_shell", shell[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_grain", grain[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_turn", turn[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_form", form[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_belt", belt[0], CLOUD_MAX_LAYERS);
}

// Where the eye is in each layer's noises.
static void set_anchors(const struct cloud_field *field, const struct camera *camera,
                        struct gpu_program *program)
{
    float anchor[CLOUD_MAX_LAYERS][4] = {{0}};
    float finer[CLOUD_MAX_LAYERS][4] = {{0}};
    float gathered[CLOUD_MAX_LAYERS][4] = {{0}};
    float wide[CLOUD_MAX_LAYERS][4] = {{0}};
    float bend[CLOUD_MAX_LAYERS][4] = {{0}};
    float gathered_bend[CLOUD_MAX_LAYERS][4] = {{0}};
    float eye[CLOUD_MAX_LAYERS][4] = {{0}};
    for (size_t i = 0; i < field->desc.layer_count; i++) {
        const double tile_m = field->desc.layers[i].scale_m;
        const struct vec3 eye_m = cloud_field_unturned(field, i, camera->position_m);
        set_anchor(anchor[i], eye_m, tile_m);
        set_anchor(finer[i], eye_m, tile_m / CLOUD_DETAIL_TILES);
        set_anchor(gathered[i], eye_m, tile_m * CLOUD_FIELD_TILES);
        set_anchor(wide[i], cloud_field_wide_place(eye_m), tile_m * CLOUD_WIDE_TILES);
        set_bend(bend[i], eye_m, tile_m);
        set_bend(gathered_bend[i], eye_m, tile_m * CLOUD_FIELD_TILES);
        set_vec3(eye[i], eye_m, 0);
    }
    gpu_program_set_vec4s(program, "u_cloud_anchor", anchor[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_detail_anchor", finer[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_field_anchor", gathered[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_wide_anchor", wide[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_bend", bend[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_field_bend", gathered_bend[0], CLOUD_MAX_LAYERS);
    gpu_program_set_vec4s(program, "u_cloud_eye", eye[0], CLOUD_MAX_LAYERS);
}

static void set_cyclones(const struct cloud_field *field, struct gpu_program *program)
{
    float at[CLOUD_MAX_CYCLONES][4] = {{0}};
    float east[CLOUD_MAX_CYCLONES][4] = {{0}};
    float turn[CLOUD_MAX_CYCLONES][4] = {{0}};
    for (size_t i = 0; i < field->desc.cyclone_count; i++) {
        const struct cloud_cyclone *c = &field->desc.cyclones[i];
        struct vec3 axes[3];
        cloud_cyclone_axes(c, &axes[0], &axes[1], &axes[2]);
        set_vec3(at[i], axes[0], field->ground_radius_m / c->radius_m);
        set_vec3(east[i], axes[1], c->eye_radius_m / c->radius_m);
        set_vec3(turn[i], axes[2], 0);
    }
    gpu_program_set_int(program, "u_cyclones", (int32_t)field->desc.cyclone_count);
    gpu_program_set_vec4s(program, "u_cyclone_at", at[0], CLOUD_MAX_CYCLONES);
    gpu_program_set_vec4s(program, "u_cyclone_east", east[0], CLOUD_MAX_CYCLONES);
    gpu_program_set_vec4s(program, "u_cyclone_turn", turn[0], CLOUD_MAX_CYCLONES);
}

void cloud_march_set_field(const struct cloud_march *m, const struct camera *camera,
                           struct gpu_program *program)
{
    const struct cloud_field *field = m->field;
    float spread[CLOUD_LEVELS];
    for (int level = 0; level < CLOUD_LEVELS; level++) {
        spread[level] = (float)field->volume.spread[level];
    }
    const float volume[4] = {CLOUD_SIDE, CLOUD_LEVELS - 1, (float)cloud_field_system_tiles(field),
                             (float)field->map_count};
    set_layers(field, program);
    set_anchors(field, camera, program);
    set_cyclones(field, program);
    gpu_program_set_floats(program, "u_cloud_spread", spread, CLOUD_LEVELS);
    gpu_program_set_vec4(program, "u_cloud_volume", volume);
    gpu_program_set_texture(program, "u_cloud_noise", &m->noise);
    gpu_program_set_texture(program, "u_cloud_map", &m->map);
}
