// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_PHYSICS_WAVES_H
#define TESTS_PHYSICS_WAVES_H
// A sea for tests, on a planet of Earth's size.
#include "ocean/waves.h"
#include <terrella/context.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const double RADIUS_M = 6371000, GRAVITY = 9.81;

static inline int waves_set_up(void **state)
{
    trl_context *ctx = NULL;
    const trl_context_desc desc = trl_context_desc_default();
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    *state = ctx;
    return 0;
}

static inline int waves_tear_down(void **state)
{
    trl_context *ctx = *state;
    trl_context_destroy(&ctx);
    return 0;
}

static inline struct ocean_desc waves_describe(double wind_m_s, enum ocean_spectrum spectrum,
                                               uint32_t count)
{
    return (struct ocean_desc){.gravity_m_s2 = GRAVITY,
                               .waves = {.wind_m_s = wind_m_s,
                                         .wind_from_rad = 240 * M_PI / 180,
                                         .fetch_m = 3e5,
                                         .spectrum = spectrum,
                                         .count = count,
                                         .seed = 1}};
}

static inline void waves_make(trl_context *ctx, const struct ocean_desc *ocean, struct waves *out)
{
    const struct waves_desc desc = {ctx, ocean, RADIUS_M, 0.003 + 0.00512 * ocean->waves.wind_m_s};
    assert_int_equal(waves_init(&desc, out), TRL_OK);
}

#endif // TESTS_PHYSICS_WAVES_H
