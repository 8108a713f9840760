// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The waves around an eye, summed at a place. The C side is src/ocean/wave_texture.c.
#include "shared/gerstner.glsl"
#include "shared/sea.glsl"

uniform highp sampler2D u_waves; // 7 x groups of 4 waves, the longest first
uniform int u_wave_groups;
uniform vec4 u_wave_range; // radius of the sea (m), distance of the eye from the centre (m), mean
                           // square slope of what is shorter than all waves; breaking wavenumber
                           // of shared/sea.glsl
uniform mat3 u_wave_local_from_planet;

// Beyond this part of the radius no wave is looked at: series of angles end there.
#define WAVES_REACH 0.19

GerstnerPlace waves_place(vec3 from_eye)
{
    vec3 local = u_wave_local_from_planet * from_eye;
    return gerstner_place(local.x, local.y, local.z + u_wave_range.y);
}

GerstnerWave waves_fetch(int group, int lane)
{
    float v[7];
    for (int i = 0; i < 7; i++) {
        v[i] = texelFetch(u_waves, ivec2(i, group), 0)[lane];
    }
    return GerstnerWave(v[0], v[1], v[2], v[3], v[4], v[5], v[6]);
}

// Where waves are looked at: a window whose sides along the ground are `x` and `y` (m, axes of the
// anchor), `least` the shorter one; and how deep the water is, m.
struct WavesWindow {
    vec2 x, y;
    float least, depth;
};

// All waves at a place. What is not shown is in lost_square.
GerstnerSum waves_sum(GerstnerPlace p, WavesWindow window)
{
    GerstnerSum sum = gerstner_level();
    float near = 1.0 - smoothstep(0.5 * WAVES_REACH, WAVES_REACH, length(vec2(p.vx, p.vy)));
    bool is_seen = true;
    for (int g = 0; g < u_wave_groups; g++) {
        for (int lane = 0; lane < 4; lane++) {
            GerstnerWave w = waves_fetch(g, lane);
            w.amplitude *= gerstner_shoal(w.wavenumber, window.depth);
            is_seen = is_seen && near * gerstner_weight(w.wavenumber * window.least, 0.0) >
                                     GERSTNER_LEAST_WEIGHT;
            float steep = w.amplitude * w.wavenumber;
            float press = steep * sea_breaking(w.wavenumber, u_wave_range.w);
            sum.press_square += 0.5 * press * press;
            if (!is_seen) {
                sum.lost_square += 0.5 * steep * steep;
                sum.press_lost += 0.5 * press * press;
                continue;
            }
            GerstnerRipple r =
                gerstner_ripple(w, p, u_wave_range.x, gerstner_small_angle(gerstner_turn(w, p)));
            vec2 d = vec2(r.dx, r.dy) * w.wavenumber;
            float weight = near * gerstner_weight(dot(d, window.x), dot(d, window.y));
            sum = gerstner_add(sum, w, r, weight);
            sum.press += press * weight * r.sine;
            sum.press_lost += 0.5 * press * press * (1.0 - weight * weight);
        }
    }
    sum.lost_square += u_wave_range.z;
    return sum;
}
