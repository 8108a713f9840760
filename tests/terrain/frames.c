// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Rasters in their own projections: texels against PROJ, heights of the GPU against the CPU's and
// across the seams, about both poles; exaggeration, blend modes, and layers that are no good.
#include "fixture.h"

#include "shared/blend.glsl"
#include "shared/projection.glsl"
#include "shared/sea.glsl"
#include "terrain/look.h"

#include <gdal.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double R = 6.371e6;
static const double DEGREE = 3.14159265358979323846 / 180;

// Smooth over the sphere; about -1000 to 3000 m.
static double hills(double latitude, double longitude)
{
    const struct vec3 d = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
    return 1000 + 1000 * sin(7 * d.x + 1) * cos(5 * d.y) + 1000 * sin(9 * d.z) * cos(6 * d.x);
}

// A file of one or three bands in a projected system, `side` pixels square about the pole.
struct polar_file {
    const char *name, *srs; // the latter as OSRSetFromUserInput takes it
    double half_m;
    int side, bands;
    double (*values)(double latitude, double longitude);
};

static OGRCoordinateTransformationH transform_to_degrees(OGRSpatialReferenceH srs)
{
    const OGRSpatialReferenceH geographic = OSRCloneGeogCS(srs);
    OSRSetAxisMappingStrategy(geographic, OAMS_TRADITIONAL_GIS_ORDER);
    OSRSetAxisMappingStrategy(srs, OAMS_TRADITIONAL_GIS_ORDER);
    const OGRCoordinateTransformationH t = OCTNewCoordinateTransformation(srs, geographic);
    assert_non_null(t);
    OSRDestroySpatialReference(geographic);
    return t;
}

static void write_polar(const struct fixture *f, const struct polar_file *file, char path[128])
{
    snprintf(path, 128, "%s/%s.tif", f->folder, file->name);
    const GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName("GTiff"), path, file->side, file->side, file->bands,
                   file->bands == 1 ? GDT_Float32 : GDT_Byte, NULL);
    assert_non_null(dataset);
    const double pixel = 2 * file->half_m / file->side;
    double transform[6] = {-file->half_m, pixel, 0, file->half_m, 0, -pixel};
    assert_int_equal(GDALSetGeoTransform(dataset, transform), CE_None);
    const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    assert_int_equal(OSRSetFromUserInput(srs, file->srs), OGRERR_NONE);
    assert_int_equal(GDALSetSpatialRef(dataset, srs), CE_None);
    const OGRCoordinateTransformationH t = transform_to_degrees(srs);
    for (int y = 0; y < file->side; y++) {
        for (int x = 0; x < file->side; x++) {
            double at[2] = {(x + 0.5) * pixel - file->half_m, file->half_m - (y + 0.5) * pixel};
            assert_true(OCTTransform(t, 1, &at[0], &at[1], NULL));
            float value = (float)file->values(at[1], at[0]);
            for (int band = 1; band <= file->bands; band++) {
                assert_int_equal(GDALRasterIO(GDALGetRasterBand(dataset, band), GF_Write, x, y, 1,
                                              1, &value, 1, 1, GDT_Float32, 0, 0),
                                 CE_None);
            }
        }
    }
    OCTDestroyCoordinateTransformation(t);
    OSRDestroySpatialReference(srs);
    GDALClose(dataset);
}

// Of Mars, of Earth as an ellipsoid, and with an odd meridian.
static const char *const SYSTEMS[] = {
    "+proj=stere +lat_0=90 +lon_0=0 +k=1 +R=3396190 +units=m", "EPSG:3413", "EPSG:3031",
    "+proj=stere +lat_0=-90 +lat_ts=-60 +lon_0=77 +a=3396190 +b=3376200 +units=m"};
enum { SYSTEM_COUNT = sizeof SYSTEMS / sizeof SYSTEMS[0] };

static void test_texels_lie_where_proj_says(void **state)
{
    struct fixture *f = *state;
    for (size_t i = 0; i < SYSTEM_COUNT; i++) {
        char path[128];
        const struct polar_file file = {"polar", SYSTEMS[i], 2.5e6, 64, 1, hills};
        write_polar(f, &file, path);
        struct raster raster;
        assert_int_equal(raster_open(f->ctx, path, &raster), TRL_OK);
        assert_null(raster.source);
        const struct layer_frame frame = layer_frame_of(&raster, raster.width, raster.height, 0);
        const OGRSpatialReferenceH srs = OSRClone(GDALGetSpatialRef(raster.dataset));
        const OGRCoordinateTransformationH t = transform_to_degrees(srs);
        for (int k = 0; k < 200; k++) {
            const double column = fmod(k * 7.77, 63.9) - 0.45, row = fmod(k * 3.33, 63.9) - 0.45;
            double at[2] = {(column + 0.5) * 5e6 / 64 - 2.5e6, 2.5e6 - (row + 0.5) * 5e6 / 64};
            assert_true(OCTTransform(t, 1, &at[0], &at[1], NULL));
            const struct layer_place place = layer_locate(&frame, at[1] * DEGREE, at[0] * DEGREE);
            // Half a metre: what the ellipsoid's series leaves 45 degrees from the pole is less.
            assert_close(place.x, column, 0.5 / 78125);
            assert_close(place.y, row, 0.5 / 78125);
            assert_true(place.weight == 1);
            const struct layer_geo geo = layer_geo_of(&frame, column, row);
            const struct vec3 there = vec3_from_lat_lon(geo.latitude, geo.longitude);
            const struct vec3 wanted = vec3_from_lat_lon(at[1] * DEGREE, at[0] * DEGREE);
            assert_close(vec3_length(vec3_sub(there, wanted)), 0, 1e-7);
            assert_true(acos(fmin(1, vec3_dot(wanted, frame.direction))) <= frame.reach_rad);
        }
        assert_true(layer_locate(&frame, 0, 0).weight == 0);
        // The other pole, and beside it, where the map has no end.
        for (int k = 0; k < 5; k++) {
            const double other = -frame.pole * (SHARED_PI / 2 - (k == 0 ? 0 : pow(10, -2 * k)));
            assert_true(layer_locate(&frame, other, k).weight == 0);
        }
        OCTDestroyCoordinateTransformation(t);
        OSRDestroySpatialReference(srs);
        raster_finish(&raster);
    }
}

// A globe with a layer about each pole, all of the same hills.
struct planet {
    struct fixture *f;
    struct surface surface;
    struct mesher *mesher;
    struct picture picture;
};

static void make_planet(struct fixture *f, struct planet *p)
{
    char paths[3][128];
    const struct raster_place everywhere = {-180, 90, 0.5, 720, 360};
    fixture_write_heights(f, "globe", &everywhere, hills, paths[0]);
    const struct polar_file north = {"north", "EPSG:3413", 2e6, 200, 1, hills};
    const struct polar_file south = {"south", "EPSG:3031", 2e6, 200, 1, hills};
    write_polar(f, &north, paths[1]);
    write_polar(f, &south, paths[2]);
    struct surface_layer_desc layers[3];
    for (int i = 0; i < 3; i++) {
        layers[i] = (struct surface_layer_desc){
            .kind = SURFACE_ELEVATION, .path = paths[i], .scale = 1, .feather_rad = 3 * DEGREE};
    }
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = 3;
    desc.layers = layers;
    desc.is_strict = true;
    p->f = f;
    assert_int_equal(surface_init(f->gpu, &desc, &p->surface), TRL_OK);
    assert_int_equal(mesher_create(&p->surface, TRL_MESHER_HEMISPHERE, &p->mesher), TRL_OK);
    fixture_picture_init(f, &p->picture);
}

static void destroy_planet(struct planet *p)
{
    fixture_picture_finish(p->f, &p->picture);
    mesher_destroy(&p->mesher);
    surface_finish(&p->surface);
}

static void test_seams_of_projections_do_not_show(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    for (int i = 0; i < 4000; i++) {
        const double latitude = (i % 2 ? 1 : -1) * (60 + fmod(i * 0.0777, 30));
        const double longitude = fmod(i * 7.31, 360) - 180;
        const double height =
            surface_altitude(&p.surface, vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE));
        // Hills bend by 1000 m 81 (0.0087 rad)^2 = 6 m a texel squared of the globe, of which the
        // smoothing cubic takes an 18th each way; heights there are whole metres; level rows next
        // to the poles lie below the polar layers.
        assert_close(height, hills(latitude, longitude), 2.5);
    }
    destroy_planet(&p);
}

static void test_the_gpu_has_the_cpus_heights_at_the_poles(void **state)
{
    struct planet p;
    make_planet(*state, &p);
    static const double LATITUDES[] = {90, 89.99, 84, 72.5, -90, -79, -71.9};
    static const double HEIGHTS[] = {500, 2e4, 1e6};
    for (size_t i = 0; i < sizeof LATITUDES / sizeof LATITUDES[0]; i++) {
        for (int k = 0; k < 3; k++) {
            const struct camera_place place = {
                LATITUDES[i], 40.0 * (double)i, R, 3000 + HEIGHTS[k], 10, -90, 60};
            const struct camera camera = fixture_camera(&place);
            fixture_picture_draw(&p.picture, p.mesher, &camera);
            for (int n = 0; n < PICTURE_SIDE * PICTURE_SIDE; n += 61) {
                const float *pixel = p.picture.pixels + 4 * n;
                assert_true(pixel[3] > -1e8f);
                const struct vec3 at = {camera.position_m.x + (double)pixel[0],
                                        camera.position_m.y + (double)pixel[1],
                                        camera.position_m.z + (double)pixel[2]};
                // Cells of the mesh sag by their length squared times the bend, 81e3 m / R^2; from
                // 1000 km they are some 20 km long, and mips smooth by as much.
                const double sag = HEIGHTS[k] > 1e5 ? 8 : 1.5;
                assert_close((double)pixel[3], surface_altitude(&p.surface, at), sag);
            }
        }
    }
    destroy_planet(&p);
}

static double byte_hills(double latitude, double longitude)
{
    return 60 + hills(latitude, longitude) / 30;
}

static double steep_hills(double latitude, double longitude)
{
    return 40 * hills(latitude, longitude);
}

// Colour and slope of pixels under the camera, as the CPU has them: at the poles, beside them and
// in the feather, where east and north of a map are not those of the place.
static void test_colours_and_normals_are_the_cpus(void **state)
{
    struct fixture *f = *state;
    char paths[4][128];
    const struct raster_place everywhere = {-180, 90, 0.5, 720, 360};
    fixture_write_bytes(f, "globe", &everywhere, byte_hills, paths[0]);
    const struct polar_file files[] = {{"north", "EPSG:3413", 2e6, 200, 1, steep_hills},
                                       {"south", "EPSG:3031", 2e6, 200, 1, steep_hills},
                                       {"colour", "EPSG:3031", 2e6, 200, 3, byte_hills}};
    for (int i = 0; i < 3; i++) {
        write_polar(f, &files[i], paths[i + 1]);
    }
    const struct surface_layer_desc layers[] = {
        {.kind = SURFACE_ELEVATION, .path = paths[1], .scale = 1, .feather_rad = 3 * DEGREE},
        {.kind = SURFACE_ELEVATION, .path = paths[2], .scale = 1, .feather_rad = 3 * DEGREE},
        {.kind = SURFACE_COLOUR, .path = paths[0]},
        {.kind = SURFACE_COLOUR, .path = paths[3], .feather_rad = 3 * DEGREE}};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = 4;
    desc.layers = layers;
    desc.is_strict = true;
    struct surface with, without;
    assert_int_equal(surface_init(f->gpu, &desc, &with), TRL_OK);
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &without), TRL_OK);
    static const double LATITUDES[] = {90, 89.999, 84, -90, -89.99, -80};
    for (size_t i = 0; i < sizeof LATITUDES / sizeof LATITUDES[0]; i++) {
        const struct camera_place place = {LATITUDES[i], 25.0 + 50.0 * (double)i, R, 2e5, 0, -90,
                                           0.5};
        const struct camera camera = fixture_camera(&place);
        const struct composed c = fixture_compose_middle(f, &with, &camera);
        // The middle pixel's own middle is a two hundredth of half a degree off: 5 m.
        const struct vec3 up = vec3_normalize(camera.position_m);
        const struct vec3 n = surface_normal(&without, up);
        const struct vec3 got = {(double)c.normal_sun[0], (double)c.normal_sun[1],
                                 (double)c.normal_sun[2]};
        assert_true(vec3_length(vec3_sub(n, up)) > 0.01);
        // Slopes of 0.06 that bend by 0.5 per radian; the CPU's counts the radius of the ground,
        // 1 % more than the sphere's, the GPU's smooths over a texel.
        assert_close(vec3_length(vec3_sub(got, n)), 0, 2e-3);
        double rgb[3] = {0};
        assert_true(surface_picture(&without, SURFACE_COLOUR, up, rgb));
        assert_close(c.albedo_water[1], 255 * sqrt(rgb[1]), 2);
    }
    surface_finish(&with);
    surface_finish(&without);
}

// Two altitudes of one place, an offset of a hundredth of a metre away: their difference is that of
// the slope, not of rounding.
static void test_small_steps_keep_their_digits(void **state)
{
    (void)state;
    struct raster raster = {.width = 4096, .height = 4096};
    raster.plane = (struct raster_plane){1, -45, 0.00669438, -0.4, 0.4, 0.8 / 4096, 0.8 / 4096};
    const struct layer_frame frame = layer_frame_of(&raster, 4096, 4096, 0);
    const double latitude = 71 * DEGREE, longitude = 33 * DEGREE;
    const struct layer_place here = layer_locate(&frame, latitude, longitude);
    const struct layer_place there = layer_locate(&frame, latitude + 1e-2 / R, longitude);
    const double texel_m = frame.texel_height * R;
    // The map's scale there: 2 / (1 + sin 71).
    assert_close(hypot(there.x - here.x, there.y - here.y) * texel_m / 1e-2,
                 2 / (1 + sin(latitude)), 0.01);
}

static double hundred(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 100;
}

static double three_to_the_east(double latitude, double longitude)
{
    (void)latitude;
    return longitude < 0 ? NAN : 3;
}

static void test_layers_blend_as_they_say(void **state)
{
    struct fixture *f = *state;
    static const double MODES[] = {BLEND_OVER, BLEND_ADD, BLEND_MULTIPLY, BLEND_MAX, BLEND_MIN};
    static const double WANTED[] = {3, 103, 300, 100, 3};
    char below[128], above[128];
    const struct raster_place everywhere = {-180, 90, 1, 360, 180};
    const struct raster_place half = {-20, 40, 0.2, 200, 200};
    fixture_write_heights(f, "below", &everywhere, hundred, below);
    fixture_write_heights(f, "above", &half, three_to_the_east, above);
    for (int i = 0; i < 5; i++) {
        const struct surface_layer_desc layers[2] = {
            {.kind = SURFACE_ELEVATION, .path = below, .scale = 1},
            {.kind = SURFACE_ELEVATION,
             .path = above,
             .scale = 1,
             .feather_rad = 2 * DEGREE,
             .mode = MODES[i]}};
        struct surface_desc desc = surface_desc_default();
        desc.radius_m = R;
        desc.layer_count = 2;
        desc.layers = layers;
        desc.exaggeration = 2;
        struct surface s;
        assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
        const struct vec3 on = vec3_from_lat_lon(20 * DEGREE, 10 * DEGREE);
        const struct vec3 gap = vec3_from_lat_lon(20 * DEGREE, -10 * DEGREE);
        const struct vec3 off = vec3_from_lat_lon(-50 * DEGREE, 10 * DEGREE);
        assert_close(surface_altitude(&s, on), 2 * WANTED[i], 1e-4);
        assert_close(surface_altitude(&s, gap), 200, 1e-4);
        assert_close(surface_altitude(&s, off), 200, 1e-4);
        const struct surface_bounds b = surface_bounds_around(&s, on, 0.01);
        assert_true((double)b.min <= 2 * WANTED[i] && (double)b.max >= 2 * WANTED[i]);
        surface_finish(&s);
    }
}

static double nothing(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return NAN;
}

static void cut(const char *path, long bytes)
{
    assert_int_equal(truncate(path, bytes), 0);
}

// Each is told in one line that names it, and the planet is there without it.
static void test_bad_layers_are_left_out(void **state)
{
    struct fixture *f = *state;
    char paths[6][128], good[128];
    const struct raster_place everywhere = {-180, 90, 1, 360, 180};
    fixture_write_heights(f, "good", &everywhere, hundred, good);
    fixture_write_heights(f, "void", &(struct raster_place){10, 20, 0.1, 30, 30}, nothing,
                          paths[0]);
    fixture_write_heights(f, "point", &(struct raster_place){10, 20, 1, 1, 1}, hundred, paths[1]);
    fixture_write_heights(f, "line", &(struct raster_place){10, 20, 1e-4, 100000, 1}, hundred,
                          paths[2]);
    fixture_write_heights(f, "cut", &everywhere, hundred, paths[3]);
    cut(paths[3], 70000);
    fixture_write_heights(f, "odd", &(struct raster_place){10, 20, 1, 400, 10}, hundred, paths[4]);
    snprintf(paths[5], 128, "%s/text.tif", f->folder);
    FILE *file = fopen(paths[5], "w");
    assert_non_null(file);
    fputs("no raster at all\n", file);
    fclose(file);
    for (int i = 0; i < 6; i++) {
        const struct surface_layer_desc layers[2] = {
            {.kind = SURFACE_ELEVATION, .path = good, .scale = 1},
            {.kind = SURFACE_ELEVATION, .path = paths[i], .scale = 1}};
        struct surface_desc desc = surface_desc_default();
        desc.radius_m = R;
        desc.layer_count = 2;
        desc.layers = layers;
        struct surface s;
        f->last_error[0] = '\0';
        assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
        assert_non_null(strstr(f->last_error, paths[i]));
        assert_non_null(strstr(f->last_error, "left out"));
        assert_int_equal(s.counts[SURFACE_ELEVATION], 1);
        assert_close(surface_altitude(&s, (struct vec3){1, 0.2, 0.3}), 100, 1e-6);
        surface_finish(&s);
        desc.is_strict = true;
        assert_int_not_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    }
    // A picture of heights is no colour.
    const struct surface_layer_desc colour = {.kind = SURFACE_COLOUR, .path = good};
    struct surface_desc desc = surface_desc_default();
    desc.layer_count = 1;
    desc.layers = &colour;
    struct surface s;
    assert_int_equal(surface_init(f->gpu, &desc, &s), TRL_OK);
    assert_non_null(strstr(f->last_error, "8 bits"));
    surface_finish(&s);
}

static double shallow(double latitude, double longitude)
{
    return -40 + 10 * sin(3 * longitude * DEGREE) * cos(latitude * DEGREE);
}

static double deep(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return -90;
}

static double all_water(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 255;
}

// A finer map about the pole tells the mask's water how deep it is, and the globe's heights beyond.
static void test_the_sea_about_a_pole_is_as_deep_as_its_map(void **state)
{
    const struct fixture *f = *state;
    char paths[3][128];
    const struct raster_place everywhere = {-180, 90, 0.5, 720, 360};
    const struct polar_file north = {"north", "EPSG:3413", 2e6, 400, 1, shallow};
    fixture_write_heights(f, "deep", &everywhere, deep, paths[0]);
    write_polar(f, &north, paths[1]);
    fixture_write_bytes(f, "water", &everywhere, all_water, paths[2]);
    struct surface_layer_desc layers[3];
    for (int i = 0; i < 3; i++) {
        layers[i] =
            (struct surface_layer_desc){.kind = SURFACE_ELEVATION, .path = paths[i], .scale = 1};
    }
    layers[2].kind = SURFACE_WATER;
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = R;
    desc.layer_count = 3;
    desc.layers = layers;
    desc.is_strict = true;
    desc.depth = (struct surface_depth){.is_told = true, .everywhere_m = -1};
    struct surface s;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
    for (int k = 0; k < 200; k++) {
        const double latitude = 75.3 + 14.6 * k / 200, longitude = fmod(k * 77.7, 360) - 180;
        double code;
        const struct vec3 at = vec3_from_lat_lon(latitude * DEGREE, longitude * DEGREE);
        assert_close(surface_water(&s, at, &code), 1, 0);
        // Codes of bytes have steps of 0.7 and 1.1 m there; a texel of the mask, 0.1 m.
        assert_close(sea_code_depth(code), -shallow(latitude, longitude), 0.5);
        const struct vec3 south = vec3_from_lat_lon(-latitude * DEGREE, longitude * DEGREE);
        assert_close(surface_water(&s, south, &code), 1, 0);
        assert_close(sea_code_depth(code), 90, 0.6);
    }
    surface_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_texels_lie_where_proj_says),
        cmocka_unit_test(test_seams_of_projections_do_not_show),
        cmocka_unit_test(test_the_gpu_has_the_cpus_heights_at_the_poles),
        cmocka_unit_test(test_colours_and_normals_are_the_cpus),
        cmocka_unit_test(test_the_sea_about_a_pole_is_as_deep_as_its_map),
        cmocka_unit_test(test_small_steps_keep_their_digits),
        cmocka_unit_test(test_layers_blend_as_they_say),
        cmocka_unit_test(test_bad_layers_are_left_out),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
