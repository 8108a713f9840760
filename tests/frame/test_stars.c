// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Stars in pictures: their light, place and colour, and what takes them away.
#include "fixture.h"
#include "scene/scene.h"
#include "sky/airglow.h"
#include "sky/catalogue.h"
#include "spectrum/starlight.h"
#include <terrella/terrella.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double PI = 3.14159265358979323846;
enum { SIDE = 192 };
static const double DARK_LX = 1e-15; // maps of the sky end at 1e-20 cd m^-2

// Of all tests: right ascension and declination in degrees, magnitude, B-V; far from each other.
static const double STARS[][4] = {
    {80, 10, 0, 0.65},    {120, 40, 3, -0.2},
    {160, -40, 6.5, 2.1}, {0, 0, 1, 0},
    {101.3, -16.7, 0, 0}, {279.2, 38.8, 0, 0},
    {37.9, 89.2, 0, 0},   {247.4, -26.4, 0, 0},
    {10, 75, 0, 0},       {317.681, 52.887, 0, 0},
    {200, -10, 4, 0.65},  {220, -10, 4, -0.2},
    {240, -10, 4, 1.5},   {60, -60, 7.5, 0} /* beyond the limit */,
};
enum { STAR_COUNT = sizeof STARS / sizeof *STARS };

struct setup {
    struct fixture *f;
    char folder[64], path[96];
    trl_scene *scene;
    trl_renderer *renderer;
};

static void write_catalogue(const struct setup *s, const char *lines)
{
    FILE *file = fopen(s->path, "w");
    assert_non_null(file);
    fputs(lines, file);
    assert_int_equal(fclose(file), 0);
}

// A dark planet whose air absorbs `per_m` up to 10 km, with a body as wide as 20 degrees.
static trl_result make_renderer(struct setup *s, double per_m)
{
    char text[2048];
    snprintf(text, sizeof text,
             "{\"terrella\": 1, \"name\": \"dark\", \"star\": {\"spectral_irradiance\": 1},"
             " \"planet\": {\"radius_m\": 1e6, \"ground_albedo\": 0},"
             " \"atmosphere\": {\"height_m\": 1e4, \"constituents\": ["
             "   {\"absorption_per_m\": [[500, %g], [510, %g]], \"profile\": \"uniform\"}]},"
             " \"stars\": {\"catalogue\": \"%s\", \"limit_magnitude\": 7},"
             " \"bodies\": [{\"name\": \"B\", \"radius_m\": 1.7364e6, \"distance_m\": 1.1e7,"
             "   \"geometric_albedo\": 0}]}",
             per_m, per_m * 0.5, s->path);
    assert_int_equal(
        trl_scene_parse(s->f->ctx, text, strlen(text), "dark", "/nonexistent", &s->scene), TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    return trl_renderer_create(s->f->ctx, &desc, &s->renderer);
}

static void write_stars(const struct setup *s)
{
    char lines[2048] = "";
    for (size_t i = 0; i < STAR_COUNT; i++) {
        const double *star = STARS[i];
        snprintf(lines + strlen(lines), sizeof lines - strlen(lines), "%g,%g,%g,%g\n", star[0],
                 star[1], star[2], star[3]);
    }
    write_catalogue(s, lines);
}

// Another air.
static void make_sky(struct setup *s, double per_m)
{
    trl_renderer_destroy(&s->renderer);
    trl_scene_destroy(&s->scene);
    write_stars(s);
    const trl_result result = make_renderer(s, per_m);
    fixture_skip_without_gl(s->f, result);
    assert_int_equal(result, TRL_OK);
}

static int set_up(void **state)
{
    void *f = NULL;
    struct setup *s = calloc(1, sizeof *s);
    *state = s;
    if (!s || fixture_set_up(&f)) {
        return 1;
    }
    s->f = f;
    strcpy(s->folder, "/tmp/trl-stars-XXXXXX");
    if (!mkdtemp(s->folder)) {
        return 1;
    }
    snprintf(s->path, sizeof s->path, "%s/stars.csv", s->folder);
    make_sky(s, 0);
    return 0;
}

static int tear_down(void **state)
{
    struct setup *s = *state;
    trl_renderer_destroy(&s->renderer);
    trl_scene_destroy(&s->scene);
    unlink(s->path);
    rmdir(s->folder);
    void *f = s->f;
    free(s);
    return fixture_tear_down(&f);
}

// Looking straight up from the equator at the place of a star, by night.
static trl_view view_of_star(int star, double fov_deg)
{
    trl_view view = trl_view_default();
    view.altitude_m = 1;
    view.latitude_rad = STARS[star][1] * PI / 180;
    view.sidereal_rad = STARS[star][0] * PI / 180;
    view.pitch_rad = PI / 2;
    view.vertical_fov_rad = fov_deg * PI / 180;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = -PI / 2;
    return view;
}

// From the equator and the meridian, by night, facing a point of the sky.
static trl_view view_toward(double azimuth_deg, double elevation_deg, double fov_deg)
{
    trl_view view = trl_view_default();
    view.altitude_m = 1;
    view.heading_rad = azimuth_deg * PI / 180;
    view.pitch_rad = elevation_deg * PI / 180;
    view.vertical_fov_rad = fov_deg * PI / 180;
    view.sun_longitude_or_azimuth_rad = PI;
    return view;
}

struct size {
    uint32_t width, height;
};

// What comes in through a picture, lx in linear sRGB, and where its middle is, in pixels from the
// upper left corner.
struct found {
    double rgb[3], lx;
    double x, y;
};

static struct found draw(const struct setup *s, const trl_view *view, struct size size)
{
    static float rgba[4 * 2 * SIDE * SIDE];
    assert_true(size.width * size.height <= 2 * SIDE * SIDE);
    assert_int_equal(trl_renderer_draw(s->renderer, view, size.width, size.height, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(s->renderer, rgba), TRL_OK);
    const double half = tan(0.5 * view->vertical_fov_rad);
    struct found found = {{0, 0, 0}, 0, 0, 0};
    for (uint32_t i = 0; i < size.width * size.height; i++) {
        const double px = i % size.width + 0.5, py = i / size.width + 0.5;
        const double x = half * (2 * px - size.width) / size.height;
        const double y = half * (2 * py / size.height - 1);
        const double solid_angle = pow(2 * half / size.height, 2) / pow(1 + x * x + y * y, 1.5);
        const float *p = rgba + 4 * (size_t)i;
        const double lx =
            solid_angle * (0.2126 * (double)p[0] + 0.7152 * (double)p[1] + 0.0722 * (double)p[2]);
        for (int c = 0; c < 3; c++) {
            found.rgb[c] += solid_angle * (double)p[c];
        }
        found.lx += lx;
        found.x += lx * px;
        found.y += lx * py;
    }
    found.x /= found.lx > 0 ? found.lx : 1;
    found.y /= found.lx > 0 ? found.lx : 1;
    return found;
}

// Magnitude 0 is 2.54e-6 lx. Pixels of the spread see the star's light under solid angles of their
// own, so a star off the axis is not exact: to a few 1e-4 here.
static void a_star_has_the_light_of_its_magnitude_in_any_picture(void **state)
{
    const struct setup *s = *state;
    const struct size sizes[] = {{48, 48}, {SIDE, SIDE}, {301, 117}, {97, 333}};
    for (int i = 0; i < 3; i++) {
        const double wanted_lx = 2.54e-6 * pow(10, -0.4 * STARS[i][2]);
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
            trl_view view = view_of_star(i, 20);
            view.pitch_rad -= 0.03;
            const struct found found = draw(s, &view, sizes[k]);
            assert_true(fabs(found.lx / wanted_lx - 1) < 1e-3);
        }
    }
}

// A flicker would be a change from frame to frame: the camera turns by fractions of a pixel.
static void a_star_keeps_its_light_between_pixels(void **state)
{
    const double pixel_deg = 10.0 / SIDE;
    for (int i = 0; i < 16; i++) {
        trl_view view = view_of_star(3, 10);
        view.pitch_rad -= pixel_deg * i / 8 * PI / 180;
        view.roll_rad = 0.3 * i;
        const struct found found = draw(*state, &view, (struct size){SIDE, SIDE});
        // Floats add up 150 pixels; solid angles differ by 1e-5.
        assert_true(fabs(found.lx / (2.54e-6 * pow(10, -0.4)) - 1) < 1e-4);
        // The middle of what is seen is where the star is.
        const double off = sqrt(pow(found.x - SIDE / 2.0, 2) + pow(found.y - SIDE / 2.0, 2));
        assert_true(fabs(off - i / 8.0) < 0.02);
    }
}

// By the hour angle: sin(elevation) = sin(phi) sin(delta) + cos(phi) cos(delta) cos(H), and the
// azimuth from north through east (Meeus, Astronomical Algorithms, Chapter 13).
static void stars_stand_where_astronomers_expect_them(void **state)
{
    const double places[][3] = {// star, sidereal time at longitude 0, longitude, degrees
                                {4, 75, 20},
                                {5, 260, -30},
                                {6, 300, 10},
                                {0, 130, 0},
                                {7, 200, 50}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const double *star = STARS[(int)places[i][0]];
        const double phi = 0.7, delta = star[1] * PI / 180;
        const double h = (places[i][1] + places[i][2] - star[0]) * PI / 180;
        const double elevation = asin(sin(phi) * sin(delta) + cos(phi) * cos(delta) * cos(h));
        const double azimuth = PI + atan2(sin(h), cos(h) * sin(phi) - tan(delta) * cos(phi));
        trl_view view = view_toward(azimuth * 180 / PI, elevation * 180 / PI, 1);
        view.latitude_rad = phi;
        view.longitude_rad = places[i][2] * PI / 180;
        view.sidereal_rad = places[i][1] * PI / 180;
        view.sun_mode = TRL_SUN_LOCAL;
        view.sun_latitude_or_elevation_rad = -1;
        const struct found found = draw(*state, &view, (struct size){64, 64});
        assert_true(fabs(found.x - 32) < 0.02 && fabs(found.y - 32) < 0.02);
    }
}

// Facing north, what is east of the meridian is at the right: the sky is not mirrored.
static void east_is_at_the_right_of_north(void **state)
{
    const trl_view view = view_toward(0, 15, 10);
    const struct found found = draw(*state, &view, (struct size){64, 64}); // H = -10 degrees
    assert_true(found.lx > 2e-6 && found.x > 33);
}

static void a_tilted_pole_turns_the_sky(void **state)
{
    struct setup *s = *state;
    write_stars(s);
    s->scene->stars.pole_right_ascension_rad = 317.681 * PI / 180; // Mars
    s->scene->stars.pole_declination_rad = 52.887 * PI / 180;
    trl_renderer_destroy(&s->renderer);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    assert_int_equal(trl_renderer_create(s->f->ctx, &desc, &s->renderer), TRL_OK);
    trl_view view = view_toward(0, 10, 4);
    view.latitude_rad = 10 * PI / 180; // the pole's height is the latitude
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = -1;
    for (int i = 0; i < 3; i++) {
        view.sidereal_rad = i;
        const struct found found = draw(s, &view, (struct size){64, 64});
        assert_true(fabs(found.x - 32) < 0.02 && fabs(found.y - 32) < 0.02);
    }
}

// Uniform air of 10 km takes exp(-k s), s the way to its top: sqrt((R mu)^2 + 2 R h + h^2) - R mu.
// Its coefficient is k below 500 nm and k / 2 above 510 nm, so colours of long waves lose half.
static void air_takes_light_by_the_way_through_it(void **state)
{
    struct setup *s = *state;
    const double per_m = 2e-5, eye_m = 1e6 + 1, top_m = 1.01e6;
    const double elevations_deg[] = {90, 30, 5, 1};
    const trl_view up = view_of_star(3, 4);
    const struct found clear = draw(s, &up, (struct size){64, 64});
    make_sky(s, per_m);
    for (size_t i = 0; i < 4; i++) {
        const double mu = sin(elevations_deg[i] * PI / 180);
        const double way_m =
            sqrt(pow(eye_m * mu, 2) + (top_m - eye_m) * (top_m + eye_m)) - eye_m * mu;
        trl_view view = view_toward(90, elevations_deg[i], 4);
        view.sidereal_rad = -(90 - elevations_deg[i]) * PI / 180; // in the east
        const struct found found = draw(s, &view, (struct size){64, 64});
        // Red primaries see nothing below 510 nm but a little of violet.
        assert_true(fabs(found.rgb[0] / clear.rgb[0] / exp(-0.5 * per_m * way_m) - 1) < 0.1);
        assert_true(found.rgb[2] / clear.rgb[2] < exp(-0.8 * per_m * way_m));
        assert_true(found.lx < clear.lx * exp(-0.5 * per_m * way_m) * 1.001);
        assert_true(found.lx > clear.lx * exp(-per_m * way_m));
    }
}

static void ground_and_bodies_hide_stars(void **state)
{
    const struct setup *s = *state;
    trl_view view = view_toward(90, 2, 20);
    view.sidereal_rad = -89 * PI / 180; // one degree up
    assert_true(draw(s, &view, (struct size){64, 64}).lx > 1e-6);
    view.sidereal_rad = -91 * PI / 180;
    assert_true(draw(s, &view, (struct size){64, 64}).lx < DARK_LX);
    view.sidereal_rad = -80 * PI / 180;
    view.bodies[0] = (trl_body_place){TRL_BODY_LOCAL, 19 * PI / 180, PI / 2, 0};
    assert_true(draw(s, &view, (struct size){64, 64}).lx < DARK_LX); // its radius is ten degrees
    view.bodies[0].latitude_or_elevation_rad = 21 * PI / 180;
    assert_true(draw(s, &view, (struct size){64, 64}).lx > 1e-6);
}

static void colours_follow_the_index(void **state)
{
    const int stars[] = {11, 10, 12};
    double before = 1e9;
    for (int i = 0; i < 3; i++) {
        const trl_view view = view_of_star(stars[i], 5);
        const struct found found = draw(*state, &view, (struct size){64, 64});
        const double blue_over_red = found.rgb[2] / found.rgb[0];
        assert_true(blue_over_red < 0.8 * before);
        before = blue_over_red;
    }
    // The Sun's index is that of its temperature, 5772 K; Vega's about 10 000 K.
    assert_true(fabs(starlight_temperature_K(0.65) - 5772) < 30);
    assert_true(fabs(starlight_temperature_K(0) - 10000) < 200);
}

static void limits_leave_faint_stars_out_of_pictures(void **state)
{
    const trl_view view = view_of_star(13, 5);
    assert_true(draw(*state, &view, (struct size){64, 64}).lx < DARK_LX);
}

static void limits_leave_faint_stars_out(void **state)
{
    const struct setup *s = *state;
    write_catalogue(s, "# comment\nra,dec,v,bv\n1,2,6.9,0\r\n\n1,2,7.1,0\n -3 , 4 ,7,0.5");
    struct catalogue catalogue;
    assert_int_equal(catalogue_load(s->f->ctx, s->path, 7, &catalogue), TRL_OK);
    assert_int_equal(catalogue.count, 2);
    assert_true(catalogue.stars[1].colour_index == 0.5);
    catalogue_finish(s->f->ctx, &catalogue);
}

static void faults_of_a_catalogue_are_told(void **state)
{
    struct setup *s = *state;
    const char *const bad[] = {"1,2,3\n",    "1,2,3,4,5\n", "1,2,x,4\n",
                               "1,91,3,0\n", "1,2,nan,0\n", "h\nh\n"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        write_catalogue(s, bad[i]);
        struct catalogue catalogue;
        fixture_expect_error(s->f, catalogue_load(s->f->ctx, s->path, 7, &catalogue),
                             TRL_ERROR_INVALID, TRL_LOG_ITEM_SCENE);
        assert_null(catalogue.stars);
    }
    unlink(s->path);
    trl_renderer_destroy(&s->renderer);
    trl_scene_destroy(&s->scene);
    const trl_result result = make_renderer(s, 0);
    fixture_skip_without_gl(s->f, result);
    fixture_expect_error(s->f, result, TRL_ERROR_IO, TRL_LOG_ITEM_FILE_READ);
    s->scene->stars.is_optional = true;
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    assert_int_equal(trl_renderer_create(s->f->ctx, &desc, &s->renderer), TRL_OK);
}

// Patat 2003, A&A 400, Table C.1: how much brighter the sky is 50 degrees from the zenith than
// there, in magnitudes of U, B, V; with the extinctions of Paranal (Table A.1) in magnitudes.
static void airglow_rises_toward_the_horizon_as_published(void **state)
{
    (void)state;
    const double extinction[3] = {0.43, 0.22, 0.11}, wanted[3] = {0.07, 0.18, 0.24};
    struct airglow airglow = {.share = 0.6, .layer = 0.96};
    for (int i = 0; i < 3; i++) {
        airglow.depth[i] = extinction[i] * log(10) / 2.5;
    }
    double rgb[3];
    airglow_at(&airglow, cos(50 * PI / 180), rgb);
    for (int i = 0; i < 3; i++) {
        assert_true(fabs(2.5 * log10(rgb[i]) - wanted[i]) < 0.01); // its digits, rounded
    }
}

// Without extinction.
static void pictures_show_airglow(void **state)
{
    struct setup *s = *state;
    make_sky(s, 0);
    s->scene->stars.background_cd_m2 = 1e-3;
    s->scene->stars.airglow_share = 0.6;
    trl_renderer_destroy(&s->renderer);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    assert_int_equal(trl_renderer_create(s->f->ctx, &desc, &s->renderer), TRL_OK);
    const double elevations_deg[] = {90, 40, 5};
    for (int i = 0; i < 3; i++) {
        trl_view view = view_toward(180, elevations_deg[i], 2);
        view.latitude_rad = -0.5; // no star there
        const struct found found = draw(s, &view, (struct size){16, 16});
        const double solid_angle = pow(2 * tan(PI / 180), 2);
        const double sine2 = 1 - pow(sin(elevations_deg[i] * PI / 180), 2);
        const double path = 1 / sqrt(1 - pow(1e6 / 1.13e6, 2) * sine2);
        const double wanted_cd_m2 = 1e-3 * (1 + 0.6 * (path - 1));
        assert_true(fabs(found.lx / solid_angle / wanted_cd_m2 - 1) < 0.01); // 2 degrees are seen
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_star_has_the_light_of_its_magnitude_in_any_picture),
        cmocka_unit_test(a_star_keeps_its_light_between_pixels),
        cmocka_unit_test(stars_stand_where_astronomers_expect_them),
        cmocka_unit_test(east_is_at_the_right_of_north),
        cmocka_unit_test(ground_and_bodies_hide_stars),
        cmocka_unit_test(colours_follow_the_index),
        cmocka_unit_test(limits_leave_faint_stars_out_of_pictures),
        cmocka_unit_test(limits_leave_faint_stars_out),
        cmocka_unit_test(airglow_rises_toward_the_horizon_as_published),
        // These make other skies.
        cmocka_unit_test(air_takes_light_by_the_way_through_it),
        cmocka_unit_test(a_tilted_pole_turns_the_sky),
        cmocka_unit_test(pictures_show_airglow),
        cmocka_unit_test(faults_of_a_catalogue_are_told),
    };
    return cmocka_run_group_tests_name("stars", tests, set_up, tear_down);
}
