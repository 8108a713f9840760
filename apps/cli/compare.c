// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "compare.h"

#include "difference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct canvas_color PAPER = {250, 250, 248};
static const struct canvas_color INK = {28, 30, 34};
static const struct canvas_color FAINT_INK = {105, 108, 114};
static const struct canvas_color EDGE = {214, 214,
                                         210}; // around maps, whose middle is nearly white

// The view by each model, and each but the first against it.
struct compared {
    struct shot shots[COMPARE_MAX_MODELS];
    struct difference differences[COMPARE_MAX_MODELS]; // the first is empty
    double range;                                      // of all maps
};

static enum exit_status add_model(const char *word, struct compare_models *out)
{
    trl_sky_model model;
    if (!trl_sky_model_find(word, &model)) {
        return report_error(EXIT_USAGE,
                            "render: --compare: '%.40s' is not one of spectral, single, rayleigh",
                            word);
    }
    if (model == TRL_SKY_REFERENCE) {
        return report_error(EXIT_USAGE, "render: --compare: pictures are not made by reference; "
                                        "see terrella validate");
    }
    for (int i = 0; i < out->count; i++) {
        if (out->models[i] == model) {
            return report_error(EXIT_USAGE, "render: --compare: %s is there twice", word);
        }
    }
    out->models[out->count++] = model;
    return EXIT_OK;
}

enum exit_status compare_models_parse(const char *text, struct compare_models *out)
{
    *out = (struct compare_models){.count = 0};
    enum exit_status status = EXIT_OK;
    const char *at = text;
    while (status == EXIT_OK && at) {
        const size_t length = strcspn(at, ",");
        char word[64];
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        status = add_model(word, out);
        at = at[length] ? at + length + 1 : NULL;
    }
    if (status == EXIT_OK && out->count < 2) {
        return report_error(EXIT_USAGE,
                            "render: --compare: one model is not enough, as in spectral,single");
    }
    return status;
}

static void finish_compared(struct compared *compared)
{
    for (int i = 0; i < COMPARE_MAX_MODELS; i++) {
        shot_finish(&compared->shots[i]);
        difference_finish(&compared->differences[i]);
    }
}

// The first one's exposure, found from the picture or fixed, is that of all.
static trl_result draw_all(const struct compare_desc *desc, trl_renderer *renderer,
                           struct compared *out)
{
    trl_view view = *desc->view;
    trl_result result = TRL_OK;
    for (int i = 0; result == TRL_OK && i < desc->models.count; i++) {
        const struct shot_desc shot = {.renderer = renderer,
                                       .view = &view,
                                       .model = desc->models.models[i],
                                       .size = desc->size,
                                       .samples = desc->samples};
        if (!progress_report(&desc->app->progress, "drawing", (double)i / desc->models.count)) {
            report_error(EXIT_FAILED, "cancelled before writing %s", desc->output);
            return TRL_ERROR_CANCELLED;
        }
        result = shot_take(&shot, &out->shots[i]);
        view.has_fixed_exposure = true;
        view.exposure_ev100 = out->shots[0].ev100;
        if (result == TRL_OK && i > 0 &&
            !difference_make(&out->shots[0], &out->shots[i], &out->differences[i])) {
            report_error(EXIT_FAILED, "render: out of memory");
            result = TRL_ERROR_MEMORY;
        }
    }
    out->range = difference_choose_range(out->differences, COMPARE_MAX_MODELS);
    return result;
}

// Where everything is on the sheet, in pixels.
struct layout {
    int scale;         // pixels of a dot of the letters
    int margin;        // around and between
    int line;          // of words, with the space below them
    int width, height; // of a picture
    int pictures_y, maps_y, captions_y;
    int sheet_width, sheet_height;
};

static struct layout find_layout(const struct compare_desc *desc)
{
    struct layout l = {.width = (int)desc->size.width, .height = (int)desc->size.height};
    const int wished = l.width / 300;
    l.scale = wished < 1 ? 1 : (wished > 4 ? 4 : wished);
    l.margin = 8 * l.scale;
    l.line = 12 * l.scale;
    l.pictures_y = l.margin + 5 * l.line / 2;
    l.maps_y = l.pictures_y + l.height + l.margin + l.line;
    l.captions_y = l.maps_y + l.height + l.margin / 2;
    l.sheet_width = desc->models.count * (l.width + l.margin) + l.margin;
    l.sheet_height = l.captions_y + l.line + l.margin / 2;
    return l;
}

struct number_size compare_sheet_size(const struct compare_desc *desc)
{
    const struct layout l = find_layout(desc);
    if (desc->is_exr) {
        return (struct number_size){(uint32_t)(desc->models.count * l.width),
                                    (uint32_t)(2 * l.height)};
    }
    return (struct number_size){(uint32_t)l.sheet_width, (uint32_t)l.sheet_height};
}

static int column_x(const struct layout *l, int column)
{
    return l->margin + column * (l->width + l->margin);
}

// A line of words in a column of the sheet.
static void write_line(struct canvas *sheet, const struct layout *l, struct canvas_rect where,
                       struct canvas_color color, const char *words)
{
    const struct canvas_text text = {l->scale, color, words};
    canvas_write(sheet, where, &text);
}

// Centred on x.
static void write_centred(struct canvas *sheet, const struct layout *l, int x, int y,
                          const char *words)
{
    const struct canvas_text text = {l->scale, INK, words};
    const int width = canvas_text_width(&text);
    canvas_write(sheet, (struct canvas_rect){x - width / 2, y, width, l->line}, &text);
}

static void draw_scale_bar(struct canvas *sheet, const struct layout *l, struct canvas_rect bar,
                           double range)
{
    for (int x = 0; x < bar.width; x++) {
        const double share = range * (2.0 * x / (bar.width > 1 ? bar.width - 1 : 1) - 1);
        canvas_fill(sheet, (struct canvas_rect){bar.x + x, bar.y, 1, bar.height},
                    difference_color(share, range));
    }
    for (int tick = -2; tick <= 2; tick++) {
        const int x = bar.x + (tick + 2) * (bar.width - 1) / 4;
        canvas_fill(sheet, (struct canvas_rect){x, bar.y + bar.height, l->scale, 3 * l->scale},
                    INK);
        char words[32];
        snprintf(words, sizeof words, tick ? "%+.3g%%" : "%.0f", 50.0 * tick * range);
        write_centred(sheet, l, x, bar.y + bar.height + 5 * l->scale, words);
    }
}

// Below the first picture, where it would differ from itself: what the colours mean.
static void draw_legend(struct canvas *sheet, const struct layout *l, const char *base,
                        double range)
{
    const int x = column_x(l, 0);
    const int bar_width = 4 * l->width / 5;
    const int bar_x = x + (l->width - bar_width) / 2;
    const int middle = l->height / 2 - 4 * l->line;
    int y = l->maps_y + (middle > 0 ? middle : 0); // never into the picture above
    char words[96];
    snprintf(words, sizeof words, "luminance compared with %s", base);
    write_centred(sheet, l, x + l->width / 2, y, words);
    y += 3 * l->line / 2;
    draw_scale_bar(sheet, l, (struct canvas_rect){bar_x, y, bar_width, 2 * l->line}, range);
    y += 4 * l->line;
    const struct canvas_text left = {l->scale, FAINT_INK, "darker"};
    const struct canvas_text right = {l->scale, FAINT_INK, "brighter"};
    const int right_width = canvas_text_width(&right);
    canvas_write(sheet, (struct canvas_rect){bar_x, y, bar_width, l->line}, &left);
    canvas_write(sheet,
                 (struct canvas_rect){bar_x + bar_width - right_width, y, right_width, l->line},
                 &right);
    y += 2 * l->line;
    const int swatch = 8 * l->scale;
    canvas_fill(sheet, (struct canvas_rect){bar_x, y, swatch, swatch},
                difference_color((double)NAN, range));
    write_line(sheet, l, (struct canvas_rect){bar_x + 2 * swatch, y, bar_width, l->line}, FAINT_INK,
               "both black");
}

static void draw_column(struct canvas *sheet, const struct layout *l, const struct compared *all,
                        const struct compare_desc *desc, int i)
{
    const int x = column_x(l, i);
    const char *name = trl_sky_model_name(desc->models.models[i]);
    const char *base = trl_sky_model_name(desc->models.models[0]);
    const struct canvas_rect label = {x, l->pictures_y - l->line, l->width, l->line};
    write_line(sheet, l, label, INK, name);
    canvas_put(sheet, (struct canvas_rect){x, l->pictures_y, l->width, l->height},
               all->shots[i].picture);
    if (i == 0) {
        draw_legend(sheet, l, base, all->range);
        return;
    }
    const struct difference *d = &all->differences[i];
    char words[128];
    snprintf(words, sizeof words, "%s - %s", name, base);
    write_line(sheet, l, (struct canvas_rect){x, l->maps_y - l->line, l->width, l->line}, INK,
               words);
    const int edge = l->scale;
    canvas_fill(
        sheet,
        (struct canvas_rect){x - edge, l->maps_y - edge, l->width + 2 * edge, l->height + 2 * edge},
        EDGE);
    for (size_t p = 0; p < d->count; p++) {
        const struct canvas_rect pixel = {x + (int)(p % (size_t)l->width),
                                          l->maps_y + (int)(p / (size_t)l->width), 1, 1};
        canvas_fill(sheet, pixel, difference_color((double)d->share[p], all->range));
    }
    snprintf(words, sizeof words, "mean %+.2f%%, size %.2f%%, 99%% within %.2f%%, dE %.1f",
             100 * d->mean, 100 * d->mean_size, 100 * d->largest_size, d->mean_delta_e);
    write_line(sheet, l, (struct canvas_rect){x, l->captions_y, l->width, l->line}, FAINT_INK,
               words);
}

static trl_result write_png(const struct compare_desc *desc, const struct compared *all)
{
    const struct layout l = find_layout(desc);
    struct canvas sheet;
    if (!canvas_init(l.sheet_width, l.sheet_height, PAPER, &sheet)) {
        report_error(EXIT_FAILED, "render: out of memory");
        return TRL_ERROR_MEMORY;
    }
    char title[160];
    snprintf(title, sizeof title, "%.60s   %.60s   EV100 %.1f", trl_scene_name(desc->scene),
             desc->view_name, all->shots[0].ev100);
    write_line(&sheet, &l, (struct canvas_rect){l.margin, l.margin, l.sheet_width, l.line}, INK,
               title);
    for (int i = 0; i < desc->models.count; i++) {
        draw_column(&sheet, &l, all, desc, i);
    }
    const trl_result result = trl_image_write_png(
        desc->app->ctx, desc->output, (uint32_t)sheet.width, (uint32_t)sheet.height, sheet.rgba);
    canvas_finish(&sheet);
    return result;
}

// Above the radiances, below the shares in all three components; 0 below the first and where both
// are dark.
static trl_result write_exr(const struct compare_desc *desc, const struct compared *all)
{
    const struct number_size size = compare_sheet_size(desc);
    const size_t width = desc->size.width;
    const size_t height = desc->size.height;
    float *rgba = calloc((size_t)size.width * size.height * 4, sizeof *rgba);
    if (!rgba) {
        report_error(EXIT_FAILED, "render: out of memory");
        return TRL_ERROR_MEMORY;
    }
    for (int i = 0; i < desc->models.count; i++) {
        for (size_t p = 0; p < width * height; p++) {
            const size_t x = (size_t)i * width + p % width;
            float *above = rgba + 4 * (p / width * size.width + x);
            float *below = above + 4 * height * size.width;
            memcpy(above, all->shots[i].radiance + 4 * p, 4 * sizeof *above);
            const float share = i > 0 ? all->differences[i].share[p] : 0;
            for (int c = 0; c < 3; c++) {
                below[c] = isnan(share) ? 0 : share;
            }
        }
    }
    const trl_result result =
        trl_image_write_exr(desc->app->ctx, desc->output, size.width, size.height, rgba);
    free(rgba);
    return result;
}

static void print_summary(const struct compare_desc *desc, const struct compared *all,
                          FILE *summary)
{
    const char *base = trl_sky_model_name(desc->models.models[0]);
    for (int i = 1; i < desc->models.count; i++) {
        const struct difference *d = &all->differences[i];
        fprintf(summary,
                "%s - %s: luminance %+.2f %% in the mean, %.2f %% in size, within %.2f %% in 99 %% "
                "of the pixels; Delta E %.1f\n",
                trl_sky_model_name(desc->models.models[i]), base, 100 * d->mean, 100 * d->mean_size,
                100 * d->largest_size, d->mean_delta_e);
    }
}

trl_result compare_write(const struct compare_desc *desc, FILE *summary)
{
    trl_renderer_desc with = trl_renderer_desc_default();
    with.scene = desc->scene;
    with.sky_model = (int)desc->models.models[0];
    with.rayleigh = &desc->rayleigh;
    with.mesher = desc->mesher;
    with.projective = desc->projective;
    with.mesh_error_px = desc->mesh_error_px;
    trl_renderer *renderer = NULL;
    struct compared all = {0};
    trl_result result = trl_renderer_create(desc->app->ctx, &with, &renderer);
    if (result == TRL_OK) {
        result = draw_all(desc, renderer, &all);
    }
    if (result == TRL_OK) {
        result = desc->is_exr ? write_exr(desc, &all) : write_png(desc, &all);
    }
    progress_clear(&desc->app->progress);
    if (result == TRL_OK && summary) {
        print_summary(desc, &all, summary);
    }
    finish_compared(&all);
    trl_renderer_destroy(&renderer);
    return result;
}
