// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/clouds.h"

#include "reference/phase_sampler.h"

#include <math.h>

// What is dimmer than this goes on every second time only.
static const double dim = 0.05;

// Along a way from bound to bound.
struct track {
    const struct reference_clouds *clouds;
    const struct reference_clouds_way *way;
    struct random_stream *random;
    double at_m, until_m; // the bound holds up to there
    double most_per_m;
};

static struct vec3 place_of(const struct track *track)
{
    return vec3_add(track->way->from_m, vec3_scale(track->way->direction, track->at_m));
}

// Moves on to where matter of the bound's density everywhere would make light collide; false at the
// way's end. What is left of a free path at the border of two bounds is drawn anew, as exponential
// ones may be.
static bool next_try(struct track *track)
{
    while (track->at_m < track->way->length_m) {
        if (track->at_m >= track->until_m) {
            double reach_m;
            track->most_per_m =
                track->clouds->most_per_m(track->clouds->user, place_of(track), &reach_m);
            track->until_m = fmin(track->at_m + reach_m, track->way->length_m);
        }
        const double free_m =
            track->most_per_m > 0 ? -log(random_next(track->random)) / track->most_per_m : HUGE_VAL;
        if (track->at_m + free_m < track->until_m) {
            track->at_m += free_m;
            return true;
        }
        track->at_m = track->until_m;
    }
    return false;
}

// Of the matter there, the part that is cloud.
static double real_part(const struct track *track)
{
    return track->clouds->extinction_per_m(track->clouds->user, place_of(track)) /
           track->most_per_m;
}

double reference_clouds_meet(const struct reference_clouds *clouds,
                             const struct reference_clouds_way *way, struct random_stream *random)
{
    struct track track = {.clouds = clouds, .way = way, .random = random};
    while (next_try(&track)) {
        if (random_next(random) < real_part(&track)) {
            return track.at_m;
        }
    }
    return INFINITY;
}

double reference_clouds_passed(const struct reference_clouds *clouds,
                               const struct reference_clouds_way *way, struct random_stream *random)
{
    struct track track = {.clouds = clouds, .way = way, .random = random};
    double passed = 1;
    while (passed > 0 && next_try(&track)) {
        passed *= fmax(0, 1 - real_part(&track));
        if (passed < dim) {
            passed = random_next(random) < 0.5 ? 2 * passed : 0;
        }
    }
    return passed;
}

static double lobe(double g, double cosine)
{
    return phase_value(&(struct phase){.kind = PHASE_HENYEY_GREENSTEIN, .g = g}, cosine);
}

double reference_clouds_phase(const struct reference_clouds *clouds, double cosine)
{
    return (1 - clouds->back_share) * lobe(clouds->forward_g, cosine) +
           clouds->back_share * lobe(clouds->back_g, cosine);
}

double reference_clouds_draw(const struct reference_clouds *clouds, struct random_stream *random)
{
    const bool is_back = random_next(random) < clouds->back_share;
    return phase_draw_henyey_greenstein(is_back ? clouds->back_g : clouds->forward_g, random);
}
