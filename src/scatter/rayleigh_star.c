// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Colours of the wavelengths of pictures (Santana 2017, Section 4).
#include "scatter/rayleigh.h"

#include "spectrum/cie.h"

static const double FIRST_NM = 380;
static const double LAST_NM = 780;
static const double COLDEST_K = 500;
static const double HOTTEST_K = 1e6;
static const double SUN_K = 5778;

static double bell(double distance)
{
    return exp(-0.5 * distance * distance);
}

// The single-lobe fit of the 1931 observer: Wyman, Sloan and Shirley 2013, "Simple analytic
// approximations to the CIE XYZ color matching functions", JCGT 2(2), Section 2.
static struct cie_xyz observe(double nm)
{
    return (struct cie_xyz){1.065 * bell((nm - 595.8) / 33.33) + 0.366 * bell((nm - 446.8) / 19.44),
                            1.014 * bell((log(nm) - log(556.3)) / 0.075),
                            1.839 * bell((log(nm) - log(449.8)) / 0.051)};
}

// Irradiance of a black body of some size: only its shape counts.
static struct spectrum make_star(double temperature_K)
{
    return (struct spectrum){.kind = SPECTRUM_BLACKBODY,
                             .blackbody = {.temperature_K = temperature_K, .total_W_m2 = 1}};
}

static double find_blueness(const struct spectrum *star)
{
    const double middle = 0.5 * (FIRST_NM + LAST_NM);
    const double red = spectrum_mean(star, middle, LAST_NM);
    return spectrum_mean(star, FIRST_NM, middle) / (red > 0 ? red : 1e-300);
}

// The temperature of the black body that has the star's share of blue and red light: it gets bluer
// with its temperature, which is bisected in the logarithm.
static double find_temperature(const struct spectrum *star_irradiance)
{
    if (star_irradiance->kind == SPECTRUM_BLACKBODY) {
        return fmin(fmax(star_irradiance->blackbody.temperature_K, COLDEST_K), HOTTEST_K);
    }
    if (spectrum_mean(star_irradiance, FIRST_NM, LAST_NM) <= 0) {
        return SUN_K; // of no light any colour is right
    }
    const double wanted = find_blueness(star_irradiance);
    double cold = COLDEST_K;
    double hot = HOTTEST_K;
    for (int i = 0; i < 50; i++) {
        const double middle = sqrt(cold * hot);
        const struct spectrum star = make_star(middle);
        if (find_blueness(&star) < wanted) {
            cold = middle;
        } else {
            hot = middle;
        }
    }
    return sqrt(cold * hot);
}

static double find_luminance(const struct spectrum *star)
{
    const double step = 5;
    double sum = 0;
    for (double nm = CIE_FIRST_NM; nm < CIE_LAST_NM; nm += step) {
        sum += spectrum_mean(star, nm, nm + step) * cie_observer_integral(nm, nm + step).y;
    }
    return CIE_LUMENS_PER_WATT * sum;
}

void rayleigh_star_init(const struct rayleigh *model, struct rayleigh_star *out)
{
    const struct spectrum *star = &model->gas.medium->star_irradiance;
    const double given = model->desc.star_temperature_K;
    const int count = (int)model->desc.wavelengths;
    *out = (struct rayleigh_star){.temperature_K = given > 0 ? given : find_temperature(star),
                                  .luminance = find_luminance(star)};
    const struct spectrum body = make_star(out->temperature_K);
    double sum = 0;
    for (int k = 0; k < count; k++) {
        const double nm = FIRST_NM + (k + 0.5) * (LAST_NM - FIRST_NM) / count;
        const double light = spectrum_at(&body, nm);
        const struct cie_xyz seen = observe(nm);
        const struct cie_rgb rgb =
            cie_rgb_of_xyz((struct cie_xyz){light * seen.x, light * seen.y, light * seen.z});
        out->nm[k] = nm;
        out->rgb[k][0] = rgb.r;
        out->rgb[k][1] = rgb.g;
        out->rgb[k][2] = rgb.b;
        sum += light * seen.y;
    }
    for (int k = 0; k < 3 * count; k++) {
        out->rgb[k / 3][k % 3] /= sum;
    }
}
