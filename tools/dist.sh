#!/bin/bash
# SPDX-License-Identifier: MIT
# A release, in build/dist, after `make`: the sources, the images of each board, how to flash them, and the
# check sums of all of it:
#     tools/dist.sh VERSION
# The same tree makes the same bytes: times are those of the last commit, names are sorted, nobody is named.
set -euo pipefail
version=${1:?usage: tools/dist.sh VERSION}
out=build/dist
rm -rf "$out"
mkdir -p "$out"
time_s=$(git log -1 --format=%ct)
git ls-files -z | tar --null --files-from=- --sort=name --mtime="@$time_s" --owner=0 --group=0 --numeric-owner \
    --mode='go=u,go-w' --transform="s|^|fuzzy51-$version/|" -cf - | gzip -9n >"$out/fuzzy51-$version.tar.gz"

page=$out/FLASH.md
{
    echo "# How to flash fuzzy51 $version"
    echo
    echo "Each folder has the images of one board, APP.hex; README.md in the sources says what they do. \`make flash\`"
    echo "does the same from the sources. PORT is where the programmer is, such as /dev/ttyUSB0."
} >"$page"
for fragment in firmware/boards/*.mk; do
    board=$(basename "$fragment" .mk)
    mkdir "$out/$board"
    cp "build/$board"/*.hex "$out/$board/"
    [ ! -f "${fragment%.mk}.conf" ] || cp "${fragment%.mk}.conf" "$out/$board/"
    {
        echo
        echo "## $board"
        echo
        make -s "BOARD=$board" flash-page HEX="$board/APP.hex" PORT=PORT | sed "s|firmware/boards/$board.conf|$board/$board.conf|"
    } >>"$page"
done
# shellcheck disable=SC2094  # SHA256SUMS is left out
(cd "$out" && find . -type f ! -name SHA256SUMS -printf '%P\n' | LC_ALL=C sort | xargs sha256sum >SHA256SUMS)
echo "$out: $(find "$out" -name '*.hex' | wc -l) images, the sources, FLASH.md, SHA256SUMS"
