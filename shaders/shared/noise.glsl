// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_NOISE_GLSL
#define SHARED_NOISE_GLSL
// Simplex noise of three dimensions (Perlin 2001, "Noise hardware"; in the form that Gustavson 2005
// describes), with a hash of the lattice point in place of a table, and its gradient; a noise of
// stripes on the same lattice, for gullies; and how octaves of both become relief.
// docs/physics.md, section 26, derives what is here.
//
// Places are lattice coordinates: an offset from a whole lattice point, which is given apart, so
// that nothing of a planet's size is ever a float. Offsets may be some thousands.
#include "shared/shared.glsl"

#define NOISE_SKEW (1.0 / 3.0)   // of three axes: (sqrt(4) - 1) / 3
#define NOISE_UNSKEW (1.0 / 6.0) // (1 - 1 / sqrt(4)) / 3
// Corners count within this squared distance: the height of a tetrahedron's corner over the
// opposite face, so that none is cut off where it still counts.
#define NOISE_REACH2 0.5
// The noise stays within -1 and 1 with this: gradients' components are as large as 1.
#define NOISE_SCALE 62.0
// Stripes to a lattice unit.
#define NOISE_STRIPES 1.1
// Where the squared length of their sum is this, they have 0.7 of their height.
#define NOISE_FORK 0.04

// A place: x, y, z from the whole lattice point i, j, k (skewed).
SHARED_STRUCT(NoisePlace)
{
    Number x, y, z;
    Whole i, j, k;
};

SHARED_STRUCT(NoiseValue)
{
    Number value;
    Number x, y, z; // its gradient
};

// A point's place in its cell, and the cell's first corner.
SHARED_STRUCT(NoiseCell)
{
    Number x, y, z;    // from that corner
    Whole i, j, k;     // its skewed lattice coordinates
    Number rx, ry, rz; // rank of the coordinates: 2 the largest, 0 the smallest
};

SHARED_STRUCT(NoiseCorner)
{
    Number x, y, z; // from it
    Whole hash;
};

// Well mixed bits of a lattice point. The finaliser of MurmurHash3 (Appleby 2011) over a sum of
// multiples; the factors are 2^32 times the powers of the inverse of the root of x^4 = x + 1.
SHARED_FN Whole noise_hash(Whole i, Whole j, Whole k)
{
    Whole h = i * 0xd1b54a33u + j * 0xabc98389u + k * 0x8cb92ba7u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}

SHARED_FN NoiseCell noise_find_cell(NoisePlace p)
{
    Number skew = (p.x + p.y + p.z) * NOISE_SKEW;
    Number i = floor(p.x + skew);
    Number j = floor(p.y + skew);
    Number k = floor(p.z + skew);
    Number unskew = (i + j + k) * NOISE_UNSKEW;
    NoiseCell c;
    c.x = p.x - (i - unskew);
    c.y = p.y - (j - unskew);
    c.z = p.z - (k - unskew);
    c.i = p.i + shared_whole(i);
    c.j = p.j + shared_whole(j);
    c.k = p.k + shared_whole(k);
    // The cube of the skewed lattice is six tetrahedra, by the order of the coordinates.
    Number xy = c.x >= c.y ? 1.0 : 0.0;
    Number xz = c.x >= c.z ? 1.0 : 0.0;
    Number yz = c.y >= c.z ? 1.0 : 0.0;
    c.rx = xy + xz;
    c.ry = 1.0 - xy + yz;
    c.rz = 2.0 - xz - yz;
    return c;
}

// Corner 0 to 3 of the tetrahedron: a step along the largest coordinate, then the next, the last.
SHARED_FN NoiseCorner noise_corner(NoiseCell c, Number number)
{
    Number least = 2.5 - number;
    Number x = c.rx > least ? 1.0 : 0.0;
    Number y = c.ry > least ? 1.0 : 0.0;
    Number z = c.rz > least ? 1.0 : 0.0;
    Number unskew = number * NOISE_UNSKEW;
    NoiseCorner corner;
    corner.x = c.x - x + unskew;
    corner.y = c.y - y + unskew;
    corner.z = c.z - z + unskew;
    corner.hash = noise_hash(c.i + shared_whole(x), c.j + shared_whole(y), c.k + shared_whole(z));
    return corner;
}

// In [-1, 1], mean 0. Each corner adds (1/2 - d^2)^4 (g . d), with a gradient g from a cube.
SHARED_FN NoiseValue noise_simplex(NoisePlace p)
{
    NoiseCell cell = noise_find_cell(p);
    NoiseValue sum;
    sum.value = 0.0;
    sum.x = 0.0;
    sum.y = 0.0;
    sum.z = 0.0;
    for (int n = 0; n < 4; n++) {
        NoiseCorner c = noise_corner(cell, shared_number(n));
        // Ten bits for each component.
        Number gx = shared_number(c.hash & 1023u) * (2.0 / 1023.0) - 1.0;
        Number gy = shared_number((c.hash >> 10) & 1023u) * (2.0 / 1023.0) - 1.0;
        Number gz = shared_number((c.hash >> 20) & 1023u) * (2.0 / 1023.0) - 1.0;
        Number t = shared_max(NOISE_REACH2 - c.x * c.x - c.y * c.y - c.z * c.z, 0.0);
        Number t2 = t * t;
        Number t4 = t2 * t2;
        Number along = gx * c.x + gy * c.y + gz * c.z;
        Number fall = -8.0 * t * t2 * along;
        sum.value += t4 * along;
        sum.x += t4 * gx + fall * c.x;
        sum.y += t4 * gy + fall * c.y;
        sum.z += t4 * gz + fall * c.z;
    }
    sum.value *= NOISE_SCALE;
    sum.x *= NOISE_SCALE;
    sum.y *= NOISE_SCALE;
    sum.z *= NOISE_SCALE;
    return sum;
}

// In [-1, 1], mean 0: stripes that vary along a unit direction, each corner in its own phase.
// Waves of the corners are added as complex numbers, and the sum is brought near length 1; the
// direction counts as constant in the gradient.
SHARED_FN NoiseValue noise_stripes(NoisePlace p, Number dx, Number dy, Number dz)
{
    NoiseCell cell = noise_find_cell(p);
    NoiseValue re;
    re.value = 0.0;
    re.x = 0.0;
    re.y = 0.0;
    re.z = 0.0;
    NoiseValue im = re;
    for (int n = 0; n < 4; n++) {
        NoiseCorner c = noise_corner(cell, shared_number(n));
        Number t = shared_max(NOISE_REACH2 - c.x * c.x - c.y * c.y - c.z * c.z, 0.0);
        Number weight = 8.0 * t * t * t;
        Number fall = -48.0 * t * t;
        Number turn = 2.0 * SHARED_PI * NOISE_STRIPES;
        Number phase = turn * (dx * c.x + dy * c.y + dz * c.z) +
                       shared_number(c.hash & 1023u) * (2.0 * SHARED_PI / 1024.0);
        Number cosine = cos(phase);
        Number sine = sin(phase);
        Number sweep = turn * weight;
        re.value += weight * cosine;
        re.x += fall * cosine * c.x - sweep * sine * dx;
        re.y += fall * cosine * c.y - sweep * sine * dy;
        re.z += fall * cosine * c.z - sweep * sine * dz;
        im.value += weight * sine;
        im.x += fall * sine * c.x + sweep * cosine * dx;
        im.y += fall * sine * c.y + sweep * cosine * dy;
        im.z += fall * sine * c.z + sweep * cosine * dz;
    }
    // Where the waves cancel there is a fork, and about it they are low: gullies come and go.
    Number size2 = re.value * re.value + im.value * im.value + NOISE_FORK;
    Number inverse = sqrt((1.0 + NOISE_FORK) / size2);
    Number cube = inverse / size2;
    Number kept = (im.value * im.value + NOISE_FORK) * cube;
    Number lost = re.value * im.value * cube;
    NoiseValue sum;
    sum.value = re.value * inverse;
    sum.x = kept * re.x - lost * im.x;
    sum.y = kept * re.y - lost * im.y;
    sum.z = kept * re.z - lost * im.z;
    return sum;
}

#endif // SHARED_NOISE_GLSL
