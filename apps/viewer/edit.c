// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "edit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const double least_amount = 1e-3;
static const double largest_amount = 1e3;
static const double largest_asymmetry = 0.98;

// When the file was written; a changed size counts too, for clocks that tick slowly. Negative when
// there is no file at the moment, as while some editors save.
static double read_stamp(const char *path)
{
    struct stat info;
    if (!path || stat(path, &info) != 0) {
        return -1.0;
    }
    return (double)info.st_mtim.tv_sec + 1e-9 * (double)info.st_mtim.tv_nsec +
           1e-6 * (double)(info.st_size % 1000);
}

static void forget_changes(struct edit *edit)
{
    for (size_t i = 0; i < EDIT_MAX_CONSTITUENTS; i++) {
        edit->changes[i] = (trl_constituent_change){i, 1.0, (double)NAN};
    }
    edit->chosen = SIZE_MAX;
}

void edit_init(struct edit *edit, trl_context *ctx, trl_renderer *renderer, const char *path,
               const trl_scene *scene)
{
    *edit = (struct edit){
        .ctx = ctx, .renderer = renderer, .path = path, .first = scene, .stamp = read_stamp(path)};
    forget_changes(edit);
}

void edit_finish(struct edit *edit)
{
    trl_scene_destroy(&edit->saved);
}

const trl_scene *edit_scene(const struct edit *edit)
{
    return edit->saved ? edit->saved : edit->first;
}

static size_t count_constituents(const struct edit *edit)
{
    const size_t count = trl_scene_constituent_count(edit_scene(edit));
    return count < EDIT_MAX_CONSTITUENTS ? count : EDIT_MAX_CONSTITUENTS;
}

// What phase functions at several wavelengths have made of one thing in the scene ("dust, 450 nm",
// "dust, 550 nm") is one thing for the keys: its name goes up to the last comma before an "nm".
static size_t name_length(const struct edit *edit, size_t index)
{
    const char *name = trl_scene_constituent_name(edit_scene(edit), index);
    const size_t length = strlen(name);
    const char *comma = strrchr(name, ',');
    const bool is_share = comma && length > 3 && strcmp(name + length - 3, " nm") == 0;
    return is_share ? (size_t)(comma - name) : length;
}

static bool is_same_thing(const struct edit *edit, size_t a, size_t b)
{
    const trl_scene *scene = edit_scene(edit);
    const size_t length = name_length(edit, a);
    return length == name_length(edit, b) &&
           strncmp(trl_scene_constituent_name(scene, a), trl_scene_constituent_name(scene, b),
                   length) == 0;
}

void edit_choose_next(struct edit *edit)
{
    const size_t count = count_constituents(edit);
    const size_t before = edit->chosen;
    do {
        edit->chosen = edit->chosen + 1 < count ? edit->chosen + 1 : 0;
    } while (edit->chosen > 0 && before < count && is_same_thing(edit, before, edit->chosen));
}

// The one that is changed: the first, when none was chosen yet. False when there is no air.
static bool choose(struct edit *edit)
{
    if (edit->chosen >= count_constituents(edit)) {
        edit->chosen = 0;
    }
    return count_constituents(edit) > 0;
}

static bool apply(struct edit *edit)
{
    return trl_renderer_change_atmosphere(edit->renderer, edit_scene(edit), edit->changes,
                                          count_constituents(edit)) == TRL_OK;
}

static void set_amount(struct edit *edit, double amount)
{
    for (size_t i = 0; i < count_constituents(edit); i++) {
        if (is_same_thing(edit, edit->chosen, i)) {
            edit->changes[i].amount = amount;
        }
    }
}

bool edit_scale(struct edit *edit, double factor)
{
    if (!choose(edit)) {
        return false;
    }
    const double before = edit->changes[edit->chosen].amount;
    double amount = fmin(fmax(before * factor, least_amount), largest_amount);
    if (fabs(log(amount)) < 1e-6) {
        amount = 1.0; // back where it was, without rounding: the cache knows it
    }
    set_amount(edit, amount);
    if (!apply(edit)) {
        set_amount(edit, before);
        return false;
    }
    return true;
}

bool edit_turn_asymmetry(struct edit *edit, double step)
{
    const double own = choose(edit)
                           ? trl_scene_constituent_asymmetry(edit_scene(edit), edit->chosen)
                           : (double)NAN;
    if (isnan(own)) {
        return false;
    }
    trl_constituent_change *change = &edit->changes[edit->chosen];
    const double before = change->asymmetry;
    const double now = (isnan(before) ? own : before) + step;
    change->asymmetry = fmin(fmax(now, -largest_asymmetry), largest_asymmetry);
    if (!apply(edit)) {
        change->asymmetry = before;
        return false;
    }
    return true;
}

bool edit_follow_file(struct edit *edit)
{
    const double stamp = read_stamp(edit->path);
    if (stamp < 0.0 || stamp == edit->stamp) {
        return false;
    }
    edit->stamp = stamp;
    trl_scene *scene = NULL;
    if (trl_scene_load(edit->ctx, edit->path, &scene) != TRL_OK) {
        return false;
    }
    trl_scene_destroy(&edit->saved);
    edit->saved = scene;
    forget_changes(edit);
    return trl_renderer_change_atmosphere(edit->renderer, scene, NULL, 0) == TRL_OK;
}

void edit_describe(const struct edit *edit, char text[EDIT_TEXT_MAX])
{
    text[0] = '\0';
    if (edit->chosen >= count_constituents(edit)) {
        return;
    }
    const trl_constituent_change *change = &edit->changes[edit->chosen];
    const double own = trl_scene_constituent_asymmetry(edit_scene(edit), edit->chosen);
    const double g = isnan(change->asymmetry) ? own : change->asymmetry;
    const int name_max = 40;
    const int name = (int)name_length(edit, edit->chosen);
    const int length =
        snprintf(text, EDIT_TEXT_MAX, "%.*s x %.3g", name_max < name ? name_max : name,
                 trl_scene_constituent_name(edit_scene(edit), edit->chosen), change->amount);
    if (!isnan(g) && length > 0 && length < EDIT_TEXT_MAX) {
        snprintf(text + length, (size_t)(EDIT_TEXT_MAX - length), ", g %.2f", g);
    }
}
