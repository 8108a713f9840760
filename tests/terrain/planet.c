// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "planet.h"

static const double DEGREE = 3.14159265358979323846 / 180;

void planet_make(struct fixture *f, planet_heights *globe, planet_heights *inset,
                 struct planet *out)
{
    const struct surface_detail none = {.roughness = 0};
    planet_make_detailed(f, globe, inset, &none, out);
}

void planet_make_detailed(struct fixture *f, planet_heights *globe, planet_heights *inset,
                          const struct surface_detail *detail, struct planet *out)
{
    char paths[2][128];
    const struct raster_place everywhere = {-180, 90, 0.5, 720, 360};
    const struct raster_place somewhere = {28, 42, 0.02, 200, 200};
    fixture_write_heights(f, "planet", &everywhere, globe, paths[0]);
    if (inset) {
        fixture_write_heights(f, "planet-inset", &somewhere, inset, paths[1]);
    }
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = paths[0], .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = paths[1], .scale = 1, .feather_rad = DEGREE}};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = PLANET_RADIUS_M;
    desc.layer_count = inset ? 2 : 1;
    desc.layers = layers;
    desc.detail = *detail;
    *out = (struct planet){.f = f};
    assert_int_equal(surface_init(f->gpu, &desc, &out->relief.surface), TRL_OK);
    assert_int_equal(terrain_ceiling_init(&out->relief.surface, &out->relief.ceiling), TRL_OK);
    out->truth = relief_surface(&out->relief);
}

bool planet_use(struct planet *planet, trl_mesher mesher)
{
    mesher_destroy(&planet->mesher);
    const struct surface *surface = &planet->relief.surface;
    const struct hemisphere_desc grid = {FIXTURE_CELLS, false};
    const trl_result result = mesher == TRL_MESHER_HEMISPHERE
                                  ? hemisphere_create_of(surface, &grid, &planet->mesher)
                                  : mesher_create(surface, mesher, &planet->mesher);
    assert_true(result == TRL_OK ||
                (result == TRL_ERROR_UNSUPPORTED && mesher == TRL_MESHER_TESSELLATED &&
                 !planet->f->gpu->caps.has_tessellation));
    return result == TRL_OK;
}

void planet_destroy(struct planet *planet)
{
    mesher_destroy(&planet->mesher);
    relief_finish(&planet->relief);
}

struct camera planet_camera(const struct planet *planet, struct camera_place place, double height_m)
{
    const struct vec3 up = vec3_from_lat_lon(place.latitude * DEGREE, place.longitude * DEGREE);
    place.radius_m = PLANET_RADIUS_M;
    place.altitude_m = surface_altitude(&planet->relief.surface, up) + height_m;
    return fixture_camera(&place);
}

struct mesh_error planet_check(const struct planet *planet, const struct camera *camera,
                               uint32_t side, uint32_t step)
{
    const struct mesh_check_desc desc = {
        .ctx = planet->f->ctx,
        .gpu = planet->f->gpu,
        .mesher = planet->mesher,
        .truth = {&planet->truth, PLANET_RADIUS_M, camera, 2 * camera->tan_half_fov_y / side},
        .width = side,
        .height = side,
        .step = step};
    uint32_t size[2];
    mesh_check_size(&desc, size);
    struct mesh_truth truth;
    assert_int_equal(mesh_truth_init(desc.ctx, &desc.truth, size, &truth), TRL_OK);
    assert_int_equal(mesh_truth_find_edges(&truth, &desc.truth), TRL_OK);
    struct mesh_check check;
    assert_int_equal(mesh_check_init(&desc, &truth, &check), TRL_OK);
    const struct mesh_error error = check.error;
    mesh_check_finish(&check);
    mesh_truth_finish(&truth);
    return error;
}
