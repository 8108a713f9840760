#!/bin/bash
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
# fetch_data.sh FETCH_SCRIPT: the fetching of data against archives made here, without any network: apt and npm
# are replaced by scripts of this test. Prints one line a fact; exits with 1 if any is not so.
set -euo pipefail
fetch=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failures=0

fact() { # name status
    if [ "$2" -eq 0 ]; then
        echo "ok: $1"
    else
        echo "NOT OK: $1"
        sed 's/^/    /' "$work/log" || true
        failures=$((failures + 1))
    fi
}

sum() {
    sha256sum "$1" | cut -d ' ' -f 1
}

# A package with one file and one folder, and a list that names it.
make_package() {
    mkdir -p p/DEBIAN p/usr/share/t/tiles published
    printf 'Package: tiny-data\nVersion: 1\nArchitecture: all\nMaintainer: t <t@example.org>\nDescription: t\n' \
        >p/DEBIAN/control
    echo "heights" >p/usr/share/t/a.txt
    echo "1" >p/usr/share/t/tiles/1
    echo "2" >p/usr/share/t/tiles/2
    dpkg-deb --root-owner-group -b p published/tiny-data_1_all.deb >/dev/null
    mkdir -p package/img
    echo "colour" >package/img/c.txt
    tar -czf published/pictures-1.0.0.tgz package/img/c.txt
    cat >sources.txt <<END
# a comment
archive deb tiny-data needed 1000 $(sum published/tiny-data_1_all.deb)
content usr/share/t/a.txt $(sum p/usr/share/t/a.txt)
content usr/share/t/tiles $(printf '1\n2\n' | sha256sum | cut -d ' ' -f 1)

archive npm pictures@1.0.0 optional 1000 $(sum published/pictures-1.0.0.tgz)
content package/img/c.txt $(sum package/img/c.txt)
END
}

# Stand-ins: apt knows no package, npm serves what lies in the folder `net`.
make_stand_ins() {
    mkdir -p bin net
    cat >bin/apt-cache <<'END'
#!/bin/bash
exit 100
END
    cat >bin/apt-get <<END
#!/bin/bash
[ "\${!#}" = update ] && exit 0
echo "E: no such package" >&2
exit 100
END
    cat >bin/npm <<END
#!/bin/bash
cp "$work/net/pictures-1.0.0.tgz" .
END
    chmod +x bin/*
}

# A stand-in for the tool that makes rasters: needs the unpacked content, makes empty outputs.
make_prepare() {
    cat >prepare <<'END'
#!/bin/bash
set -e
grep -q heights "$1/usr/share/t/a.txt"
for name in elevation elevation-north elevation-south water colorado colour colour-north colour-south lights snow; do echo "$name" >"$2/$name.tif"; done
echo made >>"$2/../made"
END
    chmod +x prepare
}

# shellcheck disable=SC2317 # called through status_of
run() { # arguments of the script
    env PATH="$work/bin:$PATH" TERRELLA_DATA="$work/data" TERRELLA_DATA_SOURCES="$work/sources.txt" \
        TERRELLA_DATA_MIRROR="$work/mirror" bash "$fetch" "$@" >log 2>&1
}

status_of() {
    local status=0
    "$@" || status=$?
    echo "$status"
}

start_over() {
    rm -rf data mirror net out
    mkdir -p mirror net
}

make_package
make_stand_ins
make_prepare

start_over
cp published/* mirror/
fact "a mirror serves what is needed" "$(status_of run "$work/prepare")"
fact "the rasters are made" "$(status_of test -f data/earth/lights.tif)"
fact "nothing of the unpacked content stays" "$(status_of test ! -e data/unpacked)"
before=$(wc -l <data/made)
rm -rf mirror
fact "a second run needs nothing" "$(status_of run "$work/prepare")"
fact "a second run makes nothing" "$(status_of test "$(wc -l <data/made)" = "$before")"
fact "a second run says nothing" "$(status_of test ! -s log)"
rm data/earth/water.tif
fact "a raster that is gone is made again" "$(status_of run "$work/prepare")"
fact "it is there" "$(status_of test -f data/earth/water.tif)"

start_over
cp published/pictures-1.0.0.tgz mirror/
head -c 500 published/tiny-data_1_all.deb >mirror/tiny-data_1_all.deb
fact "a truncated package is refused" "$((!$(status_of run "$work/prepare")))"
fact "its checksum is named" "$(status_of grep -q "checksum is wrong" log)"
fact "the package is called needed" "$(status_of grep -q "tiny-data is needed" log)"
fact "it is not in the cache" "$(status_of test ! -e data/packages/tiny-data.deb)"
fact "no raster is made" "$(status_of test ! -e data/earth/lights.tif)"
cp published/tiny-data_1_all.deb mirror/
fact "with the right one the next run goes through" "$(status_of run "$work/prepare")"

start_over
mkdir -p data/packages/partial-tiny-data.deb
head -c 300 published/tiny-data_1_all.deb >data/packages/partial-tiny-data.deb/tiny-data_1_all.deb
cp published/* mirror/
fact "a partial file is not taken for whole" "$(status_of run --unpack-to out)"
fact "what is kept is whole" "$(status_of cmp data/packages/tiny-data.deb published/tiny-data_1_all.deb)"
fact "no partial file stays" "$(status_of test ! -e data/packages/partial-tiny-data.deb)"
fact "the content is unpacked" "$(status_of cmp out/usr/share/t/tiles/2 p/usr/share/t/tiles/2)"

start_over
cp published/tiny-data_1_all.deb mirror/
cp published/pictures-1.0.0.tgz net/
fact "what the mirror lacks comes from the registry" "$(status_of run --unpack-to out)"
fact "it is unpacked" "$(status_of cmp out/package/img/c.txt package/img/c.txt)"

start_over
cp published/tiny-data_1_all.deb mirror/
echo "not what was published" >net/pictures-1.0.0.tgz
fact "a wrong optional archive does not stop it" "$(status_of run "$work/prepare")"
fact "it is told" "$(status_of grep -q "pictures@1.0.0: what came has a wrong checksum" log)"
fact "it is told what it means" "$(status_of grep -q "goes on without pictures" log)"
fact "it is not in the cache" "$(status_of test ! -e data/packages/pictures@1.0.0.tgz)"
cp published/pictures-1.0.0.tgz net/
fact "it is tried again" "$(status_of run "$work/prepare")"
fact "and the rasters are made again with it" "$(status_of test "$(wc -l <data/made)" = 2)"

start_over
cp published/* mirror/
sed -i "s/^content usr.share.t.a.txt .*/content usr\/share\/t\/a.txt $(printf 'x' | sha256sum | cut -d ' ' -f 1)/" \
    sources.txt
fact "another version of a file is refused" "$((!$(status_of run "$work/prepare")))"
fact "the file is named" "$(status_of grep -q "usr/share/t/a.txt is not the version that is known" log)"

# Other bodies: files by their address, or from the mirror alone.
make_bodies() {
    mkdir -p archive/red archive/grey
    echo "red heights" >archive/red/heights.img
    echo "red colour" >archive/red/colour.jpg
    echo "grey heights" >archive/grey/heights.png
    cat >>sources.txt <<END
file red/heights.img needed $(sum archive/red/heights.img) https://archive.example/red/heights.img
file red/colour.jpg optional $(sum archive/red/colour.jpg) -
file grey/heights.png needed $(sum archive/grey/heights.png) -
END
    cat >bin/curl <<END
#!/bin/bash
while [ \$# -gt 1 ]; do [ "\$1" = -o ] && out=\$2; shift; done
[ -f "$work/net/\${1##*/}" ] || { echo "curl: (6) no such host" >&2; exit 6; }
cp "$work/net/\${1##*/}" "\$out"
END
    cat >prepare <<END
#!/bin/bash
set -e
echo "\$*" >>"$work/data/made"
[ "\${3:-earth}" = earth ] || cp "\$1/\$3/"* "\$2"
END
    chmod +x bin/curl prepare
}
make_package
make_bodies

start_over
fact "a body without archive and mirror is no failure" "$(status_of run "$work/prepare" red grey)"
fact "one line tells of each" "$(status_of test "$(grep -c "goes without" log)" = 2)"
fact "it says what the network says" "$(status_of grep -q "red/heights.img (https.*no such host)" log)"
fact "it says what only a mirror has" "$(status_of grep -q "grey/heights.png (only a mirror" log)"
cp archive/red/heights.img net/
fact "a body comes from its archive" "$(status_of run "$work/prepare" red grey)"
fact "its tool is told which body" "$(status_of grep -q "data/archives .*data/red red" data/made)"
fact "without what is optional" "$(status_of test ! -e data/red/colour.jpg)"
before=$(wc -l <data/made)
fact "a second run is no failure" "$(status_of run "$work/prepare" red)"
fact "it makes nothing" "$(status_of test "$(wc -l <data/made)" = "$before")"
cp -r archive mirror/../mirror2
mv mirror2/* mirror/
rm -rf mirror2
fact "with a mirror the rest comes" "$(status_of run "$work/prepare" red grey)"
fact "all of it" "$(status_of test -e data/red/colour.jpg -a -e data/grey/heights.png)"

start_over
mkdir -p mirror/red mirror/grey
echo "cut" >mirror/red/heights.img
echo "my own" >mirror/grey/heights.png
fact "a wrong file of a known address is no failure" "$(status_of run "$work/prepare" red grey)"
fact "but not used" "$(status_of test ! -e data/red/heights.img)"
fact "one without an address is, and told" "$(status_of grep -q "grey/heights.png: not the copy" log)"
fact "it is there" "$(status_of grep -q "my own" data/grey/heights.png)"
fact "an unknown body is refused" "$((!$(status_of run "$work/prepare" blue)))"
fact "the known ones are named" "$(status_of grep -q "there is no data of blue; there is: earth red grey" log)"

exit $((failures > 0))
