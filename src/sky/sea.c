// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/sea.h"

#include "shared/phase.glsl"
#include "shared/sea.glsl"
#include "shared/sky_map.glsl"
#include "spectrum/cie.h"

#include <math.h>

// Facets of a rough surface, equally many for each part of the slopes' distribution.
enum { RINGS = 10, SPOKES = 16, FACETS = RINGS * SPOKES };

// A facet as seen in a direction: its share of what is seen, and where it mirrors.
struct facet {
    double weight, reflectance;
    double share;           // of the mirrored light: both together, of all
    double mu;              // of the mirrored ray
    double turn_x;          // its horizontal direction, from the one away from the eye: cosine
    double turn_y;          // sine
    struct table_cell view; // of the 4D table, in that direction
};

// The facets that a view sees, in the frame whose x axis points away from the eye. Each is seen as
// large as it is turned to the eye; those that face away are not.
static void find_facets(const struct sky_sea *sea, double view_mu, struct facet facets[FACETS])
{
    const double sine = sqrt(fmax(1 - view_mu * view_mu, 0));
    const double hidden = sea_hidden(view_mu, sea->mean_square_slope);
    double sum = 0;
    for (int i = 0; i < FACETS; i++) {
        // Slopes with the density exp(-s^2 / mss): a ring holds the same share of them as others.
        const double share = (i / SPOKES + 0.5) / RINGS;
        const double slope = sqrt(-sea->mean_square_slope * log(1 - share));
        const double angle = 2 * M_PI * (i % SPOKES + 0.5) / SPOKES;
        const double x = -slope * cos(angle), y = -slope * sin(angle);
        const double seen = -sine * x + view_mu; // toward the eye: (-sine, 0, view_mu)
        const double length2 = x * x + y * y + 1;
        const double twice = 2 * seen / length2;
        struct facet *f = &facets[i];
        f->weight = fmax(seen, 0);
        f->reflectance = fresnel_reflectance(fmin(seen / sqrt(length2), 1), sea->index);
        f->mu = fmax(twice - view_mu, 0);
        // What another wave hides on the way to the sky comes from below the horizon as well: most
        // of it went into the water there.
        const double open = sea_hidden(f->mu, sea->mean_square_slope);
        f->reflectance *= twice > view_mu ? (1 + hidden) / (1 + hidden + open) : 0;
        const double along = twice * x + sine, across = twice * y;
        const double level = fmax(sqrt(along * along + across * across), 1e-12);
        f->turn_x = along / level;
        f->turn_y = across / level;
        sum += f->weight;
    }
    for (int i = 0; i < FACETS; i++) {
        facets[i].weight /= sum;
    }
}

struct sky_sea sea_at_level(const struct sky_sea *sea, int level)
{
    struct sky_sea smoother = *sea;
    smoother.mean_square_slope *= exp2(SEA_LEVEL_OCTAVES * (level - (SEA_LEVELS - 1)));
    return smoother;
}

double sea_surface_reflectance(const struct sky_sea *sea, double mu, double *mirror_mu)
{
    struct facet facets[FACETS];
    find_facets(sea, mu, facets);
    double sum = 0, mus = 0;
    for (int i = 0; i < FACETS; i++) {
        sum += facets[i].weight * facets[i].reflectance;
        mus += facets[i].weight * facets[i].reflectance * facets[i].mu;
    }
    *mirror_mu = mus / sum;
    return sum;
}

// The sky as seen from the sea: logarithms of a slice of the 4D table, one array a channel.
struct seen_sky {
    const struct atmosphere *atmosphere;
    int first, count; // of the table's suns
    float *slices[1 + TABLE_MAX_PEAKED];
};

// XYZ of one channel, without its phase function.
static void look_up(const float *slice, const struct table_size *n, const int sun,
                    const struct table_cell cells[2], float xyz[3])
{
    const size_t row = (size_t)n->azimuths * TEXEL_FLOATS;
    const float *low = slice + ((size_t)cells[0].below * (size_t)n->suns + (size_t)sun) * row +
                       (size_t)cells[1].below * TEXEL_FLOATS;
    const float *high = low + (size_t)n->suns * row;
    for (int k = 0; k < 3; k++) {
        const float a = low[k] + (low[TEXEL_FLOATS + k] - low[k]) * cells[1].part;
        const float b = high[k] + (high[TEXEL_FLOATS + k] - high[k]) * cells[1].part;
        xyz[k] = expf(a + (b - a) * cells[0].part);
    }
}

// Of the table at the ground.
static struct table_cell view_cell(const struct atmosphere *a, double mu)
{
    const double ground = a->optics->ground_radius_m;
    const double height = a->optics->top_radius_m - ground;
    const double square = height * (2 * ground + height);
    const double along = ground * mu;
    const double way = square / (sqrt(along * along + square) + along);
    return table_cell_at(sky_map_view(way, height, sqrt(square)), a->table.size.views);
}

// One of the table's suns.
struct seen_sun {
    int index;
    double mu;
};

// Adds the radiance of the sky where a facet mirrors, at the angle to the sun whose cosine is nu.
static void add_sky(const struct seen_sky *sky, const struct facet *facet,
                    const struct seen_sun *sun, double nu, double sum[3])
{
    const struct atmosphere *a = sky->atmosphere;
    const double mu = facet->mu;
    const double sines = sqrt(fmax((1 - mu * mu) * (1 - sun->mu * sun->mu), 1e-12));
    const double azimuth = sky_map_azimuth(fmin(fmax((nu - mu * sun->mu) / sines, -1), 1));
    const struct table_cell cells[2] = {facet->view,
                                        table_cell_at(azimuth, a->table.size.azimuths)};
    for (int c = 0; c < a->table.channels; c++) {
        const double phase =
            c == 0 ? phase_rayleigh(nu)
                   : phase_value(&a->medium.constituents[a->peaked.constituent[c - 1]].phase, nu);
        float xyz[3];
        look_up(sky->slices[c], &a->table.size, sun->index, cells, xyz);
        for (int k = 0; k < 3; k++) {
            sum[k] += facet->share * phase * (double)xyz[k];
        }
    }
}

// XYZ of light as bands per unit irradiance of the star that show the same.
static void store_bands(const struct bands *bands, const double xyz[3], float *texel)
{
    double relative[3]; // linear sRGB relative to that of a white wall in the star's light
    for (int k = 0; k < 3; k++) {
        double star = 0;
        for (int b = 0; b < BAND_COUNT; b++) {
            star += (double)bands->rgb_from_bands[k][b];
        }
        const double rgb = cie_rgb_from_xyz[k][0] * xyz[0] + cie_rgb_from_xyz[k][1] * xyz[1] +
                           cie_rgb_from_xyz[k][2] * xyz[2];
        relative[k] = star > 0 ? rgb / star : 0;
    }
    for (int b = 0; b < BAND_COUNT; b++) {
        double value = 0;
        for (int k = 0; k < 3; k++) {
            value += (double)bands->bands_from_rgb[b][k] * relative[k];
        }
        texel[b] = logf(fmaxf((float)value, 1e-30f));
    }
}

// One view: its suns and all azimuths.
static void fill_view(const struct seen_sky *sky, const struct sky_sea *sea, int view,
                      float *texels)
{
    const struct atmosphere *a = sky->atmosphere;
    struct facet facets[FACETS];
    const double root = fmax((double)view / (SEA_MIRROR_VIEWS - 1), 0.02);
    find_facets(sea, root * root, facets);
    double reflectance = 0;
    for (int i = 0; i < FACETS; i++) {
        reflectance += facets[i].weight * facets[i].reflectance;
    }
    for (int i = 0; i < FACETS; i++) {
        facets[i].share = facets[i].weight * facets[i].reflectance / reflectance;
        facets[i].view = view_cell(a, facets[i].mu);
    }
    for (int index = 0; index < sky->count; index++) {
        const int of_table = sky->first + index;
        const struct seen_sun sun = {of_table, table_sun_mu(&a->table, of_table)};
        const double sun_sine = sqrt(fmax(1 - sun.mu * sun.mu, 0));
        for (int az = 0; az < SEA_MIRROR_AZIMUTHS; az++) {
            const double half = asin((double)az / (SEA_MIRROR_AZIMUTHS - 1));
            const double cosine = cos(2 * half), sine = sin(2 * half);
            double xyz[3] = {0, 0, 0};
            for (int i = 0; i < FACETS; i++) {
                const struct facet *f = &facets[i];
                const double level = sqrt(fmax(1 - f->mu * f->mu, 0));
                const double nu =
                    f->mu * sun.mu + level * sun_sine * (f->turn_x * cosine + f->turn_y * sine);
                if (f->weight > 0) {
                    add_sky(sky, f, &sun, nu, xyz);
                }
            }
            store_bands(&a->bands, xyz,
                        texels + ((size_t)index * SEA_LEVELS * SEA_MIRROR_AZIMUTHS + (size_t)az) *
                                     BAND_COUNT);
        }
    }
}

// Of the suns that are looked up.
static void take_logarithms(const struct seen_sky *sky, float *slice)
{
    const struct table_size *n = &sky->atmosphere->table.size;
    const size_t row = (size_t)n->azimuths * TEXEL_FLOATS;
    for (int view = 0; view < n->views; view++) {
        float *suns = slice + ((size_t)view * (size_t)n->suns + (size_t)sky->first) * row;
        for (size_t k = 0; k < (size_t)sky->count * row; k++) {
            suns[k] = logf(fmaxf(suns[k], 1e-20f));
        }
    }
}

trl_result sea_mirror_make(const struct atmosphere *atmosphere, const struct sky_sea *sea,
                           int first, int suns, float *texels)
{
    const struct table *table = &atmosphere->table;
    const size_t count = (size_t)table->size.views * (size_t)table->size.suns *
                         (size_t)table->size.azimuths * TEXEL_FLOATS;
    struct seen_sky sky = {.atmosphere = atmosphere, .first = first, .count = suns};
    float *slices = mem_alloc(atmosphere->ctx, count * (size_t)table->channels, sizeof *slices);
    if (!slices) {
        return TRL_ERROR_MEMORY;
    }
    for (int c = 0; c < table->channels; c++) {
        sky.slices[c] = slices + (size_t)c * count;
        table_slice(table, atmosphere->optics, c, atmosphere->optics->ground_radius_m,
                    sky.slices[c]);
        take_logarithms(&sky, sky.slices[c]);
    }
    const size_t view_floats = (size_t)suns * SEA_LEVELS * SEA_MIRROR_AZIMUTHS * BAND_COUNT;
#pragma omp parallel for schedule(dynamic, 1)
    for (int k = 0; k < SEA_MIRROR_VIEWS * SEA_LEVELS; k++) {
        const int view = k / SEA_LEVELS, level = k % SEA_LEVELS;
        const struct sky_sea rough = sea_at_level(sea, level);
        fill_view(&sky, &rough, view,
                  texels + (size_t)view * view_floats +
                      (size_t)level * SEA_MIRROR_AZIMUTHS * BAND_COUNT);
    }
    mem_free(atmosphere->ctx, slices);
    return TRL_OK;
}
