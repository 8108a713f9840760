// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What horizons are looked for among: the heights of the shadow map, in means of four, and how much
// of the star's light falls there, 1 where all of it falls straight on.
#include "shared/penumbra.glsl"
#include "terrain/shadow_map.glsl"

uniform sampler2D u_shadows; // altitude of the shadow; distance to what casts it; ground; m
uniform vec4 u_texel;        // a texel of u_shadows; sphere's radius, m; star's angular radius
uniform vec3 u_sun;          // local frame

out vec4 o_ground; // altitude, m; light

vec2 shadow_uv(vec2 g)
{
    return 0.5 + 0.5 * g * (1.0 - u_texel.x);
}

vec3 point_at(vec2 g)
{
    vec3 o = map_direction(g);
    float h = textureLod(u_shadows, shadow_uv(g), 0.0).b;
    return o * u_texel.y + (o + vec3(0.0, 0.0, 1.0)) * h;
}

void main()
{
    vec2 g = map_grid(gl_FragCoord.xy);
    vec2 uv = shadow_uv(g);
    vec2 d = vec2(0.5, -0.5) * u_texel.x;
    vec3 mean =
        0.25 *
        (textureLod(u_shadows, uv + d.xx, 0.0).rgb + textureLod(u_shadows, uv + d.xy, 0.0).rgb +
         textureLod(u_shadows, uv + d.yx, 0.0).rgb + textureLod(u_shadows, uv + d.yy, 0.0).rgb);
    vec2 cell = vec2(2.0 / (u_map.x - 1.0), 0.0);
    vec3 n = normalize(cross(point_at(g + cell.xy) - point_at(g - cell.xy),
                             point_at(g + cell.yx) - point_at(g - cell.yx)));
    float sine = dot(u_sun, map_direction(g) + vec3(0.0, 0.0, 1.0));
    float penumbra = max(mean.g, 1.0) * u_texel.z / max(1.0 - sine * sine, 0.01);
    float visible = penumbra_visible((mean.b - mean.r) / max(penumbra, 0.5));
    o_ground = vec4(mean.b, visible * max(dot(n, u_sun), 0.0), 0.0, 0.0);
}
