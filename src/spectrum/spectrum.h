// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SPECTRUM_SPECTRUM_H
#define SPECTRUM_SPECTRUM_H
// A quantity that depends on the wavelength, in the forms a scene file knows.

#include "base/context.h"

enum spectrum_kind {
    SPECTRUM_CONSTANT = 0, // a zeroed spectrum is 0 everywhere
    SPECTRUM_TABLE,        // linear between the knots, constant outside
    SPECTRUM_POWER_LAW,    // value * (nm / at_nm)^exponent
    SPECTRUM_RAYLEIGH,     // scattering of a gas per metre, Elek 2010 Eq. 1-2 (no depolarisation)
    SPECTRUM_BLACKBODY     // irradiance W m^-2 nm^-1 of a black body whose whole spectrum sums to
                           // total_W_m2
};

// Weight over the wavelength that is 1 at peak_nm and falls linearly to 0 at the neighbours. The
// hats of ascending knots sum to 1 everywhere: what they weigh is interpolated between the knots,
// and constant outside, where the first and the last hat have no edge. A zeroed hat weighs 1.
struct spectrum_hat {
    double from_nm; // 0: no edge below
    double peak_nm; // 0: no hat
    double to_nm;   // 0: no edge above
};

struct spectrum {
    enum spectrum_kind kind;
    struct spectrum_hat hat; // factor of all values
    union {
        double constant;
        struct {
            double *nm; // ascending; `nm` and `value` are two halves of one block, owned
            double *value;
            size_t count; // >= 1
        } table;
        struct {
            double at_nm, value, exponent;
        } power_law;
        struct {
            double refractive_index, number_density_per_m3;
        } rayleigh;
        struct {
            double temperature_K, total_W_m2;
        } blackbody;
    };
};

// The value at one wavelength, nm > 0.
double spectrum_at(const struct spectrum *spectrum, double nm);

// The mean over [from_nm, to_nm], from < to: exact for tables without a hat, else by Simpson's
// rule.
double spectrum_mean(const struct spectrum *spectrum, double from_nm, double to_nm);

// Copies `count` knots (ascending nm) into a table spectrum.
TRL_MUST_USE trl_result spectrum_table_init(const trl_context *ctx, const double *nm,
                                            const double *value, size_t count,
                                            struct spectrum *out);
// A copy with a table of its own.
TRL_MUST_USE trl_result spectrum_copy(const trl_context *ctx, const struct spectrum *spectrum,
                                      struct spectrum *out);
// The hat of knot `index` among `count` ascending ones.
struct spectrum_hat spectrum_hat_of(const double *knot_nm, size_t count, size_t index);

// Frees what a table owns; a zeroed spectrum is a no-op.
void spectrum_finish(const trl_context *ctx, struct spectrum *spectrum);

#endif // SPECTRUM_SPECTRUM_H
