// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// In place of cloud/hidden.frag: all is drawn, and joined.
layout(location = 0) out float out_hidden;

void main()
{
    out_hidden = 0.5;
}
