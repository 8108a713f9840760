// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/query.h"

#include "scatter/aureole.h"

#include <math.h>

enum { SHADOW_SAMPLES = 96, BISECTIONS = 40 };

static const double NODES_PER_SHELL = 96;
static const double DEPTH_PER_RULE = 2; // of sixteen nodes
static const double LEAST_TRANSMITTANCE = 1e-7;

struct query {
    const struct solution *solution;
    struct ray ray;
    struct ray toward_star; // from where most of the first order is scattered
    struct transport_scratch *scratch;
    struct aureole aureole;
};

struct query_view query_view_make(double radius_m, double sun_zenith_rad, double view_zenith_rad,
                                  double azimuth_rad)
{
    struct query_view view = {
        .radius_m = radius_m, .sun_mu = cos(sun_zenith_rad), .view_mu = cos(view_zenith_rad)};
    view.nu =
        view.view_mu * view.sun_mu + sin(view_zenith_rad) * sin(sun_zenith_rad) * cos(azimuth_rad);
    return view;
}

trl_result query_create(const trl_context *ctx, const struct solution *solution, struct query **out)
{
    *out = mem_alloc(ctx, 1, sizeof **out);
    if (!*out) {
        return TRL_ERROR_MEMORY;
    }
    (*out)->solution = solution;
    trl_result result = transport_scratch_create(ctx, 1, solution->moments.suns, &(*out)->scratch);
    if (result == TRL_OK) {
        result = aureole_init(ctx, solution->optics, solution->sun.disc_rad, &(*out)->aureole);
    }
    if (result != TRL_OK) {
        query_destroy(ctx, out);
    }
    return result;
}

void query_destroy(const trl_context *ctx, struct query **query)
{
    if (*query) {
        transport_scratch_destroy(ctx, &(*query)->scratch);
        aureole_finish(ctx, &(*query)->aureole);
        mem_free(ctx, *query);
        *query = NULL;
    }
}

// Angle of the star's centre above the horizon of a point of the ray.
static double sun_elevation(const struct query_view *view, double ground_radius_m,
                            double distance_m)
{
    const double r = view->radius_m;
    const double square = r * r + distance_m * (distance_m + 2 * r * view->view_mu);
    const double radius_m = fmax(sqrt(square), ground_radius_m);
    const double mu = (r * view->sun_mu + distance_m * view->nu) / radius_m;
    const double horizon_rad = M_PI - asin(fmin(1, ground_radius_m / radius_m));
    return horizon_rad - acos(fmin(fmax(mu, -1), 1));
}

// The source has kinks where the ray crosses the edges of the planet's penumbra. They are found by
// sampling and bisection; quadratures stop there.
static void find_shadow_edges(const struct query *query, const struct query_view *view,
                              struct ray_desc *desc)
{
    const struct solution *s = query->solution;
    double begin_m;
    double end_m;
    bool hits_ground;
    if (!ray_clip(s->optics, view->radius_m, view->view_mu, &begin_m, &end_m, &hits_ground)) {
        return;
    }
    const double edge_rad[2] = {-s->sun.disc_rad, s->sun.disc_rad};
    double low_m = begin_m;
    double low = sun_elevation(view, s->optics->ground_radius_m, low_m);
    for (int k = 1; k <= SHADOW_SAMPLES; k++) {
        const double high_m = begin_m + (end_m - begin_m) * k / SHADOW_SAMPLES;
        const double high = sun_elevation(view, s->optics->ground_radius_m, high_m);
        for (int e = 0; e < 2 && desc->break_count < RAY_MAX_BREAKS; e++) {
            // Edges in the order in which the ray meets them, so that the breaks ascend.
            const double edge = edge_rad[low < high ? e : 1 - e];
            if ((low < edge) == (high < edge)) {
                continue;
            }
            double a = low_m;
            double b = high_m;
            for (int n = 0; n < BISECTIONS; n++) {
                const double middle = 0.5 * (a + b);
                const double value = sun_elevation(view, s->optics->ground_radius_m, middle);
                if ((value < edge) == (low < edge)) {
                    a = middle;
                } else {
                    b = middle;
                }
            }
            desc->break_m[desc->break_count++] = 0.5 * (a + b);
        }
        low_m = high_m;
        low = high;
    }
}

// Phase function averaged over the star's disc, which matters where it is as sharp as the disc:
// rings of equal area, midpoints around each.
static double disc_phase(const struct phase *phase, double nu, double disc_rad)
{
    enum { RINGS = 4, POINTS = 8 };
    const double sine = sqrt(fmax(0, 1 - nu * nu));
    double sum = 0;
    for (int ring = 0; ring < RINGS; ring++) {
        const double off_rad = disc_rad * sqrt((ring + 0.5) / RINGS);
        for (int k = 0; k < POINTS; k++) {
            const double around = cos((k + 0.5) * M_PI / POINTS); // the other half mirrors it
            sum += phase_value(phase, nu * cos(off_rad) + sine * sin(off_rad) * around);
        }
    }
    return sum / (RINGS * POINTS);
}

static double sun_mu_at(const struct query_view *view, const struct ray_node *node)
{
    const double mu =
        (view->radius_m * view->sun_mu + node->distance_m * view->nu) / node->radius_m;
    return fmin(fmax(mu, -1), 1);
}

// What of the first order a node scatters in forward peaks, the wavelengths together.
static double forward_light(const struct query *query, const struct query_view *view,
                            const struct ray_node *node)
{
    const struct solution *s = query->solution;
    lanes light;
    sunlight_at(&s->sun, node->radius_m, sun_mu_at(view, node), &light);
    lanes scattered = {0};
    for (int i = 0; i < s->optics->constituent_count; i++) {
        scattered += s->optics->scattering_per_m[i] *
                     (float)(s->optics->forward_share[i] * node->density[i] * node->weight_m);
    }
    light *= scattered * optics_attenuation(s->optics, node->column_m);
    double sum = 0;
    for (int k = 0; k < LANES; k++) {
        sum += (double)light[k];
    }
    return sum;
}

// The node before which half of that light comes from; NULL when there is none.
static const struct ray_node *find_middle(const struct query *query, const struct query_view *view)
{
    const struct ray *ray = &query->ray;
    double so_far[RAY_MAX_NODES];
    double sum = 0;
    for (int k = 0; k < ray->node_count; k++) {
        sum += forward_light(query, view, &ray->node[k]);
        so_far[k] = sum;
    }
    for (int k = 0; k < ray->node_count && sum > 0; k++) {
        if (so_far[k] >= 0.5 * sum) {
            return &ray->node[k];
        }
    }
    return NULL;
}

// Columns of the way of light that is scattered forward: from the star to where it meets the line
// of sight, and on to the eye.
static bool find_way(struct query *query, const struct query_view *view, double *column_m)
{
    const struct solution *s = query->solution;
    const struct ray_node *node = find_middle(query, view);
    if (!node) {
        return false;
    }
    // A star whose middle has set still is seen above the horizon.
    const double sine = s->optics->ground_radius_m / node->radius_m;
    const double horizon_mu = -sqrt(fmax(0, 1 - sine * sine));
    const struct ray_desc desc = {.radius_m = node->radius_m,
                                  .mu = fmin(1, fmax(sun_mu_at(view, node), horizon_mu + 1e-9)),
                                  .nodes_per_shell = NODES_PER_SHELL,
                                  .end_m = INFINITY};
    ray_init(&query->toward_star, s->optics, s->rules, &desc);
    for (int i = 0; i < s->optics->constituent_count; i++) {
        column_m[i] = node->column_m[i] + query->toward_star.column_m[i];
    }
    return true;
}

// Single scattering of the view: the light comes as if the star stood at the angle of cosine `nu`
// from the ray, the phase functions take the view's own angle. Leaves the ray in the query.
static void add_single(struct query *query, const struct query_view *view, double nu,
                       lanes *radiance)
{
    const struct solution *s = query->solution;
    const struct optics *optics = s->optics;
    struct query_view lit = *view;
    lit.nu = nu;
    struct ray_desc desc = {.radius_m = view->radius_m,
                            .mu = view->view_mu,
                            .nodes_per_shell = NODES_PER_SHELL,
                            .end_m = INFINITY,
                            .depth_per_rule = DEPTH_PER_RULE,
                            .least_transmittance = LEAST_TRANSMITTANCE};
    find_shadow_edges(query, &lit, &desc);
    ray_init(&query->ray, optics, s->rules, &desc);

    const float sun_mu = (float)view->sun_mu;
    const float light_nu = (float)nu;
    const struct transport_family family = {1, &sun_mu, &light_nu};
    struct transport_channels channels;
    lanes single[MEDIUM_MAX_CONSTITUENTS];
    lanes *out[MEDIUM_MAX_CONSTITUENTS];
    for (int i = 0; i < optics->constituent_count; i++) {
        channels.channel[i] = i;
        channels.phase[i] = NULL;
        single[i] = lanes_set(0);
        out[i] = &single[i];
    }
    transport_add_single(&s->sun, &query->ray, &family, &channels, out, query->scratch);
    float phase[MEDIUM_MAX_CONSTITUENTS];
    for (int i = 0; i < optics->constituent_count; i++) {
        phase[i] =
            (float)disc_phase(&optics->medium->constituents[i].phase, view->nu, s->sun.disc_rad);
        *radiance += single[i] * phase[i];
    }
    // Without a forward peak there is nothing to add: so it is where single orders are asked for.
    double column_m[MEDIUM_MAX_CONSTITUENTS];
    if (aureole_reaches(&query->aureole, view->nu) && find_way(query, &lit, column_m)) {
        aureole_add(&query->aureole, view->nu, single, phase, column_m, radiance);
    }
}

void query_radiance(struct query *query, const struct query_view *view, lanes *radiance)
{
    const struct solution *s = query->solution;
    const float sun_mu = (float)view->sun_mu;
    const float nu = (float)view->nu;
    const struct transport_family family = {1, &sun_mu, &nu};
    const unsigned state = lanes_flush_denormals();
    *radiance = lanes_set(0);
    add_single(query, view, view->nu, radiance);
    transport_add_multiple(&s->moments, &query->ray, &family, radiance, query->scratch);
    transport_add_ground(&s->sun, &s->moments, &query->ray, &family, radiance);
    lanes_restore(state);
}

// From outside the observer moves along the ray to where it enters the air; false: it never does.
static bool move_to_air(const struct optics *optics, struct query_view *view)
{
    double begin_m;
    double end_m;
    bool hits_ground;
    if (!ray_clip(optics, view->radius_m, view->view_mu, &begin_m, &end_m, &hits_ground)) {
        return false;
    }
    if (view->radius_m > optics->top_radius_m) {
        const double top_m = optics->top_radius_m;
        view->view_mu = fmax(-1, (view->radius_m * view->view_mu + begin_m) / top_m);
        view->sun_mu =
            fmin(fmax((view->radius_m * view->sun_mu + begin_m * view->nu) / top_m, -1), 1);
        view->radius_m = top_m;
    }
    return true;
}

void query_plane_radiance(struct query *query, const struct query_view *view, lanes *radiance)
{
    const struct solution *s = query->solution;
    struct query_view here = *view;
    *radiance = lanes_set(0);
    if (!move_to_air(s->optics, &here)) {
        return;
    }
    const double sines =
        sqrt(fmax(0, 1 - here.view_mu * here.view_mu) * fmax(0, 1 - here.sun_mu * here.sun_mu));
    const float sun_mu = (float)here.sun_mu;
    const float nu = (float)here.nu;
    const struct transport_family family = {1, &sun_mu, &nu};
    const unsigned state = lanes_flush_denormals();
    add_single(query, &here, here.view_mu * here.sun_mu + sines, radiance);
    transport_add_ground(&s->sun, NULL, &query->ray, &family, radiance);
    lanes_restore(state);
}
