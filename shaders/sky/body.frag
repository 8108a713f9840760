// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A body's disc, lit by the star, behind the air; added to what is there, which is before it. Where
// it is dark it is as if it were not there. Directions have axes of their own: x toward the star as
// the disc shows it, z away from the eye; lengths count in the eye's distance from the centre.
// docs/physics.md, section 24.

// Rows of the matrix from (1, x, y), the place in the picture in [-1, 1]^2, to a ray.
uniform vec3 u_lit;    // x
uniform vec3 u_side;   // y
uniform vec3 u_centre; // z
uniform vec3 u_zenith; // for the air
uniform vec2 u_pixel;  // size in [-1, 1]^2
uniform vec4 u_body;   // sine of its angular radius; a sample's width in radii; sine and cosine of
                       // the phase angle
uniform int u_samples; // of a pixel, in each direction: crescents are thinner than pixels
uniform vec3 u_rows;   // of u_light: horizon mu, width in mu, number less 1
uniform vec2 u_law;    // factor; whether it is Lambert's
uniform sampler2D u_light; // linear sRGB, lx

layout(location = 0) out vec4 out_radiance;

// Radiance in sr^-1 of the fully lit disc's light.
float shine(vec3 ray)
{
    float from_centre = length(ray.xy) / u_body.x; // 1 at the edge
    // Samples outside share in what is half a step inside. There light falls as the root of the
    // distance from the edge, whose mean over that half step they complete at this place.
    float q = min(from_centre, 1.0 - 0.142 * u_body.y);
    float mu = sqrt(1.0 - q * q); // toward the eye
    vec2 outward = ray.xy * (q / max(length(ray.xy), 1.0e-12));
    float normal_x = outward.x * (ray.z - mu * u_body.x);
    float normal_z = -(u_body.x * q * q + mu * ray.z);
    float mu_star = max(normal_x * u_body.z - normal_z * u_body.w, 0.0);
    float inside = clamp((1.0 - from_centre) / u_body.y + 0.5, 0.0, 1.0);
    float law = u_law.y > 0.5 ? 1.5 * mu_star : 2.0 * mu_star / max(mu_star + mu, 1.0e-6);
    return ray.z > 0.0 ? inside * law * u_law.x : 0.0;
}

void main()
{
    float sum = 0.0;
    for (int y = 0; y < u_samples; y++) {
        for (int x = 0; x < u_samples; x++) {
            vec2 offset = (vec2(x, y) + 0.5) / float(u_samples) - 0.5;
            vec3 at = vec3(1.0, (gl_FragCoord.xy + offset) * u_pixel - 1.0);
            sum += shine(normalize(vec3(dot(u_lit, at), dot(u_side, at), dot(u_centre, at))));
        }
    }
    vec3 at = vec3(1.0, gl_FragCoord.xy * u_pixel - 1.0);
    float mu = dot(u_zenith, at) / length(vec3(dot(u_lit, at), dot(u_side, at), dot(u_centre, at)));
    float row = sqrt(clamp((mu - u_rows.x) / u_rows.y, 0.0, 1.0)) * u_rows.z;
    int below = int(min(row, u_rows.z - 1.0));
    vec3 light = mix(texelFetch(u_light, ivec2(below, 0), 0).rgb,
                     texelFetch(u_light, ivec2(below + 1, 0), 0).rgb, row - float(below));
    out_radiance = vec4(light * (sum / float(u_samples * u_samples)), 0.0);
}
