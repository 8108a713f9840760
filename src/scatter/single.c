// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/single.h"

#include "shared/single_map.glsl"
#include "shared/sky_map.glsl"

#include <math.h>
#include <string.h>

// The integrand has a kink where the ray leaves the planet's shadow, elsewhere for each star.
static const double NODES_PER_SHELL = 64;
static const double MORE_NODES_PER_DEPTH = 12; // of vertical optical depth, up to 8 of it
static const double DEPTH_NODES_PER_SHELL = 32;
// Stars as low as this many dips of the horizon (seen from the top) still light the far end of a
// ray that enters the air here: two of them lie between its ends, one more below the last.
static const double DARKNESS_DIPS = 2.2;
static const double TWILIGHT_DIPS = 0.4; // where the grid is densest, and over how much
// The lowest altitude, where rays that meet the ground have no length, stands this high.
static const double LOWEST_M = 0.01;

static double longest_m(const struct optics *optics)
{
    return sqrt((optics->top_radius_m - optics->ground_radius_m) *
                (optics->top_radius_m + optics->ground_radius_m));
}

static double altitude_at(const struct optics *optics, double height)
{
    return single_altitude(height, optics->ground_radius_m, longest_m(optics));
}

static bool is_same_phase(const struct phase *a, const struct phase *b)
{
    enum { ANGLES = 65 };
    for (int k = 0; k < ANGLES; k++) {
        const double nu = cos(M_PI * k / (ANGLES - 1));
        if (phase_value(a, nu) != phase_value(b, nu)) {
            return false;
        }
    }
    return true;
}

// Groups the constituents by their phase functions; the weakest groups share the last channel when
// there are more than channels.
static void choose_channels(struct single_tables *t)
{
    const struct optics *optics = t->optics;
    const double *depth = optics->vertical_scattering_depth;
    int group[MEDIUM_MAX_CONSTITUENTS];
    double strength[MEDIUM_MAX_CONSTITUENTS] = {0};
    int groups = 0;
    int first[MEDIUM_MAX_CONSTITUENTS];
    for (int i = 0; i < optics->constituent_count; i++) {
        group[i] = -1;
        for (int g = 0; g < groups && depth[i] > 0 && group[i] < 0; g++) {
            if (is_same_phase(&optics->medium->constituents[first[g]].phase,
                              &optics->medium->constituents[i].phase)) {
                group[i] = g;
            }
        }
        if (depth[i] > 0 && group[i] < 0) {
            first[groups] = i;
            group[i] = groups++;
        }
        if (group[i] >= 0) {
            strength[group[i]] += depth[i];
        }
    }
    t->channels = groups < SINGLE_CHANNELS ? groups : SINGLE_CHANNELS;
    double sum[SINGLE_CHANNELS] = {0};
    for (int i = 0; i < optics->constituent_count; i++) {
        int rank = 0; // of its group, the strongest first
        for (int g = 0; g < groups && group[i] >= 0; g++) {
            rank += strength[g] > strength[group[i]] ||
                    (strength[g] == strength[group[i]] && g < group[i]);
        }
        t->channel[i] = group[i] < 0 ? -1 : rank < t->channels ? rank : t->channels - 1;
        if (t->channel[i] >= 0) {
            sum[t->channel[i]] += depth[i];
        }
    }
    for (int i = 0; i < optics->constituent_count; i++) {
        t->weight[i] = t->channel[i] < 0 ? 0 : depth[i] / sum[t->channel[i]];
    }
}

double single_phase(const struct single_tables *t, int channel, double nu)
{
    double sum = 0;
    for (int i = 0; i < t->optics->constituent_count; i++) {
        if (t->channel[i] == channel) {
            sum += t->weight[i] * phase_value(&t->optics->medium->constituents[i].phase, nu);
        }
    }
    return sum;
}

static void choose_suns(struct single_tables *t)
{
    const struct optics *optics = t->optics;
    const double dip_rad = acos(optics->ground_radius_m / optics->top_radius_m) + t->sun.disc_rad;
    t->sun_centre = -sin(fmin(TWILIGHT_DIPS * dip_rad, M_PI_2));
    t->sun_width = fmax(-t->sun_centre, 1e-3);
    const double darkest = -sin(fmin(DARKNESS_DIPS * dip_rad, M_PI_2));
    t->sun_first = asinh((darkest - t->sun_centre) / t->sun_width);
    t->sun_last = asinh((1 - t->sun_centre) / t->sun_width);
}

static double sun_mu_at(const struct single_tables *t, int sun)
{
    const double z = t->sun_first + (t->sun_last - t->sun_first) * sun / (SINGLE_SUNS - 1);
    return fmin(1, t->sun_centre + t->sun_width * sinh(z));
}

// A ray by the distance to its end: the top for those that miss the ground.
struct table_ray {
    double radius_m, mu, way_m;
    bool meets_ground;
};

static struct table_ray make_table_ray(const struct optics *optics, double altitude_m, double view,
                                       bool meets_ground)
{
    const double ground = optics->ground_radius_m;
    const double top = optics->top_radius_m;
    const double horizon_m = single_horizon(altitude_m, ground);
    struct table_ray ray = {.radius_m = ground + altitude_m, .meets_ground = meets_ground};
    const double r = ray.radius_m;
    const double horizon_mu = -horizon_m / r;
    if (meets_ground) {
        ray.way_m = altitude_m + (horizon_m - altitude_m) * view * view;
        ray.mu = -(altitude_m * (ground + r) + ray.way_m * ray.way_m) / (2 * r * ray.way_m);
        ray.mu = fmax(-1, fmin(ray.mu, horizon_mu - 1e-12));
    } else {
        ray.way_m = fmax(sky_map_view_distance(view, top - r, horizon_m + longest_m(optics)), 1e-3);
        ray.mu = ((top - r) * (top + r) - ray.way_m * ray.way_m) / (2 * r * ray.way_m);
        ray.mu = fmin(1, fmax(ray.mu, horizon_mu + 1e-12));
    }
    return ray;
}

struct single_worker {
    struct ray ray;
    struct transport_scratch *scratch;
    float sun_mu[SINGLE_SUNS], nu[SINGLE_SUNS];
    lanes radiance[SINGLE_CHANNELS][SINGLE_SUNS];
};

// Light of all suns of the family along one ray, per channel. Zero where there is no way.
static void gather(const struct single_tables *t, const struct table_ray *at, int suns,
                   struct single_worker *w)
{
    const struct optics *optics = t->optics;
    const double sine = sqrt(fmax(0, 1 - at->mu * at->mu));
    for (int s = 0; s < suns; s++) {
        const double sun_mu = (double)w->sun_mu[s];
        w->nu[s] = (float)(at->mu * sun_mu + sine * sqrt(fmax(0, 1 - sun_mu * sun_mu)));
    }
    const double depth = fmin(optics_largest_depth(optics), 8);
    const struct ray_desc desc = {.radius_m = at->radius_m,
                                  .mu = at->mu,
                                  .nodes_per_shell = NODES_PER_SHELL + MORE_NODES_PER_DEPTH * depth,
                                  .end_m = at->meets_ground ? at->way_m : HUGE_VAL};
    ray_init(&w->ray, optics, t->rules, &desc);
    struct transport_channels channels = {.phase = {NULL}};
    memcpy(channels.channel, t->channel, sizeof channels.channel);
    lanes *out[SINGLE_CHANNELS];
    for (int c = 0; c < SINGLE_CHANNELS; c++) {
        out[c] = w->radiance[c];
    }
    memset(w->radiance, 0, sizeof w->radiance);
    const struct transport_family family = {suns, w->sun_mu, w->nu};
    transport_add_single(&t->sun, &w->ray, &family, &channels, out, w->scratch);
}

// Spectra of the light that the air adds, for angles from the star of 30 to 150 degrees: the sky
// and ground seen from some altitudes; rays that meet the ground near its surface are short ways.
static void add_air(struct single_tables *t, struct single_worker *w, int suns,
                    struct band_fit *fit)
{
    static const double heights[] = {0, 0.15, 0.4, 1};
    static const double views[] = {0, 0.3, 0.6, 0.8, 0.95};
    enum { HEIGHTS = sizeof heights / sizeof *heights, VIEWS = sizeof views / sizeof *views };
    for (int k = 0; k < HEIGHTS * VIEWS * 2; k++) {
        const double altitude_m = altitude_at(t->optics, heights[k / 2 / VIEWS]);
        const struct table_ray ray =
            make_table_ray(t->optics, fmax(altitude_m, LOWEST_M), views[k / 2 % VIEWS], k % 2 == 0);
        gather(t, &ray, suns, w);
        for (int s = 0; s < suns; s++) {
            for (int angle = 30; angle <= 150; angle += 60) {
                lanes sum = {0};
                for (int c = 0; c < t->channels; c++) {
                    sum += w->radiance[c][s] * (float)single_phase(t, c, cos(angle * M_PI / 180));
                }
                band_fit_add(fit, &sum);
            }
        }
    }
}

static void choose_bands(const trl_context *ctx, struct single_tables *t, struct single_worker *w)
{
    static const int suns_deg[] = {0, 40, 60, 70, 80, 85, 88, 90, 92, 94};
    enum { SUNS = sizeof suns_deg / sizeof *suns_deg };
    struct band_fit ground;
    struct band_fit air;
    band_fit_init(&ground, t->optics);
    band_fit_init(&air, t->optics);
    for (int s = 0; s < SUNS; s++) {
        w->sun_mu[s] = (float)cos(suns_deg[s] * M_PI / 180);
        lanes star;
        sunlight_at(&t->sun, t->optics->ground_radius_m, (double)w->sun_mu[s], &star);
        band_fit_add_surfaces(&ground, &star);
    }
    add_air(t, w, SUNS, &air);
    band_fit_choose_both(&ground, &air, &t->bands, &t->added);
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < LANES; i++) {
            t->rgb_from_lanes[k][i] = (float)air.rgb_from_lanes[k][i];
        }
    }
    trl_log(ctx, TRL_LOG_DEBUG, TRL_LOG_ITEM_SOLVER,
            "single scattering: bands at %.0f, %.0f, %.0f, %.0f nm reproduce colours of ground to "
            "%.2f %%, of air to %.2f %%",
            t->bands.nm[0], t->bands.nm[1], t->bands.nm[2], t->bands.nm[3],
            100 * t->bands.rms_error, 100 * t->added.rms_error);
}

static void store_bands(const struct bands *bands, const lanes *value, double scale, float *texel)
{
    for (int b = 0; b < BAND_COUNT; b++) {
        texel[b] = (float)((double)(*value)[bands->lane[b]] * scale);
    }
}

static void store_colour(const struct single_tables *t, const lanes *value, double scale,
                         float *texel)
{
    for (int k = 0; k < 3; k++) {
        const lanes product = t->rgb_from_lanes[k] * *value;
        float sum = 0;
        for (int i = 0; i < LANES; i++) {
            sum += product[i];
        }
        texel[k] = sum * (float)scale;
    }
    texel[3] = 0;
}

static void fill_ray(struct single_tables *t, struct single_worker *w, int height, int view)
{
    const bool meets_ground = view < SINGLE_GROUND_VIEWS;
    const double x = meets_ground ? (double)view / (SINGLE_GROUND_VIEWS - 1)
                                  : (double)(view - SINGLE_GROUND_VIEWS) /
                                        (SINGLE_VIEWS - SINGLE_GROUND_VIEWS - 1);
    const double altitude_m =
        fmax(altitude_at(t->optics, (double)height / (SINGLE_HEIGHTS - 1)), LOWEST_M);
    const struct table_ray ray = make_table_ray(t->optics, altitude_m, x, meets_ground);
    gather(t, &ray, SINGLE_SUNS, w);
    const double scale = meets_ground ? 1 / ray.way_m : 1;
    for (int c = 0; c < t->channels; c++) {
        for (int s = 0; s < SINGLE_SUNS; s++) {
            const size_t texel =
                ((size_t)height * SINGLE_SUNS + (size_t)s) * SINGLE_VIEWS + (size_t)view;
            store_colour(t, &w->radiance[c][s], scale, t->scattered[c] + texel * BAND_COUNT);
        }
    }
}

static void fill_depth(struct single_tables *t, struct single_worker *w, int height)
{
    const struct optics *optics = t->optics;
    const double altitude_m = altitude_at(optics, (double)height / (SINGLE_HEIGHTS - 1));
    for (int v = 0; v < SINGLE_DEPTH_VIEWS; v++) {
        const struct table_ray at =
            make_table_ray(optics, altitude_m, (double)v / (SINGLE_DEPTH_VIEWS - 1), false);
        const struct ray_desc desc = {.radius_m = at.radius_m,
                                      .mu = at.mu,
                                      .nodes_per_shell = DEPTH_NODES_PER_SHELL,
                                      .end_m = INFINITY};
        ray_init(&w->ray, optics, t->rules, &desc);
        lanes depth = {0};
        for (int i = 0; i < optics->constituent_count; i++) {
            depth += optics->extinction_per_m[i] * (float)w->ray.column_m[i];
        }
        store_bands(&t->bands, &depth, 1,
                    t->depth + ((size_t)height * SINGLE_DEPTH_VIEWS + (size_t)v) * BAND_COUNT);
    }
}

static void fill_light(struct single_tables *t, int height)
{
    const double ground = t->optics->ground_radius_m;
    const double altitude_m = altitude_at(t->optics, (double)height / (SINGLE_HEIGHTS - 1));
    const double lowest =
        sky_map_lowest_sun(ground, altitude_m, cos(t->sun.disc_rad), sin(t->sun.disc_rad));
    const double scale = log(1 + (1 - lowest) / SUNLIGHT_SOFT);
    for (int s = 0; s < SINGLE_LIGHT_SUNS; s++) {
        const double x = (double)s / (SINGLE_LIGHT_SUNS - 1);
        lanes light;
        sunlight_at(&t->sun, ground + altitude_m, lowest + SUNLIGHT_SOFT * expm1(x * scale),
                    &light);
        store_bands(&t->bands, &light, 1,
                    t->light + ((size_t)height * SINGLE_LIGHT_SUNS + (size_t)s) * BAND_COUNT);
    }
}

static void fill_medium(struct single_tables *t)
{
    const struct optics *optics = t->optics;
    for (int a = 0; a < SINGLE_MEDIUM_ALTITUDES; a++) {
        const double altitude_m = altitude_at(optics, (double)a / (SINGLE_MEDIUM_ALTITUDES - 1));
        lanes extinction = {0};
        lanes scattering[SINGLE_CHANNELS] = {{0}};
        for (int i = 0; i < optics->constituent_count; i++) {
            const float density =
                (float)profile_density(&optics->medium->constituents[i].profile, altitude_m);
            extinction += optics->extinction_per_m[i] * density;
            if (t->channel[i] >= 0) {
                scattering[t->channel[i]] += optics->scattering_per_m[i] * density;
            }
        }
        store_bands(&t->bands, &extinction, 1, t->medium + (size_t)a * BAND_COUNT);
        for (int c = 0; c < t->channels; c++) {
            store_bands(&t->bands, &scattering[c], 1,
                        t->medium +
                            ((size_t)(1 + c) * SINGLE_MEDIUM_ALTITUDES + (size_t)a) * BAND_COUNT);
        }
    }
}

static trl_result fill_tables(const trl_context *ctx, struct single_tables *t,
                              struct single_worker *workers, int worker_count)
{
    (void)worker_count; // without OpenMP there is one
    trl_result result = TRL_OK;
    // Some heights at a time, so that the user can be told, and can stop it.
    enum { BLOCK = 16 };
    for (int first = 0; first < SINGLE_HEIGHTS && result == TRL_OK; first += BLOCK) {
#pragma omp parallel for schedule(dynamic) num_threads(worker_count)
        for (int height = first; height < first + BLOCK; height++) {
            struct single_worker *w = &workers[lanes_thread()];
            const unsigned state = lanes_flush_denormals();
            for (int s = 0; s < SINGLE_SUNS; s++) {
                w->sun_mu[s] = (float)sun_mu_at(t, s);
            }
            for (int view = 0; view < SINGLE_VIEWS; view++) {
                fill_ray(t, w, height, view);
            }
            fill_depth(t, w, height);
            fill_light(t, height);
            lanes_restore(state);
        }
        result = trl_progress(ctx, "tabulating single scattering",
                              (double)(first + BLOCK) / SINGLE_HEIGHTS);
    }
    fill_medium(t);
    return result;
}

static trl_result reserve(const trl_context *ctx, struct single_tables *t)
{
    const size_t heights = SINGLE_HEIGHTS;
    t->depth = mem_alloc(ctx, heights * SINGLE_DEPTH_VIEWS * BAND_COUNT, sizeof(float));
    t->light = mem_alloc(ctx, heights * SINGLE_LIGHT_SUNS * BAND_COUNT, sizeof(float));
    t->medium = mem_alloc(ctx, (size_t)(1 + t->channels) * SINGLE_MEDIUM_ALTITUDES * BAND_COUNT,
                          sizeof(float));
    bool has_memory = t->depth && t->light && t->medium;
    for (int c = 0; c < t->channels && has_memory; c++) {
        t->scattered[c] =
            mem_alloc(ctx, heights * SINGLE_SUNS * SINGLE_VIEWS * BAND_COUNT, sizeof(float));
        has_memory = t->scattered[c] != NULL;
    }
    return has_memory ? TRL_OK : TRL_ERROR_MEMORY;
}

static trl_result compute(const trl_context *ctx, struct single_tables *t)
{
    const int worker_count = lanes_max_threads();
    struct single_worker *workers = mem_alloc(ctx, (size_t)worker_count, sizeof *workers);
    trl_result result = workers ? TRL_OK : TRL_ERROR_MEMORY;
    for (int n = 0; n < worker_count && result == TRL_OK; n++) {
        result = transport_scratch_create(ctx, SINGLE_SUNS, 1, &workers[n].scratch);
    }
    if (result == TRL_OK) {
        choose_bands(ctx, t, &workers[0]);
        result = fill_tables(ctx, t, workers, worker_count);
    }
    for (int n = 0; workers && n < worker_count; n++) {
        transport_scratch_destroy(ctx, &workers[n].scratch);
    }
    mem_free(ctx, workers);
    return result;
}

trl_result single_tables_init(const trl_context *ctx, const struct optics *optics,
                              struct single_tables *out)
{
    *out = (struct single_tables){.optics = optics};
    choose_channels(out);
    out->rules = mem_alloc(ctx, 1, sizeof *out->rules);
    trl_result result = out->rules ? sunlight_reserve(ctx, optics, &out->sun) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        ray_rules_init(out->rules);
        result = sunlight_fill(ctx, out->rules, &out->sun);
    }
    if (result == TRL_OK) {
        choose_suns(out);
        result = reserve(ctx, out);
    }
    if (result == TRL_OK) {
        result = compute(ctx, out);
    }
    if (result != TRL_OK) {
        single_tables_finish(ctx, out);
    }
    return result;
}

void single_tables_drop(const trl_context *ctx, struct single_tables *t)
{
    for (int c = 0; c < SINGLE_CHANNELS; c++) {
        mem_free(ctx, t->scattered[c]);
        t->scattered[c] = NULL;
    }
    mem_free(ctx, t->depth);
    mem_free(ctx, t->light);
    mem_free(ctx, t->medium);
    t->depth = t->light = t->medium = NULL;
    mem_free(ctx, t->rules);
    t->rules = NULL;
}

void single_tables_finish(const trl_context *ctx, struct single_tables *t)
{
    single_tables_drop(ctx, t);
    sunlight_finish(ctx, &t->sun);
    *t = (struct single_tables){0};
}
