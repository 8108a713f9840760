// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_SAMPLING_CAMERA_H
#define TERRAIN_SAMPLING_CAMERA_H
// The sampling camera of PGM, Section 5: which directions a grid must look into so that all that a
// camera can see of the planet is sampled, its own foot included. Its columns are half planes
// through the vertical, since ground that is lifted stays in its own: no hill comes into the
// picture from the side. Its rows are cones around the nadir, so the horizon is one.

#include "base/camera.h"
#include "terrain/surface.h"

struct sampling_camera {
    struct anchor anchor;           // below the camera
    double distance_m;              // of the camera from the planet's centre
    double height_m;                // above the ground below, > 0
    double max_altitude_m;          // of the ground that may be seen
    double reach_rad;               // angle at the centre that covers it
    double top_rad;                 // from the nadir: no ground is seen beyond
    bool is_circle;                 // the nadir or the zenith is in view: columns all around
    double from_rad, to_rad;        // azimuths, from east to north
    struct vec3 right, up, forward; // of the camera, in the anchor's axes
    double tan_half_fov_x, tan_half_fov_y;
};

struct sampling_camera sampling_camera_make(const struct surface *surface,
                                            const struct camera *camera);

// For the layers within its reach.
struct surface_eye sampling_camera_eye(const struct sampling_camera *s,
                                       const struct surface *surface);

// The part of a half plane that the camera sees: angles from the nadir. Empty: to <= from.
struct sampling_range {
    double from_rad, to_rad;
};
struct sampling_range sampling_camera_range(const struct sampling_camera *s, double azimuth_rad);

// Places count + 1 columns over all azimuths, in proportion to how wide they are in the picture. Of
// each: cosine and sine of its azimuth, its range. There is one more beyond, so that every column
// has a next one; of a circle column `count` is column 0. `columns` holds (count + 2) x 4 floats.
void sampling_camera_columns(const struct sampling_camera *s, uint32_t count, float *columns);

#endif // TERRAIN_SAMPLING_CAMERA_H
