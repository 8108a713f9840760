// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Which parts of a ray are in layers of clouds (Michelic 2019, Figure 12).
#ifndef CLOUD_PARTS_GLSL
#define CLOUD_PARTS_GLSL

#include "sky/ray.glsl"

const int CLOUD_MAX_LAYERS = 4;

uniform int u_cloud_layers;
uniform vec4 u_cloud_shell[CLOUD_MAX_LAYERS]; // base, top above the sphere; widest at; cover

const float SKY_M = 1.0e8;   // where rays end that meet no ground
const float BELOW_M = 1.0e6; // and that meet it below the lowest layer

struct Part {
    float from, to; // m
    int layer;
    bool falls; // leaves the layer by its base, unless it ends before
};

// Where a ray is below a height over the sphere: x and y; x > y: nowhere.
vec2 ball(Ray ray, float height)
{
    float r = u_eye.x;
    float along = r * ray.mu;
    float pass = r * length(cross(u_eye_up, ray.direction));
    float radius = u_planet.x + height;
    bool outside = u_eye.w > 0.5;
    float inside2 =
        outside ? (radius - pass) * (radius + pass)
                : along * along + (height - u_eye.y) * (2.0 * u_planet.x + u_eye.y + height);
    float chord = sqrt(max(inside2, 0.0));
    // The root nearer to 0 from the product of both, which is h^2 + 2 R h of the difference.
    float product = (u_eye.y - height) * (2.0 * u_planet.x + u_eye.y + height);
    float far = along > 0.0 ? -along - chord : -along + chord;
    float near = product / (abs(far) > 1.0e-3 ? far : 1.0e-3);
    return inside2 <= 0.0 ? vec2(1.0, -1.0) : vec2(min(near, far), max(near, far));
}

// The parts of a ray in a layer: before the sphere of its base, and beyond.
Part part_of(Ray ray, int index, float end)
{
    Part part;
    part.layer = index / 2;
    vec2 top = ball(ray, u_cloud_shell[part.layer].y);
    vec2 base = ball(ray, u_cloud_shell[part.layer].x);
    bool meets_base = base.x < base.y;
    bool is_second = index % 2 == 1;
    part.falls = !is_second && meets_base;
    part.from = is_second ? base.y : top.x;
    part.to = is_second || !meets_base ? top.y : base.x;
    part.from = max(part.from, 0.0);
    part.to = min(part.to, end);
    if (top.x > top.y || (is_second && !meets_base)) {
        part.to = part.from;
    }
    return part;
}

// Where a ray that meets ground at `end` ends for clouds, m. Ground in a layer, or before all, is
// where it is; beyond a layer it may be anywhere, which is one place below the layer, and one above
// it: above all that of the sky.
float ray_end(Ray ray, float end)
{
    float farthest = 0.0;
    float place = end;
    if (end < SKY_M) {
        int k = 0;
        do {
            Part part = part_of(ray, k, end);
            if (part.to > max(part.from, farthest)) {
                farthest = part.to;
                float beyond = part.falls ? BELOW_M * exp2(float(part.layer))
                                          : SKY_M * exp2(float(part.layer + 1 - u_cloud_layers));
                place = part.to < end ? beyond : end;
            }
            k++;
        } while (k < 2 * u_cloud_layers);
    }
    return place;
}

#endif // CLOUD_PARTS_GLSL
