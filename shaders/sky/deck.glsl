// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What clouds leave of light at any place: a map over where rays toward the star cross the sphere
// in the middle of the clouds. C makes it with cloud/deck.h. docs/physics.md, section 29.
#ifndef SKY_DECK_GLSL
#define SKY_DECK_GLSL

#include "shared/cloud.glsl"
#include "sky/ray.glsl"

// x: optical depth toward the star; y: altitude of the middle of the clouds there, m; z: part of
// the sky that they cover; w: what comes through them.
uniform sampler2D u_deck;
uniform vec4 u_deck_map; // altitude of its sphere; where its texels begin to grow, m; asinh of how
                         // often that its edge is away; half the height of the clouds, m

const float DECK_FARTHEST_M = 2.0e5; // from a place to where its ray toward the star is looked at

// Level, through the sphere's middle and below the eye: columns are two axes and the way up.
mat3 deck_axes()
{
    vec3 axis = abs(u_eye_up.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    vec3 east = normalize(cross(axis, u_eye_up));
    return mat3(east, cross(u_eye_up, east), u_eye_up);
}

// How far a ray toward the star, or back, goes from a place, relative to the eye, to a sphere.
float deck_way(vec3 place, float altitude, float to_altitude)
{
    float along = u_eye.x * u_eye.z + dot(place, u_sun);
    float rise = (to_altitude - altitude) * (2.0 * u_planet.x + altitude + to_altitude);
    float root = sqrt(max(along * along + rise, 0.0));
    return clamp(rise / max(along + root, 1.0), -DECK_FARTHEST_M, DECK_FARTHEST_M);
}

vec2 deck_uv(vec3 crossing)
{
    mat3 axes = deck_axes();
    vec2 at = vec2(dot(crossing, axes[0]), dot(crossing, axes[1]));
    float far = length(at) / u_deck_map.y;
    float grown = log(far + sqrt(far * far + 1.0)) / u_deck_map.z;
    return 0.5 + 0.5 * min(grown, 1.0) / max(length(at), 1.0e-3) * at;
}

struct Deck {
    float below;  // 1 below the clouds, 0 above
    float direct; // of the star's light, as it came
    float cover;
    float through; // covered parts of the sky let through
};

// How much of the clouds there is above an altitude.
float deck_below(float middle, float altitude)
{
    return clamp(0.5 + 0.5 * (middle - altitude) / u_deck_map.w, 0.0, 1.0);
}

Deck deck_texel(vec3 crossing, float altitude)
{
    vec4 texel = textureLod(u_deck, deck_uv(crossing), 0.0);
    Deck deck;
    deck.below = deck_below(texel.y, altitude);
    deck.direct = exp(-texel.x * deck.below);
    deck.cover = texel.z;
    deck.through = texel.w;
    return deck;
}

// For light from the star.
Deck deck_toward_star(vec3 place, float altitude)
{
    return deck_texel(place + u_sun * deck_way(place, altitude, u_deck_map.x), altitude);
}

// For light from all the sky.
Deck deck_overhead(vec3 place, float altitude)
{
    return deck_texel(place, altitude);
}

// Of light from below, what the clouds above send back.
float deck_back(Deck deck)
{
    return deck.below * deck.cover * (1.0 - deck.through);
}

// Of all light from above, below the clouds and in them.
float deck_left(Deck deck)
{
    return 1.0 - deck_back(deck);
}

// Light of the star that clouds have spread: what reaches a place from everywhere, actinic, over
// what a plane that faces the star gets. A diffuse flux is twice as actinic as it is on level
// ground (Madronich 1987, J. Geophys. Res. 92).
float deck_spread(Deck deck, float sun_mu)
{
    float through = cloud_star_through(deck.through, deck.cover, max(sun_mu, 0.0));
    float flux = deck.cover * mix(1.0 - through, through, deck.below);
    return 2.0 * max(sun_mu, 0.0) * flux;
}

// The star's light that level ground gets from clouds around, over what it would get without them:
// of what those within some of their heights take.
float deck_shed(vec3 place, float altitude, float sun_mu)
{
    const int WAYS = 8;
    vec3 crossing = place + u_sun * deck_way(place, altitude, u_deck_map.x);
    float height = max(u_deck_map.x - altitude, 0.0);
    mat3 axes = deck_axes();
    float taken = 0.0;
    for (int i = 0; i < WAYS; i++) {
        float angle = 2.0 * SHARED_PI / float(WAYS) * float(i);
        vec3 way = cos(angle) * axes[0] + sin(angle) * axes[1];
        float far = height * (1.0 + float(i & 1));
        taken += 1.0 - deck_texel(crossing + far * way, altitude).direct;
    }
    Deck deck = deck_overhead(place, altitude);
    return taken / float(WAYS) * cloud_star_through(deck.through, deck.cover, sun_mu);
}

#endif // SKY_DECK_GLSL
