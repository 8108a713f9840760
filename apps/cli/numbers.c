// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "numbers.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBER_TEXT_MAX = 31 };

// Always false, so that a parser can end with `return refuse(…)`.
__attribute__((format(printf, 2, 3))) static bool refuse(struct number_message *message,
                                                         const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(message->text, sizeof message->text, format, args);
    va_end(args);
    return false;
}

bool number_parse(const char *text, double *out, struct number_message *message)
{
    const size_t length = strlen(text);
    char *end = NULL;
    // strtod alone would take "inf", "nan", "0x1p3" and leading blanks.
    const bool is_decimal = length > 0 && strspn(text, "0123456789+-.eE") == length;
    const double value = is_decimal ? strtod(text, &end) : 0.0;
    if (!is_decimal || end != text + length) {
        return refuse(message, "'%.40s' is not a number", text);
    }
    if (length > NUMBER_TEXT_MAX) {
        return refuse(message, "'%.40s' has more than %d characters", text, NUMBER_TEXT_MAX);
    }
    if (!isfinite(value)) {
        return refuse(message, "'%.40s' is too large", text);
    }
    *out = value;
    return true;
}

static bool check_range(const char *text, double value, struct number_range range,
                        struct number_message *message)
{
    if (value < range.min) {
        return refuse(message, "%.40s is less than %.10g", text, range.min);
    }
    if (value > range.max) {
        return refuse(message, "%.40s is more than %.10g", text, range.max);
    }
    return true;
}

bool number_parse_in(const char *text, struct number_range range, double *out,
                     struct number_message *message)
{
    return number_parse(text, out, message) && check_range(text, *out, range, message);
}

// A side of a picture; the text ends at `stop`.
static bool parse_side(const char *text, char stop, uint32_t *out, const char **rest)
{
    if (!isdigit((unsigned char)*text)) {
        return false;
    }
    char *end = NULL;
    const unsigned long value = strtoul(text, &end, 10); // saturates when too large
    *out = value > UINT32_MAX ? UINT32_MAX : (uint32_t)value;
    *rest = end + 1;
    return *end == stop;
}

bool number_size_parse(const char *text, struct number_size *out, struct number_message *message)
{
    const char *rest = NULL;
    if (!parse_side(text, 'x', &out->width, &rest) ||
        !parse_side(rest, '\0', &out->height, &rest)) {
        return refuse(message, "'%.40s' is not WIDTHxHEIGHT in pixels, such as 1280x720", text);
    }
    if (out->width < 1 || out->height < 1 || out->width > NUMBER_SIZE_MAX ||
        out->height > NUMBER_SIZE_MAX) {
        return refuse(message, "'%.40s': each side must be from 1 to %d pixels", text,
                      NUMBER_SIZE_MAX);
    }
    if ((uint64_t)out->width * out->height > TRL_RENDERER_MAX_PIXELS) {
        return refuse(message, "'%.40s' has more than %d pixels", text, TRL_RENDERER_MAX_PIXELS);
    }
    return true;
}

static bool append_item(struct number_list *list, double value, const char *text,
                        struct number_message *message)
{
    if (list->count >= NUMBER_LIST_MAX) {
        return refuse(message, "more than %d numbers", NUMBER_LIST_MAX);
    }
    // Capacity is the next power of two, so it need not be kept.
    if ((list->count & (list->count - 1)) == 0) {
        const size_t capacity = list->count ? 2 * list->count : 1;
        struct number_item *items = realloc(list->items, capacity * sizeof *items);
        if (!items) {
            return refuse(message, "out of memory");
        }
        list->items = items;
    }
    struct number_item *item = &list->items[list->count++];
    item->value = value;
    snprintf(item->text, sizeof item->text, "%s", text);
    return true;
}

// from:to:step with the bounds already read.
static bool append_range(struct number_list *list, const double bounds[3], const char *text,
                         struct number_message *message)
{
    const double from = bounds[0];
    const double to = bounds[1];
    const double step = bounds[2];
    if (step == 0.0 || (to - from) / step < 0.0) {
        return refuse(message,
                      "'%.40s': the step does not lead from the first to the second number", text);
    }
    // 1e-9 of a step forgives the rounding of steps such as 0.1, so that the end is not lost.
    const double steps = floor((to - from) / step + 1e-9);
    if (steps >= NUMBER_LIST_MAX) {
        return refuse(message, "'%.40s' has more than %d numbers", text, NUMBER_LIST_MAX);
    }
    for (double i = 0.0; i <= steps; i += 1.0) {
        char shown[32];
        snprintf(shown, sizeof shown, "%.12g", from + i * step);
        // What is printed is what is asked: the value is the one that its text stands for.
        if (!append_item(list, strtod(shown, NULL), shown, message)) {
            return false;
        }
    }
    return true;
}

// One element between commas; `text` is modified.
static bool parse_element(char *text, struct number_range range, struct number_list *list,
                          struct number_message *message)
{
    char whole[64];
    snprintf(whole, sizeof whole, "%s", text);
    double bounds[3];
    size_t count = 0;
    for (char *part = text; part;) {
        char *colon = strchr(part, ':');
        if (colon) {
            *colon = '\0';
        }
        if (count == 3) {
            return refuse(message, "'%.40s' is not from:to:step", whole);
        }
        if (!number_parse(part, &bounds[count++], message)) {
            return false;
        }
        if (!check_range(part, bounds[count - 1],
                         count < 3 ? range : (struct number_range){-INFINITY, INFINITY}, message)) {
            return false;
        }
        part = colon ? colon + 1 : NULL;
    }
    if (count == 1) {
        return append_item(list, bounds[0], whole, message);
    }
    if (count == 2) {
        return refuse(message, "'%.40s' has no step: write from:to:step", whole);
    }
    return append_range(list, bounds, whole, message);
}

bool number_list_parse(const char *text, struct number_range range, struct number_list *out,
                       struct number_message *message)
{
    number_list_finish(out);
    char *copy = strdup(text);
    if (!copy) {
        return refuse(message, "out of memory");
    }
    bool is_good = true;
    for (char *element = copy; element && is_good;) {
        char *comma = strchr(element, ',');
        if (comma) {
            *comma = '\0';
        }
        is_good = parse_element(element, range, out, message);
        element = comma ? comma + 1 : NULL;
    }
    free(copy);
    if (!is_good) {
        number_list_finish(out);
    }
    return is_good;
}

void number_list_finish(struct number_list *list)
{
    free(list->items);
    *list = (struct number_list){0};
}
