// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The hemisphere mesh against the altitudes of the CPU: a small planet with rolling land, an inset
// that lies over it, cameras everywhere.
#include "fixture.h"

#include <math.h>
#include <stdlib.h>

static const double R = 1e6;
static const double DEGREE = 3.14159265358979323846 / 180;

// Smooth over the whole sphere, poles and antimeridian included; -400 to 2400 m.
static double globe_height(double latitude, double longitude)
{
    const struct vec3 d = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
    return 1000 + 700 * sin(5 * d.x + 1) * cos(4 * d.y) + 700 * sin(6 * d.z) * cos(3 * d.x);
}

static double inset_height(double latitude, double longitude)
{
    return 1500 + 120 * sin(latitude * 8) * cos(longitude * 7);
}

struct planet {
    struct fixture *f;
    struct surface surface;
    struct mesher *mesher;
    struct picture picture;
};

static void make_planet(struct fixture *f, struct planet *p)
{
    char globe[128];
    char inset[128];
    const struct raster_place everywhere = {-180, 90, 0.5, 720, 360};
    const struct raster_place somewhere = {28, 42, 0.02, 200, 200};
    fixture_write_heights(f, "globe", &everywhere, globe_height, globe);
    fixture_write_heights(f, "inset", &somewhere, inset_height, inset);
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = globe, .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = inset, .scale = 1, .feather_rad = DEGREE}};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = 2;
    desc.layers = layers;
    p->f = f;
    assert_int_equal(surface_init(f->gpu, &desc, &p->surface), TRL_OK);
    const struct hemisphere_desc grid = {FIXTURE_CELLS, false};
    assert_int_equal(hemisphere_create_of(&p->surface, &grid, &p->mesher), TRL_OK);
    fixture_picture_init(f, &p->picture);
}

static void destroy_planet(struct planet *p)
{
    fixture_picture_finish(p->f, &p->picture);
    mesher_destroy(&p->mesher);
    surface_finish(&p->surface);
}

// `height_m` above the ground there.
static struct camera place_camera(const struct planet *p, struct camera_place place,
                                  double height_m)
{
    const struct vec3 up = vec3_from_lat_lon(place.latitude * DEGREE, place.longitude * DEGREE);
    place.radius_m = R;
    place.altitude_m = surface_altitude(&p->surface, up) + height_m;
    return fixture_camera(&place);
}

// Poles, antimeridian, the inset's border and middle, and nowhere in particular.
static const struct camera_place PLACES[] = {
    {.latitude = 90, .longitude = 20},      {.latitude = -89.9, .longitude = 130},
    {.latitude = 12, .longitude = 179.999}, {.latitude = -40, .longitude = -179.99},
    {.latitude = 40, .longitude = 28.3},    {.latitude = 40, .longitude = 30},
    {.latitude = 3, .longitude = -77}};
enum { PLACE_COUNT = sizeof PLACES / sizeof PLACES[0] };

static void check_altitudes(struct planet *p, const struct camera *camera, double tolerance_m)
{
    fixture_picture_draw(&p->picture, p->mesher, camera);
    for (int k = 0; k < PICTURE_SIDE * PICTURE_SIDE; k += 37) {
        const float *pixel = p->picture.pixels + 4 * k;
        assert_true(pixel[3] > -1e8f);
        const struct vec3 at = {camera->position_m.x + (double)pixel[0],
                                camera->position_m.y + (double)pixel[1],
                                camera->position_m.z + (double)pixel[2]};
        const double truth = surface_altitude(&p->surface, at);
        assert_close((double)pixel[3], truth, tolerance_m);
        // The position lies where its altitude says, but for the same sag.
        assert_close(vec3_length(at) - R, truth, tolerance_m);
    }
}

static void test_altitudes_are_those_of_the_cpu(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    for (size_t i = 0; i < PLACE_COUNT; i++) {
        struct camera_place place = PLACES[i];
        place.pitch = -90;
        place.fov = 80;
        const struct camera camera = place_camera(&p, place, 1500);
        // Cells near the camera are at most a tenth of the finest texel in reach, or of the
        // height: the inset bends by 120 m (8 rad/deg * 0.02 deg)^2 = 3 m a texel squared,
        // the feather's slope over it less. Floats of some km: 1 mm.
        check_altitudes(&p, &camera, 1.0);
    }
    destroy_planet(&p);
}

// Another grid is another mesh of the same ground: a quarter of the vertices, cells twice as wide,
// so four times the sag; 1 m of the test above is generous by more than that.
static void test_a_grid_of_another_size_is_the_same_ground(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    const uint64_t bytes = p.mesher->stats.bytes;
    mesher_destroy(&p.mesher);
    const struct hemisphere_desc desc = {FIXTURE_CELLS / 2, false};
    assert_int_equal(hemisphere_create_of(&p.surface, &desc, &p.mesher), TRL_OK);
    assert_true(p.mesher->stats.bytes < bytes / 3);
    struct camera_place place = PLACES[PLACE_COUNT - 1];
    place.pitch = -90;
    place.fov = 80;
    const struct camera camera = place_camera(&p, place, 1500);
    check_altitudes(&p, &camera, 4.0);
    destroy_planet(&p);
}

// First crossing of the ground by a ray, by steps far smaller than its hills, then halving.
static double cast_ray(const struct planet *p, const struct camera *camera, struct vec3 ray)
{
    const double step = 100;
    for (double t = step; t < 3e5; t += step) {
        const struct vec3 at = vec3_add(camera->position_m, vec3_scale(ray, t));
        if (vec3_length(at) - R > surface_altitude(&p->surface, at)) {
            continue;
        }
        double low = t - step;
        double high = t;
        for (int i = 0; i < 20; i++) {
            const double mid = 0.5 * (low + high);
            const struct vec3 m = vec3_add(camera->position_m, vec3_scale(ray, mid));
            if (vec3_length(m) - R > surface_altitude(&p->surface, m)) {
                low = mid;
            } else {
                high = mid;
            }
        }
        return high;
    }
    return INFINITY;
}

static void test_pixels_agree_with_a_ray_caster(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    int compared = 0;
    for (size_t i = 0; i < PLACE_COUNT; i++) {
        struct camera_place place = PLACES[i];
        place.pitch = -8;
        place.heading = 50.0 * (double)i;
        place.fov = 50;
        const struct camera camera = place_camera(&p, place, 800);
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        int outliers = 0;
        int samples = 0;
        for (int y = 3; y < PICTURE_SIDE; y += 13) {
            for (int x = 5; x < PICTURE_SIDE; x += 17) {
                const struct vec3 ray = fixture_ray(&camera, x, y);
                const double truth = cast_ray(&p, &camera, ray);
                const float *pixel = p.picture.pixels + 4 * (y * PICTURE_SIDE + x);
                const struct vec3 at = {(double)pixel[0], (double)pixel[1], (double)pixel[2]};
                const double got = pixel[3] > -1e8f ? vec3_length(at) : (double)INFINITY;
                samples++;
                if (isinf(truth) && isinf(got)) {
                    continue;
                }
                // At a grazing angle of g a sag of z shifts the hit by z / g; cells are about 2 %
                // of the distance, land bends with 1 / 1e5 m: z = (0.02 t)^2 / 8e5, g > 0.05.
                const double tolerance = 5 + 1e-8 * truth * truth + 0.005 * truth;
                outliers += !(fabs(got - truth) < tolerance);
                if (isfinite(got)) {
                    // On the pixel's ray, to the precision of rasterised floats.
                    const struct vec3 off = vec3_cross(ray, vec3_scale(at, 1 / got));
                    assert_true(vec3_length(off) < 1e-4);
                    compared++;
                }
            }
        }
        // Crests: a pixel that just misses one sees the next, far behind.
        assert_true(outliers <= samples / 25);
    }
    assert_true(compared > 100);
    destroy_planet(&p);
}

// Whether a ray meets a sphere about the centre; from inside it always does.
static bool hits_sphere(const struct camera *camera, struct vec3 ray, double radius)
{
    const double b = vec3_dot(camera->position_m, ray);
    const double c = vec3_dot(camera->position_m, camera->position_m) - radius * radius;
    return c < 0 || (b < 0 && b * b - c > 0);
}

static void test_there_are_no_holes(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    const double low = R + surface_min_altitude(&p.surface);
    const double high = R + surface_max_altitude(&p.surface);
    const double heights[] = {2, 50, 3000, 3e4, 3e5, 2e6, 1e7};
    srand(7);
    for (size_t i = 0; i < 42; i++) {
        struct camera_place place = PLACES[i % PLACE_COUNT];
        const double height = heights[i / 6];
        place.heading = rand() % 360;
        place.fov = 20 + rand() % 70;
        const double horizon = -acos(R / (R + height)) / DEGREE;
        place.pitch = i % 3 == 0 ? horizon : i % 3 == 1 ? -90 : horizon - rand() % 40;
        const struct camera camera = place_camera(&p, place, height);
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        for (int y = 0; y < PICTURE_SIDE; y++) {
            for (int x = 0; x < PICTURE_SIDE; x++) {
                const struct vec3 ray = fixture_ray(&camera, x, y);
                const bool is_ground = p.picture.pixels[4 * (y * PICTURE_SIDE + x) + 3] > -1e8f;
                assert_true(is_ground || !hits_sphere(&camera, ray, low));
                assert_true(!is_ground || hits_sphere(&camera, ray, high));
            }
        }
    }
    destroy_planet(&p);
}

static void test_small_motion_moves_no_vertex(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    struct camera_place place = PLACES[4];
    place.pitch = -20;
    place.fov = 60;
    struct camera camera = place_camera(&p, place, 400);
    fixture_picture_draw(&p.picture, p.mesher, &camera);
    assert_int_equal(p.mesher->stats.projections, 1);
    const size_t count = (size_t)PICTURE_SIDE * PICTURE_SIDE;
    float *before = malloc(count * 4 * sizeof *before);
    assert_non_null(before);
    for (size_t i = 0; i < 4 * count; i++) {
        before[i] = p.picture.pixels[i];
    }
    // A hundredth of a pixel at the nearest ground.
    const struct vec3 step = vec3_scale(camera.right, 400 * 0.01 / PICTURE_SIDE);
    camera.position_m = vec3_add(camera.position_m, step);
    fixture_picture_draw(&p.picture, p.mesher, &camera);
    assert_int_equal(p.mesher->stats.projections, 1);
    size_t changed = 0;
    for (size_t i = 0; i < count; i++) {
        const float a = before[4 * i + 3];
        const float b = p.picture.pixels[4 * i + 3];
        changed += (a > -1e8f) != (b > -1e8f) || fabsf(a - b) > 1;
    }
    // Pixels on a crest may see what is behind it.
    assert_true(changed <= count / 1000);
    free(before);
    // Farther than the threshold (15 % of the height) the mesh is made anew.
    camera.position_m = vec3_add(camera.position_m, vec3_scale(camera.right, 100));
    fixture_picture_draw(&p.picture, p.mesher, &camera);
    assert_int_equal(p.mesher->stats.projections, 2);
    destroy_planet(&p);
}

// Below the threshold, while the camera looks at the sky; never while it sees the ground.
static void test_mesh_changes_where_nobody_sees_it(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    struct camera_place place = PLACES[4];
    place.pitch = -20;
    place.fov = 60;
    struct camera ground = place_camera(&p, place, 400);
    place.pitch = 70;
    struct camera sky = place_camera(&p, place, 400);
    assert_int_equal(mesher_update(p.mesher, &ground), TRL_OK);
    const struct vec3 step = vec3_scale(ground.right, 400 * 0.05); // a third of the threshold
    ground.position_m = vec3_add(ground.position_m, step);
    assert_int_equal(mesher_update(p.mesher, &ground), TRL_OK);
    assert_int_equal(p.mesher->stats.projections, 1);
    assert_int_equal(mesher_update(p.mesher, &sky), TRL_OK);
    assert_int_equal(p.mesher->stats.projections, 1); // it has not moved
    sky.position_m = ground.position_m;
    assert_int_equal(mesher_update(p.mesher, &sky), TRL_OK);
    assert_int_equal(p.mesher->stats.projections, 2);
    destroy_planet(&p);
}

static void test_chunks_out_of_sight_are_not_drawn(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    struct camera_place place = PLACES[6];
    place.fov = 40;
    const struct camera ahead = place_camera(&p, place, 300);
    fixture_picture_draw(&p.picture, p.mesher, &ahead);
    const uint32_t seen = p.mesher->stats.triangles;
    assert_true(seen > 0);
    place.pitch = 89;
    const struct camera sky = place_camera(&p, place, 300);
    fixture_picture_draw(&p.picture, p.mesher, &sky);
    assert_true(p.mesher->stats.triangles < seen / 10);
    destroy_planet(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_altitudes_are_those_of_the_cpu),
        cmocka_unit_test(test_a_grid_of_another_size_is_the_same_ground),
        cmocka_unit_test(test_pixels_agree_with_a_ray_caster),
        cmocka_unit_test(test_there_are_no_holes),
        cmocka_unit_test(test_small_motion_moves_no_vertex),
        cmocka_unit_test(test_mesh_changes_where_nobody_sees_it),
        cmocka_unit_test(test_chunks_out_of_sight_are_not_drawn),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
