#!/bin/bash
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
# install-packages.sh [PART…]: installs the packages of tools/packages.txt that are missing: those of no part,
# and of the parts named. Does nothing, and needs no rights, when all are there.
set -euo pipefail
cd "$(dirname "$0")"

list_wanted() { # parts
    awk -v parts=" $* " '
        { sub(/#.*/, ""); gsub(/[[:space:]]/, "") }
        /^\[.*\]$/ { is_unwanted = !index(parts, " " substr($0, 2, length($0) - 2) " "); next }
        $0 != "" && !is_unwanted' packages.txt
}
mapfile -t wanted < <(list_wanted "$@")

# Names of the wanted packages that are not installed; one call of dpkg for all.
list_missing() {
    local installed
    installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null |
        sed -n 's/ installed$//p' | sort -u) || true
    printf '%s\n' "${wanted[@]}" | sort -u | comm -23 - <(printf '%s\n' "$installed")
}

if ! command -v dpkg-query >/dev/null; then
    echo "packages: this is not a Debian system; install by hand what tools/packages.txt names" >&2
    exit 1
fi
mapfile -t missing < <(list_missing)
if [ ${#missing[@]} -eq 0 ]; then
    exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
        echo "packages: not root and no sudo; as root run: apt-get install ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
run_apt() {
    if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y \
        -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3 "$@" >"$log" 2>&1; then
        tail -n 15 "$log" >&2
        echo "packages: apt-get $1 failed (its last lines are above); missing: ${missing[*]}" >&2
        exit 1
    fi
}

echo "packages: installing ${#missing[@]} (${missing[*]}); the first time about a minute"
start=$SECONDS
run_apt update
run_apt install --no-install-recommends "${missing[@]}"
mapfile -t missing < <(list_missing)
if [ ${#missing[@]} -ne 0 ]; then
    echo "packages: still missing: ${missing[*]}" >&2
    exit 1
fi
echo "packages: installed in $((SECONDS - start)) s"
