// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "rayleigh_options.h"

#include <string.h>

// In the order of trl_rayleigh_depth.
static const char *const depth_words[] = {"texture", "fit", NULL};
static const char *const switch_words[] = {"on", "off", NULL};

struct rayleigh_choice rayleigh_choice_default(void)
{
    return (struct rayleigh_choice){.optical_depth = -1, .out_scattering = -1};
}

static struct option make_count(const char *name, struct option_number *target, double most,
                                const char *help)
{
    return (struct option){.name = name,
                           .kind = OPTION_NUMBER,
                           .target.number = target,
                           .metavar = "N",
                           .range = {3, most},
                           .is_whole = true,
                           .help = help};
}

void rayleigh_options_make(struct rayleigh_choice *choice, struct option out[RAYLEIGH_OPTIONS])
{
    const struct option options[RAYLEIGH_OPTIONS] = {
        make_count("rayleigh-samples", &choice->samples, TRL_RAYLEIGH_MAX_SAMPLES,
                   "Points along a line of sight, odd. Default of all these: what the scene asks "
                   "for, else 5."),
        make_count("rayleigh-wavelengths", &choice->wavelengths, TRL_RAYLEIGH_MAX_WAVELENGTHS,
                   "Of pictures. Else 10."),
        {.name = "rayleigh-optical-depth",
         .kind = OPTION_CHOICE,
         .target.choice = &choice->optical_depth,
         .choices = depth_words,
         .metavar = "FROM",
         .help = "From a texture, or a fit by polynomials. Else texture."},
        {.name = "rayleigh-height-scale",
         .kind = OPTION_NUMBER,
         .target.number = &choice->height_scale,
         .metavar = "S",
         .range = {1e-3, 1000},
         .help = "Air this many times as high as it is. Else 1."},
        {.name = "rayleigh-out-scattering",
         .kind = OPTION_CHOICE,
         .target.choice = &choice->out_scattering,
         .choices = switch_words,
         .metavar = "ON",
         .help = "on, or off: light is not lost on its way, so there is no dusk. Else on."},
    };
    memcpy(out, options, sizeof options);
}

enum exit_status rayleigh_choice_check(const struct rayleigh_choice *choice)
{
    const unsigned samples = (unsigned)choice->samples.value;
    return choice->samples.is_given && samples % 2 == 0
               ? report_error(EXIT_USAGE, "--rayleigh-samples: %u is not odd", samples)
               : EXIT_OK;
}

trl_rayleigh_desc rayleigh_choice_resolve(const struct rayleigh_choice *choice,
                                          const trl_scene *scene)
{
    trl_rayleigh_desc desc = trl_scene_rayleigh(scene);
    if (choice->samples.is_given) {
        desc.samples = (uint32_t)choice->samples.value;
    }
    if (choice->wavelengths.is_given) {
        desc.wavelengths = (uint32_t)choice->wavelengths.value;
    }
    if (choice->height_scale.is_given) {
        desc.height_scale = choice->height_scale.value;
    }
    if (choice->optical_depth >= 0) {
        desc.optical_depth = (trl_rayleigh_depth)choice->optical_depth;
    }
    if (choice->out_scattering >= 0) {
        desc.has_out_scattering = choice->out_scattering == 0;
    }
    return desc;
}
