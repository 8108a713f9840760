// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What the march of clouds must not leave in pictures, and what it must: grain, lattices, rings,
// holes; edges.
#include "drawer.h"

#include <math.h>
#include <stdlib.h>

// Mean difference of neighbours in a row, in green; pixels are means of `fine` x `fine` of these.
static double edges(const float *rgba, int fine)
{
    double sum = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double two[2] = {0};
        for (int k = 0; k < 2 * fine * fine && i % WIDTH > 0; k++) {
            const int x = (i % WIDTH - k % 2) * fine + k / 2 % fine;
            const int y = i / WIDTH * fine + k / 2 / fine;
            two[k % 2] += (double)rgba[4 * (y * WIDTH * fine + x) + 1] / (fine * fine);
        }
        sum += fabs(two[0] - two[1]) / (WIDTH * HEIGHT);
    }
    return sum;
}

// Clouds are marched at every second pixel and joined by fours, which blurs them.
static void clouds_are_about_as_sharp_as_of_finer_pixels(void **state)
{
    enum { FINE = 4 };
    struct fixture *f = *state;
    struct drawer d = make_drawer(f, LAYERS("{\"cover\": 0.5}"));
    trl_view view = look(3500, -10);
    view.vertical_fov_rad = 9 * DEGREE;
    float *coarse = draw(&d, &view);
    float *fine = draw_larger(&d, &view, FINE);
    const double sharpness = edges(coarse, 1) / edges(fine, FINE);
    print_message("differences of neighbours are %.3f of those of fine pixels\n", sharpness);
    assert_true(sharpness > 0.56 && sharpness < 1); // 0.53 without what join.frag sharpens
    free(coarse);
    free(fine);
    finish_drawer(&d);
}

// Each ray of a lattice of two by two is apart from its neighbours: by how much the most, of what
// the least is.
static double lattice(const float *rgba, int width, int height)
{
    double squares[4] = {0};
    for (int y = 2; y < height - 2; y += 2) {
        for (int x = 2; x < width - 2; x += 2) {
            const float *at = &rgba[4 * (y * width + x) + 1]; // green
            const double apart =
                (double)at[0] - 0.25 * (double)(at[8] + at[-8] + at[8 * width] + at[-8 * width]);
            squares[y % 4 + x % 4 / 2] += apart * apart;
        }
    }
    const double low = fmin(fmin(squares[0], squares[1]), fmin(squares[2], squares[3]));
    const double high = fmax(fmax(squares[0], squares[1]), fmax(squares[2], squares[3]));
    return sqrt(high / low);
}

// From so high that no mean of rays is taken, each ray must stand for itself.
static void a_deck_from_afar_has_no_lattice(void **state)
{
    enum { SIDES = 4 };
    struct fixture *f = *state;
    struct drawer d = make_drawer(f, LAYERS("{\"cover\": 0.01, \"scale_m\": 5000},"
                                            "{\"type\": \"stratus\", \"cover\": 0.9,"
                                            " \"base_m\": 3600, \"top_m\": 14000,"
                                            " \"extinction_per_m\": 0.01, \"scale_m\": 40000}"));
    const trl_view view = look(600e3, -90);
    float *rgba = draw_larger(&d, &view, SIDES);
    const double seen = lattice(rgba, WIDTH * SIDES, HEIGHT * SIDES);
    print_message("a lattice of %.5f\n", seen);
    assert_true(seen < 1.15); // 1.29 with spread levels
    free(rgba);
    finish_drawer(&d);
}

// How far the mean green of some rows is from that of four pixels beside it, of the mean.
static double rings(const float *rows, int width, int row_count)
{
    double square = 0;
    double all = 0;
    for (int x = width / 2 - 30; x < width / 2 + 30; x++) {
        double apart = 0;
        for (int y = 0; y < row_count; y++) {
            const float *at = &rows[4 * (y * width + x) + 1];
            apart += (double)at[0] - 0.5 * (double)(at[-16] + at[16]);
            all += (double)at[0];
        }
        square += apart * apart;
    }
    return sqrt(square * 60) / all;
}

// The air's share that a deck leaves is summed in steps, of which one must not begin at other
// depths in rays side by side.
static void a_closed_deck_from_space_has_no_rings(void **state)
{
    enum { SIDES = 4, ACROSS = WIDTH * SIDES, DOWN = HEIGHT * SIDES };
    struct fixture *f = *state;
    struct drawer d = make_drawer(f, LAYERS("{\"type\": \"stratus\", \"cover\": 1,"
                                            " \"base_m\": 4000, \"top_m\": 8000}"));
    const trl_view view = look(12000e3, -90);
    float *rgba = draw_larger(&d, &view, SIDES);
    const float *middle = rgba + (ptrdiff_t)(4 * ACROSS * (DOWN / 2 - 4));
    const double seen = rings(middle, ACROSS, 8);
    print_message("rings of %.5f\n", seen);
    assert_true(seen < 0.005); // 0.009 with steps from the eye
    free(rgba);
    finish_drawer(&d);
}

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

// How far a pixel is from the mean of the four beside it, of their mean, in the median: edges are
// few.
static double grain(const float *rgba, int width, int height)
{
    float *apart = malloc((size_t)(width * height) * sizeof *apart);
    assert_non_null(apart);
    int count = 0;
    for (int y = 1; y < height - 1; y++) {
        for (int x = 1; x < width - 1; x++) {
            const float *at = &rgba[4 * (y * width + x) + 1];
            const float mean = 0.25f * (at[4] + at[-4] + at[4 * width] + at[-4 * width]);
            apart[count++] = fabsf(at[0] - mean) / mean;
        }
    }
    qsort(apart, (size_t)count, sizeof *apart, compare);
    const double median = (double)apart[count / 2];
    free(apart);
    return median;
}

// From within a layer noise is not resolved: what differs from pixel to pixel comes from the march.
static void near_clouds_have_no_grain(void **state)
{
    enum { SIDES = 6 };
    struct fixture *f = *state;
    struct drawer d = make_drawer(f, LAYERS("{\"cover\": 0.8}"));
    for (int i = 0; i < 2; i++) {
        const trl_view view = look(1000, i > 0 ? 70 : 40);
        float *rgba = draw_larger(&d, &view, SIDES);
        const double seen = grain(rgba, WIDTH * SIDES, HEIGHT * SIDES);
        print_message("grain of %.5f\n", seen);
        assert_true(seen < 0.002); // 0.003 with steps of a texel
        free(rgba);
    }
    finish_drawer(&d);
}

// Steps that are long beside pixels meet heads of clouds, or miss them, from row to row.
static void far_clouds_in_a_narrow_view_have_no_grain(void **state)
{
    enum { SIDES = 6 };
    struct fixture *f = *state;
    struct drawer d = make_drawer(f, LAYERS("{\"cover\": 0.5}"));
    trl_view view = look(6000, -9);
    view.vertical_fov_rad = 6 * DEGREE;
    float *rgba = draw_larger(&d, &view, SIDES);
    const double seen = grain(rgba, WIDTH * SIDES, HEIGHT * SIDES);
    print_message("grain of %.5f\n", seen);
    assert_true(seen < 0.008); // 0.0092 with steps of a third of a slice in sixteen
    free(rgba);
    finish_drawer(&d);
}

// Where rays graze layers, places are far from the lines that they are looked for on.
static void light_on_far_clouds_is_finite(void **state)
{
    enum { SIDES = 16 };
    struct fixture *f = *state;
    struct drawer d =
        make_drawer(f, LAYERS("{\"cover\": 0.6}, {\"type\": \"cirrus\", \"cover\": 0.4}"));
    trl_view view = look(4000, -5);
    view.sun_latitude_or_elevation_rad = 3 * DEGREE;
    float *rgba = draw_larger(&d, &view, SIDES);
    for (int i = 0; i < FLOATS * SIDES * SIDES; i++) {
        assert_true(isfinite(rgba[i]));
    }
    free(rgba);
    finish_drawer(&d);
}

// Of deep clouds nothing comes through, not even what is to be a part of it.
static void sea_under_deep_clouds_is_finite(void **state)
{
    struct fixture *f = *state;
    struct drawer d =
        make_drawer(f, ", \"surface\": {\"noise\": {\"ocean_share\": 0.99}}, \"ocean\": {}" LAYERS(
                           "{\"type\": \"stratus\", \"cover\": 0.9, \"extinction_per_m\": 0.5}"));
    trl_view view = look(200, -20);
    view.sun_latitude_or_elevation_rad = 3 * DEGREE;
    float *rgba = draw(&d, &view);
    for (int i = 0; i < FLOATS; i++) {
        assert_true(isfinite(rgba[i]));
    }
    free(rgba);
    finish_drawer(&d);
}

static const char deep_scene[] =
    "{\"terrella\": 1, \"name\": \"deep\","
    " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.27},"
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.1},"
    " \"atmosphere\": {\"height_m\": 120000, \"constituents\": [{\"name\": \"air\","
    "  \"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 3e-3,"
    "   \"exponent\": -0.5}}, \"profile\": {\"exponential\": {\"scale_height_m\": 10000}},"
    "  \"phase\": \"rayleigh\"}]}" LAYERS(
        "{\"type\": \"stratus\", \"cover\": 1, \"base_m\": 57000, \"top_m\": 72000,"
        " \"extinction_per_m\": 0.001, \"scale_m\": 250000}") "}";

// Before its clouds, air that hides the ground is as deep along rays beside the planet as along
// those that would meet it.
static void a_deck_in_deep_air_has_no_dark_limb(void **state)
{
    enum { SIDES = 2 };
    struct fixture *f = *state;
    struct drawer d = make_scene_drawer(f, deep_scene);
    trl_view view = look(12000e3, -69.75);
    view.vertical_fov_rad = 1.1 * DEGREE;
    float *rgba = draw_larger(&d, &view, SIDES);
    double brightest = 0;
    double dip = 0; // below what is farther out
    for (int y = 0; y < HEIGHT * SIDES; y++) {
        double row = 0;
        for (int x = 0; x < WIDTH * SIDES; x++) {
            row += (double)rgba[4 * (y * WIDTH * SIDES + x) + 1];
        }
        brightest = fmax(brightest, row);
        dip = fmax(dip, (brightest - row) / fmax(brightest, 1e-9));
    }
    print_message("a dip of %.4f\n", dip);
    assert_true(brightest > 0);
    assert_true(dip < 0.15); // 0.2 where depths are those of thin air; traced: none
    free(rgba);
    finish_drawer(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clouds_are_about_as_sharp_as_of_finer_pixels),
        cmocka_unit_test(near_clouds_have_no_grain),
        cmocka_unit_test(far_clouds_in_a_narrow_view_have_no_grain),
        cmocka_unit_test(a_deck_from_afar_has_no_lattice),
        cmocka_unit_test(a_closed_deck_from_space_has_no_rings),
        cmocka_unit_test(light_on_far_clouds_is_finite),
        cmocka_unit_test(sea_under_deep_clouds_is_finite),
        cmocka_unit_test(a_deck_in_deep_air_has_no_dark_limb),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
