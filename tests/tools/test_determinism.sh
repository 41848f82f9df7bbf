#!/bin/bash
# SPDX-License-Identifier: MIT
# The same seed gives the same bytes. The time between two meetings of simulator and plant changes no byte
# of the trace, and half the plant's step changes no outcome beyond the tolerances below. All runs use the
# real firmware.
. tests/lib.sh

run() { # BOARD SCENARIO NAME [option...]
    board=$1 scenario=$2 name=$3
    shift 3
    build/drive run --hex "build/$board/brake.ihx" --board "$board" --scenario "tests/loop/$scenario.scn" \
        --csv "$out/$name.csv" --vcd "$out/$name.vcd" --json "$out/$name.json" "$@" >"$out/$name.out" 2>&1
}

same() { # NAME A B
    cmp "$out/$2.csv" "$out/$3.csv" >"$out/cmp" 2>&1 && cmp "$out/$2.vcd" "$out/$3.vcd" >"$out/cmp" 2>&1 &&
        cmp <(sed '/"hex"/d' "$out/$2.json") <(sed '/"hex"/d' "$out/$3.json") >"$out/cmp" 2>&1
    say "$1" $? "$(cat "$out/cmp")"
}

number() { # NAME KEY: that outcome's value
    sed -n "0,/\"$2\":/s/.*\"$2\":[[:space:]]*\([-0-9.e]*\).*/\1/p" "$out/$1.json"
}

near() { # NAME A B KEY TOLERANCE
    a=$(number "$2" "$4") b=$(number "$3" "$4")
    awk -v a="$a" -v b="$b" -v t="$5" 'BEGIN { d = a - b; exit !(a != "" && b != "" && d <= t && d >= -t) }'
    say "$1: $4 within $5" $? "$a and $b"
}

run stc89c516rd noisy_approach first
run stc89c516rd noisy_approach again
same "same seed, same bytes" first again
run stc89c516rd noisy_approach other --seed 8
! cmp -s "$out/first.csv" "$out/other.csv"
say "another seed, other noise" $? "the traces are equal"

for pair in stc89c516rd/noisy_approach generic8052/noisy_approach at89s52/fault_intermittent \
    stc89c516rd/fault_off stc89c516rd/override_held; do
    board=${pair%/*} scenario=${pair#*/}
    run "$board" "$scenario" guess
    for quantum in 400 57; do
        run "$board" "$scenario" "q$quantum" --quantum-us $quantum
        same "$board $scenario, quantum $quantum us" guess "q$quantum"
    done
done

for scenario in standing_car_3mps noisy_approach lead_brakes_2mps2 slower_car_1mps; do
    run stc89c516rd $scenario coarse
    run stc89c516rd "$scenario" fine --step-us 500
    for tolerance in min_gap_m/0.002 impact_mps/0.005 peak_decel_mps2/0.02 peak_jerk_mps3/0.1 final_speed_mps/0.005 \
        rms_accel_mps2/0.01; do
        near "$scenario, half the step" coarse fine ${tolerance%/*} ${tolerance#*/}
    done
done

for name in first other; do # a stamp never goes back in the waveform, and every name is declared
    awk '$1 == "$var" { known[$4] = 1 } /^#/ { t = substr($1, 2) + 0; if (t <= last && last != "") bad = 1; last = t }
         /^[01]/ && !($0 ~ /^[01][A-Z]$/ && known[substr($1, 2)]) { bad = 1 } /^[rs]/ && !known[$2] { bad = 1 }
         END { exit bad || last == "" }' "$out/$name.vcd"
    say "waveform $name is in order" $? "$(head -n 40 "$out/$name.vcd" | tail -n 1)"
done
finish
