#!/bin/bash
# SPDX-License-Identifier: MIT
# fistab table --repair and --encoding=packed from the command line: what is written and what is said.
. tests/lib.sh

table() { build/fistab table "$@"; }
refuses_table() { # NAME STATUS TEXT OPTION...
    refuses "$1" "$2" "$3" build/fistab table "${@:4}" -o "$out/refused.h"
}

table tables/brake.fis --csv="$out/before.csv"
table tables/brake.fis --repair=-1,+2 --csv="$out/after.csv" --changes="$out/changes.csv" \
    --name=lut -o "$out/plain.h" 2>"$out/summary"
check summary_has_count_and_largest_change grep -q \
    "'brake_pct' broke -1,+2 between 650 pairs .* changing 3531 of 10000 cells by at most 3;" "$out/summary"
check header_says_so grep -q 'Repair: -1,+2; 3531 of 10000 cells of output 1 changed by at most 3' "$out/plain.h"

# The listing holds the cells in which the two tables differ, no more, with both values.
paste -d, "$out/before.csv" "$out/after.csv" |
    awk -F, 'NR > 1 && $3 != $6 { n = NR - 2; printf "%d,%d,%s,%s,%d,%d\n", n / 100, n % 100, $1, $2, $3, $6 }' >"$out/differ"
awk -F, 'NR > 1 { printf "%d,%d,%s,%s,%d,%d\n", $1, $2, $3, $4, $7, $8 }' "$out/changes.csv" >"$out/listed"
check every_changed_cell_is_listed cmp "$out/differ" "$out/listed"
check there_are_as_many_as_it_says test "$(wc -l <"$out/listed")" -eq 3531
obeys() { # CSV of 100 by 100 cells
    awk -F, 'NR > 1 { c = (NR - 2) % 100
        if ((c > 0 && $3 < left) || (NR > 101 && $3 > above[c])) bad++
        left = above[c] = $3 } END { print bad + 0, "pairs"; exit bad > 0 || NR != 10001 }' "$1"
}
check the_written_table_obeys obeys "$out/after.csv"
check the_unrepaired_one_does_not eval '! obeys "$out/before.csv"'

table tables/brake.fis --repair=-1,+2 --encoding=packed --name=lut -o "$out/packed.h" --csv="$out/packed.csv" 2>/dev/null
table tables/brake.fis --repair=-1,+2 --encoding=packed --name=lut -o "$out/again.h" 2>/dev/null
check packing_changes_no_cell cmp "$out/after.csv" "$out/packed.csv"
check same_input_same_bytes cmp "$out/packed.h" "$out/again.h"
packed_bytes() {
    local bytes
    bytes=$(awk '$2 == "LUT_BYTES" { print $3 }' "$out/packed.h")
    echo "$bytes bytes"
    [ "$bytes" -lt 2000 ]
}
check repaired_brake_packs_below_2000_bytes packed_bytes
check header_says_that_it_is_packed grep -q '#define LUT_PACKED 1' "$out/packed.h"

refuses_table three_inputs_do_not_pack 1 'a packed table has two inputs and one output' tables/follow.fis --encoding=packed
refuses_table one_input_does_not_pack 1 'a packed table has two inputs and one output' tests/lut/one_input.fis --encoding=packed
refuses_table too_long_axes_do_not_pack 1 '300 by 10 cells' tables/brake.fis --grid=300x10 --encoding=packed --target=c
refuses_table tiny_tables_do_not_pack 1 'it would take' tables/brake.fis --grid=2x2 --encoding=packed
refuses_table unknown_encodings_are_usage 2 'give plain or packed' tables/brake.fis --encoding=tight
refuses_table laws_without_sign_are_usage 2 'give a sign and an input each' tables/brake.fis --repair=1,2
refuses_table laws_on_missing_inputs_are_usage 2 'names input 3, but the system has 2 inputs' tables/brake.fis --repair=+3
refuses_table changes_without_repair_are_usage 2 'give --repair=SPEC too' tables/brake.fis --changes="$out/none.csv"
check refusals_write_nothing test ! -e "$out/refused.h"
finish
