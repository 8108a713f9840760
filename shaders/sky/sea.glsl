// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Open water as models of the sky light it. C sets the uniforms with sea_water_set.
#ifndef SKY_SEA_GLSL
#define SKY_SEA_GLSL

#include "shared/sea.glsl"
#include "sky/ground.glsl"

// Root of the view's cosine x roughness: reflectance of the surface; y: see Sea.mirror_mu.
uniform sampler2D u_water;
// Depth x row x view: see sky/sea_volume.h.
uniform sampler3D u_sea_volume;
// Cosine of refracted grazing rays, 1 over a step of cosines, 1 over the refractive index, 1 over
// depths.
uniform vec4 u_sea_volume_map;
uniform sampler2D u_facets; // of ocean/facets.h: normal of the waves that are resolved, foam; mean
                            // square slope of the rest
uniform sampler2D u_reflection; // of terrain: see sky/reflection.frag
uniform vec2 u_reflected;       // 1: it covers the sky; its light is added
uniform vec3 u_sea;        // mean square slope of all, refractive index; part of the former that is
                           // the star's disc
uniform float u_sea_texel; // 1 over views of u_water
uniform float u_shadowed;  // 1: shadows of terrain and clouds are the light's

struct Sea {
    vec3 up, normal;
    float level;   // roughness: see sea_level in sky/sea.h
    vec3 mirrored; // the ray that comes from the sky by the mean normal
    float altitude_m;
    float sun_mu, height; // of the star, and of its visible part
    float view_mu;
    float visible;   // part of the star that terrain and clouds leave
    float shed;      // of its light on level water, what clouds shed from all around
    float glint;     // radiance per irradiance of a plane that faces the star
    float seen;      // reflectance of the surface for the view
    float mirror_mu; // cosine of the zenith angle where it mirrors the sky, in the mean
    float entered;   // of the star's
    vec2 white;      // share of the surface that is white, and its albedo
    vec4 by_star;    // of the water below the surface: pi times what leaves it per irradiance
    vec4 by_sky;     // that has entered, by the star; from above, by the sky
    vec4 terrain;    // mirrored, linear sRGB behind the air; part of the mirrored sky that it hides
};

// At a roughness, between its rows.
vec4 surface_at(float mu, float level)
{
    float x = sqrt(clamp(mu, 0.0, 1.0));
    return textureLod(u_water, vec2(x + (0.5 - x) * u_sea_texel, (0.5 + level) / float(SEA_LEVELS)),
                      0.0);
}

// Of light in the water, what one row of its table says.
vec4 volume_at(vec3 at, float row)
{
    float rows = float(SEA_ORDERS * SEA_ANGLES + 1);
    return textureLod(u_sea_volume, vec3(at.x, (row + at.y + 0.5) / rows, at.z), 0.0);
}

// What comes out of the water: rays bend at the mean of the waves that are resolved, light at level
// water.
void look_below(inout Sea sea, vec3 ray, vec3 light, float code)
{
    vec3 sight = refract(ray, sea.normal, u_sea_volume_map.z);
    vec3 sent = (light - sea.up * dot(light, sea.up)) * u_sea_volume_map.z;
    float last = float(SEA_ANGLES - 1);
    float sun_mu = sqrt(max(1.0 - dot(sent, sent), 0.0));
    float view_mu = -dot(sight, sea.up);
    float sun = clamp((sun_mu - u_sea_volume_map.x) * u_sea_volume_map.y, 0.0, last);
    float view = clamp((view_mu - u_sea_volume_map.x) * u_sea_volume_map.y, 0.0, last);
    vec3 at = vec3(code + (0.5 - code) * u_sea_volume_map.w, sun, (view + 0.5) / float(SEA_ANGLES));
    // Both sines times the cosine of the azimuth between, and both squared times that of twice it.
    float along = dot(sent, sight);
    float twice = 2.0 * along * along - dot(sent, sent) * max(1.0 - view_mu * view_mu, 0.0);
    vec4 share = 1.0 + volume_at(at, float(SEA_ANGLES)) * along +
                 volume_at(at, float(2 * SEA_ANGLES)) * twice;
    sea.by_star = exp(volume_at(at, 0.0)) * max(share, 0.0);
    at.y = 0.0;
    sea.by_sky = exp(volume_at(at, float(SEA_ORDERS * SEA_ANGLES)));
}

// Of every second pixel: between the four around, of those that show water.
vec4 sea_terrain()
{
    ivec2 last = textureSize(u_reflection, 0) - 1;
    vec2 at = gl_FragCoord.xy * 0.5 - 0.5;
    vec2 part = fract(at);
    vec4 sum = vec4(0.0);
    float weights = 1.0e-6;
    for (int n = 0; n < 4; n++) {
        ivec2 offset = ivec2(n & 1, n >> 1);
        vec4 texel = texelFetch(u_reflection, clamp(ivec2(floor(at)) + offset, ivec2(0), last), 0);
        vec2 near = mix(1.0 - part, part, vec2(offset));
        float weight = texel.a < 0.0 ? 0.0 : near.x * near.y + 1.0e-4;
        sum += weight * texel;
        weights += weight;
    }
    return sum / weights * u_reflected.yyyx;
}

Sea find_sea(Ray ray, Ground ground)
{
    Sea sea;
    sea.up = normalize(u_eye_up * u_eye.x + ray.direction * ground.distance_m);
    sea.altitude_m = ground.altitude_m;
    sea.sun_mu = dot(sea.up, u_sun);
    sea.height = visible_height(sea.sun_mu, u_disc.y);
    vec4 waves = texelFetch(u_facets, ivec2(gl_FragCoord.xy), 0);
    float stretched = length(waves.xyz);
    sea.normal = waves.xyz / max(stretched, 1.0e-6);
    sea.white = vec2(max(stretched - 1.0, 0.0), SEA_FOAM_ALBEDO);
    float mss = max(waves.w + u_sea.z, 1.0e-6);
    sea.level = clamp(float(SEA_LEVELS - 1) + log2(mss / u_sea.x) * (1.0 / SEA_LEVEL_OCTAVES), 0.0,
                      float(SEA_LEVELS - 1));
    sea.view_mu = clamp(-dot(sea.normal, ray.direction), 0.0, 1.0);
    sea.mirrored = ray.direction + 2.0 * sea.view_mu * sea.normal;
    sea.visible = mix(1.0, ground.star_visible, u_shadowed);
    sea.shed = ground.star_shed * u_shadowed;
    vec3 light = normalize(u_sun + sea.up * (sea.height - sea.sun_mu));
    vec3 facet = normalize(light - ray.direction);
    float light_mu = max(dot(sea.normal, light), 0.0);
    float glint =
        sea_glint(dot(facet, sea.normal), dot(facet, light), sea.view_mu, light_mu, mss, u_sea.y);
    sea.glint = light_mu > 0.0 ? glint * mix(1.0, ground.star_direct, u_shadowed) : 0.0;
    vec4 surface = surface_at(sea.view_mu, sea.level);
    sea.seen = surface.x;
    sea.mirror_mu = surface.y;
    sea.entered = 1.0 - surface_at(sea.height, float(SEA_LEVELS - 1)).x;
    look_below(sea, ray.direction, light, ground.depth_code);
    sea.terrain = sea_terrain();
    return sea;
}

// Of the light from the water, what terrain has sent.
vec3 sea_mirrored_terrain(Sea sea)
{
    return sea.terrain.rgb * (sea.seen * (1.0 - sea.white.x));
}

// The mirrored ray in the mean of the facets.
vec3 sea_mirror(Sea sea)
{
    float mu = clamp(dot(sea.mirrored, sea.up), 0.0, 1.0);
    vec3 along = sea.mirrored - sea.up * dot(sea.mirrored, sea.up);
    float mean = min(mu + max(sea.mirror_mu - sea.view_mu, 0.0), 1.0);
    float level = sqrt(max(1.0 - mean * mean, 0.0));
    return along * (level / max(length(along), 1.0e-6)) + sea.up * mean;
}

// Radiance under light of the star (on a plane that faces it), irradiance of level ground by the
// sky, and the sky's radiance where it is mirrored.
vec4 sea_radiance(Sea sea, vec4 star, vec4 sky, vec4 mirrored)
{
    star *= sea.visible;
    vec4 below = star * (sea.height * sea.entered) * sea.by_star + sky * sea.by_sky;
    vec4 clear = star * sea.glint + mirrored * (sea.seen * (1.0 - sea.terrain.a)) +
                 below * ((1.0 - sea.seen) / SHARED_PI);
    vec4 white = (star * sea.height + sky) * (sea.white.y / SHARED_PI);
    return mix(clear, white, sea.white.x);
}

#endif // SKY_SEA_GLSL
