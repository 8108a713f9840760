#!/bin/bash
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
# fetch-data.sh PREPARE_TOOL [BODY...]
# fetch-data.sh --unpack-to DIR
#
# Gets the archives and files of tools/data-sources.txt without installing them, checks them, and has
# PREPARE_TOOL make the rasters of the bodies from them: earth when none is named, or any of earth, mars, moon,
# titan, venus, or all. Earth must succeed; what another body lacks is told in a line. With --unpack-to only the
# checked content of Earth's archives is put into DIR. Does nothing when all is there. docs/data.md tells the rest.
#
#   TERRELLA_DATA         where everything goes; else terrella/data below $XDG_CACHE_HOME or ~/.cache
#   TERRELLA_DATA_MIRROR  a folder to look in first: for archives there or in packages/ below it, for other
#                         bodies' files as tools/data-sources.txt names them
#   TERRELLA_DATA_8K=1    also the large colour picture
#   TERRELLA_DATA_SOURCES another list than tools/data-sources.txt (tests)
set -euo pipefail
tools=$(cd "$(dirname "$0")" && pwd)

data=${TERRELLA_DATA:-${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/terrella/data}
sources=${TERRELLA_DATA_SOURCES:-$tools/data-sources.txt}
archives=$data/packages
outputs=(elevation.tif elevation-north.tif elevation-south.tif water.tif colorado.tif colour.tif colour-north.tif
    colour-south.tif lights.tif snow.tif)

die() {
    echo "data: $*" >&2
    exit 1
}

sha256_of() {
    sha256sum "$1" | cut -d ' ' -f 1
}

# A file's own hash, or that of all files of a folder one after the other.
sha256_of_content() {
    if [ -d "$1" ]; then
        (cd "$1" && find . -type f -print0 | LC_ALL=C sort -z | xargs -0 cat) | sha256sum | cut -d ' ' -f 1
    else
        sha256_of "$1"
    fi
}

megabytes() {
    echo $((($1 + 999999) / 1000000))
}

# The file an archive is kept in, whatever its publisher calls it.
file_of() { # kind name
    if [ "$1" = deb ]; then
        echo "$2.deb"
    else
        echo "$2.tgz"
    fi
}

# What apt says the archive's hash is; nothing when it does not know the package.
apt_sha256() { # name
    (apt-cache show --no-all-versions "$1" 2>/dev/null || true) | sed -n 's/^SHA256: //p'
}

is_good() { # file kind name sha256
    local is
    is=$(sha256_of "$1")
    [ "$is" = "$4" ] || { [ "$2" = deb ] && [ "$is" = "$(apt_sha256 "$3")" ]; }
}

# Shows how far a file has come while a process runs, on terminals only, on one line.
watch_progress() { # pid folder name bytes
    if [ ! -t 1 ]; then
        return
    fi
    while kill -0 "$1" 2>/dev/null; do
        local have
        have=$(du -cb "$2"/* 2>/dev/null | sed -n '$s/\t.*//p')
        printf '\rdata: %s: %d of %d MB, %d s ' "$3" "$(megabytes "${have:-0}")" "$(megabytes "$4")" \
            $((SECONDS - began))
        sleep 0.3
    done
    printf '\r\033[K'
}

# The archive in the mirror, under its publisher's name or ours; nothing when it is not there.
find_in_mirror() { # kind name
    local mirror=${TERRELLA_DATA_MIRROR:-} place candidate
    [ -n "$mirror" ] || return 0
    for place in "$mirror" "$mirror/packages"; do
        for candidate in "$place/$(file_of "$1" "$2")" "$place/$2"_*.deb "$place/${2/@/-}.tgz"; do
            if [ -f "$candidate" ]; then
                echo "$candidate"
                return 0
            fi
        done
    done
}

# The lists apt needs; only fetched when it does not know the package.
ensure_apt_lists() { # name
    if ! command -v apt-get >/dev/null; then
        echo "data: $1: there is no apt-get here; put the package into TERRELLA_DATA_MIRROR" >&2
        return 1
    fi
    if [ -n "$(apt_sha256 "$1")" ]; then
        return 0
    fi
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "data: apt does not know $1: run apt-get update as root first" >&2
            return 1
        fi
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get -qq -o DPkg::Lock::Timeout=600 update >/dev/null 2>&1 || true
    if [ -z "$(apt_sha256 "$1")" ]; then
        echo "data: apt does not know $1, even after apt-get update" >&2
        return 1
    fi
}

# Into the folder of partial files: a download that was stopped goes on there (apt checks what it finds).
download() { # kind name partial-folder
    if [ "$1" = deb ]; then
        ensure_apt_lists "$2" || return 1
        (cd "$3" && exec apt-get -qq -o APT::Sandbox::User=root -o Acquire::Retries=3 download "$2")
    elif command -v npm >/dev/null; then
        (cd "$3" && exec npm pack --silent --fetch-retries=1 --fetch-timeout=60000 "$2" >/dev/null)
    else
        echo "data: $2: npm is not there" >&2
        return 1
    fi
}

# Brings one archive into the cache, whole and checked, or fails.
fetch_archive() { # kind name bytes sha256
    local kind=$1 name=$2 bytes=$3 sha256=$4
    local kept partial log source began=$SECONDS
    kept=$archives/$(file_of "$kind" "$name")
    if [ -f "$kept" ]; then
        return 0 # it was checked before it got this name
    fi
    partial=$archives/partial-$(file_of "$kind" "$name")
    log=$partial.log
    mkdir -p "$partial"
    source=$(find_in_mirror "$kind" "$name")
    if [ -n "$source" ] && ! is_good "$source" "$kind" "$name" "$sha256"; then
        echo "data: $source: its checksum is wrong; not used" >&2
        source=
    fi
    if [ -n "$source" ]; then
        rm -f "$partial"/*
        cp "$source" "$partial/" 2>"$log" &
    else
        download "$kind" "$name" "$partial" 2>"$log" >&2 &
    fi
    watch_progress $! "$partial" "$name" "$bytes"
    if ! wait $!; then
        grep -v '^$' "$log" | tail -n 3 | sed "s/^data: $name: //; s/^/data: $name: /" >&2
        return 1
    fi
    rm -f "$log"
    local got
    got=$(find "$partial" -type f | head -n 1)
    if [ -z "$got" ] || ! is_good "$got" "$kind" "$name" "$sha256"; then
        rm -rf "$partial"
        echo "data: $name: what came has a wrong checksum; removed" >&2
        return 1
    fi
    mv "$got" "$kept"
    rm -rf "$partial"
    echo "data: $name: $(megabytes "$(stat -c %s "$kept")") MB in $((SECONDS - began)) s${source:+ from the mirror}"
}

# Unpacks one archive's content into a folder and checks it.
unpack_archive() { # kind name folder; uses contents[name]
    local kept paths path sha256
    kept=$archives/$(file_of "$1" "$2")
    mapfile -t paths <<<"${contents[$2]}"
    if [ "$1" = deb ]; then
        dpkg-deb --fsys-tarfile "$kept" | tar -x -C "$3" "${paths[@]/#/./}"
    else
        tar -xzf "$kept" -C "$3" "${paths[@]}"
    fi || return 1
    for path in "${paths[@]}"; do
        sha256=$(sha256_of_content "$3/$path")
        if [ "$sha256" != "${hashes[$2:$path]}" ]; then
            echo "data: $2: $path is not the version that is known" >&2
            return 1
        fi
    done
}

kinds=() names=() needs=() sizes=() sums=()
files=() file_needs=() file_sums=() file_urls=() known_bodies=(earth)
declare -A contents hashes
read_sources() {
    local word a b c d e
    while read -r word a b c d e; do
        case $word in
        archive)
            kinds+=("$a") names+=("$b") needs+=("$c") sizes+=("$d") sums+=("$e")
            ;;
        content)
            local name=${names[-1]}
            contents[$name]+=${contents[$name]:+$'\n'}$a
            hashes[$name:$a]=$b
            ;;
        file)
            files+=("$a") file_needs+=("$b") file_sums+=("$c") file_urls+=("$d")
            [[ " ${known_bodies[*]} " == *" ${a%%/*} "* ]] || known_bodies+=("${a%%/*}")
            ;;
        '' | '#'*) ;;
        *) die "$sources: cannot read the line that begins with $word" ;;
        esac
    done <"$sources"
}

# Whether an archive is to be had at all: the large one only when asked for or already there.
is_wanted() { # index
    [ "${needs[$1]}" != 8k ] || [ "${TERRELLA_DATA_8K:-0}" = 1 ] ||
        [ -f "$archives/$(file_of "${kinds[$1]}" "${names[$1]}")" ] ||
        [ -n "$(find_in_mirror "${kinds[$1]}" "${names[$1]}")" ]
}

# One line that changes with whatever the rasters are made from: this list, the tool's source, the archives.
stamp_now() { # archives that are used
    (
        cat "$sources" "$tools"/prepare/*.{[ch],py}
        printf '%s\n' "$@"
    ) | sha256sum | cut -d " " -f 1
}

used=() used_kinds=() failed=()
fetch_all() {
    local i
    mkdir -p "$archives"
    for i in "${!names[@]}"; do
        is_wanted "$i" || continue
        if fetch_archive "${kinds[$i]}" "${names[$i]}" "${sizes[$i]}" "${sums[$i]}"; then
            used+=("${names[$i]}")
            used_kinds+=("${kinds[$i]}")
        elif [ "${needs[$i]}" = needed ]; then
            die "${names[$i]} is needed and cannot be had; see docs/data.md for a mirror"
        else
            failed+=("${names[$i]}")
        fi
    done
}

unpack_all() { # folder
    local i
    for i in "${!used[@]}"; do
        if ! unpack_archive "${used_kinds[$i]}" "${used[$i]}" "$1"; then
            rm -f "$archives/$(file_of "${used_kinds[$i]}" "${used[$i]}")"
            die "${used[$i]} is broken; removed, try again"
        fi
    done
}

# The table of stars, where its archive is to be had.
star_source=package/data/stars.8.json
make_stars() { # unpacked
    [ -f "$1/$star_source" ] || return 0
    mkdir -p "$data/stars"
    python3 "$tools/prepare/stars.py" "$1/$star_source" "$data/stars/stars.csv" ||
        die "the table of stars could not be made"
}

is_complete() {
    local name
    if [[ " ${used[*]} " == *" d3-celestial@"* ]] && [ ! -f "$data/stars/stars.csv" ]; then
        return 1
    fi
    for name in "${outputs[@]}"; do
        [ -f "$data/earth/$name" ] || return 1
    done
}

make_rasters() { # prepare-tool
    local stamp began=$SECONDS
    stamp=$(stamp_now "${used[@]}")
    if is_complete && [ "$(cat "$data/earth/stamp" 2>/dev/null)" = "$stamp" ]; then
        return 0
    fi
    if [ ${#failed[@]} -ne 0 ]; then
        echo "data: goes on without ${failed[*]}: what docs/data.md says they are for is coarser or missing"
    fi
    [ -x "$1" ] || die "$1 is not built; run make build first"
    local unpacked=$data/unpacked
    rm -rf "$unpacked"
    mkdir -p "$unpacked" "$data/earth"
    unpack_all "$unpacked"
    rm -f "$data/earth/stamp"
    echo "data: making the rasters of Earth (about 15 s)"
    "$1" "$unpacked" "$data/earth" || die "the rasters could not be made"
    make_stars "$unpacked"
    rm -rf "$unpacked"
    echo "$stamp" >"$data/earth/stamp"
    echo "data: $(du -sh "$data/earth" | cut -f 1) in $data/earth, made in $((SECONDS - began)) s; licences: data/LICENCES.md"
}

# A file of another body's archive: from the mirror, else from the archive where its address is known. A copy in
# the mirror that is another one than ours is used all the same when there is no address: somebody made it from
# the original (docs/data.md). On failure it says why in a line.
fetch_file() { # index
    local path=${files[$1]} sum=${file_sums[$1]} url=${file_urls[$1]}
    local kept=$data/archives/$path partial=$data/archives/$path.part
    [ ! -f "$kept" ] || return 0
    mkdir -p "$(dirname "$kept")"
    local source=${TERRELLA_DATA_MIRROR:+$TERRELLA_DATA_MIRROR/$path}
    if [ -n "$source" ] && [ -f "$source" ]; then
        cp "$source" "$partial"
        if [ "$(sha256_of "$partial")" != "$sum" ]; then
            if [ "$url" = - ]; then
                echo "data: $source: not the copy that is known; used as it is" >&2
            else
                echo "data: $source: its checksum is wrong; not used" >&2
                rm -f "$partial"
            fi
        fi
    fi
    if [ ! -f "$partial" ] && [ "$url" != - ]; then
        download_file "$url" "$partial" "$sum" || return 1
    fi
    if [ ! -f "$partial" ]; then
        echo "data: only a mirror can have it" >&2
        return 1
    fi
    mv "$partial" "$kept"
}

download_file() { # url file sha256
    local why
    if ! command -v curl >/dev/null; then
        echo "data: curl is not there; $1 cannot be fetched" >&2
        return 1
    fi
    if ! why=$(curl -fsSL --retry 2 --connect-timeout 20 --max-time 600 -o "$2" "$1" 2>&1); then
        rm -f "$2"
        echo "data: $1: $(tail -n 1 <<<"${why:-cannot be fetched}")" >&2
        return 1
    fi
    if [ "$(sha256_of "$2")" != "$3" ]; then
        rm -f "$2"
        echo "data: $1: what came has a wrong checksum; removed" >&2
        return 1
    fi
}

# Everything about a body that changes its rasters: its lines of the list, the tool's source, its files.
stamp_of_body() { # body
    (
        grep "^file $1/" "$sources"
        cat "$tools"/prepare/*.[ch]
        find "$data/archives/$1" -type f -printf '%f %s\n' 2>/dev/null | LC_ALL=C sort
    ) | sha256sum | cut -d ' ' -f 1
}

# Earth's insets: files as those of other bodies, none of them needed, made beside the globe. Silent where there is
# nothing to be had.
make_insets() { # prepare-tool
    local i stamp has_any=''
    for i in "${!files[@]}"; do
        if [ "${files[$i]%%/*}" = earth ] && fetch_file "$i" 2>/dev/null; then
            has_any=1
        fi
    done
    [ -n "$has_any" ] || return 0
    stamp=$(stamp_of_body earth)
    if [ "$(cat "$data/earth/stamp-insets" 2>/dev/null)" = "$stamp" ]; then
        return 0
    fi
    if ! "$1" "$data/archives" "$data/earth" earth-insets; then
        echo "data: earth: its insets could not be made"
        return 0
    fi
    echo "$stamp" >"$data/earth/stamp-insets"
    echo "data: Earth's insets made"
}

# Another body than Earth. Nothing here is fatal: its scenes do without, or say what they lack.
make_body() { # body prepare-tool
    local body=$1 i missing='' has_any='' stamp began=$SECONDS
    for i in "${!files[@]}"; do
        [ "${files[$i]%%/*}" = "$body" ] || continue
        if fetch_file "$i" 2>"$data/.log"; then
            has_any=1
            cat "$data/.log" >&2
        elif [ "${file_needs[$i]}" = needed ]; then
            missing="${files[$i]} ($(tail -n 1 "$data/.log" | sed 's/^data: //'))"
        fi
    done
    rm -f "$data/.log"
    if [ -n "$missing" ] || [ -z "$has_any" ]; then
        echo "data: $body goes without: ${missing:-nothing of it is to be had}; see docs/data.md"
        return 0
    fi
    stamp=$(stamp_of_body "$body")
    if [ "$(cat "$data/$body/stamp" 2>/dev/null)" = "$stamp" ]; then
        return 0
    fi
    [ -x "$2" ] || die "$2 is not built; run make build first"
    mkdir -p "$data/$body"
    rm -f "$data/$body/stamp"
    if ! "$2" "$data/archives" "$data/$body" "$body"; then
        echo "data: $body: its rasters could not be made"
        return 0
    fi
    echo "$stamp" >"$data/$body/stamp"
    echo "data: $(du -sh "$data/$body" | cut -f 1) in $data/$body, made in $((SECONDS - began)) s"
}

make_bodies() { # prepare-tool body...
    local tool=$1 body
    shift
    [ $# -gt 0 ] || set -- earth
    if [ "$1" = all ]; then
        set -- "${known_bodies[@]}"
    fi
    for body in "$@"; do
        [[ " ${known_bodies[*]} " == *" $body "* ]] || die "there is no data of $body; there is: ${known_bodies[*]}"
    done
    for body in "$@"; do
        if [ "$body" = earth ]; then
            fetch_all
            make_rasters "$tool"
            make_insets "$tool"
        else
            make_body "$body" "$tool"
        fi
    done
}

main() {
    mkdir -p "$data" || die "cannot make $data"
    exec 9>"$data/.lock"
    flock 9
    read_sources
    if [ "${1:-}" = --unpack-to ]; then
        fetch_all
        mkdir -p "$2"
        unpack_all "$2"
    else
        make_bodies "$@"
    fi
}

if [ $# -lt 1 ] || { [ "$1" = --unpack-to ] && [ $# -ne 2 ]; }; then
    echo "usage: fetch-data.sh PREPARE_TOOL [BODY...] | --unpack-to DIR" >&2
    exit 2
fi
main "$@"
