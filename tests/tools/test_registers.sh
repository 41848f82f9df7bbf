#!/bin/bash
# SPDX-License-Identifier: MIT
# Each bit of the registers that the brake sets again in each round of its main loop (firmware/mcu/registers.c),
# and of its output port: flipped once, at two instants of an approach, it leads to no impact and to no
# FAULT. It may spoil one reading, or turn STOP on for a tick. In timer 0's mode 3, until the next round, timer 0 adds
# ticks: four of them are FAULT 12, a wrong clock, which ends. The board has no watchdog, so nothing else helps.
. tests/lib.sh
board=generic8052
make -s BOARD=$board build/$board/brake.ihx || exit 2

# TCON TMOD IE IP SCON T2CON RCAP2L RCAP2H P3 P1
registers=(0x88 0x89 0xA8 0xB8 0x98 0xC8 0xCA 0xCB 0xB0 0x90)
# At 11.0592 MHz these are 0.54 s, in the self-test, and 1.11 s, while an echo is awaited.
cycles=(500000 1020000)

sed '/^never = FAULT$/d' tests/loop/standing_car_5mps.scn >"$out/wrong_clock.scn"
flip() { # REGISTER CYCLE: what is wrong, a line for each bit
    local bit name scenario
    for bit in 0 1 2 3 4 5 6 7; do
        name=$out/$1_$2_$bit
        scenario=tests/loop/standing_car_5mps.scn
        [ "$1 $bit" != "0x89 1" ] || scenario=$out/wrong_clock.scn
        build/drive run --engine=fast --board "$board" --scenario "$scenario" \
            --set=flip.place=sfr --set=flip.address="$1" --set=flip.bit="$bit" --set=flip.at_cycle="$2" --brief \
            --uart="$name.uart" >"$name" 2>&1 || echo "bit $bit at cycle $2: $(grep -v PASS "$name" | head -n 1)"
        wrong_clock "$name.uart" || echo "bit $bit at cycle $2: a FAULT that is not 12, or lasts"
    done
}
# FAULT begins with 12, if at all, and is over at the end.
wrong_clock() { # UART
    tr -d '\r' <"$1" | awk -F, 'NF == 9 && $8 == "FAULT" && !faults++ { bad = $9 != 12 } NF == 9 { last = $8 } END { exit bad || last == "FAULT" || last == "" }'
}
for register in "${registers[@]}"; do
    faultless "a bit of the register at $register flips" \
        "$(for cycle in "${cycles[@]}"; do flip "$register" "$cycle"; done)"
done
finish
