// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/bands.h"

#include "spectrum/cie.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Share of wavelength `k` in the piecewise-linear interpolation at nm; constant outside the ends.
static double hat(const struct optics *optics, int k, double nm)
{
    const double *at = optics->wavelength_nm;
    const int last = optics->wavelength_count - 1;
    if (nm <= at[0]) {
        return k == 0;
    }
    if (nm >= at[last]) {
        return k == last;
    }
    if (nm >= at[k]) {
        return k < last && nm < at[k + 1] ? (at[k + 1] - nm) / (at[k + 1] - at[k]) : nm == at[k];
    }
    return k > 0 && nm > at[k - 1] ? (nm - at[k - 1]) / (at[k] - at[k - 1]) : 0;
}

void band_fit_init(struct band_fit *fit, const struct optics *optics)
{
    *fit = (struct band_fit){.optics = optics};
    for (double nm = CIE_FIRST_NM; nm < CIE_LAST_NM; nm += 1) {
        const struct cie_xyz observer = cie_observer_integral(nm, nm + 1);
        const double irradiance = spectrum_at(&optics->medium->star_irradiance, nm + 0.5);
        const double watts = CIE_LUMENS_PER_WATT * irradiance;
        for (int k = 0; k < optics->wavelength_count; k++) {
            const double share = hat(optics, k, nm + 0.5);
            fit->xyz_from_lanes[0][k] += share * observer.x * watts;
            fit->xyz_from_lanes[1][k] += share * observer.y * watts;
            fit->xyz_from_lanes[2][k] += share * observer.z * watts;
        }
    }
    for (int k = 0; k < optics->wavelength_count; k++) {
        const struct cie_rgb rgb = cie_rgb_of_xyz((struct cie_xyz){
            fit->xyz_from_lanes[0][k], fit->xyz_from_lanes[1][k], fit->xyz_from_lanes[2][k]});
        fit->rgb_from_lanes[0][k] = rgb.r;
        fit->rgb_from_lanes[1][k] = rgb.g;
        fit->rgb_from_lanes[2][k] = rgb.b;
    }
}

void band_fit_add(struct band_fit *fit, const lanes *spectrum)
{
    const int count = fit->optics->wavelength_count;
    struct cie_rgb rgb = {0};
    for (int k = 0; k < count; k++) {
        rgb.r += fit->rgb_from_lanes[0][k] * (double)(*spectrum)[k];
        rgb.g += fit->rgb_from_lanes[1][k] * (double)(*spectrum)[k];
        rgb.b += fit->rgb_from_lanes[2][k] * (double)(*spectrum)[k];
    }
    const double luminance = cie_luminance(rgb);
    if (!(luminance > 1e-30)) {
        return;
    }
    for (int k = 0; k < count; k++) {
        for (int j = 0; j < count; j++) {
            fit->gram[k][j] +=
                (double)(*spectrum)[k] * (double)(*spectrum)[j] / (luminance * luminance);
        }
    }
}

enum { SURFACES = 9 };

// Albedo of typical surfaces over x = 0 (shortest) to 1 (longest wavelength): grey, slopes both
// ways, the middle
// raised or lowered, and smooth bumps that look blue, green, yellow and red.
static double surface_albedo(int surface, double x)
{
    const double values[SURFACES] = {1,
                                     1 - 0.8 * x,
                                     0.2 + 0.8 * x,
                                     1 - 0.8 * fabs(2 * x - 1),
                                     0.2 + 0.8 * fabs(2 * x - 1),
                                     0.1 + 0.9 * exp(-40 * (x - 0.20) * (x - 0.20)),
                                     0.1 + 0.9 * exp(-40 * (x - 0.45) * (x - 0.45)),
                                     0.1 + 0.9 * exp(-40 * (x - 0.60) * (x - 0.60)),
                                     0.1 + 0.9 / (1 + exp(-20 * (x - 0.60)))};
    return values[surface];
}

void band_fit_add_surfaces(struct band_fit *fit, const lanes *light)
{
    static const float ways[] = {0, 1, 3}; // through the vertical optical depth
    const struct optics *optics = fit->optics;
    const int last = optics->wavelength_count - 1;
    for (int surface = 0; surface < SURFACES; surface++) {
        for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
            lanes spectrum;
            for (int k = 0; k < LANES; k++) {
                const double x = last > 0 ? (double)(k < last ? k : last) / last : 0.5;
                spectrum[k] =
                    (*light)[k] * (float)(surface_albedo(surface, x) *
                                          exp(-(double)ways[w] * optics->vertical_depth[k]));
            }
            // White counts for three: a wrong grey is seen first.
            for (int times = surface == 0 ? 3 : 1; times > 0; times--) {
                band_fit_add(fit, &spectrum);
            }
        }
    }
}

void band_fit_add_products(struct band_fit *fit, const struct solution *solution)
{
    const struct moments *m = &solution->moments;
    static const int suns_deg[] = {0, 40, 60, 70, 80, 85, 88};
    for (size_t s = 0; s < sizeof suns_deg / sizeof *suns_deg; s++) {
        const double mu = cos(suns_deg[s] * M_PI / 180);
        lanes star;
        sunlight_at(&solution->sun, fit->optics->ground_radius_m, mu, &star);
        band_fit_add_surfaces(fit, &star);
        int nearest = 0;
        for (int i = 0; i < m->suns; i++) {
            nearest = fabs(moments_sun_mu(m, i) - mu) < fabs(moments_sun_mu(m, nearest) - mu)
                          ? i
                          : nearest;
        }
        band_fit_add_surfaces(fit, &m->irradiance[nearest]);
    }
}

// Solves the symmetric system a x = b (4 x 4, three right sides) by elimination with pivoting.
// False when it is singular: the spectra do not tell these wavelengths apart.
static bool solve_four(double a[BAND_COUNT][BAND_COUNT], double b[BAND_COUNT][3])
{
    for (int c = 0; c < BAND_COUNT; c++) {
        int pivot = c;
        for (int r = c + 1; r < BAND_COUNT; r++) {
            pivot = fabs(a[r][c]) > fabs(a[pivot][c]) ? r : pivot;
        }
        if (!(fabs(a[pivot][c]) > 1e-300)) {
            return false;
        }
        for (int k = 0; k < BAND_COUNT; k++) {
            const double kept = a[c][k];
            a[c][k] = a[pivot][k];
            a[pivot][k] = kept;
        }
        for (int k = 0; k < 3; k++) {
            const double kept = b[c][k];
            b[c][k] = b[pivot][k];
            b[pivot][k] = kept;
        }
        for (int r = 0; r < BAND_COUNT; r++) {
            const double factor = r == c ? 0 : a[r][c] / a[c][c];
            for (int k = 0; k < BAND_COUNT; k++) {
                a[r][k] -= factor * a[c][k];
            }
            for (int k = 0; k < 3; k++) {
                b[r][k] -= factor * b[c][k];
            }
        }
    }
    for (int r = 0; r < BAND_COUNT; r++) {
        for (int k = 0; k < 3; k++) {
            b[r][k] /= a[r][r];
        }
    }
    return true;
}

// With W the exact matrix and G the Gram matrix, the best matrix on the choice S is M = W G_S
// (G_SS)^-1 and leaves trace(W G W^T) - trace(M (W G_S)^T).
static double fit_choice(const struct band_fit *fit, double projected[3][LANES], double whole,
                         const int *lane, double matrix[3][BAND_COUNT])
{
    double a[BAND_COUNT][BAND_COUNT];
    double b[BAND_COUNT][3];
    for (int r = 0; r < BAND_COUNT; r++) {
        for (int c = 0; c < BAND_COUNT; c++) {
            a[r][c] = fit->gram[lane[r]][lane[c]];
        }
        a[r][r] *= 1 + 1e-12; // keeps equal spectra solvable
        for (int k = 0; k < 3; k++) {
            b[r][k] = projected[k][lane[r]];
        }
    }
    if (!solve_four(a, b)) {
        return INFINITY;
    }
    double left = whole;
    for (int k = 0; k < 3; k++) {
        for (int r = 0; r < BAND_COUNT; r++) {
            matrix[k][r] = b[r][k];
            left -= b[r][k] * projected[k][lane[r]];
        }
    }
    return fmax(0, left);
}

// Albedo by least change: with white w = M 1 and N = diag(1/w) M, the bands of a colour c are the
// smallest ones with N a = c, plus a share of N's null space that makes white 1 in every band.
static void derive_albedo(struct bands *bands)
{
    double n[3][BAND_COUNT];
    for (int k = 0; k < 3; k++) {
        double white = 0;
        for (int r = 0; r < BAND_COUNT; r++) {
            white += (double)bands->rgb_from_bands[k][r];
        }
        for (int r = 0; r < BAND_COUNT; r++) {
            n[k][r] = (double)bands->rgb_from_bands[k][r] / white;
        }
    }
    // N^T (N N^T)^-1, with the inverse by cofactors
    double p[3][3] = {{0}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            for (int r = 0; r < BAND_COUNT; r++) {
                p[i][j] += n[i][r] * n[j][r];
            }
        }
    }
    double inverse[3][3];
    double determinant = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            inverse[i][j] = p[a][c] * p[b][d] - p[a][d] * p[b][c];
        }
        determinant += p[0][i] * inverse[i][0];
    }
    for (int r = 0; r < BAND_COUNT; r++) {
        double row[3];
        double sum = 0;
        for (int k = 0; k < 3; k++) {
            row[k] = (n[0][r] * inverse[0][k] + n[1][r] * inverse[1][k] + n[2][r] * inverse[2][k]) /
                     determinant;
            sum += row[k];
        }
        for (int k = 0; k < 3; k++) {
            bands->bands_from_rgb[r][k] = (float)(row[k] + (1 - sum) / 3);
        }
    }
}

// A scene with fewer than four wavelengths, or black in all of them, shows what it has.
static void choose_few(const struct band_fit *fit, struct bands *out)
{
    const int count = fit->optics->wavelength_count;
    for (int r = 0; r < BAND_COUNT; r++) {
        out->lane[r] =
            count > BAND_COUNT ? r * (count - 1) / (BAND_COUNT - 1) : (r < count ? r : count - 1);
        for (int k = 0; k < 3; k++) {
            out->rgb_from_bands[k][r] = 0;
            out->bands_from_rgb[r][k] = 1.0f / 3.0f;
        }
    }
    for (int lane = 0; lane < count; lane++) {
        int nearest = 0;
        for (int r = 1; r < BAND_COUNT; r++) {
            if (abs(out->lane[r] - lane) < abs(out->lane[nearest] - lane)) {
                nearest = r;
            }
        }
        for (int k = 0; k < 3; k++) {
            out->rgb_from_bands[k][nearest] += (float)fit->rgb_from_lanes[k][lane];
        }
    }
}

void band_fit_choose(const struct band_fit *fit, struct bands *out)
{
    *out = (struct bands){.rms_error = INFINITY};
    const int count = fit->optics->wavelength_count;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < count; i++) {
            out->xyz_from_lanes[k][i] = (float)fit->xyz_from_lanes[k][i];
        }
    }
    double projected[3][LANES] = {{0}}; // W G
    double whole = 0;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < count; i++) {
            for (int j = 0; j < count; j++) {
                projected[k][i] += fit->rgb_from_lanes[k][j] * fit->gram[j][i];
            }
            whole += projected[k][i] * fit->rgb_from_lanes[k][i];
        }
    }
    double spectra = 0; // how many were added: each has luminance 1
    for (int i = 0; i < count; i++) {
        const double to_y[3] = {0.2126, 0.7152, 0.0722};
        for (int k = 0; k < 3; k++) {
            for (int j = 0; j < 3; j++) {
                spectra += to_y[k] * to_y[j] * projected[k][i] * fit->rgb_from_lanes[j][i];
            }
        }
    }
    double best = INFINITY;
    int lane[BAND_COUNT];
    for (lane[0] = 0; lane[0] < count; lane[0]++) {
        for (lane[1] = lane[0] + 1; lane[1] < count; lane[1]++) {
            for (lane[2] = lane[1] + 1; lane[2] < count; lane[2]++) {
                for (lane[3] = lane[2] + 1; lane[3] < count; lane[3]++) {
                    double matrix[3][BAND_COUNT] = {{0}};
                    const double left = fit_choice(fit, projected, whole, lane, matrix);
                    if (!(left < best)) {
                        continue;
                    }
                    best = left;
                    memcpy(out->lane, lane, sizeof lane);
                    for (int k = 0; k < 3; k++) {
                        for (int r = 0; r < BAND_COUNT; r++) {
                            out->rgb_from_bands[k][r] = (float)matrix[k][r];
                        }
                    }
                }
            }
        }
    }
    if (spectra > 0 && best < HUGE_VAL) {
        out->rms_error = sqrt(best / spectra);
        derive_albedo(out);
    } else {
        choose_few(fit, out);
    }
    for (int r = 0; r < BAND_COUNT; r++) {
        out->nm[r] = fit->optics->wavelength_nm[out->lane[r]];
    }
}

void bands_xyz(const struct bands *bands, const lanes *radiance, float scale, float *texel)
{
    for (int k = 0; k < 3; k++) {
        float sum = 0;
        for (int i = 0; i < LANES; i++) {
            sum += bands->xyz_from_lanes[k][i] * (*radiance)[i];
        }
        texel[k] = sum * scale;
    }
    texel[3] = 0;
}
