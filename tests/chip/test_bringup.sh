#!/bin/bash
# SPDX-License-Identifier: MIT
# The program for a freshly wired board, on each board: a key, or a press of the button, shows the next pin;
# the last step measures. The text is the one that docs/wiring.md has.
. tests/lib.sh
. tests/chip/lib.sh
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
# Echoes of 1,234 mm, of a clear road and of 1 cm; none; and then one that does not end.
widths_us=(7191 38000 58 0)
wanted_readings="dist_mm=1234
# echo: no target within 6 m
# echo: nearer than 2 cm, or noise
# echo: never came; look at TRIGGER, ECHO and the sensor's supply
# echo: never ends: the pin stays high; is the sensor connected?"

run() { # BOARD: leaves `levels`, a line a step, and the file $said
    local now=900000 step first k rise_us
    S51_TYPES=1 s51_start "$1" "build/$1/bringup.ihx"
    s51_pin 1000 echo 0
    s51_until $now
    levels=$(levels_at $now)
    for step in 1 2 3 4 5 6 7; do
        if [ $((step % 2)) -eq 1 ]; then
            s51_type $'n\n'
        else
            # It bounces, at both ends.
            s51_pin $((now + 1000)) override 0
            s51_pin $((now + 4000)) override 1
            s51_pin $((now + 5000)) override 0
            s51_pin $((now + 105000)) override 1
            s51_pin $((now + 109000)) override 0
            s51_pin $((now + 111000)) override 1
        fi
        now=$((now + 250000))
        s51_until $now
        levels+=$'\n'$(levels_at $now)
    done
    s51_until $((now + 600000))
    first=$(s51_edges port1_value.2 | awk -v from="$now" '$2 == 1 && $1 > from { printf "%d", $1; exit }')
    for k in "${!widths_us[@]}"; do
        rise_us=$((first + 500000 * (k + 1) + 600))
        [ "${widths_us[k]}" -eq 0 ] || s51_pin $rise_us echo 1
        [ "${widths_us[k]}" -eq 0 ] || s51_pin $((rise_us + widths_us[k])) echo 0
    done
    s51_pin $((rise_us + 500000)) echo 1
    s51_until $((rise_us + 800000))
    s51_type n
    s51_until $((rise_us + 950000))
    s51_stop
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
