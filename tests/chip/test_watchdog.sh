#!/bin/bash
# SPDX-License-Identifier: MIT
# The AT89S52's watchdog resets a hung controller in time. The controller then starts with the brake on,
# in FAULT, until three good readings. The image is the brake's, with an endless loop while the override
# is pressed.
. tests/lib.sh
. tests/chip/lib.sh
board=at89s52
image=build/$board/tests/chip/brake_hang.ihx
make -s "BOARD=$board" "$image" || exit 2
mapfile -t listings < <(sed -n 's/\.rel$/.rst/p' "build/$board/brake.lk")
check "the brake's own listings keep its addresses" build/bound "build/$board/brake.ihx" "build/$board/brake.map" "${listings[@]}"

# No echo: it brakes with 60 %, so the PWM's edges tell the time of the reset to 6 ms.
s51_start "$board" "$image"
s51_until 600000
first_us=$(s51_first_trigger)
# Triggers come with a tick, which feeds the watchdog; the next tick sees the press and hangs.
fed_us=$((first_us + 60000 * 20))
s51_pin "$((fed_us + 5000))" override 0
s51_pin "$((fed_us + 12000))" override 1
# After the reset time starts at 0 again; the boot takes as long as before.
s51_until "$((first_us + 60000 * 25))"
s51_echoes "$first_us" 26 36 none
s51_until "$((first_us + 60000 * 40))"
s51_stop

pwm=$s51_dir/pwm
s51_edges port1_value.0 >"$pwm"
reset_us=$(awk '$2 == "reset" { printf "%d", $1; exit }' "$pwm")
# Of a pin after the reset, counted from there. s51 sets its clock to 0 some 0.4 ms before the reset.
fall_us() {
    s51_edges "port1_value.$1" | awk '$2 == "reset" { base = $1 } base != "" && $2 == 0 && $1 > base + 1000 { printf "%d", $1 - base; exit }'
}

check "a_hung_controller_is_reset_16_ms_after_the_last_feed" \
    [ "${reset_us:-0}" -gt "$((fed_us + 10000))" -a "${reset_us:-0}" -le "$((fed_us + 17000))" ]
check "only_one_reset" [ "$(grep -c reset "$pwm")" -eq 1 ]
check "the_brake_is_full_while_it_boots" [ "$(fall_us 0)" -ge 100000 ]
check "the_STOP_pin_is_on_while_it_boots" [ "$(fall_us 1)" -ge 100000 ]
sed -n '/reset=watchdog/,$p' "$s51_uart" >"$s51_dir/after"
check "the_title_names_the_watchdog" [ -s "$s51_dir/after" ]
check "it_starts_in_fault_at_60_percent" grep -aqE '^1,[0-9]+,,0,0,0,60,FAULT,' "$s51_dir/after"
check "three_good_readings_release_it" grep -aqE ',0,RELEASED,0' "$s51_dir/after"
s51_clean

# The STC89's tells by a flag that it was it. s51 does not have that watchdog.
board=stc89c516rd
image=build/$board/brake.ihx
make -s "BOARD=$board" "$image" build/tests/fast_pins || exit 2
ENGINE=fast
s51_start "$board" "$image"
s51_jump 800000 0xFFFE
s51_until 1200000
s51_stop
check "an_STC89_is_reset_once_and_knows_it" [ "$(grep -ac 'reset=watchdog' "$s51_uart")" -eq 1 ]
s51_clean
finish
