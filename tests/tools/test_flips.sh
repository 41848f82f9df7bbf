#!/bin/bash
# SPDX-License-Identifier: MIT
# What the brake finds in its own RAM while it drives: each bit of what the decision remembers, and of its
# clock, is flipped once, at instants spread over a period of the sensor, on a board without a watchdog. It
# is found in the next round of the main loop, which is FAULT; what is flipped while the decision is at work,
# a ninth of the time, is taken for its own. And flip's own complaints.
. tests/lib.sh
. tests/flips/image.sh

link() { # BOARD
    board=$1
    link_brake "$out" "$board" || exit 2
}
address() { # NAME: of a variable
    variable_at "$out" "$board" "$1"
}
flip() { # SCENARIO OPTION...
    local scenario=$1
    shift
    build/flip --board="$board" --hex="$out/$board/brake.ihx" --scenario="tests/flips/$scenario.scn" "$@"
}
link generic8052
bytes() { # NAME BYTES
    printf '%X-%X' $((0x$(address "$1"))) $((0x$(address "$1") + $2 - 1))
}

# STOP stands, so that FAULT is nothing that a bad reading alone would bring.
remembered=$(bytes demand_pct 1),$(bytes override_cs 1),$(bytes fault_code 1),$(bytes silence_cs 1)
remembered+=,$(bytes latch_state 1),$(bytes target_worth 1),$(bytes since_cs 1),$(bytes closing_smooth 4)
remembered+=,$(bytes closing_place_mm 2),$(bytes smooth_mm 2),$(bytes triggered 1),$(bytes tick 1),$(bytes ticks 1)
flip stop --at=0.5 --ram="$remembered" --least=100 \
    --fault-state="$(address fault_state)" -o "$out/remembered.csv"
say "flip ends" $?
check "it flips 144 bits" awk -F , 'NR > 1 { n++ } END { exit n != 144 }' "$out/remembered.csv"
check "no bit that flips lets go of STOP" awk -F , '$6 == "unsafe" || $6 == "lost" { n++ } END { exit n > 0 || NR != 145 }' "$out/remembered.csv"
check "five in six are found" awk -F , '$6 == "FAULT" { n++ } END { exit n < 144 * 5 / 6 }' "$out/remembered.csv"

# In CONTROL the brake goes on as it was, or harder.
flip approach --at=0.5 --fault-state="$(address fault_state)" \
    --ram="$(bytes brake 5),$(bytes demand_pct 1),$(bytes fault_state 1),$(bytes latch_state 1)" -o "$out/approach.csv"
check "no bit of the decision leads to an impact or lets go of the brake" \
    awk -F , '$6 == "unsafe" || $6 == "lost" { n++ } END { exit n > 0 || NR != 65 }' "$out/approach.csv"

# The stack pointer and the register bank are right again in the next round.
flip follow --at=0.5 --sfr=D0 -o "$out/flags.csv"
check "no flag that flips stays so" awk -F , 'NR > 1 && $6 != "none" && $6 != "corrected" && $6 != "safe-stop" { n++ } END { exit n > 1 || NR != 9 }' "$out/flags.csv"

# All code is checked all the time: within two passes, 2 s of 8 KB and 4 s of 16 KB, a bit that changes is FAULT. The
# drive is 4 s long. Some bits change what finds them: some 2 %.
for case in "at89s52 2" "generic8052 0"; do
    read -r name at_s <<<"$case"
    link "$name"
    flip stop --what=code --count=200 --at="$at_s" \
        --fault-state="$(address fault_state)" -o "$out/$board.csv"
    check "a bit of the code is found within $((4 - at_s)) s on $board" \
        awk -F, '$6 == "FAULT" || $6 == "watchdog" { n++ } END { exit !(NR == 201 && n >= 190) }' "$out/$board.csv"
done

# Every flip of a few bytes within a millisecond, without flying each, against some that are flown by themselves.
flip approach --at=0.5 --what=space --window=1 --sample=40 --ram="$(bytes brake 2)" --sfr=81,D0 \
    --fault-state="$(address fault_state)" -o "$out/space.csv" 2>"$out/said"
say "flip looks at every cycle" $?
check "each bit is looked at in the same number of cycles, most of a millisecond's" awk -F, '
    NR > 1 { n = 0; for (i = 4; i <= NF; i++) n += $i; if (n < 800 || n > 1000 || (m && n != m)) exit 1; m = n } END { exit NR != 33 }' "$out/space.csv"
check "some of the flips are not harmless" awk -F, 'NR > 1 { other += $5 + $7 + $8; none += $4 } END { exit !(other > 100 && none > 100) }' "$out/space.csv"
check "a flip flown by itself comes to what its class does" awk '
    /^flip: [0-9]+ runs; of [0-9]+ flips by chance/ { good = $2 > 10 && $5 >= 30 && $12 == $5 } END { exit !good }' "$out/said"

# Whenever a bit of the demand or of STOP's state flips in FAULT, also while the decision is at work: no full brake of a
# second, and none below FAULT's. Whichever bit of a return address flips in the self-test: that ends, and the brake acts.
link at89s52
whenever() { # NAME SCENARIO ADDRESS BYTES MS OPTION...
    local name=$1 scenario=$2 address=$3 bytes=$4 ms=$5
    shift 5
    flip "$scenario" --what=space --window="$ms" --ram="$(printf '%X-%X' "$address" $((address + bytes - 1)))" \
        --fault-state="$(address fault_state)" "$@" -o "$out/$scenario.csv" 2>"$out/said"
    check "$name" awk -F, -v bits=$((8 * bytes)) -v ms="$ms" '
        NR > 1 { unsafe += $9; for (i = 4; i <= 9; i++) all += $i } END { exit !(NR == bits + 1 && unsafe == 0 && all > bits * ms * 900) }' "$out/$scenario.csv"
}
whenever "no flip of the demand in FAULT is unsafe" fault $((0x$(address demand_pct))) 1 10 --at=0.7 --least=60
whenever "no flip of STOP's state in FAULT is unsafe" fault $((0x$(address latch_state))) 1 10 --at=0.7 --least=60
# The loop's tick and the last trigger's: an approach that loses a reading there ends in an impact.
whenever "no flip of the ticks between two triggers is unsafe" approach $((0x$(address tick))) \
    $((0x$(address triggered_twin) - 0x$(address tick) + 1)) 10 --at=0.24
# The PWM pin is found wrong, which is STOP and FAULT for good, in the third tick: no flip comes to that.
whenever "no flip of the count of wrong pins is unsafe" fault $((0x$(address wrong_ticks))) 1 10 --at=0.7 --least=60
whenever "no flip of a return address in the self-test is unsafe" start "$(stack_at "$out" "$board")" 4 2 --at=-0.06

# --- what flip says of odd input ------------------------------------------------------------------------
good=("--board=$board" --scenario=tests/flips/stop.scn --at=0.5)
refuses "no board" 2 "give --board, --scenario and --at" build/flip
refuses "an unknown board" 2 "no board 'none'" build/flip --board=none --scenario=tests/flips/stop.scn --at=0
refuses "a bad instant" 2 "--at=soon: give a number" build/flip "${good[@]}" --at=soon
refuses "a bad address" 2 "--ram=100: give a hexadecimal number" build/flip "${good[@]}" --ram=100
refuses "a register below 80" 2 "--sfr=7F: give a hexadecimal number" build/flip "${good[@]}" --sfr=7F
refuses "an unknown kind" 2 "--what=all: give bits, stuck, code, pc or space" build/flip "${good[@]}" --what=all
refuses "no scenario file" 1 "none.scn" build/flip --board="$board" --scenario=none.scn --at=0
refuses "an image that never measures" 2 "does not begin" build/flip "${good[@]}" --hex="build/$board/bringup.ihx"
finish
