// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The camera, and straight rays from it against the reference sphere and its air: what every model
// of the sky shares. Lengths in m. No planet-sized floats are subtracted: heights come separately.
// C sets the uniforms with sky_pixels_set_view.
#ifndef SKY_RAY_GLSL
#define SKY_RAY_GLSL

#include "shared/shared.glsl"

uniform vec3 u_forward;
uniform vec3 u_right;  // scaled to half the picture's width at distance 1
uniform vec3 u_up;     // the same for its height
uniform vec3 u_eye_up; // unit, planet frame
uniform vec3 u_sun;    // unit, toward the star
uniform vec4 u_eye;    // radius, altitude, cosine of the star's zenith angle, is outside the air
uniform vec3 u_disc;   // cosine and sine of the star's angular radius, angle of a pixel
uniform vec4 u_planet; // ground radius, height of the air, half chord of the air over the horizon

// A straight ray from the eye against the planet and its air.
struct Ray {
    vec3 direction;
    float mu, nu;         // cosines of the angles to the zenith and to the star
    bool meets_ground;    // of the reference sphere
    float inside_m2;      // square of half the chord in it, below 0 where the line passes by
    float ground_m;       // distance to it, where it is met
    float begin_m, end_m; // of the part in the air, as if it ended at the sphere
    float chord_m;        // half of the whole way through the air, from outside
};

Ray make_ray(vec3 direction)
{
    Ray ray;
    ray.direction = direction;
    ray.mu = dot(u_eye_up, direction);
    ray.nu = dot(u_sun, direction);
    float r = u_eye.x;
    float h = u_eye.y;
    float ground = u_planet.x;
    float top = u_planet.x + u_planet.y;
    float along = r * ray.mu;
    float pass = r * length(cross(u_eye_up, direction));
    bool outside = u_eye.w > 0.5;
    float to_ground =
        outside ? (ground - pass) * (ground + pass) : along * along - h * (2.0 * ground + h);
    float to_top = outside ? (top - pass) * (top + pass)
                           : along * along + (u_planet.y - h) * (2.0 * ground + u_planet.y + h);
    ray.inside_m2 = to_ground;
    ray.meets_ground = along < 0.0 && to_ground > 0.0;
    // The nearer root without cancellation: the product of both is h (2 R + h).
    ray.ground_m = h * (2.0 * ground + h) / (sqrt(max(to_ground, 0.0)) - min(along, -1.0e-3));
    ray.chord_m = sqrt(max(to_top, 0.0));
    bool misses = outside && (to_top <= 0.0 || along > 0.0);
    ray.begin_m = outside ? max(-along - ray.chord_m, 0.0) : 0.0;
    ray.end_m = ray.meets_ground ? ray.ground_m : ray.chord_m - along;
    if (misses) {
        ray.chord_m = 0.0;
        ray.end_m = ray.begin_m;
    }
    return ray;
}

// Through a pixel, by its place in the picture: (0, 0) lower left, (1, 1) upper right.
Ray make_pixel_ray(vec2 uv)
{
    vec2 at = 2.0 * uv - 1.0;
    return make_ray(normalize(u_forward + at.x * u_right + at.y * u_up));
}

#endif // SKY_RAY_GLSL
