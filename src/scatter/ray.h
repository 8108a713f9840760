// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_RAY_H
#define SCATTER_RAY_H
// The nodes of a quadrature along a straight ray through spherical shells. Everything here depends
// on the geometry and the density profiles alone, so one ray serves every wavelength, sun and
// azimuth.

#include "scatter/optics.h"
#include "scatter/quadrature.h"

enum { RAY_MAX_NODES = 1024, RAY_MAX_BREAKS = 8, RAY_RULE_NODES = 16 };

// Gauss rules of 1 .. RAY_RULE_NODES points with their cumulative weights; shared by all rays.
struct ray_rules {
    struct gauss rule[RAY_RULE_NODES + 1];
    double cumulative[RAY_RULE_NODES + 1][RAY_RULE_NODES * RAY_RULE_NODES];
};

void ray_rules_init(struct ray_rules *rules);

struct ray_node {
    double distance_m; // from the eye
    double radius_m;
    double mu;   // cosine of the zenith angle of the ray here
    double sine; // of it, >= 0
    double weight_m;
    double altitude_m;
    double shell;
    double density[MEDIUM_MAX_CONSTITUENTS];
    double column_m[MEDIUM_MAX_CONSTITUENTS]; // from the eye, at reference density
};

struct ray_desc {
    double radius_m;        // of the eye; above the top is legal
    double mu;              // cosine of the ray's zenith angle at the eye
    double nodes_per_shell; // nodes on a way through the whole shell coordinate; at least 4 are
                            // used on any leg
    double end_m;           // the ray ends here at the latest; INFINITY: at the ground or the top
    // In dense matter nodes go by optical depth: no rule reaches across more than this (0: any) as
    // long as something of its light arrives, and the ray ends where less than this part of the
    // light at any wavelength would arrive (0: never), as if nothing were behind.
    double depth_per_rule;
    double least_transmittance;
    int break_count; // distances where the integrand has a kink: no rule reaches across
    double break_m[RAY_MAX_BREAKS];
};

struct ray {
    double eye_radius_m, eye_mu;
    double begin_m, end_m; // of the part inside the medium; equal when there is none
    bool hits_ground;      // at end_m
    bool is_dark;          // ended early by least_transmittance
    double column_m[MEDIUM_MAX_CONSTITUENTS]; // of the whole part
    int first_node;                           // integrations take nodes [first_node, node_count)
    int node_count;
    struct ray_node node[RAY_MAX_NODES];
};

void ray_init(struct ray *ray, const struct optics *optics, const struct ray_rules *rules,
              const struct ray_desc *desc);

// The same with cells instead of legs: `count` + 1 ascending distances, `per_cell` nodes in each,
// so that an integration can stop at each bound. The nodes of cell c are [c * per_cell, (c + 1) *
// per_cell). count * per_cell <= RAY_MAX_NODES, per_cell <= RAY_RULE_NODES.
void ray_init_cells(struct ray *ray, const struct optics *optics, const struct ray_rules *rules,
                    const struct ray_desc *desc, const double *bound_m, int count, int per_cell);

// Half the chord that a line passing the centre at `pass_m` cuts from a sphere, without
// cancellation; 0 where it passes by.
double ray_half_chord(double radius_m, double pass_m);

// Geometry alone: where the ray enters and leaves the medium. False when it misses.
bool ray_clip(const struct optics *optics, double radius_m, double mu, double *begin_m,
              double *end_m, bool *hits_ground);

#endif // SCATTER_RAY_H
