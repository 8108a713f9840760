// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The surface as the shaders see it: uniforms and defines of shaders/terrain/layers.glsl.
#include "terrain/surface.h"

#include "shared/shared.glsl"

#include <stdio.h>

static const char *const KIND_DEFINES[SURFACE_KIND_COUNT] = {"ELEVATION_COUNT", "COLOUR_COUNT",
                                                             "WATER_COUNT", "LIGHTS_COUNT"};
static const char *const KIND_UNIFORMS[SURFACE_KIND_COUNT] = {"u_elevation", "u_colour", "u_water",
                                                              "u_lights"};
static const double UNBOUNDED = 9; // radians: more than any distance on a sphere

void surface_get_defines(const struct surface *surface, size_t elevations,
                         struct surface_defines *out)
{
    *out = (struct surface_defines){.count = 0};
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        const size_t count = k == SURFACE_ELEVATION ? elevations : surface->counts[k];
        snprintf(out->text[out->count], SURFACE_DEFINE_LENGTH, "%s %zu", KIND_DEFINES[k], count);
        out->list[out->count] = out->text[out->count];
        out->count++;
    }
    if (!surface->gpu->caps.has_float_linear) {
        snprintf(out->text[out->count], SURFACE_DEFINE_LENGTH, "NO_FLOAT_LINEAR");
        out->list[out->count] = out->text[out->count];
        out->count++;
    }
}

static void describe_layer(const struct terrain_layer *layer, const struct anchor *anchor,
                           double radius_m, float rows[3][4])
{
    const struct layer_frame *f = &layer->frame;
    double east = anchor->longitude_rad - f->centre_longitude;
    east -= 2 * SHARED_PI * floor(east / (2 * SHARED_PI) + 0.5);
    const double values[3][4] = {{east, anchor->latitude_rad - f->centre_latitude,
                                  0.5 / f->half_width, 0.5 / f->half_height},
                                 {f->is_whole_circle ? UNBOUNDED : f->half_width,
                                  f->touches_north ? UNBOUNDED : f->half_height,
                                  f->touches_south ? UNBOUNDED : f->half_height,
                                  1 / fmax(f->feather, 1e-9)},
                                 {layer->texture_scale_m, f->texel_height,
                                  log2(f->texel_height * radius_m), layer->texture_offset_m}};
    for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 4; i++) {
            rows[j][i] = (float)values[j][i];
        }
    }
}

static void bind_kind(const struct surface *surface, enum surface_kind kind,
                      const struct anchor *anchor, struct gpu_program *program)
{
    static const char *const PARTS[3] = {"_place", "_shape", "_texel"};
    float values[3][SURFACE_MAX_LAYERS][4] = {0};
    char name[32];
    for (size_t i = 0; i < surface->counts[kind]; i++) {
        const struct terrain_layer *layer = &surface->layers[kind][i];
        float rows[3][4];
        describe_layer(layer, anchor, surface->radius_m, rows);
        for (int j = 0; j < 3; j++) {
            for (int c = 0; c < 4; c++) {
                values[j][i][c] = rows[j][c];
            }
        }
        snprintf(name, sizeof name, "%s%zu", KIND_UNIFORMS[kind], i);
        gpu_program_set_texture(program, name, &layer->texture);
    }
    for (int j = 0; j < 3 && surface->counts[kind] > 0; j++) {
        snprintf(name, sizeof name, "%s%s", KIND_UNIFORMS[kind], PARTS[j]);
        gpu_program_set_vec4s(program, name, values[j][0], SURFACE_MAX_LAYERS);
    }
}

void surface_bind(const struct surface *surface, const struct anchor *anchor,
                  struct gpu_program *program)
{
    const float place[4] = {(float)sin(anchor->latitude_rad), (float)cos(anchor->latitude_rad),
                            (float)anchor->latitude_rad, (float)surface->radius_m};
    gpu_program_set_vec4(program, "u_anchor", place);
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        bind_kind(surface, (enum surface_kind)k, anchor, program);
    }
}
