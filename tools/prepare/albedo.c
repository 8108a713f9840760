// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// From published pictures of a globe to the albedo of its ground.
#include "prepare.h"

#include <math.h>

#define PI 3.14159265358979323846

double light_of_code(double code)
{
    const double x = code / 255;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

double code_of_light(double light)
{
    const double x = fmin(1, fmax(0, light));
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055);
}

// How much area has each code of a band between the latitudes.
static void measure_codes(const struct picture *picture, uint32_t band, double latitude_deg,
                          double area[256])
{
    for (int code = 0; code < 256; code++) {
        area[code] = 0;
    }
    for (uint32_t row = 0; row < picture->height; row++) {
        const double latitude = PI / 2 - PI * (row + 0.5) / picture->height;
        if (fabs(latitude) > latitude_deg * PI / 180) {
            continue;
        }
        const uint8_t *pixel = picture->pixels + (size_t)row * picture->width * picture->bands;
        for (uint32_t column = 0; column < picture->width; column++) {
            area[pixel[(size_t)column * picture->bands + band]] += cos(latitude);
        }
    }
}

// The code below which that part of the area is, interpolated.
static double find_percentile(const double area[256], double part)
{
    double total = 0;
    for (int code = 0; code < 256; code++) {
        total += area[code];
    }
    double sum = 0;
    for (int code = 0; code < 256; code++) {
        if (sum + area[code] >= part * total) {
            return area[code] > 0 ? code - 0.5 + (part * total - sum) / area[code] : code;
        }
        sum += area[code];
    }
    return 255;
}

// Linear from dark to bright, and from bright to white.
static double map_light(const struct albedo_map *map, uint32_t band, double low, double high,
                        int code)
{
    const double light = light_of_code(code);
    const double dark = map->dark[band], bright = map->bright[band];
    if (light > high) {
        return bright + (map->white[band] - bright) * (light - high) / fmax(1 - high, 1e-6);
    }
    // Shadows in the picture would become negative; half of the dark ground is darker than any.
    return fmax(dark / 2, dark + (bright - dark) * (light - low) / fmax(high - low, 1e-6));
}

static void map_band(struct picture *picture, uint32_t band, const struct albedo_map *map)
{
    double area[256];
    measure_codes(picture, band, map->latitude_deg, area);
    const double low = light_of_code(find_percentile(area, 0.1));
    const double high = light_of_code(find_percentile(area, 0.9));
    uint8_t mapped[256];
    for (int code = 0; code < 256; code++) {
        mapped[code] = (uint8_t)lrint(code_of_light(map_light(map, band, low, high, code)));
    }
    const size_t count = (size_t)picture->width * picture->height;
    for (size_t i = 0; i < count; i++) {
        uint8_t *value = picture->pixels + i * picture->bands + band;
        *value = mapped[*value];
    }
}

// A grey picture gets three bands, an alpha band is dropped.
static trl_result make_three_bands(const struct places *places, struct picture *picture)
{
    const size_t count = (size_t)picture->width * picture->height;
    struct picture out = {picture->width, picture->height, 3, mem_alloc(places->ctx, count, 3)};
    if (!out.pixels) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < count; i++) {
        for (uint32_t band = 0; band < 3; band++) {
            const uint32_t from = picture->bands < 3 ? 0 : band;
            out.pixels[3 * i + band] = picture->pixels[i * picture->bands + from];
        }
    }
    picture_finish(places, picture);
    *picture = out;
    return TRL_OK;
}

trl_result albedo_prepare(const struct places *places, const struct albedo_map *map)
{
    struct picture picture;
    trl_result result = picture_read_globe(places, map->file, &picture);
    if (result == TRL_OK && picture.bands != 3) {
        result = make_three_bands(places, &picture);
    }
    for (uint32_t band = 0; band < 3 && result == TRL_OK; band++) {
        map_band(&picture, band, map);
    }
    if (result == TRL_OK) {
        result = picture_write(places, map->name, &picture);
    }
    if (result == TRL_OK && map->polar) {
        const struct globe_values globe = {picture.width, picture.height, picture.bands, NULL,
                                           picture.pixels};
        result = polar_prepare(places, map->polar, "colour", &globe);
    }
    picture_finish(places, &picture);
    return result;
}
