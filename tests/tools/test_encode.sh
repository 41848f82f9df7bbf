#!/bin/bash
# fistab table --repair and --encoding=packed from the command line: what is written and what is said.
set -u
work=$(mktemp -d build/test_encode.XXXXXX)
trap 'rm -rf "$work"' EXIT
failed=0

check() { # NAME COMMAND...
    local name=$1
    shift
    if "$@" >"$work/said" 2>&1; then
        echo "tests/tools/test_encode.sh:${BASH_LINENO[0]}:$name:PASS"
    else
        echo "tests/tools/test_encode.sh:${BASH_LINENO[0]}:$name:FAIL: $(tr '\n' ' ' <"$work/said" | cut -c1-300)"
        failed=1
    fi
}
table() { build/fistab table "$@"; }
refuses() { # STATUS TEXT OPTION...: nothing is written, the message has TEXT
    local wanted=$1 text=$2 got=0
    shift 2
    table "$@" -o "$work/refused.h" >"$work/message" 2>&1 || got=$?
    [ "$got" -eq "$wanted" ] && grep -qF -- "$text" "$work/message" && [ ! -e "$work/refused.h" ] || {
        echo "exit status $got: $(cat "$work/message")"
        return 1
    }
}

table tables/brake.fis --csv="$work/before.csv"
table tables/brake.fis --repair=-1,+2 --csv="$work/after.csv" --changes="$work/changes.csv" \
    --name=lut -o "$work/plain.h" 2>"$work/summary"
check summary_has_count_and_largest_change grep -q \
    "'brake_pct' broke -1,+2 between 650 pairs .* changing 3531 of 10000 cells by at most 3;" "$work/summary"
check header_says_so grep -q 'Repair: -1,+2; 3531 of 10000 cells of output 1 changed by at most 3' "$work/plain.h"

# The listing holds the cells in which the two tables differ, no more, with both values.
paste -d, "$work/before.csv" "$work/after.csv" |
    awk -F, 'NR > 1 && $3 != $6 { n = NR - 2; printf "%d,%d,%s,%s,%d,%d\n", n / 100, n % 100, $1, $2, $3, $6 }' >"$work/differ"
awk -F, 'NR > 1 { printf "%d,%d,%s,%s,%d,%d\n", $1, $2, $3, $4, $7, $8 }' "$work/changes.csv" >"$work/listed"
check every_changed_cell_is_listed cmp "$work/differ" "$work/listed"
check there_are_as_many_as_it_says test "$(wc -l <"$work/listed")" -eq 3531
obeys() { # CSV of 100 by 100 cells
    awk -F, 'NR > 1 { c = (NR - 2) % 100
        if ((c > 0 && $3 < left) || (NR > 101 && $3 > above[c])) bad++
        left = above[c] = $3 } END { print bad + 0, "pairs"; exit bad > 0 || NR != 10001 }' "$1"
}
check the_written_table_obeys obeys "$work/after.csv"
check the_unrepaired_one_does_not eval '! obeys "$work/before.csv"'

table tables/brake.fis --repair=-1,+2 --encoding=packed --name=lut -o "$work/packed.h" --csv="$work/packed.csv" 2>/dev/null
table tables/brake.fis --repair=-1,+2 --encoding=packed --name=lut -o "$work/again.h" 2>/dev/null
check packing_changes_no_cell cmp "$work/after.csv" "$work/packed.csv"
check same_input_same_bytes cmp "$work/packed.h" "$work/again.h"
packed_bytes() {
    local bytes
    bytes=$(awk '$2 == "LUT_BYTES" { print $3 }' "$work/packed.h")
    echo "$bytes bytes"
    [ "$bytes" -lt 2000 ]
}
check repaired_brake_packs_below_2000_bytes packed_bytes
check header_says_that_it_is_packed grep -q '#define LUT_PACKED 1' "$work/packed.h"

check three_inputs_do_not_pack refuses 1 'a packed table has two inputs and one output' tables/follow.fis --encoding=packed
check one_input_does_not_pack refuses 1 'a packed table has two inputs and one output' tests/lut/one_input.fis --encoding=packed
check too_long_axes_do_not_pack refuses 1 '300 by 10 cells' tables/brake.fis --grid=300x10 --encoding=packed
check tiny_tables_do_not_pack refuses 1 'it would take' tables/brake.fis --grid=2x2 --encoding=packed
check unknown_encodings_are_usage refuses 2 'give plain or packed' tables/brake.fis --encoding=tight
check laws_without_sign_are_usage refuses 2 'give a sign and an input each' tables/brake.fis --repair=1,2
check laws_on_missing_inputs_are_usage refuses 2 'names input 3, but the system has 2 inputs' tables/brake.fis --repair=+3
check changes_without_repair_are_usage refuses 2 'give --repair=SPEC too' tables/brake.fis --changes="$work/none.csv"
exit "$failed"
