#!/bin/bash
# SPDX-License-Identifier: MIT
# Each finding of the self-test ends in FAULT until the next start, with its code in the telemetry and on
# the lamp. STOP still works then.
. tests/lib.sh
. tests/chip/lib.sh
board=at89s52
# In uCsim 0.8.15 triggers come a little late, up to 2 ms after 150 readings.
s51_echo_after_us=4000
make -s "BOARD=$board" "build/$board/brake.ihx" "build/$board/tests/chip/brake_overflow.ihx" || exit 2

# Blinks between the first two pauses of the lamp (low is lit) from a time on. A pause is a second and
# more from fall to fall, within a number half a second.
blinks() { # FROM_US
    s51_edges port1_value.3 | awk -v from="$1" '
        $1 < from || $2 == level { next }
        { level = $2 }
        level == 0 {
            if (fall && $1 - fall > 1000000) {
                if (pauses++) { print count; exit }
                count = 0
            }
            count++
            fall = $1
        }'
}

# Runs the image for 150 readings: 2.4 s of echoes of 3 m, the override or not, more of them, and at
# last two of 0.6 m.
run() { # IMAGE press|high|stuck|""
    local first
    s51_start "$board" "$1"
    if [ "$2" = high ]; then s51_pin 2 echo 1; fi
    if [ "$2" = stuck ]; then stick; fi
    s51_until 500000
    if [ "$2" = high ]; then s51_until 600000; fi
    first=$(s51_first_trigger)
    if [ "$2" = high ]; then s51_pin 605000 echo 0; fi
    s51_echoes "$first" 3 40 3000
    if [ "$2" = press ]; then
        s51_pin $((first + 60000 * 40)) override 0
        s51_pin $((first + 60000 * 40 + 20000)) override 1
    fi
    s51_echoes "$first" 41 148 3000
    s51_echoes "$first" 148 150 600
    s51_until $((first + 60000 * 150))
    s51_stop
    tr -d '\r' <"$s51_uart" >"$out/said"
}

# uCsim 0.8.15 loses a count of the echo now and then, with each interrupt in it.
near_3000='(2999|3000)'
shows() { # CODE, after the fault came
    grep -qE "^[0-9]+,[0-9]+,$near_3000,-?[0-9]+,[0-9]+,[0-9]+,60,FAULT,$1\$" "$out/said"
}
never_leaves() { # CODE once there
    awk -F, -v code="$1" '/^[0-9]+,/ { if ($9 == code) seen = 1; else if (seen) left = 1 } END { exit !seen || left }' "$out/said"
}
stops() {
    awk -F, '$3 >= 599 && $3 <= 600 && $7 == 100 { seen = 1 } END { exit !seen }' "$out/said"
}

run "build/$board/brake.ihx" ""
check "a_good_image_controls" grep -qE ",$near_3000,-?[0-9]+,(49|5[0-9]),0,[0-9]+,CONTROL,0\$" "$out/said"
check "a_good_image_shows_no_fault" [ -z "$(grep -E 'FAULT,([89]|1[01])' "$out/said")" ]
s51_clean

# The table's bytes lie in lut's constants.
awk -v "address=$(($(address_of _lut_out1 "build/$board/brake/lib/lut.rst") + 1000))" -f tests/chip/flip_byte.awk "build/$board/brake.ihx" >"$out/flipped.ihx"
check "one_bit_of_the_table_is_flipped" [ "$(cmp -l "build/$board/brake.ihx" "$out/flipped.ihx" | wc -l)" -ge 2 ]
run "$out/flipped.ihx" ""
check "a_flipped_bit_in_the_table_is_fault_8" shows 8
check "a_flipped_bit_lasts" never_leaves 8
check "a_flipped_bit_still_stops" stops
check "a_flipped_bit_blinks_2" [ "$(blinks 400000)" = 2 ]
s51_clean

# A bit of RAM that keeps its level: around the end of the instruction that writes one of the test's two
# patterns there, the byte takes the value that such a bit leaves. uCsim 0.6.4 stores at the end of that
# instruction, 0.8.15 at its start.
stick() { # uses S51_SETS, $bit and $level
    local time_us byte
    while read -r time_us byte; do
        byte=$(((2#$byte & ~(1 << bit)) | level << bit))
        s51_set $((time_us - 1)) "$byte"
        s51_set "$time_us" "$byte"
    done <"$out/patterns"
}
patterns() { # CELL: when each pattern is written there, and the pattern
    s51_start "$board" "build/$board/brake.ihx" "$1"
    s51_until 20000
    s51_stop
    s51_edges "$1" | awk '$2 == "01010101" || $2 == "10101010" { printf "%d %s\n", $1, $2 }' | head -n 2
    s51_clean
}
for case in "0x08 0 0" "0x50 7 1" "0xff 5 0"; do
    read -r cell bit level <<<"$case"
    patterns "iram[$cell]" >"$out/patterns"
    check "both_patterns_are_written_to_$cell" [ "$(wc -l <"$out/patterns")" -eq 2 ]
    S51_SETS="iram[$cell]" run "build/$board/brake.ihx" stuck
    check "bit_${bit}_of_${cell}_stuck_at_${level}_is_fault_9" shows 9
    check "bit_${bit}_of_${cell}_stuck_at_${level}_lasts" never_leaves 9
    check "bit_${bit}_of_${cell}_stuck_at_${level}_blinks_3" [ "$(blinks 400000)" = 3 ]
    s51_clean
done

run "build/$board/tests/chip/brake_overflow.ihx" press
check "a_full_stack_is_fault_10" shows 10
check "a_full_stack_lasts" never_leaves 10
check "a_full_stack_blinks_4" [ "$(blinks 3000000)" = 4 ]
s51_clean

run "build/$board/brake.ihx" high
check "a_line_high_at_rest_is_fault_11" shows 11
check "a_line_high_lasts" never_leaves 11
check "a_line_high_blinks_5" [ "$(blinks 400000)" = 5 ]
s51_clean
finish
