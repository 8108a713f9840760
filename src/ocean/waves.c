// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/waves.h"

#include "ocean/sea.h"
#include "ocean/spectrum.h"

#include <math.h>

// Of the spectrum: from where nothing is, to waves that only a glance at one's feet resolves.
static const double LONGEST_OF_PEAK = 0.55, SHORTEST_OF_PEAK = 3, SHORTEST_M = 0.12;
// Compression along any course where all crests meet, at most: 1 would be a cusp.
static const double MOST_COMPRESSION = 0.98;

// Down to waves a ninth as fast as the peak crests have foam of their own; shorter ones only make
// its edges ragged: wavenumber over the peak's, by how patches of foam look.
static const double BREAKING_OF_PEAK = 80;

// Of the numbers that directions are drawn from.
static const uint32_t DIRECTIONS = 0x5bd1e995;

// Where the laws of growth have been measured, about, and how much more than the spectrum's the
// steepness of a short sea may be.
static const double LEAST_FETCH_M = 100, MOST_STEEPER = 3;

enum { STEPS = 4096 };

// Along the ground and up; at a pole, east is that of longitude 0.
struct axes {
    struct vec3 east, north, up;
};

static struct axes find_axes(struct vec3 place)
{
    struct axes a = {.up = vec3_normalize(place)};
    const double longitude = atan2(place.y, place.x);
    a.east = (struct vec3){-sin(longitude), cos(longitude), 0};
    a.north = vec3_cross(a.up, a.east);
    return a;
}

// A number of [0, 1) for each pair: the finaliser of MurmurHash3 (Appleby 2011), twice.
static double draw_number(uint32_t seed, uint32_t index)
{
    uint32_t h = seed * 0x9e3779b9u + 0x7f4a7c15u;
    for (int i = 0; i < 2; i++) {
        h ^= index * 0xd1b54a33u;
        h = (h ^ (h >> 16)) * 0x85ebca6bu;
        h = (h ^ (h >> 13)) * 0xc2b2ae35u;
        h ^= h >> 16;
    }
    return h / 4294967296.0;
}

// Sums of the spectrum from its long end: variances of height and slope.
struct sums {
    double height_m2[STEPS + 1], slope[STEPS + 1];
};

static void sum_spectrum(const struct wave_spectrum *s, struct sums *out)
{
    const double low = LONGEST_OF_PEAK * s->peak_per_s;
    const double high =
        fmax(SHORTEST_OF_PEAK * s->peak_per_s, sqrt(2 * M_PI / SHORTEST_M * s->gravity_m_s2));
    const double step = log(high / low) / STEPS;
    out->height_m2[0] = out->slope[0] = 0;
    for (int i = 0; i < STEPS; i++) {
        const double omega = low * exp((i + 0.5) * step);
        const double k = wave_number_per_m(omega, s->gravity_m_s2);
        const double variance = wave_spectrum_at(s, omega) * omega * step;
        out->height_m2[i + 1] = out->height_m2[i] + variance;
        out->slope[i + 1] = out->slope[i] + variance * k * k;
    }
}

// Of the waves, what is drawn evenly over the variance of slopes, the rest over that of heights.
// Slopes are what glints show, over ten times as many octaves.
static const double BY_SLOPE = 0.7;

// The step at which shares of the variances of height and slope reach it.
static int find_step(const struct sums *sums, double part)
{
    int low = 0, high = STEPS;
    while (low < high) {
        const int middle = (low + high) / 2;
        const double here = (1 - BY_SLOPE) * sums->height_m2[middle] / sums->height_m2[STEPS] +
                            BY_SLOPE * sums->slope[middle] / sums->slope[STEPS];
        low = here < part ? middle + 1 : low;
        high = here < part ? high : middle;
    }
    return low;
}

// A part of all directions, with one of every eighth in eight neighbours, in an order drawn for
// each eight. In one order for all, like that of the golden section, neighbours always cross at
// about one angle, and the glint of short waves looks woven; drawn one by one, some seeds streak.
static double draw_direction(uint32_t seed, uint32_t index)
{
    const uint32_t eight = UINT32_MAX - index / 8;
    const uint32_t first = (uint32_t)(8 * draw_number(seed, eight));
    const uint32_t stride = 1 + 2 * (uint32_t)(4 * draw_number(~seed, eight)); // odd: meets all
    return ((first + stride * (index % 8)) % 8 + draw_number(seed, index)) / 8;
}

// Components take equal shares, with borders moved a little so that no beat repeats. Each keeps the
// variance of height and of slope of its share.
static void draw_components(struct waves *waves, const struct wave_spectrum *s,
                            const struct ocean_desc *ocean, const struct sums *sums)
{
    const uint32_t wanted = waves->count;
    int from = 0;
    waves->count = 0;
    for (uint32_t i = 0; i < wanted; i++) {
        const double jitter = i + 1 < wanted ? 0.6 * (draw_number(waves->seed, i) - 0.5) : 0;
        const int to = i + 1 < wanted ? find_step(sums, (i + 1 + jitter) / wanted) : STEPS;
        const double height = sums->height_m2[to] - sums->height_m2[from];
        const double slope = sums->slope[to] - sums->slope[from];
        from = to;
        if (!(height > 0)) {
            continue;
        }
        const double k = sqrt(slope / height);
        const double omega = sqrt(s->gravity_m_s2 * k);
        const double part = draw_direction(waves->seed ^ DIRECTIONS, i);
        const double turn = wave_spread_quantile(wave_spread_exponent(s, omega), part);
        waves->components[waves->count++] = (struct wave_component){
            sqrt(2 * height), k, omega, ocean->waves.wind_from_rad + M_PI + turn};
    }
}

static double square_of(const struct wave_component *c)
{
    return 0.5 * pow(c->amplitude_m * c->wavenumber_per_m, 2);
}

static void finish_sums(struct waves *waves, double total_square)
{
    double square = 0;
    uint32_t kept = 0;
    for (; kept < waves->count; kept++) {
        const struct wave_component *c = &waves->components[kept];
        if (square + square_of(c) > total_square) {
            break;
        }
        square += square_of(c);
    }
    waves->count = kept;
    waves->mean_square_slope = square;
    waves->rest_square = total_square - square;
}

trl_result waves_init(const struct waves_desc *desc, struct waves *out)
{
    const struct ocean_waves *waves = &desc->ocean->waves;
    *out = (struct waves){.ctx = desc->ctx,
                          .radius_m = desc->radius_m,
                          .wind = *waves,
                          .gravity_m_s2 = desc->ocean->gravity_m_s2,
                          .seed = waves->seed,
                          .count = waves->wind_m_s > 0 ? waves->count : 0};
    out->components = mem_alloc(desc->ctx, waves->count, sizeof *out->components);
    struct sums *sums = mem_alloc(desc->ctx, 1, sizeof *sums);
    trl_result result = out->components && sums ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK && out->count > 0) {
        const struct wave_spectrum s = wave_spectrum_make(waves, desc->ocean->gravity_m_s2);
        sum_spectrum(&s, sums);
        draw_components(out, &s, desc->ocean, sums);
        out->breaking_per_m =
            BREAKING_OF_PEAK * wave_number_per_m(s.peak_per_s, desc->ocean->gravity_m_s2);
    }
    mem_free(desc->ctx, sums);
    if (result != TRL_OK) {
        waves_finish(out);
        return result;
    }
    finish_sums(out, fmax(desc->total_square, 0));
    out->surf = sea_surf_find(waves, waves_significant_height_m(out));
    return TRL_OK;
}

void waves_finish(struct waves *waves)
{
    if (waves->ctx) {
        mem_free(waves->ctx, waves->components);
    }
    *waves = (struct waves){0};
}

double waves_significant_height_m(const struct waves *waves)
{
    double variance = 0;
    for (uint32_t i = 0; i < waves->count; i++) {
        variance += 0.5 * waves->components[i].amplitude_m * waves->components[i].amplitude_m;
    }
    return 4 * sqrt(variance);
}

// Cells: the places nearest to each of these, about 12 degrees apart, and how wide borders are.
enum { CELLS = 256 };
static const double BORDER_RAD = 0.03;

// The lattice of Fibonacci on the sphere.
static struct vec3 cell_place(uint32_t cell)
{
    const double z = 1 - (2 * cell + 1.0) / CELLS;
    const double turn = 2 * M_PI * fmod(cell * 0.6180339887498949, 1);
    const double flat = sqrt(1 - z * z);
    return (struct vec3){flat * cos(turn), flat * sin(turn), z};
}

struct cell {
    uint32_t index;
    double distance_rad, share;
};

// Insertion into a list of the nearest.
static void note_cell(struct cell cells[WAVES_MAX_CELLS], struct cell found)
{
    for (int i = 0; i < WAVES_MAX_CELLS; i++) {
        if (found.distance_rad < cells[i].distance_rad) {
            const struct cell farther = cells[i];
            cells[i] = found;
            found = farther;
        }
    }
}

// Those with a share in the energy, nearest first; how many.
static int find_cells(struct vec3 up, struct cell cells[WAVES_MAX_CELLS])
{
    for (int i = 0; i < WAVES_MAX_CELLS; i++) {
        cells[i] = (struct cell){0, HUGE_VAL, 0};
    }
    for (uint32_t i = 0; i < CELLS; i++) {
        const struct vec3 p = cell_place(i);
        const double angle = atan2(vec3_length(vec3_cross(up, p)), vec3_dot(up, p));
        note_cell(cells, (struct cell){i, angle, 0});
    }
    int count = 0;
    double sum = 0;
    for (; count < WAVES_MAX_CELLS; count++) {
        const double left = 1 - (cells[count].distance_rad - cells[0].distance_rad) / BORDER_RAD;
        if (left <= 0) {
            break;
        }
        cells[count].share = left * left * (3 - 2 * left);
        sum += cells[count].share;
    }
    for (int i = 0; i < count; i++) {
        cells[i].share /= sum;
    }
    return count;
}

// A quarter of the circumference behind a cell's middle.
static struct vec3 find_origin(uint32_t cell, double bearing_rad)
{
    const struct axes middle = find_axes(cell_place(cell));
    return vec3_add(vec3_scale(middle.north, -cos(bearing_rad)),
                    vec3_scale(middle.east, -sin(bearing_rad)));
}

struct eye {
    struct axes axes;
    double time_s;
    double parts[OCEAN_MAX_WAVES]; // of each component's amplitude
};

// Of components that a fetch leaves, as parts of their amplitude, and of the height of all. The
// variance of each is as much less as the spectrum of that fetch is below the scene's. Where it is
// above, short seas are steep about their peak, but what is shorter is saturated in every sea
// (Phillips 1958, J. Fluid Mech. 4): more of it by the inverse square of the frequency, and so much
// that all together has the variance of that fetch.
static double find_parts(const struct waves *waves, double fetch_m, double *parts)
{
    for (uint32_t i = 0; i < waves->count; i++) {
        parts[i] = 1;
    }
    if (waves->count == 0 || !(fetch_m < waves->wind.fetch_m)) {
        return 1;
    }
    struct ocean_waves near = waves->wind;
    near.spectrum = OCEAN_JONSWAP;
    near.fetch_m = fmax(fetch_m, LEAST_FETCH_M);
    const struct wave_spectrum whole = wave_spectrum_make(&waves->wind, waves->gravity_m_s2);
    const struct wave_spectrum part = wave_spectrum_make(&near, waves->gravity_m_s2);
    double all = 0, kept = 0, steeper = 0, more[OCEAN_MAX_WAVES];
    for (uint32_t i = 0; i < waves->count; i++) {
        const struct wave_component *c = &waves->components[i];
        const double ratio = wave_spectrum_at(&part, c->omega_per_s) /
                             fmax(wave_spectrum_at(&whole, c->omega_per_s), 1e-300);
        const double over = fmax(c->omega_per_s / part.peak_per_s, 1);
        const double variance = 0.5 * c->amplitude_m * c->amplitude_m;
        parts[i] = fmin(ratio, 1);
        more[i] = fmax(ratio - 1, 0) / (over * over);
        all += variance;
        kept += variance * parts[i];
        steeper += variance * more[i];
    }
    const double wanted =
        all * wave_spectrum_variance_m2(&part) / wave_spectrum_variance_m2(&whole);
    const double scale = steeper > 0 ? fmin(fmax((wanted - kept) / steeper, 0), MOST_STEEPER) : 0;
    for (uint32_t i = 0; i < waves->count; i++) {
        parts[i] = sqrt(parts[i] + scale * more[i]);
    }
    return sqrt((kept + scale * steeper) / all);
}

static void put_wave(const struct waves *waves, const struct eye *eye, const struct cell *cell,
                     uint32_t component, struct waves_view *out)
{
    const struct wave_component *c = &waves->components[component];
    const struct vec3 origin = find_origin(cell->index, c->bearing_rad);
    const struct vec3 o = {vec3_dot(eye->axes.east, origin), vec3_dot(eye->axes.north, origin),
                           vec3_dot(eye->axes.up, origin)};
    const double way_m = waves->radius_m * atan2(hypot(o.x, o.y), o.z);
    const double begun =
        2 * M_PI * draw_number(waves->seed ^ (cell->index + 1) * 0x85ebca6bu, component);
    const double turned = fmod(c->omega_per_s * eye->time_s, 2 * M_PI);
    const double phase = fmod(c->wavenumber_per_m * way_m, 2 * M_PI) - turned + begun;
    const double values[WAVES_FIELDS] = {o.x,
                                         o.y,
                                         o.z,
                                         c->amplitude_m * eye->parts[component] * sqrt(cell->share),
                                         c->wavenumber_per_m,
                                         remainder(phase, 2 * M_PI),
                                         0};
    const uint32_t group = out->count / WAVES_LANES, lane = out->count % WAVES_LANES;
    for (int i = 0; i < WAVES_FIELDS; i++) {
        out->texels[group][i][lane] = (float)values[i];
    }
    out->count++;
}

// Q: with B = most I - C, C = sum Q A k d d^T the compression where all crests meet, and p = A k,
// the next wave takes its largest eigenvalue to the most that is allowed when det(B - Q p d d^T) =
// 0, which is Q p d^T B^-1 d = 1. Any other phases make less of it in every direction.
static void steepen(struct waves_view *view)
{
    double xx = MOST_COMPRESSION, xy = 0, yy = MOST_COMPRESSION; // B
    double steepness = 1;
    for (uint32_t i = 0; i < view->count; i++) {
        const GerstnerWave w = waves_view_get(view, i);
        const double away = hypot(w.x, w.y), press = w.amplitude * w.wavenumber;
        const double dx = away > 0 ? -w.x / away : 1, dy = away > 0 ? -w.y / away : 0;
        const double along = yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy; // d^T adj(B) d
        const double room = press * along > 0 ? (xx * yy - xy * xy) / (press * along) : 0;
        steepness = steepness < 1 ? 0 : fmin(fmax(room, 0), 1);
        xx -= steepness * press * dx * dx;
        xy -= steepness * press * dx * dy;
        yy -= steepness * press * dy * dy;
        view->texels[i / WAVES_LANES][6][i % WAVES_LANES] = (float)steepness;
    }
}

void waves_view_make(const struct waves *waves, struct vec3 place, double time_s,
                     struct waves_view *out)
{
    waves_view_make_within(waves, &(struct waves_eye){place, time_s, HUGE_VAL}, out);
}

void waves_view_make_within(const struct waves *waves, const struct waves_eye *at,
                            struct waves_view *out)
{
    struct eye eye = {.axes = find_axes(at->place), .time_s = at->time_s};
    out->height_part = find_parts(waves, at->fetch_m, eye.parts);
    struct cell cells[WAVES_MAX_CELLS];
    const int count = find_cells(eye.axes.up, cells);
    out->count = 0;
    for (uint32_t w = 0; w < waves->count; w++) {
        for (int i = 0; i < count; i++) {
            put_wave(waves, &eye, &cells[i], w, out);
        }
    }
    steepen(out);
    out->groups = (out->count + WAVES_LANES - 1) / WAVES_LANES;
    for (uint32_t i = out->count; i < out->groups * WAVES_LANES; i++) {
        for (int f = 0; f < WAVES_FIELDS; f++) {
            // As the last one, without its height.
            out->texels[i / WAVES_LANES][f][i % WAVES_LANES] =
                f == 3 ? 0 : out->texels[(i - 1) / WAVES_LANES][f][(i - 1) % WAVES_LANES];
        }
    }
}

struct waves_stand waves_stand_find(const struct waves_view *view, double radius_m, double side_m,
                                    double part)
{
    // By Newton's method, which converges since no crest is a loop.
    enum { ROUNDS = 6 };
    struct waves_stand stand = {0, 0, 0};
    for (int round = 0; round < ROUNDS; round++) {
        const GerstnerPlace p = gerstner_place(stand.east_m, stand.north_m, radius_m);
        GerstnerSum sum = gerstner_level();
        for (uint32_t i = 0; i < view->count; i++) {
            const GerstnerWave w = waves_view_get(view, i);
            const Angle angle = gerstner_small_angle(gerstner_turn(w, p));
            const double weight = part * gerstner_weight(w.wavenumber * side_m, 0);
            sum = gerstner_add(sum, w, gerstner_ripple(w, p, radius_m, angle), weight);
        }
        const double east = stand.east_m + sum.x, north = stand.north_m + sum.y;
        const double det = gerstner_jacobian(sum, 1);
        stand.east_m -= ((1 - sum.yy) * east + sum.xy * north) / det;
        stand.north_m -= ((1 - sum.xx) * north + sum.xy * east) / det;
        stand.height_m = sum.z;
    }
    return stand;
}

void waves_local_from_planet(struct vec3 place, float matrix[9])
{
    const struct axes axes = find_axes(place);
    const struct vec3 rows[3] = {axes.east, axes.north, axes.up};
    for (int i = 0; i < 3; i++) {
        matrix[i] = (float)rows[i].x;
        matrix[3 + i] = (float)rows[i].y;
        matrix[6 + i] = (float)rows[i].z;
    }
}

GerstnerWave waves_view_get(const struct waves_view *view, uint32_t index)
{
    double v[WAVES_FIELDS];
    for (int i = 0; i < WAVES_FIELDS; i++) {
        v[i] = (double)view->texels[index / WAVES_LANES][i][index % WAVES_LANES];
    }
    return (GerstnerWave){v[0], v[1], v[2], v[3], v[4], v[5], v[6]};
}
