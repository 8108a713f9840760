// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Level made-up ground from the eye's height to a kilometre: pictures of it differ from pixel to
// pixel as ground does, at each size that they show, without noise of what they do not, and are as
// bright from near as from far.
#include "fixture.h"

#include <stdio.h>

static const double DEGREE = 3.14159265358979323846 / 180;
static const double SUN_DEG = 40;
enum { LEVELS = 5, SIDE = PICTURE_SIDE };

static struct biome make_biome(float albedo, double slope)
{
    return (struct biome){.albedo = {albedo, albedo, albedo},
                          .variation = 0.15,
                          .altitude_m = FIXTURE_ANY,
                          .slope = {slope, 1e9, 0.2},
                          .latitude_deg = FIXTURE_ANY,
                          .temperature_C = FIXTURE_ANY,
                          .moisture = FIXTURE_ANY};
}

// Plains, of a soil and of a rock half as bright.
static struct surface_desc plains(void)
{
    struct surface_desc desc = fixture_invent(3);
    desc.noise.smallest_m = 0.03;
    desc.continents.amplitude_m = 1000;
    desc.biomes.count = 2;
    desc.biomes.list[0] = make_biome(0.3f, -1e9);
    desc.biomes.list[1] = make_biome(0.15f, 0.7);
    return desc;
}

// Level over a kilometre, in degrees.
static void find_plain(const struct surface *s, double *latitude, double *longitude)
{
    for (int i = 0; i < 2000; i++) {
        *latitude = 40 * sin(0.7 * i);
        *longitude = 137.5 * i;
        double steepest = 0;
        for (int k = 0; k < 9; k++) {
            const double a = (*latitude + 0.005 * (k / 3 - 1)) * DEGREE;
            const double b = (*longitude + 0.005 * (k % 3 - 1)) * DEGREE;
            struct noise_place place;
            const struct vec3 up = {cos(a) * cos(b), cos(a) * sin(b), sin(a)};
            const Relief r = surface_relief(s, up, &place);
            const struct vec3 slope = {r.fall_x, r.fall_y, r.fall_z};
            steepest =
                fmax(steepest, vec3_length(vec3_sub(slope, vec3_scale(up, vec3_dot(slope, up)))));
        }
        if (steepest < 0.05) {
            return;
        }
    }
    fail_msg("no plain");
}

// What a picture has at each size: the deviation of means over 2^k pixels from those over twice as
// many, over the mean.
struct spectrum {
    double mean, contrast[LEVELS];
};

static double mean_at(const double *light, int k, int x, int y)
{
    double sum = 0;
    for (int i = 0; i < 1 << 2 * k; i++) {
        sum += light[(y * (1 << k) + (i >> k)) * SIDE + x * (1 << k) + i % (1 << k)];
    }
    return sum / (1 << 2 * k);
}

static struct spectrum find_spectrum(const double *light)
{
    struct spectrum s = {.mean = 0};
    for (int i = 0; i < SIDE * SIDE; i++) {
        s.mean += light[i] / (SIDE * SIDE);
    }
    for (int k = 0; k < LEVELS; k++) {
        const int n = SIDE >> k;
        double sum = 0;
        for (int i = 0; i < n * n; i++) {
            const int x = i % n, y = i / n;
            sum += pow(mean_at(light, k, x, y) - mean_at(light, k + 1, x / 2, y / 2), 2);
        }
        s.contrast[k] = sqrt(sum / (n * n)) / s.mean;
    }
    return s;
}

// Straight down on a plain, in sunlight without air: what the ground sends back.
static struct spectrum look_from(const struct fixture *f, const struct surface *s, double height_m)
{
    double latitude, longitude;
    find_plain(s, &latitude, &longitude);
    struct camera_place place = {latitude, longitude, s->radius_m, 0, 0, -90, 50};
    const struct vec3 up = vec3_normalize(fixture_camera(&place).position_m);
    place.altitude_m = surface_altitude(s, up) + height_m;
    struct camera camera = fixture_camera(&place);
    const struct vec3 east = vec3_normalize(vec3_cross((struct vec3){0, 0, 1}, up));
    camera.sun_direction =
        vec3_add(vec3_scale(up, sin(SUN_DEG * DEGREE)), vec3_scale(east, cos(SUN_DEG * DEGREE)));
    const struct composed_picture p = fixture_compose(f, s, &camera);
    static double light[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) {
        const float *n = &p.normal_sun[4 * i];
        const struct vec3 normal =
            vec3_normalize((struct vec3){(double)n[0], (double)n[1], (double)n[2]});
        light[i] = pow(p.albedo_water[4 * i] / 255.0, 2) * (double)n[3] *
                   fmax(vec3_dot(normal, camera.sun_direction), 0);
    }
    mem_free(f->ctx, p.albedo_water);
    mem_free(f->ctx, p.normal_sun);
    return find_spectrum(light);
}

static void test_ground_near_by_is_no_blur(void **state)
{
    struct fixture *f = *state;
    const struct surface_desc desc = plains();
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    // Without soil and stones the first two have 0.005 of two pixels, the third 0.009.
    static const double HEIGHTS_M[] = {1000, 100, 10, 1.7}, LEAST[] = {0.015, 0.018, 0.06, 0.08};
    double far_mean = 0;
    for (int i = 0; i < 4; i++) {
        const struct spectrum seen = look_from(f, &s, HEIGHTS_M[i]);
        printf("%6.1f m: mean %.4f, contrast", HEIGHTS_M[i], seen.mean);
        for (int k = 0; k < LEVELS; k++) {
            printf(" %.4f", seen.contrast[k]);
        }
        printf("\n");
        for (int k = 0; k < LEVELS - 1; k++) {
            assert_true(seen.contrast[k] > LEAST[i]);
        }
        // Where each pixel is drawn without knowing of its neighbours this is 2.
        assert_true(seen.contrast[0] < 1.25 * seen.contrast[1]);
        // Stones' shadows take some. The last is less than two metres wide, of a colour of its own.
        far_mean = i == 0 ? seen.mean : far_mean;
        if (i < 3) {
            assert_close(seen.mean / far_mean, 0.97, 0.04);
        }
    }
    surface_finish(&s);
}

// Slope over a way to the north, from the slopes on it.
static double slope_over(const struct surface *s, double latitude, double longitude,
                         double length_m)
{
    enum { STEPS = 100 };
    const struct vec3 north = {-sin(latitude) * cos(longitude), -sin(latitude) * sin(longitude),
                               cos(latitude)};
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double along = latitude + length_m / s->radius_m * (i + 0.5) / STEPS;
        struct noise_place place;
        const Relief r = surface_relief(s, vec3_from_lat_lon(along, longitude), &place);
        sum += vec3_dot((struct vec3){r.x, r.y, r.z}, north) / STEPS;
    }
    return sum;
}

// Level ground deviates by some degrees over a metre (Shepard et al. 2001), and by more the shorter
// the length, as it is seen; the heights that meshes take have none of that.
static void test_level_ground_is_as_rough_as_natural(void **state)
{
    struct fixture *f = *state;
    const struct surface_desc desc = plains();
    struct surface s;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
    static const double LENGTHS_M[] = {10, 1, 0.1};
    double slopes_deg[3] = {0}, rises_deg[3] = {0};
    double latitude, longitude;
    find_plain(&s, &latitude, &longitude);
    enum { COUNT = 400 };
    for (int i = 0; i < 3; i++) {
        double slopes = 0, rises = 0;
        for (int k = 0; k < COUNT; k++) {
            const double a = latitude * DEGREE + (k % 20) * 5e-7;
            const double b = longitude * DEGREE + (k / 20) * 5e-7;
            const double step = LENGTHS_M[i] / s.radius_m;
            const double rise = surface_altitude(&s, vec3_from_lat_lon(a + step, b)) -
                                surface_altitude(&s, vec3_from_lat_lon(a, b));
            slopes += pow(slope_over(&s, a, b, LENGTHS_M[i]), 2) / COUNT;
            rises += pow(rise / LENGTHS_M[i], 2) / COUNT;
        }
        slopes_deg[i] = atan(sqrt(slopes)) / DEGREE;
        rises_deg[i] = atan(sqrt(rises)) / DEGREE;
        printf("over %4.1f m: %.2f degrees, %.2f in heights\n", LENGTHS_M[i], slopes_deg[i],
               rises_deg[i]);
    }
    surface_finish(&s);
    assert_true(slopes_deg[1] > 2 && slopes_deg[1] < 8);
    assert_true(slopes_deg[2] > 1.3 * slopes_deg[1]);
    assert_true(rises_deg[2] < 0.3);
}

// What a paraboloid hides of an even sky: the mean of sin^2 of its elevation over all azimuths.
static double hidden_by(double high, double radius, double from)
{
    enum { AZIMUTHS = 720, STEPS = 2000 };
    double sum = 0;
    for (int i = 0; i < AZIMUTHS; i++) {
        const double a = 2 * 180 * DEGREE * (i + 0.5) / AZIMUTHS;
        double steep = 0;
        for (int k = 1; k <= STEPS; k++) {
            const double away = (from + radius) * k / STEPS;
            const double x = from - away * cos(a), y = away * sin(a);
            steep = fmax(steep, high * (1 - (x * x + y * y) / (radius * radius)) / away);
        }
        sum += steep * steep / (1 + steep * steep) / AZIMUTHS;
    }
    return sum;
}

static void test_a_stone_hides_the_sky_behind_it(void **state)
{
    (void)state;
    static const double HIGH_M[] = {0.05, 0.1, 0.2}, AWAY[] = {1, 1.2, 1.5, 2, 3};
    const double radius_m = 0.2;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 5; k++) {
            const double from_m = AWAY[k] * radius_m;
            const double hides = relief_stone_hides(HIGH_M[i], radius_m, from_m);
            const double truth = hidden_by(HIGH_M[i], radius_m, from_m);
            printf("%.2f m, %.1f radii: %.4f, %.4f\n", HIGH_M[i], AWAY[k], hides, truth);
            assert_close(hides, truth, k == 0 ? 0.003 : 0.02);
        }
        // Without a ring: at the edge it is lit as the ground.
        const double cosine = 1 / sqrt(1 + pow(2 * HIGH_M[i] / radius_m, 2));
        assert_close(1 - relief_stone_hides(HIGH_M[i], radius_m, radius_m), 0.5 + 0.5 * cosine,
                     1e-12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ground_near_by_is_no_blur),
        cmocka_unit_test(test_level_ground_is_as_rough_as_natural),
        cmocka_unit_test(test_a_stone_hides_the_sky_behind_it),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
