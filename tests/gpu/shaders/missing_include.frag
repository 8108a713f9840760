// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT

#include "no/such/file.glsl"
void main() {}
