// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The formulas that C and GLSL share, at the arguments of a test.
#include "shared/albedo.glsl"
#include "shared/blend.glsl"
#include "shared/eclipse.glsl"
#include "shared/penumbra.glsl"
#include "shared/phase.glsl"
#include "shared/profile.glsl"
#include "shared/projection.glsl"
#include "shared/sea.glsl"
#include "shared/shore.glsl"
#include "shared/sky_map.glsl"

uniform vec4 u_angle; // cosine, g
uniform vec4 u_shell; // altitude, scale height, centre, half width
uniform vec4 u_map;   // distance, its largest, cosine of a zenith angle, altitude
uniform float u_wants_profile;
uniform float u_wants_map;
uniform float u_wants_outside;
uniform float u_wants_shadow;
uniform float u_wants_eclipse;
uniform float u_wants_blend;
uniform float u_wants_cover;
uniform float u_wants_sea;
uniform float u_wants_projection; // 1 the offset, 2 the map
uniform vec4 u_place;             // latitude of the anchor; offsets in longitude and latitude; pole
layout(location = 0) out vec4 o_color;

void main()
{
    vec4 phases = vec4(phase_isotropic(), phase_rayleigh(u_angle.x),
                       phase_henyey_greenstein(u_angle.x, u_angle.y),
                       phase_cornette_shanks(u_angle.x, u_angle.y));
    vec4 profiles = vec4(profile_exponential(u_shell.x, u_shell.y),
                         profile_tent(u_shell.x, u_shell.z, u_shell.w), 0.0, 0.0);
    float lowest = sky_map_lowest_sun(6371000.0, u_map.w, 0.99998915, 0.0046529);
    vec4 maps =
        vec4(sky_map_view(u_map.x, 1000.0, u_map.y), sky_map_sun(u_map.z, -0.07, 0.07, -2.0, 3.4),
             sky_map_sunlight(u_map.z, lowest, 0.01), sky_map_depth(u_map.x, 1000.0, u_map.y));
    vec4 shadows = vec4(penumbra_visible(u_angle.x), penumbra_mean(u_angle.x, u_angle.y), 0.0, 0.0);
    SkyMapSuns suns = sky_map_suns(7.0e6, u_map.x, 6.5e6, -0.4, u_map.z);
    vec4 outside = vec4(sky_map_ground_row_outside(u_map.x, 1000.0, u_map.y),
                        sky_map_depth_outside(u_map.x, 1000.0, 700000.0, u_map.y, 0.5), suns.middle,
                        suns.reach);
    vec4 eclipses = vec4(eclipse_visible(u_angle.x, u_angle.y), eclipse_corona(u_angle.x),
                         eclipse_shadow(u_shell.x, u_shell.y, 1737400.0, 0.0046529), 0.0);
    vec4 blends =
        vec4(blend_layers(u_shell.x, u_angle.x, u_angle.y, u_shell.y),
             u_wants_cover > 0.5 ? albedo_cover(u_angle.x, u_angle.y, u_shell.x, u_shell.y)
                                 : blend_slope(u_shell.x, u_angle.x, u_angle.y, 3.0, 4.0),
             blend_neutral(u_shell.x, u_angle.x), albedo_varied(u_angle.x, u_shell.x));
    float anchor_sine = sin(u_place.x);
    float anchor_cosine = cos(u_place.x);
    AxisOffset offset = projection_axis_offset(anchor_sine, anchor_cosine, u_place.y, u_place.z);
    MapOffset map =
        projection_stereographic(offset, anchor_sine, anchor_cosine, u_place.w, 0.0066943799, 1.0);
    vec4 projections =
        vec4(map.x, map.y, projection_stereographic_scale(anchor_sine, offset.up, u_place.w), 0.0);
    projections =
        u_wants_projection < 1.5 ? vec4(offset.outward, offset.east, offset.up, 0.0) : projections;
    vec4 seas = vec4(fresnel_reflectance(u_angle.x, u_angle.y), sea_hidden(u_angle.x, u_shell.x),
                     sea_glint(u_angle.x, 0.8, u_shell.y, u_shell.z, u_shell.x, 1.34),
                     sea_code_depth(sea_depth_code(u_shell.w)));
    ShoreWater shores[2];
    for (int k = 0; k < 2; k++) {
        shores[k] = shore_water(Shore(u_angle.x, 1.0 - float(k), u_angle.y, u_shell.x,
                                      2.0 * (u_wants_sea - 2.0), u_shell.y, u_angle.z, u_shell.z,
                                      u_shell.w, 4000.0));
    }
    seas = u_wants_sea > 1.5 ? vec4(shores[0].part, shores[1].part, shores[0].code, shores[1].code)
                             : seas;
    seas = u_wants_sea > 2.5
               ? vec4(sea_foam(3.0 * u_angle.x, u_shell.x, u_shell.z + 1.0, u_shell.y))
               : seas;
    o_color = u_wants_sea > 0.5          ? seas
              : u_wants_projection > 0.5 ? projections
              : u_wants_blend > 0.5      ? blends
              : u_wants_eclipse > 0.5    ? eclipses
              : u_wants_outside > 0.5    ? outside
              : u_wants_shadow > 0.5     ? shadows
              : u_wants_map > 0.5        ? maps
                                         : (u_wants_profile > 0.5 ? profiles : phases);
}
