#!/bin/bash
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
# gallery.sh PROGRAM [WORD…]: makes the pictures of docs/gallery again, by the commands in its README.md:
# all, or those with one of the words in their name. Braces in a command make one picture of several:
# across by the first, down by the last.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$1
shift
gallery=docs/gallery

if ! command -v gdal_translate >/dev/null; then
    echo "gallery: gdal_translate is missing (Debian's package gdal-bin)" >&2
    exit 1
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# No files beside the pictures.
export GDAL_PAM_ENABLED=NO

is_wanted() { # file word…
    local file=$1 word
    shift
    [ $# -eq 0 ] && return 0
    for word in "$@"; do
        [[ $file == *$word* ]] && return 0
    done
    return 1
}

# The finest JPEG that is small enough: the small pictures of the planets 60 kB, the large ones 150 kB.
compress() { # from to command
    local quality limit=150000
    [[ $3 == *--size* && $3 != *{* ]] && limit=60000
    for quality in 90 85 80 70 60; do
        gdal_translate -q -of JPEG -co QUALITY=$quality "$1" "$2"
        [ "$(stat -c %s "$2")" -le $limit ] && return 0
    done
    echo "gallery: $2 is larger than $limit bytes" >&2
    return 1
}

# One picture by a command, or several side by side by one with braces.
draw() { # command to
    local all=() words=() tiles=() rows size wide high i x y
    eval "all=(${1// /\\ })"
    if [ ${#all[@]} -eq 1 ]; then
        read -ra words <<<"${1#terrella }"
        "$program" "${words[@]}" --quiet --output "$2" </dev/null
        return
    fi
    rows=${1##*\{}
    rows=${rows%%\}*}
    rows=${rows//[^,]/}
    rows=$((${#rows} + 1))
    size=${1##*--size }
    size=${size%% *}
    wide=${size%x*} high=${size#*x}
    for i in "${!all[@]}"; do
        read -ra words <<<"${all[i]#terrella }"
        "$program" "${words[@]}" --quiet --output "$scratch/$i.png" </dev/null
        x=$((i / rows * wide)) y=$((-(i % rows) * high))
        gdal_translate -q -of VRT -a_ullr $x $y $((x + wide)) $((y - high)) "$scratch/$i.png" \
            "$scratch/$i.vrt"
        tiles+=("$scratch/$i.vrt")
    done
    gdalbuildvrt -q -overwrite "$scratch/all.vrt" "${tiles[@]}"
    gdal_translate -q "$scratch/all.vrt" "$2"
}

count=0
while IFS=$'\t' read -r file command; do
    is_wanted "$file" "$@" || continue
    draw "$command" "$scratch/picture.png"
    compress "$scratch/picture.png" "$scratch/$file" "$command"
    mv "$scratch/$file" "$gallery/$file"
    echo "gallery: $gallery/$file"
    count=$((count + 1))
done < <(sed -n 's/^| !\[[^]]*\](\([^)]*\)) | `\(terrella render [^`]*\)`.*/\1\t\2/p' "$gallery/README.md")
if [ $count -eq 0 ]; then
    echo "gallery: $gallery/README.md has no picture with such a name" >&2
    exit 1
fi
