// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_SCENE_H
#define TRL_SCENE_H

#include <terrella/context.h>

TRL_BEGIN

/// A planet as physics and data: star, ground, atmosphere, surface layers, views.
/// Owner: caller. Threads: immutable, const calls from any thread.
typedef struct trl_scene trl_scene;

/// From where altitudes of a camera count.
typedef enum trl_altitude_mode {
    TRL_ALTITUDE_SPHERE, ///< the reference sphere
    TRL_ALTITUDE_GROUND, ///< the ground below the camera, level water included
    TRL_ALTITUDE_WAVES   ///< as TRL_ALTITUDE_GROUND, and with the waves of the ocean at the view's
                         ///< time: an eye on a boat. Where there is no sea it is still raised
} trl_altitude_mode;

/// Where the star stands: a point of the planet over which it is at the zenith, or as the camera
/// sees it.
typedef enum trl_sun_mode { TRL_SUN_SUBSOLAR, TRL_SUN_LOCAL } trl_sun_mode;

typedef enum trl_tone_curve {
    TRL_TONE_FILMIC,     ///< a shoulder that keeps hue in highlights
    TRL_TONE_EXPONENTIAL ///< 1 - exp(-E I), Elek 2010 Section 5
} trl_tone_curve;

/// How the light of the sky is found.
typedef enum trl_sky_model {
    TRL_SKY_SPECTRAL, ///< "spectral": all orders, wavelength by wavelength (Elek 2010 and beyond)
    TRL_SKY_SINGLE,   ///< "single": single scattering from one 3D table (Schafhitzel 2007)
    TRL_SKY_RAYLEIGH, ///< "rayleigh": single scattering by few samples per pixel (Santana 2017)
    TRL_SKY_REFERENCE ///< "reference": a Monte Carlo path tracer that shares no transport code with
                      ///< the others: slow, unbiased, with a standard error; numbers only
} trl_sky_model;

/// The word for a model in scenes and on the command line; NULL for what is none. Threads: any.
TRL_API const char *trl_sky_model_name(trl_sky_model model);

/// The model of that word. False when there is none, and *out is not touched. Threads: any.
TRL_API bool trl_sky_model_find(const char *name, trl_sky_model *out);

/// From what TRL_SKY_RAYLEIGH reads the columns of air along lines (Santana 2017, Section 6).
typedef enum trl_rayleigh_depth {
    TRL_RAYLEIGH_TEXTURE, ///< a texture of 128 x 64 texels
    TRL_RAYLEIGH_FIT      ///< polynomials at some heights, fitted when the model is made
} trl_rayleigh_depth;

/// How TRL_SKY_RAYLEIGH works. It knows one gas whose density falls exponentially: the constituents
/// that scatter with the Rayleigh phase function, without the others.
typedef struct trl_rayleigh_desc {
    uint32_t canary;      ///< set by trl_rayleigh_desc_default(); never touch
    uint32_t samples;     ///< along a line of sight: odd, [3, TRL_RAYLEIGH_MAX_SAMPLES]; default 5
    uint32_t wavelengths; ///< of pictures, [3, TRL_RAYLEIGH_MAX_WAVELENGTHS]; default 10
    trl_rayleigh_depth optical_depth; ///< default TRL_RAYLEIGH_TEXTURE
    uint32_t fit_heights;    ///< of TRL_RAYLEIGH_FIT, [2, TRL_RAYLEIGH_MAX_HEIGHTS]; default 10
    uint32_t fit_degree;     ///< the same, [1, TRL_RAYLEIGH_MAX_DEGREE]; default 5
    bool has_out_scattering; ///< light is lost on its way; default true. False: Santana's
                             ///< simplified variant, which has no dusk
    double height_scale; ///< of the air, (0, 1000], to show it higher than it is; straight up the
                         ///< optical depth stays. Default 1
    double star_temperature_K; ///< of the black body that colours the light of pictures, [500,
                               ///< 1e6]; 0 (default): like the scene's star
} trl_rayleigh_desc;

enum {
    TRL_RAYLEIGH_MAX_SAMPLES = 65,
    TRL_RAYLEIGH_MAX_WAVELENGTHS = 40,
    TRL_RAYLEIGH_MAX_HEIGHTS = 32,
    TRL_RAYLEIGH_MAX_DEGREE = 7
};

/// A desc with every default set. Threads: any.
TRL_API trl_rayleigh_desc trl_rayleigh_desc_default(void);

/// Which wavelengths pictures of TRL_SKY_SPECTRAL are solved at. The other models have their own.
typedef enum trl_spectrum {
    TRL_SPECTRUM_FULL, ///< "full": spread evenly over what eyes see, as many as the desc says
    TRL_SPECTRUM_RGB   ///< "rgb": one each of red, green and blue (680, 550, 440 nm), whatever the
                       ///< desc says; taken as a spectrum of three samples, so that white stays
                       ///< white (Elek 2010, Section 4.4). To compare with, not for good pictures
} trl_spectrum;

/// How a view says where a body of the scene is.
typedef enum trl_body_mode {
    TRL_BODY_ABSENT,   ///< not in the picture, and without effect on it
    TRL_BODY_LOCAL,    ///< as the camera sees its centre: elevation and azimuth
    TRL_BODY_SUBPOINT, ///< by the point of the planet over which it is at the zenith
    TRL_BODY_FROM_SUN  ///< as the camera sees its centre: up and right of the star's, for one that
                       ///< faces the star and is held level
} trl_body_mode;

/// Where a body is. What is not said is 0.
typedef struct trl_body_place {
    trl_body_mode mode;
    double latitude_or_elevation_rad; ///< or the angle up from the star
    double longitude_or_azimuth_rad;  ///< or the angle to the right; azimuth clockwise from north
    double distance_m;                ///< from the planet's centre to its own; 0: the scene's
} trl_body_place;

enum { TRL_VIEW_MAX_BODIES = 8 };

/// A camera, the star, other bodies and the exposure.
typedef struct trl_view {
    double latitude_rad;  ///< planetocentric, [-pi/2, pi/2]
    double longitude_rad; ///< east positive
    double altitude_m;    ///< of the camera, see altitude_mode
    trl_altitude_mode altitude_mode;
    double heading_rad;      ///< clockwise from north
    double pitch_rad;        ///< above the horizontal; -pi/2 looks straight down
    double roll_rad;         ///< clockwise about the line of sight
    double vertical_fov_rad; ///< (0, pi)
    trl_sun_mode sun_mode;
    double sun_latitude_or_elevation_rad; ///< subsolar latitude, or elevation above the camera's
                                          ///< horizontal
    double sun_longitude_or_azimuth_rad;  ///< subsolar longitude, or azimuth clockwise from north
    double sidereal_rad; ///< right ascension over longitude 0: how far the planet has turned
    double time_s;       ///< at which the waves of an ocean and clouds in the wind are shown
    trl_body_place bodies[TRL_VIEW_MAX_BODIES]; ///< in the order of the scene's; others absent
    bool has_fixed_exposure;                    ///< else exposure is found from the picture
    double exposure_ev100;                      ///< exposure value at ISO 100, when fixed
    double exposure_bias_ev;                    ///< added brightness in stops, both modes
    trl_tone_curve tone_curve;
} trl_view;

/// Over the planet's middle from 3 radii, half lit, 40 degrees of view, automatic exposure.
/// Threads: any.
TRL_API trl_view trl_view_default(void);

/// Reads a scene file (JSON; docs/scenes.md). Errors name file, line, column and the path of the
/// key.
/// @param[out] out  new scene, or NULL on failure
/// @return TRL_OK; TRL_ERROR_IO (cannot be read); TRL_ERROR_INVALID (its content); TRL_ERROR_MEMORY
TRL_API TRL_MUST_USE trl_result trl_scene_load(trl_context *ctx, const char *path, trl_scene **out);

/// Reads a scene from memory. `name` stands for the file in messages; files it names are looked for
/// in `base_dir`, then in the context's data folder.
/// @return as trl_scene_load
TRL_API TRL_MUST_USE trl_result trl_scene_parse(trl_context *ctx, const char *text, size_t length,
                                                const char *name, const char *base_dir,
                                                trl_scene **out);

/// Frees *scene and sets it to NULL.
TRL_API void trl_scene_destroy(trl_scene **scene);

/// The scene's name; owned by the scene.
TRL_API const char *trl_scene_name(const trl_scene *scene);

/// Radius of the reference sphere, and of the top of the atmosphere, in metres.
TRL_API double trl_scene_ground_radius_m(const trl_scene *scene);
TRL_API double trl_scene_top_radius_m(const trl_scene *scene);

/// The model of the sky that the scene asks for; TRL_SKY_SPECTRAL when it does not say.
TRL_API trl_sky_model trl_scene_sky_model(const trl_scene *scene);

/// How the scene wants TRL_SKY_RAYLEIGH to work; the default where it does not say.
TRL_API trl_rayleigh_desc trl_scene_rayleigh(const trl_scene *scene);

/// Constituents of the atmosphere. Index below the count, else NULL; names are the scene's.
TRL_API size_t trl_scene_constituent_count(const trl_scene *scene);
TRL_API const char *trl_scene_constituent_name(const trl_scene *scene, size_t index);

/// The asymmetry g of a constituent's phase function (Henyey-Greenstein or Cornette-Shanks); NAN
/// for one that has none, and for an index beyond the count.
TRL_API double trl_scene_constituent_asymmetry(const trl_scene *scene, size_t index);

/// Bodies beside the planet and its star, at most TRL_VIEW_MAX_BODIES. Index below the count, else
/// NULL.
TRL_API size_t trl_scene_body_count(const trl_scene *scene);
TRL_API const char *trl_scene_body_name(const trl_scene *scene, size_t index);

/// Named views. Index below the count, else NULL.
TRL_API size_t trl_scene_view_count(const trl_scene *scene);
TRL_API const char *trl_scene_view_name(const trl_scene *scene, size_t index);

/// Copies the view of that name. The first one for NULL; trl_view_default() if the scene has none.
/// @return TRL_OK; TRL_ERROR_INVALID (no such view; the log names those there are)
TRL_API TRL_MUST_USE trl_result trl_scene_view(const trl_scene *scene, const char *name,
                                               trl_view *out);

/// Surface rasters. Index below the count, else NULL.
TRL_API size_t trl_scene_layer_count(const trl_scene *scene);
TRL_API const char *trl_scene_layer_name(const trl_scene *scene, size_t index);
/// The file that the layer reads, and whether it is there.
TRL_API const char *trl_scene_layer_path(const trl_scene *scene, size_t index);
TRL_API bool trl_scene_layer_is_present(const trl_scene *scene, size_t index);

TRL_END
#endif // TRL_SCENE_H
