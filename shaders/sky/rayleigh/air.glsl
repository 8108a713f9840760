// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Light scattered once, by SAMPLES points on each line of sight at WAVELENGTHS wavelengths
// (Santana 2017). With FIT_HEIGHTS columns come from polynomials, else from a texture. With SIMPLE
// nothing is lost on the way. The same steps as src/scatter/rayleigh.c.
#ifndef SKY_RAYLEIGH_AIR_GLSL
#define SKY_RAYLEIGH_AIR_GLSL

#include "shared/phase.glsl"
#include "shared/rayleigh.glsl"
#include "sky/ray.glsl"

uniform vec4 u_air; // ground radius, height, scale height, softness of the map
uniform vec4
    u_spectrum[WAVELENGTHS];        // colour of the star's light, in all cd m^-2 of a radiance of 1
                                    // per unit irradiance; w: extinction, per m
uniform vec4 u_matter[WAVELENGTHS]; // scattering, per m; albedo of the bare sphere
#ifdef FIT_HEIGHTS
uniform vec4 u_fit[2 * FIT_HEIGHTS]; // c0 to c3, c4 to c7 of each height
#else
uniform sampler2D u_columns;  // the inverse air mass as a sum of two
uniform vec2 u_columns_texel; // 1 over its width and height
#endif

RayleighAir get_air()
{
    return RayleighAir(u_air.x, u_air.y, u_air.z, u_air.w);
}

#ifdef FIT_HEIGHTS
float fit_at(int height, float x)
{
    vec4 low = u_fit[2 * height];
    vec4 high = u_fit[2 * height + 1];
    return rayleigh_fit_value(
        RayleighFit(low.x, low.y, low.z, low.w, high.x, high.y, high.z, high.w), x);
}
#endif

// Column of a line that comes from above at an angle with this cosine.
float read_column(float cosine, float altitude)
{
    float x = rayleigh_map_x(min(cosine, 1.0), u_air.w);
    float y = rayleigh_map_y(altitude, u_air.y);
#ifdef FIT_HEIGHTS
    float at = y * float(FIT_HEIGHTS - 1);
    int low = int(min(at, float(FIT_HEIGHTS - 2)));
    float inverse = mix(fit_at(low, x), fit_at(low + 1, x), at - float(low));
#else
    vec2 at = vec2(x, y);
    vec2 parts = textureLod(u_columns, at + (0.5 - at) * u_columns_texel, 0.0).xy;
    float inverse = parts.x + parts.y;
#endif
    return rayleigh_column(get_air(), altitude, inverse);
}

// g of the star's light at a point: `height` of it above the terminator's plane.
float star_column(float altitude, float height)
{
    RayleighAir air = get_air();
    float excess = rayleigh_excess(air, altitude);
    float closest = max(rayleigh_closest(air, excess, height), 0.0);
    float mirrored = read_column(abs(height) / (u_air.x + altitude), altitude);
    return height < 0.0 ? rayleigh_beyond(read_column(0.0, closest), mirrored) : mirrored;
}

// A point of the line of sight at X.
struct Point {
    float x;
    float view_m; // g of the line of sight
    float star_m; // g of the star's light
    float density;
};

struct Sight {
    RayleighLine line;
    float closest_m; // g of the line at its closest point
    float closest_density;
    Point eye; // where the line begins
};

Point find_point(Sight sight, float x)
{
    RayleighAir air = get_air();
    float altitude = rayleigh_altitude(air, sight.line.excess + x * x);
    float mirrored = read_column(abs(x) / (u_air.x + altitude), altitude);
    Point point;
    point.x = x;
    point.view_m = x > 0.0 ? rayleigh_beyond(sight.closest_m, mirrored) : mirrored;
    point.star_m = star_column(altitude, x * sight.line.nu + sight.line.sun_distance);
    point.density = rayleigh_density(air, altitude);
    return point;
}

float find_between(Sight sight, Point a, Point b)
{
    float thin = min(a.density, b.density);
    float thick = a.x < 0.0 && b.x > 0.0 ? sight.closest_density : max(a.density, b.density);
    return rayleigh_between(b.view_m - a.view_m, b.x - a.x, thin, thick);
}

// The line of a ray from the eye, or from where it enters the air, that ends `way` farther on.
Sight make_sight(Ray ray, float way)
{
    RayleighAir air = get_air();
    bool outside = u_eye.w > 0.5;
    float eye_x = u_eye.x * ray.mu;
    float begin = outside ? -ray.chord_m : eye_x;
    float beginning = outside ? u_air.y : u_eye.y; // altitude
    Sight sight;
    sight.line.begin = begin;
    sight.line.end = begin + max(way, 0.0);
    sight.line.excess = rayleigh_excess(air, beginning) - begin * begin;
    sight.line.nu = ray.nu;
    sight.line.sun_distance = u_eye.x * u_eye.z - eye_x * ray.nu;
    float closest = rayleigh_altitude(air, sight.line.excess);
    sight.closest_m = read_column(0.0, max(closest, 0.0));
    sight.closest_density = rayleigh_density(air, closest);
    sight.eye = find_point(sight, begin);
    return sight;
}

// Colour that the air adds on the way.
vec3 air_light(Sight sight)
{
    RayleighShadow shadow = rayleigh_shadow(sight.line);
    RayleighLegs legs = rayleigh_legs(sight.line, shadow);
    float mass[SAMPLES];  // of the way from the sample before, as far as it is lit
    float depth[SAMPLES]; // column from the eye and to the star
    Point before = find_point(sight, legs.first_far);
    for (int i = 0; i < SAMPLES; i++) {
        Point here = find_point(sight, rayleigh_place(legs, float(i) / float(SAMPLES - 1)));
        mass[i] = find_between(sight, before, here) * rayleigh_lit(shadow, before.x, here.x);
        depth[i] = find_between(sight, sight.eye, here) + here.star_m;
        before = here;
    }
    vec3 sum = vec3(0.0);
#ifdef SIMPLE
    float all = 0.0;
    for (int i = 1; i < SAMPLES; i++) {
        all += mass[i];
    }
    for (int k = 0; k < WAVELENGTHS; k++) {
        sum += u_spectrum[k].rgb * (u_matter[k].x * all);
    }
#else
    for (int k = 0; k < WAVELENGTHS; k++) {
        float extinction = u_spectrum[k].w;
        float left = exp(-extinction * depth[0]);
        float light = 0.0;
        for (int i = 1; i < SAMPLES; i++) {
            float next = exp(-extinction * depth[i]);
            light += mass[i] * rayleigh_mean(left, next, extinction * (depth[i] - depth[i - 1]));
            left = next;
        }
        sum += u_spectrum[k].rgb * (u_matter[k].x * light);
    }
#endif
    return sum * phase_rayleigh(sight.line.nu);
}

// The star's light after a column.
vec3 star_through(float column_m)
{
    vec3 sum = vec3(0.0);
    for (int k = 0; k < WAVELENGTHS; k++) {
        sum += u_spectrum[k].rgb * exp(-u_spectrum[k].w * column_m);
    }
    return sum;
}

#endif // SKY_RAYLEIGH_AIR_GLSL
