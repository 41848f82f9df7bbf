#!/bin/bash
# SPDX-License-Identifier: MIT
# The PWM, measured by the edges of its pin on each board while UART and echo are busy: the duty is exact,
# the periods are whole, a change adds no edge, and a new duty holds from the next period on. The image is
# the brake's, with fixed duties (tests/chip/brake_duties.c).
. tests/lib.sh
. tests/chip/lib.sh

run() { # BOARD
    local image=build/$1/tests/chip/brake_duties.ihx cell first
    make -s "BOARD=$1" "$image" || exit 2
    cell=$(s51_cell "$image" duty_pct)
    s51_start "$1" "$image" "$cell"
    s51_until 1000000
    first=$(s51_first_trigger)
    s51_echoes "$first" 13 160 2000
    s51_until $((first + 60000 * 160))
    s51_stop
    s51_edges "$cell" >"$s51_dir/asked"
    s51_edges port1_value.0 >"$s51_dir/pwm"
    awk -v "clk_hz=$(s51_board "$1" CLK_HZ)" -f tests/chip/pwm_periods.awk "$s51_dir/asked" "$s51_dir/pwm" >"$s51_dir/found"
    lines=$(grep -acE ',(1999|200[01]),' "$s51_uart")
}
found() { # NAME
    awk -v name="$1" '{ for (i = 1; i < NF; i += 2) if ($i == name) print $(i + 1) }' "$s51_dir/found"
}
at_most() { # VALUE LIMIT
    awk -v value="$1" -v limit="$2" 'BEGIN { exit !(value != "" && value <= limit) }'
}

# Edges are measured to the cycle, and uCsim 0.8.15 loses one with each interrupt: 5,001 where 0.6.4 has 5,000.
# Then our own simulator measures.
if ! build/drive canary | grep -qF "comes every 5000.00 us"; then
    make -s build/tests/fast_pins || exit 2
    export ENGINE=fast
fi
for board in at89s52 generic8052 stc89c516rd; do
    run "$board"
    cat "$s51_dir/found" >&2
    thousandth_mc=$(($(s51_board "$board" CLK_HZ) / 1200 / 1000))
    check "${board}_the_uart_and_the_echo_were_busy" [ "$lines" -ge 100 ]
    check "${board}_all_duties_came_by" [ "$(found duties)" = 101 ]
    check "${board}_each_period_is_one_duty_asked_in_time_for_it" [ "$(found wrong)" = 0 ]
    check "${board}_duties_are_right_to_a_thousandth" at_most "$(found error_mc)" "$thousandth_mc"
    check "${board}_periods_are_right_to_a_thousandth_and_never_drift" at_most "$(found drift_mc)" "$thousandth_mc"
    check "${board}_a_new_duty_waits_a_period_and_140_cycles_at_most" at_most "$(found late_us)" $((10000 + 140 * 12000000 / $(s51_board "$board" CLK_HZ)))
    s51_clean
done
finish
