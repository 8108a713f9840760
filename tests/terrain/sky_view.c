// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Sky view factors of pixels among mountains against rays in double, and of shapes whose factor is
// known.
#include "planet.h"

#include "shared/sky_view.glsl"
#include "terrain/sky_view.h"

#include <stdio.h>

static const double DEGREE = 3.14159265358979323846 / 180;

enum { AZIMUTHS = 32, ELEVATIONS = 48, STEP = 16 };

static double level(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 0;
}

// Ranges of 3 km, 10 km apart, across one another, and valleys along the meridians.
static double ranges(double latitude, double longitude)
{
    const double x = (longitude - 30) / 0.7, y = (latitude - 40) / 0.55;
    return 2500 + 1500 * cos(2 * M_PI * x) + 700 * sin(2 * M_PI * (y + 0.4 * x)) +
           300 * sin(2 * M_PI * (2.3 * x - 1.9 * y));
}

// A valley of infinite length along the meridian: slopes of 30 degrees, 14 km wide.
static double valley(double latitude, double longitude)
{
    (void)latitude;
    const double across_m = fabs(longitude - 30) * DEGREE * PLANET_RADIUS_M * cos(40 * DEGREE);
    return tan(30 * DEGREE) * fmin(across_m, 7000);
}

struct scene {
    struct planet planet;
    struct terrain_shadow shadow;
    struct terrain_compose compose;
    struct terrain_sky_view view;
    struct picture picture;
    struct gpu_texture colors[4]; // see compose.h
    struct gpu_target target, view_target;
    float *normals; // of the picture
    uint8_t *light, *sky;
};

static void make_target(struct fixture *f, struct scene *s)
{
    static const enum gpu_format FORMATS[4] = {GPU_FORMAT_RGBA8, GPU_FORMAT_RGBA32F,
                                               GPU_FORMAT_RGBA8, GPU_FORMAT_RGBA8};
    struct gpu_target_desc all = {.color_count = 4};
    struct gpu_target_desc view = {.color_count = 2};
    for (int i = 0; i < 4; i++) {
        struct gpu_texture_desc desc = gpu_texture_desc_default();
        desc.width = desc.height = PICTURE_SIDE;
        desc.filter = GPU_FILTER_NEAREST;
        desc.format = FORMATS[i];
        assert_int_equal(gpu_texture_init(f->gpu, &desc, &s->colors[i]), TRL_OK);
        all.colors[i].texture = &s->colors[i];
    }
    view.colors[0].texture = &s->colors[2];
    view.colors[1].texture = &s->colors[3];
    assert_int_equal(gpu_target_init(f->gpu, &all, &s->target), TRL_OK);
    assert_int_equal(gpu_target_init(f->gpu, &view, &s->view_target), TRL_OK);
}

static void make_scene(struct fixture *f, planet_heights *heights, struct scene *s)
{
    planet_make(f, level, heights, &s->planet);
    assert_true(planet_use(&s->planet, TRL_MESHER_HEMISPHERE));
    const struct surface *surface = &s->planet.relief.surface;
    assert_int_equal(terrain_shadow_init(surface, 0.0047, &s->shadow), TRL_OK);
    assert_int_equal(terrain_compose_init(surface, &s->compose), TRL_OK);
    assert_int_equal(terrain_sky_view_init(&s->shadow, &s->view), TRL_OK);
    fixture_picture_init(f, &s->picture);
    make_target(f, s);
    const size_t pixels = (size_t)PICTURE_SIDE * PICTURE_SIDE;
    s->normals = mem_alloc(f->ctx, pixels, 4 * sizeof(float));
    s->light = mem_alloc(f->ctx, pixels, 4);
    s->sky = mem_alloc(f->ctx, pixels, 4);
    assert_true(s->normals && s->light && s->sky);
}

static void destroy_scene(struct fixture *f, struct scene *s)
{
    mem_free(f->ctx, s->normals);
    mem_free(f->ctx, s->light);
    mem_free(f->ctx, s->sky);
    gpu_target_finish(&s->target);
    gpu_target_finish(&s->view_target);
    for (int i = 0; i < 4; i++) {
        gpu_texture_finish(&s->colors[i]);
    }
    fixture_picture_finish(f, &s->picture);
    terrain_sky_view_finish(&s->view);
    terrain_compose_finish(&s->compose);
    terrain_shadow_finish(&s->shadow);
    planet_destroy(&s->planet);
}

static void draw_scene(struct scene *s, const struct camera *camera)
{
    const struct terrain_compose_inputs inputs = {
        .camera = camera, .position = &s->picture.position, .shadow = &s->shadow};
    const struct terrain_sky_view_inputs ground = {camera, &s->picture.position, &s->colors[1],
                                                   &s->colors[0]};
    fixture_picture_draw(&s->picture, s->planet.mesher, camera);
    assert_int_equal(terrain_shadow_update(&s->shadow, camera), TRL_OK);
    assert_int_equal(terrain_compose_draw(&s->compose, &inputs, &s->target), TRL_OK);
    assert_int_equal(terrain_sky_view_update(&s->view), TRL_OK);
    assert_int_equal(terrain_sky_view_draw(&s->view, &ground, &s->view_target), TRL_OK);
    const struct gpu_region all = gpu_texture_region(&s->colors[1], 0);
    assert_int_equal(gpu_texture_read(&s->colors[1], &all, s->normals), TRL_OK);
    assert_int_equal(gpu_texture_read(&s->colors[2], &all, s->light), TRL_OK);
    assert_int_equal(gpu_texture_read(&s->colors[3], &all, s->sky), TRL_OK);
}

// Of a place: the part of an even sky's light, and the mean of the star's on the ground it sees.
struct seen {
    double sky, light;
};

// Whether a ray from a metre above the ground meets ground again, and where.
static bool meet(const struct scene *s, struct vec3 ground, struct vec3 ray, struct vec3 *hit)
{
    const double altitude = surface_altitude(&s->planet.relief.surface, ground);
    const struct vec3 from = vec3_scale(vec3_normalize(ground), PLANET_RADIUS_M + altitude + 1);
    const struct reference_way way = {.from_m = from, .direction = ray, .length_m = 2e5};
    const double distance = reference_surface_meet(&s->planet.truth, PLANET_RADIUS_M, &way);
    *hit = vec3_add(from, vec3_scale(ray, distance));
    return distance >= 0;
}

static double star_light(const struct scene *s, struct vec3 ground, struct vec3 sun)
{
    struct reference_look look;
    struct vec3 hit;
    s->planet.truth.look(s->planet.truth.user, ground, &look);
    return meet(s, ground, sun, &hit) ? 0 : fmax(0, vec3_dot(look.normal, sun));
}

// By rays through the cells of a grid over the sphere.
static struct seen cast_rays(const struct scene *s, struct vec3 ground, struct vec3 normal,
                             struct vec3 sun)
{
    const struct vec3 up = vec3_normalize(ground);
    const struct vec3 east = vec3_normalize(vec3_cross((struct vec3){0, 0, 1}, up));
    const struct vec3 north = vec3_cross(up, east);
    double sky = 0, around = 1e-9, light = 0;
    for (int i = 0; i < AZIMUTHS * ELEVATIONS; i++) {
        const double azimuth = 2 * M_PI * (i % AZIMUTHS + 0.5) / AZIMUTHS;
        const double h = M_PI * (i / AZIMUTHS + 0.5) / ELEVATIONS - M_PI / 2;
        const struct vec3 flat =
            vec3_add(vec3_scale(east, cos(azimuth)), vec3_scale(north, sin(azimuth)));
        const struct vec3 ray = vec3_add(vec3_scale(flat, cos(h)), vec3_scale(up, sin(h)));
        const double share = vec3_dot(normal, ray) * cos(h);
        struct vec3 hit;
        if (share <= 0) {
            continue;
        }
        if (meet(s, ground, ray, &hit)) {
            around += share;
            light += share * star_light(s, hit, sun);
        } else if (h > 0) {
            sky += share;
        }
    }
    return (struct seen){sky * 2 * M_PI / ELEVATIONS / AZIMUTHS, light / around};
}

struct comparison {
    int count;
    double mean, rms, worst, least; // differences of the sky, but `least`
    double light, light_rms;        // of the light around
};

static struct comparison compare(const struct scene *s, const struct camera *camera)
{
    struct comparison c = {.least = 1};
    for (int i = 0; i < PICTURE_SIDE * PICTURE_SIDE; i++) {
        const float *p = s->picture.pixels + 4 * i, *n = s->normals + 4 * i;
        if (i % STEP != STEP / 2 || i / PICTURE_SIDE % STEP != STEP / 2 || p[3] < -1e8f) {
            continue;
        }
        const struct vec3 at = {(double)p[0], (double)p[1], (double)p[2]};
        const struct vec3 normal = {(double)n[0], (double)n[1], (double)n[2]};
        const struct seen truth =
            cast_rays(s, vec3_add(camera->position_m, at), normal, camera->sun_direction);
        const double off = s->sky[4 * i + 3] / 255.0 - truth.sky;
        // What comes from there.
        const double light = (1 - truth.sky) * (pow(s->light[4 * i + 3] / 255.0, 2) - truth.light);
        c.count++;
        c.mean += off;
        c.rms += off * off;
        c.worst = fmax(c.worst, fabs(off));
        c.least = fmin(c.least, truth.sky);
        c.light += light;
        c.light_rms += light * light;
    }
    assert_true(c.count > 20);
    c.mean /= c.count;
    c.light /= c.count;
    c.rms = sqrt(c.rms / c.count);
    c.light_rms = sqrt(c.light_rms / c.count);
    return c;
}

static void check_view(struct scene *s, const char *name, double height_m, double pitch)
{
    const struct camera_place place = {
        .latitude = 39.8, .longitude = 30.06, .pitch = pitch, .heading = 20, .fov = 60};
    struct camera camera = planet_camera(&s->planet, place, height_m);
    // 25 degrees high in the east.
    const struct vec3 up = vec3_normalize(camera.position_m);
    const struct vec3 east = vec3_normalize(vec3_cross((struct vec3){0, 0, 1}, up));
    camera.sun_direction =
        vec3_add(vec3_scale(up, sin(25 * DEGREE)), vec3_scale(east, cos(25 * DEGREE)));
    draw_scene(s, &camera);
    const struct comparison c = compare(s, &camera);
    printf("%s: %d pixels, down to %.2f: off by %+.3f, rms %.3f, at most %.3f; light %+.3f, rms "
           "%.3f\n",
           name, c.count, c.least, c.mean, c.rms, c.worst, c.light, c.light_rms);
    assert_true(c.least < 0.85);
    // Eight azimuths, among slopes that bend within a cell of the map. Found: 0.011, 0.016.
    assert_true(fabs(c.mean) < 0.015);
    assert_true(c.rms < 0.025);
    // Of ground at its brightest. Found: 0.021, 0.036 beside the camera, where texels end.
    assert_true(fabs(c.light) < 0.03);
    assert_true(c.light_rms < 0.05);
}

static void ranges_hide_what_rays_say(void **state)
{
    struct scene s;
    make_scene(*state, ranges, &s);
    check_view(&s, "20 km", 20000, -40);
    check_view(&s, "3 km", 3000, -15);
    check_view(&s, "100 m", 100, -4);
    destroy_scene(*state, &s);
}

// At the foot of a valley without end between slopes S, tan(h) = tan(S) |sin(phi)|, and V = cos(S).
static void a_valley_has_the_cosine_of_its_slopes(void **state)
{
    struct scene s;
    make_scene(*state, valley, &s);
    const struct camera_place place = {.latitude = 40, .longitude = 30, .pitch = -90, .fov = 20};
    const struct camera camera = planet_camera(&s.planet, place, 5000);
    draw_scene(&s, &camera);
    const size_t middle = (size_t)PICTURE_SIDE / 2 * PICTURE_SIDE + PICTURE_SIDE / 2;
    // Slopes end at 7 km, and the foot is rounded over a texel of 350 m: 0.02 more.
    assert_close(s.sky[4 * middle + 3] / 255.0, cos(30 * DEGREE), 0.03);
    destroy_scene(*state, &s);
}

// Without terrain nothing is hidden but by the ground's own slope.
static void level_ground_sees_all_of_the_sky(void **state)
{
    struct scene s;
    make_scene(*state, level, &s);
    const struct camera_place place = {.latitude = 40, .longitude = 30, .pitch = -30, .fov = 60};
    const struct camera camera = planet_camera(&s.planet, place, 5000);
    draw_scene(&s, &camera);
    for (int i = 0; i < PICTURE_SIDE * PICTURE_SIDE; i++) {
        const bool is_ground = s.picture.pixels[4 * i + 3] > -1e8f;
        // The sun is at the zenith of the camera's place.
        assert_true(!is_ground || (s.light[4 * i + 3] >= 253 && s.sky[4 * i + 3] >= 254));
    }
    destroy_scene(*state, &s);
}

static double sum_azimuths(double slope, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        sum += sky_view_azimuth(cos(slope), sin(slope) * cos(2 * M_PI * (i + 0.3) / count), 0);
    }
    return sum / count;
}

// Closed forms of the formula itself.
static void a_slope_alone_sees_half_and_half_its_cosine(void **state)
{
    (void)state;
    for (int degrees = 0; degrees <= 90; degrees += 5) {
        const double slope = degrees * DEGREE;
        assert_close(sum_azimuths(slope, 720), 0.5 + 0.5 * cos(slope), 1e-4);
        // What eight azimuths make of it.
        assert_close(sum_azimuths(slope, 8), 0.5 + 0.5 * cos(slope), 0.01);
    }
    for (int degrees = 1; degrees < 90; degrees += 4) {
        const double h = degrees * DEGREE;
        // A crater's rim at one height all around.
        assert_close(sky_view_azimuth(1, 0, sin(h)), cos(h) * cos(h), 1e-12);
        assert_close(sky_view_tilted(cos(h)), h - sin(h) * cos(h), 1e-4);
    }
    // In a white enclosure all light leaves in the end, black ground sends nothing twice.
    assert_close(0.3 * sky_view_again(0.3, 1), 1, 1e-12);
    assert_close(sky_view_again(0.3, 0), 1, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slope_alone_sees_half_and_half_its_cosine),
        cmocka_unit_test(level_ground_sees_all_of_the_sky),
        cmocka_unit_test(a_valley_has_the_cosine_of_its_slopes),
        cmocka_unit_test(ranges_hide_what_rays_say),
    };
    return cmocka_run_group_tests_name("sky view", tests, fixture_set_up, fixture_tear_down);
}
