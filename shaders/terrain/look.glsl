// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Colour, water and normal of the ground at a place: part of terrain/surface.frag.
#ifdef HAS_BIOMES
#include "terrain/biomes.glsl"
#endif

struct Look {
    vec3 root; // square root of the albedo
    float water;
    float depth;     // of the water, as a code of shared/sea.glsl
    vec3 normal;     // local axes
    vec3 region;     // square root of the albedo of the region around
    float open, lit; // what stones leave of an even sky, and of the sun
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

// Open water in a footprint and the code of its depth, where the masks say `water` (see
// terrain_water).
vec2 look_shore(vec3 water, Tangent t, LookGround ground)
{
    vec2 shore = water.xy;
#if defined(HAS_DEPTH) && ELEVATION_COUNT > 0 && !defined(HAS_MEAN_SHORES)
    bool has_bed = any(greaterThan(u_elevation_floors, vec4(LAYER_NO_FLOOR)));
    if (water.x > 0.0 || has_bed) {
        vec2 bed = layers_linear(0.0, LAYER_NO_FLOOR, t.ground, t.log2_footprint);
        float around = layers_altitude_linear(0.0, t.ground, max(t.log2_footprint, water.z + 1.0));
        float texel = exp2(water.z);
        float fine = shore_fine(water.z - ground.log2_texel);
        ShoreWater w =
            shore_water(Shore(water.x, water.y, exp2(t.log2_footprint - water.z), bed.x, bed.y,
                              around, fine, ground.steep, shore_made(ground.shore / texel), texel));
        shore = vec2(w.part, w.code);
    }
#endif
    return shore;
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
const float LOOK_STONE_STEEP = 1.2; // slope of ground whose colour stones have
const float LOOK_STONE_CLEAN = 0.6; // the part of it that dust and lichens leave

// Linear albedo of rock, and how much of its colour is that of the pictures, where that is no
// brighter; tangents of the slopes from which, and above which, it is bare, and 1 where it is told.
uniform vec4 u_rock;
uniform vec4 u_rock_slopes;

const vec3 LOOK_LUMINANCE = vec3(0.2126, 0.7152, 0.0722);

// Where stones lie bare: not in water, on cliffs, and below what is brighter than soil, as snow and
// salt are.
float look_bare(vec3 albedo, float water)
{
    float bright = smoothstep(0.4, 0.7, dot(albedo, LOOK_LUMINANCE));
    return (1.0 - water) * (1.0 - bright) * (1.0 - rock.part);
}

// Ground with stones: their mean is what the ground has from afar.
vec3 look_stony(vec3 ground, vec3 stone, float bare)
{
    float cover = bare * stones.cover;
    vec3 soil = max((ground - cover * stone) / (1.0 - cover), 0.6 * ground);
    return mix(soil, stone, bare * stones.part);
}

// Snow and soil slide off what is steeper than their angle of repose, and leave rock, as of stones.
// Square roots. What is too steep or too flat to be seen counts by its spread.
vec3 look_weathered(vec3 root, float tone, float slope, float spread, float bare)
{
    vec3 c = root * root;
    vec3 tinted = c * min(1.0, dot(u_rock.rgb, LOOK_LUMINANCE) / max(dot(c, LOOK_LUMINANCE), 1e-3));
    vec3 rock = mix(u_rock.rgb, tinted, u_rock.a);
    c = look_stony(c, mix(c, rock, LOOK_STONE_CLEAN * u_rock_slopes.z), bare);
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

#ifdef HAS_BIOMES
// Linear albedo of a place, the region around, which is its own where a pixel is larger, and of
// stones, which is that of steep ground.
void look_biomes(BiomePlace place, Relief r, float log2_footprint, inout vec3 albedo,
                 inout vec3 region, inout vec3 stone)
{
    float steep = place.place.y;
    place.slope_spread = sqrt(r.unseen);
    place.height_spread = sqrt(r.unseen_height2);
    int last = stones.cover > 0.0 ? 3 : log2_footprint < u_region ? 2 : 1;
    int k = 0;
    do {
        place.tone = k == 1 ? 0.0 : r.tone;
        place.place.y = k == 2 ? max(steep, LOOK_STONE_STEEP) : steep;
        stone = biome_albedo(u_default_albedo, place);
        albedo = k == 0 ? stone : albedo;
        region = k < 2 ? stone : region;
        k++;
    } while (k < last);
}
#endif

// With stones, and what is too small for heights where it is steep.
vec3 look_normal(vec3 up, vec3 slope, float dry, float bare)
{
    vec3 n = normalize(up - dry * slope - bare * stones.slope);
    RockNormal rough =
        relief_rock_normal(RockNormal(n.x, n.y, n.z),
                           NoiseValue(0.0, dry * rock.sum.x, dry * rock.sum.y, dry * rock.sum.z));
    return vec3(rough.x, rough.y, rough.z);
}

Look find_look(Tangent t, LookPlace p)
{
    NoiseBase base = ground_base(t, p.quad_footprint, p.altitude);
    rock.ray = p.ray;
    rock.log2_pixel = p.log2_pixel;
    Relief r = noise_compose(base, p.at * u_anchor.w, t.up);
    vec3 slope = terrain_slope(vec4(r.x, r.y, r.z, base.view.texel), t).xyz;
    slope -= t.up * dot(slope, t.up);
    vec3 standing = slope - vec3(r.x - r.fall_x, r.y - r.fall_y, r.z - r.fall_z);
    float steep = length(standing - t.up * dot(standing, t.up));
    Look look;
    vec3 water = terrain_water(t.ground, t.log2_footprint);
    vec2 shore = look_shore(water, t, LookGround(length(base.slope), base.view.texel, r.shore));
    look.water = shore.x;
    look.depth = shore.y;
    vec3 albedo = u_default_albedo;
    vec3 region = u_default_albedo;
    vec3 stone = u_default_albedo;
    float sea = 0.0;
#ifdef HAS_GROUND
    sea = look_sea(r.height, steep * steep + r.unseen, exp2(t.log2_footprint));
#ifdef HAS_DEPTH
    look.depth = sea > look.water ? sea_depth_code(u_noise_form.w - r.height) : look.depth;
#endif
    look.water = max(look.water, sea);
#endif
    float dry = 1.0 - look.water;
    r.tone += dry * (rock.sum.value - 0.5 * rock.part * r.tone);
#ifdef HAS_BIOMES
    BiomePlace place =
        biome_place(r.height - r.passing, steep, u_anchor.z + t.ground.geo.y, base.view.climate);
    look_biomes(place, r, t.log2_footprint, albedo, region, stone);
#endif
#ifdef HAS_GROUND
    float bare = look_bare(region, look.water);
    albedo = look_stony(albedo, mix(region, stone, LOOK_STONE_CLEAN), bare);
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
    float bare = look_bare(look.region * look.region, look.water);
    look.root = look_weathered(look.root, dry * r.tone, dry * steep, dry * sqrt(r.unseen), bare);
#endif
    look.open = mix(1.0, stones.open, bare);
    look.lit = mix(1.0, stones.lit, bare);
    look.normal = look_normal(t.up, slope, dry, bare);
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
    vec2 shore = look_shore(water, t, LookGround(length(slope.xyz), slope.w, 0.0));
    vec3 region = terrain_albedo(root, t.ground, max(t.log2_footprint, u_region));
    return Look(terrain_albedo(root, t.ground, t.log2_footprint), shore.x, shore.y,
                normalize(t.up - slope.xyz), look_region(region, t, 0.0), 1.0, 1.0);
}
#endif
