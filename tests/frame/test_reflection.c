// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Terrain that water mirrors: a wall that stands in flat water, whose image geometry tells.
#include "fixture.h"
#include "shared/fresnel.glsl"
#include "sky/reflection.h"

#include <math.h>
#include <stdio.h>

// The eye is 10 m above the water and looks level at a wall 100 m away and 20 m high. A row whose
// way falls by m meets the water at 10 m / m, and its mirrored ray the wall at 100 m * m - 10 m.
enum { SIZE = 64, HALF = SIZE / 2 };
static const double EYE_M = 10, WALL_M = 100, HIGH_M = 20, TAN_HALF = 0.5;
static const double RADIUS_M = 6371000;
static const float AIR = 1, WALL = 5, SKY = 100;

static double slope_at(uint32_t row, uint32_t rows)
{
    return TAN_HALF * ((2.0 * row + 1) / rows - 1);
}

static bool is_water(uint32_t y)
{
    return slope_at(y, SIZE) * WALL_M < -EYE_M;
}

static bool is_sky(uint32_t y)
{
    return slope_at(y, SIZE) * WALL_M > HIGH_M - EYE_M;
}

static struct color paint_radiance(uint32_t x, uint32_t y, const void *user)
{
    (void)x;
    (void)user;
    const float value = is_water(y) ? AIR : is_sky(y) ? SKY : WALL;
    return (struct color){value, value, value};
}

// Axes: x up from the planet's centre, y to the right, z away from the eye.
static void fill_surface(float *position, float *albedo)
{
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        const double across = slope_at(i % SIZE, SIZE), along = slope_at(i / SIZE, SIZE);
        const bool water = is_water(i / SIZE);
        const double distance = water ? -EYE_M / along : WALL_M;
        position[4 * i] = (float)(distance * along);
        position[4 * i + 1] = (float)(distance * across);
        position[4 * i + 2] = (float)distance;
        position[4 * i + 3] = is_sky(i / SIZE) ? -1e9f : (float)(EYE_M + distance * along);
        albedo[4 * i + 3] = water ? 1 : 0;
    }
}

// Level water, as rough as that.
static void fill_facets(const float *position, double eye_m, float mean_square_slope, float *facets)
{
    for (size_t i = 0; i < 4 * SIZE * SIZE; i += 4) {
        const struct vec3 at = {RADIUS_M + eye_m + (double)position[i], (double)position[i + 1],
                                (double)position[i + 2]};
        const struct vec3 up = vec3_normalize(at);
        facets[i] = (float)up.x;
        facets[i + 1] = (float)up.y;
        facets[i + 2] = (float)up.z;
        facets[i + 3] = mean_square_slope;
    }
}

static struct gpu_texture make_texture(struct fixture *f, const float *texels)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    struct gpu_texture texture;
    desc.label = "surface";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = desc.height = SIZE;
    desc.data = texels;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
    return texture;
}

// What an eye sees, and how high it is.
struct scene {
    void (*fill)(float *position, float *albedo);
    struct color (*paint)(uint32_t x, uint32_t y, const void *user);
    double eye_m;
    struct vec3 forward, up;
};

static void draw_into(struct fixture *f, struct reflection *reflection, const struct scene *scene,
                      float mean_square_slope, float texels[4 * HALF * HALF])
{
    static float position_texels[4 * SIZE * SIZE], albedo_texels[4 * SIZE * SIZE],
        facet_texels[4 * SIZE * SIZE];
    scene->fill(position_texels, albedo_texels);
    fill_facets(position_texels, scene->eye_m, mean_square_slope, facet_texels);
    static float kind_texels[4 * SIZE * SIZE]; // as of terrain/kinds.h
    for (int i = 0; i < SIZE * SIZE; i++) {
        kind_texels[4 * i] = position_texels[4 * i + 3] > -1e8f ? 0.75f : 0;
    }
    struct gpu_texture position = make_texture(f, position_texels);
    struct gpu_texture albedo = make_texture(f, albedo_texels);
    struct gpu_texture facets = make_texture(f, facet_texels);
    struct gpu_texture kinds = make_texture(f, kind_texels);
    struct gpu_texture radiance = fixture_paint(f, SIZE, SIZE, scene->paint, NULL);
    const struct gpu_target_desc desc = {
        .label = "picture", .color_count = 1, .colors[0].texture = &radiance};
    struct gpu_target target;
    assert_int_equal(gpu_target_init(f->gpu, &desc, &target), TRL_OK);
    const struct sky_pixels pixels = {
        .gpu = f->gpu, .ground_radius_m = RADIUS_M, .top_radius_m = RADIUS_M + 1e5};
    const struct camera camera = {.position_m = {RADIUS_M + scene->eye_m, 0, 0},
                                  .forward = scene->forward,
                                  .right = {0, 1, 0},
                                  .up = scene->up,
                                  .sun_direction = {1, 0, 0},
                                  .tan_half_fov_x = TAN_HALF,
                                  .tan_half_fov_y = TAN_HALF};
    const struct sky_view view = {
        .camera = &camera,
        .surface = {.position = &position, .albedo = &albedo, .facets = &facets, .kinds = &kinds},
        .target = &target};
    const float sea[3] = {mean_square_slope, 1.34f, 0};
    assert_int_equal(reflection_draw(reflection, &pixels, &view, sea), TRL_OK);
    const struct gpu_region region = gpu_texture_region(&reflection->texture, 0);
    assert_int_equal(gpu_texture_read(&reflection->texture, &region, texels), TRL_OK);
    gpu_target_finish(&target);
    gpu_texture_finish(&radiance);
    gpu_texture_finish(&kinds);
    gpu_texture_finish(&facets);
    gpu_texture_finish(&albedo);
    gpu_texture_finish(&position);
}

static void draw_scene(struct fixture *f, const struct scene *scene, float mean_square_slope,
                       float texels[4 * HALF * HALF])
{
    struct reflection reflection = {0};
    draw_into(f, &reflection, scene, mean_square_slope, texels);
    reflection_finish(&reflection);
}

static void draw(struct fixture *f, float mean_square_slope, float texels[4 * HALF * HALF])
{
    const struct scene scene = {fill_surface, paint_radiance, EYE_M, {0, 0, 1}, {1, 0, 0}};
    draw_scene(f, &scene, mean_square_slope, texels);
}

static void calm_water_mirrors_the_wall_where_geometry_says(void **state)
{
    static float texels[4 * HALF * HALF];
    draw(*state, 1e-8f, texels);
    int mirrored = 0, open = 0;
    for (uint32_t y = 0; y < HALF; y++) {
        const float *texel = texels + 4 * ((size_t)y * HALF + HALF / 2);
        const double fall = -slope_at(y, HALF);
        const double height_m = WALL_M * fall - EYE_M;
        // Off the shore and the wall's upper edge by more than a row of either picture: 3 m.
        if (height_m < -4) {
            assert_true(texel[3] < 0); // no water
        } else if (height_m > 4 && height_m < HIGH_M - 4) {
            assert_true(fabs((double)texel[3] - 1) < 0.01);
            assert_true(fabs((double)(texel[0] - (WALL - AIR))) < 0.05);
            mirrored++;
        } else if (height_m > HIGH_M + 4) {
            assert_true(fabs((double)texel[3]) < 0.01 && fabs((double)texel[0]) < 0.05);
            open++;
        }
    }
    assert_true(mirrored >= 3 && open >= 3);
}

// Straight down from 2000 km on a sea whose coast lies along the picture's border.
static const double SPACE_M = 2e6;

static bool is_coast(uint32_t x, uint32_t y)
{
    return x < 3 || y < 3 || x >= SIZE - 3 || y >= SIZE - 3;
}

static void fill_sea_from_space(float *position, float *albedo)
{
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        const struct vec3 way =
            vec3_normalize((struct vec3){-1, slope_at(i % SIZE, SIZE), slope_at(i / SIZE, SIZE)});
        const double eye = RADIUS_M + SPACE_M, along = -eye * way.x;
        const double distance = along - sqrt(along * along - eye * eye + RADIUS_M * RADIUS_M);
        position[4 * i] = (float)(distance * way.x);
        position[4 * i + 1] = (float)(distance * way.y);
        position[4 * i + 2] = (float)(distance * way.z);
        position[4 * i + 3] = 0;
        albedo[4 * i + 3] = is_coast(i % SIZE, i / SIZE) ? 0 : 1;
    }
}

static struct color paint_coast(uint32_t x, uint32_t y, const void *user)
{
    (void)user;
    const float value = is_coast(x, y) ? WALL : AIR;
    return (struct color){value, value, value};
}

// Rays that leave the picture over a coast are hundreds of kilometres up.
static void no_coast_is_mirrored_into_space(void **state)
{
    static float texels[4 * HALF * HALF];
    const struct scene scene = {fill_sea_from_space, paint_coast, SPACE_M, {-1, 0, 0}, {0, 0, 1}};
    draw_scene(*state, &scene, 0.02f, texels);
    double most = 0;
    for (uint32_t i = 0; i < HALF * HALF; i++) {
        // Beside the coast it is what lies behind it that is not known.
        const uint32_t x = i % HALF, y = i / HALF;
        if (x >= 4 && y >= 4 && x < HALF - 4 && y < HALF - 4) {
            most = fmax(most, (double)texels[4 * i + 3]);
        }
    }
    printf("%.3f of the mirrored light is land's\n", most);
    assert_true(most < 1e-3);
}

static void fill_open_sea(float *position, float *albedo)
{
    fill_sea_from_space(position, albedo);
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        albedo[4 * i + 3] = 1;
    }
}

static float find_most(const float texels[4 * HALF * HALF])
{
    float most = -1;
    for (uint32_t i = 0; i < 4 * HALF * HALF; i++) {
        most = fmaxf(most, texels[i]);
    }
    return most;
}

// Where a picture has no land nothing is drawn; what the one before had must not stay.
static void no_land_of_the_frame_before_is_mirrored(void **state)
{
    static float texels[4 * HALF * HALF];
    const struct scene wall = {fill_surface, paint_radiance, EYE_M, {0, 0, 1}, {1, 0, 0}};
    const struct scene sea = {fill_open_sea, paint_coast, SPACE_M, {-1, 0, 0}, {0, 0, 1}};
    struct reflection reflection = {0};
    draw_into(*state, &reflection, &wall, 1e-8f, texels);
    assert_true(find_most(texels) > 1);
    draw_into(*state, &reflection, &sea, 0.02f, texels);
    assert_true(find_most(texels) <= 0);
    draw_into(*state, &reflection, &wall, 1e-8f, texels);
    assert_true(find_most(texels) > 1);
    reflection_finish(&reflection);
}

// Of a row of the half picture: how large facets of all slopes along the view are as they are seen,
// times their reflectance; all of them, and those that mirror the wall.
struct facets {
    double all, wall;
};
static struct facets find_facets(uint32_t row, double mean_square_slope)
{
    enum { FACETS = 1000 };
    const double fall = -slope_at(2 * row, SIZE); // the first of its rows
    struct facets f = {0};
    for (int i = 0; i < FACETS; i++) {
        const double share = (i + 0.5) / FACETS;
        const double slope = log(share / (1 - share)) / 1.702 * sqrt(0.5 * mean_square_slope);
        const double seen = sin(atan(fall) + atan(slope));
        const double rise_rad = atan(fall) + 2 * atan(slope);
        if (seen > 0 && rise_rad > 0) {
            const double weight = seen * fresnel_reflectance(seen, 1.34);
            const bool is_wall =
                rise_rad < 0.5 * M_PI && tan(rise_rad) * (WALL_M - EYE_M / fall) < HIGH_M;
            f.wall += is_wall ? weight : 0;
            f.all += weight;
        }
    }
    return f;
}

// The mean of the rows that reflection_filter.frag takes together.
static double find_covered(uint32_t row, double mean_square_slope)
{
    static const double SHARES[5] = {0.5, 1, 1, 1, 0.5};
    double all = 0, wall = 0;
    for (uint32_t i = 0; i < 5; i++) {
        const struct facets f = find_facets(row + i > 2 ? row + i - 2 : 0, mean_square_slope);
        all += SHARES[i] * f.all;
        wall += SHARES[i] * f.wall;
    }
    return wall / all;
}

static void rough_water_draws_the_image_out(void **state)
{
    static float texels[4 * HALF * HALF];
    const float mean_square_slope = 0.02f;
    draw(*state, mean_square_slope, texels);
    for (uint32_t y = 0; y < HALF / 2 - 6; y++) {
        const float *texel = texels + 4 * ((size_t)y * HALF + HALF / 2);
        const double covered = find_covered(y, (double)mean_square_slope);
        // 32 facets where the law has all, 8 of them in a row: one of those is 0.03 to 0.1.
        assert_true(fabs((double)texel[3] - covered) < 0.06);
        assert_true(fabs((double)(texel[0] - (WALL - AIR) * texel[3])) < 0.01);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calm_water_mirrors_the_wall_where_geometry_says),
        cmocka_unit_test(rough_water_draws_the_image_out),
        cmocka_unit_test(no_coast_is_mirrored_into_space),
        cmocka_unit_test(no_land_of_the_frame_before_is_mirrored),
    };
    return cmocka_run_group_tests(tests, fixture_set_up_gpu, fixture_tear_down);
}
