// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TEST_RASTER_FIXTURE_H
#define TEST_RASTER_FIXTURE_H
// What the tests of rasters share: a context that keeps what is logged, a folder of its own, and
// files made with GDAL by recipe.
#include "raster/raster.h"

// cmocka wants these before its own header
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <gdal.h>
#include <sys/types.h>

static const double RADIAN = 3.14159265358979323846 / 180;

struct fixture {
    trl_context *ctx;
    char folder[64];
    int errors, warnings;           // lines logged as such
    char last[2048], warning[2048]; // the latest of them
    pid_t server;                   // of test_remote.c
    int to_server, port;            // its standard input
};

// Of cmocka: sets *state to a fixture, frees it.
int set_up(void **state);
int tear_down(void **state);

// The same with a context that may reach the network, or not.
int set_up_allowed(void **state, bool allows_remote);

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

// A context whose allocations fail when *left of them have gone through. Threads: any.
trl_context *make_counting_context(int *left);

// What a test file is. The georeference is left out when the pixel width is 0.
struct recipe {
    const char *name;
    const char *driver; // NULL: GTiff
    int width, height, bands;
    GDALDataType type;
    double transform[6];
    const char *system; // of coordinates, as GDAL's programs take it; NULL: none
    bool has_nodata;
    double nodata;
    const char *option; // of creation, "NAME=VALUE", or NULL
    bool has_overviews;
    double (*value)(int x, int y); // of every band; NULL: as value_at says
};

// 36 x 18 int16 pixels, WGS 84.
extern const struct recipe GLOBE;

// Value of a pixel: different everywhere, and within 8 bits where that is the type.
double value_at(const struct recipe *r, int band, int x, int y);

// Path of the file made; good until the next call.
const char *make_file(struct fixture *f, const struct recipe *r);

// Makes and opens it; nothing may be logged.
void open_made(struct fixture *f, const struct recipe *r, struct raster *raster);

// Opens what must be refused: the result, one line that names the file and holds `why`, nothing
// left open.
void expect_refused(struct fixture *f, const char *path, trl_result result, const char *why);

// A place's value in the file, as the raster's own borders have it.
double value_in(const struct raster *raster, double latitude, double longitude);

#endif // TEST_RASTER_FIXTURE_H
