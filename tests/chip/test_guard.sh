#!/bin/bash
# SPDX-License-Identifier: MIT
# On a board without a watchdog the PWM's interrupt starts a hung controller again, with the brake on, and then
# in FAULT until three good readings. The image is the brake's, with an endless loop while the override is pressed.
. tests/lib.sh
. tests/chip/lib.sh
export ENGINE=${ENGINE:-fast}
board=generic8052
image=build/$board/tests/chip/brake_hang.ihx
make -s "BOARD=$board" "$image" build/tests/fast_pins || exit 2

s51_start "$board" "$image"
s51_until 1000000
first_us=$(s51_first_trigger)
# A clear road: STOP is off. Triggers come with a tick, which is the last one that ends.
s51_echoes "$first_us" 1 10 none
fed_us=$((first_us + 60000 * 10))
s51_pin "$((fed_us + 5000))" override 0
s51_pin "$((fed_us + 12000))" override 1
s51_until "$((fed_us + 1100000))"
# The first trigger after the start, and readings from then on.
again_us=$(s51_edges port1_value.2 | awk -v from="$((fed_us + 100000))" '$2 == 1 && $1 > from { printf "%d", $1; exit }')
s51_until "$((fed_us + 1150000))"
for k in 6 7 8 9 10; do s51_echoes "${again_us:-0}" "$k" "$((k + 1))" none; done
s51_until "$((fed_us + 2000000))"
s51_stop

rise_us=$(s51_edges port1_value.1 | awk -v from="$((fed_us + 5000))" '$2 == 1 && $1 > from { printf "%d", $1; exit }')
check "a hung controller is started again 70 to 91 ms after its last tick" \
    [ "${rise_us:-0}" -ge "$((fed_us + 70000))" -a "${rise_us:-0}" -le "$((fed_us + 91000))" ]
sed -n '/reset=watchdog/,$p' "$s51_uart" >"$out/after"
check "once" [ "$(grep -ac reset= "$s51_uart")" -eq 2 ]
check "it starts in FAULT at 60 percent" grep -aqE '^1,[0-9]+,,0,0,0,60,FAULT,' "$out/after"
check "three good readings release it" grep -aqE ',0,RELEASED,0' "$out/after"
s51_clean
finish
