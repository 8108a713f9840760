// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Gaps of rasters that are held in tiles: no cliff, no seam between tiles, what is around them and
// in them as of rasters held whole.
#include "fixture.h"
#include "terrain/look.h"
#include "terrain/surface.h"

#include <math.h>
#include <stdio.h>

// Of the inset, texels: a hole around where four tiles meet, and a slit of one texel.
enum { WIDTH = 2100, HEIGHT = 600, HOLE_X = 1024, HOLE_Y = 256, HOLE_RADIUS = 100, SLIT_X = 700 };
static const double TEXEL_DEG = 0.01, WEST_DEG = -10, NORTH_DEG = 3;

static bool is_hole(int x, int y)
{
    return hypot(x - HOLE_X, y - HOLE_Y) < HOLE_RADIUS || (x == SLIT_X && y > 200 && y < 400);
}

// Steep hills of some texels on a slope.
static double hills(int x, int y)
{
    return is_hole(x, y) ? (double)NAN
                         : 3000 + 2 * x + 400 * sin(x / 3.0) * cos(y / 4.0) + 300 * sin(y / 40.0);
}

static double plain(int x, int y)
{
    (void)x;
    (void)y;
    return 1000;
}

static double brightness(int x, int y)
{
    return is_hole(x, y) ? 0 : 150 + 50 * sin(x / 50.0) * cos(y / 60.0);
}

static const struct recipe GROUND = {.name = "ground.tif",
                                     .width = 72,
                                     .height = 36,
                                     .bands = 1,
                                     .type = GDT_Int16,
                                     .transform = {-180, 5, 0, 90, 0, -5},
                                     .system = "EPSG:4326",
                                     .value = plain};

static struct recipe inset_of(double (*value)(int x, int y))
{
    return (struct recipe){.name = "inset.tif",
                           .width = WIDTH,
                           .height = HEIGHT,
                           .bands = value == hills ? 1 : 3,
                           .type = value == hills ? GDT_Float32 : GDT_Byte,
                           .transform = {WEST_DEG, TEXEL_DEG, 0, NORTH_DEG, 0, -TEXEL_DEG},
                           .system = "EPSG:4326",
                           .has_nodata = value != hills,
                           .nodata = 0,
                           .value = value};
}

struct both {
    char ground[256], inset[256];
    struct surface whole, tiled;
};

// The inset fades over `feather` texels.
static void make_both(struct fixture *f, const struct recipe *inset, double feather,
                      struct both *out)
{
    snprintf(out->ground, sizeof out->ground, "%s", make_file(f, &GROUND));
    snprintf(out->inset, sizeof out->inset, "%s", make_file(f, inset));
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = out->ground, .scale = 1},
        {.kind = inset->bands == 1 ? SURFACE_ELEVATION : SURFACE_COLOUR,
         .path = out->inset,
         .scale = 1,
         .feather_rad = feather * TEXEL_DEG * RADIAN}};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = 6371000;
    desc.layers = layers;
    desc.layer_count = 2;
    desc.is_strict = true;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &out->whole), TRL_OK);
    desc.max_bytes = 1;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &out->tiled), TRL_OK);
    assert_non_null(out->tiled.stream);
}

static void finish_both(struct both *both)
{
    surface_finish(&both->whole);
    surface_finish(&both->tiled);
}

static struct vec3 place(double x, double y)
{
    return vec3_from_lat_lon((NORTH_DEG - (y + 0.5) * TEXEL_DEG) * RADIAN,
                             (WEST_DEG + (x + 0.5) * TEXEL_DEG) * RADIAN);
}

// The largest step from a texel to the next along lines through the hole, of what is drawn.
static double largest_step(const struct surface *s, bool is_along_rows)
{
    double largest = 0;
    for (int line = -90; line <= 90; line += 15) {
        double before = NAN;
        for (int i = -HOLE_RADIUS - 10; i <= HOLE_RADIUS + 10; i++) {
            const double now =
                surface_altitude(s, is_along_rows ? place(HOLE_X + i, HOLE_Y + line)
                                                  : place(HOLE_X + line, HOLE_Y + i));
            largest = fmax(largest, isnan(before) ? 0 : fabs(now - before));
            before = now;
        }
    }
    return largest;
}

static void gaps_of_heights_have_no_cliffs_and_no_seams(void **state)
{
    struct fixture *f = *state;
    struct both both;
    const struct recipe inset = inset_of(hills);
    make_both(f, &inset, 60, &both);
    for (int x = 600; x < 1200; x += 7) {
        for (int y = 120; y < 420; y += 9) {
            // The cubic looks two texels around.
            const bool is_near =
                hypot(x - HOLE_X, y - HOLE_Y) < HOLE_RADIUS + 3 || abs(x - SLIT_X) < 3;
            const double whole = surface_altitude(&both.whole, place(x, y));
            const double tiled = surface_altitude(&both.tiled, place(x, y));
            assert_true(is_near || fabs(whole - tiled) < 1e-6);
            // A mean of 4 x 4 texels makes of hills 400 m high what it can.
            assert_true(fabs(whole - tiled) < 400);
        }
    }
    // 400 m / 3 texels are 133 m from one to the next at the steepest, 2 m of slope; from the rim's
    // 5000 m to the ground's 1000 over 60 texels 100 m. With the coarse level alone it was 365.
    assert_true(largest_step(&both.tiled, true) < 170);
    assert_true(largest_step(&both.tiled, false) < 170);
    // A slit of one texel is closed between its sides.
    const double there = surface_altitude(&both.tiled, place(SLIT_X, 300));
    const double beside = (hills(SLIT_X - 1, 300) + hills(SLIT_X + 1, 300)) / 2;
    assert_true(fabs(there - beside) < 60);
    finish_both(&both);
}

// The feather of 3 texels is looked for on the finest level, those of 20 and 60 on coarser ones.
static void pictures_fade_toward_gaps_as_held_whole(void **state)
{
    struct fixture *f = *state;
    struct both both;
    const struct recipe inset = inset_of(brightness);
    static const double FEATHERS[3] = {3, 20, 60};
    for (int i = 0; i < 3; i++) {
        make_both(f, &inset, FEATHERS[i], &both);
        double worst = 0, mean = 0;
        int count = 0;
        for (int x = 850; x < 1200; x += 5) {
            for (int y = 90; y < 430; y += 7) {
                double a[3] = {0}, b[3] = {0};
                (void)surface_picture(&both.whole, SURFACE_COLOUR, place(x, y), a);
                (void)surface_picture(&both.tiled, SURFACE_COLOUR, place(x, y), b);
                worst = fmax(worst, fabs(a[1] - b[1]));
                mean += fabs(a[1] - b[1]);
                count++;
            }
        }
        // Distances are told to a texel of a level where the feather is 8 wide, at the most.
        assert_true(worst < 0.15 && mean / count < 0.005);
        finish_both(&both);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(gaps_of_heights_have_no_cliffs_and_no_seams),
        TEST(pictures_fade_toward_gaps_as_held_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
