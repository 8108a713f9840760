// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// One order of scattering after another in and around a shadow, and as it would be without.
#include "scatter/umbra.h"

#include "shared/eclipse.glsl"

#include <math.h>
#include <string.h>

// Higher orders come from no farther than the last one that is computed, and decay evenly.
enum { ORDERS = 4, DIRECTIONS = 8, VISIBLE_SAMPLES = 1024 };

// Cosine of the lowest star's zenith angle: below, the shadow would be longer than the planet.
static const double LOWEST_STAR = 0.03;

static double umbra_scale_m(const struct umbra_shadow *shadow)
{
    return 0.1 * (shadow->radius_m + shadow->along_m * shadow->star_rad);
}

// Light of one order: in the air as mean intensity, on the ground as irradiance; in a shadow, and
// without.
struct light {
    umbra_bands air[UMBRA_ALTITUDES][UMBRA_PLACES];
    umbra_bands ground[UMBRA_PLACES];
    umbra_bands open_air[UMBRA_ALTITUDES];
    umbra_bands open_ground;
    bool is_star; // its own: only the open light is filled in
};

struct work {
    const struct umbra_kernel *kernel;
    double scale_m;
    double star_mu, star_sine;
    struct light light[2]; // of an order and of the next
    struct light sum;      // of orders from 1 on
    umbra_bands reflected[UMBRA_PLACES];
    float visible[VISIBLE_SAMPLES + 1]; // of the star, over [0, 1] of umbra_coordinate
};

static double place_m(double coordinate, double scale_m)
{
    return scale_m * coordinate / (1 - fabs(coordinate));
}

// Nodes stand in the middle of cells, so that none is at infinity.
static double node_u(const struct work *work, int i)
{
    return place_m((2 * i + 1.0) / UMBRA_US - 1, work->scale_m);
}

static double node_v(const struct work *work, int i)
{
    return place_m((i + 0.5) / UMBRA_VS, work->scale_m);
}

static umbra_bands look_up(const umbra_bands *map, float u, float v, float scale)
{
    const float x = 0.5f * UMBRA_US * (1 + u / (fabsf(u) + scale)) - 0.5f;
    const float y = UMBRA_VS * (fabsf(v) / (fabsf(v) + scale)) - 0.5f;
    const int i = x > 0 ? (x < UMBRA_US - 2 ? (int)x : UMBRA_US - 2) : 0;
    const int j = y > 0 ? (y < UMBRA_VS - 2 ? (int)y : UMBRA_VS - 2) : 0;
    const float right = fminf(fmaxf(x - (float)i, 0), 1);
    const float up = fminf(fmaxf(y - (float)j, 0), 1);
    const umbra_bands *row = map + j * UMBRA_US + i;
    return (row[0] * (1 - right) + row[1] * right) * (1 - up) +
           (row[UMBRA_US] * (1 - right) + row[UMBRA_US + 1] * right) * up;
}

static float look_up_star(const struct work *work, float u, float v)
{
    const float across = sqrtf(u * u + v * v);
    const float x = across / (across + (float)work->scale_m) * VISIBLE_SAMPLES;
    const int i = x < VISIBLE_SAMPLES - 1 ? (int)x : VISIBLE_SAMPLES - 1;
    return work->visible[i] + (work->visible[i + 1] - work->visible[i]) * (x - (float)i);
}

// Light at one altitude for places that are so much lower.
struct sources {
    const umbra_bands *map;     // NULL: of the star itself
    umbra_bands open;           // of which this is visible
    const umbra_bands *weights; // of rings
    double rise_m;
};

// What of it reaches a place.
static umbra_bands gather(const struct work *work, const struct sources *sources, float u, float v)
{
    static const float cosine[DIRECTIONS / 2] = {0.92387953f, 0.38268343f, -0.38268343f,
                                                 -0.92387953f};
    static const float sine[DIRECTIONS / 2] = {0.38268343f, 0.92387953f, 0.92387953f, 0.38268343f};
    const float scale = (float)work->scale_m;
    const double ground_m = work->kernel->optics->ground_radius_m;
    umbra_bands sum = {0};
    for (int r = 0; r < UMBRA_RINGS; r++) {
        const umbra_bands weight = sources->weights[r];
        if (weight[0] + weight[1] + weight[2] + weight[3] <= 0) {
            continue;
        }
        const double ring_m = work->kernel->ring_m[r];
        // The ground falls away below the level through the place.
        const double rise_m = sources->rise_m - ring_m * ring_m / (2 * ground_m);
        const float shift = (float)(-rise_m * work->star_sine);
        umbra_bands mean = {0};
        for (int k = 0; k < DIRECTIONS / 2; k++) {
            const float along = (float)(ring_m * work->star_mu) * cosine[k] + u + shift;
            const float aside = (float)ring_m * sine[k];
            mean += sources->map ? look_up(sources->map, along, v + aside, scale) +
                                       look_up(sources->map, along, v - aside, scale)
                                 : sources->open * (look_up_star(work, along, v + aside) +
                                                    look_up_star(work, along, v - aside));
        }
        sum += weight * mean * (1.0f / DIRECTIONS);
    }
    return sum;
}

static umbra_bands sum_rings(const umbra_bands *weights)
{
    umbra_bands sum = {0};
    for (int r = 0; r < UMBRA_RINGS; r++) {
        sum += weights[r];
    }
    return sum;
}

// Light of the next order at one altitude, or on the ground, from one altitude, or the ground.
static void add_sources(const struct work *work, const struct sources *sources, umbra_bands *out)
{
    for (int j = 0; j < UMBRA_VS; j++) {
        const float v = (float)node_v(work, j);
        for (int i = 0; i < UMBRA_US; i++) {
            out[j * UMBRA_US + i] += gather(work, sources, (float)node_u(work, i), v);
        }
    }
}

static void scatter(struct work *work, const struct light *from, struct light *to)
{
    const struct umbra_kernel *k = work->kernel;
    const umbra_bands reflects = k->ground_albedo * (float)(1 / SHARED_PI);
    for (int p = 0; p < UMBRA_PLACES; p++) {
        work->reflected[p] = from->ground[p] * reflects;
    }
    memset(to, 0, sizeof *to);
    for (int a = 0; a < UMBRA_ALTITUDES; a++) {
        for (int b = 0; b < UMBRA_ALTITUDES; b++) {
            const struct sources air = {from->is_star ? NULL : from->air[b], from->open_air[b],
                                        k->air_air[a][b], k->altitude_m[b] - k->altitude_m[a]};
            add_sources(work, &air, to->air[a]);
            to->open_air[a] += sum_rings(k->air_air[a][b]) * from->open_air[b];
        }
        const struct sources ground = {from->is_star ? NULL : work->reflected,
                                       from->open_ground * reflects, k->air_ground[a],
                                       -k->altitude_m[a]};
        add_sources(work, &ground, to->air[a]);
        to->open_air[a] += sum_rings(k->air_ground[a]) * from->open_ground * reflects;
        const struct sources sky = {from->is_star ? NULL : from->air[a], from->open_air[a],
                                    k->ground_air[a], k->altitude_m[a]};
        add_sources(work, &sky, to->ground);
        to->open_ground += sum_rings(k->ground_air[a]) * from->open_air[a];
    }
}

// Light of the star itself.
static void light_directly(struct work *work, const struct umbra_shadow *shadow, struct light *to)
{
    const struct umbra_kernel *k = work->kernel;
    for (int a = 0; a < UMBRA_ALTITUDES; a++) {
        to->open_air[a] = umbra_kernel_direct(k, k->altitude_m[a], work->star_mu, UMBRA_SIMILAR) *
                          (float)(0.25 / SHARED_PI);
    }
    to->is_star = true;
    to->open_ground =
        umbra_kernel_direct(k, 0, work->star_mu, UMBRA_SIMILAR) * (float)work->star_mu;
    for (int i = 0; i <= VISIBLE_SAMPLES; i++) {
        const double across_m = place_m(fmin((double)i / VISIBLE_SAMPLES, 0.9999), work->scale_m);
        work->visible[i] =
            (float)eclipse_shadow(across_m, shadow->along_m, shadow->radius_m, shadow->star_rad);
    }
}

// How often an order counts.
struct factor {
    umbra_bands air[UMBRA_ALTITUDES], ground;
};

static void add_light(struct light *sum, const struct light *light, const struct factor *factor)
{
    for (int a = 0; a < UMBRA_ALTITUDES; a++) {
        for (int p = 0; p < UMBRA_PLACES; p++) {
            sum->air[a][p] += light->air[a][p] * factor->air[a];
        }
        sum->open_air[a] += light->open_air[a] * factor->air[a];
    }
    for (int p = 0; p < UMBRA_PLACES; p++) {
        sum->ground[p] += light->ground[p] * factor->ground;
    }
    sum->open_ground += light->open_ground * factor->ground;
}

// 1 + q + q^2 + ... for what the last order has of the one before.
static umbra_bands sum_series(umbra_bands last, umbra_bands before)
{
    umbra_bands sum;
    for (int k = 0; k < BAND_COUNT; k++) {
        const float ratio = before[k] > 0 ? fminf(last[k] / before[k], 0.99f) : 0;
        sum[k] = 1 / (1 - ratio);
    }
    return sum;
}

// Light on the ground that similarity leaves in the star's own beam: scattered, but not far.
static void add_forward(struct work *work)
{
    const struct umbra_kernel *k = work->kernel;
    const umbra_bands light = (umbra_kernel_direct(k, 0, work->star_mu, UMBRA_SIMILAR) -
                               umbra_kernel_direct(k, 0, work->star_mu, UMBRA_WHOLE)) *
                              (float)work->star_mu;
    for (int p = 0; p < UMBRA_PLACES; p++) {
        work->sum.ground[p] += light * look_up_star(work, (float)node_u(work, p % UMBRA_US),
                                                    (float)node_v(work, p / UMBRA_US));
    }
    work->sum.open_ground += light;
}

// Orders from 1 on, of light that is scattered or reflected once more before it is seen; in all it
// may have `orders`, 0 for any number.
static void sum_orders(struct work *work, int orders)
{
    const bool is_limited = orders > 0 && orders <= ORDERS;
    const int last = is_limited ? orders - 1 : ORDERS;
    for (int n = 1; n <= last; n++) {
        const struct light *from = &work->light[(n + 1) % 2];
        struct light *to = &work->light[n % 2];
        scatter(work, from, to);
        const bool has_tail = n == last && !is_limited;
        const umbra_bands once = {1, 1, 1, 1};
        struct factor factor;
        for (int a = 0; a < UMBRA_ALTITUDES; a++) {
            factor.air[a] = has_tail ? sum_series(to->open_air[a], from->open_air[a]) : once;
        }
        factor.ground = has_tail ? sum_series(to->open_ground, from->open_ground) : once;
        add_light(&work->sum, to, &factor);
    }
}

// Of XYZ, how much each band stands for: the wavelengths between two bands are shared between them.
static void weigh_bands(const struct umbra_kernel *kernel, const struct bands *bands,
                        float weight[3][BAND_COUNT])
{
    for (int i = 0; i < kernel->optics->wavelength_count; i++) {
        const double nm = kernel->optics->wavelength_nm[i];
        int above = 0;
        while (above < BAND_COUNT && bands->nm[above] < nm) {
            above++;
        }
        const int right = above < BAND_COUNT ? above : BAND_COUNT - 1;
        const int left = above > 0 ? above - 1 : 0;
        const double width = bands->nm[right] - bands->nm[left];
        const double part = width > 0 ? (nm - bands->nm[left]) / width : 0;
        for (int c = 0; c < 3; c++) {
            weight[c][left] += bands->xyz_from_lanes[c][i] * (float)(1 - part);
            weight[c][right] += bands->xyz_from_lanes[c][i] * (float)part;
        }
    }
}

static float find_share(float light, float open)
{
    return open > 0 ? fminf(fmaxf(light / open, 0), 1) : 1;
}

// Light that was scattered forward only, relative to the star's own, at an altitude; by luminance.
static float find_forward(const struct work *work, int altitude, const float weight[BAND_COUNT])
{
    const struct umbra_kernel *k = work->kernel;
    const double altitude_m = k->altitude_m[altitude];
    const umbra_bands similar = umbra_kernel_direct(k, altitude_m, work->star_mu, UMBRA_SIMILAR);
    const umbra_bands whole = umbra_kernel_direct(k, altitude_m, work->star_mu, UMBRA_WHOLE);
    float more = 0;
    float all = 0;
    for (int b = 0; b < BAND_COUNT; b++) {
        more += weight[b] * (similar[b] - whole[b]);
        all += weight[b] * whole[b];
    }
    return all > 0 ? fmaxf(more / all, 0) : 0;
}

static void fill_map(const struct work *work, const struct bands *bands, struct umbra_map *out)
{
    const struct light *sum = &work->sum;
    float weight[3][BAND_COUNT] = {{0}};
    float forward[UMBRA_ALTITUDES];
    weigh_bands(work->kernel, bands, weight);
    for (int a = 0; a < UMBRA_ALTITUDES; a++) {
        forward[a] = find_forward(work, a, weight[1]);
    }
    for (int p = 0; p < UMBRA_PLACES; p++) {
        const float star = look_up_star(work, (float)node_u(work, p % UMBRA_US),
                                        (float)node_v(work, p / UMBRA_US));
        for (int k = 0; k < BAND_COUNT; k++) {
            out->ground[p][k] = find_share(sum->ground[p][k], sum->open_ground[k]) - star;
        }
        for (int a = 0; a < UMBRA_ALTITUDES; a++) {
            float *texel = out->air[a * UMBRA_PLACES + p];
            for (int c = 0; c < 3; c++) {
                float light = 0;
                float open = 0;
                for (int k = 0; k < BAND_COUNT; k++) {
                    light += weight[c][k] * sum->air[a][p][k];
                    open += weight[c][k] * sum->open_air[a][k];
                }
                texel[c] = find_share(light, open) - star;
            }
            texel[3] = forward[a];
        }
    }
}

trl_result umbra_map_make(const trl_context *ctx, const struct umbra_kernel *kernel,
                          const struct umbra_shadow *shadow, const struct bands *bands,
                          struct umbra_map *out)
{
    struct work *work = mem_alloc(ctx, 1, sizeof *work);
    if (work) {
        work->kernel = kernel;
        work->scale_m = umbra_scale_m(shadow);
        work->star_mu = fmax(shadow->star_mu, LOWEST_STAR);
        work->star_sine = sqrt(1 - work->star_mu * work->star_mu);
        light_directly(work, shadow, &work->light[0]);
        add_forward(work);
        sum_orders(work, shadow->orders);
        out->scale_m = work->scale_m;
        fill_map(work, bands, out);
    }
    const trl_result result = work ? TRL_OK : TRL_ERROR_MEMORY;
    mem_free(ctx, work);
    return result;
}
