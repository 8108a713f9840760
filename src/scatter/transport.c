// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Compiled with -O3 -ffast-math: hot. Nothing here may depend on infinities or NaN.
#include "scatter/transport.h"

#include <math.h>

enum { SUN_COLUMNS = 256 };

struct transport_scratch {
    int max_count;
    float *sun_mu;      // [max_count] at the node
    float *sun_sine;    // [max_count] at the node
    float *cos_azimuth; // [max_count] of the ray, at the node
    float *part;        // [max_count] interpolation weight
    int *index;         // [max_count] interpolation cell
    lanes *row;         // [max(SUN_COLUMNS, suns * (lmax + 1))]
};

trl_result transport_scratch_create(const trl_context *ctx, int max_count, int suns,
                                    struct transport_scratch **out)
{
    *out = mem_alloc(ctx, 1, sizeof **out);
    if (!*out) {
        return TRL_ERROR_MEMORY;
    }
    struct transport_scratch *s = *out;
    const size_t row = (size_t)(suns + 2) * (OPTICS_MAX_DEGREE + 1); // a guard row at each end
    s->max_count = max_count;
    s->sun_mu = mem_alloc(ctx, (size_t)max_count, sizeof *s->sun_mu);
    s->sun_sine = mem_alloc(ctx, (size_t)max_count, sizeof *s->sun_sine);
    s->cos_azimuth = mem_alloc(ctx, (size_t)max_count, sizeof *s->cos_azimuth);
    s->part = mem_alloc(ctx, (size_t)max_count, sizeof *s->part);
    s->index = mem_alloc(ctx, (size_t)max_count, sizeof *s->index);
    s->row = mem_alloc(ctx, row > SUN_COLUMNS ? row : SUN_COLUMNS, sizeof(lanes));
    if (!s->sun_mu || !s->sun_sine || !s->cos_azimuth || !s->part || !s->index || !s->row) {
        transport_scratch_destroy(ctx, out);
        return TRL_ERROR_MEMORY;
    }
    return TRL_OK;
}

void transport_scratch_destroy(const trl_context *ctx, struct transport_scratch **scratch)
{
    struct transport_scratch *s = *scratch;
    if (!s) {
        return;
    }
    mem_free(ctx, s->sun_mu);
    mem_free(ctx, s->sun_sine);
    mem_free(ctx, s->cos_azimuth);
    mem_free(ctx, s->part);
    mem_free(ctx, s->index);
    mem_free(ctx, s->row);
    mem_free(ctx, s);
    *scratch = NULL;
}

// The star's zenith angle at a point of the ray: parallel light, so nu is the same all along.
LANES_INLINE float sun_mu_at(float eye_radius, float distance, float inverse_radius,
                             float eye_sun_mu, float nu)
{
    const float mu = (eye_radius * eye_sun_mu + distance * nu) * inverse_radius;
    return mu < -1.0f ? -1.0f : mu > 1.0f ? 1.0f : mu;
}

LANES_INLINE void place_in_sunlight(const struct sunlight *sun, const struct ray *ray,
                                    const struct ray_node *node,
                                    const struct transport_family *family,
                                    struct transport_scratch *s)
{
    const struct sunlight_row row =
        sunlight_row_at(sun->optics->ground_radius_m, node->radius_m, sun->disc_rad);
    const float eye_radius = (float)ray->eye_radius_m;
    const float distance = (float)node->distance_m;
    const float inverse_radius = (float)(1 / node->radius_m);
    const float lowest = (float)row.lowest_mu;
    const float scale = (float)row.scale * (SUN_COLUMNS - 1);
    float *restrict part = s->part;
    int *restrict index = s->index;
#pragma omp simd
    for (int t = 0; t < family->count; t++) {
        const float mu =
            sun_mu_at(eye_radius, distance, inverse_radius, family->sun_mu[t], family->nu[t]);
        const float above = mu - lowest;
        const float x =
            logf(1.0f + (above > 0.0f ? above : 0.0f) * (float)(1 / SUNLIGHT_SOFT)) * scale;
        const float inside = x < (float)SUN_COLUMNS - 1.001f ? x : (float)SUN_COLUMNS - 1.001f;
        index[t] = (int)inside;
        part[t] = inside - (float)(int)inside;
    }
}

// Sunlight over the sun coordinate at one altitude, as far as the family needs it, times the
// attenuation from the node to the eye.
LANES_INLINE void fill_sun_row(const struct sunlight *sun, const struct ray_node *node,
                               const lanes *attenuation, int count, struct transport_scratch *s)
{
    lanes *row = s->row;
    int first = SUN_COLUMNS;
    int last = 0;
    for (int t = 0; t < count; t++) {
        first = s->index[t] < first ? s->index[t] : first;
        last = s->index[t] > last ? s->index[t] : last;
    }
    last++; // cells have two ends
    const double position = node->shell * (sun->levels - 1);
    const int level = position < sun->levels - 2 ? (int)position : sun->levels - 2;
    const float part = (float)(position - level);
    const lanes *below = sun->log_transmittance + level * SUN_COLUMNS;
    const lanes *above = below + SUN_COLUMNS;
    for (int c = first; c <= last; c++) {
        row[c] = lanes_exp_negative(below[c] + (above[c] - below[c]) * part) * *attenuation;
    }
}

LANES_CLONES void transport_add_single(const struct sunlight *sun, const struct ray *ray,
                                       const struct transport_family *family,
                                       const struct transport_channels *channels,
                                       lanes *const *radiance, struct transport_scratch *s)
{
    const struct optics *optics = sun->optics;
    for (int k = ray->first_node; k < ray->node_count; k++) {
        const struct ray_node *node = &ray->node[k];
        const lanes attenuation = optics_attenuation(optics, node->column_m);
        place_in_sunlight(sun, ray, node, family, s);
        fill_sun_row(sun, node, &attenuation, family->count, s);
        for (int i = 0; i < optics->constituent_count; i++) {
            if (channels->channel[i] < 0 || node->density[i] <= 0) {
                continue;
            }
            lanes *restrict out = radiance[channels->channel[i]];
            const float *phase = channels->phase[i];
            const lanes scattered =
                optics->scattering_per_m[i] * (float)(node->density[i] * node->weight_m);
            for (int t = 0; t < family->count; t++) {
                const lanes *cell = s->row + s->index[t];
                const lanes light = cell[0] + (cell[1] - cell[0]) * s->part[t];
                out[t] += light * (phase ? scattered * phase[t] : scattered);
            }
        }
    }
}

// Where the family's suns and azimuths stand at the node, in the grid of the moments. A sun below
// the grid stays on its darkest row.
LANES_INLINE void place_in_moments(const struct moments *m, const struct ray *ray,
                                   const struct ray_node *node,
                                   const struct transport_family *family,
                                   struct transport_scratch *s)
{
    const float eye_radius = (float)ray->eye_radius_m;
    const float distance = (float)node->distance_m;
    const float inverse_radius = (float)(1 / node->radius_m);
    const float mu = (float)node->mu;
    const float sine = (float)fmax(node->sine, 1e-6);
    const float centre = (float)m->sun_centre;
    const float inverse_width = (float)(1 / m->sun_width);
    const float first = (float)m->sun_first;
    const float scale = (float)m->sun_scale;
    const float last = (float)m->suns - 1.001f;
    float *restrict part = s->part;
    float *restrict sine_out = s->sun_sine;
    float *restrict cos_azimuth = s->cos_azimuth;
    int *restrict index = s->index;
#pragma omp simd
    for (int t = 0; t < family->count; t++) {
        const float sun_mu =
            sun_mu_at(eye_radius, distance, inverse_radius, family->sun_mu[t], family->nu[t]);
        const float sun_sine = sqrtf(1.0f - sun_mu * sun_mu) + 1e-6f;
        const float cosine = (family->nu[t] - mu * sun_mu) / (sine * sun_sine);
        sine_out[t] = sun_sine;
        cos_azimuth[t] = cosine < -1.0f ? -1.0f : cosine > 1.0f ? 1.0f : cosine;
        // asinh, odd: the logarithm of a sum without cancellation
        const float z = (sun_mu - centre) * inverse_width;
        const float magnitude = z < 0.0f ? -z : z;
        const float root = logf(magnitude + sqrtf(magnitude * magnitude + 1.0f));
        const float x = ((z < 0.0f ? -root : root) - first) * scale;
        const float inside = x < 0.0f ? 0.0f : x < last ? x : last;
        index[t] = (int)inside;
        part[t] = inside - (float)(int)inside;
    }
}

// The source's azimuth harmonics over the sun grid at one node, folded with the attenuation and the
// length of the node: row[sun][m] = sum over l of B_l T w Y_lm(mu) a_lm(altitude, sun), B_l = sum_i
// scattering_i p_il.
LANES_INLINE void fill_source_row(const struct moments *m, const struct ray_node *node,
                                  const lanes *attenuation, int first_sun, int last_sun, lanes *row)
{
    const struct optics *optics = m->optics;
    const int orders = m->lmax + 1;
    const int harmonics = harmonic_count(m->lmax);
    double harmonic[(OPTICS_MAX_DEGREE + 1) * (OPTICS_MAX_DEGREE + 2) / 2];
    harmonic_values(m->lmax, node->mu, harmonic);
    lanes factor[(OPTICS_MAX_DEGREE + 1) * (OPTICS_MAX_DEGREE + 2) / 2];
    for (int l = 0; l < orders; l++) {
        const lanes scattered = optics_source(optics, node->density, l) * (float)node->weight_m;
        for (int o = 0; o <= l; o++) {
            factor[harmonic_index(l, o)] =
                scattered * *attenuation * (float)harmonic[harmonic_index(l, o)];
        }
    }
    const struct moments_levels at = moments_levels_at(m, node->shell);
    const size_t next = (size_t)m->suns * harmonics;
    const lanes *lowest = m->radiance + (size_t)at.first * next;
    for (int sun = first_sun; sun <= last_sun; sun++) {
        const lanes *a = lowest + sun * harmonics;
        const lanes *b = a + next;
        const lanes *c = b + next;
        const lanes *d = c + next;
        lanes *out = row + sun * orders;
        for (int o = 0; o < orders; o++) {
            lanes sum = {0};
            for (int l = o; l < orders; l++) {
                const int h = harmonic_index(l, o);
                sum += (a[h] * at.weight[0] + b[h] * at.weight[1] + c[h] * at.weight[2] +
                        d[h] * at.weight[3]) *
                       factor[h];
            }
            out[o] = sum;
        }
    }
}

// Catmull-Rom weights of the four neighbours: twilight falls by a factor from sun to sun, and a
// straight line through two points of an exponential lies above it, at every order of scattering
// anew.
struct cubic {
    float weight[4];
};

LANES_INLINE struct cubic cubic_at(float part)
{
    const float rest = 1.0f - part;
    return (struct cubic){{-0.5f * part * rest * rest, 1.0f - part * part * (2.5f - 1.5f * part),
                           1.0f - rest * rest * (2.5f - 1.5f * rest), -0.5f * rest * part * part}};
}

// Adds the interpolated harmonics times cos(m phi), by Chebyshev's recurrence. Row -1 is there. Odd
// orders are without the sine of the star's zenith angle.
LANES_INLINE void add_source(const struct transport_scratch *s, int count, int orders,
                             const lanes *row, lanes *restrict radiance)
{
    for (int t = 0; t < count; t++) {
        const lanes *at = row + (s->index[t] - 1) * orders;
        const struct cubic c = cubic_at(s->part[t]);
        const float twice = 2.0f * s->cos_azimuth[t];
        float before = s->cos_azimuth[t]; // cos(-phi)
        float now = 1.0f;
        lanes sum = {0};
        for (int o = 0; o < orders; o++, at++) {
            sum += (at[0] * c.weight[0] + at[orders] * c.weight[1] + at[2 * orders] * c.weight[2] +
                    at[3 * orders] * c.weight[3]) *
                   (o % 2 ? now * s->sun_sine[t] : now);
            const float next = twice * now - before;
            before = now;
            now = next;
        }
        radiance[t] += sum;
    }
}

// With the star near the zenith odd orders grow as the sine of its zenith angle, which is a root of
// the grid's coordinate there and no cubic: they are divided by it. In the zenith itself what is
// left goes on as before it.
LANES_INLINE void divide_odd_orders(const struct moments *m, int first_sun, int last_sun,
                                    lanes *row)
{
    const int orders = m->lmax + 1;
    for (int sun = first_sun; sun <= last_sun; sun++) {
        for (int o = 1; o < orders; o += 2) {
            row[sun * orders + o] *= m->inverse_sun_sine[sun];
        }
    }
    if (last_sun == m->suns - 1) {
        for (int o = 1; o < orders; o += 2) {
            lanes *last = row + last_sun * orders + o;
            *last = 3.0f * (last[-orders] - last[-2 * orders]) + last[-3 * orders];
        }
    }
}

// Rows beyond the ends go on as parabolas.
LANES_INLINE void fill_guards(lanes *row, int suns, int orders)
{
    for (int o = 0; o < orders; o++) {
        lanes *first = row + o;
        lanes *last = row + (suns - 1) * orders + o;
        first[-orders] = 3.0f * (first[0] - first[orders]) + first[2 * orders];
        last[orders] = 3.0f * (last[0] - last[-orders]) + last[-2 * orders];
    }
}

LANES_CLONES void transport_add_multiple(const struct moments *moments, const struct ray *ray,
                                         const struct transport_family *family, lanes *radiance,
                                         struct transport_scratch *s)
{
    const int suns = moments->suns;
    const int orders = moments->lmax + 1;
    lanes *row = s->row + orders;
    for (int k = ray->first_node; k < ray->node_count; k++) {
        const struct ray_node *node = &ray->node[k];
        const lanes attenuation = optics_attenuation(moments->optics, node->column_m);
        place_in_moments(moments, ray, node, family, s);
        int first = suns;
        int last = 0;
        for (int t = 0; t < family->count; t++) {
            first = s->index[t] < first ? s->index[t] : first;
            last = s->index[t] > last ? s->index[t] : last;
        }
        // The cubic's neighbours, and what the ends are made of.
        first = first > 0 ? first - 1 : 0;
        last = last < suns - 3 ? last + 2 : suns - 1;
        first = last == suns - 1 && first > suns - 4 ? suns - 4 : first;
        fill_source_row(moments, node, &attenuation, first, last, row);
        divide_odd_orders(moments, first, last, row);
        if (first == 0 || last == suns - 1) {
            fill_guards(row, suns, orders);
        }
        add_source(s, family->count, orders, row, radiance);
    }
}

LANES_INLINE lanes irradiance_at(const struct moments *m, double mu)
{
    const double x = (asinh((mu - m->sun_centre) / m->sun_width) - m->sun_first) * m->sun_scale;
    const double inside = fmin(fmax(x, 0), m->suns - 1.001);
    const int index = (int)inside;
    const struct cubic c = cubic_at((float)(inside - index));
    const lanes *at = m->irradiance;
    const lanes sum = at[index > 0 ? index - 1 : 0] * c.weight[0] + at[index] * c.weight[1] +
                      at[index + 1] * c.weight[2] +
                      at[index + 2 < m->suns ? index + 2 : m->suns - 1] * c.weight[3];
    return sum;
}

lanes moments_irradiance(const struct moments *moments, double mu)
{
    return irradiance_at(moments, mu);
}

LANES_CLONES void transport_add_ground(const struct sunlight *sun, const struct moments *moments,
                                       const struct ray *ray, const struct transport_family *family,
                                       lanes *radiance)
{
    if (!ray->hits_ground) {
        return;
    }
    const struct optics *optics = sun ? sun->optics : moments->optics;
    const lanes reflected =
        optics->ground_albedo * optics_attenuation(optics, ray->column_m) * (float)(1 / M_PI);
    for (int t = 0; t < family->count; t++) {
        const double mu = fmin(1, fmax(-1, (ray->eye_radius_m * (double)family->sun_mu[t] +
                                            ray->end_m * (double)family->nu[t]) /
                                               optics->ground_radius_m));
        lanes irradiance = {0};
        if (sun) {
            sunlight_ground_at(sun, mu, &irradiance);
        }
        if (moments) {
            irradiance += irradiance_at(moments, mu);
        }
        if (sun && moments) {
            // The cubic may undershoot where night falls. Not within the iteration, whose vectors
            // have signs.
            irradiance = lanes_max(irradiance, lanes_set(0));
        }
        radiance[t] += reflected * irradiance;
    }
}
