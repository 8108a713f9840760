// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What validate found, as one page that needs nothing but a browser.
#include "validate.h"

#include "output.h"
#include "validate_plot.h"
#include "validate_style.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static const char *const verdict_classes[] = {
    [VERDICT_GOOD] = "good", [VERDICT_NOISY] = "noisy", [VERDICT_BAD] = "bad"};
static const char *const verdict_words[] = {[VERDICT_GOOD] = "within the bounds",
                                            [VERDICT_NOISY] = "noise hides the bounds",
                                            [VERDICT_BAD] = "outside the bounds"};

// Upper ends of the colours of errors; what is larger has the last one.
static const double error_steps[] = {0.005, 0.01, 0.02, 0.05, 0.2};
enum { ERROR_STEPS = sizeof error_steps / sizeof *error_steps };

static void write_escaped(FILE *page, const char *text)
{
    for (; *text; text++) {
        switch (*text) {
        case '<':
            fputs("&lt;", page);
            break;
        case '>':
            fputs("&gt;", page);
            break;
        case '&':
            fputs("&amp;", page);
            break;
        case '"':
            fputs("&quot;", page);
            break;
        default:
            fputc(*text, page);
        }
    }
}

static int error_step(double error)
{
    int step = 0;
    while (step < ERROR_STEPS && error > error_steps[step]) {
        step++;
    }
    return step;
}

static const char *model_name(int model)
{
    return trl_sky_model_name((trl_sky_model)model);
}

static void write_head(FILE *page)
{
    fprintf(page,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
            "<title>Terrella: models of the sky against the path tracer</title>\n"
            "<style>%s</style>\n</head>\n<body>\n"
            "<h1>Models of the sky against the path tracer</h1>\n",
            validate_style);
}

static void write_summary(FILE *page, const struct validate *v)
{
    const struct validate_total t = validate_sum(v, NULL, TRL_SKY_SPECTRAL);
    const enum verdict verdict =
        t.bad > 0 ? VERDICT_BAD : (t.noisy > 0 ? VERDICT_NOISY : VERDICT_GOOD);
    fprintf(page, "<p class=\"summary %s\">", verdict_classes[verdict]);
    if (t.bad > 0) {
        fprintf(page, "The spectral model is <b>outside its bounds in %d of %d views</b>", t.bad,
                t.views);
    } else if (t.noisy > 0) {
        fprintf(page,
                "The spectral model is <b>nowhere seen outside its bounds</b>: %d of %d views are "
                "shown to be within, in %d the noise of the path tracer is larger than a bound",
                t.views - t.noisy, t.views, t.noisy);
    } else {
        fprintf(page, "The spectral model is <b>within its bounds in all %d views</b>", t.views);
    }
    fprintf(page,
            ". Beyond the noise it is off by %.2f&nbsp;%% in the mean of the views and by "
            "%.2f&nbsp;%% at most.</p>\n",
            100 * t.mean, 100 * t.largest);
}

static void write_explanation(FILE *page, const struct validate *v)
{
    fprintf(page,
            "<p><b>What is compared.</b> The spectral radiance that reaches an observer on the "
            "ground, at 10&nbsp;km and outside the air, under a sun from noon to 6&deg; below the "
            "horizon: in each of these views %d directions at 450, 550 and 650&nbsp;nm. The ground "
            "is a sphere with the scene&rsquo;s mean albedo. Each model answers at exactly these "
            "wavelengths. The reference is a Monte Carlo path tracer that follows all orders of "
            "scattering and shares no transport code with the models.</p>\n",
            VALIDATE_DIRECTIONS);
    fprintf(page,
            "<p><b>What noise is.</b> A path tracer averages random paths, and tells how far that "
            "average is likely off: its standard error. Noise makes errors look larger than they "
            "are. So the <i>mean</i> of a view is the mean size of the relative errors with what "
            "noise alone would give taken out (as squares), and the <i>largest</i> is the largest "
            "error beyond the %.1f standard errors that the luckiest of all values may be off. An "
            "error is relative to the value, or to a hundredth of the view&rsquo;s mean where the "
            "value is smaller.</p>\n"
            "<p><b>The bounds</b> of the spectral model are %.0f&nbsp;%% in the mean and "
            "%.0f&nbsp;%% at most, in every view. Where the noise itself is larger than that, the "
            "view says so. The other models have one order of scattering by design; their errors "
            "are shown, not judged. Their largest errors belong to dark directions: the error is "
            "relative to the direction&rsquo;s own light, so 300&nbsp;%% of a value that is a "
            "hundredth of the view&rsquo;s mean is 3&nbsp;%% of that mean. After sunset nearly all "
            "light has been scattered twice or more, and an error near 100&nbsp;%% says that a "
            "model of one scattering has hardly any.</p>\n",
            judge_granted_sigmas(validate_sum(v, NULL, TRL_SKY_SPECTRAL).views * VALIDATE_VALUES),
            100 * JUDGE_MEAN_BOUND, 100 * JUDGE_LARGEST_BOUND);
}

// In %, with as many digits as there is a use for.
static void write_percent(FILE *page, double share)
{
    const double percent = 100 * share;
    fprintf(page, percent < 10 ? "%.2f" : (percent < 100 ? "%.1f" : "%.0f"), percent);
}

// "mean / largest" with the colour of the mean.
static void write_errors(FILE *page, double mean, double largest)
{
    fprintf(page, "<td class=\"e%d\">", error_step(mean));
    write_percent(page, mean);
    fprintf(page, " / ");
    write_percent(page, largest);
    fprintf(page, "</td>");
}

static void write_color_key(FILE *page)
{
    fprintf(page, "<p class=\"key\">Mean error: <span class=\"k0\">up to 0.5&nbsp;%%</span>"
                  "<span class=\"k1\">1&nbsp;%%</span><span class=\"k2\">2&nbsp;%%</span>"
                  "<span class=\"k3\">5&nbsp;%%</span><span class=\"k4\">20&nbsp;%%</span>"
                  "<span class=\"k5\">more</span></p>\n");
}

static void write_overview(FILE *page, const struct validate *v)
{
    fprintf(page, "<h2>All scenes</h2>\n<p class=\"faint\">Errors in %%, mean / largest of all "
                  "views.</p>\n<div class=\"scroll\"><table>\n<tr><th>scene</th>");
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        fprintf(page, "<th>%s</th>", model_name(m));
    }
    fprintf(page, "<th>noise</th><th>views within bounds</th></tr>\n");
    for (int s = 0; s < v->scene_count; s++) {
        const struct validate_scene *scene = &v->scenes[s];
        fprintf(page, "<tr><td><a href=\"#s%d\">", s);
        write_escaped(page, trl_scene_name(scene->scene));
        fprintf(page, "</a></td>");
        for (int m = 0; m < VALIDATE_MODELS; m++) {
            const struct validate_total t = validate_sum(v, scene, m);
            if (t.views > 0) {
                write_errors(page, t.mean, t.largest);
            } else {
                fprintf(page, "<td class=\"none\">no answer</td>");
            }
        }
        const struct validate_total t = validate_sum(v, scene, TRL_SKY_SPECTRAL);
        fprintf(page, "<td>%.2f</td><td>%d of %d", 100 * t.noise, t.views - t.bad - t.noisy,
                t.views);
        if (t.noisy > 0) {
            fprintf(page, ", %d noisy", t.noisy);
        }
        fprintf(page, "</td></tr>\n");
    }
    fprintf(page, "</table></div>\n");
    write_color_key(page);
}

static void write_view_name(FILE *page, const struct validate_case *c)
{
    const double sun = c->sun_elevation_deg;
    fprintf(page, "%s, sun %g&deg; %s", c->place, fabs(sun),
            sun < 0 ? "below the horizon" : "high");
}

static void write_row(FILE *page, const struct validate_case *c)
{
    fprintf(page, "<tr><td>%s</td><td>%g&deg;</td>", c->place, c->sun_elevation_deg);
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        const struct validate_answer *answer = &c->answers[m];
        if (answer->is_there) {
            write_errors(page, answer->judgement.mean, answer->judgement.largest);
        } else {
            fprintf(page, "<td class=\"none\">&ndash;</td>");
        }
    }
    const struct judgement *j = &c->answers[TRL_SKY_SPECTRAL].judgement;
    fprintf(page, "<td>%.2f</td><td><span class=\"verdict %s\">%s</span></td>", 100 * j->noise,
            verdict_classes[j->verdict], verdict_words[j->verdict]);
    fprintf(page, "<td>%.0f</td><td>%.1f</td><td>", c->paths, c->traced_s);
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        fputs(m ? " / " : "", page);
        if (c->answers[m].frame_ms > 0) {
            fprintf(page, "%.0f", c->answers[m].frame_ms);
        } else {
            fprintf(page, "&ndash;");
        }
    }
    fprintf(page, "</td></tr>\n");
}

static void write_table(FILE *page, const struct validate_scene *scene)
{
    fprintf(page, "<div class=\"scroll\"><table>\n<tr><th>from</th><th>sun</th>");
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        fprintf(page, "<th>%s %%</th>", model_name(m));
    }
    fprintf(page, "<th>noise %%</th><th>spectral is</th><th>paths</th><th>traced, s</th>"
                  "<th>frames, ms</th></tr>\n");
    for (int c = 0; c < scene->case_count; c++) {
        write_row(page, &scene->cases[c]);
    }
    fprintf(page, "</table></div>\n");
}

static void write_figure(FILE *page, const struct validate_case *c, int model)
{
    const struct validate_answer *answer = &c->answers[model];
    if (!answer->pictures.picture) {
        return;
    }
    fprintf(page, "<figure><img alt=\"%s by %s\" src=\"%s\">", c->place, model_name(model),
            answer->pictures.picture);
    if (answer->pictures.map) {
        fprintf(page, "<img alt=\"difference of %s\" src=\"%s\">", model_name(model),
                answer->pictures.map);
    }
    fprintf(page, "<figcaption><b>%s</b>", model_name(model));
    if (answer->is_there) {
        fprintf(page, "<br>mean ");
        write_percent(page, answer->judgement.mean);
        fprintf(page, "&nbsp;%%, largest ");
        write_percent(page, answer->judgement.largest);
        fprintf(page, "&nbsp;%%");
    }
    fprintf(page, "<br>frame %.0f&nbsp;ms</figcaption></figure>\n", answer->frame_ms);
}

static void write_view(FILE *page, const struct validate_case *c)
{
    const struct judgement *j = &c->answers[TRL_SKY_SPECTRAL].judgement;
    fprintf(page, "<h3>");
    write_view_name(page, c);
    fprintf(page, "<span class=\"verdict %s\">%s</span></h3>\n<div class=\"view\">\n",
            verdict_classes[j->verdict], verdict_words[j->verdict]);
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        write_figure(page, c, m);
    }
    fprintf(page, "<figure class=\"plot\">");
    validate_plot_errors(page, c);
    fprintf(page,
            "<figcaption><b>spectral</b> against the path tracer, value by value; bars are "
            "one standard error of %.0f paths, %.2f&nbsp;%% in the mean</figcaption></figure>\n"
            "</div>\n",
            c->paths, 100 * j->noise);
}

static void write_scene(FILE *page, const struct validate *v, int index)
{
    const struct validate_scene *scene = &v->scenes[index];
    fprintf(page, "<h2 id=\"s%d\">", index);
    write_escaped(page, trl_scene_name(scene->scene));
    fprintf(page, "</h2>\n<p class=\"faint\">");
    write_escaped(page, scene->path);
    fprintf(page, ". All numbers of the spectral model took %.1f&nbsp;s.",
            scene->solve_s[TRL_SKY_SPECTRAL]);
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        if (scene->refusal[m][0]) {
            fprintf(page, " The model %s has no answer: ", model_name(m));
            write_escaped(page, scene->refusal[m]);
            fprintf(page, ".");
        }
    }
    fprintf(page, "</p>\n");
    write_table(page, scene);
    for (int c = 0; c < scene->case_count; c++) {
        write_view(page, &scene->cases[c]);
    }
}

static void write_map_key(FILE *page)
{
    fprintf(
        page,
        "<h2>Pictures and maps</h2>\n<p>Each view below is drawn by every model with the "
        "exposure of the first, looking toward the sun&rsquo;s side. Below the pictures of the "
        "others stand maps of how their luminance differs from the spectral model&rsquo;s:</p>\n"
        "<div class=\"bar\"></div><div class=\"ends faint\"><span>50&nbsp;%% darker</span>"
        "<span>the same</span><span>50&nbsp;%% brighter</span></div>\n"
        "<p class=\"faint\">Grey: both black. In the plots blue, green and red stand for 450, "
        "550 and 650&nbsp;nm; the numbers below are degrees from the zenith and from the "
        "sun&rsquo;s azimuth; the band is the bound of the mean.</p>\n");
}

static void write_foot(FILE *page, const struct validate *v)
{
    char when[64] = "";
    const time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc)) {
        strftime(when, sizeof when, "%Y-%m-%d %H:%M UTC", &utc);
    }
    fprintf(page, "<h2>Made by</h2>\n<p class=\"faint\">terrella %s, %s, in %.0f&nbsp;s on ",
            trl_version(), when, v->spent_s);
    write_escaped(page, v->machine.cpu);
    fprintf(page, ", %d cores, load %.1f at the start; pictures by ", v->machine.cores,
            v->machine.load_average);
    write_escaped(page, v->machine.gl_renderer);
    fprintf(page, ". Times of frames are for 416&nbsp;&times;&nbsp;234 pixels, the maps of the sky "
                  "made anew.</p>\n</body>\n</html>\n");
}

enum exit_status validate_write_html(const struct validate *v, const char *path)
{
    struct output_text output;
    enum exit_status status = output_text_begin(path, &output);
    if (status != EXIT_OK) {
        return status;
    }
    write_head(output.stream);
    write_summary(output.stream, v);
    write_explanation(output.stream, v);
    write_overview(output.stream, v);
    write_map_key(output.stream);
    for (int s = 0; s < v->scene_count; s++) {
        write_scene(output.stream, v, s);
    }
    write_foot(output.stream, v);
    return output_text_commit(&output);
}
