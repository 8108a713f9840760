// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What is wrong with a scene: exactly one line, with the place and the path of the key.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdio.h>

#include "log.h"
#include "sample.h"

struct error_case {
    const char *from, *to; // what is replaced in the sample
    const char *message;   // how the line begins
};

// From a block of exactly the text's size, so that a sanitizer sees reads behind it.
static trl_result parse(struct fixture *f, const char *text, size_t length)
{
    trl_scene *scene = NULL;
    char *copy = malloc(length > 0 ? length : 1);
    assert_non_null(copy);
    memcpy(copy, text, length);
    f->log.errors = 0;
    const trl_result result = trl_scene_parse(f->ctx, copy, length, "t.json", ".", &scene);
    assert_true((result == TRL_OK) == (scene != NULL));
    trl_scene_destroy(&scene);
    free(copy);
    return result;
}

static void assert_errors(struct fixture *f, const struct error_case *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char *text = sample_replace(cases[i].from, cases[i].to);
        assert_non_null(text);
        const trl_result result = parse(f, text, strlen(text));
        free(text);
        if (result != TRL_ERROR_INVALID || f->log.errors != 1 || strchr(f->log.error, '\n') ||
            strncmp(f->log.error, cases[i].message, strlen(cases[i].message)) != 0) {
            fail_msg("%s -> %s: %s, %zu errors, \"%s\"", cases[i].from, cases[i].to,
                     trl_result_name(result), f->log.errors, f->log.error);
        }
    }
}

#define ASSERT_ERRORS(state, cases)                                                                \
    assert_errors(*(state), (cases), sizeof(cases) / sizeof((cases)[0]))

static void syntax_errors_have_their_place(void **state)
{
    const struct error_case cases[] = {
        {"\"name\": \"Test\"", "\"name\": Test", "t.json:1:26: name: not JSON: "},
        {"0.25 }", "0.25, }", "t.json:2:69: star: not JSON: "},
        {"6371000,", "6371000", "t.json:3:35: planet.radius_m: not JSON: "},
        {"1.5", "1e999", "t.json:2:36: star.spectral_irradiance: not JSON: "},
        {"1.5", "NaN", "t.json:2:36: star.spectral_irradiance: not JSON: "},
        {"0.1 }", "0.1, \"radius_m\": 2 }", "t.json:3:58: planet.radius_m: not JSON: duplicate"},
        {"\"Test\"", "\"\xff\"", "t.json:1:"},
    };
    ASSERT_ERRORS(state, cases);
}

static void unknown_keys_are_named_with_the_nearest(void **state)
{
    const struct error_case cases[] = {
        {"\"radius_m\"", "\"radus_m\"",
         "t.json:3:15: planet.radus_m: unknown key; the nearest known one is \"radius_m\" "},
        {"\"scale_height_m\"", "\"scale_hight\"",
         "t.json:6:37: atmosphere.constituents[0].profile.exponential.scale_hight: unknown key; "
         "the nearest known one is \"scale_height_m\""},
        {"\"exponential\"", "\"exponental\"",
         "t.json:6:20: atmosphere.constituents[0].profile.exponental: unknown key; the nearest "
         "known one is \"exponential\""},
        {"\"azimuth_deg\"", "\"azimut_deg\"",
         "t.json:11:35: views.one.sun.azimut_deg: unknown key; the nearest known one is "
         "\"azimuth_deg\""},
        {"\"name\": \"Test\"", "\"Names\": \"Test\"",
         "t.json:1:18: Names: unknown key; the nearest known one is \"name\""},
        {"\"rayleigh\"", "\"raileigh\"",
         "t.json:7:16: atmosphere.constituents[0].phase: is \"raileigh\"; the nearest known word "
         "is "
         "\"rayleigh\""},
        {"\"elevation\": \"a.tif\"", "\"colour\": \"a.tif\", \"scale\": 2",
         "t.json:8:49: surface.layers[0].scale: unknown key; the nearest known one is "},
        {"\"name\": \"Test\"", "\"\\u0000\": 1", "t.json:1:"},
        {"\"name\": \"Test\"", "\"a\\nb\": 1", "t.json:1:1: [\"a b\"]: unknown key"},
    };
    ASSERT_ERRORS(state, cases);
}

static void missing_and_wrongly_typed_values_are_named(void **state)
{
    const struct error_case cases[] = {
        {"\"terrella\": 1, ", "", "t.json:1:1: terrella: is missing; must be a number"},
        {"\"terrella\": 1", "\"terrella\": 2", "t.json:1:15: terrella: format 2 is unknown"},
        {"\"terrella\": 1", "\"terrella\": \"1\"", "t.json:1:15: terrella: is a string"},
        {"\"Test\"", "7", "t.json:1:26: name: is a number; must be a string"},
        {"\"Test\"", "\"\"", "t.json:1:26: name: has 0 bytes"},
        {"\"radius_m\": 6371000, ", "", "t.json:3:13: planet.radius_m: is missing"},
        {", \"ground_albedo\": 0.1", "", "t.json:3:13: planet.ground_albedo: is missing"},
        {"\"spectral_irradiance\": 1.5, ", "", "t.json:2:11: star.spectral_irradiance: is missing"},
        {"\"height_m\": 100000, ", "", "t.json:4:17: atmosphere.height_m: is missing"},
        {"6371000", "\"6371 km\"", "t.json:3:27: planet.radius_m: is a string; must be a number"},
        {"6371000", "null", "t.json:3:27: planet.radius_m: is null; must be a number"},
        {"1e-5", "true",
         "t.json:5:42: atmosphere.constituents[0].scattering_per_m: is true or "
         "false; must be a number, a list"},
        {"\"rayleigh\"", "3", "t.json:7:16: atmosphere.constituents[0].phase: is a number"},
        {",\n      \"phase\": \"rayleigh\"", "",
         "t.json:5:5: atmosphere.constituents[0].phase: is missing"},
        {"{ \"exponential\": { \"scale_height_m\": 8000 } }", "[]",
         "t.json:6:18: atmosphere.constituents[0].profile: is a list; must be \"uniform\" or"},
        {"{ \"exponential\": { \"scale_height_m\": 8000 } }", "{}",
         "t.json:6:18: atmosphere.constituents[0].profile: has 0 of the keys exponential, tent"},
        {"8000 }", "8000 }, \"table\": []",
         "t.json:6:18: atmosphere.constituents[0].profile: has 2 of the keys exponential, tent"},
        {"\"a.tif\" }", "\"a.tif\", \"optional\": 1 }",
         "t.json:8:64: surface.layers[0].optional: is a number; must be true or false"},
        {"\"altitude_m\": 3", "\"heading_deg\": 3",
         "t.json:10:15: views.one.camera: must have one of altitude_m"},
        {"\"altitude_m\": 3", "\"altitude_m\": 3, \"height_above_ground_m\": 1",
         "t.json:10:15: views.one.camera: must have one of altitude_m"},
        {"\"elevation_deg\": 45, ", "", "t.json:11:12: views.one.sun.elevation_deg: is missing"},
        {"\"elevation_deg\"", "\"subsolar_latitude_deg\"",
         "t.json:11:14: views.one.sun.subsolar_latitude_deg: unknown key"},
        {"{ \"one\"", "{ \"comment\": 5, \"one\"", "t.json:9:25: views.comment: is a number"},
        {"\"name\": \"Test\"", "\"comment\": 5", "t.json:1:29: comment: is a number"},
        {"{ \"one\"", "{ \"\": 5, \"one\"", "t.json:9:18: views[\"\"]: a view's name"},
    };
    ASSERT_ERRORS(state, cases);
}

static void numbers_out_of_range_say_what_is_allowed(void **state)
{
    const struct error_case cases[] = {
        {"6371000", "0", "t.json:3:27: planet.radius_m: is 0; must be a number >= 1 and <= 1e+09"},
        {"6371000", "-1", "t.json:3:27: planet.radius_m: is -1; must be a number >= 1"},
        {"6371000", "1e300", "t.json:3:27: planet.radius_m: is 1e+300; must be"},
        {"100000", "0", "t.json:4:31: atmosphere.height_m: is 0; must be a number >= 1"},
        {"0.1 }", "1.01 }",
         "t.json:3:53: planet.ground_albedo: is 1.01; must be a number >= 0 and "
         "<= 1"},
        {"0.1 }", "[[400, 0.5], [500, -0.1]] }",
         "t.json:3:72: planet.ground_albedo[1][1]: is -0.1; must be a number >= 0 and <= 1"},
        {"0.1 }", "{\"power_law\":{\"at_nm\":550,\"value\":0.9,\"exponent\":2}} }",
         "t.json:3:53: planet.ground_albedo: is 1.0"},
        {"0.25", "91", "t.json:2:63: star.angular_radius_deg: is 91"},
        {"0.25", "0.25, \"corona\": -1", "t.json:2:79: star.corona: is -1; must be a number >= 0"},
        {"1.5", "-1", "t.json:2:36: star.spectral_irradiance: is -1"},
        {"1e-5", "1001",
         "t.json:5:42: atmosphere.constituents[0].scattering_per_m: is 1001; must "
         "be a number >= 0 and <= 1000"},
        {"1e-5", "{\"rayleigh\":{\"refractive_index\":2,\"number_density_per_m3\":1}}",
         "t.json:5:42: atmosphere.constituents[0].scattering_per_m: is 4.4"},
        {"1e-5", "{\"rayleigh\":{\"refractive_index\":1.1,\"number_density_per_m3\":0}}",
         "t.json:5:102: atmosphere.constituents[0].scattering_per_m.rayleigh.number_density_per_m3"
         ": is 0"},
        {"1e-5", "{\"blackbody\":{\"temperature_K\":-4,\"total_W_m2\":0}}",
         "t.json:5:72: atmosphere.constituents[0].scattering_per_m.blackbody.temperature_K: is -4"},
        {"1e-5", "[]", "t.json:5:42: atmosphere.constituents[0].scattering_per_m: is empty"},
        {"1e-5", "[500, 1]",
         "t.json:5:43: atmosphere.constituents[0].scattering_per_m[0]: must be a pair [nm, value]"},
        {"1e-5", "[[0, 1]]",
         "t.json:5:44: atmosphere.constituents[0].scattering_per_m[0][0]: is 0; "
         "must be a number > 0"},
        {"1e-5", "[[5, 1], [5, 1]]",
         "t.json:5:52: atmosphere.constituents[0].scattering_per_m[1][0]: is 5 after 5; must"},
        {"8000", "0",
         "t.json:6:55: atmosphere.constituents[0].profile.exponential.scale_height_m: "
         "is 0; must be"},
        {"\"rayleigh\"", "{\"henyey_greenstein\": {\"g\": 1}}",
         "t.json:7:44: atmosphere.constituents[0].phase.henyey_greenstein.g: is 1; must be"},
        {"\"rayleigh\"", "{\"table\": [[0, 0], [180, 0]]}",
         "t.json:7:26: atmosphere.constituents[0].phase.table: sums to 0; must"},
        {"\"rayleigh\"", "{\"table\": [[0, 1], [181, 0]]}",
         "t.json:7:36: atmosphere.constituents[0].phase.table[1][0]: is 181"},
        {"\"rayleigh\"", "{\"table\": [[0, 1], [18, -1]]}",
         "t.json:7:40: atmosphere.constituents[0].phase.table[1][1]: is -1"},
        {"\"latitude_deg\": 10", "\"latitude_deg\": 91",
         "t.json:10:33: views.one.camera.latitude_deg: is 91"},
    };
    ASSERT_ERRORS(state, cases);
}

// One thing of the sample's spheres replaced.
static void assert_spheres_error(struct fixture *f, const struct error_case *error)
{
    char spheres[1024] = SAMPLE_SPHERES;
    char *at = strstr(spheres, error->from);
    assert_non_null(at);
    char rest[1024];
    strcpy(rest, at + strlen(error->from));
    strcpy(at, error->to);
    strcat(spheres, rest);
    assert_errors(f, &(struct error_case){SAMPLE_AIR, spheres, error->message}, 1);
}

static void spheres_that_cannot_be_are_named(void **state)
{
    const struct error_case cases[] = {
        {"1.5", "0", "t.json:5:51: atmosphere.constituents[0].mie.refractive_index: is 0; must be"},
        {"0.001", "-1",
         "t.json:5:96: atmosphere.constituents[0].mie.absorption_index[1][1]: is -1"},
        {"0.2 }", "0 }",
         "t.json:6:79: atmosphere.constituents[0].mie.size.log_normal.effective_variance: is 0"},
        {"1e-6", "1e-4",
         "t.json:5:29: atmosphere.constituents[0].mie: the largest spheres measure "},
        {"log_normal", "gama",
         "t.json:6:13: atmosphere.constituents[0].mie.size.gama: unknown key; the nearest known "
         "one is \"gamma\""},
        {"0.5 } }", "0.5 }, \"number_density_per_m3\": 1 }",
         "t.json:5:29: atmosphere.constituents[0].mie: has 2 of the keys optical_depth, "},
        {"[[0, 1], [100000, 0]]", "[[0, 0]]",
         "t.json:5:29: atmosphere.constituents[0].mie: no number of these spheres has an optical "
         "depth"},
        {"\"optical_depth\": { \"at_nm\": 600, \"value\": 0.5 }", "\"number_density_per_m3\": 1e16",
         "t.json:5:29: atmosphere.constituents[0].mie: extinction is "},
        {"\"size\"", "\"phase_at_nm\": [500, 450], \"size\"",
         "t.json:6:24: atmosphere.constituents[0].mie.phase_at_nm[1]: is 450; must be a number > "
         "500"},
        {"\"size\"", "\"phase_at_nm\": [], \"size\"",
         "t.json:6:18: atmosphere.constituents[0].mie.phase_at_nm: is empty"},
        {"\"profile\"", "\"phase\": \"rayleigh\", \"profile\"",
         "t.json:8:3: atmosphere.constituents[0].phase: unknown key; the nearest known one is "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_spheres_error(*state, &cases[i]);
    }
}

static void phase_functions_by_wavelength_that_cannot_be_are_named(void **state)
{
    const struct error_case cases[] = {
        {"\"rayleigh\"", "{\"by_wavelength\": 4}",
         "t.json:7:34: atmosphere.constituents[0].phase.by_wavelength: is a number; must be a "
         "list"},
        {"\"rayleigh\"", "{\"by_wavelength\": []}",
         "t.json:7:34: atmosphere.constituents[0].phase.by_wavelength: is empty; must have a pair"},
        {"\"rayleigh\"", "{\"by_wavelength\": [[450, \"rayleigh\"], [450, \"rayleigh\"]]}",
         "t.json:7:55: atmosphere.constituents[0].phase.by_wavelength[1][0]: is 450; must be a "
         "number > 450"},
        {"\"rayleigh\"", "{\"by_wavelength\": [[450, {\"by_wavelength\": []}]]}",
         "t.json:7:42: atmosphere.constituents[0].phase.by_wavelength[0][1].by_wavelength: unknown "
         "key"},
        {"\"rayleigh\"", "{\"by_wavelngth\": []}",
         "t.json:7:17: atmosphere.constituents[0].phase.by_wavelngth: unknown key; the nearest "
         "known one is \"by_wavelength\""},
        {"\"rayleigh\" }",
         "\"rayleigh\" }, { \"scattering_per_m\": 1, \"profile\": \"uniform\", \"phase\": "
         "{\"by_wavelength\": [[1, \"rayleigh\"], [2, \"rayleigh\"], [3, \"rayleigh\"], [4, "
         "\"rayleigh\"], [5, \"rayleigh\"], [6, \"rayleigh\"], [7, \"rayleigh\"], [8, "
         "\"rayleigh\"], "
         "[9, \"rayleigh\"], [10, \"rayleigh\"], [11, \"rayleigh\"], [12, \"rayleigh\"], [13, "
         "\"rayleigh\"], [14, \"rayleigh\"], [15, \"rayleigh\"], [16, \"rayleigh\"]]}}",
         "t.json:7:30: atmosphere.constituents[1]: counts as 16 constituents, one for each phase "
         "function; there is room for 15 more of 16"},
    };
    ASSERT_ERRORS(state, cases);
}

static void files_that_could_be_fetched_are_refused(void **state)
{
    const struct error_case cases[] = {
        {"a.tif", "/vsicurl/http",
         "t.json:8:43: surface.layers[0].elevation: is \"/vsicurl/http\""},
        {"a.tif", "https://x.org/a.tif", "t.json:8:43: surface.layers[0].elevation: is \"https"},
        {"a.tif", "NETCDF:a.nc:z", "t.json:8:43: surface.layers[0].elevation: is \"NETCDF"},
        {"a.tif", "", "t.json:8:43: surface.layers[0].elevation: has 0 bytes"},
        {"1e-5", "{\"file\": \"no.csv\"}",
         "t.json:5:51: atmosphere.constituents[0].scattering_per_m.file: there is no file "},
        {"1e-5", "{\"file\": \"/vsizip/a.csv\"}",
         "t.json:5:51: atmosphere.constituents[0].scattering_per_m.file: is \"/vsizip/a.csv\""},
    };
    ASSERT_ERRORS(state, cases);
}

static void faults_of_bodies_are_told(void **state)
{
    const struct error_case cases[] = {
        {"2e6", "0", "t.json:13:45: bodies[0].radius_m: is 0; must be a number >= 1"},
        {"4e8", "8471000",
         "t.json:13:64: bodies[0].distance_m: is 8471000; must be above 8471000: the body would "
         "reach into the planet or its air"},
        {"4e8", "1e14", "t.json:13:64: bodies[0].distance_m: is 1e+14; must be"},
        {"\"name\": \"Moon\", ", "", "t.json:13:15: bodies[0].name: is missing"},
        {"\"name\": \"Moon\"", "\"name\": \"comment\"",
         "t.json:13:25: bodies[0].name: must have at most 64 bytes and not be \"comment\""},
        {"0.1 } ]", "-0.1 } ]", "t.json:14:25: bodies[0].geometric_albedo: is -0.1; must be"},
        {"0.1 } ]", "0.1, \"phase_law\": \"moon\" } ]",
         "t.json:14:43: bodies[0].phase_law: is \"moon\"; the nearest known word"},
        {"0.1 } ]",
         "0.1 }, {\"name\": \"Moon\", \"radius_m\": 1, \"distance_m\": 1e9, "
         "\"geometric_albedo\": 0} ]",
         "t.json:14:41: bodies[1].name: is the name of an earlier body"},
        {"\"Moon\": {", "\"Mon\": {",
         "t.json:12:17: views.one.bodies.Mon: unknown key; the nearest known one is \"Moon\""},
        {"{ \"elevation_deg\": 20, \"azimuth_deg\": 90 }", "{ \"elevation_deg\": 20 }",
         "t.json:12:25: views.one.bodies.Moon.azimuth_deg: is missing; must be a number"},
        {"\"azimuth_deg\": 90", "\"longitude_deg\": 90",
         "t.json:12:25: views.one.bodies.Moon: must have one of elevation_deg with azimuth_deg"},
        {"{ \"elevation_deg\": 20, \"azimuth_deg\": 90 }", "{}",
         "t.json:12:25: views.one.bodies.Moon: must have one of elevation_deg with azimuth_deg"},
        {"\"elevation_deg\": 20, \"azimuth_deg\": 90", "\"offset_from_sun_deg\": [1]",
         "t.json:12:50: views.one.bodies.Moon.offset_from_sun_deg: must be a pair [right, up]"},
        {"\"azimuth_deg\": 90", "\"azimuth_deg\": 90, \"distance_m\": 7e6",
         "t.json:12:81: views.one.bodies.Moon.distance_m: is 7000000; must be above 8471000"},
    };
    ASSERT_ERRORS(state, cases);
}

static void faults_of_the_ocean_are_told(void **state)
{
    const struct error_case cases[] = {
        {"0.1 },\n  \"atm", "0.1, \"gravity_m_s2\": -1 },\n  \"atm",
         "t.json:3:74: planet.gravity_m_s2: is -1; must be "},
        {"\"views\"", "\"ocean\": { \"wave\": {} }, \"views\"",
         "t.json:9:14: ocean.wave: unknown key; the nearest known one is \"waves\""},
        {"\"views\"", "\"ocean\": { \"waves\": { \"wind_m_s\": 99 } }, \"views\"",
         "t.json:9:37: ocean.waves.wind_m_s: is 99; must be "},
        {"\"views\"", "\"ocean\": { \"waves\": { \"count\": 2.5 } }, \"views\"",
         "t.json:9:34: ocean.waves.count: is 2.5; must be a whole number"},
        {"\"views\"", "\"ocean\": { \"waves\": { \"spectrum\": \"x\" } }, \"views\"",
         "t.json:9:37: ocean.waves.spectrum: "},
        {"\"views\"", "\"ocean\": { \"water\": { \"refractive_index\": 1 } }, \"views\"",
         "t.json:9:45: ocean.water.refractive_index: is 1; must be "},
        {"\"views\"", "\"ocean\": { \"bed\": { \"albedo\": [[500, 2]] } }, \"views\"",
         "t.json:9:40: ocean.bed.albedo[0][1]: is 2; must be "},
    };
    ASSERT_ERRORS(state, cases);
}

static void every_truncation_is_one_error(void **state)
{
    struct fixture *f = *state;
    const size_t length = strlen(sample_scene) - 1; // without the last newline it is whole
    for (size_t n = 0; n < length; n++) {
        assert_int_equal(parse(f, sample_scene, n), TRL_ERROR_INVALID);
        assert_int_equal(f->log.errors, 1);
        assert_memory_equal(f->log.error, "t.json:", 7);
    }
    assert_int_equal(parse(f, sample_scene, length), TRL_OK);
}

static void assert_text_is_refused(struct fixture *f, const char *text, const char *message)
{
    assert_int_equal(parse(f, text, strlen(text)), TRL_ERROR_INVALID);
    if (f->log.errors != 1 || strncmp(f->log.error, message, strlen(message)) != 0) {
        fail_msg("got \"%s\"", f->log.error);
    }
}

static void other_roots_are_refused(void **state)
{
    struct fixture *f = *state;
    assert_text_is_refused(f, "", "t.json:1:1: not JSON: ");
    assert_text_is_refused(f, "[]", "t.json:1:1: is a list; must be an object");
    assert_text_is_refused(f, "\n {}", "t.json:2:2: terrella: is missing");
    assert_text_is_refused(f, "{} {}", "t.json:1:4: not JSON: ");
}

static void sizes_are_bounded(void **state)
{
    struct fixture *f = *state;
    const size_t size = 3000000;
    char *text = malloc(size);
    assert_non_null(text);
    memset(text, '[', 1000);
    assert_int_equal(parse(f, text, 1000), TRL_ERROR_INVALID);
    assert_string_equal(f->log.error, "t.json:1:1: nested more than 64 deep");
    for (size_t i = 0; i < size; i += 2) {
        memcpy(text + i, i == 0 ? "[0" : ",0", 2);
    }
    assert_int_equal(parse(f, text, size), TRL_ERROR_INVALID);
    assert_string_equal(f->log.error, "t.json:1:1: more than 1000000 values");
    free(text);

    // One view and one constituent too many.
    char many[8192] = "[";
    for (int i = 0; i < 17; i++) {
        strcat(many, i > 0 ? ",{\"profile\":\"uniform\"}" : "{\"profile\":\"uniform\"}");
    }
    char scene[9000];
    snprintf(scene, sizeof scene,
             "{\"terrella\":1,\"star\":{\"spectral_irradiance\":1},\"planet\":{\"radius_m\":9,"
             "\"ground_albedo\":0},\"atmosphere\":{\"height_m\":9,\"constituents\":%s]}}",
             many);
    assert_text_is_refused(f, scene,
                           "t.json:1:132: atmosphere.constituents: has 17 elements; at most 16");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(syntax_errors_have_their_place),
        cmocka_unit_test(unknown_keys_are_named_with_the_nearest),
        cmocka_unit_test(missing_and_wrongly_typed_values_are_named),
        cmocka_unit_test(numbers_out_of_range_say_what_is_allowed),
        cmocka_unit_test(spheres_that_cannot_be_are_named),
        cmocka_unit_test(phase_functions_by_wavelength_that_cannot_be_are_named),
        cmocka_unit_test(files_that_could_be_fetched_are_refused),
        cmocka_unit_test(faults_of_bodies_are_told),
        cmocka_unit_test(faults_of_the_ocean_are_told),
        cmocka_unit_test(every_truncation_is_one_error),
        cmocka_unit_test(other_roots_are_refused),
        cmocka_unit_test(sizes_are_bounded),
    };
    return cmocka_run_group_tests(tests, make_fixture, free_fixture);
}
