// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The displaced sea over a planet of level water with one island.
#include "fixture.h"

#include "ocean/sea_mesh.h"

#include <stdio.h>
#include <stdlib.h>

static const double RADIUS_M = 6371000;
// Of the island, a square around 0 N 0 E, flat and at sea level like the water around.
static const double ISLAND_DEG = 1;

struct sea {
    struct fixture *f;
    struct surface surface;
    struct mesher *mesher;
    struct waves waves;
    struct wave_texture texture;
    struct sea_mesh mesh;
    struct picture picture;
    float *joined, *level; // as picture.pixels; after draw_sea
};

static double level_height(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 0;
}

static double water_byte(double latitude, double longitude)
{
    return fabs(latitude) < ISLAND_DEG && fabs(longitude) < ISLAND_DEG ? 0 : 255;
}

static void make_sea(struct fixture *f, double wind_m_s, struct sea *out)
{
    *out = (struct sea){.f = f};
    char heights[128], mask[128];
    const struct raster_place everywhere = {-180, 90, 0.5, 720, 360};
    fixture_write_heights(f, "level", &everywhere, level_height, heights);
    fixture_write_bytes(f, "water", &everywhere, water_byte, mask);
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = heights, .scale = 1},
        {.kind = SURFACE_WATER, .path = mask}};
    struct surface_desc surface = surface_desc_default();
    surface.radius_m = RADIUS_M;
    surface.layer_count = 2;
    surface.layers = layers;
    assert_int_equal(surface_init(f->gpu, &surface, &out->surface), TRL_OK);
    const struct hemisphere_desc grid = {FIXTURE_CELLS, false};
    assert_int_equal(hemisphere_create_of(&out->surface, &grid, &out->mesher), TRL_OK);
    const struct ocean_desc ocean = {
        .gravity_m_s2 = 9.81,
        .waves = {.wind_m_s = wind_m_s, .fetch_m = 4e5, .count = 40, .seed = 2}};
    const struct waves_desc waves = {f->ctx, &ocean, RADIUS_M, 0.003 + 0.00512 * wind_m_s};
    assert_int_equal(waves_init(&waves, &out->waves), TRL_OK);
    assert_int_equal(wave_texture_init(f->gpu, &out->waves, &out->texture), TRL_OK);
    assert_int_equal(sea_mesh_init(&out->surface, &out->texture, &out->mesh), TRL_OK);
    fixture_picture_init(f, &out->picture);
    assert_int_equal(sea_mesh_resize(&out->mesh, &out->picture.depth), TRL_OK);
    const size_t bytes = (size_t)PICTURE_SIDE * PICTURE_SIDE * 4 * sizeof(float);
    out->joined = malloc(bytes);
    out->level = malloc(bytes);
}

static void finish_sea(struct sea *s)
{
    free(s->joined);
    free(s->level);
    sea_mesh_finish(&s->mesh);
    fixture_picture_finish(s->f, &s->picture);
    wave_texture_finish(&s->texture);
    waves_finish(&s->waves);
    mesher_destroy(&s->mesher);
    surface_finish(&s->surface);
}

static struct camera look(double latitude, double altitude_m, double heading)
{
    const struct camera_place place = {.latitude = latitude,
                                       .longitude = latitude == 0 ? 0 : 40,
                                       .radius_m = RADIUS_M,
                                       .altitude_m = altitude_m,
                                       .heading = heading,
                                       .pitch = -6,
                                       .fov = 40};
    return fixture_camera(&place);
}

static void draw_sea(struct sea *s, const struct camera *camera, double time_s)
{
    fixture_picture_draw(&s->picture, s->mesher, camera);
    const struct sea_mesh_inputs inputs = {camera, time_s, &s->picture.position};
    assert_int_equal(sea_mesh_draw(&s->mesh, &inputs), TRL_OK);
    assert_true(s->mesh.plan.is_seen);
    const struct gpu_region all = gpu_texture_region(&s->mesh.position, 0);
    assert_int_equal(gpu_texture_read(&s->mesh.position, &all, s->joined), TRL_OK);
    assert_int_equal(gpu_texture_read(&s->mesh.level, &all, s->level), TRL_OK);
}

// A vertex by the formulas of Michelic's Eq. 7 and 8 in double: relative to the eye, axes of its
// anchor; how high.
static struct vec3 move_vertex(const struct sea *s, double ring, double spoke, double *height_m)
{
    const struct sea_mesh_plan *plan = &s->mesh.plan;
    const double radius_m = sea_grid_radius(plan->grid, ring);
    const double azimuth = sea_grid_azimuth(plan->grid, spoke);
    const double angle = radius_m / RADIUS_M;
    const struct vec3 at = {RADIUS_M * sin(angle) * sin(azimuth) + plan->east_m,
                            RADIUS_M * sin(angle) * cos(azimuth) + plan->north_m,
                            RADIUS_M * cos(angle)};
    const GerstnerPlace p = gerstner_place(at.x, at.y, at.z);
    const double along = SEA_GRID_WINDOW * sea_grid_long(plan->grid, radius_m);
    const double across = SEA_GRID_WINDOW * sea_grid_wide(plan->grid, radius_m);
    GerstnerSum sum = gerstner_level();
    for (uint32_t i = 0; i < s->texture.view->count; i++) {
        const GerstnerWave w = waves_view_get(s->texture.view, i);
        const GerstnerTurn turn = gerstner_turn(w, p);
        const GerstnerRipple r = gerstner_ripple(w, p, RADIUS_M, atan2(turn.rise, turn.run));
        const double out = r.dx * sin(azimuth) + r.dy * cos(azimuth);
        const double side = r.dx * cos(azimuth) - r.dy * sin(azimuth);
        const double weight =
            gerstner_weight_of(w.wavenumber * along * out, w.wavenumber * across * side,
                               w.wavenumber, along * along + across * across);
        const double first = waves_view_get(s->texture.view, i - i % WAVES_LANES).wavenumber;
        const bool is_shown = first <= gerstner_last(1, fmin(along, across));
        sum = gerstner_add(sum, w, r, is_shown ? weight : 0);
    }
    const double shown = sea_grid_shown(plan->grid, hypot(radius_m, plan->eye_height_m));
    *height_m = sea_grid_bowl(shown * sum.z, radius_m, plan->eye_height_m);
    const GerstnerNormal moved = gerstner_to_anchor(p, shown * sum.x, shown * sum.y, *height_m);
    return (struct vec3){at.x + moved.x, at.y + moved.y,
                         at.z + moved.z - RADIUS_M - plan->eye_height_m};
}

static void vertices_are_where_the_closed_form_has_them(void **state)
{
    struct sea s;
    make_sea(*state, 12, &s);
    const struct camera camera = look(30, 5, 70);
    draw_sea(&s, &camera, 7);
    const uint32_t side = s.mesh.crests.width;
    float *texels = malloc((size_t)side * s.mesh.crests.height * 4 * sizeof *texels);
    const struct gpu_region all = gpu_texture_region(&s.mesh.crests, 0);
    assert_int_equal(gpu_texture_read(&s.mesh.crests, &all, texels), TRL_OK);
    double highest_m = 0;
    for (uint32_t ring = 0; ring < s.mesh.crests.height; ring += 7) {
        for (uint32_t spoke = ring % 11; spoke < side; spoke += 23) {
            const float *texel = texels + 4 * ((size_t)ring * side + spoke);
            double height_m;
            const struct vec3 wanted = move_vertex(&s, ring, spoke, &height_m);
            // A float holds a place 10 km away to 1 mm; the exponent of the radius has 1e-6.
            const double tolerance_m = 0.002 + 4e-6 * vec3_length(wanted);
            assert_close((double)texel[0], wanted.x, tolerance_m);
            assert_close((double)texel[1], wanted.y, tolerance_m);
            assert_close((double)texel[2], wanted.z, tolerance_m);
            assert_close((double)texel[3], height_m, 0.002);
            highest_m = fmax(highest_m, height_m);
        }
    }
    printf("highest crest %.2f m, significant height %.2f m\n", highest_m, s.mesh.wave_height_m);
    assert_true(highest_m > 0.4 * s.mesh.wave_height_m); // there was something to compare
    free(texels);
    finish_sea(&s);
}

// Of pixels of the picture: all of which something is asked.
struct counts {
    int below_horizon, holes, flat, above_horizon;
    double seam_px; // between mesh and far sea
};

static struct counts count_pixels(const struct sea *s, const struct camera *camera)
{
    struct counts c = {0};
    const double pixel_rad = 2 * camera->tan_half_fov_y / PICTURE_SIDE;
    const double eye_m = s->mesh.plan.eye_height_m;
    const double dip = sqrt(2 * eye_m / RADIUS_M);
    const struct vec3 up = vec3_normalize(camera->position_m);
    for (int y = 0; y < PICTURE_SIDE; y++) {
        for (int x = 0; x < PICTURE_SIDE; x++) {
            const size_t i = 4 * ((size_t)y * PICTURE_SIDE + (size_t)x);
            const bool is_sea = s->level[i + 3] > 0, is_there = s->joined[i + 3] > -1e8f;
            const double elevation = asin(vec3_dot(fixture_ray(camera, x, y), up)) + dip;
            const double distance_m =
                sqrt((double)(s->joined[i] * s->joined[i] + s->joined[i + 1] * s->joined[i + 1] +
                              s->joined[i + 2] * s->joined[i + 2]));
            c.below_horizon += elevation < -1.5 * pixel_rad;
            c.holes += elevation < -1.5 * pixel_rad && !is_there;
            c.flat += elevation < -1.5 * pixel_rad && !is_sea &&
                      distance_m < 0.9 * sea_grid_radius(s->mesh.plan.grid, SEA_GRID_RINGS);
            c.above_horizon += elevation > pixel_rad && is_sea;
            const size_t next = y + 1 < PICTURE_SIDE ? i + 4 * PICTURE_SIDE : i;
            if (is_sea && s->level[next + 3] == 0 && s->joined[next + 3] > -1e8f) {
                c.seam_px =
                    fmax(c.seam_px, fabs((double)s->joined[i + 3]) / (distance_m * pixel_rad));
            }
        }
    }
    return c;
}

static void the_sea_has_no_hole_and_its_waves_stand_before_the_sky(void **state)
{
    static const double WINDS_M_S[2] = {5, 28};
    for (int w = 0; w < 2; w++) {
        struct sea s;
        make_sea(*state, WINDS_M_S[w], &s);
        int above = 0;
        for (int i = 0; i < 3; i++) {
            const struct camera camera = look(30, 3, 20);
            draw_sea(&s, &camera, 3 * i);
            const struct counts c = count_pixels(&s, &camera);
            assert_true(c.below_horizon > PICTURE_SIDE * PICTURE_SIDE / 4);
            assert_int_equal(c.holes, 0);
            assert_int_equal(c.flat, 0);
            above += c.above_horizon;
        }
        printf("wind %g m/s: waves of %.1f m, %d pixels above the horizon\n", WINDS_M_S[w],
               s.mesh.wave_height_m, above);
        // Waves of 0.9 m end below the eye; those of 10 m do not.
        assert_true(w == 0 ? above == 0 : above > PICTURE_SIDE / 2);
        finish_sea(&s);
    }
}

static void the_mesh_ends_level(void **state)
{
    struct sea s;
    make_sea(*state, 5, &s);
    const struct camera camera = look(30, 30, 0);
    draw_sea(&s, &camera, 0);
    const struct counts c = count_pixels(&s, &camera);
    assert_int_equal(c.holes, 0);
    printf("seam of %.3f px\n", c.seam_px);
    assert_true(c.seam_px < 0.25);
    finish_sea(&s);
}

static void land_at_sea_level_stays_land(void **state)
{
    struct sea s;
    make_sea(*state, 15, &s);
    const struct camera camera = look(0, 4, 0);
    draw_sea(&s, &camera, 0);
    for (size_t i = 0; i < (size_t)PICTURE_SIDE * PICTURE_SIDE; i++) {
        assert_true(s.level[4 * i + 3] == 0);
        for (int k = 0; k < 4; k++) {
            assert_true(s.joined[4 * i + k] == s.picture.pixels[4 * i + k]);
        }
    }
    finish_sea(&s);
}

static void from_where_waves_are_below_a_pixel_there_is_no_mesh(void **state)
{
    (void)state;
    const double pixel_rad = 0.002, height_m = 1.5;
    const double least_m = height_m / (0.5 * pixel_rad);
    for (int i = 0; i < 4; i++) {
        const double altitude_m = least_m * (const double[]){1.01, 4, 1000, 0.99}[i];
        const struct camera camera = look(10, altitude_m, 0);
        const struct sea_mesh_plan plan =
            sea_mesh_plan_make(&camera, RADIUS_M, height_m, pixel_rad);
        assert_int_equal(plan.is_seen, i == 3);
    }
    const struct camera deep = look(10, -2, 0), low = look(10, 2, 0);
    assert_false(sea_mesh_plan_make(&deep, RADIUS_M, height_m, pixel_rad).is_seen);
    assert_false(sea_mesh_plan_make(&low, RADIUS_M, 0, pixel_rad).is_seen);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_are_where_the_closed_form_has_them),
        cmocka_unit_test(the_sea_has_no_hole_and_its_waves_stand_before_the_sky),
        cmocka_unit_test(the_mesh_ends_level),
        cmocka_unit_test(land_at_sea_level_stays_land),
        cmocka_unit_test(from_where_waves_are_below_a_pixel_there_is_no_mesh),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
