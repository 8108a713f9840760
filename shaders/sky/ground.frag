// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Radiance of pixels with ground: lit by star and sky, behind air. With SURFACE the ground comes
// from the surface buffers, else it is the bare reference sphere.
// validate: PEAKED_COUNT 1
// validate: PEAKED_COUNT 0
// validate: PEAKED_COUNT 3; SURFACE

#include "sky/air.glsl"
#include "sky/colour.glsl"

in vec2 v_uv;

uniform vec4 u_ground_light; // lowest and highest tabulated altitude, softness, 1 over altitudes
uniform vec4 u_disc; // cosine and sine of the disc's radius, pixel angle, 1 over suns in u_sunlight
uniform float u_skylight_texel; // 1 over suns in u_skylight
uniform sampler2D u_sunlight;
uniform sampler2D u_skylight;
uniform vec4 u_ground_albedo; // in the bands, of the bare sphere and of the land around

#ifdef SURFACE
uniform sampler2D u_position;     // xyz relative to the camera, m; w altitude, m, or below -1e8
uniform sampler2D u_albedo;       // square root of linear sRGB
uniform sampler2D u_normal;       // xyz unit; w how much of the star terrain leaves
uniform sampler2D u_lights;       // square root of linear sRGB
uniform vec4 u_bands_from_rgb[3]; // columns
uniform vec4 u_bands_of_light[3]; // columns: bands that show lights of this colour
#endif

layout(location = 0) out vec4 out_radiance;

struct Ground {
    float distance_m;
    float altitude_m;
    vec3 normal;
    vec4 albedo;
    float star_visible;
    vec4 emitted;
};

// Mean height of the star's visible part above the level ground, as a cosine: the direct light is
// already that of this part alone. Half a disc has its centroid at 4 / (3 pi) of its radius;
// between
// none, half and all a parabola.
float visible_height(float sun_mu, float disc_sine)
{
    float c = clamp(sun_mu / disc_sine, -1.0, 1.0);
    return sun_mu > disc_sine ? sun_mu : disc_sine * (c + 1.0) * (0.424 + 0.076 * c);
}

vec4 light_ground(Ray ray, Ground ground)
{
    vec3 up = normalize(u_eye_up * u_eye.x + ray.direction * ground.distance_m);
    float sun_mu = dot(up, u_sun);
    float altitude =
        centre(clamp((ground.altitude_m - u_ground_light.x) / (u_ground_light.y - u_ground_light.x),
                     0.0, 1.0),
               u_ground_light.w);
    float lowest = sky_map_lowest_sun(u_planet.x, ground.altitude_m, u_disc.x, u_disc.y);
    float sun = sky_map_sunlight(sun_mu, lowest, u_ground_light.z);
    vec4 star = textureLod(u_sunlight, vec2(centre(sun, u_disc.w), altitude), 0.0);
    float day = sky_map_sun(sun_mu, u_sun_grid.x, u_sun_grid.y, u_sun_grid.z, u_sun_grid.w);
    vec4 sky = exp(textureLod(u_skylight, vec2(centre(day, u_skylight_texel), altitude), 0.0));
    // A slope sees a part of the sky, and for the rest the ground around it.
    float open = 0.5 + 0.5 * dot(ground.normal, up);
    float height = visible_height(sun_mu, u_disc.y);
    float incidence = max(dot(ground.normal, u_sun + up * (height - sun_mu)), 0.0);
    vec4 around = u_ground_albedo * (star * height + sky);
    vec4 irradiance = star * (incidence * ground.star_visible) + sky * open + around * (1.0 - open);
    return ground.albedo * irradiance * (1.0 / SHARED_PI) + ground.emitted;
}

#ifdef SURFACE
Ground find_ground(out Ray ray)
{
    Ground ground;
    vec4 position = texelFetch(u_position, ivec2(gl_FragCoord.xy), 0);
    float distance_m = length(position.xyz);
    ray = make_ray(position.xyz / max(distance_m, 1.0e-6));
    vec4 albedo = texelFetch(u_albedo, ivec2(gl_FragCoord.xy), 0);
    vec4 normal = texelFetch(u_normal, ivec2(gl_FragCoord.xy), 0);
    vec4 lights = texelFetch(u_lights, ivec2(gl_FragCoord.xy), 0);
    vec3 rgb = albedo.rgb * albedo.rgb;
    vec3 lit = lights.rgb * lights.rgb;
    ground.distance_m = distance_m;
    ground.altitude_m = position.w;
    ground.normal = normal.xyz;
    ground.albedo =
        max(u_bands_from_rgb[0] * rgb.r + u_bands_from_rgb[1] * rgb.g + u_bands_from_rgb[2] * rgb.b,
            vec4(0.0));
    ground.star_visible = normal.w;
    ground.emitted =
        max(u_bands_of_light[0] * lit.r + u_bands_of_light[1] * lit.g + u_bands_of_light[2] * lit.b,
            vec4(0.0));
    return ground;
}
#else
Ground find_ground(out Ray ray)
{
    Ground ground;
    ray = make_pixel_ray(v_uv);
    ray.meets_ground = true; // what sort.frag has found counts, in case of rounding
    ray.end_m = ray.ground_m;
    ground.distance_m = ray.ground_m;
    ground.altitude_m = 0.0;
    ground.normal = normalize(u_eye_up * u_eye.x + ray.direction * ray.ground_m);
    ground.albedo = u_ground_albedo;
    ground.star_visible = 1.0;
    ground.emitted = vec4(0.0);
    return ground;
}
#endif

void main()
{
    Ray ray;
    Ground ground = find_ground(ray);
    Air air = air_before(ray, ground.distance_m);
    out_radiance = join_radiance(light_ground(ray, ground) * air.transmittance, air.scattered);
}
