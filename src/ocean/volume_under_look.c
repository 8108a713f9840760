// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Tables for eyes under water, looked up.
#include "ocean/volume_under.h"

#include "shared/fresnel.glsl"

#include <math.h>

struct cell {
    int first;
    double part;
};

static struct cell cell_at(double x, int count)
{
    const double place = fmin(fmax(x, 0), count - 1);
    const int first = place < count - 2 ? (int)place : count - 2;
    return (struct cell){first, place - first};
}

static struct cell sun_cell(const struct volume_under *u, double mu)
{
    return cell_at((mu - u->critical) / (1 - u->critical) * (UNDER_SUNS - 1), UNDER_SUNS);
}

static struct cell depth_cell(const struct volume_under *u, double depth_m)
{
    int first = UNDER_DEPTHS - 2;
    while (first > 0 && volume_under_depth_m(u->depth_m, first) > depth_m) {
        first--;
    }
    const double low = volume_under_depth_m(u->depth_m, first);
    const double high = volume_under_depth_m(u->depth_m, first + 1);
    return (struct cell){first, fmin(fmax((depth_m - low) / (high - low), 0), 1)};
}

// A direction among the nodes: of lines that go down by falling, then of those that go up by rising
// cosines, which meet on the level.
struct direction {
    int line[2], node[2];
    double part;
};

static struct direction direction_at(const struct volume_under *u, double mu)
{
    const double size = fabs(mu);
    const int line = mu > 0;
    if (size < u->node[0]) {
        return (struct direction){{0, 1}, {0, 0}, 0.5 * (mu / u->node[0] + 1)};
    }
    int node = SLAB_NODES - 2;
    while (node > 0 && u->node[node] > size) {
        node--;
    }
    const double part = (size - u->node[node]) / (u->node[node + 1] - u->node[node]);
    return (struct direction){{line, line}, {node, node + 1}, fmin(part, 1)};
}

// Of all orders at an azimuth: cos((m + 1) x) = 2 cos(x) cos(m x) - cos((m - 1) x).
static void fill_cosines(double azimuth_rad, double out[UNDER_ORDERS])
{
    const double x = cos(azimuth_rad);
    for (int m = 0; m < UNDER_ORDERS; m++) {
        out[m] = m < 2 ? (m ? x : 1) : 2 * x * out[m - 1] - out[m - 2];
    }
}

static double mix(double a, double b, double part)
{
    return a + (b - a) * part;
}

// Of positive numbers that fall with depth: by logarithms.
static double mix_depths(double a, double b, double part)
{
    return a > 0 && b > 0 ? a * pow(b / a, part) : mix(a, b, part);
}

struct under_source volume_under_source(const struct volume_under *u, int wavelength,
                                        const struct under_sight *sight)
{
    const struct under_light *light = &u->light[wavelength];
    const struct cell d = depth_cell(u, sight->eye_depth_m), s = sun_cell(u, sight->sun_mu);
    const struct direction v = direction_at(u, sight->view_mu);
    double star[2] = {0, 0}, sky[2], cosine[UNDER_ORDERS];
    fill_cosines(sight->azimuth_rad, cosine);
    for (int k = 0; k < 2; k++) {
        for (int m = 0; m < UNDER_ORDERS; m++) {
            const float(*low)[2][SLAB_NODES] = &light->order[m].source[d.first + k][s.first];
            double ends[2];
            for (int e = 0; e < 2; e++) {
                ends[e] = mix((double)low[0][v.line[e]][v.node[e]],
                              (double)low[1][v.line[e]][v.node[e]], s.part);
            }
            star[k] += mix(ends[0], ends[1], v.part) * cosine[m];
        }
        const float(*lines)[SLAB_NODES] = light->sky_source[d.first + k];
        sky[k] =
            mix((double)lines[v.line[0]][v.node[0]], (double)lines[v.line[1]][v.node[1]], v.part);
    }
    return (struct under_source){mix_depths(star[0], star[1], d.part),
                                 mix_depths(sky[0], sky[1], d.part)};
}

struct under_source volume_under_rising(const struct volume_under *u, int wavelength,
                                        const struct under_sight *sight)
{
    const struct under_light *light = &u->light[wavelength];
    const struct cell s = sun_cell(u, sight->sun_mu);
    struct direction v = direction_at(u, fmin(sight->view_mu, -u->node[0]));
    double star = 0, cosine[UNDER_ORDERS];
    fill_cosines(sight->azimuth_rad, cosine);
    for (int m = 0; m < UNDER_ORDERS; m++) {
        const float(*rows)[SLAB_NODES] = &light->order[m].rising[s.first];
        const double low = mix((double)rows[0][v.node[0]], (double)rows[1][v.node[0]], s.part);
        const double high = mix((double)rows[0][v.node[1]], (double)rows[1][v.node[1]], s.part);
        star += mix(low, high, v.part) * cosine[m];
    }
    const struct under_sight below = {0, sight->view_mu, sight->sun_mu, sight->azimuth_rad};
    return (struct under_source){
        star + volume_under_once(u, wavelength, &below, u->depth_m / fmax(-sight->view_mu, 1e-3)),
        mix((double)light->sky_rising[v.node[0]], (double)light->sky_rising[v.node[1]], v.part)};
}

struct under_source volume_under_bed(const struct volume_under *u, int wavelength, double sun_mu)
{
    const struct cell s = sun_cell(u, sun_mu);
    const float *bed = u->light[wavelength].bed + s.first;
    return (struct under_source){mix((double)bed[0], (double)bed[1], s.part),
                                 (double)u->light[wavelength].sky_bed};
}

double volume_under_once(const struct volume_under *u, int wavelength,
                         const struct under_sight *sight, double length_m)
{
    const struct water_optics *optics = &u->column[wavelength].optics;
    const double sun = sight->sun_mu, view = sight->view_mu;
    const double cosine =
        sun * view + sqrt(fmax((1 - sun * sun) * (1 - view * view), 0)) * cos(sight->azimuth_rad);
    const double rate = u->extinction_per_m[wavelength] * (1 - view / sun);
    const double arrived = exp(-u->extinction_per_m[wavelength] * sight->eye_depth_m / sun);
    const double x = rate * length_m;
    return (optics->clear_per_m + optics->particles_per_m) *
           water_phase_value(&u->phase[wavelength], cosine) * arrived *
           (fabs(x) > 1e-6 ? -expm1(-x) / rate : length_m);
}

struct volume_light volume_under_join(const struct volume_under *u, int wavelength, double depth_m,
                                      const struct volume_view *view,
                                      const struct under_sources *sources)
{
    const double sun = volume_refract(view->sun_mu, u->index), mu = view->view_mu;
    const bool is_up = mu > 0;
    const double length_m = is_up ? view->eye_depth_m / mu : (depth_m - view->eye_depth_m) / -mu;
    const struct under_sight sight = {view->eye_depth_m, mu, sun, view->azimuth_rad};
    const double extinction = u->extinction_per_m[wavelength];
    const double left = exp(-extinction * length_m);
    struct under_source far = sources->far; // where the line ends
    if (is_up) {
        const double back = fresnel_reflectance(mu, 1 / u->index);
        far.star *= back;
        far.sky = far.sky * back + (1 - back) * u->index * u->index / M_PI;
    } else {
        const double albedo = u->column[wavelength].bed_albedo / M_PI;
        far.star = albedo * (far.star + sun * exp(-extinction * depth_m / sun));
        far.sky *= albedo;
    }
    const double beam = (1 - fresnel_reflectance(view->sun_mu, u->index)) / sun;
    const double star = sources->source.star * (1 - left) + left * far.star +
                        volume_under_once(u, wavelength, &sight, length_m);
    return (struct volume_light){beam * star, sources->source.sky * (1 - left) + left * far.sky};
}

struct volume_light volume_under_at(const struct volume_under *u, int wavelength,
                                    const struct volume_view *view)
{
    const double sun = volume_refract(view->sun_mu, u->index), mu = view->view_mu;
    const struct under_sight sight = {view->eye_depth_m, mu, sun, view->azimuth_rad};
    const struct under_sight below = {0, -mu, sun, view->azimuth_rad};
    const struct under_sources sources = {volume_under_source(u, wavelength, &sight),
                                          mu > 0 ? volume_under_rising(u, wavelength, &below)
                                                 : volume_under_bed(u, wavelength, sun)};
    return volume_under_join(u, wavelength, u->depth_m, view, &sources);
}
