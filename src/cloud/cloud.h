// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUD_CLOUD_H
#define CLOUD_CLOUD_H
// Clouds as a scene describes them: plain data. docs/scenes.md has what the numbers mean.

#include <stddef.h>

enum { CLOUD_MAX_LAYERS = 4, CLOUD_MAX_CYCLONES = 4 };

// Where between base and top a layer is widest. Cumulus: low, as air that rises condenses at one
// height and has flat bases.
#define CLOUD_CUMULUS_PEAK 0.08
#define CLOUD_STRATUS_PEAK 0.5
#define CLOUD_FOG_PEAK 0.0

enum cloud_type { CLOUD_CUMULUS, CLOUD_STRATUS, CLOUD_CIRRUS, CLOUD_FOG };

// Between which latitudes a layer is; it ends within `feather_rad` outside of them.
struct cloud_belt {
    double south_rad, north_rad, feather_rad;
};
#define CLOUD_EVERYWHERE                                                                           \
    {                                                                                              \
        -2, 2, 0.1                                                                                 \
    }

struct cloud_layer {
    enum cloud_type type;
    double base_m, top_m;    // above the reference sphere
    double cover;            // of the sky, where the map says 1
    double extinction_per_m; // where the cloud is densest
    double scale_m;          // tile of the noise
    double wind_m_s;         // to the east at the equator; the layer turns as a whole
    double shear_m;          // how far its base is behind its top, to the west
    double cyclone_cover;    // of the sky in the bands of cyclones
    struct cloud_belt belt;
};

struct cloud_cyclone {
    double latitude_rad, longitude_rad; // of its eye
    double radius_m;                    // where its bands end
    double eye_radius_m;
};

struct cloud_desc {
    size_t layer_count; // 0: no clouds
    struct cloud_layer layers[CLOUD_MAX_LAYERS];
    size_t cyclone_count;
    struct cloud_cyclone cyclones[CLOUD_MAX_CYCLONES];
    double systems_m; // size of weather systems where there is no map; 0: none
    double seed;
    char *map_path; // owned; raster of cover, of all layers or a band for each; NULL: none
};

#endif // CLOUD_CLOUD_H
