// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_UNDER_LIGHT_H
#define FRAME_UNDER_LIGHT_H
// The light in the water around an eye, as textures in a sky's bands: of the tables of
// ocean/volume_under.h at the eye's depth, for the star as it stands.

#include "ocean/volume_under.h"
#include "scatter/bands.h"
#include "sky/sea_volume.h"

// Depths of columns that are solved: this many for each octave; between them it is mixed.
enum { UNDER_COLUMNS_AN_OCTAVE = 2 };

// Where the eye is.
struct under_place {
    double eye_depth_m, depth_m; // of the eye and of the bed, below the level
    double sun_mu;               // of the star's visible part, in the air
};

// light     2D RGBA32F  azimuth from the star's, and the sky's in the last column x line of sight.
//                       Rows below: J of volume_under.h, from straight down to straight up; above:
//                       what goes up below the surface toward the level and straight down. Per
//                       irradiance that has entered, on a plane that faces the refracted star; by
//                       the sky per irradiance of level water from above.
// scatter   2D RGBA32F  Row 0: root of the angle: logarithm of what is scattered into it,
//                       (m sr)^-1, without the forward peak; row 1: of the peak. Row 2: root of a
//                       length: extinction per m that gives white light the colour it has after it.
enum { UNDER_AZIMUTHS = 24, UNDER_COLUMNS = UNDER_AZIMUTHS + 1 };
enum { UNDER_VIEWS = 64, UNDER_RISING = 32, UNDER_ROWS = UNDER_VIEWS + UNDER_RISING };
enum { UNDER_ANGLES = 512, UNDER_SCATTER_ROWS = 3 };
#define UNDER_LENGTH_M 1000.0 // the longest of row 2

struct under_light_maps {
    float light[UNDER_ROWS][UNDER_COLUMNS][BAND_COUNT];
    float scatter[UNDER_SCATTER_ROWS][UNDER_ANGLES][BAND_COUNT];
    // Bands: scattering in the peak, per m, but for what leaves the star's image as it is; the
    // bed's albedo over pi; its radiance by diffuse light, as `light`.
    float peak[BAND_COUNT], bed[BAND_COUNT], bed_star[BAND_COUNT], bed_sky[BAND_COUNT];
};

struct under_columns {
    const trl_context *ctx;
    const struct ocean_desc *ocean;
    struct volume_under *of[2]; // of the depths around; both of one where the bed is level
    double part;                // of the way from the first's depth to the second's
};

// TRL_ERROR_MEMORY. Solves columns where others are wanted than are there: seconds.
TRL_MUST_USE trl_result under_columns_find(struct under_columns *columns, double depth_m);
void under_columns_finish(struct under_columns *columns);

// What an eye sees of the water over a bed at that depth, for one of the wavelengths of the columns
// found for it: as volume_radiance.
struct volume_light under_columns_at(const struct under_columns *columns, int wavelength,
                                     double depth_m, const struct volume_view *view);

void under_light_fill(const struct under_columns *columns, const struct under_place *place,
                      const struct sky_sea_volume *volume, const struct bands *bands,
                      struct under_light_maps *out);

#endif // FRAME_UNDER_LIGHT_H
