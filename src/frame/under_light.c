// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/under_light.h"

#include "shared/sea.glsl"

#include <math.h>
#include <string.h>

_Static_assert((int)SKY_SEA_WAVELENGTHS == (int)VOLUME_WAVELENGTHS, "spectra are the tables'");

// What is deeper is as deep.
static const double DEEPEST_M = 512, SHALLOWEST_M = 0.25;
// What is scattered by less does not leave the star's image, which waves make as wide.
static const double IMAGE_RAD = 0.05;

void under_columns_finish(struct under_columns *columns)
{
    const bool is_one = columns->of[0] == columns->of[1];
    volume_under_destroy(columns->ctx, &columns->of[0]);
    if (!is_one) {
        volume_under_destroy(columns->ctx, &columns->of[1]);
    }
    columns->of[1] = NULL;
}

static trl_result get(const struct under_columns *columns, double depth_m,
                      struct volume_under **out)
{
    double nm[VOLUME_WAVELENGTHS];
    for (int k = 0; k < VOLUME_WAVELENGTHS; k++) {
        nm[k] = 400 + 20 * k;
    }
    return volume_under_get(columns->ctx, columns->ocean, nm, VOLUME_WAVELENGTHS, depth_m, out);
}

// The column of that depth, which may be there already.
static trl_result take(struct under_columns *columns, double depth_m, struct volume_under **out)
{
    for (int i = 0; i < 2; i++) {
        if (columns->of[i] && columns->of[i]->depth_m == depth_m) {
            *out = columns->of[i];
            return TRL_OK;
        }
    }
    return get(columns, depth_m, out);
}

trl_result under_columns_find(struct under_columns *columns, double depth_m)
{
    const double depth = fmin(fmax(depth_m, SHALLOWEST_M), DEEPEST_M);
    double wanted[2] = {depth, depth};
    columns->part = 0;
    if (!(columns->ocean->bed.depth_m >= 0)) {
        const double octaves = log2(DEEPEST_M / depth) * UNDER_COLUMNS_AN_OCTAVE;
        wanted[0] = DEEPEST_M * exp2(-ceil(octaves) / UNDER_COLUMNS_AN_OCTAVE);
        wanted[1] = DEEPEST_M * exp2(-floor(octaves) / UNDER_COLUMNS_AN_OCTAVE);
        columns->part = wanted[1] > wanted[0] ? (depth - wanted[0]) / (wanted[1] - wanted[0]) : 0;
    }
    struct volume_under *found[2] = {NULL, NULL};
    trl_result result = take(columns, wanted[0], &found[0]);
    if (result == TRL_OK && wanted[1] == wanted[0]) {
        found[1] = found[0];
    } else if (result == TRL_OK) {
        result = take(columns, wanted[1], &found[1]);
    }
    for (int i = 0; i < 2; i++) {
        struct volume_under *old = columns->of[i];
        const bool is_left = result == TRL_OK && old != found[0] && old != found[1] &&
                             (i == 0 || old != columns->of[0]);
        if (is_left) {
            volume_under_destroy(columns->ctx, &old);
        }
    }
    if (result == TRL_OK) {
        memcpy(columns->of, found, sizeof found);
    } else if (found[0] && found[0] != columns->of[0] && found[0] != columns->of[1]) {
        volume_under_destroy(columns->ctx, &found[0]);
    }
    return result;
}

// Which part of the light a spectrum is of.
enum part { SOURCE, RISING, BED };

// Light that reaches the bed falls with its depth as an exponential does.
static double mix_bed(double a, double b, double part)
{
    const double low = fmax(a, 0), high = fmax(b, 0);
    return low > 0 && high > 0 ? low * pow(high / low, part) : low + (high - low) * part;
}

// Light in the water has a part that the bed sends back, which falls on the way down and up, as in
// the table for eyes above: the share of the deeper column.
static double share_of(const struct under_columns *columns, int wavelength,
                       const struct under_sight *sight)
{
    const double low_m = columns->of[0]->depth_m, high_m = columns->of[1]->depth_m;
    const struct water_optics *o = &columns->of[0]->column[wavelength].optics;
    const double way = 1 / sight->sun_mu + 1 / fmax(fabs(sight->view_mu), 0.1);
    const double rate =
        way * (o->absorption_per_m + o->clear_per_m / 2 + o->particles_per_m * o->backscatter);
    const double range = rate * (high_m - low_m);
    return range > 1e-6 ? expm1(-range * columns->part) / expm1(-range) : columns->part;
}

// Of the mixed columns at a wavelength. A shallower column's eye is not below its bed.
static struct under_source look(const struct under_columns *columns, enum part part, int wavelength,
                                const struct under_sight *sight)
{
    struct under_source light[2];
    for (int i = 0; i < 2; i++) {
        const struct volume_under *u = columns->of[i];
        struct under_sight own = *sight;
        own.eye_depth_m = fmin(own.eye_depth_m, u->depth_m);
        light[i] = part == SOURCE   ? volume_under_source(u, wavelength, &own)
                   : part == RISING ? volume_under_rising(u, wavelength, &own)
                                    : volume_under_bed(u, wavelength, own.sun_mu);
    }
    if (part == BED) {
        return (struct under_source){mix_bed(light[0].star, light[1].star, columns->part),
                                     mix_bed(light[0].sky, light[1].sky, columns->part)};
    }
    const double share = share_of(columns, wavelength, sight);
    return (struct under_source){
        (1 - share) * fmax(light[0].star, 0) + share * fmax(light[1].star, 0),
        (1 - share) * fmax(light[0].sky, 0) + share * fmax(light[1].sky, 0)};
}

struct volume_light under_columns_at(const struct under_columns *columns, int wavelength,
                                     double depth_m, const struct volume_view *view)
{
    const struct volume_under *u = columns->of[0];
    const bool is_up = view->view_mu > 0;
    const struct under_sight sight = {view->eye_depth_m, view->view_mu,
                                      volume_refract(view->sun_mu, u->index), view->azimuth_rad};
    const struct under_sight below = {0, -view->view_mu, sight.sun_mu, view->azimuth_rad};
    const struct under_sources sources = {
        look(columns, SOURCE, wavelength, &sight),
        look(columns, is_up ? RISING : BED, wavelength, is_up ? &below : &sight)};
    return volume_under_join(u, wavelength, depth_m, view, &sources);
}

struct job {
    const struct under_columns *columns;
    const struct sky_sea_volume *volume;
    const struct bands *bands;
};

static void store(const struct job *job, const double spectrum[VOLUME_WAVELENGTHS],
                  float out[BAND_COUNT])
{
    double bands[BAND_COUNT];
    sea_volume_bands(job->volume, job->bands, spectrum, bands);
    for (int b = 0; b < BAND_COUNT; b++) {
        out[b] = (float)bands[b];
    }
}

static void fill_light(const struct job *job, const struct under_place *place, double sun,
                       struct under_light_maps *out)
{
#pragma omp parallel for schedule(dynamic)
    for (int row = 0; row < UNDER_ROWS; row++) {
        const bool is_rising = row >= UNDER_VIEWS;
        const double mu = is_rising ? -(double)(row - UNDER_VIEWS) / (UNDER_RISING - 1)
                                    : 2.0 * row / (UNDER_VIEWS - 1) - 1;
        double star[VOLUME_WAVELENGTHS], sky[VOLUME_WAVELENGTHS];
        for (int az = 0; az < UNDER_AZIMUTHS; az++) {
            const struct under_sight sight = {place->eye_depth_m, mu, sun,
                                              M_PI * az / (UNDER_AZIMUTHS - 1)};
            for (int k = 0; k < VOLUME_WAVELENGTHS; k++) {
                const struct under_source light =
                    look(job->columns, is_rising ? RISING : SOURCE, k, &sight);
                star[k] = light.star;
                sky[k] = light.sky;
            }
            store(job, star, out->light[row][az]);
        }
        store(job, sky, out->light[row][UNDER_AZIMUTHS]);
    }
}

static void fill_bed(const struct job *job, double sun, struct under_light_maps *out)
{
    const struct volume_under *u = job->columns->of[0];
    double albedo[VOLUME_WAVELENGTHS], star[VOLUME_WAVELENGTHS], sky[VOLUME_WAVELENGTHS];
    for (int k = 0; k < VOLUME_WAVELENGTHS; k++) {
        const struct under_sight none = {0, 0, sun, 0};
        const struct under_source light = look(job->columns, BED, k, &none);
        albedo[k] = u->column[k].bed_albedo / M_PI;
        star[k] = albedo[k] * light.star;
        sky[k] = albedo[k] * light.sky;
    }
    store(job, albedo, out->bed);
    store(job, star, out->bed_star);
    store(job, sky, out->bed_sky);
}

static double scattering_of(const struct volume_under *u, int wavelength)
{
    const struct water_optics *optics = &u->column[wavelength].optics;
    return optics->clear_per_m + optics->particles_per_m;
}

static void store_logarithms(const struct job *job, const double spectrum[VOLUME_WAVELENGTHS],
                             float out[BAND_COUNT])
{
    for (int b = 0; b < BAND_COUNT; b++) {
        const double value = sea_volume_value(job->volume, spectrum, job->bands->nm[b]);
        out[b] = (float)log(fmax(value, 1e-30));
    }
}

static void fill_phase(const struct job *job, struct under_light_maps *out)
{
    const struct volume_under *u = job->columns->of[0];
    for (int i = 0; i < UNDER_ANGLES; i++) {
        const double root = (double)i / (UNDER_ANGLES - 1);
        const double angle = fmax(M_PI * root * root, IMAGE_RAD);
        double blunt[VOLUME_WAVELENGTHS], peak[VOLUME_WAVELENGTHS];
        for (int k = 0; k < VOLUME_WAVELENGTHS; k++) {
            const double cut = water_phase_blunt(&u->phase[k], angle);
            blunt[k] = scattering_of(u, k) * cut;
            peak[k] =
                scattering_of(u, k) * fmax(water_phase_value(&u->phase[k], cos(angle)) - cut, 0);
        }
        store_logarithms(job, blunt, out->scatter[0][i]);
        store_logarithms(job, peak, out->scatter[1][i]);
    }
}

// What is scattered beyond the image's angle, less what the extinction without the peak has.
static void fill_peak(const struct job *job, struct under_light_maps *out)
{
    enum { STEPS = 64 };
    const struct volume_under *u = job->columns->of[0];
    double peak[VOLUME_WAVELENGTHS];
    for (int k = 0; k < VOLUME_WAVELENGTHS; k++) {
        const double step = log(M_PI / IMAGE_RAD) / STEPS;
        double sum = 0;
        for (int i = 0; i < STEPS; i++) {
            const double angle = IMAGE_RAD * exp(step * (i + 0.5));
            const double whole = water_phase_value(&u->phase[k], cos(angle));
            sum += fmax(whole - water_phase_blunt(&u->phase[k], angle), 0) * 2 * M_PI * sin(angle) *
                   angle * step;
        }
        peak[k] = scattering_of(u, k) * sum;
    }
    for (int b = 0; b < BAND_COUNT; b++) {
        out->peak[b] = (float)sea_volume_value(job->volume, peak, job->bands->nm[b]);
    }
}

static void fill_extinction(const struct job *job, struct under_light_maps *out)
{
    const struct volume_under *u = job->columns->of[0];
    for (int i = 0; i < UNDER_ANGLES; i++) {
        const double root = fmax((double)i / (UNDER_ANGLES - 1), 1e-3);
        const double length_m = UNDER_LENGTH_M * root * root;
        double left[VOLUME_WAVELENGTHS];
        float bands[BAND_COUNT];
        for (int k = 0; k < VOLUME_WAVELENGTHS; k++) {
            left[k] = exp(-u->extinction_per_m[k] * length_m);
        }
        store(job, left, bands);
        for (int b = 0; b < BAND_COUNT; b++) {
            out->scatter[2][i][b] = (float)(-log((double)bands[b]) / length_m);
        }
    }
}

void under_light_fill(const struct under_columns *columns, const struct under_place *place,
                      const struct sky_sea_volume *volume, const struct bands *bands,
                      struct under_light_maps *out)
{
    const struct job job = {.columns = columns, .volume = volume, .bands = bands};
    const double sun = volume_refract(fmax(place->sun_mu, 0), columns->of[0]->index);
    fill_light(&job, place, sun, out);
    fill_bed(&job, sun, out);
    fill_phase(&job, out);
    fill_peak(&job, out);
    fill_extinction(&job, out);
}
