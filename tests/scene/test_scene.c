// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Every form that a scene file may have, and what it means.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "log.h"
#include "sample.h"
#include "scene/scene.h"

#define PI 3.14159265358979323846

static trl_scene *parse(struct fixture *f, const char *text)
{
    trl_scene *scene = NULL;
    if (trl_scene_parse(f->ctx, text, strlen(text), "t.json", ".", &scene) != TRL_OK) {
        fail_msg("%s", f->log.error);
    }
    return scene;
}

// The sample with one thing replaced; only what matters is compared.
static trl_scene *parse_with(struct fixture *f, const char *from, const char *to)
{
    char *text = sample_replace(from, to);
    assert_non_null(text);
    trl_scene *scene = parse(f, text);
    free(text);
    return scene;
}

static void assert_near(double got, double wanted)
{
    if (!(fabs(got - wanted) <= 1e-13 * fabs(wanted))) { // a few roundings
        fail_msg("got %.17g, wanted %.17g", got, wanted);
    }
}

static void sample_is_read_whole(void **state)
{
    trl_scene *s = parse(*state, sample_scene);
    assert_string_equal(trl_scene_name(s), "Test");
    assert_near(trl_scene_ground_radius_m(s), 6371000);
    assert_near(trl_scene_top_radius_m(s), 6471000);
    assert_near(s->medium.star_irradiance.constant, 1.5);
    assert_near(s->medium.star_angular_radius_rad, 0.25 * PI / 180);
    assert_true(s->medium.star_corona == 0);
    assert_near(s->medium.ground_albedo.constant, 0.1);
    assert_int_equal(s->medium.constituent_count, 1);
    assert_string_equal(s->medium.constituents[0].name, "air");
    assert_near(s->medium.constituents[0].scattering_per_m.constant, 1e-5);
    assert_int_equal(s->medium.constituents[0].profile.kind, PROFILE_EXPONENTIAL);
    assert_near(s->medium.constituents[0].profile.scale_height_m, 8000);
    assert_int_equal(s->medium.constituents[0].phase.kind, PHASE_RAYLEIGH);
    trl_scene_destroy(&s);
    assert_null(s);
    trl_scene_destroy(&s);
}

static void bodies_and_their_places_are_read(void **state)
{
    trl_scene *s = parse(*state, sample_scene);
    assert_int_equal(trl_scene_body_count(s), 1);
    assert_string_equal(trl_scene_body_name(s, 0), "Moon");
    assert_null(trl_scene_body_name(s, 1));
    assert_near(s->bodies[0].radius_m, 2e6);
    assert_near(s->bodies[0].distance_m, 4e8);
    assert_near(s->bodies[0].geometric_albedo.constant, 0.1);
    assert_int_equal(s->bodies[0].phase_law, BODY_LOMMEL_SEELIGER);
    assert_int_equal(s->views[0].bodies[0].mode, TRL_BODY_LOCAL);
    assert_near(s->views[0].bodies[0].latitude_or_elevation_rad, 20 * PI / 180);
    assert_near(s->views[0].bodies[0].longitude_or_azimuth_rad, 90 * PI / 180);
    assert_true(s->views[0].bodies[0].distance_m == 0);
    assert_int_equal(s->views[0].bodies[1].mode, TRL_BODY_ABSENT);
    trl_scene_destroy(&s);
    s = parse_with(*state, "\"geometric_albedo\": 0.1",
                   "\"geometric_albedo\": 0.1, \"phase_law\": \"lunar\"");
    assert_int_equal(s->bodies[0].phase_law, BODY_LUNAR);
    trl_scene_destroy(&s);
    s = parse_with(*state, "\"elevation_deg\": 20, \"azimuth_deg\": 90",
                   "\"offset_from_sun_deg\": [3, -6], \"distance_m\": 5e8");
    assert_int_equal(s->views[0].bodies[0].mode, TRL_BODY_FROM_SUN);
    assert_near(s->views[0].bodies[0].longitude_or_azimuth_rad, 3 * PI / 180);
    assert_near(s->views[0].bodies[0].latitude_or_elevation_rad, -6 * PI / 180);
    assert_near(s->views[0].bodies[0].distance_m, 5e8);
    trl_scene_destroy(&s);
    s = parse_with(*state, "{ \"elevation_deg\": 20, \"azimuth_deg\": 90 }",
                   "{ \"latitude_deg\": 2, \"longitude_deg\": -90 }");
    assert_int_equal(s->views[0].bodies[0].mode, TRL_BODY_SUBPOINT);
    assert_near(s->views[0].bodies[0].longitude_or_azimuth_rad, -90 * PI / 180);
    trl_scene_destroy(&s);
}

static void optional_parts_may_be_missing(void **state)
{
    trl_scene *s = parse(*state, "{\"terrella\":1,\"star\":{\"spectral_irradiance\":1},"
                                 "\"planet\":{\"radius_m\":100,\"ground_albedo\":0}}");
    assert_string_equal(trl_scene_name(s), "t.json");
    assert_true(trl_scene_top_radius_m(s) > 100);
    assert_int_equal(s->medium.constituent_count, 0);
    assert_int_equal(trl_scene_layer_count(s), 0);
    assert_int_equal(trl_scene_view_count(s), 0);
    trl_view view;
    assert_int_equal(trl_scene_view(s, NULL, &view), TRL_OK);
    assert_near(view.altitude_m, 300);
    trl_scene_destroy(&s);
    s = parse_with(*state, "[\n    { \"name\"", "[ { \"name\"");
    trl_scene_destroy(&s);
}

static void missing_coefficients_are_zero_and_need_no_phase(void **state)
{
    trl_scene *s = parse(*state, "{\"terrella\":1,\"star\":{\"spectral_irradiance\":1},\"planet\":"
                                 "{\"radius_m\":100,\"ground_albedo\":0},\"atmosphere\":{"
                                 "\"height_m\":9,\"constituents\":[{\"profile\":\"uniform\"}]}}");
    const struct constituent *c = &s->medium.constituents[0];
    assert_true(spectrum_at(&c->scattering_per_m, 500) == 0);
    assert_true(spectrum_at(&c->absorption_per_m, 500) == 0);
    assert_int_equal(c->profile.kind, PROFILE_UNIFORM);
    assert_int_equal(c->phase.kind, PHASE_ISOTROPIC);
    trl_scene_destroy(&s);
}

static void every_spectrum_form_is_read(void **state)
{
    const struct {
        const char *json;
        enum spectrum_kind kind;
        double at_550;
    } forms[] = {
        {"2e-5", SPECTRUM_CONSTANT, 2e-5},
        {"[[500, 1e-5], [600, 3e-5]]", SPECTRUM_TABLE, 2e-5},
        {"{\"power_law\": {\"at_nm\": 275, \"value\": 8e-5, \"exponent\": -2}}", SPECTRUM_POWER_LAW,
         2e-5},
        {"{\"rayleigh\": {\"refractive_index\": 1.00027, \"number_density_per_m3\": 2.5e25}, "
         "\"comment\": \"air\"}",
         SPECTRUM_RAYLEIGH, 1.0542226794701448e-05},
        {"{\"blackbody\": {\"temperature_K\": 5778, \"total_W_m2\": 0}}", SPECTRUM_BLACKBODY, 0},
    };
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        trl_scene *s = parse_with(*state, "1e-5", forms[i].json);
        const struct spectrum *spectrum = &s->medium.constituents[0].scattering_per_m;
        assert_int_equal(spectrum->kind, forms[i].kind);
        const double got = spectrum_at(spectrum, 550);
        assert_true(fabs(got - forms[i].at_550) <= 1e-11 * forms[i].at_550);
        trl_scene_destroy(&s);
    }
}

static void every_profile_form_is_read(void **state)
{
    const char *old = "{ \"exponential\": { \"scale_height_m\": 8000 } }";
    const struct {
        const char *json;
        double at_7500_m;
    } forms[] = {
        {"\"uniform\"", 1},
        {"{\"exponential\": {\"scale_height_m\": 7500}}", 0.36787944117144233},
        {"{\"tent\": {\"centre_m\": 5000, \"half_width_m\": 5000}}", 0.5},
        {"{\"table\": [[0, 2], [10000, 0]]}", 0.5},
    };
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        trl_scene *s = parse_with(*state, old, forms[i].json);
        assert_near(profile_density(&s->medium.constituents[0].profile, 7500), forms[i].at_7500_m);
        trl_scene_destroy(&s);
    }
}

static void every_phase_form_is_read(void **state)
{
    const struct {
        const char *json;
        enum phase_kind kind;
        double first_moment;
    } forms[] = {
        {"\"rayleigh\"", PHASE_RAYLEIGH, 0},
        {"\"isotropic\"", PHASE_ISOTROPIC, 0},
        {"{\"henyey_greenstein\": {\"g\": 0.5}}", PHASE_HENYEY_GREENSTEIN, 0.5},
        // 3 / (2 (2 + g^2)) (8/5 g + 2/5 g^3) at g = 1/2
        {"{\"cornette_shanks\": {\"g\": 0.5}}", PHASE_CORNETTE_SHANKS, 17.0 / 30},
        // 1 + cos is not linear in the angle; a constant is.
        {"{\"table\": [[0, 3], [180, 3]]}", PHASE_TABLE, 0},
    };
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        trl_scene *s = parse_with(*state, "\"rayleigh\"", forms[i].json);
        const struct phase *phase = &s->medium.constituents[0].phase;
        assert_int_equal(phase->kind, forms[i].kind);
        double moments[2];
        phase_moments(phase, 1, moments);
        assert_true(fabs(moments[0] - 1) < 1e-13);
        assert_true(fabs(moments[1] - forms[i].first_moment) < 1e-13);
        trl_scene_destroy(&s);
    }
}

// Coefficient times phase function, summed over the constituents of the first name.
static double source_at(const struct medium *medium, double nm, double cosine)
{
    double sum = 0;
    for (size_t i = 0; i < medium->constituent_count; i++) {
        const struct constituent *c = &medium->constituents[i];
        sum += spectrum_at(&c->scattering_per_m, nm) * phase_value(&c->phase, cosine);
    }
    return sum;
}

static void phase_functions_by_wavelength_are_linear_between_and_constant_outside(void **state)
{
    trl_scene *s = parse_with(
        *state, SAMPLE_AIR,
        "\"scattering_per_m\": "
        "[[400, 1e-5], [700, 4e-5]], \"absorption_per_m\": 1e-6,"
        "\"profile\": {\"table\": [[0, 1], [9, 0]]}, \"phase\": {\"by_wavelength\": [[450, "
        "\"isotropic\"], [550, {\"henyey_greenstein\": {\"g\": 0.5}}], [600, "
        "\"rayleigh\"]]}");
    const struct medium *m = &s->medium;
    assert_int_equal(m->constituent_count, 3);
    assert_string_equal(m->constituents[1].name, "air, 550 nm");
    const struct phase isotropic = {.kind = PHASE_ISOTROPIC}, rayleigh = {.kind = PHASE_RAYLEIGH};
    const struct phase peaked = {.kind = PHASE_HENYEY_GREENSTEIN, .g = 0.5};
    for (double mu = -1; mu <= 1; mu += 0.5) {
        const double a = phase_value(&isotropic, mu), b = phase_value(&peaked, mu);
        const double c = phase_value(&rayleigh, mu);
        assert_near(source_at(m, 380, mu), 1e-5 * a);
        assert_near(source_at(m, 450, mu), 1.5e-5 * a);
        assert_near(source_at(m, 475, mu), 1.75e-5 * (0.75 * a + 0.25 * b));
        assert_near(source_at(m, 550, mu), 2.5e-5 * b);
        assert_near(source_at(m, 590, mu), 2.9e-5 * (0.2 * b + 0.8 * c));
        assert_near(source_at(m, 800, mu), 4e-5 * c);
    }
    for (double nm = 370; nm < 830; nm += 13) {
        double absorption = 0;
        for (size_t i = 0; i < 3; i++) {
            absorption += spectrum_at(&m->constituents[i].absorption_per_m, nm);
            assert_near(profile_density(&m->constituents[i].profile, 3), 2.0 / 3);
        }
        assert_near(absorption, 1e-6);
    }
    trl_scene_destroy(&s);
}

static void spheres_have_the_optical_depth_that_is_asked_for(void **state)
{
    trl_scene *s = parse_with(*state, SAMPLE_AIR, SAMPLE_SPHERES);
    const struct medium *m = &s->medium;
    assert_int_equal(m->constituent_count, 3);
    double depth = 0, scattering[2] = {0}, absorption[2] = {0};
    for (size_t i = 0; i < 3; i++) {
        const struct constituent *c = &m->constituents[i];
        depth += profile_column_m(&c->profile, 100000) *
                 (spectrum_at(&c->scattering_per_m, 600) + spectrum_at(&c->absorption_per_m, 600));
        scattering[0] += spectrum_at(&c->scattering_per_m, 450);
        absorption[0] += spectrum_at(&c->absorption_per_m, 450);
        scattering[1] += spectrum_at(&c->scattering_per_m, 650);
        absorption[1] += spectrum_at(&c->absorption_per_m, 650);
        double moments[2];
        phase_moments(&c->phase, 1, moments);
        assert_true(fabs(moments[0] - 1) < 1e-13 && moments[1] > 0.6 && moments[1] < 0.85);
    }
    // Linear between wavelengths 20 nm apart; extinction is nearly flat.
    assert_true(fabs(depth - 0.5) < 1e-3);
    // Ten times the absorption index: about that much more absorption, less what is saturated.
    const double ratio = absorption[0] / absorption[1];
    assert_true(ratio > 6 && ratio < 12);
    assert_true(scattering[0] > 0 && scattering[0] < scattering[1]);
    trl_scene_destroy(&s);
}

static void comments_are_allowed_in_any_object(void **state)
{
    trl_scene *s =
        parse_with(*state, "\"scale_height_m\"", "\"comment\": \"Elek 2010\", \"scale_height_m\"");
    trl_scene_destroy(&s);
    s = parse_with(*state, "{ \"one\"", "{ \"comment\": \"c\", \"one\"");
    assert_int_equal(trl_scene_view_count(s), 1);
    trl_scene_destroy(&s);
}

static void detail_is_read_and_has_defaults(void **state)
{
    trl_scene *s = parse_with(*state, "\"layers\":", "\"layers\":");
    assert_true(s->detail.roughness == 0 && s->detail.albedo_variation == 0);
    trl_scene_destroy(&s);
    s = parse_with(*state, "\"layers\":", "\"detail\": {}, \"layers\":");
    assert_near(s->detail.roughness, 1);
    assert_near(s->detail.albedo_variation, 0.2);
    assert_near(s->detail.smallest_m, 0.03);
    trl_scene_destroy(&s);
    s = parse_with(*state, "\"layers\":",
                   "\"detail\": {\"roughness\": 2, \"albedo_variation\": 0, "
                   "\"smallest_m\": 5}, \"layers\":");
    assert_near(s->detail.roughness, 2);
    assert_true(s->detail.albedo_variation == 0);
    assert_near(s->detail.smallest_m, 5);
    assert_false(s->detail.rock.is_there);
    trl_scene_destroy(&s);
    s = parse_with(*state, "\"layers\":",
                   "\"detail\": {\"rock\": {\"albedo\": 0.2, \"slope_deg\": 45}}, \"layers\":");
    assert_true(s->detail.rock.is_there);
    assert_near(s->detail.rock.slope_deg, 45);
    assert_near(s->detail.rock.feather_deg, 17);
    assert_near(s->detail.rock.tint, 0.5);
    trl_scene_destroy(&s);
}

static void an_ocean_is_read_and_has_defaults(void **state)
{
    trl_scene *scene = parse_with(*state, "\"views\"", "\"views\"");
    assert_false(scene->ocean.is_there);
    assert_near(scene->ocean.gravity_m_s2, 9.81);
    trl_scene_destroy(&scene);
    scene = parse_with(*state, "\"views\"", "\"ocean\": {}, \"views\"");
    assert_true(scene->ocean.is_there);
    assert_near(scene->ocean.waves.wind_m_s, 8);
    assert_near(scene->ocean.waves.fetch_m, 3e5);
    assert_int_equal(scene->ocean.waves.count, 60);
    assert_true(scene->ocean.waves.mean_square_slope < 0 && scene->ocean.bed.depth_m < 0);
    trl_scene_destroy(&scene);
    scene = parse_with(
        *state, "\"views\"",
        "\"ocean\": { \"waves\": { \"fetch_km\": 20, \"spectrum\": \"pierson_moskowitz\","
        " \"wind_from_deg\": 90, \"seed\": 4294967295 },"
        " \"water\": { \"kind\": \"fresh\", \"absorption_per_m\": [[400, 0.1], [500, 0.2]] },"
        " \"bed\": { \"depth_m\": 3, \"albedo\": 0.5 } }, \"views\"");
    assert_near(scene->ocean.waves.fetch_m, 2e4);
    assert_near(scene->ocean.waves.wind_from_rad, 90 * 3.14159265358979323846 / 180);
    assert_int_equal(scene->ocean.waves.spectrum, OCEAN_PIERSON_MOSKOWITZ);
    assert_int_equal(scene->ocean.waves.seed, 4294967295);
    assert_int_equal(scene->ocean.water.kind, OCEAN_FRESH);
    assert_true(scene->ocean.water.has_absorption && !scene->ocean.water.has_scattering);
    assert_near(spectrum_at(&scene->ocean.water.absorption_per_m, 450), 0.15);
    assert_near(scene->ocean.bed.depth_m, 3);
    assert_near(spectrum_at(&scene->ocean.bed.albedo, 550), 0.5);
    trl_scene_destroy(&scene);
}

static void layers_are_read(void **state)
{
    trl_scene *s = parse_with(
        *state, "{ \"elevation\": \"a.tif\" }",
        "{\"elevation\": \"a.tif\", \"scale\": 0.5, \"offset_m\": -3, \"feather_deg\": 2, "
        "\"optional\": true, \"sea_bed\": true, \"name\": \"Alps\"}, {\"colour\": \"b/c.png\"}, "
        "{\"water\": \"/w.tif\"}, {\"lights\": \"l.tif\", \"radiance_cd_m2\": 7}, "
        "{\"snow\": \"s.tif\"}, {\"snow\": \"t.tif\", \"albedo\": [[400, 0.5], [500, 0.7]]}");
    assert_int_equal(trl_scene_layer_count(s), 6);
    assert_string_equal(trl_scene_layer_name(s, 0), "Alps");
    assert_near(s->layers[0].scale, 0.5);
    assert_near(s->layers[0].offset_m, -3);
    assert_near(s->layers[0].feather_deg, 2);
    assert_true(s->layers[0].is_optional && !s->layers[1].is_optional);
    assert_true(s->layers[0].has_bed && !s->layers[1].has_bed);
    assert_int_equal(s->layers[1].kind, LAYER_COLOUR);
    assert_string_equal(trl_scene_layer_name(s, 1), "b/c.png");
    assert_string_equal(trl_scene_layer_path(s, 1), "/nonexistent/terrella-data/b/c.png");
    assert_false(trl_scene_layer_is_present(s, 1));
    assert_string_equal(trl_scene_layer_path(s, 2), "/w.tif");
    assert_near(s->layers[3].radiance_cd_m2, 7);
    assert_int_equal(s->layers[4].kind, LAYER_SNOW);
    assert_near(spectrum_at(&s->layers[4].albedo, 600), 0.9);
    assert_near(spectrum_at(&s->layers[5].albedo, 450), 0.6);
    assert_null(trl_scene_layer_name(s, 6));
    assert_null(trl_scene_layer_path(s, 6));
    assert_false(trl_scene_layer_is_present(s, 6));
    trl_scene_destroy(&s);
}

static void views_are_read(void **state)
{
    struct fixture *f = *state;
    trl_scene *s = parse_with(
        f, "{ \"one\": {",
        "{ \"two\": {\"camera\": {\"latitude_deg\": -90, \"longitude_deg\": 0, "
        "\"height_above_ground_m\": 2, \"heading_deg\": 90, \"pitch_deg\": -45, \"roll_deg\": 180, "
        "\"vertical_fov_deg\": 60}, \"sun\": {\"subsolar_latitude_deg\": 18, "
        "\"subsolar_longitude_deg\": 36}, \"exposure\": {\"ev100\": 15, \"bias_ev\": -1, "
        "\"tone\": \"exponential\"}}, \"one\": {");
    assert_int_equal(trl_scene_view_count(s), 2);
    assert_string_equal(trl_scene_view_name(s, 1), "one");
    assert_null(trl_scene_view_name(s, 2));
    trl_view v;
    assert_int_equal(trl_scene_view(s, NULL, &v), TRL_OK); // the first one
    assert_near(v.latitude_rad, -PI / 2);
    assert_int_equal(v.altitude_mode, TRL_ALTITUDE_GROUND);
    assert_near(v.altitude_m, 2);
    assert_near(v.heading_rad, PI / 2);
    assert_near(v.pitch_rad, -PI / 4);
    assert_near(v.roll_rad, PI);
    assert_near(v.vertical_fov_rad, PI / 3);
    assert_int_equal(v.sun_mode, TRL_SUN_SUBSOLAR);
    assert_near(v.sun_latitude_or_elevation_rad, PI / 10);
    assert_near(v.sun_longitude_or_azimuth_rad, PI / 5);
    assert_true(v.has_fixed_exposure);
    assert_near(v.exposure_ev100, 15);
    assert_near(v.exposure_bias_ev, -1);
    assert_int_equal(v.tone_curve, TRL_TONE_EXPONENTIAL);
    assert_int_equal(trl_scene_view(s, "one", &v), TRL_OK);
    assert_int_equal(v.sun_mode, TRL_SUN_LOCAL);
    assert_near(v.sun_longitude_or_azimuth_rad, PI);
    assert_true(v.pitch_rad == 0 && !v.has_fixed_exposure);
    assert_int_equal(trl_scene_view(s, "three", &v), TRL_ERROR_INVALID);
    assert_non_null(strstr(f->log.error, "\"three\""));
    assert_non_null(strstr(f->log.error, "two, one"));
    trl_scene_destroy(&s);
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void files_are_found_beside_the_scene(void **state)
{
    struct fixture *f = *state;
    char folder[] = "/tmp/terrella-scene-XXXXXX";
    assert_non_null(mkdtemp(folder));
    char scene_path[256];
    char csv_path[256];
    char raster_path[256];
    snprintf(scene_path, sizeof scene_path, "%s/s.json", folder);
    snprintf(csv_path, sizeof csv_path, "%s/x.csv", folder);
    snprintf(raster_path, sizeof raster_path, "%s/a.tif", folder);
    char *text = sample_replace("1e-5", "{\"file\": \"x.csv\"}");
    assert_non_null(text);
    write_text(scene_path, text);
    write_text(csv_path, "nm,value\n500,1e-5\n600,3e-5\n");
    write_text(raster_path, "not yet a raster");
    free(text);
    trl_scene *s = NULL;
    assert_int_equal(trl_scene_load(f->ctx, scene_path, &s), TRL_OK);
    assert_near(spectrum_at(&s->medium.constituents[0].scattering_per_m, 550), 2e-5);
    assert_string_equal(trl_scene_layer_path(s, 0), raster_path);
    assert_true(trl_scene_layer_is_present(s, 0));
    trl_scene_destroy(&s);

    // What a file says is checked like what the scene says, at the place that names it.
    write_text(csv_path, "500,1e-5\n600,-1\n");
    assert_int_equal(trl_scene_load(f->ctx, scene_path, &s), TRL_ERROR_INVALID);
    assert_non_null(strstr(f->log.error, "s.json:5:42: atmosphere.constituents[0]."
                                         "scattering_per_m: is -1 at 600 nm"));
    assert_int_equal(unlink(raster_path), 0);
    assert_int_equal(unlink(csv_path), 0);
    assert_int_equal(unlink(scene_path), 0);
    assert_int_equal(rmdir(folder), 0);
    assert_int_equal(trl_scene_load(f->ctx, scene_path, &s), TRL_ERROR_IO);
    assert_null(s);
}

static void null_arguments_are_refused(void **state)
{
    struct fixture *f = *state;
    trl_scene *s = NULL;
    assert_int_equal(trl_scene_parse(f->ctx, NULL, 0, "t", ".", &s), TRL_ERROR_INVALID);
    assert_int_equal(trl_scene_parse(f->ctx, "{}", 2, NULL, ".", &s), TRL_ERROR_INVALID);
    assert_int_equal(trl_scene_parse(f->ctx, "{}", 2, "t", NULL, &s), TRL_ERROR_INVALID);
    assert_int_equal(trl_scene_parse(f->ctx, "{}", 2, "t", ".", NULL), TRL_ERROR_INVALID);
    assert_int_equal(trl_scene_parse(NULL, "{}", 2, "t", ".", &s), TRL_ERROR_INVALID);
    assert_int_equal(trl_scene_load(f->ctx, NULL, &s), TRL_ERROR_INVALID);
    assert_int_equal(trl_scene_load(f->ctx, "t", NULL), TRL_ERROR_INVALID);
    trl_scene_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sample_is_read_whole),
        cmocka_unit_test(bodies_and_their_places_are_read),
        cmocka_unit_test(optional_parts_may_be_missing),
        cmocka_unit_test(missing_coefficients_are_zero_and_need_no_phase),
        cmocka_unit_test(every_spectrum_form_is_read),
        cmocka_unit_test(every_profile_form_is_read),
        cmocka_unit_test(every_phase_form_is_read),
        cmocka_unit_test(phase_functions_by_wavelength_are_linear_between_and_constant_outside),
        cmocka_unit_test(spheres_have_the_optical_depth_that_is_asked_for),
        cmocka_unit_test(comments_are_allowed_in_any_object),
        cmocka_unit_test(detail_is_read_and_has_defaults),
        cmocka_unit_test(an_ocean_is_read_and_has_defaults),
        cmocka_unit_test(layers_are_read),
        cmocka_unit_test(views_are_read),
        cmocka_unit_test(files_are_found_beside_the_scene),
        cmocka_unit_test(null_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, make_fixture, free_fixture);
}
