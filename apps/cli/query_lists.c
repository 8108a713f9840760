// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "query_lists.h"

void query_lists_make_options(struct query_lists *lists, struct option *out)
{
    for (size_t i = 0; i < lists->part_count; i++) {
        const struct query_part *part = &lists->parts[i];
        out[i] = (struct option){.name = part->option,
                                 .kind = OPTION_LIST,
                                 .target.list = &lists->lists[i],
                                 .metavar = part->metavar,
                                 .range = part->range,
                                 .help = part->help};
    }
}

void query_lists_finish(struct query_lists *lists)
{
    for (size_t i = 0; i < lists->part_count; i++) {
        number_list_finish(&lists->lists[i]);
    }
}

enum exit_status query_lists_count(const struct query_lists *lists, size_t *count)
{
    *count = 1;
    for (size_t i = 0; i < lists->part_count; i++) {
        const struct query_part *part = &lists->parts[i];
        const size_t given = lists->lists[i].count;
        if (given == 0 && !part->fallback) {
            return report_error(EXIT_USAGE, "%s: --%s%s is missing; see terrella %s --help",
                                lists->command, part->option, lists->alternative, lists->command);
        }
        *count *= given > 0 ? given : 1;
        *count = *count > lists->max_count ? lists->max_count + 1 : *count; // no overflow
    }
    return EXIT_OK;
}

void query_lists_get(const struct query_lists *lists, size_t index, double *values,
                     const char **texts)
{
    for (size_t i = lists->part_count; i-- > 0;) {
        const struct number_list *list = &lists->lists[i];
        const size_t count = list->count > 0 ? list->count : 1;
        const struct number_item *item =
            list->count > 0 ? &list->items[index % count] : lists->parts[i].fallback;
        index /= count;
        values[i] = item->value;
        texts[i] = item->text;
    }
}

void query_lists_print_columns(const struct query_lists *lists, FILE *stream)
{
    for (size_t i = 0; i < lists->part_count; i++) {
        fprintf(stream, "%s,", lists->parts[i].column);
    }
}

void query_lists_print_texts(const struct query_lists *lists, const char *const *texts,
                             FILE *stream)
{
    for (size_t i = 0; i < lists->part_count; i++) {
        fprintf(stream, "%s,", texts[i]);
    }
}
