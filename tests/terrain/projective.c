// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The projective mesh against the altitudes of the CPU: a small planet with rolling land and an
// inset of ridges, cameras everywhere, from a centimetre above the ground to a hundred radii.
#include "fixture.h"

#include "terrain/projective.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double R = 1e6;
static const double DEGREE = 3.14159265358979323846 / 180;

// Smooth over the whole sphere, poles and antimeridian included; -2400 to 2400 m.
static double globe_height(double latitude, double longitude)
{
    const struct vec3 d = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
    return 1700 * sin(5 * d.x + 1) * cos(4 * d.y) + 700 * sin(6 * d.z) * cos(3 * d.x);
}

// A crater of 20 km with a rim and a peak, and ridges around.
static double inset_height(double latitude, double longitude)
{
    const double x = (longitude - 30) * 17.45 * cos(40 * DEGREE);
    const double y = (latitude - 40) * 17.45;
    const double r = hypot(x, y) / 10;
    const double ridges = 60 * sin(x) * cos(0.7 * y) + 25 * sin(2.1 * y + x);
    return 900 + 600 * exp(-8 * (r - 1) * (r - 1)) - 1500 * exp(-2 * r * r) + ridges;
}

static double sea_height(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 0;
}

// Islands of 4 to 6 km, one kilometre wide, 25 to 95 km north of the equator.
static double island_height(double latitude, double longitude)
{
    double height = 0;
    for (int i = 0; i < 6; i++) {
        const double x = (longitude - 30 - 0.4 * (i - 2.5)) * 17.45;
        const double y = (latitude - 1.5 - 0.75 * i) * 17.45;
        height += (4000 + 400 * i) * exp(-(x * x + y * y));
    }
    return height;
}

struct planet {
    struct fixture *f;
    struct surface surface;
    struct mesher *mesher;
    struct picture picture;
};

typedef double heights_of(double latitude, double longitude);

static void make_planet_of(struct fixture *f, const trl_projective_desc *grid,
                           heights_of *const heights[2], struct planet *p)
{
    char globe[128];
    char inset[128];
    const struct raster_place everywhere = {-180, 90, 0.5, 720, 360};
    const bool is_sea = heights[0] == sea_height;
    const struct raster_place somewhere = {28, is_sea ? 6 : 42, 0.01, 400, is_sea ? 600 : 400};
    fixture_write_heights(f, "globe", &everywhere, heights[0], globe);
    fixture_write_heights(f, "inset", &somewhere, heights[1], inset);
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = globe, .scale = 1},
        {.kind = SURFACE_ELEVATION, .path = inset, .scale = 1, .feather_rad = 0.5 * DEGREE}};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = 2;
    desc.layers = layers;
    p->f = f;
    assert_int_equal(surface_init(f->gpu, &desc, &p->surface), TRL_OK);
    assert_int_equal(projective_create(&p->surface, grid, &p->mesher), TRL_OK);
    fixture_picture_init(f, &p->picture);
}

static void make_planet(struct fixture *f, const trl_projective_desc *grid, struct planet *p)
{
    heights_of *const heights[2] = {globe_height, inset_height};
    make_planet_of(f, grid, heights, p);
}

static void make_default_planet(struct fixture *f, struct planet *p)
{
    const trl_projective_desc grid = projective_desc_default();
    make_planet(f, &grid, p);
}

static void destroy_planet(struct planet *p)
{
    fixture_picture_finish(p->f, &p->picture);
    mesher_destroy(&p->mesher);
    surface_finish(&p->surface);
}

struct shot {
    const char *name;
    struct camera_place place; // altitude_m above the ground
    double roll;
};

static struct camera place_camera(const struct planet *p, const struct shot *shot)
{
    struct camera_place place = shot->place;
    const struct vec3 up = vec3_from_lat_lon(place.latitude * DEGREE, place.longitude * DEGREE);
    place.radius_m = R;
    place.altitude_m += surface_altitude(&p->surface, up);
    struct camera camera = fixture_camera(&place);
    const double c = cos(shot->roll * DEGREE), s = sin(shot->roll * DEGREE);
    const struct vec3 right = camera.right;
    camera.right = vec3_add(vec3_scale(right, c), vec3_scale(camera.up, -s));
    camera.up = vec3_add(vec3_scale(camera.up, c), vec3_scale(right, s));
    return camera;
}

// latitude, longitude, radius (filled in), height above the ground, heading, pitch, field of view.
static const struct shot SHOTS[] = {
    {"orbit", {20, 10, 0, 1.5e6, 0, -90, 60}, 0},
    {"100 km", {39, 30, 0, 1e5, 10, -35, 50}, 0},
    {"10 km", {39.6, 30, 0, 1e4, 10, -15, 50}, 0},
    {"100 m", {39.8, 30.1, 0, 100, 300, -10, 50}, 0},
    {"valley", {40, 30.15, 0, 2, 200, 5, 60}, 0},
    {"below the sphere", {-62, -77, 0, 3, 90, 0, 60}, 0},
    {"crater rim", {40.7, 30, 0, 2, 180, -8, 70}, 0},
    {"horizon at 0 m", {3, -77, 0, 0.5, 45, 0, 50}, 0},
    {"a centimetre above", {3, -77, 0, 0.01, 45, -5, 50}, 0},
    {"pole", {89.99, 10, 0, 3000, 0, -20, 60}, 25},
    {"antimeridian", {12, 179.999, 0, 300, 90, -10, 80}, -70},
    {"straight down", {40.5, 30.5, 0, 50, 0, -90, 90}, 10},
    {"ten radii", {10, 30, 0, 1e7, 0, -90, 10}, 0},
};
enum { SHOT_COUNT = sizeof SHOTS / sizeof SHOTS[0] };

static double pixel_rad(const struct camera *camera)
{
    return 2 * camera->tan_half_fov_y / PICTURE_SIDE;
}

static bool is_ground(const struct planet *p, int pixel)
{
    return p->picture.pixels[4 * pixel + 3] > -1e8f;
}

static struct vec3 find_offset(const struct planet *p, int pixel)
{
    const float *v = p->picture.pixels + (size_t)4 * pixel;
    return (struct vec3){(double)v[0], (double)v[1], (double)v[2]};
}

// By how many pixels a point of the mesh lies beside the ground that it stands for.
static double find_error(const struct planet *p, const struct camera *camera, int pixel)
{
    const struct vec3 offset = find_offset(p, pixel);
    const struct vec3 at = vec3_add(camera->position_m, offset);
    const double above = vec3_length(at) - R - surface_altitude(&p->surface, at);
    const struct vec3 up = vec3_normalize(at);
    const double across = vec3_length(vec3_cross(up, vec3_normalize(offset)));
    return above * across / (vec3_length(offset) * pixel_rad(camera));
}

static double find_rms(const struct planet *p, const struct camera *camera)
{
    double sum = 0;
    int count = 0;
    for (int k = 0; k < PICTURE_SIDE * PICTURE_SIDE; k++) {
        if (is_ground(p, k)) {
            const double error = find_error(p, camera, k);
            sum += error * error;
            count++;
        }
    }
    return count > 0 ? sqrt(sum / count) : 0;
}

static void test_mesh_lies_on_the_ground_within_a_fraction_of_a_pixel(void **state)
{
    struct planet p;
    make_default_planet(*state, &p);
    for (size_t i = 0; i < SHOT_COUNT; i++) {
        const struct camera camera = place_camera(&p, &SHOTS[i]);
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        const double rms = find_rms(&p, &camera);
        print_message("%s: %.3f pixels\n", SHOTS[i].name, rms);
        // Far below the goal of 1. Altitudes of kilometres are floats, 1e-4 m apart: a hundredth of
        // a centimetre, seen under 1/100.
        assert_true(rms < (SHOTS[i].place.altitude_m < 0.1 ? 0.2 : 0.02));
        for (int k = 0; k < PICTURE_SIDE * PICTURE_SIDE; k += 31) {
            if (is_ground(&p, k)) { // on the pixel's ray, to the precision of rasterised floats
                const struct vec3 ray = fixture_ray(&camera, k % PICTURE_SIDE, k / PICTURE_SIDE);
                const struct vec3 seen = vec3_normalize(find_offset(&p, k));
                assert_true(vec3_length(vec3_cross(ray, seen)) < 0.05 * pixel_rad(&camera) + 2e-6);
            }
        }
    }
    destroy_planet(&p);
}

static double find_clearance(const struct planet *p, const struct camera *camera, struct vec3 ray,
                             double t)
{
    const struct vec3 at = vec3_add(camera->position_m, vec3_scale(ray, t));
    return vec3_length(at) - R - surface_altitude(&p->surface, at);
}

// Whether a ray meets the ground, by steps that are short where it is near.
static bool meets_ground(const struct planet *p, const struct camera *camera, struct vec3 ray)
{
    const double top = R + surface_max_altitude(&p->surface);
    const double d = vec3_length(camera->position_m);
    const double along = vec3_dot(camera->position_m, ray);
    const double inside = along * along - (d - top) * (d + top);
    if (inside < 0) {
        return false;
    }
    const double end = -along + sqrt(inside);
    for (double t = fmax(0, -along - sqrt(inside)); t < end;) {
        const double clearance = find_clearance(p, camera, ray, t);
        if (clearance < 0) {
            return true;
        }
        t += fmax(0.1 * clearance, fmax(5e-4 * t, 0.01)); // slopes are below 10
    }
    return false;
}

// The highest row of each of some columns of pixels that shows ground is the truth's, within one.
static void test_skyline_is_that_of_a_ray_caster(void **state)
{
    struct planet p;
    make_default_planet(*state, &p);
    int skylines = 0;
    for (size_t i = 0; i < SHOT_COUNT; i++) {
        if (SHOTS[i].roll != 0) {
            continue;
        }
        const struct camera camera = place_camera(&p, &SHOTS[i]);
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        for (int x = 3; x < PICTURE_SIDE; x += 12) {
            int y = PICTURE_SIDE - 1;
            while (y > 0 && !is_ground(&p, y * PICTURE_SIDE + x)) {
                y--;
            }
            if (y == 0 || y >= PICTURE_SIDE - 2) {
                continue;
            }
            skylines++;
            assert_true(meets_ground(&p, &camera, fixture_ray(&camera, x, y - 1)));
            assert_false(meets_ground(&p, &camera, fixture_ray(&camera, x, y + 2)));
        }
    }
    assert_true(skylines > 60);
    destroy_planet(&p);
}

// Mountains far behind the horizon, no wider than a kilometre: seen by a place for every ring.
static void test_islands_behind_the_horizon_are_not_missed(void **state)
{
    struct planet p;
    heights_of *const heights[2] = {sea_height, island_height};
    const trl_projective_desc grid = projective_desc_default();
    make_planet_of(*state, &grid, heights, &p);
    const struct shot shot = {"islands", {0.05, 30, 0, 0.5, 0, 3, 40}, 0};
    const struct camera camera = place_camera(&p, &shot);
    fixture_picture_draw(&p.picture, p.mesher, &camera);
    int islands = 0;
    for (int x = 0; x < PICTURE_SIDE; x++) {
        int y = PICTURE_SIDE - 1;
        while (y > 0 && !is_ground(&p, y * PICTURE_SIDE + x)) {
            y--;
        }
        islands += y > PICTURE_SIDE / 2 - 10;
        assert_true(meets_ground(&p, &camera, fixture_ray(&camera, x, y - 1)));
        assert_false(meets_ground(&p, &camera, fixture_ray(&camera, x, y + 2)));
    }
    assert_true(islands > 15);
    destroy_planet(&p);
}

// Whether a ray meets a sphere about the centre; from inside it always does.
static bool hits_sphere(const struct camera *camera, struct vec3 ray, double radius)
{
    const double b = vec3_dot(camera->position_m, ray);
    const double c = vec3_dot(camera->position_m, camera->position_m) - radius * radius;
    return c < 0 || (b < 0 && b * b - c > 0);
}

static int check_holes(struct planet *p, const struct shot *shot)
{
    const double low = R + surface_min_altitude(&p->surface);
    const double high = R + surface_max_altitude(&p->surface);
    const struct camera camera = place_camera(p, shot);
    fixture_picture_draw(&p->picture, p->mesher, &camera);
    int bad = 0;
    for (int k = 0; k < PICTURE_SIDE * PICTURE_SIDE; k++) {
        const struct vec3 ray = fixture_ray(&camera, k % PICTURE_SIDE, k / PICTURE_SIDE);
        bad += is_ground(p, k) ? !hits_sphere(&camera, ray, high) : hits_sphere(&camera, ray, low);
        // No pixel shows the ground from below: beside it by more than the picture is wide.
        bad += is_ground(p, k) && fabs(find_error(p, &camera, k)) > 20;
    }
    if (bad > 0) {
        print_message("%d pixels: %.9g %.9g, %.9g m above the ground, heading %g, pitch %g, roll "
                      "%g, field %g\n",
                      bad, shot->place.latitude, shot->place.longitude, shot->place.altitude_m,
                      shot->place.heading, shot->place.pitch, shot->roll, shot->place.fov);
    }
    return bad;
}

static void test_there_are_no_holes(void **state)
{
    struct planet p;
    make_default_planet(*state, &p);
    const double heights[] = {0.01, 2, 50, 3000, 3e4, 3e5, 2e6, 1e7, 1e8};
    const double fields[] = {0.5, 5, 40, 75, 120, 150};
    srand(7);
    int bad = 0;
    for (int i = 0; i < 90; i++) {
        struct shot shot = SHOTS[i % SHOT_COUNT];
        shot.place.altitude_m = heights[i % 9];
        shot.place.heading = rand() % 360;
        shot.roll = i % 2 == 0 ? rand() % 360 : 0;
        shot.place.fov = fields[rand() % 6];
        const double horizon = -acos(R / (R + shot.place.altitude_m)) / DEGREE;
        const double pitches[] = {horizon, -90, horizon - rand() % 40, 89, rand() % 180 - 90};
        shot.place.pitch = pitches[rand() % 5];
        bad += check_holes(&p, &shot);
    }
    assert_int_equal(bad, 0);
    destroy_planet(&p);
}

// Another grid, another way to place rows: the same ground, if with larger triangles.
static void test_every_grid_draws_the_same_ground(void **state)
{
    const trl_projective_desc grids[] = {{128, 96, TRL_PROJECTIVE_ROWS_RELIEF},
                                         {512, 512, TRL_PROJECTIVE_ROWS_RELIEF},
                                         {448, 448, TRL_PROJECTIVE_ROWS_SPHERES}};
    const size_t shots[] = {0, 1, 2}; // spheres are made for views from above
    for (int i = 0; i < 3; i++) {
        struct planet p;
        make_planet(*state, &grids[i], &p);
        for (int k = 0; k < 3; k++) {
            const struct camera camera = place_camera(&p, &SHOTS[shots[k]]);
            fixture_picture_draw(&p.picture, p.mesher, &camera);
            const double rms = find_rms(&p, &camera);
            print_message("%u x %u, %s: %.3f pixels\n", grids[i].columns, grids[i].rows,
                          SHOTS[shots[k]].name, rms);
            assert_true(rms < 0.3);
            assert_int_equal(p.mesher->stats.triangles % (2 * grids[i].columns), 0);
        }
        destroy_planet(&p);
    }
}

static void test_it_agrees_with_the_hemisphere(void **state)
{
    struct planet p;
    make_default_planet(*state, &p);
    struct mesher *hemisphere = NULL;
    assert_int_equal(mesher_create(&p.surface, TRL_MESHER_HEMISPHERE, &hemisphere), TRL_OK);
    const size_t count = (size_t)PICTURE_SIDE * PICTURE_SIDE;
    float *other = malloc(count * 4 * sizeof *other);
    assert_non_null(other);
    for (size_t i = 0; i < SHOT_COUNT; i++) {
        if (SHOTS[i].place.altitude_m < 50) {
            continue; // there the hemisphere's own cells are larger than pixels
        }
        const struct camera camera = place_camera(&p, &SHOTS[i]);
        fixture_picture_draw(&p.picture, hemisphere, &camera);
        for (size_t k = 0; k < 4 * count; k++) {
            other[k] = p.picture.pixels[k];
        }
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        size_t differ = 0;
        for (size_t k = 0; k < count; k++) {
            const float *a = p.picture.pixels + 4 * k;
            const float *b = other + 4 * k;
            const bool has_a = a[3] > -1e8f, has_b = b[3] > -1e8f;
            const double distance = vec3_length(find_offset(&p, (int)k));
            // A pixel's width seen at a slant of 1/20.
            const double tolerance = 20 * distance * pixel_rad(&camera);
            const double apart =
                hypot(hypot((double)(a[0] - b[0]), (double)(a[1] - b[1])), (double)(a[2] - b[2]));
            differ += has_a != has_b || (has_a && apart > tolerance);
        }
        // Silhouettes: a pixel shows what is before or behind.
        assert_true(differ <= count / 100);
    }
    free(other);
    mesher_destroy(&hemisphere);
    destroy_planet(&p);
}

// From near to far the mesh gives way to an impostor where nobody sees it.
static void test_impostor_takes_over_unseen(void **state)
{
    struct planet p;
    make_default_planet(*state, &p);
    bool was_mesh = false;
    bool was_impostor = false;
    for (double radii = 1; radii < 150; radii *= 1.5) {
        const struct shot shot = {
            "far", {30, 30, 0, radii * R, 40, -89, 20 + 100 / (1 + radii)}, 30};
        const struct camera camera = place_camera(&p, &shot);
        assert_int_equal(check_holes(&p, &shot), 0);
        was_mesh = was_mesh || p.mesher->stats.triangles > 0;
        was_impostor = was_impostor || p.mesher->stats.triangles == 0;
        assert_true(!was_impostor || p.mesher->stats.triangles == 0);
        for (int k = 0; k < PICTURE_SIDE * PICTURE_SIDE; k++) {
            assert_true(!is_ground(&p, k) || fabs(find_error(&p, &camera, k)) < 0.3);
        }
    }
    assert_true(was_mesh && was_impostor);
    destroy_planet(&p);
}

static struct camera draw_from_afar(struct planet *p, double radii)
{
    const struct shot shot = {"far", {30, 30, 0, radii * R, 40, -89, 20 + 100 / (1 + radii)}, 30};
    const struct camera camera = place_camera(p, &shot);
    fixture_picture_draw(&p->picture, p->mesher, &camera);
    return camera;
}

// On both sides of the distance at which one takes over from the other.
static void test_mesh_and_impostor_are_the_same_where_they_change(void **state)
{
    enum { COUNT = PICTURE_SIDE * PICTURE_SIDE };
    static double before[COUNT];
    struct planet p;
    make_default_planet(*state, &p);
    double near = 1, far = 150;
    for (int i = 0; i < 24; i++) {
        const double middle = sqrt(near * far);
        draw_from_afar(&p, middle);
        *(p.mesher->stats.triangles > 0 ? &near : &far) = middle;
    }
    struct camera camera = draw_from_afar(&p, near);
    assert_true(p.mesher->stats.triangles > 0);
    for (int k = 0; k < COUNT; k++) {
        before[k] = is_ground(&p, k) ? find_error(&p, &camera, k) : (double)NAN;
    }
    camera = draw_from_afar(&p, far);
    assert_int_equal(p.mesher->stats.triangles, 0);
    double largest = 0;
    int ground = 0, limb = 0;
    for (int k = 0; k < COUNT; k++) {
        const bool was = !isnan(before[k]);
        limb += was != is_ground(&p, k);
        if (was && is_ground(&p, k)) {
            largest = fmax(largest, fabs(find_error(&p, &camera, k) - before[k]));
            ground++;
        }
    }
    print_message(
        "from mesh to impostor at %.1f radii: %.4f pixels at most, %d of %d at the limb\n", far,
        largest, limb, ground);
    assert_true(ground > 500);
    assert_true(largest < 0.1);
    // The mesh's chords lie within the arc, by what a pixel's middle hardly sees.
    assert_true(limb <= ground / 100);
    destroy_planet(&p);
}

// The ground must not swim: between two frames from places a tenth of a pixel apart, the mesh moves
// against the ground by less than that.
static void test_mesh_does_not_swim(void **state)
{
    struct planet p;
    make_default_planet(*state, &p);
    const size_t count = (size_t)PICTURE_SIDE * PICTURE_SIDE;
    double *before = malloc(count * sizeof *before);
    assert_non_null(before);
    for (size_t i = 0; i < SHOT_COUNT; i++) {
        struct camera camera = place_camera(&p, &SHOTS[i]);
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        for (size_t k = 0; k < count; k++) {
            before[k] = is_ground(&p, (int)k) ? find_error(&p, &camera, (int)k) : (double)NAN;
        }
        const double step = 0.1 * pixel_rad(&camera) * SHOTS[i].place.altitude_m;
        camera.position_m = vec3_add(camera.position_m, vec3_scale(camera.right, step));
        fixture_picture_draw(&p.picture, p.mesher, &camera);
        double sum = 0;
        int both = 0;
        for (size_t k = 0; k < count; k++) {
            if (is_ground(&p, (int)k) && !isnan(before[k])) {
                const double change = find_error(&p, &camera, (int)k) - before[k];
                sum += change * change;
                both++;
            }
        }
        const double rms = sqrt(sum / fmax(both, 1));
        print_message("%s: swims by %.4f pixels\n", SHOTS[i].name, rms);
        assert_true(rms < 0.05);
    }
    free(before);
    destroy_planet(&p);
}

static void test_grids_that_cannot_be_are_refused(void **state)
{
    struct planet p;
    make_default_planet(*state, &p);
    const trl_projective_desc bad[] = {{8, 64, 0}, {64, 8, 0}, {65, 64, 0}, {4096, 64, 0}};
    for (int i = 0; i < 4; i++) {
        struct mesher *mesher = p.mesher;
        p.f->last_error[0] = 0;
        assert_int_equal(projective_create(&p.surface, &bad[i], &mesher), TRL_ERROR_INVALID);
        assert_null(mesher);
        assert_non_null(strstr(p.f->last_error, "a grid of"));
    }
    destroy_planet(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mesh_lies_on_the_ground_within_a_fraction_of_a_pixel),
        cmocka_unit_test(test_skyline_is_that_of_a_ray_caster),
        cmocka_unit_test(test_islands_behind_the_horizon_are_not_missed),
        cmocka_unit_test(test_there_are_no_holes),
        cmocka_unit_test(test_every_grid_draws_the_same_ground),
        cmocka_unit_test(test_it_agrees_with_the_hemisphere),
        cmocka_unit_test(test_impostor_takes_over_unseen),
        cmocka_unit_test(test_mesh_and_impostor_are_the_same_where_they_change),
        cmocka_unit_test(test_mesh_does_not_swim),
        cmocka_unit_test(test_grids_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
