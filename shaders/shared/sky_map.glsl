// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Where a ray, a sun and a distance lie in the tables of the sky. C fills the tables with the
// inverse of these; the sky pass looks them up. All coordinates are in [0, 1].
// Quantities: lengths in m; mu = cosine of a zenith angle; radius from the planet's centre.
#ifndef SHARED_SKY_MAP_GLSL
#define SHARED_SKY_MAP_GLSL

#include "shared/shared.glsl"

// Rays that miss the ground, by their distance to the top of the air: shortest straight up, longest
// along the horizon, where the coordinate is 1 and the table is densest (Bruneton and Neyret 2008
// take the distance itself; the root resolves the limb's lowest kilometre).
SHARED_FN Number sky_map_view(Length distance, Length shortest, Length longest)
{
    Number y = shared_clamp((distance - shortest) / shared_max(longest - shortest, 1.0), 0.0, 1.0);
    return 1.0 - sqrt(1.0 - y);
}

SHARED_FN Length sky_map_view_distance(Number x, Length shortest, Length longest)
{
    return shortest + (longest - shortest) * (1.0 - (1.0 - x) * (1.0 - x));
}

// asinh, odd, without cancellation
SHARED_FN Number sky_map_asinh(Number z)
{
    Number magnitude = shared_abs(z);
    Number root = log(magnitude + sqrt(magnitude * magnitude + 1.0));
    return z < 0.0 ? -root : root;
}

// The star's zenith angle in the grid of the moments: densest in the middle of twilight (centre),
// over its width. `first` and `last` are the asinh values of the ends.
SHARED_FN Number sky_map_sun(Number mu, Number centre, Number width, Number first, Number last)
{
    return shared_clamp((sky_map_asinh((mu - centre) / width) - first) / (last - first), 0.0, 1.0);
}

// The cosine at which the disc's upper edge touches the horizon of a point, and the coordinate of
// direct light above it: logarithmic, finest where the disc rises (softness is a cosine).
SHARED_FN Number sky_map_lowest_sun(Length ground_radius, Length altitude, Number disc_cos,
                                    Number disc_sin)
{
    Length h = shared_max(altitude, 0.0);
    Length r = ground_radius + h;
    // sqrt(1 - (R / r)^2) without cancellation
    return -sqrt(h * (ground_radius + r)) / r * disc_cos - ground_radius / r * disc_sin;
}

SHARED_FN Number sky_map_sunlight(Number mu, Number lowest, Number softness)
{
    return log(1.0 + shared_max(mu - lowest, 0.0) / softness) /
           log(1.0 + (1.0 - lowest) / softness);
}

// Mean height of the star's visible part above the level ground, as a cosine: the direct light is
// already that of this part alone. Half a disc has its centroid at 4 / (3 pi) of its radius;
// between none, half and all a parabola.
SHARED_FN Number visible_height(Number sun_mu, Number disc_sine)
{
    Number c = shared_clamp(sun_mu / disc_sine, -1.0, 1.0);
    return sun_mu > disc_sine ? sun_mu : disc_sine * (c + 1.0) * (0.424 + 0.076 * c);
}

// The azimuth of a ray from the star's, by its cosine.
SHARED_FN Number sky_map_azimuth(Number cos_azimuth)
{
    return 0.5 - 0.5 * cos_azimuth;
}

// From outside, rays of one zenith angle reach the planet under suns from noon to night. Their
// coordinate is sky_map_sun where they meet the ground, or are closest to it, between its values at
// both ends: dense where twilight falls. The cosine there is middle + reach cos(azimuth).
SHARED_STRUCT(SkyMapSuns)
{
    Number middle, reach;
};

// `distance` goes from the eye to that place, whose radius is `place`.
SHARED_FN SkyMapSuns sky_map_suns(Length eye, Length distance, Length place, Number mu,
                                  Number sun_mu)
{
    SkyMapSuns suns;
    suns.middle = (eye + distance * mu) * sun_mu / place;
    suns.reach =
        distance * sqrt(shared_max((1.0 - mu * mu) * (1.0 - sun_mu * sun_mu), 1.0e-12)) / place;
    return suns;
}

// Aerial perspective: rows of rays that meet the reference sphere, by the distance to it (nearest
// at the nadir, farthest along the horizon); rows of rays that pass above, by mu between the
// horizon and the highest ray; and the depth along a ray through the air, by the root of its share.
// Both have another form from outside.
SHARED_FN Number sky_map_ground_row(Length distance, Length nearest, Length farthest)
{
    return sqrt(
        shared_clamp((distance - nearest) / shared_max(farthest - nearest, 1.0e-3), 0.0, 1.0));
}

// From outside: dense at the nadir, where rows are wide on the ground, and at the limb.
SHARED_FN Number sky_map_ground_row_outside(Length distance, Length nearest, Length farthest)
{
    Number y = (distance - nearest) / shared_max(farthest - nearest, 1.0e-3);
    return acos(shared_clamp(1.0 - 2.0 * y, -1.0, 1.0)) / SHARED_PI;
}

SHARED_FN Number sky_map_air_row(Number mu, Number horizon_mu, Number highest_mu)
{
    return sqrt(
        shared_clamp((mu - horizon_mu) / shared_max(highest_mu - horizon_mu, 1.0e-9), 0.0, 1.0));
}

SHARED_FN Number sky_map_depth(Length distance, Length start, Length end)
{
    return sqrt(shared_clamp((distance - start) / shared_max(end - start, 1.0e-3), 0.0, 1.0));
}

// From outside rays come from thin air into dense, at `dense`: `before` of the depths stand before
// that, the others beyond, and on both sides most of them near it.
SHARED_FN Number sky_map_depth_outside(Length distance, Length start, Length dense, Length end,
                                       Number before)
{
    Number ahead =
        1.0 - sqrt(shared_clamp((dense - distance) / shared_max(dense - start, 1.0e-3), 0.0, 1.0));
    Number beyond =
        sqrt(shared_clamp((distance - dense) / shared_max(end - dense, 1.0e-3), 0.0, 1.0));
    return before * ahead + (1.0 - before) * beyond;
}

#endif // SHARED_SKY_MAP_GLSL
