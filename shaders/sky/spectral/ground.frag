// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels with ground: lit by star and sky, behind air. With SURFACE the ground comes
// from the surface buffers, else it is the bare reference sphere. With MOON a body stands for the
// star, and its light is added to what is there. With SEA open water is drawn by sea.frag, and is
// black here.
// validate: PEAKED_COUNT 1
// validate: PEAKED_COUNT 0
// validate: PEAKED_COUNT 3; SURFACE
// validate: PEAKED_COUNT 1; SURFACE; MARCH
// validate: PEAKED_COUNT 1; SURFACE; MARCH; ECLIPSE
// validate: PEAKED_COUNT 1; ECLIPSE
// validate: PEAKED_COUNT 1; MOON
// validate: PEAKED_COUNT 1; SURFACE; MOON
// validate: PEAKED_COUNT 1; SURFACE; SEA
// validate: PEAKED_COUNT 1; SURFACE; MARCH; CLOUDS
// validate: PEAKED_COUNT 1; CLOUDS

#include "shared/sky_view.glsl"
#include "sky/ground.glsl"
#include "sky/spectral/air.glsl"
#include "sky/spectral/colour.glsl"
#ifdef ECLIPSE
#include "sky/eclipse.glsl"
#endif

uniform vec4 u_ground_light; // lowest and highest tabulated altitude, softness, 1 over altitudes
uniform vec2 u_light_texel;  // 1 over suns in u_sunlight, in u_skylight
uniform sampler2D u_sunlight;
uniform sampler2D u_skylight;
uniform vec4 u_ground_albedo; // in the bands, of the bare sphere and of the land around

#ifdef SURFACE
uniform vec4 u_bands_from_rgb[3]; // columns
uniform vec4 u_bands_of_light[3]; // columns: bands that show lights of this colour
uniform sampler2D u_bounce;       // as u_extinction: see scatter/aerial.h
uniform sampler2D u_air_albedo;   // of the air above an altitude, from below
uniform sampler2D u_rising;       // as u_skylight: light from below, over the mean ground
#endif

#ifdef MOON
uniform float u_shadowed; // 1: shadows of terrain and clouds are the body's; 0: there are none
#endif

layout(location = 0) out vec4 out_radiance;

#ifdef SURFACE
vec4 bands_of(vec3 albedo)
{
    return max(u_bands_from_rgb[0] * albedo.r + u_bands_from_rgb[1] * albedo.g +
                   u_bands_from_rgb[2] * albedo.b,
               vec4(0.0));
}
#endif

#ifdef SURFACE
vec4 sent_again(float view, vec4 albedo)
{
    return vec4(sky_view_again(view, albedo.x), sky_view_again(view, albedo.y),
                sky_view_again(view, albedo.z), sky_view_again(view, albedo.w));
}
#endif

vec4 ground_emitted(Ground ground)
{
#ifdef SURFACE
    return max(u_bands_of_light[0] * ground.lights.r + u_bands_of_light[1] * ground.lights.g +
                   u_bands_of_light[2] * ground.lights.b,
               vec4(0.0));
#else
    return vec4(0.0);
#endif
}

// In the bands: the ground, and what the air before it adds because the region sends another light
// than what rises at its altitude over the sphere, for which the air's light is solved.
struct Light {
    vec4 ground, bounced;
};

Light light_ground(Ray ray, Ground ground, Air air)
{
    vec3 up = normalize(u_eye_up * u_eye.x + ray.direction * ground.distance_m);
    float sun_mu = dot(up, u_sun);
    float altitude =
        centre(clamp((ground.altitude_m - u_ground_light.x) / (u_ground_light.y - u_ground_light.x),
                     0.0, 1.0),
               u_ground_light.w);
    float lowest = sky_map_lowest_sun(u_planet.x, ground.altitude_m, u_disc.x, u_disc.y);
    float sun = sky_map_sunlight(sun_mu, lowest, u_ground_light.z);
    vec4 star = textureLod(u_sunlight, vec2(centre(sun, u_light_texel.x), altitude), 0.0);
    float day = sun_coordinate(sun_mu);
    vec4 sky = exp(textureLod(u_skylight, vec2(centre(day, u_light_texel.y), altitude), 0.0));
    float height = visible_height(sun_mu, u_disc.y);
    vec4 level = star * height + sky;
#ifdef SURFACE
    vec4 rising = exp(textureLod(u_rising, vec2(centre(day, u_light_texel.y), altitude), 0.0));
#endif
#ifdef ECLIPSE
    vec3 place = ray.direction * ground.distance_m;
    float left = star_left(place);
    star *= left;
    sky *= ground_left(place, left);
    vec4 lit = star * height + sky;
#ifdef SURFACE
    rising *= lit / max(level, vec4(1.0e-20));
#endif
    level = lit;
#endif
    // What clouds shed of the star's light is the sky's.
    vec3 cloudy =
        cloud_sky(ray.direction * ground.distance_m, ground.altitude_m, sun_mu, ground.star_shed);
    vec4 under = star * (height * cloudy.z) + sky * cloudy.x;
    sky = sky * cloudy.x + star * (height * ground.star_shed);
    float incidence = max(dot(ground.normal, u_sun + up * (height - sun_mu)), 0.0);
    Light light;
#ifdef SURFACE
    // Between ground and air light goes back and forth: a series of air_albedo albedo.
    vec4 own = bands_of(ground.albedo);
    vec4 region = bands_of(ground.region);
    vec4 above = textureLod(u_air_albedo, vec2(0.5, altitude), 0.0);
    vec4 whole = textureLod(u_air_albedo, vec2(0.5, 0.0), 0.0);
    rising *= under / max(level, vec4(1.0e-20));
    level = under;
    vec4 gain = (1.0 - above * min(rising / max(level, vec4(1.0e-20)), vec4(1.0))) /
                (1.0 - (above + cloudy.y) * region);
    vec4 around = region * level * gain;
    sky += level * (gain - 1.0);
    // A slope sees a part of the sky, and for the rest the ground around it, among terrain itself.
    float open = ground.open;
    light.bounced = (around - rising) * (1.0 / SHARED_PI) * air.way *
                    textureLod(u_bounce, air.at, 0.0) * (1.0 - above) / (1.0 - whole);
    float seen = (ground.around_lit < 0.0 ? max(height, 0.0) : ground.around_lit) *
                 (cloudy.z - ground.star_shed);
    around = region * (star * seen + sky * open) * sent_again(open, region);
#else
    vec4 own = u_ground_albedo;
    vec4 around = own * under;
    sky += under * (1.0 / (1.0 - cloudy.y * own) - 1.0);
    float open = 1.0;
    light.bounced = vec4(0.0);
#endif
    vec4 irradiance = star * (incidence * ground.star_visible) + sky * open + around * (1.0 - open);
#ifdef SEA
    own *= 1.0 - ground.water;
#endif
    light.ground = own * irradiance * (1.0 / SHARED_PI) + ground_emitted(ground);
    return light;
}

void main()
{
    Ray ray;
    Ground ground = find_ground(ray);
#ifdef MOON
    ground.star_visible = mix(1.0, ground.star_visible, u_shadowed);
    ground.star_shed *= u_shadowed;
#endif
    Air air = air_before(ray, ground.distance_m);
#ifdef MARCH
    air.scattered *= share_before(v_uv, ray, ground.distance_m);
#endif
    Light light = light_ground(ray, ground, air);
    out_radiance = join_radiance(light.ground * air.transmittance + light.bounced, air.scattered);
}
