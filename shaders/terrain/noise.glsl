// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Relief made of noise, where it is the ground itself and where it is below the resolution of data.
// The C side is src/terrain/noise.c; formulas are in shared/relief.glsl. Places are offsets from
// the anchor's point of the reference sphere, local axes, m.
#include "shared/relief.glsl"
#include "shared/spline.glsl"

// The map: height in m, amplitude of the first octave in m, how ridged, climate.
uniform highp sampler2D u_noise_map;
// The anchor's column and row, as whole numbers and rests; texels to a radian, both ways.
uniform ivec4 u_noise_map_base;
uniform vec4 u_noise_map_place;
// Of each octave: the anchor from the whole lattice point, 1 / wavelength in m; that point; log2 of
// the wavelength in m, size relative to that of mountains, variance of its slopes and of
// those below, of its heights and those below.
uniform vec4 u_noise_place[24];
uniform ivec4 u_noise_base[24];
uniform vec4 u_noise_size[24];
uniform vec4 u_noise_lattice[9]; // lattice axes, local, three for each third octave
uniform ivec4 u_noise_ends; // octaves of noise, of gullies after them, of noise after those; the
                            // first that rock has
uniform vec4 u_noise_form;  // contrast, strength of gullies, altitude of full roughness, sea level
uniform vec4 u_noise_more;  // roughness on level ground; log2 of the map's texel in m; floor

struct NoiseGround {
    vec4 map;    // height, amplitude, ridged, climate
    vec2 slope;  // of the height to the east and the north
    vec2 spread; // of the amplitude
};

// Smooth between texels.
NoiseGround noise_ground_at(vec2 geo, float cos_latitude, int level)
{
    ivec2 whole = textureSize(u_noise_map, 0);
    ivec2 size = max(whole >> level, ivec2(1));
    float texels = exp2(float(level));
    ivec2 base = u_noise_map_base.xy >> level;
    vec2 rest = vec2(u_noise_map_base.xy - (base << level));
    vec2 moved = u_noise_map_place.xy + vec2(geo.x, -geo.y) * u_noise_map_place.zw;
    vec2 at = (rest + moved + 0.5) / texels - 0.5;
    vec2 middle = floor(at + 0.5);
    vec2 f = at - middle;
    ivec2 first = base + ivec2(middle) - 1;
    first.x -= first.x >= size.x ? size.x : 0;
    first.x += first.x < 0 ? size.x : 0;
    vec4 rows[3];
    vec2 slopes[3];
    for (int j = 0; j < 3; j++) {
        int y = first.y + j;
        bool is_over = y < 0 || y >= size.y; // a pole: down the opposite meridian
        int x = first.x + (is_over ? size.x / 2 : 0);
        x -= x >= size.x ? size.x : 0;
        y = y < 0 ? -1 - y : y >= size.y ? 2 * size.y - 1 - y : y;
        int next = x + 1 < size.x ? x + 1 : x + 1 - size.x;
        int last = next + 1 < size.x ? next + 1 : next + 1 - size.x;
        vec4 a = texelFetch(u_noise_map, ivec2(x, y), level);
        vec4 b = texelFetch(u_noise_map, ivec2(next, y), level);
        vec4 c = texelFetch(u_noise_map, ivec2(last, y), level);
        for (int k = 0; k < 4; k++) {
            rows[j][k] = spline_blend(f.x, a[k], b[k], c[k]);
        }
        slopes[j] = vec2(spline_slope(f.x, a.x, b.x, c.x), spline_slope(f.x, a.y, b.y, c.y));
    }
    NoiseGround g;
    for (int k = 0; k < 4; k++) {
        g.map[k] = spline_blend(f.y, rows[0][k], rows[1][k], rows[2][k]);
    }
    vec2 east;
    vec2 south;
    for (int k = 0; k < 2; k++) {
        east[k] = spline_blend(f.y, slopes[0][k], slopes[1][k], slopes[2][k]);
        south[k] = spline_slope(f.y, rows[0][k], rows[1][k], rows[2][k]);
    }
    vec2 per_metre = u_noise_map_place.zw / (texels * u_anchor.w);
    east *= per_metre.x / max(cos_latitude, 1e-4);
    south *= per_metre.y;
    g.slope = vec2(east.x, -south.x);
    g.spread = vec2(east.y, -south.y);
    return g;
}

// `log2_footprint` must be one for 2 x 2 pixels: llvmpipe fetches one level for all of them.
NoiseGround noise_ground(vec2 geo, float cos_latitude, float log2_footprint)
{
    float lod = max(log2_footprint - u_noise_more.y, 0.0);
    int level = int(lod);
    float part = lod - float(level);
    NoiseGround g = NoiseGround(vec4(0.0), vec2(0.0), vec2(0.0));
    // A loop, which ends where the next level is not wanted: a branch would fetch it anyway.
    int k = 0;
    do {
        NoiseGround h = noise_ground_at(geo, cos_latitude, level + k);
        float weight = k == 0 ? 1.0 - part : part;
        g.map += weight * h.map;
        g.slope += weight * h.slope;
        g.spread += weight * h.spread;
        k++;
    } while (k < 2 && part > 0.0);
    return g;
}

// Lattice axes from local ones, times a vector; and back.
vec3 noise_turn(int i, vec3 v)
{
    int row = 3 * (i % 3);
    return vec3(dot(u_noise_lattice[row].xyz, v), dot(u_noise_lattice[row + 1].xyz, v),
                dot(u_noise_lattice[row + 2].xyz, v));
}

vec3 noise_turn_back(int i, vec3 v)
{
    int row = 3 * (i % 3);
    return u_noise_lattice[row].xyz * v.x + u_noise_lattice[row + 1].xyz * v.y +
           u_noise_lattice[row + 2].xyz * v.z;
}

NoisePlace noise_place(int i, vec3 lattice)
{
    vec3 p = lattice * u_noise_place[i].w + u_noise_place[i].xyz;
    return NoisePlace(p.x, p.y, p.z, uint(u_noise_base[i].x), uint(u_noise_base[i].y),
                      uint(u_noise_base[i].z));
}

// With its gradient along local axes, per m.
NoiseValue noise_local(NoiseValue n, int i)
{
    vec3 g = noise_turn_back(i, vec3(n.x, n.y, n.z)) * u_noise_place[i].w;
    return NoiseValue(n.value, g.x, g.y, g.z);
}

// What octaves see: log2 of the footprint and of the data's texel, between layers and for each;
// amplitude in m; how ridged; climate, -1 dry to 1 wet.
struct NoiseView {
    float footprint, texel;
    ReliefData data;
    float amplitude, ridged, climate;
};

float pow2(float x)
{
    return x * x;
}

// Of the whole octave, without soil; what is seen of it is apart.
float noise_size(int i, NoiseView view)
{
    return view.amplitude * u_noise_size[i].y * relief_lacking_of(u_noise_size[i].x, view.data);
}

// The part of an octave that soil has.
float noise_soil(int i, NoiseView view)
{
    return relief_soil(view.amplitude) * relief_lacking_of(u_noise_size[i].x, view.data);
}

// Also where there is nothing to see: on the sea, and on the floor of oceans. Where masks have
// shores detail moves those, which ends nowhere but on the sea: where ground rises through its
// level relief has no height, but shores go on.
#ifdef HAS_GROUND
const float NOISE_LEAST_M = 1e-3;
#else
const float NOISE_LEAST_M = 1e-8;
#endif
bool noise_is_over(int i, int end, NoiseView view)
{
    return i >= end || u_noise_size[i].x - view.footprint < 1.0 || view.amplitude < NOISE_LEAST_M;
}

// Variance of the heights below a texel, of an amplitude of 1.
float noise_variance_below(float texel)
{
    int first = clamp(int(ceil(u_noise_size[0].x - texel - 1.5)), 0, u_noise_ends.z - 1);
    return RELIEF_HEIGHT2 * u_noise_size[first].w;
}

// Of the heights that all octaves together add to data, m^2.
float noise_height_variance(NoiseView view)
{
    return pow2(view.amplitude) * mix(noise_variance_below(view.data.below),
                                      noise_variance_below(view.data.top), view.data.part);
}

// What is not seen of an octave, which made the height out of `before`, counts by its variances.
Relief noise_hide(Relief r, int i, float size, float rough, float before, NoiseView view)
{
    float seen = pow2(relief_seen(u_noise_size[i].x, view.footprint));
    float stands = u_noise_size[i].x > RELIEF_STAND_LOG2 ? 1.0 - seen : 0.0;
    r.unseen += RELIEF_SLOPE2 * pow2(rough * u_noise_place[i].w) * stands;
    // Of a wave that is seen, its mean over a square keeps sinc^4: heights differ within a pixel.
    float within = 6.6 * pow2(exp2(view.footprint) * u_noise_place[i].w);
    float kept = max(1.0 - within, 0.0);
    r.unseen_height2 += RELIEF_HEIGHT2 * size * size * (1.0 - seen * kept);
    r.passing += (r.height - before) * (1.0 - sqrt(kept));
    return r;
}

#ifdef HAS_ROCK
#include "terrain/stones.glsl"

// What rock is seen from, and what its octaves sum up to: gradient times size, and a tone.
struct Rock {
    vec3 ray;         // unit
    float log2_pixel; // of a pixel's width there, m
    float part;
    NoiseValue sum;
};

Rock rock;

// log2 of the footprint on ground of a slope: a cliff at the height of the eye is seen from the
// front. It is longer than wide, and the middle of both is taken.
float rock_footprint(vec3 up, vec3 slope)
{
    float slant = max(abs(dot(rock.ray, normalize(up - slope))), 0.02);
    return rock.log2_pixel - 0.5 * log2(slant);
}

void rock_begin(float slope)
{
    rock.part = relief_rock(slope);
    rock.sum = NoiseValue(0.0, 0.0, 0.0, 0.0);
}

void rock_add(int i, NoiseValue n, NoiseView view)
{
    float wave = u_noise_size[i].x;
    float seen = rock.part * relief_seen(wave, view.footprint);
    float size =
        seen * relief_rock_size(noise_size(i, view), wave) * relief_lacking_of(wave, view.data);
    rock.sum.value += seen * relief_tone(wave) * n.value;
    rock.sum.x += size * n.x;
    rock.sum.y += size * n.y;
    rock.sum.z += size * n.z;
}
#endif

// An octave of noise on top of `r`: `level` of its size.
Relief noise_add(Relief r, NoiseValue n, int i, float level, NoiseView view)
{
    float wave = u_noise_size[i].x;
    float soil = noise_soil(i, view);
    float size = noise_size(i, view) * level;
    float rough = relief_soil_size(size, wave, soil);
    float seen = relief_seen(wave, view.footprint);
    float before = r.height;
#ifdef HAS_ROCK
    if (wave < RELIEF_STONE_LOG2) {
        stones_add(n, wave, view.footprint, r.past, soil);
    }
#endif
    r = relief_add(r, relief_fold(n, view.ridged), size * seen, rough * seen, u_noise_form.x);
    float value = size > 0.0 ? seen * n.value : 0.0;
    r.tone += value * relief_tone(wave);
    r.shore += value / u_noise_place[i].w;
    r = noise_hide(r, i, size, rough, before, view);
    if (wave > RELIEF_STAND_LOG2) {
        r = relief_stand(r);
    }
    return r;
}

// One of stripes, which run down what is steep.
Relief noise_cut(Relief r, vec3 at, vec3 up, int i, NoiseView view)
{
    vec3 s = vec3(r.fall_x, r.fall_y, r.fall_z);
    s -= up * dot(s, up);
    float slope2 = dot(s, s);
    vec3 along = cross(up, s) * inversesqrt(slope2 + 1e-12);
    vec3 d = noise_turn(i, along);
    NoiseValue n = noise_local(noise_stripes(noise_place(i, noise_turn(i, at)), d.x, d.y, d.z), i);
    float size = noise_size(i, view) * u_noise_form.y * relief_cutting(slope2);
    float seen = relief_seen(u_noise_size[i].x, view.footprint);
    float before = r.height;
    r = relief_cut(r, n, size * seen);
    return noise_hide(r, i, size, size, before, view);
}

// The relief that is made on top of `r`. `up` is unit.
Relief noise_relief(Relief r, vec3 at, vec3 up, NoiseView view)
{
#ifdef HAS_ROCK
    const int parts = 3; // in the same loop: another would take as long again to compile
#else
    const int parts = 2;
#endif
    int i = 0;
    int end = 0;
#ifdef HAS_ROCK
    stones_begin(up, view.climate);
#endif
    int part = 0;
    do {
        vec3 left = vec3(r.fall_x, r.fall_y, r.fall_z);
        left -= up * dot(left, up);
        r.cutting = relief_cutting(dot(left, left));
        int last = part == 0 ? u_noise_ends.x : u_noise_ends.z;
#ifdef HAS_ROCK
        view.footprint = rock_footprint(up, left);
        if (part == 2) {
            rock_begin(length(left));
            at += r.height * up;
            i = u_noise_ends.w;
            last = rock.part > 0.0 ? last : 0;
        }
#endif
        bool goes_on = !noise_is_over(i, last, view);
        do {
            if (goes_on) {
                NoiseValue n = noise_local(noise_simplex(noise_place(i, noise_turn(i, at))), i);
#ifdef HAS_ROCK
                if (part == 2) {
                    rock_add(i, n, view);
                } else
#endif
                {
                    float level = part == 0 ? 1.0 : mix(u_noise_more.x, 1.0, r.cutting);
                    r = noise_add(r, n, i, level, view);
                }
                i++;
                goes_on = !noise_is_over(i, last, view);
            }
        } while (goes_on);
        end = part == 2 ? end : i;
        goes_on = part == 0 && !noise_is_over(i, u_noise_ends.y, view);
        do {
            if (goes_on) {
                r = noise_cut(r, at, up, i, view);
                i++;
                goes_on = !noise_is_over(i, u_noise_ends.y, view);
            }
        } while (goes_on);
        if (part == 0 && i > end) {
            r = relief_stand(r);
        }
        part++;
    } while (part < parts);
    float below = pow2(view.amplitude) * (end < u_noise_ends.z ? 1.0 : 0.0);
    int next = min(end, u_noise_ends.z - 1);
    r.unseen += RELIEF_SLOPE2 * below * u_noise_size[next].z;
    r.unseen_height2 += RELIEF_HEIGHT2 * below * u_noise_size[next].w;
    return r;
}

// The ground without octaves as data and map together say it. Without data the texel is the map's.
struct NoiseBase {
    float height;
    vec3 slope; // local axes
    vec3 spread;
    NoiseView view;
};

// Everything: `base` with octaves, before water.
Relief noise_compose(NoiseBase base, vec3 at, vec3 up)
{
    float amplitude = base.view.amplitude;
    base.view.amplitude *= relief_fullness(base.height + u_datum, u_noise_form.z);
    Relief r = relief_of(base.height, base.slope.x, base.slope.y, base.slope.z);
    r = noise_relief(r, at, up, base.view);
    vec3 spread = base.spread * ((r.height - base.height) / max(amplitude, 1e-6));
    return relief_lean(r, spread.x, spread.y, spread.z);
}
