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
uniform vec3 u_wave_all;   // of all waves in deep water: mean square slope, mean square of what
                           // presses; the largest wavenumber
uniform mat3 u_wave_local_from_planet;

// Beyond this part of the radius no wave is looked at: series of angles end there.
#define WAVES_REACH 0.19

GerstnerPlace waves_place(vec3 from_eye)
{
    vec3 local = u_wave_local_from_planet * from_eye;
    return gerstner_place(local.x, local.y, local.z + u_wave_range.y);
}

// Where waves are looked at: a window whose sides along the ground are `x` and `y` (m, axes of the
// anchor), `least` the shorter one; and how deep the water is, m.
struct WavesWindow {
    vec2 x, y;
    float least, depth;
};

// One more, which makes foam by the press that it has in deep water: what shallow water takes of a
// wave has broken.
GerstnerSum waves_add(GerstnerSum sum, GerstnerWave w, GerstnerPlace p, WavesWindow window,
                      float near, float press)
{
    GerstnerRipple r =
        gerstner_ripple(w, p, u_wave_range.x, gerstner_small_angle(gerstner_turn(w, p)));
    vec2 d = vec2(r.dx, r.dy) * w.wavenumber;
    float sides2 = dot(window.x, window.x) + dot(window.y, window.y);
    float weight =
        near * gerstner_weight_of(dot(d, window.x), dot(d, window.y), w.wavenumber, sides2);
    sum = gerstner_add(sum, w, r, weight);
    sum.press += press * weight * r.sine;
    sum.press_square += 0.5 * press * press;
    sum.press_lost += 0.5 * press * press * (1.0 - weight * weight);
    return sum;
}

// Mean square slope of the waves that are left, in water of a depth: that leaves of all what it
// leaves of one in their middle.
float waves_left(float square, float longest, float depth)
{
    float shoal = gerstner_shoal(sqrt(longest * max(u_wave_all.z, longest)), depth);
    return max(square, 0.0) * (shoal * shoal);
}

// A group of four. `left`: as u_wave_all.xy, of what is not summed yet.
GerstnerSum waves_add_group(GerstnerSum sum, int group, GerstnerPlace p, WavesWindow window,
                            float near, inout vec2 left)
{
    vec4 v[7];
    for (int i = 0; i < 7; i++) {
        v[i] = texelFetch(u_waves, ivec2(i, group), 0);
    }
    for (int i = 0; i < 4; i++) {
        GerstnerWave w =
            GerstnerWave(v[0][i], v[1][i], v[2][i], v[3][i], v[4][i], v[5][i], v[6][i]);
        float steep = w.amplitude * w.wavenumber;
        float press = steep * sea_breaking(w.wavenumber, u_wave_range.w);
        left -= 0.5 * vec2(steep * steep, press * press);
        w.amplitude *= gerstner_shoal(w.wavenumber, window.depth);
        sum = waves_add(sum, w, p, window, near, press);
    }
    return sum;
}

// All waves at a place. What is not shown is in lost_square. The longest come first: where the
// window leaves no more of a wave, the loop ends, and of the others only the sums count.
GerstnerSum waves_sum(GerstnerPlace p, WavesWindow window)
{
    GerstnerSum sum = gerstner_level();
    float near = 1.0 - smoothstep(0.5 * WAVES_REACH, WAVES_REACH, length(vec2(p.vx, p.vy)));
    float shortest = gerstner_last(near, window.least);
    vec2 left = u_wave_all.xy;
    int g = 0;
    float longest = texelFetch(u_waves, ivec2(4, 0), 0).x;
    bool goes_on = u_wave_groups > 0 && longest <= shortest;
    do {
        if (goes_on) {
            sum = waves_add_group(sum, g, p, window, near, left);
            g++;
            longest = texelFetch(u_waves, ivec2(4, min(g, u_wave_groups - 1)), 0).x;
            goes_on = g < u_wave_groups && longest <= shortest;
        }
    } while (goes_on);
    if (g < u_wave_groups) {
        sum.lost_square += waves_left(left.x, longest, window.depth);
        sum.press_square += max(left.y, 0.0);
        sum.press_lost += max(left.y, 0.0);
    }
    sum.lost_square += u_wave_range.z;
    return sum;
}
