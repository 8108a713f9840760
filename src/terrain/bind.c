// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The surface as the shaders see it: uniforms and defines of shaders/terrain/layers.glsl.
#include "terrain/surface.h"

#include "shared/blend.glsl"
#include "terrain/stream.h"

#include <math.h>
#include <stdio.h>

static const char *const KIND_DEFINES[SURFACE_KIND_COUNT] = {
    "ELEVATION_COUNT", "COLOUR_COUNT", "WATER_COUNT", "LIGHTS_COUNT", "NORMAL_COUNT"};
static const char *const KIND_UNIFORMS[SURFACE_KIND_COUNT] = {"u_elevation", "u_colour", "u_water",
                                                              "u_lights", "u_normal"};
static const float COVER_MODE = 5; // as in terrain/surface.frag
static const float NO_FLOOR_M = -1e9f;
enum { FRAME_ROWS = 5 }; // vec4 of a layer; the last one only where there are tiles

static void add_define(struct surface_defines *out, const char *name)
{
    snprintf(out->text[out->count], SURFACE_DEFINE_LENGTH, "%s", name);
    out->list[out->count] = out->text[out->count];
    out->count++;
}

void surface_get_defines(const struct surface *surface, size_t elevations,
                         struct surface_defines *out)
{
    *out = (struct surface_defines){.count = 0};
    bool has_polar = false, has_modes = false, has_gaps = false, has_covers = false;
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        char text[SURFACE_DEFINE_LENGTH];
        const size_t count =
            k == SURFACE_ELEVATION ? elevations : surface_count_seen(surface, (enum surface_kind)k);
        snprintf(text, sizeof text, "%s %zu", KIND_DEFINES[k], count);
        add_define(out, text);
        for (size_t i = 0; i < surface->counts[k]; i++) {
            has_polar = has_polar || surface->layers[k][i].frame.pole != 0;
            has_modes = has_modes || surface->layers[k][i].mode != BLEND_OVER;
            has_covers = has_covers || surface->layers[k][i].cover.is_there;
            has_gaps = has_gaps || surface->layers[k][i].heights.coarser;
        }
    }
    if (!surface->gpu->caps.has_float_linear) {
        add_define(out, "NO_FLOAT_LINEAR");
    }
    if (has_polar) {
        add_define(out, "HAS_POLAR");
    }
    if (has_modes) {
        add_define(out, "HAS_MODES");
    }
    if (has_covers) {
        add_define(out, "HAS_COVERS");
    }
    if (has_gaps) {
        add_define(out, "HAS_GAPS");
    }
    if (surface->stream) {
        add_define(out, "HAS_PAGES");
    }
    if (surface->depth.is_told) {
        add_define(out, "HAS_DEPTH");
    }
    if (noise_is_there(&surface->noise)) {
        add_define(out, surface->is_invented ? "HAS_GROUND" : "HAS_NOISE"); // the last
    }
}

static void describe_layer(const struct terrain_layer *layer, const struct anchor *anchor,
                           double radius_m, float (*rows)[4])
{
    const struct layer_frame *f = layer_finest_frame(layer);
    const struct layer_view view = layer_view_from(f, anchor->latitude_rad, anchor->longitude_rad);
    const double texel[4] = {layer->texture_scale_m, f->texel_height,
                             log2(f->texel_height * radius_m), layer->texture_offset_m};
    for (int i = 0; i < 4; i++) {
        rows[0][i] = (float)view.place[i];
        rows[1][i] = (float)view.shape[i];
        rows[2][i] = (float)texel[i];
        rows[3][i] = (float)view.turn[i];
    }
    if (layer->tiles) {
        stream_describe(layer->stream, layer->tiles, rows[4]);
    }
}

struct binding {
    const struct surface *surface;
    const struct surface_selection *selection;
    const struct anchor *anchor;
};

// u_elevation_near of one layer. Heights count from what is about the ground below the anchor; what
// only changes those has numbers of another size.
static void describe_near(const struct terrain_layer *layer, const struct anchor *anchor,
                          double ground_m, float rows[2][4])
{
    const struct layer_view view =
        layer_view_from(layer_finest_frame(layer), anchor->latitude_rad, anchor->longitude_rad);
    const double uv[2] = {0.5 + view.place[0] * view.place[2], 0.5 - view.place[1] * view.place[3]};
    for (int i = 0; i < 2; i++) {
        // Far from the raster no digits matter, and the shader's integers end.
        const double place = fmax(-3, fmin(4, uv[i]));
        rows[0][i] = (float)floor(1024 * place + 0.5);
        rows[0][2 + i] = (float)(uv[i] - (double)rows[0][i] / 1024);
    }
    const double steps = layer->texture_steps;
    const double step_m = steps > 0 ? layer->texture_scale_m / steps : layer->texture_scale_m;
    const bool is_change = blend_is_change(layer->mode);
    const double near_m = is_change ? 0 : ground_m, datum_m = is_change ? 0 : anchor->datum_m;
    const double base = floor((near_m - layer->texture_offset_m) / step_m + 0.5);
    rows[1][0] = (float)steps;
    rows[1][1] = (float)base;
    rows[1][2] = (float)(layer->texture_offset_m + (double)rows[1][1] * step_m - datum_m);
    rows[1][3] = (float)step_m;
}

static void bind_near(const struct binding *binding, struct gpu_program *program)
{
    const struct surface_selection *selection = binding->selection;
    // Tiles are not waited for: what is held whole is near enough for the digits.
    const double ground_m = surface_altitude_of_held(binding->surface, binding->anchor->up);
    float rows[2 * SURFACE_SEEN_LAYERS][4] = {0};
    for (size_t i = 0; i < selection->counts[SURFACE_ELEVATION]; i++) {
        const size_t index = selection->indices[SURFACE_ELEVATION][i];
        describe_near(&binding->surface->layers[SURFACE_ELEVATION][index], binding->anchor,
                      ground_m, &rows[2 * i]);
    }
    if (selection->counts[SURFACE_ELEVATION] > 0) {
        gpu_program_set_vec4s(program, "u_elevation_near", rows[0], 2 * SURFACE_SEEN_LAYERS);
    }
}

static void bind_kind(const struct binding *binding, enum surface_kind kind,
                      struct gpu_program *program)
{
    const struct surface *surface = binding->surface;
    const struct surface_selection *selection = binding->selection;
    const size_t row_count = surface->stream ? FRAME_ROWS : FRAME_ROWS - 1;
    float rows[SURFACE_SEEN_LAYERS * FRAME_ROWS][4] = {0};
    float modes[4] = {0}, gaps[4] = {0}, floors[4];
    char name[32];
    for (int i = 0; i < 4; i++) {
        floors[i] = NO_FLOOR_M;
    }
    for (size_t i = 0; i < selection->counts[kind]; i++) {
        const struct terrain_layer *layer = &surface->layers[kind][selection->indices[kind][i]];
        describe_layer(layer, binding->anchor, surface->radius_m, &rows[i * row_count]);
        modes[i] = layer->cover.is_there ? COVER_MODE : (float)layer->mode;
        gaps[i] = layer->heights.coarser ? 1.0f : 0.0f;
        floors[i] = layer->heights.has_bed ? 0 : NO_FLOOR_M;
        snprintf(name, sizeof name, "%s%zu", KIND_UNIFORMS[kind], i);
        gpu_program_set_texture(program, name,
                                layer->tiles ? stream_texture(layer->stream, layer->tiles)
                                             : &layer->texture);
    }
    if (selection->counts[kind] > 0) {
        gpu_program_set_vec4s(program, KIND_UNIFORMS[kind], rows[0],
                              SURFACE_SEEN_LAYERS * row_count);
        snprintf(name, sizeof name, "%s_modes", KIND_UNIFORMS[kind]);
        gpu_program_set_vec4(program, name, modes);
        snprintf(name, sizeof name, "%s_gaps", KIND_UNIFORMS[kind]);
        gpu_program_set_vec4(program, name, gaps);
        snprintf(name, sizeof name, "%s_floors", KIND_UNIFORMS[kind]);
        gpu_program_set_vec4(program, name, floors);
    }
}

void surface_bind(const struct surface *surface, const struct surface_selection *selection,
                  const struct anchor *anchor, struct gpu_program *program)
{
    const float place[4] = {(float)sin(anchor->latitude_rad), (float)cos(anchor->latitude_rad),
                            (float)anchor->latitude_rad, (float)surface->radius_m};
    gpu_program_set_vec4(program, "u_anchor", place);
    gpu_program_set_float(program, "u_datum", (float)anchor->datum_m);
    if (surface->stream) {
        gpu_program_set_texture(program, "u_pages", &surface->stream->atlas.pages);
    }
    const struct binding binding = {surface, selection, anchor};
    bind_near(&binding, program);
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        bind_kind(&binding, (enum surface_kind)k, program);
    }
    noise_bind(&surface->noise, anchor, program);
}
