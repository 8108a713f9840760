// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/table.h"

#include "shared/phase.glsl"
#include "shared/sky_map.glsl"

#include <math.h>
#include <string.h>

static const double NODES_PER_SHELL = 12;
static const double DEPTH_PER_RULE = 2.5; // optical
static const double LEAST_TRANSMITTANCE = 1e-5;
// Single scattering has a kink where the ray crosses the edge of the planet's shadow, elsewhere for
// each sun: only more nodes help. This many leave less than 1 % in twilight.
static const double SHADOW_NODES_PER_SHELL = 96;
// A phase function whose third moment is above this has a peak that eight azimuths would blur.
static const double PEAKED_MOMENT = 0.05;

static bool is_peaked(const struct phase *phase)
{
    double moment[4];
    phase_moments(phase, 3, moment);
    return fabs(moment[3]) > PEAKED_MOMENT;
}

struct peaked peaked_choose(const struct optics *optics)
{
    struct peaked p = {0};
    bool is_taken[MEDIUM_MAX_CONSTITUENTS] = {false};
    while (p.count < TABLE_MAX_PEAKED) {
        int best = -1;
        for (int i = 0; i < optics->constituent_count; i++) {
            const double depth = optics->vertical_scattering_depth[i];
            if (!is_taken[i] && depth > 0 && is_peaked(&optics->medium->constituents[i].phase) &&
                (best < 0 || depth > optics->vertical_scattering_depth[best])) {
                best = i;
            }
        }
        if (best < 0) {
            break;
        }
        is_taken[best] = true;
        p.constituent[p.count++] = best;
    }
    return p;
}

struct transport_channels peaked_channels(const struct peaked *peaked, const struct optics *optics,
                                          const struct transport_family *family,
                                          float *const *phase)
{
    struct transport_channels channels;
    for (int i = 0; i < optics->constituent_count; i++) {
        channels.channel[i] = optics->vertical_scattering_depth[i] > 0 ? 0 : -1;
        channels.phase[i] = NULL;
        for (int c = 0; c < peaked->count; c++) {
            if (peaked->constituent[c] == i) {
                channels.channel[i] = c + 1;
            }
        }
        if (channels.channel[i] == 0) {
            for (int t = 0; t < family->count; t++) {
                phase[i][t] = (float)phase_value(&optics->medium->constituents[i].phase,
                                                 (double)family->nu[t]);
            }
            channels.phase[i] = phase[i];
        }
    }
    return channels;
}

struct table_size table_size_default(void)
{
    return (struct table_size){
        .altitudes = 32, .views = 128, .suns = TABLE_MOST_SUNS, .azimuths = 8};
}

struct table_size table_size_draft(void)
{
    return (struct table_size){.altitudes = 16, .views = 56, .suns = 28, .azimuths = 6};
}

static size_t slice_floats(const struct table *t)
{
    return (size_t)t->size.views * t->size.suns * t->size.azimuths * TEXEL_FLOATS;
}

size_t table_texels(const struct table *t)
{
    return (size_t)t->channels * t->size.altitudes * slice_floats(t);
}

trl_result table_reserve(const trl_context *ctx, const struct moments *moments, int channels,
                         struct table *out)
{
    *out = (struct table){.size = out->size,
                          .channels = channels,
                          .sun_centre = moments->sun_centre,
                          .sun_width = moments->sun_width,
                          .sun_first = moments->sun_first};
    out->sun_last = moments->sun_first + (moments->suns - 1) / moments->sun_scale;
    out->texels = mem_alloc(ctx, table_texels(out), sizeof *out->texels);
    return out->texels ? TRL_OK : TRL_ERROR_MEMORY;
}

void table_finish(const trl_context *ctx, struct table *table)
{
    mem_free(ctx, table->texels);
    *table = (struct table){0};
}

static double table_radius(const struct optics *optics, double coordinate)
{
    const double ground = optics->ground_radius_m;
    const double longest = sqrt((optics->top_radius_m - ground) * (optics->top_radius_m + ground));
    return sqrt(ground * ground + coordinate * coordinate * longest * longest);
}

// The ray at the view coordinate: from its distance to the top, mu by the law of cosines.
static double table_view_mu(const struct optics *optics, double radius_m, double coordinate)
{
    const double ground = optics->ground_radius_m;
    const double top = optics->top_radius_m;
    const double rise = sqrt(fmax(0, (radius_m - ground) * (radius_m + ground)));
    const double longest = rise + sqrt((top - ground) * (top + ground));
    const double distance = fmax(sky_map_view_distance(coordinate, top - radius_m, longest), 1e-3);
    const double mu =
        ((top - radius_m) * (top + radius_m) - distance * distance) / (2 * radius_m * distance);
    const double sine = ground / radius_m;
    const double horizon_mu = -sqrt(fmax(0, 1 - sine * sine));
    // A hair above the horizon: this half of the sphere never meets the ground.
    return fmin(1, fmax(mu, horizon_mu + 1e-10));
}

struct table_worker {
    struct ray ray;
    struct transport_scratch *scratch;
    float *sun_mu, *nu;
    float *phase[MEDIUM_MAX_CONSTITUENTS];
    lanes *radiance[1 + TABLE_MAX_PEAKED];
};

static void worker_destroy(const trl_context *ctx, struct table_worker *w)
{
    if (!w) {
        return;
    }
    transport_scratch_destroy(ctx, &w->scratch);
    mem_free(ctx, w->sun_mu);
    mem_free(ctx, w->nu);
    for (int i = 0; i < MEDIUM_MAX_CONSTITUENTS; i++) {
        mem_free(ctx, w->phase[i]);
    }
    for (int c = 0; c <= TABLE_MAX_PEAKED; c++) {
        mem_free(ctx, w->radiance[c]);
    }
    mem_free(ctx, w);
}

static struct table_worker *worker_create(const trl_context *ctx, const struct solution *solution,
                                          int members)
{
    struct table_worker *w = mem_alloc(ctx, 1, sizeof *w);
    if (!w) {
        return NULL;
    }
    w->sun_mu = mem_alloc(ctx, (size_t)members, sizeof(float));
    w->nu = mem_alloc(ctx, (size_t)members, sizeof(float));
    bool has_memory = w->sun_mu && w->nu;
    for (int i = 0; i < solution->optics->constituent_count && has_memory; i++) {
        w->phase[i] = mem_alloc(ctx, (size_t)members, sizeof(float));
        has_memory = w->phase[i] != NULL;
    }
    for (int c = 0; c <= TABLE_MAX_PEAKED && has_memory; c++) {
        w->radiance[c] = mem_alloc(ctx, (size_t)members, sizeof(lanes));
        has_memory = w->radiance[c] != NULL;
    }
    if (!has_memory ||
        transport_scratch_create(ctx, members, solution->moments.suns, &w->scratch) != TRL_OK) {
        worker_destroy(ctx, w);
        return NULL;
    }
    return w;
}

double table_sun_mu(const struct table *table, int sun)
{
    const double z =
        table->sun_first + (table->sun_last - table->sun_first) * sun / (table->size.suns - 1);
    return fmin(1, table->sun_centre + table->sun_width * sinh(z));
}

// All suns and azimuths of the table under one ray; suns outermost.
static struct transport_family fill_family(const struct table *table, double mu,
                                           struct table_worker *w)
{
    const double sine = sqrt(fmax(0, 1 - mu * mu));
    const struct table_size n = table->size;
    for (int i = 0; i < n.suns; i++) {
        const double sun_mu = table_sun_mu(table, i);
        const double sun_sine = sqrt(fmax(0, 1 - sun_mu * sun_mu));
        for (int p = 0; p < n.azimuths; p++) {
            const double cos_azimuth = 1 - 2.0 * p / (n.azimuths - 1);
            w->sun_mu[i * n.azimuths + p] = (float)sun_mu;
            w->nu[i * n.azimuths + p] = (float)(mu * sun_mu + sine * sun_sine * cos_azimuth);
        }
    }
    return (struct transport_family){n.suns * n.azimuths, w->sun_mu, w->nu};
}

static struct transport_family gather(const struct table *table, const struct solution *solution,
                                      const struct peaked *peaked, double radius_m, double mu,
                                      struct table_worker *w)
{
    const struct optics *optics = solution->optics;
    struct ray_desc desc = {.radius_m = radius_m,
                            .mu = mu,
                            .nodes_per_shell = SHADOW_NODES_PER_SHELL,
                            .end_m = INFINITY,
                            .depth_per_rule = DEPTH_PER_RULE,
                            .least_transmittance = LEAST_TRANSMITTANCE};
    const struct transport_family family = fill_family(table, mu, w);
    for (int c = 0; c <= peaked->count; c++) {
        memset(w->radiance[c], 0, (size_t)family.count * sizeof(lanes));
    }
    const struct transport_channels channels = peaked_channels(peaked, optics, &family, w->phase);
    ray_init(&w->ray, optics, solution->rules, &desc);
    transport_add_single(&solution->sun, &w->ray, &family, &channels, w->radiance, w->scratch);
    desc.nodes_per_shell = NODES_PER_SHELL;
    ray_init(&w->ray, optics, solution->rules, &desc);
    transport_add_multiple(&solution->moments, &w->ray, &family, w->radiance[0], w->scratch);
    return family;
}

static void store(const struct table *table, const struct transport_family *family,
                  const struct bands *bands, const struct table_worker *w, size_t ray_index)
{
    for (int c = 0; c < table->channels; c++) {
        float *texel = table->texels + (size_t)c * table->size.altitudes * slice_floats(table) +
                       ray_index * family->count * TEXEL_FLOATS;
        for (int t = 0; t < family->count; t++) {
            const double scale = c == 0 ? 1 / phase_rayleigh((double)family->nu[t]) : 1;
            bands_xyz(bands, &w->radiance[c][t], (float)scale, texel + t * TEXEL_FLOATS);
        }
    }
}

trl_result table_init(const trl_context *ctx, const struct solution *solution,
                      const struct peaked *peaked, const struct bands *bands, struct table *out)
{
    trl_result result = table_reserve(ctx, &solution->moments, 1 + peaked->count, out);
    if (result != TRL_OK) {
        return result;
    }
    const struct table_size n = out->size;
    bool has_memory = true;
    // A block of altitudes at a time, so that the user can be told, and can stop it.
    enum { BLOCK = 4 };
    for (int first = 0; first < n.altitudes && result == TRL_OK; first += BLOCK) {
        const int rays = (n.altitudes - first < BLOCK ? n.altitudes - first : BLOCK) * n.views;
#pragma omp parallel
        {
            struct table_worker *w = worker_create(ctx, solution, n.suns * n.azimuths);
            const unsigned state = lanes_flush_denormals();
#pragma omp for schedule(dynamic, 8)
            for (int r = 0; r < rays; r++) {
                if (!w) {
                    has_memory = false;
                    continue;
                }
                const size_t index = (size_t)first * n.views + r;
                const double radius_m =
                    table_radius(solution->optics, (double)(index / n.views) / (n.altitudes - 1));
                const double mu = table_view_mu(solution->optics, radius_m,
                                                (double)(index % n.views) / (n.views - 1));
                const struct transport_family family =
                    gather(out, solution, peaked, radius_m, mu, w);
                store(out, &family, bands, w, index);
            }
            lanes_restore(state);
            worker_destroy(ctx, w);
        }
        result = has_memory ? trl_progress(ctx, "tabulating the sky",
                                           (double)(first + BLOCK) / (n.altitudes + BLOCK))
                            : TRL_ERROR_MEMORY;
    }
    if (result != TRL_OK) {
        table_finish(ctx, out);
    }
    return result;
}

struct table_cell table_cell_at(double coordinate, int count)
{
    const double position = fmin(fmax(coordinate, 0), 1) * (count - 1);
    const int below = position < count - 2 ? (int)position : count - 2;
    return (struct table_cell){below, (float)(position - below)};
}

static struct table_cell altitude_cell(const struct table *table, const struct optics *optics,
                                       double radius_m)
{
    const double ground = optics->ground_radius_m;
    const double top = optics->top_radius_m;
    const double square = fmax(0, (radius_m - ground) * (radius_m + ground));
    return table_cell_at(sqrt(square / ((top - ground) * (top + ground))), table->size.altitudes);
}

static const float *slice_of(const struct table *table, int channel, int altitude)
{
    return table->texels +
           ((size_t)channel * table->size.altitudes + (size_t)altitude) * slice_floats(table);
}

void table_slice(const struct table *table, const struct optics *optics, int channel,
                 double radius_m, float *texels)
{
    const struct table_cell altitude = altitude_cell(table, optics, radius_m);
    const float *a = slice_of(table, channel, altitude.below);
    const float *b = slice_of(table, channel, altitude.below + 1);
    const size_t count = slice_floats(table);
    for (size_t k = 0; k < count; k++) {
        texels[k] = a[k] + (b[k] - a[k]) * altitude.part;
    }
}

// With a negative part light goes on to fall as it does between the two, at least by a factor e for
// a whole one.
static float interpolate_log(float a, float b, float part)
{
    if (part < 0) {
        const float fall = a > 0 && b > 0 ? logf(b) - logf(a) : 0;
        return a * expf(fmaxf(fall, 1) * part);
    }
    return a > 0 && b > 0 ? expf(logf(a) + (logf(b) - logf(a)) * part) : a + (b - a) * part;
}

void table_slice_at_sun(const struct table *table, const struct optics *optics, int channel,
                        double radius_m, double sun_mu, float *texels)
{
    const struct table_cell altitude = altitude_cell(table, optics, radius_m);
    struct table_cell sun = table_cell_at(
        sky_map_sun(sun_mu, table->sun_centre, table->sun_width, table->sun_first, table->sun_last),
        table->size.suns);
    const double z = asinh((sun_mu - table->sun_centre) / table->sun_width);
    if (z < table->sun_first) {
        sun.part = (float)((z - table->sun_first) / (table->sun_last - table->sun_first) *
                           (table->size.suns - 1));
    }
    const size_t row = (size_t)table->size.azimuths * TEXEL_FLOATS;
    const float *a = slice_of(table, channel, altitude.below);
    const float *b = slice_of(table, channel, altitude.below + 1);
    for (int v = 0; v < table->size.views; v++) {
        const size_t at = ((size_t)v * table->size.suns + (size_t)sun.below) * row;
        for (size_t k = at; k < at + row; k++) {
            const float before = a[k] + (b[k] - a[k]) * altitude.part;
            const float after = a[k + row] + (b[k + row] - a[k + row]) * altitude.part;
            *texels++ = interpolate_log(before, after, sun.part);
        }
    }
}
