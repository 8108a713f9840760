// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The star's light on the ground of every second pixel each way, over what is there without clouds.
// x: from about where the star is; w: of that, what is not scattered; z: from clouds all around, on
// level ground; y: logarithm of the ground's distance, for who looks between pixels.
// Ground that clouds hide from the eye counts as sky. With SORT: which is ground, as depth, so that
// the rest is not entered.
// validate: SURFACE
// validate: SURFACE; SORT
// validate: SORT

#include "cloud/weather.glsl"
#include "sky/deck.glsl"

uniform vec2 u_picture;     // pixels
uniform sampler2D u_hidden; // of squares of four of them

#ifdef SURFACE
uniform sampler2D u_position; // xyz relative to the camera, m; w altitude, m, or below -1e8
#endif

#ifndef SORT
layout(location = 0) out vec4 out_left;
#endif

const int PLACES = 10; // at most: no nearer together than pixels are wide
const int LEAST_PLACES = 3;

void main()
{
    vec2 pixel = min(2.0 * floor(gl_FragCoord.xy), u_picture - 1.0) + 0.5;
    Ray ray = make_pixel_ray(pixel / u_picture);
#ifdef SURFACE
    vec4 position = texelFetch(u_position, ivec2(pixel), 0);
    bool is_ground = position.w > -1.0e8;
    vec3 place = position.xyz;
#else
    bool is_ground = ray.meets_ground;
    vec3 place = ray.direction * ray.ground_m;
#endif
#ifdef SORT
    is_ground = is_ground && texelFetch(u_hidden, ivec2(pixel) / 4, 0).x < 1.0;
    gl_FragDepth = is_ground ? 1.0 : 0.0;
#else
    vec3 up = normalize(u_eye_up * u_eye.x + place);
    float sun_mu = max(dot(up, u_sun), 0.03);
    float altitude = cloud_altitude(place);
    float width = length(place) * u_disc.z;
    float depth = 0.0;
    int index = 0;
    do {
        CloudLayer layer = cloud_layer(index);
        float base = max(layer.shell.x - altitude, 0.0) / sun_mu;
        float top = max(layer.shell.y - altitude, 0.0) / sun_mu;
        int places = clamp(int(ceil((top - base) / max(width, 1.0))), LEAST_PLACES, PLACES);
        float step_m = (top - base) / float(places);
        CloudBox box = cloud_whole_box(layer, cloud_level(layer, max(width, 0.5 * step_m)), 0.5);
        vec3 middle = place + u_sun * (0.5 * (base + top));
        float cover = cloud_gathered(layer, middle, cloud_cover(layer, middle, width), box);
        int i = 0;
        do {
            vec3 there = place + u_sun * (base + (float(i) + 0.5) * step_m);
            depth += cloud_coarse(layer, there, cover, box).x * step_m;
            i++;
        } while (i < places && cover > CLOUD_LEAST_COVER);
        index++;
    } while (index < u_cloud_layers);
    float shed = deck_shed(place, altitude, sun_mu);
    float unscattered = exp(-depth);
    // Thin clouds shed most of it forward.
    float ahead = min(exp(-CLOUD_TURNING_DEPTH * depth) - unscattered, shed);
    float toward = unscattered + ahead;
    float straight = unscattered / max(toward, 1.0e-30);
    out_left = vec4(toward, log(max(length(place), 1.0e-3)), shed - ahead, straight);
#endif
}
