// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What validate found, as one page that needs nothing but a browser.
#include "validate.h"

#include "output.h"
#include "validate_map.h"
#include "validate_plot.h"
#include "validate_style.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static const char *const verdict_classes[] = {[VERDICT_GOOD] = "good",
                                              [VERDICT_MEAN] = "mean",
                                              [VERDICT_NOISY] = "noisy",
                                              [VERDICT_BAD] = "bad"};
static const char *const verdict_words[] = {[VERDICT_GOOD] = "within",
                                            [VERDICT_MEAN] = "mean within",
                                            [VERDICT_NOISY] = "noisy",
                                            [VERDICT_BAD] = "outside"};

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

static enum verdict worst_verdict(const struct validate_total *t)
{
    if (t->bad > 0) {
        return VERDICT_BAD;
    }
    return t->noisy > 0 ? VERDICT_NOISY : (t->mean_only > 0 ? VERDICT_MEAN : VERDICT_GOOD);
}

static void write_summary(FILE *page, const struct validate *v)
{
    const struct validate_total t = validate_sum(v, NULL, TRL_SKY_SPECTRAL);
    fprintf(page, "<p class=\"summary %s\">", verdict_classes[worst_verdict(&t)]);
    if (t.bad > 0) {
        fprintf(page, "The spectral model is <b>outside its bounds in %d of %d views</b>.", t.bad,
                t.views);
    } else if (t.good == t.views) {
        fprintf(page, "The spectral model is <b>within its bounds in all %d views</b>.", t.views);
    } else {
        fprintf(page,
                "The spectral model is <b>nowhere seen outside its bounds</b>. Of %d views %d are "
                "shown to be within, in %d more the mean is, and %d are too noisy to tell.",
                t.views, t.good, t.mean_only, t.noisy);
    }
    fprintf(
        page,
        " Over the %d views with a noise below %.0f&nbsp;%% it is off by %+.2f&nbsp;&plusmn;&nbsp;"
        "%.2f&nbsp;%% in the signed mean, and by %.2f&nbsp;%% at most beyond the noise.</p>\n",
        t.known, 100 * JUDGE_KNOWN_NOISE, 100 * t.signed_mean,
        100 * sqrt(t.variance) / fmax(t.known, 1), 100 * t.largest);
}

static void write_comparison(FILE *page, const struct validate_total *t)
{
    fprintf(page,
            "<p>Radiance that reaches an observer on the ground, at 10&nbsp;km and outside the "
            "air, under a sun from noon to 6&deg; below the horizon. Each view has %d directions "
            "at 450, 550 and 650&nbsp;nm. The ground is a sphere with the scene&rsquo;s mean "
            "albedo. The reference is a Monte Carlo path tracer that follows all orders of "
            "scattering and shares no transport code with the models: %.3g million paths.</p>\n",
            VALIDATE_DIRECTIONS, 1e-6 * t->path_count);
}

static void write_explanation(FILE *page, const struct validate *v)
{
    const struct validate_total t = validate_sum(v, NULL, TRL_SKY_SPECTRAL);
    write_comparison(page, &t);
    fprintf(page,
            "<details><summary>What the numbers mean</summary>\n<dl>"
            "<dt>noise</dt><dd>A path tracer averages random paths and tells how far that average "
            "is likely off: its standard error. Given is the mean of a view&rsquo;s values.</dd>"
            "<dt>signed mean</dt><dd>Mean of the relative errors with their signs, and its "
            "standard error. Noise averages out in it; so do errors of both signs.</dd>"
            "<dt>mean</dt><dd>Mean size of the relative errors, with what noise adds to sizes "
            "taken out.</dd>"
            "<dt>largest</dt><dd>The largest error beyond the %.1f standard errors that the "
            "unluckiest of all values may be off. Values with a standard error above %.0f&nbsp;%% "
            "are left out.</dd>"
            "<dt>error</dt><dd>Relative to the value, or to a hundredth of the view&rsquo;s mean "
            "where the value is smaller.</dd></dl></details>\n",
            judge_granted_sigmas(t.views * VALIDATE_VALUES), 100 * JUDGE_KNOWN_NOISE);
    fprintf(
        page,
        "<details><summary>When the spectral model passes</summary>\n<dl>"
        "<dt><span class=\"verdict good\">within</span></dt><dd>The mean size is shown to be "
        "at most %.0f&nbsp;%%, no value is off by more than %.0f&nbsp;%% beyond its noise, and "
        "no noise is larger than that.</dd>"
        "<dt><span class=\"verdict mean\">mean within</span></dt><dd>The signed mean is shown "
        "to be within %.0f&nbsp;%%. Noise hides how large single errors are.</dd>"
        "<dt><span class=\"verdict noisy\">noisy</span></dt><dd>Nothing is seen to be wrong, "
        "but the noise is too large to tell in the time that there was.</dd>"
        "<dt><span class=\"verdict bad\">outside</span></dt><dd>An error that noise does not "
        "explain.</dd></dl>\n"
        "<p>The other models have one order of scattering by design: their errors are shown, "
        "not judged. After sunset nearly all light has been scattered twice or more, and an "
        "error near 100&nbsp;%% says that a model of one scattering has hardly any. The table of "
        "single knows no azimuth, so from outside it lights what lies in shadow, and errors "
        "of a thousand per cent stand beside nearly black values.</p>"
        "</details>\n",
        100 * JUDGE_MEAN_BOUND, 100 * JUDGE_LARGEST_BOUND, 100 * JUDGE_MEAN_BOUND);
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
    if (largest >= 0) {
        write_percent(page, largest);
    } else {
        fprintf(page, "&ndash;");
    }
    fprintf(page, "</td>");
}

// -1: all values are too noisy to have one.
static double known_largest(const struct judgement *j)
{
    return j->known > 0 ? j->largest : -1;
}

static void write_color_key(FILE *page)
{
    fprintf(page, "<p class=\"key\">Mean error: <span class=\"e0\">up to 0.5&nbsp;%%</span>"
                  "<span class=\"e1\">1&nbsp;%%</span><span class=\"e2\">2&nbsp;%%</span>"
                  "<span class=\"e3\">5&nbsp;%%</span><span class=\"e4\">20&nbsp;%%</span>"
                  "<span class=\"e5\">more</span></p>\n");
}

static void write_overview(FILE *page, const struct validate *v)
{
    fprintf(page, "<h2>All scenes</h2>\n<p class=\"faint\">Errors in %%, mean / largest, of all "
                  "views with a noise below 2&nbsp;%%.</p>\n<div "
                  "class=\"scroll\"><table>\n<tr><th>scene</th>");
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        fprintf(page, "<th>%s</th>", model_name(m));
    }
    fprintf(page, "<th>signed mean of spectral</th><th>within</th><th>mean within</th>"
                  "<th>noisy</th><th>outside</th></tr>\n");
    for (int s = 0; s < v->scene_count; s++) {
        const struct validate_scene *scene = &v->scenes[s];
        fprintf(page, "<tr><td><a href=\"#s%d\">", s);
        write_escaped(page, trl_scene_name(scene->scene));
        fprintf(page, "</a></td>");
        for (int m = 0; m < VALIDATE_MODELS; m++) {
            const struct validate_total t = validate_sum(v, scene, m);
            if (t.views > 0) {
                write_errors(page, t.mean, t.known > 0 ? t.largest : -1);
            } else {
                fprintf(page, "<td class=\"none\">no answer</td>");
            }
        }
        const struct validate_total t = validate_sum(v, scene, TRL_SKY_SPECTRAL);
        fprintf(page,
                "<td>%+.2f &plusmn; %.2f</td><td>%d</td><td>%d</td><td>%d</td><td>%d</td></tr>\n",
                100 * t.signed_mean, 100 * sqrt(t.variance) / fmax(t.known, 1), t.good, t.mean_only,
                t.noisy, t.bad);
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
    fprintf(page, "<tr><td>%s</td><td>%s%g&deg;</td>", c->place,
            c->sun_elevation_deg < 0 ? "&minus;" : "", fabs(c->sun_elevation_deg));
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        const struct validate_answer *answer = &c->answers[m];
        if (answer->is_there && validate_is_telling(c)) {
            write_errors(page, answer->judgement.mean, known_largest(&answer->judgement));
        } else {
            fprintf(page, "<td class=\"none\">&ndash;</td>");
        }
    }
    const struct judgement *j = &c->answers[TRL_SKY_SPECTRAL].judgement;
    if (validate_is_telling(c)) {
        fprintf(page, "<td>%+.2f &plusmn; %.2f</td>", 100 * j->signed_mean, 100 * j->signed_noise);
    } else {
        fprintf(page, "<td>&ndash;</td>");
    }
    fprintf(page, "<td>%.2f</td><td><span class=\"verdict %s\">%s</span></td>", 100 * j->noise,
            verdict_classes[j->verdict], verdict_words[j->verdict]);
    fprintf(page, "<td>%.0f</td><td>%.1f</td><td>", validate_mean_paths(c), c->traced_s);
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
    fprintf(page, "<th>signed mean %%</th><th>noise %%</th><th>spectral is</th>"
                  "<th>paths a value</th><th>traced, s</th><th>frames, ms</th></tr>\n");
    for (int c = 0; c < scene->case_count; c++) {
        write_row(page, &scene->cases[c]);
    }
    fprintf(page, "</table></div>\n");
}

static void write_traced(FILE *page, const struct validate_case *c)
{
    if (!c->traced.picture) {
        fprintf(page, "<figure><figcaption><b>path tracer</b><br>no time for a picture"
                      "</figcaption></figure>\n");
        return;
    }
    const struct validate_profile *p = &c->traced.profile;
    fprintf(page,
            "<figure><img alt=\"%s by the path tracer\" src=\"%s\"><figcaption><b>path "
            "tracer</b><br>%u&nbsp;&times;&nbsp;%d pixels, %.0f paths each</figcaption></figure>\n",
            c->place, c->traced.picture, c->traced_width, p->rows, c->traced_pixel_paths);
}

static void write_figure(FILE *page, const struct validate_case *c, int model)
{
    const struct validate_answer *answer = &c->answers[model];
    const struct validate_pictures *pictures = &answer->pictures;
    if (!pictures->picture) {
        return;
    }
    fprintf(page, "<figure><img alt=\"%s by %s\" src=\"%s\">", c->place, model_name(model),
            pictures->picture);
    if (pictures->map) {
        fprintf(page, "<img class=\"map\" alt=\"difference of %s\" src=\"%s\">", model_name(model),
                pictures->map);
    }
    fprintf(page, "<figcaption><b>%s</b>", model_name(model));
    if (pictures->mean_noise > 0) {
        fprintf(page, "<br>picture %+.1f &plusmn; %.1f&nbsp;%%", 100 * pictures->mean,
                100 * pictures->mean_noise);
    }
    if (answer->is_there) {
        fprintf(page, "<br>values off by ");
        write_percent(page, answer->judgement.mean);
        fprintf(page, "&nbsp;%%");
    }
    fprintf(page, "</figcaption></figure>\n");
}

static void write_plots(FILE *page, const struct validate_case *c)
{
    fprintf(page, "<div class=\"plots\">");
    if (c->traced.profile.rows > 0) {
        fprintf(page, "<figure class=\"plot\">");
        validate_plot_profiles(page, c);
        fprintf(page, "<figcaption>Luminance, cd/m&sup2;, over elevation: path tracer (dots), "
                      "spectral (blue), single (red), rayleigh (green)</figcaption></figure>");
    }
    fprintf(page, "<figure class=\"plot\">");
    validate_plot_errors(page, c);
    fprintf(page, "<figcaption>Errors of spectral, value by value; bars are one standard "
                  "error</figcaption></figure></div>\n");
}

static void write_view(FILE *page, const struct validate_case *c)
{
    const struct judgement *j = &c->answers[TRL_SKY_SPECTRAL].judgement;
    fprintf(page, "<h3>");
    write_view_name(page, c);
    fprintf(page, "<span class=\"verdict %s\">%s</span></h3>\n<div class=\"view\">\n",
            verdict_classes[j->verdict], verdict_words[j->verdict]);
    if (c->answers[TRL_SKY_SPECTRAL].pictures.picture) {
        write_traced(page, c);
    }
    for (int m = 0; m < VALIDATE_MODELS; m++) {
        write_figure(page, c, m);
    }
    fprintf(page, "</div>\n");
    write_plots(page, c);
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

static void write_step(FILE *page, int step, bool is_brighter)
{
    const struct canvas_color c = validate_map_color(step, is_brighter);
    const double low = step > 0 ? 100 * validate_map_steps[step - 1] : 0;
    fprintf(page, "<span style=\"background:rgb(%d,%d,%d);color:%s\">", c.red, c.green, c.blue,
            step < 3 ? "#1d2026" : "#fff");
    if (step > 0) {
        fprintf(page, "%s%.0f</span>", is_brighter ? "+" : "&minus;", low);
    } else {
        fprintf(page, "0</span>");
    }
}

static void write_map_key(FILE *page)
{
    fprintf(page,
            "<h2>Pictures and maps</h2>\n<p>Each view below is traced, and drawn by every model "
            "with the exposure of the spectral one, looking toward the sun&rsquo;s side. Traced "
            "pictures are smaller and grainy. Below each model&rsquo;s picture stands a map of how "
            "its luminance differs from the traced one. Steps begin at, in %%:</p>\n"
            "<div class=\"steps\">");
    for (int step = VALIDATE_MAP_STEPS; step > 0; step--) {
        write_step(page, step, false);
    }
    for (int step = 0; step <= VALIDATE_MAP_STEPS; step++) {
        write_step(page, step, true);
    }
    fprintf(page,
            "</div>\n<p class=\"faint\">Blue: too dark; red: too bright. A difference below three "
            "standard errors of its pixel is shown as none. Grey: both black. "
            "&ldquo;Picture&rdquo; is the mean difference "
            "of all pixels without edges. In the plots of errors blue, green and red stand for "
            "450, 550 and 650&nbsp;nm; the numbers below are degrees from the zenith and from the "
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
    fprintf(page, ". Times of frames are for 288&nbsp;&times;&nbsp;160 pixels, the maps of the sky "
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
    validate_write_clouds(output.stream, v);
    write_foot(output.stream, v);
    return output_text_commit(&output);
}
