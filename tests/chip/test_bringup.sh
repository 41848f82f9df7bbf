#!/bin/bash
# SPDX-License-Identifier: MIT
# The program for a freshly wired board, on each board: a key, or a press of the button, shows the next pin;
# the last step measures. The text is the one that docs/wiring.md has.
. tests/lib.sh
. tests/chip/lib.sh
. tests/chip/walk_bringup.sh
export ENGINE=${ENGINE:-fast}
make -s build/tests/fast_pins || exit 2

# The share of 30 ms before a time, in percent, that PWM, STOP, lamp and buzzer were high.
levels_at() { # TIME_US
    local bit
    for bit in 0 1 3 4; do
        s51_edges "port1_value.$bit" | awk -v to="$1" '
            BEGIN { from = at = to - 30000; level = 1 }
            $1 >= to { exit }
            $1 > from { high += level * ($1 - at); at = $1 }
            { level = $2 }
            END { high += level * (to - at); printf "%.0f ", high / 300 }'
    done | xargs
}

# What the pins must show, step by step, and what the page says of each step.
wanted_levels='100 100 100 100
100 100 0 100
100 100 100 0
0 0 100 100
0 100 100 100
100 0 100 100
50 0 100 100
100 100 100 100'
wanted_steps=$(sed -n 's/^| `\(# step [^`]*\)`.*/\1/p' docs/wiring.md)
# What the echoes of walk_bringup.sh give.
wanted_readings="dist_mm=1234
# echo: no target within 6 m
# echo: nearer than 2 cm, or noise
# echo: never came; look at TRIGGER, ECHO and the sensor's supply
# echo: never ends: the pin stays high; is the sensor connected?"

at_step() { # TIME_US
    levels+=${levels:+$'\n'}$(levels_at "$1")
}

run() { # BOARD: leaves `levels`, a line a step, and the file $said
    levels=''
    walk_bringup "$1" "build/$1/bringup.ihx"
    said=$out/$1
    tr -d '\r' <"$s51_uart" >"$said"
    s51_clean
}

for fragment in firmware/boards/*.mk; do
    board=$(basename "$fragment" .mk)
    make -s "BOARD=$board" "build/$board/bringup.ihx" || exit 2
    run "$board"
    crc=$(awk '$2 == "LUT_CRC16" { print $3 }' "build/$board/bringup/lut_table.h")
    check "${board} says who it is" grep -qx "# fuzzy51 [0-9.]* bringup $board $(s51_board "$board" CLK_HZ) Hz table=$crc reset=power-on" "$said"
    check "${board} finds table and RAM good" grep -q "^# table good, RAM good; " "$said"
    check "${board} shows each pin by itself" [ "$levels" = "$wanted_levels" ]
    check "${board} says the steps of docs/wiring.md, then the first again" \
        [ "$(grep '^# step' "$said")" = "$wanted_steps"$'\n'"$(head -n 1 <<<"$wanted_steps")" ]
    # The first trigger is before the first echo.
    check "${board} measures" [ "$(grep -E '^(dist_mm|# echo)' "$said" | sed 1d)" = "$wanted_readings" ]
done
finish
