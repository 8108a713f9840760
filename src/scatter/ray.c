// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/ray.h"

#include <math.h>
#include <string.h>

enum { LEG_MIN_NODES = 4, MAX_CUTS = 12, CUT_MIN_NODES = 5 };

void ray_rules_init(struct ray_rules *rules)
{
    for (int n = 1; n <= RAY_RULE_NODES; n++) {
        gauss_init(&rules->rule[n], n);
        gauss_cumulative(&rules->rule[n], rules->cumulative[n]);
    }
}

double ray_half_chord(double radius_m, double pass_m)
{
    return sqrt(fmax(0, (radius_m - pass_m) * (radius_m + pass_m)));
}

bool ray_clip(const struct optics *optics, double radius_m, double mu, double *begin_m,
              double *end_m, bool *hits_ground)
{
    const double pass_m = radius_m * sqrt(fmax(0, 1 - mu * mu));
    const double position = radius_m * mu; // along the line, 0 at its closest point to the centre
    const double top = ray_half_chord(optics->top_radius_m, pass_m);
    *hits_ground = mu < 0 && pass_m < optics->ground_radius_m;
    *begin_m = *end_m = 0;
    if (pass_m >= optics->top_radius_m || (radius_m > optics->top_radius_m && mu >= 0)) {
        return false;
    }
    *begin_m = fmax(0, -top - position);
    *end_m =
        *hits_ground ? -ray_half_chord(optics->ground_radius_m, pass_m) - position : top - position;
    *end_m = fmax(*begin_m, *end_m);
    return *end_m > *begin_m;
}

// A stretch of the ray on which the altitude rises or falls all the way. Its parameter t runs from
// 0 at the low end to 1 at the high end, with shell = low + (high - low) t^2, which lifts the root
// singularity of the distance at a closest point.
struct leg {
    double from_m, to_m; // distances from the eye
    bool is_rising;
    double low_altitude_m, low_shell, high_shell;
};

static double altitude_at(const struct ray *ray, const struct optics *optics, double distance_m)
{
    const double r = ray->eye_radius_m;
    const double square = r * r + distance_m * (distance_m + 2 * r * ray->eye_mu); // law of cosines
    return fmax(0, sqrt(fmax(0, square)) - optics->ground_radius_m);
}

static struct leg make_leg(const struct ray *ray, const struct optics *optics, double from_m,
                           double to_m)
{
    const double first = altitude_at(ray, optics, from_m);
    const double last = altitude_at(ray, optics, to_m);
    const bool is_rising = last > first;
    return (struct leg){.from_m = from_m,
                        .to_m = to_m,
                        .is_rising = is_rising,
                        .low_altitude_m = is_rising ? first : last,
                        .low_shell = optics_shell(optics, is_rising ? first : last),
                        .high_shell = optics_shell(optics, is_rising ? last : first)};
}

static void fill_density(struct ray_node *node, const struct optics *optics)
{
    for (int i = 0; i < optics->constituent_count; i++) {
        node->density[i] =
            profile_density(&optics->medium->constituents[i].profile, node->altitude_m);
    }
}

static void place_node(struct ray_node *node, const struct ray *ray, const struct optics *optics,
                       const struct leg *leg, double t)
{
    const double span = leg->high_shell - leg->low_shell;
    node->shell = leg->low_shell + span * t * t;
    // Relative to the low end, so that the node never sinks below it by the tables' rounding.
    node->altitude_m = leg->low_altitude_m + optics_altitude(optics, node->shell) -
                       optics_altitude(optics, leg->low_shell);
    node->radius_m = optics->ground_radius_m + node->altitude_m;
    const double pass_m = ray->eye_radius_m * sqrt(fmax(0, 1 - ray->eye_mu * ray->eye_mu));
    const double chord = fmax(ray_half_chord(node->radius_m, pass_m), 1e-6);
    const double position = leg->is_rising ? chord : -chord;
    node->distance_m = position - ray->eye_radius_m * ray->eye_mu;
    node->mu = position / node->radius_m;
    node->sine = fmin(1, pass_m / node->radius_m);
    // ds/dt = (ds/dr) (dr/du) (du/dt)
    node->weight_m =
        node->radius_m / chord / optics_shell_slope(optics, node->altitude_m) * 2 * span * t;
    fill_density(node, optics);
}

// The last `count` nodes are those of one rule, their weights still without the rule's: sums up the
// columns.
static void finish_rule(struct ray *ray, const struct optics *optics, const struct ray_rules *rules,
                        int count)
{
    struct ray_node *nodes = ray->node + ray->node_count;
    const double *cumulative = rules->cumulative[count];
    for (int i = 0; i < optics->constituent_count; i++) {
        for (int k = 0; k < count; k++) {
            double column = ray->column_m[i];
            for (int j = 0; j < count; j++) {
                column += cumulative[k * count + j] * nodes[j].density[i] * nodes[j].weight_m;
            }
            nodes[k].column_m[i] = column;
        }
        for (int k = 0; k < count; k++) {
            ray->column_m[i] +=
                rules->rule[count].weight[k] * nodes[k].density[i] * nodes[k].weight_m;
        }
    }
    for (int k = 0; k < count; k++) {
        nodes[k].weight_m *= rules->rule[count].weight[k];
    }
    ray->node_count += count;
}

// What the pieces of a leg have in common.
struct march {
    struct ray *ray;
    const struct optics *optics;
    const struct ray_rules *rules;
    const struct ray_desc *desc;
    const struct leg *leg;
};

// Is the last rule too long at a wavelength at which its light arrives?
static bool is_too_deep(const struct march *m, const lanes *before)
{
    if (m->desc->depth_per_rule <= 0) {
        return false;
    }
    const lanes after = optics_depth(m->optics, m->ray->column_m);
    for (int k = 0; k < m->optics->wavelength_count; k++) {
        const double depth = (double)(after[k] - (*before)[k]);
        // What is dim may be rough: e^-7 is a thousandth.
        if (depth > m->desc->depth_per_rule * (1 + 0.5 * (double)(*before)[k])) {
            return true;
        }
    }
    return false;
}

static bool is_dark(const struct march *m, const lanes *depth)
{
    if (m->desc->least_transmittance <= 0) {
        return false;
    }
    const double deepest = -log(m->desc->least_transmittance);
    for (int k = 0; k < m->optics->wavelength_count; k++) {
        if ((double)(*depth)[k] < deepest) {
            return false;
        }
    }
    return true;
}

// One Gauss rule over t in [from, to]; from > to on a falling leg, which the ray follows downward.
static void place_rule(const struct march *m, double from, double to, int count)
{
    struct ray *ray = m->ray;
    for (int k = 0; k < count; k++) {
        struct ray_node *node = &ray->node[ray->node_count + k];
        place_node(node, ray, m->optics, m->leg,
                   from + (to - from) * m->rules->rule[count].node[k]);
        node->weight_m *= fabs(to - from);
    }
    finish_rule(ray, m->optics, m->rules, count);
}

// A rule that would reach too deep is cut in two, and those again.
static void add_rule(const struct march *m, double from, double to, int nodes, int cuts)
{
    struct ray *ray = m->ray;
    const lanes before = optics_depth(m->optics, ray->column_m);
    ray->is_dark = ray->is_dark || is_dark(m, &before);
    const int left = RAY_MAX_NODES - ray->node_count;
    const int count = nodes < left ? nodes : left;
    if (ray->is_dark || count < 1) {
        return;
    }
    double column_m[MEDIUM_MAX_CONSTITUENTS];
    memcpy(column_m, ray->column_m, sizeof column_m);
    place_rule(m, from, to, count);
    if (cuts > 0 && is_too_deep(m, &before)) {
        memcpy(ray->column_m, column_m, sizeof column_m);
        ray->node_count -= count;
        const double middle = 0.5 * (from + to);
        const int half = nodes > 2 * CUT_MIN_NODES ? (nodes + 1) / 2 : CUT_MIN_NODES;
        add_rule(m, from, middle, half, cuts - 1);
        add_rule(m, middle, to, half, cuts - 1);
    }
}

static double leg_parameter(const struct leg *leg, double shell)
{
    const double span = leg->high_shell - leg->low_shell;
    return span > 0 ? sqrt(fmin(fmax((shell - leg->low_shell) / span, 0), 1)) : 0;
}

// Parameters of the kinks, in the order in which the ray meets them; the leg's end is the last.
static int list_stops(const struct ray *ray, const struct optics *optics,
                      const struct ray_desc *desc, const struct leg *leg, double *stop)
{
    const double end = leg->is_rising ? 1 : 0;
    int count = 0;
    for (int b = 0; b < desc->break_count; b++) {
        if (desc->break_m[b] > leg->from_m && desc->break_m[b] < leg->to_m) {
            const double altitude_m = altitude_at(ray, optics, desc->break_m[b]);
            stop[count++] = leg_parameter(leg, optics_shell(optics, altitude_m));
        }
    }
    for (int k = 0; k < optics->kink_count; k++) {
        if (optics->kink_shell[k] > leg->low_shell && optics->kink_shell[k] < leg->high_shell) {
            stop[count++] = leg_parameter(leg, optics->kink_shell[k]);
        }
    }
    for (int n = 1; n < count; n++) {
        const double moved = stop[n];
        int at = n;
        for (; at > 0 && (leg->is_rising ? stop[at - 1] > moved : stop[at - 1] < moved); at--) {
            stop[at] = stop[at - 1];
        }
        stop[at] = moved;
    }
    stop[count++] = end;
    return count;
}

// Follows the leg from kink to kink, with as many nodes as the shells that each piece crosses ask
// for.
static void add_leg(struct ray *ray, const struct optics *optics, const struct ray_rules *rules,
                    const struct ray_desc *desc, const struct leg *leg)
{
    double stop[RAY_MAX_BREAKS + OPTICS_KINKS + 1];
    const int stops = list_stops(ray, optics, desc, leg, stop);
    const struct march march = {ray, optics, rules, desc, leg};
    double at = leg->is_rising ? 0 : 1;
    for (int n = 0; n < stops; n++) {
        const double to = stop[n];
        const double span = (leg->high_shell - leg->low_shell) * fabs(to * to - at * at);
        // A short way through few shells can still be long in t, so half of the nodes go by t.
        const double wanted =
            desc->nodes_per_shell * (0.5 * span + 0.5 * fabs(to - at) * sqrt(span));
        const int count = LEG_MIN_NODES + (int)fmin(ceil(wanted), RAY_MAX_NODES);
        const int pieces = (count + RAY_RULE_NODES - 1) / RAY_RULE_NODES;
        for (int p = 0; p < pieces && to != at; p++) {
            add_rule(&march, at + (to - at) * p / pieces, at + (to - at) * (p + 1) / pieces,
                     (count + pieces - 1) / pieces, MAX_CUTS);
        }
        at = to;
    }
}

static void add_legs(struct ray *ray, const struct optics *optics, const struct ray_rules *rules,
                     const struct ray_desc *desc)
{
    const double closest_m = -desc->radius_m * desc->mu;
    if (closest_m <= ray->begin_m || closest_m >= ray->end_m) {
        const struct leg leg = make_leg(ray, optics, ray->begin_m, ray->end_m);
        add_leg(ray, optics, rules, desc, &leg);
        return;
    }
    const struct leg falling = make_leg(ray, optics, ray->begin_m, closest_m);
    const struct leg rising = make_leg(ray, optics, closest_m, ray->end_m);
    add_leg(ray, optics, rules, desc, &falling);
    add_leg(ray, optics, rules, desc, &rising);
}

void ray_init(struct ray *ray, const struct optics *optics, const struct ray_rules *rules,
              const struct ray_desc *desc)
{
    ray->eye_radius_m = desc->radius_m;
    ray->eye_mu = desc->mu;
    ray->first_node = ray->node_count = 0;
    ray->is_dark = false;
    memset(ray->column_m, 0, sizeof ray->column_m);
    if (!ray_clip(optics, desc->radius_m, desc->mu, &ray->begin_m, &ray->end_m,
                  &ray->hits_ground)) {
        return;
    }
    if (desc->end_m < ray->end_m) {
        ray->end_m = fmax(ray->begin_m, desc->end_m);
        ray->hits_ground = false;
    }
    add_legs(ray, optics, rules, desc);
    ray->hits_ground = ray->hits_ground && !ray->is_dark;
}

void ray_init_cells(struct ray *ray, const struct optics *optics, const struct ray_rules *rules,
                    const struct ray_desc *desc, const double *bound_m, int count, int per_cell)
{
    ray->eye_radius_m = desc->radius_m;
    ray->eye_mu = desc->mu;
    ray->begin_m = bound_m[0];
    ray->end_m = bound_m[count];
    ray->hits_ground = ray->is_dark = false;
    ray->first_node = ray->node_count = 0;
    memset(ray->column_m, 0, sizeof ray->column_m);
    const double pass_m = desc->radius_m * sqrt(fmax(0, 1 - desc->mu * desc->mu));
    for (int c = 0; c < count; c++) {
        const double length_m = bound_m[c + 1] - bound_m[c];
        for (int k = 0; k < per_cell; k++) {
            struct ray_node *node = &ray->node[ray->node_count + k];
            node->distance_m = bound_m[c] + length_m * rules->rule[per_cell].node[k];
            node->weight_m = length_m;
            node->altitude_m = altitude_at(ray, optics, node->distance_m);
            node->radius_m = optics->ground_radius_m + node->altitude_m;
            node->shell = optics_shell(optics, node->altitude_m);
            node->mu =
                fmin(1, fmax(-1, (desc->radius_m * desc->mu + node->distance_m) / node->radius_m));
            node->sine = fmin(1, pass_m / node->radius_m);
            fill_density(node, optics);
        }
        finish_rule(ray, optics, rules, per_cell);
    }
}
