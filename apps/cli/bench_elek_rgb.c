// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Elek and Kmoch 2010, Figure 6: pictures from three wavelengths beside those from all. Per pixel,
// before exposure: how luminance and chromaticity (CIE 1976 u'v') differ.
#include "bench.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 160, HEIGHT = 120, SPECTRA = 2 };

struct color {
    double luminance, u, v;
};

// From linear sRGB (IEC 61966-2-1); u'v' of CIE 15.
static struct color color_of(const float *rgb)
{
    const double r = (double)rgb[0];
    const double g = (double)rgb[1];
    const double b = (double)rgb[2];
    const double x = 0.4124 * r + 0.3576 * g + 0.1805 * b;
    const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    const double z = 0.0193 * r + 0.1192 * g + 0.9505 * b;
    const double sum = x + 15 * y + 3 * z;
    return (struct color){y, 4 * x / sum, 9 * y / sum};
}

// Where the picture has a thousandth of its brightest luminance at least: means over pixels.
static trl_result add_differences(const struct bench_job *job, const char *name,
                                  float *const radiance[SPECTRA])
{
    double brightest = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        brightest = fmax(brightest, color_of(radiance[0] + 4 * i).luminance);
    }
    double difference = 0;
    double bias = 0;
    double chroma = 0;
    double count = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        const struct color full = color_of(radiance[0] + 4 * i);
        const struct color rgb = color_of(radiance[1] + 4 * i);
        if (full.luminance > 1e-3 * brightest && rgb.luminance > 0) {
            const double d = rgb.luminance / full.luminance - 1;
            difference += fabs(d);
            bias += d;
            chroma += hypot(rgb.u - full.u, rgb.v - full.v);
            count++;
        }
    }
    if (!(count > 0)) {
        return TRL_OK; // black, which has no colour
    }
    const struct bench_sample samples[] = {
        {name, "luminance, mean difference", "%", 100 * difference / count},
        {name, "luminance, rgb brighter by", "%", 100 * bias / count},
        {name, "colour, mean distance in u'v'", "1", chroma / count}};
    trl_result result = TRL_OK;
    for (int i = 0; i < 3 && result == TRL_OK; i++) {
        result = bench_add(job->table, samples[i]);
    }
    return result;
}

static trl_result compare_views(const struct bench_job *job, const trl_scene *scene,
                                trl_renderer *const renderers[SPECTRA],
                                float *const radiance[SPECTRA])
{
    trl_result result = TRL_OK;
    const size_t views = trl_scene_view_count(scene);
    for (size_t i = 0; i < views && result == TRL_OK; i++) {
        const char *name = trl_scene_view_name(scene, i);
        trl_view view;
        result = trl_scene_view(scene, name, &view);
        for (int s = 0; s < SPECTRA && result == TRL_OK; s++) {
            result = trl_renderer_draw(renderers[s], &view, WIDTH, HEIGHT, 0);
            if (result == TRL_OK) {
                result = trl_renderer_read_radiance(renderers[s], radiance[s]);
            }
        }
        if (result == TRL_OK) {
            result = add_differences(job, name, radiance);
        }
    }
    return result;
}

static trl_result prepare(const struct bench_job *job, const trl_scene *scene,
                          trl_renderer *renderers[SPECTRA], float *radiance[SPECTRA])
{
    trl_result result = TRL_OK;
    for (int s = 0; s < SPECTRA && result == TRL_OK; s++) {
        trl_renderer_desc desc = trl_renderer_desc_default();
        desc.scene = scene;
        desc.sky_model = TRL_SKY_SPECTRAL;
        desc.spectrum = s == 0 ? TRL_SPECTRUM_FULL : TRL_SPECTRUM_RGB;
        result = trl_renderer_create(job->app->ctx, &desc, &renderers[s]);
        radiance[s] = calloc((size_t)WIDTH * HEIGHT * 4, sizeof *radiance[s]);
        if (result == TRL_OK && !radiance[s]) {
            report_error(EXIT_FAILED, "bench: out of memory");
            result = TRL_ERROR_MEMORY;
        }
    }
    return result;
}

trl_result bench_run_elek_rgb(const struct bench_job *job)
{
    trl_scene *scene = NULL;
    trl_renderer *renderers[SPECTRA] = {NULL};
    float *radiance[SPECTRA] = {NULL};
    trl_result result = bench_load_scene(job, "bare-sphere.json", &scene);
    if (result == TRL_OK) {
        result = prepare(job, scene, renderers, radiance);
    }
    if (result == TRL_OK) {
        result = compare_views(job, scene, renderers, radiance);
    }
    for (int s = 0; s < SPECTRA; s++) {
        trl_renderer_destroy(&renderers[s]);
        free(radiance[s]);
    }
    trl_scene_destroy(&scene);
    bench_note(job->table, "Three wavelengths (440, 550, 680 nm) are taken as a spectrum of three "
                           "samples, as Section 4.4 asks for.");
    bench_note(job->table, "The paper prints no numbers but a scale that ends at 10 %%, and says "
                           "that differences grow toward sunset.");
    return result;
}
