// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The atmosphere as the viewer's keys and a saved scene file change it.
#include "viewer/edit.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const char SCENE[] =
    "{\"terrella\": 1, \"star\": {\"spectral_irradiance\": 1.5},"
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.3},"
    " \"atmosphere\": {\"height_m\": 60000, \"constituents\": ["
    "  {\"name\": \"dust\", \"scattering_per_m\": 1e-6, \"profile\": \"uniform\","
    "   \"phase\": {\"by_wavelength\": [[450, {\"henyey_greenstein\": {\"g\": 0.6}}],"
    "                                 [650, {\"henyey_greenstein\": {\"g\": 0.5}}]]}},"
    "  {\"name\": \"air\", \"scattering_per_m\": %s,"
    "   \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}, \"phase\": \"rayleigh\"}]}}";

struct setup {
    trl_context *ctx;
    trl_scene *scene;
    trl_renderer *renderer;
    struct edit edit;
    char path[64];
    int errors;
};

static void count_error(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    (void)item;
    (void)message;
    struct setup *s = user;
    s->errors += level == TRL_LOG_ERROR;
}

static void write_scene(const struct setup *s, const char *scattering)
{
    FILE *file = fopen(s->path, "w");
    assert_non_null(file);
    fprintf(file, SCENE, scattering);
    assert_int_equal(fclose(file), 0);
}

static int set_up(void **state)
{
    struct setup *s = calloc(1, sizeof *s);
    *state = s;
    snprintf(s->path, sizeof s->path, "/tmp/terrella-edit-%ld.json", (long)getpid());
    write_scene(s, "1e-6");
    trl_context_desc desc = trl_context_desc_default();
    desc.cache_dir = "";
    desc.log = count_error;
    desc.log_user = s;
    assert_int_equal(trl_context_create(&desc, &s->ctx), TRL_OK);
    assert_int_equal(trl_scene_load(s->ctx, s->path, &s->scene), TRL_OK);
    trl_renderer_desc renderer = trl_renderer_desc_default();
    renderer.scene = s->scene;
    const trl_result result = trl_renderer_create(s->ctx, &renderer, &s->renderer);
    if (result == TRL_ERROR_UNSUPPORTED && !getenv("TRL_REQUIRE_GPU")) {
        exit(77);
    }
    assert_int_equal(result, TRL_OK);
    edit_init(&s->edit, s->ctx, s->renderer, s->path, s->scene);
    return 0;
}

static int tear_down(void **state)
{
    struct setup *s = *state;
    edit_finish(&s->edit);
    trl_renderer_destroy(&s->renderer);
    trl_scene_destroy(&s->scene);
    trl_context_destroy(&s->ctx);
    unlink(s->path);
    free(s);
    return 0;
}

static void expect_text(const struct setup *s, const char *wanted)
{
    char text[EDIT_TEXT_MAX];
    edit_describe(&s->edit, text);
    assert_string_equal(text, wanted);
}

static void keys_change_one_thing_of_the_scene_after_the_other(void **state)
{
    struct setup *s = *state;
    expect_text(s, "");
    edit_choose_next(&s->edit);
    expect_text(s, "dust x 1, g 0.60");
    assert_true(edit_scale(&s->edit, 2));
    assert_false(trl_renderer_is_settled(s->renderer));
    expect_text(s, "dust x 2, g 0.60");
    assert_true(s->edit.changes[1].amount == 2); // its other half
    assert_true(s->edit.changes[2].amount == 1);
    assert_true(edit_turn_asymmetry(&s->edit, 0.05));
    expect_text(s, "dust x 2, g 0.65");
    edit_choose_next(&s->edit);
    expect_text(s, "air x 1");
    assert_false(edit_turn_asymmetry(&s->edit, 0.05)); // Rayleigh has none
    assert_true(edit_scale(&s->edit, 1e9));
    expect_text(s, "air x 1e+03");
    edit_choose_next(&s->edit);
    expect_text(s, "dust x 2, g 0.65");
    assert_int_equal(s->errors, 0);
}

static void a_saved_file_is_followed_and_a_broken_one_is_not(void **state)
{
    struct setup *s = *state;
    assert_false(edit_follow_file(&s->edit));
    edit_choose_next(&s->edit);
    assert_true(edit_scale(&s->edit, 2));
    write_scene(s, "1.5e-6"); // its size differs, so a clock that ticks slowly does not matter
    assert_true(edit_follow_file(&s->edit));
    assert_true(edit_scene(&s->edit) != s->scene);
    expect_text(s, ""); // what the keys had changed is gone
    assert_false(edit_follow_file(&s->edit));
    write_scene(s, "\"broken\"");
    const trl_scene *before = edit_scene(&s->edit);
    assert_false(edit_follow_file(&s->edit));
    assert_int_equal(s->errors, 1); // said once
    assert_false(edit_follow_file(&s->edit));
    assert_int_equal(s->errors, 1);
    assert_ptr_equal(edit_scene(&s->edit), before);
    unlink(s->path);
    assert_false(edit_follow_file(&s->edit));
    write_scene(s, "2e-6");
    assert_true(edit_follow_file(&s->edit));
    assert_int_equal(s->errors, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(keys_change_one_thing_of_the_scene_after_the_other, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(a_saved_file_is_followed_and_a_broken_one_is_not, set_up,
                                        tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
