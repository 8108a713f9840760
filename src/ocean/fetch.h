// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_FETCH_H
#define OCEAN_FETCH_H
// How far wind has blown over the water that an eye sees near it: from its shores, since a lake
// cannot have the swell of an ocean. docs/physics.md, *Waves*.

#include "ocean/ocean.h"
#include "terrain/surface.h"

// A continuous function of the eye alone (m from the planet's centre): the mean over the water
// around it, of which what is near counts most; at most that of `waves`, and just that where no
// mask is. Threads: any.
double fetch_find_m(const struct surface *surface, const struct ocean_waves *waves,
                    struct vec3 eye_m);

#endif // OCEAN_FETCH_H
