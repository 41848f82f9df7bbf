#!/bin/bash
# SPDX-License-Identifier: MIT
# A release holds the sources and the images of each board with their check sums, and the same tree makes the
# same bytes.
. tests/lib.sh
# The test of a whole tree builds all boards before; alone it builds what it lacks.
version=$(sed -n 's/^## \([0-9.]*\).*/\1/p;T;q' CHANGELOG.md)
make -s all >/dev/null || exit 2
tools/dist.sh "$version" >/dev/null || exit 2
cp -R build/dist "$out/first"
tools/dist.sh "$version" >/dev/null
check "twice the same" diff -r "$out/first" build/dist

check "the check sums hold" env -C build/dist sha256sum --quiet -c SHA256SUMS
check "they name every file" [ "$(wc -l <build/dist/SHA256SUMS)" -eq "$(find build/dist -type f ! -name SHA256SUMS | wc -l)" ]
for fragment in firmware/boards/*.mk; do
    board=$(basename "$fragment" .mk)
    check "$board has each image" [ "$(cd build/dist/"$board" && ls -- *.hex)" = "$(cd build/"$board" && ls -- *.hex)" ]
    check "$board is in the page" grep -qx "## $board" build/dist/FLASH.md
done
check "the page has avrdude's line" grep -qF "    avrdude -C +at89s52/at89s52.conf -c avrisp -b 19200 -P PORT -p AT89S52 -U flash:w:at89s52/APP.hex:i" build/dist/FLASH.md
tar -tzf "build/dist/fuzzy51-$version.tar.gz" | sed "s|^fuzzy51-$version/||" | LC_ALL=C sort >"$out/packed"
check "the sources are whole" diff <(git ls-files | LC_ALL=C sort) "$out/packed"

# An image compiled anew, elsewhere, has the same bytes.
make -s BOARD=at89s52 OUT="$out/again" "$out/again/brake.hex" "$out/again/gap.hex" >/dev/null 2>&1
packihx "$out/again/brake.ihx" 2>/dev/null >"$out/brake.hex"
packihx "$out/again/gap.ihx" 2>/dev/null >"$out/gap.hex"
check "brake built anew is the same" cmp "$out/brake.hex" build/dist/at89s52/brake.hex
check "gap built anew is the same" cmp "$out/gap.hex" build/dist/at89s52/gap.hex
finish
