// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/rayleigh.h"

#include "shared/phase.glsl"
#include "shared/sky_map.glsl"

enum { PROFILE_STEPS = 4096 };

static const double GAS_NM = 550;             // where constituents are weighed against each other
static const double HEIGHT_WITHOUT_GAS = 0.1; // scale height over the air's, of no gas at all

static bool is_gas(const struct constituent *c)
{
    return c->phase.kind == PHASE_RAYLEIGH && spectrum_at(&c->scattering_per_m, GAS_NM) > 0;
}

// Column of a constituent straight up and its first moment, at reference density.
static void weigh_profile(const struct profile *profile, double top_m, double *column,
                          double *moment)
{
    const double step = top_m / PROFILE_STEPS;
    for (int i = 0; i < PROFILE_STEPS; i++) {
        const double altitude_m = (i + 0.5) * step;
        const double part = profile_density(profile, altitude_m) * step;
        *column += part;
        *moment += part * altitude_m;
    }
}

// The one scale height of all gases, or 0.
static double find_common_scale(const struct medium *medium)
{
    double scale = 0;
    for (size_t i = 0; i < medium->constituent_count; i++) {
        const struct constituent *c = &medium->constituents[i];
        if (!is_gas(c)) {
            continue;
        }
        if (c->profile.kind != PROFILE_EXPONENTIAL ||
            (scale > 0 && c->profile.scale_height_m != scale)) {
            return 0;
        }
        scale = c->profile.scale_height_m;
    }
    return scale;
}

void rayleigh_gas_init(struct rayleigh_gas *gas, const struct medium *medium)
{
    *gas = (struct rayleigh_gas){.medium = medium, .scale_height_m = find_common_scale(medium)};
    const double top_m = medium->top_radius_m - medium->ground_radius_m;
    const bool is_exact = gas->scale_height_m > 0;
    double column[MEDIUM_MAX_CONSTITUENTS] = {0};
    double depth_sum = 0;
    double moment_sum = 0;
    for (size_t i = 0; i < medium->constituent_count; i++) {
        const struct constituent *c = &medium->constituents[i];
        if (is_gas(c) && is_exact) {
            gas->share[i] = 1;
        } else if (is_gas(c)) {
            const double per_m = spectrum_at(&c->scattering_per_m, GAS_NM);
            double moment = 0;
            weigh_profile(&c->profile, top_m, &column[i], &moment);
            depth_sum += per_m * column[i];
            moment_sum += per_m * moment;
        }
    }
    if (is_exact) {
        return;
    }
    gas->scale_height_m = moment_sum > 0 ? moment_sum / depth_sum : HEIGHT_WITHOUT_GAS * top_m;
    const double up = -gas->scale_height_m * expm1(-top_m / gas->scale_height_m);
    for (size_t i = 0; i < medium->constituent_count; i++) {
        gas->share[i] = column[i] / up;
    }
}

struct rayleigh_coefficients rayleigh_gas_at(const struct rayleigh_gas *gas, double nm)
{
    struct rayleigh_coefficients sum = {0, 0};
    for (size_t i = 0; i < gas->medium->constituent_count; i++) {
        const struct constituent *c = &gas->medium->constituents[i];
        if (gas->share[i] > 0) {
            const double scattering = spectrum_at(&c->scattering_per_m, nm);
            sum.scattering_per_m += gas->share[i] * scattering;
            sum.extinction_per_m +=
                gas->share[i] * (scattering + spectrum_at(&c->absorption_per_m, nm));
        }
    }
    return sum;
}

void rayleigh_init(struct rayleigh *model, const struct medium *medium,
                   const trl_rayleigh_desc *desc)
{
    model->desc = *desc;
    rayleigh_gas_init(&model->gas, medium);
    const double height_m = medium->top_radius_m - medium->ground_radius_m;
    const RayleighAir air =
        rayleigh_air_make(medium->ground_radius_m, height_m * desc->height_scale,
                          model->gas.scale_height_m * desc->height_scale);
    rayleigh_depth_init(&model->depth, &air, desc);
}

struct rayleigh_coefficients rayleigh_at(const struct rayleigh *model, double nm)
{
    const struct rayleigh_coefficients gas = rayleigh_gas_at(&model->gas, nm);
    const double scale = model->desc.height_scale;
    return (struct rayleigh_coefficients){
        gas.scattering_per_m / scale,
        model->desc.has_out_scattering ? gas.extinction_per_m / scale : 0};
}

// A point of a line of sight.
struct point {
    double x;             // along the line
    double view_m, sun_m; // g of the line of sight, and of the star's light
    double density;
};

struct sight {
    const struct rayleigh *model;
    const struct query_view *view;
    RayleighLine line;
    double start_x;    // of the eye, or where the line enters the air
    bool meets_ground; // at line.end
    double closest_density;
    struct point eye; // at line.begin
};

static struct point find_point(const struct sight *sight, double x)
{
    const struct rayleigh_depth *depth = &sight->model->depth;
    const RayleighAir *air = &depth->air;
    const RayleighLine *line = &sight->line;
    const double excess = line->excess + x * x;
    const double altitude = rayleigh_altitude(*air, excess);
    const double radius = air->ground_m + altitude;
    const double height = x * line->nu + line->sun_distance; // toward the star
    const double sun_closest = rayleigh_closest(*air, excess, height);
    return (struct point){.x = x,
                          .view_m = rayleigh_depth_along(depth, x / radius, altitude,
                                                         rayleigh_altitude(*air, line->excess)),
                          .sun_m =
                              rayleigh_depth_along(depth, -height / radius, altitude, sun_closest),
                          .density = rayleigh_density(*air, altitude)};
}

// The column between two points, the first before the second.
static double find_between(const struct sight *sight, const struct point *a, const struct point *b)
{
    const double thin = fmin(a->density, b->density);
    const double thick =
        a->x < 0 && b->x > 0 ? sight->closest_density : fmax(a->density, b->density);
    return rayleigh_between(b->view_m - a->view_m, b->x - a->x, thin, thick);
}

// False when the line misses the air.
static bool init_sight(struct sight *sight, const struct rayleigh *model,
                       const struct query_view *view)
{
    const RayleighAir *air = &model->depth.air;
    const double radius = fmax(view->radius_m, air->ground_m);
    const double eye_x = radius * view->view_mu;
    const double excess =
        rayleigh_excess(*air, radius - air->ground_m) - eye_x * eye_x; // of the closest point
    const double top2 = rayleigh_excess(*air, air->height_m) - excess;
    const bool is_outside = radius > air->ground_m + air->height_m;
    if (is_outside && (top2 <= 0 || eye_x > 0)) {
        return false;
    }
    const double chord = sqrt(fmax(top2, 0));
    *sight = (struct sight){.model = model, .view = view};
    sight->meets_ground = eye_x < 0 && excess < 0;
    sight->line = (RayleighLine){.begin = is_outside ? -chord : eye_x,
                                 .end = sight->meets_ground ? -sqrt(-excess) : chord,
                                 .excess = excess,
                                 .nu = view->nu,
                                 .sun_distance = radius * view->sun_mu - eye_x * view->nu};
    sight->line.end = fmax(sight->line.end, sight->line.begin);
    sight->closest_density = rayleigh_density(*air, rayleigh_altitude(*air, excess));
    sight->eye = find_point(sight, sight->line.begin);
    return true;
}

// Direct light that ground sends back, where the line ends.
static double light_ground(const struct sight *sight, double extinction_per_m)
{
    const struct medium *medium = sight->model->gas.medium;
    const double disc = sin(fmax(medium->star_angular_radius_rad, RAYLEIGH_SMALLEST_DISC_RAD));
    const struct point end = find_point(sight, sight->line.end);
    const double mu =
        (end.x * sight->line.nu + sight->line.sun_distance) / sight->model->depth.air.ground_m;
    const double column = find_between(sight, &sight->eye, &end) + end.sun_m;
    return exp(-extinction_per_m * column) * rayleigh_visible(mu / disc) *
           visible_height(mu, disc) / SHARED_PI;
}

// Light that the air sends, per scattering coefficient and phase function: an integral over the
// column, in which the whole optical depth changes evenly from sample to sample.
static double gather(const struct sight *sight, double extinction_per_m)
{
    const RayleighShadow shadow = rayleigh_shadow(sight->line);
    const RayleighLegs legs = rayleigh_legs(sight->line, shadow);
    const int samples = (int)sight->model->desc.samples;
    struct point before = {0};
    double depth_before = 0;
    double sum = 0;
    for (int i = 0; i < samples; i++) {
        const struct point here =
            find_point(sight, rayleigh_place(legs, (double)i / (samples - 1)));
        const double depth =
            extinction_per_m * (find_between(sight, &sight->eye, &here) + here.sun_m);
        if (i > 0) {
            const double mass =
                find_between(sight, &before, &here) * rayleigh_lit(shadow, before.x, here.x);
            sum += mass * rayleigh_mean(exp(-depth_before), exp(-depth), depth - depth_before);
        }
        before = here;
        depth_before = depth;
    }
    return sum;
}

double rayleigh_radiance(const struct rayleigh *model, const struct query_view *view, double nm)
{
    struct sight sight;
    const bool is_inside = init_sight(&sight, model, view);
    if (!is_inside) {
        return 0;
    }
    const struct rayleigh_coefficients c = rayleigh_at(model, nm);
    double light =
        gather(&sight, c.extinction_per_m) * c.scattering_per_m * phase_rayleigh(view->nu);
    if (sight.meets_ground) {
        light += light_ground(&sight, c.extinction_per_m) *
                 spectrum_at(&model->gas.medium->ground_albedo, nm);
    }
    return light;
}

const char *rayleigh_desc_wrong(const trl_rayleigh_desc *d)
{
    if (d->samples < 3 || d->samples > TRL_RAYLEIGH_MAX_SAMPLES || d->samples % 2 == 0) {
        return "samples";
    }
    if (d->wavelengths < 3 || d->wavelengths > TRL_RAYLEIGH_MAX_WAVELENGTHS) {
        return "wavelengths";
    }
    if (d->optical_depth != TRL_RAYLEIGH_TEXTURE && d->optical_depth != TRL_RAYLEIGH_FIT) {
        return "optical_depth";
    }
    if (d->fit_heights < 2 || d->fit_heights > TRL_RAYLEIGH_MAX_HEIGHTS) {
        return "fit_heights";
    }
    if (d->fit_degree < 1 || d->fit_degree > TRL_RAYLEIGH_MAX_DEGREE) {
        return "fit_degree";
    }
    if (!(d->height_scale > 0 && d->height_scale <= 1000)) {
        return "height_scale";
    }
    const double kelvin = d->star_temperature_K;
    return kelvin == 0 || (kelvin >= 500 && kelvin <= 1e6) ? NULL : "star_temperature_K";
}
