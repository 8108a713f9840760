// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "cloud/deck.h"

// The map: texels a side; where they begin to grow, over the eye's way to the clouds, and at least.
enum { SIDE = 128 };
static const double FINE_PART = 0.5, LEAST_FINE_M = 1500;
static const double FARTHEST_RAD = 1.45; // the map shows a half of the sphere at most

void cloud_deck_init(struct gpu *gpu, struct cloud_deck *out)
{
    *out = (struct cloud_deck){.gpu = gpu};
}

void cloud_deck_finish(struct cloud_deck *deck)
{
    gpu_program_finish(&deck->program);
    gpu_target_finish(&deck->target);
    gpu_texture_finish(&deck->map);
    *deck = (struct cloud_deck){.gpu = deck->gpu};
}

static trl_result make_map(struct cloud_deck *deck)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "deck of clouds";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_LINEAR;
    desc.width = desc.height = SIDE;
    return gpu_target_init_texture(deck->gpu, &desc, NULL, &deck->map, &deck->target);
}

// Of all layers, by their optical depth: the altitude of their middle and half their height.
static void find_middle(const struct cloud_field *field, double *middle_m, double *half_m)
{
    double depth = 0, middle = 0, half = 0;
    for (size_t i = 0; i < field->desc.layer_count; i++) {
        const struct cloud_layer *l = &field->desc.layers[i];
        const double thick_m = l->top_m - l->base_m;
        const double weight =
            thick_m * l->extinction_per_m * fmax(fmax(l->cover, l->cyclone_cover), 1e-3);
        depth += weight;
        middle += weight * 0.5 * (l->base_m + l->top_m);
        half += weight * 0.5 * thick_m;
    }
    *middle_m = middle / depth;
    *half_m = half / depth;
}

static void find_place(struct cloud_deck *deck, const struct cloud_field *field,
                       const struct camera *camera)
{
    double middle_m, half_m;
    find_middle(field, &middle_m, &half_m);
    const double ground_m = field->ground_radius_m;
    const double eye_m = fmax(vec3_length(camera->position_m), ground_m);
    const double top_m = ground_m + cloud_field_highest_m(field);
    const double seen_rad = acos(ground_m / eye_m) + acos(ground_m / top_m);
    const double edge_m = (ground_m + middle_m) * sin(fmin(seen_rad, FARTHEST_RAD));
    const double fine_m = fmax(LEAST_FINE_M, FINE_PART * fabs(eye_m - ground_m - middle_m));
    deck->place[0] = (float)middle_m;
    deck->place[1] = (float)fine_m;
    deck->place[2] = (float)asinh(edge_m / fine_m);
    deck->place[3] = (float)half_m;
}

trl_result cloud_deck_begin(struct cloud_deck *deck, const struct cloud_field *field,
                            const struct camera *camera)
{
    const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                          .fragment = "cloud/deck.frag"};
    trl_result result = TRL_OK;
    if (!deck->target.gpu) {
        result = gpu_program_init(deck->gpu, &desc, &deck->program);
        result = result == TRL_OK ? make_map(deck) : result;
    }
    if (result != TRL_OK) {
        cloud_deck_finish(deck);
        return result;
    }
    find_place(deck, field, camera);
    gpu_program_set_vec4(&deck->program, "u_deck_map", deck->place);
    gpu_program_set_float(&deck->program, "u_texels", SIDE);
    return TRL_OK;
}

trl_result cloud_deck_draw(struct cloud_deck *deck)
{
    const struct gpu_pass pass = {.target = &deck->target};
    gpu_pass_begin(deck->gpu, &pass);
    return gpu_draw_fullscreen(&deck->program, "deck of clouds");
}
