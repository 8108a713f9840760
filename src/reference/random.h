// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_RANDOM_H
#define REFERENCE_RANDOM_H
// A stream of random numbers per path, chosen by numbers alone, so that threads cannot matter.
// SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators", Figure
// 16).

#include <stdint.h>

struct random_stream {
    uint64_t state;
};

static inline uint64_t random_mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

static inline struct random_stream random_stream_for(uint64_t seed, uint64_t query, uint64_t path)
{
    const uint64_t golden = 0x9e3779b97f4a7c15ULL;
    uint64_t state = random_mix(seed + golden);
    state = random_mix(state ^ (query * golden + 1));
    return (struct random_stream){random_mix(state ^ (path * golden + 2))};
}

// Uniform in (0, 1), both ends left out.
static inline double random_next(struct random_stream *stream)
{
    stream->state += 0x9e3779b97f4a7c15ULL;
    return ((double)(random_mix(stream->state) >> 12) + 0.5) * 0x1p-52;
}

// A stream of its own, chosen by the next number of another.
static inline struct random_stream random_stream_fork(struct random_stream *stream)
{
    stream->state += 0x9e3779b97f4a7c15ULL;
    return (struct random_stream){random_mix(random_mix(stream->state) ^ 0xd1b54a32d192ed03ULL)};
}

#endif // REFERENCE_RANDOM_H
