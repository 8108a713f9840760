// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/daylight.h"

#include "spectrum/cie.h"

#include <math.h>

static const double STEP_NM = 5;

// The star's irradiance as seen after a reflection with the albedo (NULL: a perfect one), per lumen
// of 683 to the watt.
static struct cie_xyz integrate(const struct medium *medium, const struct spectrum *albedo)
{
    struct cie_xyz sum = {0, 0, 0};
    for (double nm = CIE_FIRST_NM; nm < CIE_LAST_NM; nm += STEP_NM) {
        const double reflected = albedo ? spectrum_mean(albedo, nm, nm + STEP_NM) : 1;
        const double light = spectrum_mean(&medium->star_irradiance, nm, nm + STEP_NM) * reflected;
        const struct cie_xyz seen = cie_observer_integral(nm, nm + STEP_NM);
        sum.x += light * seen.x;
        sum.y += light * seen.y;
        sum.z += light * seen.z;
    }
    return sum;
}

double daylight_wall_cd_m2(const struct medium *medium)
{
    return CIE_LUMENS_PER_WATT * integrate(medium, NULL).y / M_PI;
}

double daylight_meter_wall_cd_m2(const struct medium *medium)
{
    return fmax(daylight_wall_cd_m2(medium), 1);
}

static float divide(double reflected, double light)
{
    return light > 0 ? (float)fmin(fmax(reflected / light, 0), 1) : 0.0f;
}

void daylight_ground_albedo(const struct medium *medium, float rgb[3])
{
    daylight_albedo(medium, &medium->ground_albedo, rgb);
}

void daylight_albedo(const struct medium *medium, const struct spectrum *albedo, float rgb[3])
{
    const struct cie_rgb light = cie_rgb_of_xyz(integrate(medium, NULL));
    const struct cie_rgb reflected = cie_rgb_of_xyz(integrate(medium, albedo));
    rgb[0] = divide(reflected.r, light.r);
    rgb[1] = divide(reflected.g, light.g);
    rgb[2] = divide(reflected.b, light.b);
}

// Values of which a curve through all of them is made at a place: `weight` for each from `first`
// on, cubic as Catmull and Rom 1974, straight at the ends, even beyond them.
struct blend {
    int first;
    double weight[4];
};

static struct blend blend_at(double x, int count)
{
    const double at = fmax(0, fmin(x, count - 1));
    const int left = (int)fmin(at, count - 2);
    const double t = at - left;
    double w[4] = {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t),
                   t * (0.5 + t * (2 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)};
    // What is beyond an end goes on as it came.
    if (left == 0) {
        w[1] += 2 * w[0], w[2] -= w[0], w[0] = 0;
    }
    if (left == count - 2) {
        w[2] += 2 * w[3], w[1] -= w[3], w[3] = 0;
    }
    return (struct blend){left - 1, {w[0], w[1], w[2], w[3]}};
}

void daylight_weights(const struct medium *medium, const double *nm, int count,
                      double rgb[3][DAYLIGHT_MAX_WEIGHTS])
{
    struct cie_xyz sum[DAYLIGHT_MAX_WEIGHTS] = {{0, 0, 0}};
    for (double from = CIE_FIRST_NM; from < CIE_LAST_NM; from += STEP_NM) {
        const double light = spectrum_mean(&medium->star_irradiance, from, from + STEP_NM);
        const struct cie_xyz seen = cie_observer_integral(from, from + STEP_NM);
        const double x = (from + 0.5 * STEP_NM - nm[0]) / (nm[1] - nm[0]);
        const struct blend blend = blend_at(x, count);
        for (int n = 0; n < 4; n++) {
            const int k = blend.first + n;
            if (k >= 0 && k < count) {
                sum[k].x += light * blend.weight[n] * seen.x;
                sum[k].y += light * blend.weight[n] * seen.y;
                sum[k].z += light * blend.weight[n] * seen.z;
            }
        }
    }
    const struct cie_rgb light = cie_rgb_of_xyz(integrate(medium, NULL));
    for (int k = 0; k < count; k++) {
        const struct cie_rgb reflected = cie_rgb_of_xyz(sum[k]);
        rgb[0][k] = light.r > 0 ? reflected.r / light.r : 0;
        rgb[1][k] = light.g > 0 ? reflected.g / light.g : 0;
        rgb[2][k] = light.b > 0 ? reflected.b / light.b : 0;
    }
}
