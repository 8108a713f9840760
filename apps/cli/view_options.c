// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "view_options.h"

#include <string.h>

enum { CAMERA_OPTIONS = 9, SUN_OPTIONS = 4, EXPOSURE_OPTIONS = 3 };

static const double rad_per_deg = 3.14159265358979323846 / 180.0;

static const char *const tone_words[] = {"filmic", "exponential", NULL};
static const trl_tone_curve tone_curves[] = {TRL_TONE_FILMIC, TRL_TONE_EXPONENTIAL};

// In the order of trl_sky_model.
static const char *const sky_words[] = {"spectral", "single", "rayleigh", NULL};

// In the order of trl_air.
static const char *const air_words[] = {"table", "march", NULL};

static const struct number_range latitudes_deg = {-90.0, 90.0};
static const struct number_range turns_deg = {-360.0, 360.0};
// As far out as scene files allow a camera, and a little below the sphere, where sea floors are.
static const struct number_range altitudes_m = {-1e5, 1e12};
static const struct number_range heights_m = {0.0, 1e12};
static const struct number_range fields_deg = {0.001, 170.0};
static const struct number_range stops = {-40.0, 40.0};

struct view_choice view_choice_default(void)
{
    return (struct view_choice){.tone = -1,
                                .air = TRL_AIR_MARCH,
                                .sky_model = TRL_SKY_MODEL_OF_SCENE,
                                .mesher = mesher_option_default(),
                                .rayleigh = rayleigh_choice_default()};
}

static struct option make_number(const char *name, struct option_number *target,
                                 struct number_range range, const char *help)
{
    return (struct option){.name = name,
                           .kind = OPTION_NUMBER,
                           .target.number = target,
                           .metavar = "DEG",
                           .range = range,
                           .help = help};
}

// The same with another unit.
static struct option with_unit(struct option option, const char *metavar)
{
    option.metavar = metavar;
    return option;
}

static void make_camera(struct view_choice *c, struct option out[CAMERA_OPTIONS])
{
    const struct option options[CAMERA_OPTIONS] = {
        {.name = "view",
         .kind = OPTION_TEXT,
         .target.text = &c->name,
         .metavar = "NAME",
         .help = "View of the scene to start from. Default: its first one. What is given below "
                 "replaces "
                 "parts of it."},
        make_number("latitude", &c->latitude_deg, latitudes_deg, "Of the camera, north positive."),
        make_number("longitude", &c->longitude_deg, turns_deg, "Of the camera, east positive."),
        with_unit(make_number("altitude", &c->altitude_m, altitudes_m,
                              "Of the camera above the reference sphere."),
                  "M"),
        with_unit(make_number("height-above-ground", &c->height_m, heights_m,
                              "Of the camera above the terrain or sea below it, instead of "
                              "--altitude."),
                  "M"),
        make_number("heading", &c->heading_deg, turns_deg,
                    "Where the camera looks, clockwise from north: 90 is east."),
        make_number("pitch", &c->pitch_deg, latitudes_deg,
                    "Above the horizontal; -90 looks straight down."),
        make_number("roll", &c->roll_deg, turns_deg, "Clockwise about the line of sight."),
        make_number("fov", &c->fov_deg, fields_deg, "Vertical field of view."),
    };
    memcpy(out, options, sizeof options);
}

static void make_sun(struct view_choice *c, struct option out[SUN_OPTIONS])
{
    const struct option options[SUN_OPTIONS] = {
        make_number("sun-elevation", &c->sun_elevation_deg, latitudes_deg,
                    "Above the camera's horizontal."),
        make_number("sun-azimuth", &c->sun_azimuth_deg, turns_deg,
                    "Clockwise from north, as the camera sees it."),
        make_number("subsolar-latitude", &c->subsolar_latitude_deg, latitudes_deg,
                    "Where on the planet the sun stands overhead, instead of elevation and "
                    "azimuth."),
        make_number("subsolar-longitude", &c->subsolar_longitude_deg, turns_deg, "The same."),
    };
    memcpy(out, options, sizeof options);
}

static void make_exposure(struct view_choice *c, struct option out[EXPOSURE_OPTIONS])
{
    struct option ev100 = make_number("ev100", &c->ev100, stops,
                                      "Exposure value at ISO 100 (a bright day is about 15), or "
                                      "auto: found from the picture.");
    ev100.word = "auto";
    const struct option options[EXPOSURE_OPTIONS] = {
        with_unit(ev100, "EV"),
        with_unit(make_number("bias", &c->bias_ev, stops, "Stops of brightness added to either."),
                  "EV"),
        {.name = "tone",
         .kind = OPTION_CHOICE,
         .target.choice = &c->tone,
         .choices = tone_words,
         .metavar = "CURVE",
         .help = "From light to picture: filmic (keeps hue in highlights) or exponential "
                 "(1 - exp(-E I))."},
    };
    memcpy(out, options, sizeof options);
}

enum options_outcome view_command_read(const struct view_command *command, int argc, char **argv)
{
    struct option camera[CAMERA_OPTIONS];
    struct option sun[SUN_OPTIONS];
    struct option exposure[EXPOSURE_OPTIONS];
    make_camera(command->choice, camera);
    make_sun(command->choice, sun);
    make_exposure(command->choice, exposure);
    struct option rayleigh[RAYLEIGH_OPTIONS];
    rayleigh_options_make(&command->choice->rayleigh, rayleigh);
    struct option data[DATA_OPTIONS];
    data_options_make(&command->choice->data, data);
    const struct option sky[] = {
        {.name = "sky-model",
         .kind = OPTION_CHOICE,
         .target.choice = &command->choice->sky_model,
         .choices = sky_words,
         .metavar = "NAME",
         .help = "How the light of the air is found: spectral (all orders of scattering, Elek "
                 "2010 and beyond), single (one scattering, a 3D table, Schafhitzel 2007) or "
                 "rayleigh (a few samples per pixel, Santana 2017). Default: what the scene asks "
                 "for, else spectral."},
        {.name = "air",
         .kind = OPTION_CHOICE,
         .target.choice = &command->choice->air,
         .choices = air_words,
         .metavar = "WAY",
         .help =
             "Of the spectral sky: march (terrain casts shadows into the air) or table (it does "
             "not; faster). Default: march."},
    };
    const struct option ground[] = {
        mesher_option_make(&command->choice->mesher,
                           "How the mesh of the ground is made: hemisphere (a grid that faces the "
                           "camera, Michelic 2019), tessellated (the same divided by the GPU's "
                           "tessellation), projective (rays around the camera, laid on the planet "
                           "in every frame, PGM) or quadtree (tiles split where the ground is near "
                           "and rough, Schafhitzel 2007). Default: quadtree."),
        mesher_option_make_grid(&command->choice->mesher),
        mesher_option_make_error(&command->choice->mesher)};
    const struct option_section sections[] = {
        command->own,
        {"Camera", camera, CAMERA_OPTIONS},
        {"Sun", sun, SUN_OPTIONS},
        {"Exposure", exposure, EXPOSURE_OPTIONS},
        {"Ground", ground, sizeof ground / sizeof *ground},
        {"Sky", sky, sizeof sky / sizeof *sky},
        {RAYLEIGH_OPTIONS_HEADING, rayleigh, RAYLEIGH_OPTIONS},
        {DATA_OPTIONS_HEADING, data, DATA_OPTIONS}};
    const struct option_spec spec = {.command = command->name,
                                     .positional = "SCENE",
                                     .min_positionals = 1,
                                     .max_positionals = 1,
                                     .about = command->about,
                                     .examples = command->examples,
                                     .sections = sections,
                                     .section_count = sizeof sections / sizeof sections[0]};
    struct option_arguments words;
    const enum options_outcome outcome = options_read(&spec, argc, argv, &words);
    *command->scene = words.positionals[0];
    return outcome;
}

static void replace_angle(struct option_number given, double *rad)
{
    if (given.is_given) {
        *rad = given.value * rad_per_deg;
    }
}

static enum exit_status apply_camera(const struct view_choice *choice, trl_view *view)
{
    if (choice->altitude_m.is_given && choice->height_m.is_given) {
        return report_error(EXIT_USAGE,
                            "--altitude and --height-above-ground cannot both be given");
    }
    replace_angle(choice->latitude_deg, &view->latitude_rad);
    replace_angle(choice->longitude_deg, &view->longitude_rad);
    replace_angle(choice->heading_deg, &view->heading_rad);
    replace_angle(choice->pitch_deg, &view->pitch_rad);
    replace_angle(choice->roll_deg, &view->roll_rad);
    replace_angle(choice->fov_deg, &view->vertical_fov_rad);
    if (choice->altitude_m.is_given) {
        view->altitude_m = choice->altitude_m.value;
        view->altitude_mode = TRL_ALTITUDE_SPHERE;
    }
    if (choice->height_m.is_given) {
        view->altitude_m = choice->height_m.value;
        view->altitude_mode = TRL_ALTITUDE_GROUND;
    }
    return EXIT_OK;
}

// One of the two ways to place the sun. Half of a pair is enough where the view has the other half.
static enum exit_status apply_sun_pair(const struct option_number pair[2],
                                       const char *const names[2], trl_sun_mode mode,
                                       trl_view *view)
{
    if (!pair[0].is_given && !pair[1].is_given) {
        return EXIT_OK;
    }
    if (view->sun_mode != mode && !(pair[0].is_given && pair[1].is_given)) {
        return report_error(EXIT_USAGE,
                            "--%s also needs --%s, because the view places the sun otherwise",
                            names[pair[0].is_given ? 0 : 1], names[pair[0].is_given ? 1 : 0]);
    }
    view->sun_mode = mode;
    replace_angle(pair[0], &view->sun_latitude_or_elevation_rad);
    replace_angle(pair[1], &view->sun_longitude_or_azimuth_rad);
    return EXIT_OK;
}

static enum exit_status apply_sun(const struct view_choice *choice, trl_view *view)
{
    static const char *const local_names[] = {"sun-elevation", "sun-azimuth"};
    static const char *const subsolar_names[] = {"subsolar-latitude", "subsolar-longitude"};
    const struct option_number local[] = {choice->sun_elevation_deg, choice->sun_azimuth_deg};
    const struct option_number subsolar[] = {choice->subsolar_latitude_deg,
                                             choice->subsolar_longitude_deg};
    if ((local[0].is_given || local[1].is_given) &&
        (subsolar[0].is_given || subsolar[1].is_given)) {
        return report_error(EXIT_USAGE, "the sun is placed either by --sun-elevation and "
                                        "--sun-azimuth or by --subsolar-latitude and "
                                        "--subsolar-longitude");
    }
    const enum exit_status status = apply_sun_pair(local, local_names, TRL_SUN_LOCAL, view);
    return status == EXIT_OK ? apply_sun_pair(subsolar, subsolar_names, TRL_SUN_SUBSOLAR, view)
                             : status;
}

static void apply_exposure(const struct view_choice *choice, trl_view *view)
{
    if (choice->ev100.is_given) {
        view->has_fixed_exposure = !choice->ev100.is_word;
        view->exposure_ev100 = choice->ev100.value;
    }
    if (choice->bias_ev.is_given) {
        view->exposure_bias_ev = choice->bias_ev.value;
    }
    if (choice->tone >= 0) {
        view->tone_curve = tone_curves[choice->tone];
    }
}

enum exit_status view_choice_apply(const struct view_choice *choice, const trl_scene *scene,
                                   trl_view *out)
{
    const trl_result found = trl_scene_view(scene, choice->name, out);
    if (found != TRL_OK) {
        return found == TRL_ERROR_INVALID ? EXIT_USAGE : EXIT_FAILED;
    }
    enum exit_status status = apply_camera(choice, out);
    if (status == EXIT_OK) {
        status = apply_sun(choice, out);
    }
    if (status == EXIT_OK) {
        apply_exposure(choice, out);
    }
    return status;
}
