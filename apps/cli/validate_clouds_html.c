// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "validate.h"

static const double GOAL = 0.1; // of the errors of pixels, in the mean

static void write_row(FILE *page, int look, const struct cloud_figures *f)
{
    const char *colour = f->rms <= GOAL ? "e0" : f->least_size <= GOAL ? "e2" : "e4";
    fprintf(page,
            "<tr><td>%s</td><td>%.3g</td><td>%.3f</td><td class=\"%s\">%.1f to %.1f</td>"
            "<td>%.1f</td><td>%.2f, %.2f, %.2f</td><td>%.2f / %.2f</td></tr>\n",
            cloud_look_name(look), f->traced_cd_m2, f->ratio, colour, 100 * f->least_size,
            100 * f->rms, 100 * f->noise, f->thirds[0], f->thirds[1], f->thirds[2], f->contrast[0],
            f->contrast[1]);
}

static void write_table(FILE *page, const struct validate_clouds *clouds)
{
    fprintf(page, "<div class=\"scroll\"><table>\n<tr><th>look</th><th>luminance, "
                  "cd/m&sup2;</th><th>drawn over traced</th><th>pixels off by, %%</th><th>noise "
                  "of the paths, %%</th><th>dark, middle, bright thirds</th><th>contrast, "
                  "drawn / traced</th></tr>\n");
    for (int look = 0; look < CLOUD_LOOKS; look++) {
        write_row(page, look, &clouds->looks[look].figures);
    }
    fprintf(page, "</table></div>\n");
}

static void write_look(FILE *page, const struct validate_clouds *clouds, int look)
{
    const struct validate_cloud_look *l = &clouds->looks[look];
    const char *name = cloud_look_name(look);
    fprintf(page,
            "<h3>%s</h3>\n<div class=\"view\">\n"
            "<figure><img class=\"map\" alt=\"%s by the path tracer\" src=\"%s\"><figcaption>"
            "<b>path tracer</b></figcaption></figure>\n"
            "<figure><img alt=\"%s as drawn\" src=\"%s\"><figcaption><b>drawn</b></figcaption>"
            "</figure>\n"
            "<figure><img class=\"map\" alt=\"difference\" src=\"%s\"><figcaption><b>drawn "
            "against traced</b></figcaption></figure>\n</div>\n",
            name, name, l->traced, name, l->drawn, l->map);
}

void validate_write_clouds(FILE *page, const struct validate *v)
{
    const struct validate_clouds *clouds = &v->clouds;
    if (clouds->paths == 0) {
        return;
    }
    fprintf(page,
            "<h2>Clouds</h2>\n<p>A field of cumulus that covers half of the sky, over a sphere in "
            "Earth&rsquo;s air. The tracer follows %.0f paths a pixel through the same field. "
            "Errors of pixels, relative, without the noise of the paths: their mean lies between "
            "what is left when one half of the paths tells the signs and the other the sizes, and "
            "the root mean square, which the product of both halves gives. The goal is a mean "
            "below %.0f&nbsp;%%. Thirds: of the pixels from dark to bright as drawn, drawn over "
            "traced. Contrast: standard deviation over the mean.</p>\n",
            (double)clouds->paths, 100 * GOAL);
    write_table(page, clouds);
    for (int look = 0; look < CLOUD_LOOKS; look++) {
        write_look(page, clouds, look);
    }
}
