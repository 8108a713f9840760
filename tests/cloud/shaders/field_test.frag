// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Extinction of a layer at a place, with its height, and the optical depths toward the
// star: nearby and farther.
#include "cloud/weather.glsl"

uniform int u_layer;
uniform vec4 u_place; // relative to the eye, m; level
uniform vec2 u_width; // of a pixel that looks toward the star; how its levels are rounded

out vec4 out_point;

void main()
{
    CloudLayer layer = cloud_layer(u_layer);
    CloudBox box = cloud_box(layer, u_place.w);
    float cover = cloud_cover(layer, u_place.xyz, 1.0);
    cover = cloud_gathered(layer, u_place.xyz, cover, box);
    CloudPlaces at = cloud_places(layer, u_place.xyz);
    float extinction = cloud_look(layer, at, cover, cover, 0.0, box).extinction;
    float sun_mu = dot(u_eye_up, u_sun);
    vec2 depths = cloud_sun_depth(layer, u_place.xyz, at, cover, sun_mu, u_width.x, u_width.y);
    out_point = vec4(extinction, at.height, depths);
}
