// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What the program puts on sheets: letters, areas, maps of differences.
#include "cli/canvas.h"
#include "cli/difference.h"
#include "cli/font.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

static uint64_t letter_dots(char sign)
{
    uint64_t dots = 0;
    for (int y = 0; y < FONT_HEIGHT; y++) {
        for (int x = 0; x < FONT_WIDTH; x++) {
            dots = 2 * dots + font_has_dot(sign, x, y);
        }
    }
    return dots;
}

static void every_sign_looks_different(void **state)
{
    (void)state;
    assert_true(letter_dots(' ') == 0);
    for (int a = '!'; a <= '~'; a++) {
        for (int b = ' '; b < a; b++) {
            assert_true(letter_dots((char)a) != letter_dots((char)b));
        }
    }
    assert_true(letter_dots('\n') == letter_dots('?'));
}

static const struct canvas_color WHITE = {255, 255, 255};
static const struct canvas_color RED = {255, 0, 0};

static int count_red(const struct canvas *canvas)
{
    int count = 0;
    for (int i = 0; i < canvas->width * canvas->height; i++) {
        count += canvas->rgba[4 * i + 1] == 0;
    }
    return count;
}

static void what_does_not_fit_is_cut_off(void **state)
{
    (void)state;
    struct canvas canvas;
    assert_true(canvas_init(10, 8, WHITE, &canvas));
    canvas_fill(&canvas, (struct canvas_rect){-5, 6, 8, 100}, RED);
    assert_int_equal(count_red(&canvas), 3 * 2);
    const uint8_t picture[4 * 4] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0};
    canvas_put(&canvas, (struct canvas_rect){9, -1, 2, 2}, picture);
    assert_int_equal(count_red(&canvas), 3 * 2 + 1);
    assert_int_equal(canvas.rgba[4 * 9 + 3], 255);
    canvas_put(&canvas, (struct canvas_rect){40, 0, 2, 2}, picture);
    assert_int_equal(count_red(&canvas), 3 * 2 + 1);
    canvas_finish(&canvas);
}

static void words_take_their_width(void **state)
{
    (void)state;
    const struct canvas_text text = {2, RED, "||"};
    assert_int_equal(canvas_text_width(&text), 22);
    struct canvas canvas;
    assert_true(canvas_init(30, 20, WHITE, &canvas));
    canvas_write(&canvas, (struct canvas_rect){1, 1, 22, 16}, &text);
    assert_int_equal(count_red(&canvas), 2 * 7 * 4);
    // A letter that does not fit whole is left out.
    canvas_fill(&canvas, (struct canvas_rect){0, 0, 30, 20}, WHITE);
    canvas_write(&canvas, (struct canvas_rect){1, 1, 21, 16}, &text);
    assert_int_equal(count_red(&canvas), 7 * 4);
    canvas_finish(&canvas);
}

enum { PIXELS = 200 };

// Grey light, brighter from pixel to pixel, the first half black.
static void fill_shot(struct shot *shot, float factor, uint8_t code)
{
    static float radiance[2][4 * PIXELS];
    static uint8_t picture[2][4 * PIXELS];
    static int used;
    *shot = (struct shot){.width = PIXELS,
                          .height = 1,
                          .radiance = radiance[used % 2],
                          .picture = picture[used % 2],
                          .ev100 = log2(1000 / 1.2)}; // 1000 cd m^-2 is white
    used++;
    for (int i = 0; i < PIXELS; i++) {
        for (int c = 0; c < 4; c++) {
            shot->radiance[4 * i + c] = i < PIXELS / 2 ? 0 : factor * (float)i;
            shot->picture[4 * i + c] = code;
        }
    }
}

static void a_picture_does_not_differ_from_itself(void **state)
{
    (void)state;
    struct shot shot;
    fill_shot(&shot, 1, 90);
    struct difference d;
    assert_true(difference_make(&shot, &shot, &d));
    assert_true(d.mean == 0 && d.mean_size == 0 && d.largest_size == 0 && d.mean_delta_e == 0);
    const double range = difference_choose_range(&d, 1);
    uint8_t map[4 * PIXELS];
    difference_draw(&d, range, map);
    const struct canvas_color neutral = difference_color(0, 1);
    const struct canvas_color dark = difference_color((double)NAN, 1);
    assert_int_equal(map[0], dark.red);
    for (int i = PIXELS / 2; i < PIXELS; i++) {
        assert_memory_equal(map + 4 * i, &neutral, 3);
    }
    difference_finish(&d);
}

static void a_tenth_brighter_is_a_tenth(void **state)
{
    (void)state;
    struct shot base;
    struct shot other;
    fill_shot(&base, 1, 0);
    fill_shot(&other, 1.1f, 255);
    struct difference d;
    assert_true(difference_make(&base, &other, &d));
    // Floats have seven digits.
    assert_true(fabs(d.mean - 0.1) < 1e-6);
    assert_true(fabs(d.mean_size - 0.1) < 1e-6);
    assert_true(fabs(d.largest_size - 0.1) < 1e-6);
    assert_true(isnan(d.share[0]));
    // From black to white is 100 in lightness, and has no hue but for rounded primaries.
    assert_true(fabs(d.mean_delta_e - 100) < 0.05);
    assert_true(difference_choose_range(&d, 1) == 0.2); // 0.1 as a float is a little more
    difference_finish(&d);
}

static void maps_go_from_blue_over_white_to_red(void **state)
{
    (void)state;
    const struct canvas_color low = difference_color(-3, 1);
    const struct canvas_color middle = difference_color(0, 1);
    const struct canvas_color high = difference_color(3, 1);
    assert_true(low.blue > low.red + 50);
    assert_true(high.red > high.blue + 50);
    assert_true(middle.red > 240 && middle.green > 240 && middle.blue > 240);
    const struct canvas_color end = difference_color(-1, 1);
    assert_memory_equal(&low, &end, sizeof end);
    // What is out of the ordinary is darker at both ends.
    for (int k = 0; k < 20; k++) {
        assert_true(difference_color(0.05 * k, 1).green >
                    difference_color(0.05 * (k + 1), 1).green);
        assert_true(difference_color(-0.05 * k, 1).red > difference_color(-0.05 * (k + 1), 1).red);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_sign_looks_different),
        cmocka_unit_test(what_does_not_fit_is_cut_off),
        cmocka_unit_test(words_take_their_width),
        cmocka_unit_test(a_picture_does_not_differ_from_itself),
        cmocka_unit_test(a_tenth_brighter_is_a_tenth),
        cmocka_unit_test(maps_go_from_blue_over_white_to_red),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
