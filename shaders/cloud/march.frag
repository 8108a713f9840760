// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clouds along the ray of every second pixel each way, in one march with the air (Michelic 2019,
// Eq. 15 to 20). Out comes what a picture without clouds is mixed with:
//
//     radiance = rgb + (1 - a) * radiance      linear sRGB, cd m^-2; a = 1 - transmittance
//
// The picture already has the air's light A as if there were no clouds. With A(s) that of the air
// up to s and the clouds' transmittance T(s), Eq. 20 is clouds + integral of T dA, as its
// in-scattered light of a slice, dimmed by the air before it, is the difference of what the maps
// have of both its ends. By parts that is
//
//     sum of (T_n-1 - T_n) (cloud's light there, dimmed by the air + A(s_n)) + T picture
//
// so air is looked up only where cloud is. With MOON a body stands for the star, and its light is
// added to what is there.
// validate: PEAKED_COUNT 1
// validate: PEAKED_COUNT 1; MOON
// validate: PEAKED_COUNT 1; SURFACE; MOON
// validate: PEAKED_COUNT 1; SURFACE; MARCH; ECLIPSE
// validate: PEAKED_COUNT 0
// validate: PEAKED_COUNT 1; SURFACE; MARCH

#include "cloud/light.glsl"
#include "cloud/parts.glsl"
#include "cloud/weather.glsl"
#include "sky/deck.glsl"
#ifdef ECLIPSE
#include "sky/eclipse.glsl"
#endif
#include "sky/spectral/air.glsl"
#include "sky/spectral/colour.glsl"

uniform vec2 u_picture; // pixels
uniform vec3 u_grid;   // of those rays that are marched: the first, each way; distance between them
uniform float u_sharp; // of what a pixel takes, the share that is no mean of four rays

#ifdef SURFACE
uniform sampler2D u_position; // xyz relative to the camera, m; w altitude, m, or below -1e8
#endif

layout(location = 0) out vec4 out_clouds;
layout(location = 1) out vec2 out_ends; // cloud/rays.h

const int SLICES = 16;            // at most, of a layer along a part of the ray
const float GROWTH = 0.333;       // of the distance, as long as a slice is
const float LEAST_SLICE = 16.0;   // texels, but no shorter
const float STEPS = 16.0;         // in a slice
const float NEAR_STEPS = 24.0;    // in one that begins before NEAR, where surfaces are seen
const float NEAR = 80.0;          // texels; from twice that it is STEPS
const float MOST_STEPS = 96.0;    // in one whose steps else were longer than
const float STEP_PIXELS = 10.0;   // are wide, and missed heads of clouds from row to row
const float LEAST_STEP = 0.4;     // texels
const float PART_STEPS = 12.0;    // at least, in all slices of a thick layer
const float LEAST_STEPS = 6.0;    // in a slice of one that pixels do not resolve
const int PLACES = 24;            // at most, in a slice, that are lit
const int LOOKS = 120;            // at most, between those
const int COVER_STEPS = 6;        // between looks at the fields of clouds
const float OPAQUE = 0.04;        // what is behind counts as what is before
const float STEP_DEPTH = 0.75;    // of cloud that is lit as one place, where nothing is before it
const float LONG_DEPTH = 0.45;    // at most, of a usual step
const float SHORT = 0.3;          // of a usual step, the shortest
const float STEEPEST = 10.0;      // texels in which noise hardly changes by more than 1
const float LEAST_DEPTH = 1.0e-4; // of what counts as cloud

// The nearest part that begins at `here` or beyond; an empty one: there is none.
Part next_part(Ray ray, float here, float end)
{
    Part next = Part(1.0e30, 1.0e30, 0, false);
    int k = 0;
    do {
        Part part = part_of(ray, k, end);
        if (part.to > part.from && part.from >= here && part.from < next.from) {
            next = part;
        }
        k++;
    } while (k < 2 * u_cloud_layers);
    if (next.from > 0.9e30) {
        next = Part(0.0, 0.0, 0, false);
    }
    return next;
}

// Of the texels that stand for every second pixel.
ivec2 find_texel()
{
    return ivec2(u_grid.z * floor(gl_FragCoord.xy) + u_grid.xy);
}

// Spreads the steps' beginnings, and the levels that are looked at, over each four pixels, which
// join.frag takes the mean of: x and y of each are quarters in another order. Where it takes none,
// spread levels of one ray of four show as a lattice.
vec2 spread_four()
{
    ivec2 at = find_texel() & 1;
    float rank = float(at.x == at.y ? 2 * at.x : 3 - 2 * at.x);
    // From square to square within a quarter, by Roberts's R2 (2018): no streaks along rows.
    float within = fract(dot(floor(0.5 * vec2(find_texel())), vec2(0.75487767, 0.56984029)));
    vec2 spread = (vec2(rank, mod(2.0 * rank + 1.0, 5.0)) + vec2(within, 0.5)) * 0.25;
    return mix(spread, vec2(0.5), u_sharp);
}

// With clouds above the layer and below it in what lights it from there. What its own clouds do to
// one another is in the shares, but the ground has only what they leave.
Lights lights_by_clouds(CloudLayer layer, Lights lights, vec3 place, float sun_mu)
{
    vec4 texel = textureLod(u_deck, deck_uv(place), 0.0);
    float back = texel.z * (1.0 - texel.w);
    float under = back * (1.0 - deck_below(texel.y, layer.shell.x));
    vec4 down = lights.sun * (sun_mu / SHARED_PI) + lights.above;
    lights.below = mix(lights.below * (1.0 - back), down, under);
    float passed = 1.0 - back * deck_below(texel.y, layer.shell.y);
    lights.above *= passed;
    lights.slope *= passed;
    lights.horizon *= passed;
    return lights;
}

Lights lights_in_eclipse(Lights lights, vec3 place)
{
#ifdef ECLIPSE
    float star = star_left(place);
    vec4 sky = ground_left(place, star);
    lights.sun *= star;
    lights.above *= sky;
    lights.below *= sky;
    lights.slope *= sky;
    lights.horizon *= sky;
#endif
    return lights;
}

// A part of a slice, with the cover of a level at both its ends, and where the noise is.
struct Span {
    float from, to; // m
    float first, last;
    CloudLine line;
};

// None yet, up to where the first begins.
Span first_span(CloudLayer layer, Ray ray, float to, float weather, CloudBox box)
{
    vec3 place = ray.direction * to;
    Span span;
    span.from = to;
    span.to = to;
    span.first = 0.0;
    span.last = 0.0;
    span.line.first = cloud_places(layer, place);
    span.line.way.noise = vec3(0.0);
    span.line.way.finer = vec3(0.0);
    span.line.way.height = 0.0;
    if (weather > CLOUD_LEAST_COVER) {
        span.last = cloud_gathered(layer, place, weather, box);
    }
    return span;
}

Span next_span(CloudLayer layer, Ray ray, Span before, float to, float weather, CloudBox box)
{
    vec3 place = ray.direction * to;
    Span span;
    span.from = before.to;
    span.to = to;
    span.first = before.last;
    span.last = cloud_gathered(layer, place, weather, box);
    span.line = cloud_line(layer, cloud_on_line(before.line, 1.0), place);
    return span;
}

float part_at(Span span, float at)
{
    return (at - span.from) / max(span.to - span.from, 1.0e-3);
}

CloudPlaces places_at(Span span, float at)
{
    return cloud_on_line(span.line, part_at(span, at));
}

// The usual step in a slice that begins at `near`, m: seen from near, what is lit must not jump
// from ray to ray. `width` is that of a pixel there: up to four are one step.
float find_step(Part part, float near, float slice_m, float texel, float width)
{
    float steps = mix(NEAR_STEPS, STEPS, clamp(near / (NEAR * texel) - 1.0, 0.0, 1.0));
    steps = clamp(GROWTH * near / (STEP_PIXELS * width), steps, MOST_STEPS);
    float step_m = min(GROWTH * near / steps, (part.to - part.from) / PART_STEPS);
    step_m = max(step_m, LEAST_STEP * texel);
    return max(step_m, min(4.0 * width, slice_m / LEAST_STEPS));
}

// Of a usual step, the part or multiple that is right beyond a place.
float find_stride(CloudLook look, float usual, float thick, float texel)
{
    float air = 1.0 + min(STEEPEST * look.missing * texel / usual, 1.0);
    float cloud = clamp(thick / max(look.extinction * usual, 1.0e-3), SHORT, 1.0);
    return look.missing > 0.0 ? air : cloud;
}

void main()
{
    vec2 pixel = min(2.0 * vec2(find_texel()), u_picture - 1.0) + 0.5;
    vec2 uv = pixel / u_picture;
    Ray ray = make_pixel_ray(uv);
    float end = 1.0e30;
#ifdef SURFACE
    vec4 position = texelFetch(u_position, ivec2(pixel), 0);
    float distance_m = length(position.xyz);
    bool is_ground = position.w > -1.0e8;
    if (is_ground) {
        ray = make_ray(position.xyz / max(distance_m, 1.0e-6));
        end = distance_m;
    }
#else
    bool is_ground = ray.meets_ground;
    end = is_ground ? ray.ground_m : end;
#endif
    if (!is_ground) {
        ray.meets_ground = false;
        ray.end_m = max(ray.begin_m, ray.chord_m - u_eye.x * ray.mu);
    }
    Lighting lighting;
    lighting.phases = vec2(cloud_phase(ray.nu, 1.0), cloud_phase(ray.nu, CLOUD_TURNED));
    vec2 four = spread_four();
    float pixel_rad = u_disc.z;
    float left = 1.0;        // transmittance of the clouds so far
    vec4 bands = vec4(0.0);  // of the clouds
    vec3 air = vec3(0.0);    // XYZ of the air before them
    float distances_m = 0.0; // of clouds, times what they take
    Part part = next_part(ray, 0.0, end);
    float first_m = part.to > part.from ? max(part.from, 1.0) : 0.0; // where a layer begins
    // Loops end at their end: docs/decisions/046.
    do {
        CloudLayer layer = cloud_layer(part.layer);
        float texel = cloud_texel(layer);
        float near = part.from;
        int slice = 1;
        do {
            // Slices, and steps, grow with the distance, and not with how far the ray goes on: else
            // they would change where rays graze a layer, which shows as a line.
            float far = min(near + max(LEAST_SLICE * texel, GROWTH * near), part.to);
            far = slice < SLICES ? far : part.to;
            vec3 middle = ray.direction * (0.5 * (near + far));
            float width = 0.5 * (near + far) * pixel_rad;
            float weather = cloud_cover(layer, middle, width);
            vec3 up = normalize(u_eye_up * u_eye.x + middle);
            float sun_mu = dot(up, u_sun);
            float usual = find_step(part, near, far - near, texel, width);
            CloudBox box =
                cloud_whole_box(layer, cloud_level(layer, max(width, 0.125 * usual)), four.y);
            lighting.up = up;
            lighting.sun_mu = sun_mu;
            lighting.view_mu = dot(up, ray.direction);
            // The star's part of the horizontal, along the view.
            lighting.toward = (ray.nu - lighting.view_mu * sun_mu) *
                              inversesqrt(max(1.0 - sun_mu * sun_mu, 1.0e-4));
            lighting.width = width;
            lighting.rest = four.y;
            float rise = layer.form.w * lighting.view_mu / (layer.shell.y - layer.shell.x);
            // Where steps are longer than what is in them varies, they would only make noise.
            float offset = 0.5 + (four.x - 0.5) * min(4.0 * texel / usual, 1.0);
            float s = weather > CLOUD_LEAST_COVER ? near : far;
            float stride = usual;
            bool is_inside = false;
            bool is_near = true;
            float left_before = left;
            float moment = 0.0; // of s
            Shares sum = Shares(0.0, 0.0, 0.0, 0.0, 0.0);
            Span span = first_span(layer, ray, s, weather, box);
            int places = 0;
            bool is_lit = false;
            do {
                // Through air and cloud until there is enough to be lit: light is not looked for
                // in empty air.
                float enough = STEP_DEPTH / left;
                float thick = LONG_DEPTH / left; // of a step, at most
                float depth = 0.0;
                float depth_s = 0.0;
                float cover = 0.0;
                int looks = 0;
                bool goes_on = s < far;
                do {
                    if (s >= span.to) {
                        // In no more than a tile are places on a line.
                        float ahead = min(max(float(COVER_STEPS) * usual, 4.0 * layer.form.w),
                                          max(1.0 / layer.grain.x, 2.0 * usual));
                        span = next_span(layer, ray, span, min(s + ahead, far), weather, box);
                    }
                    do {
                        if (goes_on) {
                            float step_m = min(stride, span.to - s);
                            float at = s + offset * step_m;
                            cover = mix(span.first, span.last, part_at(span, at));
                            CloudLook look = cloud_look(layer, places_at(span, at), cover,
                                                        max(span.first, span.last), rise, box);
                            is_near = look.is_near;
                            float own = look.extinction * step_m;
                            // A step that was too long for the cloud that it meets is made again.
                            bool is_again =
                                !is_inside && own > (stride > usual ? LEAST_DEPTH : thick);
                            is_inside = own > LEAST_DEPTH;
                            stride = usual * find_stride(look, usual, thick, texel);
                            own = is_again ? 0.0 : own;
                            step_m = is_near ? step_m : max(step_m, at - s + layer.form.w);
                            step_m = is_again ? 0.0 : step_m;
                            depth += own;
                            depth_s += own * at;
                            s += step_m;
                        }
                        looks++;
                        goes_on = looks < LOOKS && s < far && depth <= enough &&
                                  (depth <= LEAST_DEPTH || is_near);
                    } while (goes_on && s < span.to);
                } while (goes_on);
                is_lit = depth > LEAST_DEPTH;
                if (is_lit) {
                    float at = depth_s / depth;
                    Shares shares =
                        shares_at(layer, ray.direction * at, places_at(span, at), cover, lighting);
                    float weight = left * (1.0 - exp(-depth));
                    sum.sun += shares.sun * weight;
                    sum.above += shares.above * weight;
                    sum.below += shares.below * weight;
                    sum.turned += shares.turned * weight;
                    sum.horizon += shares.horizon * weight;
                    moment += at * weight;
                    left -= weight;
                }
                places++;
            } while (is_lit && places < PLACES && s < far && left >= OPAQUE);
            float taken = left_before - left;
            distances_m += moment;
            if (taken > 0.0) {
                float at = moment / taken;
                vec3 lit_at = ray.direction * at;
                Lights lights = lights_in_eclipse(lights_at(lit_at), lit_at);
                lights = lights_by_clouds(layer, lights, lit_at, max(sun_mu, 0.0));
                Air before = air_before(ray, at);
                vec3 light = before.scattered;
#ifdef MARCH
                light *= share_before(uv, ray, at);
#endif
                air += light * taken;
                vec4 sky = lights.above * sum.above + lights.below * sum.below +
                           lights.slope * sum.turned + lights.horizon * sum.horizon;
                bands += (lights.sun * sum.sun + max(sky, 0.0)) * before.transmittance;
            }
            near = far;
            slice++;
        } while (slice <= SLICES && near < part.to && left >= OPAQUE);
        part = next_part(ray, part.to, end);
    } while (part.to > part.from && left >= OPAQUE);
    float empty_m = first_m > 0.0 ? first_m : min(end, 1.0e7);
    float seen_m = left < 0.99 ? max(distances_m / (1.0 - left), 1.0) : empty_m;
    // What is left of a cloud that is all but opaque is like the rest.
    float scale = left < OPAQUE ? 1.0 / (1.0 - left) : 1.0;
    left = left < OPAQUE ? 0.0 : left;
    vec4 joined = join_radiance(bands * scale, air * scale);
    out_clouds = vec4(joined.rgb, ALPHA * (1.0 - left));
    out_ends = ALPHA * vec2(log(seen_m), log(ray_end(ray, is_ground ? end : SKY_M)));
}
