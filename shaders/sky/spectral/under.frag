// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// All pixels of an eye under water: the surface from below, with the sky in Snell's window and the
// water mirrored beside it, or the bed, behind water that the star and the sky light. What the
// uniforms hold is in frame/under_light.h; docs/physics.md, *Under water*.
// validate: PEAKED_COUNT 1
// validate: PEAKED_COUNT 3; WAVES
#include "shared/fresnel.glsl"
#include "shared/sea.glsl"
#include "sky/fragment.glsl"
#include "sky/spectral/air.glsl"
#include "sky/spectral/colour.glsl"
#ifdef WAVES
#include "ocean/waves.glsl"
#endif

uniform vec4 u_ground_light; // see ground.frag
uniform vec2 u_light_texel;
uniform sampler2D u_sunlight;
uniform sampler2D u_skylight;
uniform vec4 u_bands_from_rgb[3]; // columns

uniform vec4 u_under;       // depths of the eye and of the bed there, m; mean square slope, index
uniform vec3 u_under_slope; // by how much it is deeper for a way in a direction
uniform vec4 u_under_star;  // to the refracted star; part of its light that enters
uniform float u_under_disc; // what the star's disc adds to the mean square slope
uniform vec4 u_under_peak, u_under_bed, u_under_bed_star, u_under_bed_sky;
uniform sampler2D u_under_light;
uniform sampler2D u_under_scatter;

#define AZIMUTHS 24.0
#define VIEWS 64.0
#define RISING 32.0
#define ANGLES 512.0
#define LENGTH 1000.0

// The surface is looked at over this many facets, alike likely.
#define RINGS 3
#define SPOKES 6

layout(location = 0) out vec4 out_radiance;

// Irradiance of the beam in the water, of level water by the sky; of the star in the air.
struct Light {
    vec4 beam, sky, star;
};

Light find_light()
{
    float lowest = sky_map_lowest_sun(u_planet.x, 0.0, u_disc.x, u_disc.y);
    float sun = sky_map_sunlight(u_eye.z, lowest, u_ground_light.z);
    float altitude = centre(0.0, u_ground_light.w);
    Light light;
    light.star = textureLod(u_sunlight, vec2(centre(sun, u_light_texel.x), altitude), 0.0);
    float day = sun_coordinate(u_eye.z);
    light.sky = exp(textureLod(u_skylight, vec2(centre(day, u_light_texel.y), altitude), 0.0));
    float height = max(visible_height(u_eye.z, u_disc.y), 0.0);
    light.beam =
        light.star * (height * u_under_star.w / max(dot(u_under_star.xyz, u_eye_up), 1.0e-3));
    return light;
}

// Azimuth from the star's, as a column of u_under_light.
float column_of(vec3 direction)
{
    vec3 level = direction - u_eye_up * dot(direction, u_eye_up);
    vec3 star = u_under_star.xyz - u_eye_up * dot(u_under_star.xyz, u_eye_up);
    float cosine =
        dot(level, star) * inversesqrt(max(dot(level, level) * dot(star, star), 1.0e-12));
    return 0.5 + acos(clamp(cosine, -1.0, 1.0)) * ((AZIMUTHS - 1.0) / SHARED_PI);
}

vec4 light_at(Light light, float column, float row)
{
    vec2 texel = vec2(1.0 / (AZIMUTHS + 1.0), 1.0 / (VIEWS + RISING));
    return light.beam * textureLod(u_under_light, vec2(column, row) * texel, 0.0) +
           light.sky * textureLod(u_under_light, vec2(AZIMUTHS + 0.5, row) * texel, 0.0);
}

vec4 scatter_at(float root, float row)
{
    return textureLod(u_under_scatter, vec2(centre(root, 1.0 / ANGLES), (row + 0.5) / 3.0), 0.0);
}

// What light from all sides and of the beam is dimmed by, per m, over such a way.
vec4 extinction_over(float length_m)
{
    return scatter_at(sqrt(clamp(length_m / LENGTH, 0.0, 1.0)), 2.0);
}

vec4 left_after(float length_m)
{
    return exp(-extinction_over(length_m) * length_m);
}

// What the beam scatters once into a line of sight of that length. Waves spread the beam: so much
// is the least angle. Of the peak there is no more than light that has left its way.
vec4 scattered_once(Light light, vec3 direction, float mu, float length_m)
{
    float sun = dot(u_under_star.xyz, u_eye_up);
    float spread = (1.0 - 1.0 / u_under.w) * sqrt(u_under.z + u_under_disc);
    float angle = acos(clamp(dot(direction, u_under_star.xyz), -1.0, 1.0));
    angle = min(sqrt(angle * angle + spread * spread), SHARED_PI);
    float root = sqrt(angle / SHARED_PI);
    vec4 depth = u_under_peak * length_m;
    vec4 part = (1.0 - exp(-depth)) / max(depth, vec4(1.0e-6));
    vec4 phase = exp(scatter_at(root, 0.0)) + exp(scatter_at(root, 1.0)) * min(part, vec4(1.0));
    float rate = 1.0 - mu / sun;
    vec4 extinction = extinction_over(u_under.x / sun + (mu < 0.0 ? min(length_m, 5.0) : 0.0));
    vec4 begin = extinction * (u_under.x / sun);
    vec4 way = abs(rate) > 1.0e-3 ? (exp(-begin) - exp(-begin - extinction * (rate * length_m))) /
                                        (extinction * rate)
                                  : exp(-begin) * length_m;
    return light.beam * phase * max(way, vec4(0.0));
}

// The sky's light as bands that show the same: below 0, too, in the blue of dusk.
vec4 sky_bands(vec3 direction)
{
    float mu = dot(direction, u_eye_up);
    vec3 xyz = sky_light(
        make_ray(mu < 1.0e-3 ? normalize(direction + u_eye_up * (1.0e-3 - mu)) : direction));
    vec3 rgb = vec3(dot(u_rgb_from_xyz[0].xyz, xyz), dot(u_rgb_from_xyz[1].xyz, xyz),
                    dot(u_rgb_from_xyz[2].xyz, xyz));
    vec4 one = vec4(1.0);
    rgb /= max(vec3(dot(u_rgb_from_bands[0], one), dot(u_rgb_from_bands[1], one),
                    dot(u_rgb_from_bands[2], one)),
               vec3(1.0e-20));
    return u_bands_from_rgb[0] * rgb.r + u_bands_from_rgb[1] * rgb.g + u_bands_from_rgb[2] * rgb.b;
}

// The star through facets (Walter et al. 2007, Eq. 21): radiance in the water per irradiance of a
// plane that faces it.
float star_window(vec3 direction, vec3 normal, float mss)
{
    float index = u_under.w;
    vec3 sum = index * direction - u_sun;
    float square = dot(sum, sum);
    vec3 facet = sum * inversesqrt(square);
    float mu = dot(facet, normal);
    float out_mu = dot(facet, u_sun);
    float in_mu = dot(facet, direction);
    float view_mu = dot(direction, normal);
    float light_mu = dot(u_sun, normal);
    if (mu < 0.05 || out_mu <= 0.0 || in_mu <= 0.0 || view_mu <= 0.0 || light_mu <= 0.0) {
        return 0.0;
    }
    float seen = 1.0 / (1.0 + sea_hidden(view_mu, mss) + sea_hidden(light_mu, mss));
    float mu2 = mu * mu;
    return index * index * in_mu * out_mu * (1.0 - fresnel_reflectance(out_mu, index)) *
           sea_slope_density(mu, mss) / (mu2 * mu2) * seen / (view_mu * square);
}

// A facet of the surface, from below. It stands for facets whose cosines of incidence are as much
// as `width` larger or less: of them a part is in the window, or its edge would be seen once for
// each.
vec4 facet_light(Light light, vec3 direction, vec3 facet, float width)
{
    float index = u_under.w;
    float cosine = dot(direction, facet);
    vec3 mirrored = direction - 2.0 * cosine * facet;
    float down = clamp(-dot(mirrored, u_eye_up), 0.0, 1.0);
    vec4 water = light_at(light, column_of(mirrored), VIEWS + 0.5 + down * (RISING - 1.0));
    float low = max(cosine - width, sqrt(1.0 - 1.0 / (index * index)));
    float high = cosine + width;
    float part = clamp((high - low) / (2.0 * width), 0.0, 1.0);
    vec4 sky = vec4(0.0);
    float passes = 0.0;
    if (part > 0.0) {
        float middle = min(0.5 * (low + high), 1.0);
        float turn = (middle - cosine) / max(1.0 - cosine * cosine, 1.0e-6);
        vec3 turned = normalize(facet + turn * (direction - cosine * facet));
        sky = sky_bands(refract(direction, -turned, index)) * (index * index);
        passes = part * (1.0 - fresnel_reflectance(middle, 1.0 / index));
    }
    return mix(water, sky, passes);
}

// Of all facets as large as they are seen, at that distance; the star loses what its peak has.
vec4 surface_light(Light light, vec3 direction, vec3 normal, float mss, float length_m)
{
    vec3 side =
        normalize(cross(normal, abs(normal.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
    vec3 other = cross(normal, side);
    float apart = 0.33 * sqrt(mss); // half of how far apart slopes are, one way
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < RINGS * SPOKES; i++) {
        float ring = float(i / SPOKES);
        float slope = sqrt(-mss * log(1.0 - (ring + 0.5) / float(RINGS)));
        float turn = (float(i) + 0.5 * ring) * (2.0 * SHARED_PI / float(SPOKES));
        vec3 facet = normal - slope * (cos(turn) * side + sin(turn) * other);
        float seen = max(dot(direction, facet), 0.0);
        if (seen > 0.0) {
            facet = normalize(facet);
            float sine = sqrt(max(1.0 - seen * seen / (1.0 + slope * slope), 0.0));
            sum += seen * facet_light(light, direction, facet, apart * sine + 1.0e-5);
            weights += seen;
        }
    }
    vec4 star = light.star * star_window(direction, normal, mss + u_under_disc);
    return (sum / max(weights, 1.0e-6) + star * exp(-u_under_peak * length_m)) *
           left_after(length_m);
}

// Normal of the waves that a pixel of the surface resolves; mean square slope of the others.
vec4 find_waves(vec3 direction, float mu, float length_m)
{
#ifdef WAVES
    vec3 place = direction * length_m;
    GerstnerPlace p = waves_place(place);
    vec3 way = u_wave_local_from_planet * place;
    float side = length_m * u_disc.z;
    vec2 flat_way = way.xy / max(length(way.xy), 1.0e-6);
    vec2 along = flat_way * (side / max(mu, 1.0e-2));
    vec2 across = vec2(-flat_way.y, flat_way.x) * side;
    GerstnerSum sum = waves_sum(p, WavesWindow(along, across, side, max(u_under.y, 0.1)));
    GerstnerNormal n = gerstner_normal(sum);
    GerstnerNormal turned = gerstner_to_anchor(p, n.x, n.y, n.z);
    return vec4(normalize(vec3(turned.x, turned.y, turned.z)) * u_wave_local_from_planet,
                sum.lost_square);
#else
    return vec4(u_eye_up, u_under.z);
#endif
}

// The level bed but for its slope: the beam falls on it as it is turned.
vec4 bed_light(Light light, float depth_m, float length_m)
{
    vec3 normal = normalize(u_eye_up + u_under_slope);
    float sun = dot(u_under_star.xyz, u_eye_up);
    float faces = max(dot(normal, u_under_star.xyz), 0.0);
    return light.beam * u_under_bed * (faces * left_after(depth_m / sun + length_m)) +
           (light.beam * u_under_bed_star + light.sky * u_under_bed_sky) * left_after(length_m);
}

void main()
{
    Ray ray = fragment_ray();
    Light light = find_light();
    float mu = ray.mu;
    float far = 1.0e5;
    float falls = -mu - dot(u_under_slope, ray.direction);
    float to_bed = falls > 1.0e-6 ? min((u_under.y - u_under.x) / falls, far) : far;
    float to_surface = mu > 1.0e-6 ? min(u_under.x / mu, far) : far;
    float length_m = min(to_bed, to_surface);
    vec4 behind;
    if (to_surface <= to_bed) {
        vec4 waves = find_waves(ray.direction, mu, length_m);
        behind = surface_light(light, ray.direction, waves.xyz, max(waves.w, 1.0e-6), length_m);
    } else {
        behind = bed_light(light, u_under.x - mu * length_m, length_m);
    }
    float row = 0.5 + (mu * 0.5 + 0.5) * (VIEWS - 1.0);
    vec4 water = light_at(light, column_of(ray.direction), row) * (1.0 - left_after(length_m)) +
                 scattered_once(light, ray.direction, mu, length_m);
    // Behind the eye's own window into air again: the square of the index has gone.
    out_radiance = join_radiance((behind + water) / (u_under.w * u_under.w), vec3(0.0));
}
