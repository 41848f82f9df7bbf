#!/bin/bash
# SPDX-License-Identifier: MIT
# An image says who it is, at a fixed place of the hex file; drive prints it, writes it into JSON and CSV,
# takes the crystal from it, and refuses the image where it does not belong.
. tests/lib.sh
board=stc89c516rd
make -s BOARD=$board build/$board/{brake,tuned,park}.ihx || exit 2
crc=$(awk '$2 == "LUT_CRC16" { print $3 }' build/$board/brake/lut_table.h)
who="fuzzy51 $(sed -n 's/^## \([0-9.]*\).*/\1/p;T;q' CHANGELOG.md) brake $board 12000000 Hz table=$crc"
run() {
    build/drive run --board "$board" --scenario tests/loop/start_inside_1m.scn "$@"
}

# The text at the address that the two bytes at 6 hold.
objcopy -I ihex -O binary "build/$board/brake.ihx" "$out/image.bin"
at=$(od -An -j 6 -N 2 -t u1 "$out/image.bin" | awk '{ print $1 + 256 * $2 }')
check "the bytes at 6 lead to the text" [ "$(tail -c "+$((at + 1))" "$out/image.bin" | head -c ${#who})" = "$who" ]

run --csv "$out/run.csv" --json "$out/run.json" --uart "$out/said" >"$out/stdout"
check "drive prints it" grep -qxF "  image: $who" "$out/stdout"
check "JSON has it" grep -qF "\"$who\"" "$out/run.json"
check "CSV has it in the first row" [ "$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == "image") at = k } NR == 2 { print $at }' "$out/run.csv")" = "$who" ]
check "CSV has it once" [ "$(grep -c fuzzy51 "$out/run.csv")" -eq 1 ]
check "the controller says it" grep -q "^# $who reset=power-on" "$out/said"

refuses "an image of another board" 2 "this image was built for board $board, not for at89s52; give --board=$board" \
    run --board at89s52 --hex "build/$board/brake.ihx"
refuses "an image of another world" 2 "this image is a controller 'park', and the scenario drives 'brake'" \
    run --hex "build/$board/park.ihx"
check "another law of the brake drives in its world" run --hex "build/$board/tuned.ihx"

# Another crystal: the firmware is built for it, and the simulator takes it from the image.
make -s BOARD=$board CLK_HZ=11059200 OUT="$out/crystal" "$out/crystal/brake.ihx" || exit 2
check "an image with another crystal drives" run --hex "$out/crystal/brake.ihx" --uart "$out/said"
check "and says its crystal" grep -q "^# fuzzy51 .* 11059200 Hz " "$out/said"
finish
