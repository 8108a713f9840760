// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/aerial.h"

#include "shared/phase.glsl"
#include "shared/sky_map.glsl"

#include <math.h>
#include <string.h>

// Of a cell; in dense matter more, since light dies away within it.
enum { LEAST_NODES = 2, MOST_NODES = RAY_RULE_NODES };

// The first depth stands this close to the start, in units of the depth coordinate, instead of at
// 0, where a mean over no distance has no meaning.
static const double FIRST_DEPTH = 0.1;

// Vertical optical depth of air that hides what is below; slanted rays see less of that.
static const double OPAQUE_DEPTH = 2;

struct aerial_worker {
    struct ray ray;
    struct transport_scratch *scratch;
    float sun_mu[AERIAL_LONG], nu[AERIAL_LONG];
    float phase[MEDIUM_MAX_CONSTITUENTS][AERIAL_LONG];
    lanes radiance[1 + TABLE_MAX_PEAKED][AERIAL_LONG]; // up to here, all orders
    lanes cell[AERIAL_SOURCES][AERIAL_LONG];           // of one cell, as aerial.source
};

// Two streams over a ground of radiance 1 (L+ up, L- down, no absorption): their flux is the same
// at all altitudes, and each changes with the depth t of what is scattered backward,
// d L / dt = -3/4 flux. With L- = 0 at the top,
//
//     L+ - L- = 1 / (1 + 3/4 t_all),    (L+ + L-) / 2 = (1/2 + 3/4 t_above) / (1 + 3/4 t_all)
//
// and the air sends back 3/4 t_all / (1 + 3/4 t_all).
struct streams {
    lanes mean[AERIAL_LEVELS]; // (L+ + L-) / 2, at levels uniform in the shell coordinate
    lanes flux;                // L+ - L-
};

// Depth of what is scattered backward between two altitudes.
static lanes find_backward_depth(const struct optics *o, double low_m, double high_m)
{
    enum { STEPS = 8 };
    const double step_m = (high_m - low_m) / STEPS;
    lanes depth = {0};
    for (int k = 0; k < STEPS; k++) {
        double density[MEDIUM_MAX_CONSTITUENTS];
        for (int i = 0; i < o->constituent_count; i++) {
            density[i] =
                profile_density(&o->medium->constituents[i].profile, low_m + (k + 0.5) * step_m);
        }
        depth += (optics_source(o, density, 0) - optics_source(o, density, 1)) * (float)step_m;
    }
    return depth;
}

// The altitude below which little light comes from, in any band; 0 where the ground is seen.
static double find_opaque(const struct atmosphere *atmosphere)
{
    enum { STEPS = 1024 };
    const struct optics *o = atmosphere->optics;
    const double step_m = (o->top_radius_m - o->ground_radius_m) / STEPS;
    double depth[BAND_COUNT] = {0};
    for (int k = STEPS - 1; k >= 0; k--) {
        for (int i = 0; i < o->constituent_count; i++) {
            const double density =
                profile_density(&o->medium->constituents[i].profile, (k + 0.5) * step_m);
            for (int b = 0; b < BAND_COUNT; b++) {
                depth[b] +=
                    (double)o->extinction_per_m[i][atmosphere->bands.lane[b]] * density * step_m;
            }
        }
        double least = INFINITY;
        for (int b = 0; b < BAND_COUNT; b++) {
            least = fmin(least, depth[b]);
        }
        if (least > OPAQUE_DEPTH) {
            return k * step_m;
        }
    }
    return 0;
}

static void find_streams(struct aerial *a, struct streams *out)
{
    const struct optics *o = a->atmosphere->optics;
    lanes above[AERIAL_LEVELS];
    above[AERIAL_LEVELS - 1] = lanes_set(0);
    for (int k = AERIAL_LEVELS - 2; k >= 0; k--) {
        const double low_m = optics_altitude(o, (double)k / (AERIAL_LEVELS - 1));
        const double high_m = optics_altitude(o, (double)(k + 1) / (AERIAL_LEVELS - 1));
        above[k] = above[k + 1] + find_backward_depth(o, low_m, high_m);
    }
    out->flux = lanes_set(1) / (lanes_set(1) + above[0] * 0.75f);
    for (int k = 0; k < AERIAL_LEVELS; k++) {
        out->mean[k] = (lanes_set(0.5f) + above[k] * 0.75f) * out->flux;
    }
}

static lanes streams_mean(const struct streams *s, double shell)
{
    const double position = shell * (AERIAL_LEVELS - 1);
    const int level = position < AERIAL_LEVELS - 2 ? (int)fmax(position, 0) : AERIAL_LEVELS - 2;
    return s->mean[level] + (s->mean[level + 1] - s->mean[level]) * (float)(position - level);
}

// 1 - 1 / (1 + 3/4 t_above)
void aerial_air_albedo(const struct aerial *aerial, double altitude_m, float bands[BAND_COUNT])
{
    const struct streams *s = aerial->streams;
    const double shell = optics_shell(aerial->atmosphere->optics, altitude_m);
    const lanes up = streams_mean(s, shell) + s->flux * 0.5f;
    for (int b = 0; b < BAND_COUNT; b++) {
        const int lane = aerial->atmosphere->bands.lane[b];
        bands[b] = 1 - s->flux[lane] / up[lane];
    }
}

static size_t map_floats(void)
{
    return (size_t)AERIAL_ROWS * AERIAL_LONG * AERIAL_SHORT * TEXEL_FLOATS;
}

trl_result aerial_init(const struct atmosphere *atmosphere, struct aerial *out)
{
    const trl_context *ctx = atmosphere->ctx;
    *out = (struct aerial){.atmosphere = atmosphere, .worker_count = lanes_max_threads()};
    out->workers = mem_alloc(ctx, (size_t)out->worker_count, sizeof *out->workers);
    out->extinction = mem_alloc(ctx, (size_t)AERIAL_ROWS * AERIAL_LONG * BAND_COUNT, sizeof(float));
    out->bounce = mem_alloc(ctx, (size_t)AERIAL_ROWS * AERIAL_LONG * BAND_COUNT, sizeof(float));
    out->streams = mem_alloc(ctx, 1, sizeof *out->streams);
    bool has_memory = out->workers && out->extinction && out->bounce && out->streams;
    for (int c = 0; c <= atmosphere->peaked.count && has_memory; c++) {
        out->scattered[c] = mem_alloc(ctx, map_floats(), sizeof(float));
        has_memory = out->scattered[c] != NULL;
    }
    trl_result result = has_memory ? TRL_OK : TRL_ERROR_MEMORY;
    for (int n = 0; n < out->worker_count && result == TRL_OK; n++) {
        result = transport_scratch_create(ctx, AERIAL_LONG, atmosphere->solution.moments.suns,
                                          &out->workers[n].scratch);
    }
    if (result == TRL_OK) {
        find_streams(out, out->streams);
        out->opaque_m = find_opaque(atmosphere);
    } else {
        aerial_finish(out);
    }
    return result;
}

void aerial_finish(struct aerial *aerial)
{
    if (!aerial->atmosphere) {
        return;
    }
    const trl_context *ctx = aerial->atmosphere->ctx;
    for (int n = 0; aerial->workers && n < aerial->worker_count; n++) {
        transport_scratch_destroy(ctx, &aerial->workers[n].scratch);
    }
    mem_free(ctx, aerial->workers);
    mem_free(ctx, aerial->extinction);
    mem_free(ctx, aerial->bounce);
    mem_free(ctx, aerial->streams);
    for (int c = 0; c <= TABLE_MAX_PEAKED; c++) {
        mem_free(ctx, aerial->scattered[c]);
    }
    for (int c = 0; c < AERIAL_SOURCES; c++) {
        mem_free(ctx, aerial->source[c]);
    }
    *aerial = (struct aerial){0};
}

static int nodes_per_cell(const struct optics *optics)
{
    const double wanted = LEAST_NODES + 2 * log2(fmax(1, optics_largest_depth(optics)));
    return (int)fmin(wanted, MOST_NODES);
}

static bool has_source(const struct aerial *a)
{
    return a->source[AERIAL_MULTIPLE] != NULL;
}

trl_result aerial_add_source(struct aerial *a)
{
    for (int c = 0; c < AERIAL_SOURCES; c++) {
        if (!a->source[c] && (c <= a->atmosphere->peaked.count || c == AERIAL_MULTIPLE)) {
            a->source[c] = mem_alloc(a->atmosphere->ctx, map_floats(), sizeof(float));
            if (!a->source[c]) {
                return TRL_ERROR_MEMORY;
            }
        }
    }
    return TRL_OK;
}

// Cosine of the ray of a row; the inverse of the row coordinates of shared/sky_map.glsl.
static double row_mu(const struct aerial *a, int row)
{
    const double r = a->eye_radius_m;
    const double ground = a->atmosphere->optics->ground_radius_m;
    if (row < AERIAL_GROUND_ROWS) {
        const double x = (double)row / (AERIAL_GROUND_ROWS - 1);
        const double y = a->is_outside ? 0.5 - 0.5 * cos(M_PI * x) : x * x;
        const double distance = a->nearest_m + (a->farthest_m - a->nearest_m) * y;
        const double mu = ((ground - r) * (ground + r) - distance * distance) / (2 * r * distance);
        return fmax(-1, fmin(mu, a->horizon_mu - 1e-10));
    }
    const double x = (double)(row - AERIAL_GROUND_ROWS) / (AERIAL_AIR_ROWS - 1);
    return fmin(1, a->horizon_mu + (a->highest_mu - a->horizon_mu) * x * x + 1e-10);
}

static double sun_coordinate(const struct table *t, double sun_mu)
{
    return sky_map_sun(sun_mu, t->sun_centre, t->sun_width, t->sun_first, t->sun_last);
}

// Cosines of the azimuths of a row that is seen from outside: the inverse of sky_map_suns and
// sky_map_sun. `end_m` is where the ray meets the ground, or 0.
static void find_azimuths(const struct aerial *a, double mu, double sun_mu, double end_m,
                          double cos_azimuth[AERIAL_LONG])
{
    const struct table *t = &a->atmosphere->table;
    const double r = a->eye_radius_m;
    const double ground = a->atmosphere->optics->ground_radius_m;
    const SkyMapSuns suns =
        end_m > 0 ? sky_map_suns(r, end_m, ground, mu, sun_mu)
                  : sky_map_suns(r, -r * mu, r * sqrt(fmax(0, 1 - mu * mu)), mu, sun_mu);
    const double lowest = sun_coordinate(t, suns.middle - suns.reach);
    const double highest = sun_coordinate(t, suns.middle + suns.reach);
    for (int p = 0; p < a->azimuths; p++) {
        const double x = lowest + (highest - lowest) * p / (a->azimuths - 1);
        const double z = t->sun_first + (t->sun_last - t->sun_first) * x;
        const double cosine = (t->sun_centre + t->sun_width * sinh(z) - suns.middle) / suns.reach;
        cos_azimuth[p] = fmax(-1, fmin(1, cosine));
    }
}

static void fill_family(const struct aerial *a, struct aerial_worker *w, double mu, double sun_mu,
                        double end_m)
{
    double cos_azimuths[AERIAL_LONG];
    if (a->is_outside) {
        find_azimuths(a, mu, sun_mu, end_m, cos_azimuths);
    } else {
        for (int p = 0; p < a->azimuths; p++) {
            cos_azimuths[p] = 1 - 2.0 * p / (a->azimuths - 1);
        }
    }
    const double sine = sqrt(fmax(0, 1 - mu * mu));
    const double sun_sine = sqrt(fmax(0, 1 - sun_mu * sun_mu));
    for (int p = 0; p < a->azimuths; p++) {
        const double cos_azimuth = cos_azimuths[p];
        w->sun_mu[p] = (float)sun_mu;
        w->nu[p] = (float)(mu * sun_mu + sine * sun_sine * cos_azimuth);
    }
}

static size_t texel_at(const struct aerial *a, int row, int azimuth, int depth)
{
    const int line = a->is_outside ? depth : azimuth;
    const int column = a->is_outside ? azimuth : depth;
    return (((size_t)row * AERIAL_SHORT + (size_t)line) * AERIAL_LONG + (size_t)column) *
           TEXEL_FLOATS;
}

static void store_scattered(struct aerial *a, const struct aerial_worker *w, int row, int depth,
                            double length_m)
{
    for (int c = 0; c <= a->atmosphere->peaked.count; c++) {
        for (int p = 0; p < a->azimuths; p++) {
            const double phase = c == 0 ? phase_rayleigh((double)w->nu[p]) : 1;
            bands_xyz(&a->atmosphere->bands, &w->radiance[c][p], (float)(1 / (length_m * phase)),
                      a->scattered[c] + texel_at(a, row, p, depth));
        }
    }
}

static void store_source(struct aerial *a, const struct aerial_worker *w, int row, int depth,
                         double length_m)
{
    for (int c = 0; c < AERIAL_SOURCES; c++) {
        for (int p = 0; a->source[c] && p < a->azimuths; p++) {
            const bool is_peaked = c > 0 && c != AERIAL_MULTIPLE;
            const double phase = is_peaked ? 1 : phase_rayleigh((double)w->nu[p]);
            bands_xyz(&a->atmosphere->bands, &w->cell[c][p], (float)(1 / (length_m * phase)),
                      a->source[c] + texel_at(a, row, p, depth));
        }
    }
}

// Light of one cell, apart and added to that of the cells before.
static void add_cell(const struct aerial *a, struct aerial_worker *w,
                     const struct transport_family *family,
                     const struct transport_channels *channels)
{
    const struct atmosphere *atm = a->atmosphere;
    lanes *out[1 + TABLE_MAX_PEAKED];
    for (int c = 0; c <= TABLE_MAX_PEAKED; c++) {
        out[c] = w->cell[c];
    }
    memset(w->cell, 0, sizeof w->cell);
    transport_add_single(&atm->solution.sun, &w->ray, family, channels, out, w->scratch);
    transport_add_multiple(&atm->solution.moments, &w->ray, family, w->cell[AERIAL_MULTIPLE],
                           w->scratch);
    for (int p = 0; p < a->azimuths; p++) {
        for (int c = 0; c <= atm->peaked.count; c++) {
            w->radiance[c][p] += w->cell[c][p];
        }
        w->radiance[0][p] += w->cell[AERIAL_MULTIPLE][p];
    }
}

// What a node sends to the eye of the streams. Toward a zenith angle, a phase function of asymmetry
// g takes nearly 0.6 g more of the upper than of the lower stream (Henyey-Greenstein's share
// within a right angle is 0.92 for g = 0.7).
static lanes node_bounce(const struct aerial *a, const struct ray_node *node)
{
    const struct optics *o = a->atmosphere->optics;
    const struct streams *s = a->streams;
    const lanes mean = streams_mean(s, node->shell);
    const lanes source = optics_source(o, node->density, 0) * mean -
                         optics_source(o, node->density, 1) * s->flux * (float)(0.6 * node->mu);
    return optics_attenuation(o, node->column_m) * source * (float)node->weight_m;
}

static void store_bounce(struct aerial *a, const lanes *sum, int row, int depth, double length_m)
{
    for (int b = 0; b < BAND_COUNT; b++) {
        a->bounce[((size_t)row * AERIAL_LONG + (size_t)depth) * BAND_COUNT + b] =
            (float)((double)(*sum)[a->atmosphere->bands.lane[b]] / length_m);
    }
}

static void store_extinction(struct aerial *a, const double *column_m, int row, int depth,
                             double length_m)
{
    const struct optics *optics = a->atmosphere->optics;
    for (int b = 0; b < BAND_COUNT; b++) {
        double sum = 0;
        for (int i = 0; i < optics->constituent_count; i++) {
            sum += (double)optics->extinction_per_m[i][a->atmosphere->bands.lane[b]] * column_m[i];
        }
        a->extinction[((size_t)row * AERIAL_LONG + (size_t)depth) * BAND_COUNT + b] =
            (float)(sum / length_m);
    }
}

// Where a ray from outside is in dense air first, and the part of its depths that stand before.
static double find_dense(const struct aerial *a, double mu, bool hits_ground, double *before)
{
    const double pass_m = a->eye_radius_m * sqrt(fmax(0, 1 - mu * mu));
    const double dense_m = a->atmosphere->optics->ground_radius_m + a->opaque_m;
    *before = hits_ground && a->opaque_m == 0 ? 1 : 0.5;
    return -a->eye_radius_m * mu - ray_half_chord(dense_m, pass_m);
}

// The distances at which cells of a row begin and end: the inverse of sky_map_depth, and from
// outside of sky_map_depth_outside.
static void find_bounds(const struct aerial *a, double mu, bool hits_ground, double begin_m,
                        double end_m, double *bound_m)
{
    double before;
    double dense_m = find_dense(a, mu, hits_ground, &before);
    dense_m = fmax(begin_m, fmin(end_m, dense_m));
    bound_m[0] = begin_m;
    for (int d = 0; d < a->depths; d++) {
        const double x = fmax(d, FIRST_DEPTH) / (a->depths - 1);
        if (!a->is_outside) {
            bound_m[d + 1] = begin_m + (end_m - begin_m) * x * x;
        } else if (x <= before) {
            const double left = 1 - x / before;
            bound_m[d + 1] = dense_m - (dense_m - begin_m) * left * left;
        } else {
            const double gone = (x - before) / (1 - before);
            bound_m[d + 1] = dense_m + (end_m - dense_m) * gone * gone;
        }
    }
}

// Marches one row cell by cell and stores the means up to each bound.
static void march_row(struct aerial *a, struct aerial_worker *w, int row, double sun_mu)
{
    const struct atmosphere *atm = a->atmosphere;
    const struct optics *optics = atm->optics;
    const double mu = row_mu(a, row);
    double begin_m;
    double end_m;
    bool hits_ground;
    if (!ray_clip(optics, a->eye_radius_m, mu, &begin_m, &end_m, &hits_ground)) {
        end_m = begin_m + 1; // grazes the top: nothing there
    }
    double bound_m[AERIAL_LONG + 1];
    find_bounds(a, mu, hits_ground, begin_m, end_m, bound_m);
    const struct ray_desc desc = {.radius_m = a->eye_radius_m, .mu = mu};
    const int nodes = nodes_per_cell(optics);
    ray_init_cells(&w->ray, optics, atm->solution.rules, &desc, bound_m, a->depths, nodes);
    fill_family(a, w, mu, sun_mu, hits_ground ? end_m : 0);
    const struct transport_family family = {a->azimuths, w->sun_mu, w->nu};
    float *phase[MEDIUM_MAX_CONSTITUENTS];
    for (int i = 0; i < MEDIUM_MAX_CONSTITUENTS; i++) {
        phase[i] = w->phase[i];
    }
    const struct transport_channels channels =
        peaked_channels(&atm->peaked, optics, &family, phase);
    memset(w->radiance, 0, sizeof w->radiance);
    double column_m[MEDIUM_MAX_CONSTITUENTS] = {0};
    lanes bounce = {0};
    for (int d = 0; d < a->depths; d++) {
        w->ray.first_node = d * nodes;
        w->ray.node_count = (d + 1) * nodes;
        add_cell(a, w, &family, &channels);
        for (int k = w->ray.first_node; k < w->ray.node_count; k++) {
            bounce += node_bounce(a, &w->ray.node[k]);
            for (int i = 0; i < optics->constituent_count; i++) {
                column_m[i] += w->ray.node[k].density[i] * w->ray.node[k].weight_m;
            }
        }
        const double length_m = fmax(bound_m[d + 1] - begin_m, 1e-9);
        store_scattered(a, w, row, d, length_m);
        store_extinction(a, column_m, row, d, length_m);
        store_bounce(a, &bounce, row, d, length_m);
        if (has_source(a)) {
            store_source(a, w, row, d, fmax(bound_m[d + 1] - bound_m[d], 1e-9));
        }
    }
}

void aerial_update(struct aerial *aerial, double radius_m, double sun_mu)
{
    const struct optics *optics = aerial->atmosphere->optics;
    const double ground = optics->ground_radius_m;
    const double top = optics->top_radius_m;
    const double r = fmax(radius_m, ground + AERIAL_MIN_ALTITUDE_M);
    const double sine = ground / r;
    aerial->eye_radius_m = r;
    aerial->is_outside = r > top;
    aerial->depths = aerial->is_outside ? AERIAL_SHORT : AERIAL_LONG;
    aerial->azimuths = aerial->is_outside ? AERIAL_LONG : AERIAL_SHORT;
    aerial->nearest_m = r - ground;
    aerial->farthest_m = sqrt((r - ground) * (r + ground));
    aerial->horizon_mu = -sqrt(1 - sine * sine);
    aerial->highest_mu = r > top ? -sqrt(1 - top / r * (top / r)) : 1;
#pragma omp parallel for schedule(dynamic, 4) num_threads(aerial->worker_count)
    for (int row = 0; row < AERIAL_ROWS; row++) {
        const unsigned state = lanes_flush_denormals();
        march_row(aerial, &aerial->workers[lanes_thread()], row, sun_mu);
        lanes_restore(state);
    }
}
