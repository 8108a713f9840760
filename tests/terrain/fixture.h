// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_TERRAIN_FIXTURE_H
#define TESTS_TERRAIN_FIXTURE_H
// A headless GPU, rasters made of formulas in a folder of their own, and pictures of them.

#include "terrain/compose.h"
#include "terrain/mesher.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

// cmocka's assert_float_equal is for floats.
static inline void check_close(double got, double wanted, double tolerance, int line)
{
    if (!(fabs(got - wanted) <= tolerance)) {
        fail_msg("line %d: %.9g, not %.9g within %.3g", line, got, wanted, tolerance);
    }
}
#define assert_close(got, wanted, tolerance) check_close(got, wanted, tolerance, __LINE__)

struct fixture {
    trl_context *ctx;
    struct gpu *gpu;
    char folder[64];
    char last_error[512];
};

// cmocka's group functions. The test ends with 77 (skipped) where there is no GL, unless the
// environment has TRL_REQUIRE_GPU=1, as CI does.
int fixture_set_up(void **state);
int fixture_tear_down(void **state);

// A planet of 6e6 m made of noise, of eroded form with octaves down to 0.2 m, on continents
// 2500 m rough about a height of 5000 m.
struct surface_desc fixture_invent(uint32_t seed);
// What a biome's range has where it is not asked.
#define FIXTURE_ANY ((struct biome_range){-1e9, 1e9, 1})

// Degrees.
struct raster_place {
    double west, north, texel;
    uint32_t width, height;
};
// Writes heights(latitude_deg, longitude_deg) as a GeoTIFF of floats, or of int16; `path` must hold
// 128 characters. NaN becomes nodata.
void fixture_write_heights(const struct fixture *f, const char *name,
                           const struct raster_place *place,
                           double (*heights)(double latitude, double longitude), char *path);
// The same as bytes, for masks and pictures (three equal bands).
void fixture_write_bytes(const struct fixture *f, const char *name,
                         const struct raster_place *place,
                         double (*values)(double latitude, double longitude), char *path);

// A camera above a place in degrees, `altitude_m` above the sphere of `radius_m`; heading and pitch
// in degrees; sun at the zenith.
struct camera_place {
    double latitude, longitude, radius_m, altitude_m, heading, pitch, fov;
};
struct camera fixture_camera(const struct camera_place *place);

// What a mesher draws: positions (4 floats a pixel) of a square picture. Free with mem_free.
enum { PICTURE_SIDE = 160 };
// Of the hemisphere's grid: less than a renderer's, what is shown with it holds for any.
enum { FIXTURE_CELLS = 800 };
struct picture {
    struct gpu_texture position, depth;
    struct gpu_target target;
    float *pixels; // PICTURE_SIDE^2 x 4, bottom row first
};
void fixture_picture_init(const struct fixture *f, struct picture *out);
void fixture_picture_draw(struct picture *picture, struct mesher *mesher,
                          const struct camera *camera);
void fixture_picture_finish(const struct fixture *f, struct picture *picture);

// Pixels of the three surface targets at the picture's middle.
struct composed {
    uint8_t albedo_water[4], lights[4];
    float normal_sun[4];
};
struct composed fixture_compose_middle(const struct fixture *f, const struct surface *surface,
                                       const struct camera *camera);

// And all of them, bottom row first. Free both with mem_free.
struct composed_picture {
    uint8_t *albedo_water;
    float *normal_sun;
};
struct composed_picture fixture_compose(const struct fixture *f, const struct surface *surface,
                                        const struct camera *camera);

// Unit direction of a pixel's middle.
struct vec3 fixture_ray(const struct camera *camera, int x, int y);

#endif // TESTS_TERRAIN_FIXTURE_H
