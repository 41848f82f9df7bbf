#!/bin/bash
# SPDX-License-Identifier: MIT
# The tables of radar and park: what fistab makes of them, against reference data.
. tests/lib.sh

# The numbers of a header's first table, one row a line.
cells_of() {
    sed -n '/lut_out1/,/};/p' "$1" | sed -n 's/^ *{\(.*\),},$/\1/p' | tr ',' ' '
}

radar_table() {
    build/fistab table "$1" --name=lut --grid=13x13 --samples=7 --levels=240 --half-down -o "$2"
}

radar_table tables/radar.fis "$out/radar.h" && cells_of "$out/radar.h" >"$out/radar.txt"
sed 1d tests/golden/radar_table.txt | diff - "$out/radar.txt" >"$out/radar.diff"
say "radar_table_is_the_printed_one" $? "differs: $(head -n 4 "$out/radar.diff" | tr '\n' ' ')"

# The check can fail: MATLAB's 101 samples are no substitute for the seven of the publication.
build/fistab table tables/radar.fis --name=lut --grid=13x13 --levels=240 --half-down -o "$out/radar101.h"
! cells_of "$out/radar101.h" | diff -q "$out/radar.txt" - >/dev/null
say "101_samples_make_another_table" $? "the same table with 7 and with 101 samples"

# w(D) of the blend, a straight line between 3 and 7 m.
for point in 3:0 4:0.25 5:0.5 6:0.75 7:1; do
    build/fistab eval tables/park.fis "${point%:*}" >"$out/w"
    [ "$(cat "$out/w")" = "${point#*:}" ]
    say "park_blend_at_${point%:*}_m" $? "w is $(cat "$out/w"), not ${point#*:}"
done
finish
