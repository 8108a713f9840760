#!/bin/bash
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
# build.sh FOLDER [MESON_OPTION…]: configures the folder once and builds it; says little unless it fails.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$1
shift
log=$folder.log
mkdir -p "$(dirname "$folder")"
start=$SECONDS

if [ ! -f "$folder/build.ninja" ]; then
    rm -rf "$folder" # a configuration that was stopped half way
    if ! meson setup "$folder" "$@" >"$log" 2>&1; then
        tail -n 20 "$log" >&2
        echo "build: meson setup $folder failed; its log: $log" >&2
        exit 1
    fi
fi
# Ninja draws its own progress line on a terminal; elsewhere only what went wrong is shown.
if [ -t 1 ]; then
    ninja -C "$folder" --quiet
elif ! ninja -C "$folder" >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "build: $folder failed; its log: $log" >&2
    exit 1
fi
if [ $((SECONDS - start)) -gt 1 ]; then
    echo "build: $folder in $((SECONDS - start)) s"
fi
