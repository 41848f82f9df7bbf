#!/bin/bash
# SPDX-License-Identifier: MIT
# Every cell of every table of build/lut, looked up on the chip by the code that ships, and on the
# host by the same code, against fistab's CSV; the cycles of each look-up; the check sum.
. tests/lib.sh
cases=0

for dir in build/lut/*/; do
    dir=${dir%/}
    cases=$((cases + 1))
    if ! line=$(tests/lut/run.sh "$dir" 2>&1); then
        say "$dir: end_line" 1 "$line"
        continue
    fi
    # bytes N least N most N call N crc_byte N crc_slice N crc right end
    read -r _ _ _ least _ most _ _ _ crc_byte _ crc_slice _ crc _ <<<"$line"

    od -An -v -tu1 -w1 "$dir/cells.bin" | tr -d ' ' >"$dir/cells.chip"
    tail -n +2 "$dir/cells.csv" | sed 's/.*,//' >"$dir/cells.fistab"
    difference=$(cmp "$dir/cells.fistab" "$dir/cells.chip" 2>&1) && [ -s "$dir/cells.fistab" ]
    say "$dir: every_cell_is_fistabs" $? "$difference ($(wc -l <"$dir/cells.chip") cells came)"

    "$dir/host" >"$dir/host.bin" 2>"$dir/host.log" && cmp -s "$dir/host.bin" "$dir/cells.bin"
    say "$dir: the_host_has_the_same_cells" $? "see $dir/host.log"

    case $dir in
    */plain-256) limit=25 ;; # 256 columns: a shift in place of the `mul ab`
    */plain*) limit=24 ;;
    *) limit=120 ;;
    esac
    [ "$most" -le "$limit" ]
    say "$dir: look_up_within_${limit}_mc" $? "$least to $most mc"
    [ $((most - least)) -le 20 ]
    say "$dir: same_cycles_within_20_mc" $? "$least to $most mc"
    [ "$crc" = right ]
    say "$dir: check_sum_is_the_headers" $? "the chip's sum of the table differs"
    [ "$crc_byte" -le 44 ] && [ "$crc_slice" -le 40 ]
    say "$dir: check_sum_cycles_as_lut_h_says" $? "$crc_byte a byte, $crc_slice a slice"
done
[ "$cases" -gt 0 ]
say "there are images in build/lut" $? "run: make run-test"
finish
