// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
vec4 part()
{
    return no_such_name;
}
