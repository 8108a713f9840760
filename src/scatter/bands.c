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
        fit->star_luminance += fit->xyz_from_lanes[1][k];
        fit->rgb_from_lanes[0][k] = rgb.r;
        fit->rgb_from_lanes[1][k] = rgb.g;
        fit->rgb_from_lanes[2][k] = rgb.b;
    }
}

// Of the star's light as it comes: what is darker is not seen beside the rest, and has no say in
// its colours. Stars through Venus' clouds, 1e-20, would choose the reddest wavelengths for all.
#define LEAST_SEEN 1e-6

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
    if (!(luminance > LEAST_SEEN * fit->star_luminance)) {
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
    const lanes bare = (lanes){0} + 1; // the star above the air
    static const int suns_deg[] = {0, 40, 60, 70, 80, 85, 88};
    for (size_t s = 0; s < sizeof suns_deg / sizeof *suns_deg; s++) {
        const double mu = cos(suns_deg[s] * M_PI / 180);
        lanes star;
        sunlight_at(&solution->sun, fit->optics->ground_radius_m, mu, &star);
        band_fit_add_surfaces(fit, &star);
        band_fit_add_surfaces(fit, &bare);
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

// By cofactors; false when the matrix is singular.
static bool invert_three(double m[3][3], double inverse[3][3])
{
    double determinant = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            inverse[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
        determinant += m[0][i] * inverse[i][0];
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            inverse[i][j] /= determinant;
        }
    }
    return fabs(determinant) > 0 && isfinite(1 / determinant);
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
    double p[3][3] = {{0}}; // N N^T
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            for (int r = 0; r < BAND_COUNT; r++) {
                p[i][j] += n[i][r] * n[j][r];
            }
        }
    }
    double inverse[3][3];
    invert_three(p, inverse);
    for (int r = 0; r < BAND_COUNT; r++) {
        double row[3];
        double sum = 0;
        for (int k = 0; k < 3; k++) {
            row[k] = n[0][r] * inverse[0][k] + n[1][r] * inverse[1][k] + n[2][r] * inverse[2][k];
            sum += row[k];
        }
        for (int k = 0; k < 3; k++) {
            bands->bands_from_rgb[r][k] = (float)(row[k] + (1 - sum) / 3);
        }
    }
}

// The star has light in all three colours.
static bool has_white(const struct bands *bands)
{
    for (int k = 0; k < 3; k++) {
        float white = 0;
        for (int r = 0; r < BAND_COUNT; r++) {
            white += bands->rgb_from_bands[k][r];
        }
        if (!(white > 0)) {
            return false;
        }
    }
    return true;
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
    if (count == 3 && has_white(out)) {
        derive_albedo(out); // three wavelengths tell colours of surfaces apart
    }
}

// What every choice needs of a fit.
struct fit_sums {
    double projected[3][LANES]; // W G
    double whole;               // trace(W G W^T)
    double spectra;             // how many were added: each has luminance 1
};

static struct fit_sums sum_fit(const struct band_fit *fit)
{
    struct fit_sums sums = {0};
    const int count = fit->optics->wavelength_count;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < count; i++) {
            for (int j = 0; j < count; j++) {
                sums.projected[k][i] += fit->rgb_from_lanes[k][j] * fit->gram[j][i];
            }
            sums.whole += sums.projected[k][i] * fit->rgb_from_lanes[k][i];
        }
    }
    const double to_y[3] = {0.2126, 0.7152, 0.0722};
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            for (int j = 0; j < 3; j++) {
                sums.spectra +=
                    to_y[k] * to_y[j] * sums.projected[k][i] * fit->rgb_from_lanes[j][i];
            }
        }
    }
    return sums;
}

// One fit that is tried on many choices. Returns what it leaves, a spectrum; 0 without any.
static double try_choice(const struct band_fit *fit, struct fit_sums *sums, const int *lane,
                         double matrix[3][BAND_COUNT])
{
    if (!(sums->spectra > 0)) {
        return 0;
    }
    return fit_choice(fit, sums->projected, sums->whole, lane, matrix) / sums->spectra;
}

static void copy_matrix(double from[3][BAND_COUNT], float to[3][BAND_COUNT])
{
    for (int k = 0; k < 3; k++) {
        for (int r = 0; r < BAND_COUNT; r++) {
            to[k][r] = (float)from[k][r];
        }
    }
}

// The bands of a colour by regression over the spectra of the fit, B = G_S W^T (W G W^T)^-1, then
// turned so that the matrix gives the colour back: B (M B)^-1.
static void derive_bands(const struct band_fit *fit, const struct fit_sums *sums, const int *lane,
                         struct added_bands *out)
{
    double whole[3][3] = {{0}}; // W G W^T
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < fit->optics->wavelength_count; k++) {
                whole[i][j] += sums->projected[i][k] * fit->rgb_from_lanes[j][k];
            }
        }
    }
    double inverse[3][3];
    double b[BAND_COUNT][3] = {{0}};
    bool is_good = invert_three(whole, inverse);
    double back[3][3] = {{0}}; // M B
    for (int r = 0; r < BAND_COUNT; r++) {
        for (int k = 0; k < 3; k++) {
            for (int j = 0; j < 3; j++) {
                b[r][k] += sums->projected[j][lane[r]] * inverse[j][k];
            }
            for (int j = 0; j < 3; j++) {
                back[j][k] += (double)out->rgb_from_bands[j][r] * b[r][k];
            }
        }
    }
    is_good = is_good && invert_three(back, inverse);
    for (int r = 0; r < BAND_COUNT; r++) {
        for (int k = 0; k < 3; k++) {
            double sum = 0;
            for (int j = 0; j < 3; j++) {
                sum += b[r][j] * inverse[j][k];
            }
            out->bands_from_rgb[r][k] = is_good ? (float)sum : 0;
        }
    }
}

// The choice of four that leaves least of both fits together.
static double search_choices(const struct band_fit *fit, const struct band_fit *added,
                             struct bands *out, struct added_bands *added_out)
{
    const int count = fit->optics->wavelength_count;
    struct fit_sums sums = sum_fit(fit);
    struct fit_sums added_sums = sum_fit(added);
    double best = INFINITY;
    int lane[BAND_COUNT];
    for (lane[0] = 0; lane[0] < count; lane[0]++) {
        for (lane[1] = lane[0] + 1; lane[1] < count; lane[1]++) {
            for (lane[2] = lane[1] + 1; lane[2] < count; lane[2]++) {
                for (lane[3] = lane[2] + 1; lane[3] < count; lane[3]++) {
                    double matrix[3][BAND_COUNT] = {{0}};
                    double added_matrix[3][BAND_COUNT] = {{0}};
                    const double left = try_choice(fit, &sums, lane, matrix);
                    const double added_left = try_choice(added, &added_sums, lane, added_matrix);
                    if (left + added_left < best) {
                        best = left + added_left;
                        out->rms_error = sqrt(left);
                        added_out->rms_error = sqrt(added_left);
                        memcpy(out->lane, lane, sizeof lane);
                        copy_matrix(matrix, out->rgb_from_bands);
                        copy_matrix(added_matrix, added_out->rgb_from_bands);
                    }
                }
            }
        }
    }
    const bool is_good = sums.spectra > 0 && best < HUGE_VAL;
    if (is_good && added_sums.spectra > 0) {
        derive_bands(added, &added_sums, out->lane, added_out);
    }
    return is_good ? best : HUGE_VAL;
}

void band_fit_choose_both(const struct band_fit *fit, const struct band_fit *added,
                          struct bands *out, struct added_bands *added_out)
{
    *out = (struct bands){.rms_error = INFINITY};
    *added_out = (struct added_bands){0};
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < fit->optics->wavelength_count; i++) {
            out->xyz_from_lanes[k][i] = (float)fit->xyz_from_lanes[k][i];
        }
    }
    if (search_choices(fit, added, out, added_out) < HUGE_VAL) {
        derive_albedo(out);
    } else {
        choose_few(fit, out);
        out->rms_error = INFINITY;
        memcpy(added_out->rgb_from_bands, out->rgb_from_bands, sizeof out->rgb_from_bands);
    }
    for (int r = 0; r < BAND_COUNT; r++) {
        out->nm[r] = fit->optics->wavelength_nm[out->lane[r]];
    }
}

void band_fit_choose(const struct band_fit *fit, struct bands *out)
{
    struct band_fit none = {.optics = fit->optics};
    struct added_bands unused;
    band_fit_choose_both(fit, &none, out, &unused);
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
