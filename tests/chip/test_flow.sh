#!/bin/bash
# SPDX-License-Identifier: MIT
# A job that runs twice in a round starts the controller again, with the brake on, within two ticks. The board
# has no watchdog, so nothing else helps. The image is the brake's, with a job that runs twice while the
# override is pressed.
. tests/lib.sh
. tests/chip/lib.sh
export ENGINE=${ENGINE:-fast}
board=generic8052
image=build/$board/tests/chip/brake_flow.ihx
make -s "BOARD=$board" "$image" build/tests/fast_pins || exit 2

s51_start "$board" "$image"
s51_until 1000000
first_us=$(s51_first_trigger)
# A clear road: STOP is off.
s51_echoes "$first_us" 1 10 none
pressed_us=$((first_us + 60000 * 9 + 45000))
s51_until "$pressed_us"
titles=$(grep -ac reset= "$s51_uart")
s51_pin "$((pressed_us + 10))" override 0
s51_pin "$((pressed_us + 20010))" override 1
s51_until "$((pressed_us + 600000))"
s51_stop

rise_us=$(s51_edges port1_value.1 | awk -v from="$pressed_us" '$2 == 1 && $1 > from { printf "%d", $1; exit }')
check "good rounds go on" [ "$titles" -eq 1 ]
check "a job that runs twice is STOP in 21 ms" [ "${rise_us:-0}" -gt "$pressed_us" -a "${rise_us:-0}" -le "$((pressed_us + 21000))" ]
check "it starts again as after a reset" [ "$(grep -ac reset=watchdog "$s51_uart")" -ge 1 ]
s51_clean
finish
