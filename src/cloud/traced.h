// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUD_TRACED_H
#define CLOUD_TRACED_H
// The field as the path tracer asks for it: as fine as there is, wherever it is looked at from.

#include "cloud/field.h"
#include "reference/clouds.h"

// The field must outlive it, and its time stay.
struct reference_clouds cloud_field_traced(const struct cloud_field *field);

#endif // CLOUD_TRACED_H
