#!/bin/bash
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
# demo.sh PROGRAM SIZE VIEW…: renders views of Earth into demo/, then opens the viewer if there is a display.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$1
size=$2
shift 2

mkdir -p demo
echo "demo: rendering $# pictures of $size (the first run solves the air and compiles shaders)"
for view in "$@"; do
    picture=demo/$view.png
    began=$(date +%s%N)
    "$program" render scenes/earth.json --view "$view" --size "$size" --samples 2 -o "$picture"
    took=$((($(date +%s%N) - began) / 100000000))
    echo "demo: $PWD/$picture in $((took / 10)).$((took % 10)) s"
done
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    echo "demo: opening the viewer"
    # Where nobody is there to close it, it closes itself.
    limit=()
    if [ -n "${CI:-}" ] || ! { [ -t 0 ] || [ -t 1 ]; }; then
        limit=(--frames 30)
    fi
    exec "$program" view scenes/earth.json "${limit[@]}"
fi
