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

void daylight_weights(const struct medium *medium, const double *nm, int count,
                      double rgb[3][DAYLIGHT_MAX_WEIGHTS])
{
    const struct cie_rgb light = cie_rgb_of_xyz(integrate(medium, NULL));
    for (int k = 0; k < count; k++) {
        const struct spectrum hat = {.constant = 1,
                                     .hat = {.from_nm = k > 0 ? nm[k - 1] : 0,
                                             .peak_nm = nm[k],
                                             .to_nm = k + 1 < count ? nm[k + 1] : 0}};
        const struct cie_rgb reflected = cie_rgb_of_xyz(integrate(medium, &hat));
        rgb[0][k] = light.r > 0 ? reflected.r / light.r : 0;
        rgb[1][k] = light.g > 0 ? reflected.g / light.g : 0;
        rgb[2][k] = light.b > 0 ? reflected.b / light.b : 0;
    }
}
