#!/bin/bash
# SPDX-License-Identifier: MIT
# [flip]: bits of the chip that flip once or stick, at a machine cycle or an instruction. The bits are of
# the brake's own count of its steps, which it reports, so each flip shows in the telemetry.
. tests/lib.sh
. tests/listing.sh
board=stc89c516rd
make -s BOARD=$board build/$board/brake.ihx || exit 2
# The count lies in internal RAM, low byte first.
cell=$(address_of _seq build/$board/brake/brake/main.rst)

run() { # NAME [section.key=value...]: a drive of a second, what the controller says in $out/NAME
    local name=$1 sets=() one
    shift
    for one; do sets+=("--set=$one"); done
    build/drive run --engine=fast --board $board --scenario tests/loop/warning_gentle.scn --set=scenario.duration_s=2 \
        --set=expect.impact=none "${sets[@]}" --uart "$out/$name.uart" --csv "$out/$name.csv" --json "$out/$name.json" \
        >"$out/$name.txt" 2>"$out/$name.log"
    grep -aE '^[0-9]+,' "$out/$name.uart" | cut -d, -f1 >"$out/$name"
}
shows() { # NAME AWK: a condition on the counts, in count[1..n]
    awk '{ count[++n] = $1 } END { exit !(n > 10 && ('"$2"')) }' "$out/$1"
}

run plain
check "without a flip the count goes up to 40" shows plain 'count[n] > 10 && count[n] < 40'
run cycle flip.place=ram "flip.address=$cell" flip.bit=7 flip.at_cycle=1200000
check "a bit flips at a cycle" shows cycle 'count[5] < 10 && count[n] > 128'
instruction=900000
run instruction flip.place=ram "flip.address=$cell" flip.bit=7 flip.at_instruction=$instruction
check "a bit flips at an instruction" shows instruction 'count[1] < 10 && count[n] > 128'
run back flip.place=ram "flip.address=$cell" flip.bit=7 flip.at_cycle=1000000 \
    flip2.place=ram "flip2.address=$cell" flip2.bit=7 flip2.at_cycle=1000000
check "two flips of a bit leave it as it was" cmp "$out/plain.csv" "$out/back.csv"
run high flip.kind=high flip.place=ram "flip.address=$cell" flip.bit=0 flip.at_cycle=1000000
# PD of PCON, which would end the drive. A stuck bit of RAM is no such case: the brake tests its RAM.
run low flip.kind=low flip.place=sfr flip.address=0x87 flip.bit=1 flip.at_cycle=500000
check "a bit is stuck high" shows high 'count[n] == count[n - 3] + 6 && count[n] % 2 == 1'
check "a bit that is low anyway may be stuck there" cmp "$out/plain.csv" "$out/low.csv"
# Without interrupts (bit 7 of IE) no job runs, and the watchdog comes 65.5 ms after it was fed.
run no_interrupts flip.kind=low flip.place=sfr flip.address=0xA8 flip.bit=7 flip.at_cycle=1000000
check "a register's bit that is stuck stops the interrupts" jq -e '.outcome.resets == 1 and (.boot_s + .duration_s | . > 1.05 and . < 1.08)' \
    "$out/no_interrupts.json"
run lost flip.place=pc flip.bit=14 flip.at_cycle=1000000
check "a program counter that flips changes the run" [ -s "$out/lost.json" -a "$(cmp -s "$out/plain.csv" "$out/lost.csv" && echo same)" = "" ]
run lost_again flip.place=pc flip.bit=14 flip.at_cycle=1000000
check "the same flip gives the same bytes" cmp "$out/lost.csv" "$out/lost_again.csv"
run xdata flip.place=xdata flip.address=65535 flip.bit=0 flip.at_cycle=1000000
check "external RAM that nobody uses changes nothing" cmp "$out/plain.csv" "$out/xdata.csv"

refuses "s51 refuses flips" 2 "[flip] changes what is inside the chip, which s51 cannot do; give --engine=fast" \
    build/drive run --engine=s51 --board $board --scenario tests/loop/warning_gentle.scn --set flip.place=pc \
    --set flip.bit=3 --set flip.at_cycle=5
refuses "a flip needs its time" 1 "[flip] give at_s, at_cycle or at_instruction, one of them" \
    build/drive run --engine=fast --board $board --scenario tests/loop/warning_gentle.scn --set flip.place=pc --set flip.bit=3
finish
