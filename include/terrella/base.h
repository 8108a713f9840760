// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_BASE_H
#define TRL_BASE_H

/// @file
/// Results, versions and the conventions that hold everywhere:
///
/// - SI units; wavelengths in nm; angles in radians (degrees only where a name ends in `_deg`).
/// - Radiance in W m^-2 sr^-1 nm^-1; colours are linear sRGB primaries in cd m^-2.
/// - Planet frame: right-handed, origin at the planet's centre, z to the north pole, x to
///   longitude 0.
/// - Zenith angle 0 is up; azimuth 0 is toward the sun.
/// - Matrices are column-major and named `dest_from_source`; depth is reversed (1 near, 0 far).
/// - Descriptions (`*_desc`) and strings passed in need to live only until the call returns.
/// - `create` makes an object that the caller owns and must `destroy`; destroy takes the address,
///   writes NULL there, and accepts NULL in it. Children must be destroyed before their parents.

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define TRL_BEGIN extern "C" {
#define TRL_END }
#else
#define TRL_BEGIN
#define TRL_END
#endif

#if defined(__GNUC__) || defined(__clang__)
#define TRL_API __attribute__((visibility("default")))
#define TRL_MUST_USE __attribute__((warn_unused_result))
#else
#define TRL_API
#define TRL_MUST_USE
#endif

#define TRL_VERSION_MAJOR 0
#define TRL_VERSION_MINOR 1
#define TRL_VERSION_PATCH 0

TRL_BEGIN

/// What a call came to. Details of a failure go to the context's log, once, as an error.
typedef enum trl_result {
    TRL_OK = 0,
    TRL_ERROR_INVALID = -1,     ///< an argument, a scene or a file's content is wrong
    TRL_ERROR_MEMORY = -2,      ///< not enough memory
    TRL_ERROR_IO = -3,          ///< a file cannot be read or written
    TRL_ERROR_GPU = -4,         ///< the GL driver refused something
    TRL_ERROR_UNSUPPORTED = -5, ///< this build or this machine lacks it
    TRL_ERROR_CANCELLED = -6    ///< the progress callback asked to stop
} trl_result;

/// The name of a result, for messages. Never NULL. Threads: any.
TRL_API const char *trl_result_name(trl_result result);

/// "major.minor.patch" of the library that is running. Threads: any.
TRL_API const char *trl_version(void);

TRL_END
#endif // TRL_BASE_H
