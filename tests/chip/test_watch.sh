#!/bin/bash
# SPDX-License-Identifier: MIT
# What the brake finds in RAM and in the processor while it drives, and within which time (docs/brake.md): a stuck bit
# of RAM is fault 9, a stuck bit of a register is full brake. The bytes of RAM are unused ones of the stack, one of
# the interrupt's registers, and the test's own.
. tests/lib.sh
board=at89s52
image=build/$board/brake.ihx
make -s "BOARD=$board" "$image" || exit 2
tested=$(awk '$2 == "_ram_tested" { print "0x" substr($1, 7); exit }' "${image%.ihx}.map")

# A clear road, and from half a second on a bit is stuck.
drive() { # NAME PLACE ADDRESS BIT low|high EXPECTED...
    local name=$1 place=$2 address=$3 bit=$4 kind=$5 expected
    shift 5
    printf -v expected '%s\n' "$@"
    cat >"$out/$name.scn" <<END
[scenario]
title = Stuck bit
duration_s = 1.5
hold_s = 0.2
event_s = 0.5

[ego]
speed_mps = 1

[flip]
kind = $kind
place = $place
address = $address
bit = $bit
at_s = 0.5

[expect]
$expected
END
    build/drive run --engine=fast --board "$board" --hex "$image" --scenario "$out/$name.scn" --uart "$out/$name.uart" --brief >"$out/$name" 2>&1
    faultless "$name" "$(grep -v ':PASS' "$out/$name")"
}

for case in "0xC1 3 low" "0xC1 2 high" "0xFE 7 low" "0xE0 0 high" "0x0C 6 high" "$tested 5 low"; do
    read -r address bit kind <<<"$case"
    name=ram_${address}_bit_${bit}_$kind
    drive "$name" ram "$address" "$bit" "$kind" 'final_state = FAULT' 'fault_within_s <= 0.3'
    check "${name}_is_fault_9" grep -aqE 'FAULT,9' "$out/$name.uart"
done
for case in "0xF0 0 high" "0xF0 7 low" "0x82 4 low" "0x83 6 high" "0xD0 5 low" "0xD0 6 high"; do
    read -r address bit kind <<<"$case"
    drive "sfr_${address}_bit_${bit}_$kind" sfr "$address" "$bit" "$kind" 'full_brake_within_s <= 0.03' 'final_brake_pct >= 100' 'resets <= 100'
done
# But for a high bit of R5, which a loop of the test of the code counts with: where it never ends, the watchdog resets.
for case in "0 low" "0 high" "1 low" "1 high" "2 low" "2 high" "3 low" "3 high" "4 low" "4 high" "5 low" "6 low" "6 high" "7 low" "7 high"; do
    read -r address kind <<<"$case"
    drive "r${address}_$kind" ram "$address" 6 "$kind" 'full_brake_within_s <= 0.03' 'final_brake_pct >= 100' 'resets <= 1'
done
finish
