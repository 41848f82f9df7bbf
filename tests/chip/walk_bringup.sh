# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Walks through the steps of the bringup image, for tests that have read tests/chip/lib.sh. A test that wants to look
# at each step has a function at_step; it gets the time.

# Echoes of 1,234 mm, of a clear road and of 1 cm; none; and then one that does not end.
bringup_widths_us=(7191 38000 58 0)

walk_bringup() { # BOARD IMAGE.ihx; ends after s51_stop, before s51_clean
    local now=900000 step first k rise_us
    S51_TYPES=1 s51_start "$1" "$2"
    s51_pin 1000 echo 0
    s51_until $now
    at_step $now
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
        at_step $now
    done
    s51_until $((now + 600000))
    first=$(s51_edges port1_value.2 | awk -v from="$now" '$2 == 1 && $1 > from { printf "%d", $1; exit }')
    for k in "${!bringup_widths_us[@]}"; do
        rise_us=$((first + 500000 * (k + 1) + 600))
        [ "${bringup_widths_us[k]}" -eq 0 ] || s51_pin $rise_us echo 1
        [ "${bringup_widths_us[k]}" -eq 0 ] || s51_pin $((rise_us + bringup_widths_us[k])) echo 0
    done
    s51_pin $((rise_us + 500000)) echo 1
    s51_until $((rise_us + 800000))
    s51_type n
    s51_until $((rise_us + 950000))
    s51_stop
}
