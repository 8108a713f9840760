// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Ground made of noise: the GPU's floats agree with the CPU's doubles anywhere and at any distance,
// gradients are those of the heights, bounds hold, and footprints hide octaves without a step.
#include "fixture.h"

#include "gpu/pass.h"
#include "terrain/ceiling.h"
#include "terrain/look.h"

#include <stdio.h>
#include <stdlib.h>

static const double DEGREE = 3.14159265358979323846 / 180;
enum { PLACES = 64 };

static struct surface_desc invent(enum noise_form form, double ocean_share)
{
    struct surface_desc desc = fixture_invent(3);
    desc.noise.form = desc.continents.form = form;
    desc.noise.has_sea = ocean_share > 0;
    desc.continents.ocean_share = ocean_share;
    return desc;
}

// Draws the heights of a surface at directions.
struct asker {
    struct fixture *fixture;
    const struct surface *surface;
    struct gpu_program program;
    struct gpu_texture texture;
    struct gpu_target target;
};

static void asker_init(struct fixture *f, const struct surface *s, struct asker *out)
{
    *out = (struct asker){.fixture = f, .surface = s};
    struct surface_defines defines;
    surface_get_defines(s, s->counts[SURFACE_ELEVATION], &defines);
    const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                          .fragment = "heights.frag",
                                          .defines = defines.list,
                                          .define_count = defines.count};
    assert_int_equal(gpu_program_init(f->gpu, &desc, &out->program), TRL_OK);
    struct gpu_texture_desc texture = gpu_texture_desc_default();
    texture.width = PLACES;
    texture.format = GPU_FORMAT_RGBA32F;
    texture.filter = GPU_FILTER_NEAREST;
    assert_int_equal(gpu_texture_init(f->gpu, &texture, &out->texture), TRL_OK);
    const struct gpu_target_desc target = {.color_count = 1,
                                           .colors = {{.texture = &out->texture}}};
    assert_int_equal(gpu_target_init(f->gpu, &target, &out->target), TRL_OK);
}

static void asker_finish(struct asker *a)
{
    gpu_target_finish(&a->target);
    gpu_texture_finish(&a->texture);
    gpu_program_finish(&a->program);
}

// Offsets from an anchor: what the shader is given, in float.
struct question {
    float offset[PLACES][4];
    float answer[PLACES][4];
};

static void ask(struct asker *a, const struct anchor *anchor, struct question *q)
{
    const struct surface_eye eye = {.up = anchor->up, .reach_rad = 4};
    const struct surface_selection seen = surface_select(a->surface, &eye);
    surface_bind(a->surface, &seen, anchor, &a->program);
    gpu_program_set_vec4s(&a->program, "u_offsets", q->offset[0], PLACES);
    const struct gpu_pass pass = {.target = &a->target};
    gpu_pass_begin(a->fixture->gpu, &pass);
    assert_int_equal(gpu_draw_fullscreen(&a->program, "heights"), TRL_OK);
    const struct gpu_region all = gpu_texture_region(&a->texture, 0);
    assert_int_equal(gpu_texture_read(&a->texture, &all, q->answer[0]), TRL_OK);
}

// The direction that an offset in float stands for; z is off by what a float rounds, so it is made
// from the others.
static struct vec3 direction_of(const struct anchor *anchor, const float o[4])
{
    const double x = (double)o[0], y = (double)o[1];
    return anchor_planet(anchor, (struct vec3){x, y, sqrt(1 - x * x - y * y)});
}

static void put_offset(float o[4], double angle, double heading, double log2_footprint)
{
    const double x = sin(angle) * sin(heading), y = sin(angle) * cos(heading);
    o[0] = (float)x;
    o[1] = (float)y;
    o[2] = (float)(-(x * x + y * y) / (1 + sqrt(1 - x * x - y * y)));
    o[3] = (float)log2_footprint;
}

static double altitude_with(const struct surface *s, struct vec3 up, double log2_footprint)
{
    struct noise_place place;
    surface_relief(s, up, &place);
    place.log2_footprint = log2_footprint;
    const double altitude = noise_relief_at(&s->noise, &place).height;
    return s->noise.desc.has_sea ? fmax(altitude, 0) : altitude;
}

static const double PLACES_DEG[][2] = {{12.3, 45.6},    {-33.3, -71}, {89.9999, 10}, {-90, 0},
                                       {20, 179.99999}, {-47, -180},  {0, 0},        {89.5, -120}};

// Around many anchors, from 1 cm away to 1000 km; footprints as a camera there would have them, a
// thousandth of the distance, and at least nothing.
static void check_agreement(struct fixture *f, const struct surface *s, double least_m)
{
    struct asker asker;
    asker_init(f, s, &asker);
    for (size_t i = 0; i < sizeof PLACES_DEG / sizeof *PLACES_DEG; i++) {
        // Slopes have no direction where columns of an equirectangular raster meet.
        if (!s->is_invented && fabs(PLACES_DEG[i][0]) > 89.9) {
            continue;
        }
        const struct anchor anchor =
            anchor_below(vec3_from_lat_lon(PLACES_DEG[i][0] * DEGREE, PLACES_DEG[i][1] * DEGREE));
        struct question q;
        for (int k = 0; k < PLACES; k++) {
            const double distance_m = 0.01 * pow(1e8, k / (PLACES - 1.0));
            // Distances of a few kilometres have pixels' footprints, the others no larger ones.
            put_offset(q.offset[k], distance_m / s->radius_m, 2.4 * k, log2(1e-3 * distance_m));
        }
        ask(&asker, &anchor, &q);
        for (int k = 0; k < PLACES; k++) {
            const double distance_m = 0.01 * pow(1e8, k / (PLACES - 1.0));
            const struct vec3 up = direction_of(&anchor, q.offset[k]);
            const double wanted = altitude_with(s, up, (double)q.offset[k][3]);
            // Arctangents of drivers are good to a few parts in a million, slopes are up to 2, and
            // gullies turn with what is already off: three hundredths of the footprint.
            const double tolerance = least_m + 3e-5 * distance_m;
            if (!(fabs((double)q.answer[k][0] - wanted) <= tolerance)) {
                fail_msg("%g N %g E, %g m away: GPU %.6f, CPU %.6f", PLACES_DEG[i][0],
                         PLACES_DEG[i][1], distance_m, (double)q.answer[k][0], wanted);
            }
        }
    }
    asker_finish(&asker);
}

static void test_gpu_and_cpu_agree_on_invented_heights(void **state)
{
    struct fixture *f = *state;
    for (int form = 0; form < NOISE_FORM_COUNT; form++) {
        const struct surface_desc desc =
            invent((enum noise_form)form, form == NOISE_PLAIN ? 0.6 : 0);
        struct surface s;
        assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
        // Of kilometres a float keeps 2e-4 m, at each of some twenty additions.
        check_agreement(f, &s, 1e-2);
        surface_finish(&s);
    }
}

// Where the rest of the heights is: CPU queries that need no GPU.
static struct vec3 some_place(int i)
{
    const double z = 2 * fmod(i * 0.61803398875, 1) - 1;
    const double longitude = 2.39996323 * i;
    return (struct vec3){sqrt(1 - z * z) * cos(longitude), sqrt(1 - z * z) * sin(longitude), z};
}

// The gradient against differences over 1 cm, tangential. Plain and ridged octaves are
// differentiated exactly; gullies, and roughness by slope, count their direction and share as
// constant.
static void check_gradients(const struct surface *s, double mean_bound)
{
    double sum = 0, slopes = 0;
    const int count = 400;
    for (int i = 0; i < count; i++) {
        const struct vec3 up = some_place(i + 1);
        const struct vec3 along = vec3_normalize(vec3_cross(up, some_place(i + 7)));
        const double step = 0.005 / s->radius_m;
        const double low =
            altitude_with(s, vec3_normalize(vec3_sub(up, vec3_scale(along, step))), -100);
        const double high =
            altitude_with(s, vec3_normalize(vec3_add(up, vec3_scale(along, step))), -100);
        struct noise_place place;
        const Relief r = surface_relief(s, up, &place);
        sum += fabs((high - low) / 0.01 - vec3_dot((struct vec3){r.x, r.y, r.z}, along));
        slopes += fabs((high - low) / 0.01);
    }
    if (!(sum <= mean_bound * slopes)) {
        fail_msg("form %d: gradients are off by %.3f of the slopes", (int)s->noise.desc.form,
                 sum / slopes);
    }
}

// Within 1, not steeper than rays are told, and not as deep everywhere: about forks they are
// shallow. Divided by their full length they are 3 times as steep there.
static void test_gullies_come_and_go(void **state)
{
    (void)state;
    enum { COUNT = 300000 };
    double most = 0, steepest = 0, squares = 0;
    for (int i = 0; i < COUNT; i++) {
        const struct vec3 at = vec3_scale(some_place(i), 0.001 * i), along = some_place(7 * i + 3);
        const NoisePlace place = {at.x, at.y, at.z, (Whole)i, 5, 11};
        const NoiseValue v = noise_stripes(place, along.x, along.y, along.z);
        most = fmax(most, fabs(v.value));
        steepest = fmax(steepest, sqrt(v.x * v.x + v.y * v.y + v.z * v.z));
        squares += v.value * v.value;
    }
    assert_true(most <= 1);
    assert_true(steepest < 21.1);
    assert_close(sqrt(squares / COUNT), 0.6, 0.01);
}

static void test_gradients_are_those_of_the_heights(void **state)
{
    struct fixture *f = *state;
    const double bounds[NOISE_FORM_COUNT] = {0.02, 0.02, 0.4};
    for (int form = 0; form < NOISE_FORM_COUNT; form++) {
        struct surface_desc desc = invent((enum noise_form)form, 0);
        desc.noise.level_roughness = form == NOISE_ERODED ? 0.25 : 1;
        desc.noise.smallest_m = 65; // soil, below, has slopes alone
        struct surface s;
        assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
        check_gradients(&s, bounds[form]);
        surface_finish(&s);
    }
}

// From another place that is within reach of it, over all sizes of reach: no ground is above the
// ceiling, nor outside the bounds.
static void check_ceiling(const struct surface *s)
{
    struct terrain_ceiling ceiling;
    assert_int_equal(terrain_ceiling_init(s, &ceiling), TRL_OK);
    for (int i = 1; i < 8000; i++) {
        const struct vec3 at = some_place(i);
        const double height = surface_altitude(s, at);
        const double reach = pow(10, -8.0 * (i % 97) / 96);
        const struct vec3 near =
            vec3_normalize(vec3_add(at, vec3_scale(some_place(i + 11), 0.9 * reach)));
        const double angle = 2 * asin(vec3_length(vec3_sub(near, at)) / 2) + 1e-9;
        const double high = terrain_ceiling_m(&ceiling, near, angle);
        if (!(high >= height)) {
            fail_msg("place %d, reach %g: ceiling %.2f below %.2f", i, angle, high, height);
        }
        const struct surface_bounds b = surface_bounds_around(s, at, 1e-6);
        assert_true((double)b.min <= height && height <= (double)b.max);
    }
    terrain_ceiling_finish(&ceiling);
}

static void test_no_ground_is_above_the_ceiling(void **state)
{
    struct fixture *f = *state;
    for (int form = 0; form < NOISE_FORM_COUNT; form++) {
        const struct surface_desc desc =
            invent((enum noise_form)form, form == NOISE_RIDGED ? 0.6 : 0);
        struct surface s;
        assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
        check_ceiling(&s);
        surface_finish(&s);
    }
}

// Heights of data: a wave of 1 km on texels of a degree, and an inset of finer ones.
static double rolling_height(double latitude, double longitude)
{
    return 3000 + 800 * sin(latitude * 1.7) * cos(longitude * 2.3);
}

static double inset_height(double latitude, double longitude)
{
    return 3000 + 100 * sin(latitude * 40) * cos(longitude * 50);
}

// What a description of both points to.
struct inset {
    char paths[2][128];
    struct surface_layer_desc layers[2];
};

static struct surface_desc describe_inset(struct fixture *f, double height(double, double),
                                          struct inset *out)
{
    const struct raster_place globe = {-180, 90, 1, 360, 180};
    const struct raster_place small = {40, 16, 0.02, 400, 200};
    fixture_write_heights(f, "rolling", &globe, rolling_height, out->paths[0]);
    fixture_write_heights(f, "inset", &small, height, out->paths[1]);
    for (int i = 0; i < 2; i++) {
        out->layers[i] = (struct surface_layer_desc){.kind = SURFACE_ELEVATION,
                                                     .path = out->paths[i],
                                                     .scale = 1,
                                                     .feather_rad = i > 0 ? DEGREE / 2 : 0};
    }
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = 6e6;
    desc.layers = out->layers;
    desc.layer_count = 2;
    desc.detail =
        (struct surface_detail){.roughness = 1, .albedo_variation = 0.2, .smallest_m = 0.2};
    return desc;
}

static void test_detail_of_data_agrees_on_both_sides(void **state)
{
    struct fixture *f = *state;
    struct inset inset;
    const struct surface_desc desc = describe_inset(f, inset_height, &inset);
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    assert_true(noise_is_there(&s.noise));
    // Places on the maps of data are floats: half a metre, on slopes of up to a tenth.
    check_agreement(f, &s, 0.1);
    check_ceiling(&s);
    surface_finish(&s);
}

static double find_made(const struct surface *s, struct vec3 at)
{
    return surface_altitude(s, at) - surface_altitude_of_data(s, at);
}

// How much is left, along a meridian, of what is made up without the inset.
static double find_left(const struct surface *with, const struct surface *without, double longitude)
{
    double sum = 0, all = 0;
    for (int i = 0; i < 500; i++) {
        const double latitude = (12.7 + 2.6 * i / 500) * DEGREE;
        const struct vec3 at = vec3_from_lat_lon(latitude, longitude * DEGREE);
        const double made = find_made(without, at);
        sum += find_made(with, at) * made;
        all += made * made;
    }
    return sum / all;
}

// Half way into a layer half of each octave is left. By one size of texels between those of inside
// and outside the largest, which are nearly all, would be gone in the first fifth of the way.
static void test_detail_fades_as_the_layer_does(void **state)
{
    struct fixture *f = *state;
    struct inset inset;
    struct surface_desc desc = describe_inset(f, rolling_height, &inset);
    struct surface with, without;
    desc.layer_count = 1;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &without), TRL_OK);
    desc.layer_count = 2;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &with), TRL_OK);
    assert_true(find_left(&with, &without, 39.9) == 1);
    // Octaves weigh each other a little: less of one leaves more of the next.
    const double half = find_left(&with, &without, 40.25);
    if (!(half > 0.4 && half < 0.65)) {
        fail_msg("half way %.3f are left", half);
    }
    assert_true(fabs(find_left(&with, &without, 41)) < 0.05);
    surface_finish(&with);
    surface_finish(&without);
}

// Shores: octaves fade within 25 m of the sea, which is level.
static double shore_height(double latitude, double longitude)
{
    return 40 * sin(latitude * 0.2) * cos(longitude * 0.17);
}

static double sea_is_water(double latitude, double longitude)
{
    return shore_height(latitude, longitude) < 0 ? 255 : 0;
}

static void test_no_shore_is_above_the_ceiling(void **state)
{
    struct fixture *f = *state;
    const struct raster_place globe = {-180, 90, 0.5, 720, 360};
    char paths[2][128];
    fixture_write_heights(f, "shore", &globe, shore_height, paths[0]);
    fixture_write_bytes(f, "sea", &globe, sea_is_water, paths[1]);
    const struct surface_layer_desc layers[] = {
        {.kind = SURFACE_ELEVATION, .path = paths[0], .scale = 1},
        {.kind = SURFACE_WATER, .path = paths[1]}};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = 6e6;
    desc.layers = layers;
    desc.layer_count = 2;
    desc.detail =
        (struct surface_detail){.roughness = 1, .albedo_variation = 0.2, .smallest_m = 0.2};
    struct surface s;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
    assert_true(noise_is_there(&s.noise) && s.noise.desc.full_height_m > 0);
    check_ceiling(&s);
    // In the midst of the sea nothing rises: rays step far.
    struct terrain_ceiling ceiling;
    assert_int_equal(terrain_ceiling_init(&s, &ceiling), TRL_OK);
    int level = 0;
    for (int i = 0; i < 2000; i++) {
        const struct vec3 at = some_place(i);
        const bool is_sea = surface_bounds_around(&s, at, 0.5 * DEGREE).max <= 0;
        const bool is_known = terrain_ceiling_is_below(&ceiling, at, 0.001 * DEGREE, 1e-3);
        assert_true(!is_known || surface_altitude(&s, at) < 1e-3);
        level += is_known;
        assert_true(!is_sea || is_known);
    }
    assert_in_range(level, 500, 1100); // nearly half of the globe
    terrain_ceiling_finish(&ceiling);
    surface_finish(&s);
}

// Squared change of the normal of a cliff of 63 degrees over 0.4 m along the ground, which the step
// `along` the horizon and `up` it leads, mean over places.
static double find_roughness(const struct surface *s, double along_m, double up_m)
{
    double sum = 0;
    for (int i = 0; i < 400; i++) {
        struct noise_stand stand = {1000, 2, {0, 0, 0}};
        struct vec3 normals[2];
        const struct vec3 up = some_place(i + 1);
        const struct vec3 east = vec3_normalize(vec3_cross((struct vec3){0, 0, 1}, up));
        const struct vec3 north = vec3_cross(up, east);
        stand.normal = vec3_normalize(vec3_sub(up, vec3_scale(north, 2)));
        for (int k = 0; k < 2; k++) {
            const struct vec3 aside = vec3_add(vec3_scale(east, k * along_m / s->radius_m),
                                               vec3_scale(north, k * up_m / 2 / s->radius_m));
            const struct noise_place place = {.up = vec3_normalize(vec3_add(up, aside)),
                                              .data = {10, 10, 1},
                                              .log2_footprint = NOISE_ALL};
            stand.height_m = 1000 + k * up_m;
            normals[k] = noise_rock_normal(&s->noise, &place, &stand);
        }
        const struct vec3 change = vec3_sub(normals[1], normals[0]);
        sum += vec3_dot(change, change) / 400;
    }
    return sum;
}

static void test_a_cliff_is_as_rough_upward_as_along(void **state)
{
    struct fixture *f = *state;
    const struct surface_desc desc = invent(NOISE_ERODED, 0);
    struct surface s;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
    const double along = find_roughness(&s, 0.4, 0), upward = find_roughness(&s, 0, 0.4 * 0.894);
    // Each is known to a tenth. Heights' own octaves are 2.24 times as long up this slope as along
    // it, which would make the ratio 1 / 2.24^2 = 0.2.
    assert_true(along > 1e-3);
    assert_true(upward / along > 0.7 && upward / along < 1.4);
    const struct noise_place place = {.up = {1, 0, 0}, .log2_footprint = NOISE_ALL};
    const struct noise_stand level = {1000, 0.5, {1, 0, 0}};
    assert_true(noise_rock_normal(&s.noise, &place, &level).x == 1);
    surface_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gpu_and_cpu_agree_on_invented_heights),
        cmocka_unit_test(test_no_ground_is_above_the_ceiling),
        cmocka_unit_test(test_detail_fades_as_the_layer_does),
        cmocka_unit_test(test_no_shore_is_above_the_ceiling),
        cmocka_unit_test(test_detail_of_data_agrees_on_both_sides),
        cmocka_unit_test(test_gullies_come_and_go),
        cmocka_unit_test(test_gradients_are_those_of_the_heights),
        cmocka_unit_test(test_a_cliff_is_as_rough_upward_as_along),
    };
    setenv("TRL_SHADER_DIR", TEST_SHADER_DIR, 1);
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
