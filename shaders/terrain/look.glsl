// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Colour, water and normal of the ground at a place: part of terrain/surface.frag.
#ifdef HAS_BIOMES
#include "terrain/biomes.glsl"
#endif

struct Look {
    vec3 root; // square root of the albedo
    float water;
    float depth; // of the water, as a code of shared/sea.glsl
    vec3 normal; // local axes
    vec3 region; // square root of the albedo of the region around
};

// The direction less the anchor's; log2 of a footprint that is one for 2 x 2 pixels; altitude in m.
struct LookPlace {
    vec3 at;
    float quad_footprint, altitude;
    vec3 ray;         // to it from the camera, unit, local axes
    float log2_pixel; // of a pixel's width there, m
};

// Of the ground at a place: its slope, log2 of a texel of its heights, how far made-up detail has
// the shore (m).
struct LookGround {
    float steep, log2_texel, shore;
};

// Part of a footprint that is open water, where the masks say `water` (see terrain_water).
float look_shore(vec3 water, Tangent t, LookGround ground)
{
    float part = water.x;
#if defined(HAS_DEPTH) && ELEVATION_COUNT > 0 && !defined(HAS_MEAN_SHORES)
    // No branch, but a loop that dry ground does not enter.
    int count = water.x > 0.0 ? 1 : 0;
    for (int i = 0; i < count; i++) {
        float altitude = layers_altitude_linear(0.0, t.ground, t.log2_footprint);
        float around = layers_altitude_linear(0.0, t.ground, max(t.log2_footprint, water.z + 1.0));
        around *= 1.0 - shore_fine(water.z - ground.log2_texel);
        float width = exp2(t.log2_footprint);
        part = shore_water(Shore(water.x, width * exp2(-water.z), water.y > 0.5 / 255.0 ? 1.0 : 0.0,
                                 altitude, around, width * ground.steep,
                                 shore_made(ground.shore * exp2(-water.z))));
    }
#endif
    return part;
}

// Its depth as a code of shared/sea.glsl.
float look_shore_depth(vec3 water, float log2_texel)
{
    return shore_depth(water.y, water.x, shore_fine(water.z - log2_texel));
}

// Square root of the albedo around, of land with that one and of what sea the masks have there, or
// made-up ground has here.
vec3 look_region(vec3 root, Tangent t, float made_sea)
{
#ifdef HAS_DEPTH
    float sea = max(terrain_water(t.ground, max(t.log2_footprint, u_region)).x, made_sea);
    return sqrt(mix(root * root, u_sea_albedo, sea));
#else
    return root;
#endif
}

#ifdef HAS_NOISE
// Linear albedo of rock, and how much of its colour is that of the pictures, where that is no
// brighter; tangents of the slopes from which, and above which, it is bare.
uniform vec4 u_rock;
uniform vec4 u_rock_slopes;

// Snow and soil slide off what is steeper than their angle of repose, and leave rock. Square roots.
// What is too steep or too flat to be seen counts by its spread.
vec3 look_weathered(vec3 root, float tone, float slope, float spread)
{
    const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);
    vec3 c = root * root;
    vec3 tinted = c * min(1.0, dot(u_rock.rgb, LUMINANCE) / max(dot(c, LUMINANCE), 1e-3));
    vec3 rock = mix(u_rock.rgb, tinted, u_rock.a);
    c = mix(c, rock, smoothstep(u_rock_slopes.x - spread, u_rock_slopes.y + spread, slope));
    float paler = max(1.0 + u_noise_more.z * tone, 0.1);
    return sqrt(
        vec3(albedo_varied(c.r, paler), albedo_varied(c.g, paler), albedo_varied(c.b, paler)));
}

// The part of a footprint that is below the level of the sea. Waves and shallows are the ocean's.
float look_sea(float height, float slope2, float footprint)
{
    float shore = footprint * sqrt(slope2) + 0.1;
    return clamp(0.5 - (height - u_noise_form.w) / shore, 0.0, 1.0);
}

Look find_look(Tangent t, LookPlace p)
{
    NoiseBase base = ground_base(t, p.quad_footprint, p.altitude);
    rock.ray = p.ray;
    rock.log2_pixel = p.log2_pixel;
    Relief r = noise_compose(base, p.at * u_anchor.w, t.up);
    vec3 slope = terrain_slope(vec4(r.x, r.y, r.z, base.view.texel), t).xyz;
    slope -= t.up * dot(slope, t.up);
    float steep = length(slope);
    Look look;
    vec3 water = terrain_water(t.ground, t.log2_footprint);
    look.water = look_shore(water, t, LookGround(length(base.slope), base.view.texel, r.shore));
    look.depth = look_shore_depth(water, base.view.texel);
    vec3 albedo = u_default_albedo;
    vec3 region = u_default_albedo;
    float sea = 0.0;
#ifdef HAS_GROUND
    sea = look_sea(r.height, steep * steep + r.unseen, exp2(t.log2_footprint));
#ifdef HAS_DEPTH
    look.depth = sea > look.water ? sea_depth_code(u_noise_form.w - r.height) : look.depth;
#endif
    look.water = max(look.water, sea);
#endif
    r.tone += (1.0 - look.water) * (rock.sum.value - 0.5 * rock.part * r.tone);
#ifdef HAS_BIOMES
    BiomePlace place =
        biome_place(r.height - r.passing, steep, u_anchor.z + t.ground.geo.y, base.climate);
    place.tone = r.tone;
    place.slope_spread = sqrt(r.unseen);
    place.height_spread = sqrt(r.unseen_height2);
    // A loop, since a branch would cost as much: the region is the pixel's own where that is
    // larger.
    for (int k = 0; k < (t.log2_footprint < u_region ? 2 : 1); k++) {
        region = biome_albedo(u_default_albedo, place);
        albedo = k == 0 ? region : albedo;
        place.tone = 0.0;
    }
#endif
#ifdef HAS_COVERS
    float variance = noise_height_variance(base.view);
    cover = Cover((r.height - base.height) * inversesqrt(max(variance, 1e-6)),
                  clamp(r.unseen_height2 / max(variance, 1e-6), 0.0, 1.0), sqrt(variance),
                  base.view.texel);
#endif
    look.root = terrain_albedo(sqrt(clamp(albedo, 0.0, 1.0)), t.ground, t.log2_footprint);
#ifdef HAS_COVERS
    cover.height = 0.0;
    cover.hidden = 1.0;
#endif
    look.region =
        terrain_albedo(sqrt(clamp(region, 0.0, 1.0)), t.ground, max(t.log2_footprint, u_region));
    look.region = look_region(look.region, t, sea);
#ifndef HAS_GROUND
    float land = 1.0 - look.water;
    look.root = look_weathered(look.root, land * r.tone, land * steep, land * sqrt(r.unseen));
#endif
    look.normal = normalize(t.up - (1.0 - look.water) * slope);
    RockNormal smooth_normal = RockNormal(look.normal.x, look.normal.y, look.normal.z);
    float dry = 1.0 - look.water;
    RockNormal rough = relief_rock_normal(
        smooth_normal, NoiseValue(0.0, dry * rock.sum.x, dry * rock.sum.y, dry * rock.sum.z));
    look.normal = vec3(rough.x, rough.y, rough.z);
    return look;
}
#else
Look find_look(Tangent t, LookPlace p)
{
    vec4 flat_ground = vec4(0.0, 0.0, 0.0, SLOPE_NO_DATA);
    ReliefData data;
    vec4 slope = terrain_slope(layers_slope(flat_ground, 0.0, t, data), t);
    vec3 root = sqrt(u_default_albedo);
    vec3 water = terrain_water(t.ground, t.log2_footprint);
    float part = look_shore(water, t, LookGround(length(slope.xyz), slope.w, 0.0));
    vec3 region = terrain_albedo(root, t.ground, max(t.log2_footprint, u_region));
    return Look(terrain_albedo(root, t.ground, t.log2_footprint), part,
                look_shore_depth(water, slope.w), normalize(t.up - slope.xyz),
                look_region(region, t, 0.0));
}
#endif
