// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/water_phase.h"

#include <math.h>

static const double LEAST_BACK = 0.0005, MOST_BACK = 0.09;
enum { HALVINGS = 60 };

static struct water_phase particles_of(double slope)
{
    const double index = 1.01 + 0.1542 * (slope - 3);
    return (struct water_phase){.index = index,
                                .slope = slope,
                                .nu = (3 - slope) / 2,
                                .scale = 4 / (3 * (index - 1) * (index - 1))};
}

// The part that goes back: Mobley, Sundman and Boss 2002, Eq. 6.
static double find_back(const struct water_phase *p)
{
    const double delta = p->scale / 2, power = pow(delta, p->nu);
    return 1 - (1 - delta * power - 0.5 * (1 - power)) / ((1 - delta) * power);
}

struct water_phase water_phase_make(const struct water_optics *optics)
{
    const double wanted = fmin(fmax(optics->backscatter, LEAST_BACK), MOST_BACK);
    double low = 3.001, high = 4.9;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        const struct water_phase p = particles_of(middle);
        if (find_back(&p) < wanted) {
            low = middle;
        } else {
            high = middle;
        }
    }
    struct water_phase phase = particles_of(low);
    const double all = optics->clear_per_m + optics->particles_per_m;
    phase.clear_share = all > 0 ? optics->clear_per_m / all : 1;
    return phase;
}

// With the square of the sine of half the angle, which a cosine near 1 has no digits of.
static double particles_value(const struct water_phase *p, double square)
{
    const double nu = p->nu;
    double delta = p->scale * square;
    if (fabs(delta - 1) < 1e-4) { // where numerator and denominator vanish together
        delta = 1 + (delta < 1 ? -1e-4 : 1e-4);
    }
    const double power = pow(delta, nu), left = 1 - delta;
    const double first = (nu * left - (1 - power) + (delta * (1 - power) - nu * left) / square) /
                         (4 * M_PI * left * left * power);
    const double back = pow(p->scale, nu), cosine = 1 - 2 * square;
    return first + (1 - back) / (16 * M_PI * (p->scale - 1) * back) * (3 * cosine * cosine - 1);
}

static double clear_value(double cosine)
{
    return (1 + WATER_ANISOTROPY * cosine * cosine) / (4 * M_PI * (1 + WATER_ANISOTROPY / 3));
}

double water_phase_value(const struct water_phase *phase, double cosine)
{
    const double square = fmax((1 - cosine) / 2, 1e-12);
    return phase->clear_share * clear_value(cosine) +
           (1 - phase->clear_share) * particles_value(phase, square);
}

// The particles' phase function with a blunt peak: below this angle the logarithm is a parabola
// that goes on with the value and the slope. Moments beyond SLAB_MOMENTS are then below 1 %, and
// what is left of them has no ripples where it goes back, which those of a sharp peak have.
static const double BLUNT = 0.16;

static double blunt_value(const struct water_phase *p, double angle)
{
    if (angle >= BLUNT) {
        const double half = sin(angle / 2);
        return particles_value(p, half * half);
    }
    static const double STEP = 1.001;
    const double half = sin(BLUNT / 2), beyond = sin(BLUNT * STEP / 2);
    const double value = particles_value(p, half * half);
    const double slope = log(value / particles_value(p, beyond * beyond)) / log(STEP);
    const double part = angle / BLUNT;
    return value * exp(slope / 2 * (1 - part * part));
}

double water_phase_blunt(const struct water_phase *phase, double angle)
{
    return phase->clear_share * clear_value(cos(angle)) +
           (1 - phase->clear_share) * blunt_value(phase, angle);
}

double water_phase_moments(const struct water_phase *phase, int count, double *moment)
{
    enum { STEPS = 4000 };
    const double step = M_PI / STEPS;
    for (int l = 0; l < count; l++) {
        moment[l] = 0;
    }
    for (int i = 0; i < STEPS; i++) {
        const double angle = step * (i + 0.5), x = cos(angle);
        const double weight = blunt_value(phase, angle) * 2 * M_PI * sin(angle) * step;
        double before = 0, now = 1;
        for (int l = 0; l < count; l++) {
            moment[l] += weight * now;
            const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
            before = now;
            now = next;
        }
    }
    const double left = (1 - phase->clear_share) * moment[0] + phase->clear_share;
    for (int l = 0; l < count; l++) {
        const double clear = l == 0   ? 1
                             : l == 2 ? 2 * WATER_ANISOTROPY / (5 * (3 + WATER_ANISOTROPY))
                                      : 0;
        moment[l] = (phase->clear_share * clear + (1 - phase->clear_share) * moment[l]) / left;
    }
    return 1 - left;
}
