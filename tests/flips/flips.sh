#!/bin/bash
# SPDX-License-Identifier: MIT
# What a flipped bit does, `make flips`:
#     tests/flips/flips.sh BOARD...
# Flips each bit of RAM and of each register that the brake uses, at 20 instants of five drives; then bits of
# the code and of the program counter by chance, and bits of RAM that stick. Leaves build/flips/BOARD.txt, a
# table, and all runs as build/flips/BOARD.DRIVE.WHAT.csv. Ends with 1 if on a board with a watchdog a flip of
# RAM or of a register is unsafe, but for those that stop the clock (PCON).
#
# INSTANTS, CODE, PCS in the environment: how many instants a drive (1 to 4), random flips of the code and of
# the program counter a drive.
set -u
cd "$(dirname "$0")/../.." || exit 2
. tests/flips/image.sh
out=build/flips
mkdir -p "$out"
instants=${INSTANTS:-4} code=${CODE:-2000} pcs=${PCS:-400}
# SP DPL DPH PCON TCON TMOD TL0 TL1 TH0 TH1 P1 SCON IE P3 IP T2CON RCAP2L RCAP2H TL2 TH2 PSW ACC B
registers=81-83,87-8D,90,98,A8,B0,B8,C8,CA-CD,D0,E0,F0
# Drive, the least brake that it must keep, and instants, the most telling one first.
drives=("approach 0 0.2 0.5 0.8 1.1" "follow 0 0.5 1 0.2 1.5" "stop 100 0.5 0.1 0.8 1.1" "fault 60 0.7 0.4 1 1.2" "start 0 -0.08 -0.14 -0.12 -0.02")

fly() { # BOARD DRIVE LEAST WHAT AT...
    local board=$1 drive=$2 least=$3 what=$4 stack
    shift 4
    stack=$(($(awk '$2 == "__start__stack" { print "0x" substr($1, 7) }' "$out/$board"/brake.map) + $(awk '/^stack: at most/ { print $4 }' "$out/$board"/brake.bound)))
    local options=(--ram=00-FF)
    [ "$what" != bits ] || options+=("--sfr=$registers")
    [ "$what" != code ] || options+=(--count=$(((code + $# - 1) / $#)))
    [ "$what" != pc ] || options+=(--count=$(((pcs + $# - 1) / $#)))
    build/flip --board="$board" --hex="$out/$board/brake.ihx" --scenario="tests/flips/$drive.scn" --what="$what" --at="$(tr ' ' , <<<"$*")" \
        --least="$least" --fault-state="$(address_of "$out" "$board" fault_state)" --unused="$(printf %X $stack)" \
        --told="$(address_of "$out" "$board" stack_unused)" "${options[@]}" -o "$out/$board.$drive.$what.csv" || return
    [ "$(wc -l <"$out/$board.$drive.$what.csv")" -gt 1 ] || {
        echo "flips: error: no run is in $out/$board.$drive.$what.csv" >&2
        return 1
    }
}

# The runs by outcome, a line a drive and kind; then the worst addresses.
summary() { # BOARD
    local file
    printf '%-10s %-6s %8s %8s %10s %10s %8s %9s %8s\n' drive what runs none corrected safe-stop FAULT watchdog unsafe
    for file in "$out/$1".*.csv; do
        awk -F , -v OFS=' ' -v file="$(basename "$file" .csv)" '
            NR > 1 { runs++; count[$6]++ }
            END {
                split(file, part, ".")
                printf "%-10s %-6s %8d %8d %10d %10d %8d %9d %8d\n", part[2], part[3], runs, count["none"], count["corrected"],
                    count["safe-stop"], count["FAULT"], count["watchdog"], count["unsafe"] + count["lost"]
            }' "$file"
    done
    echo
    echo "the worst: place, address, unsafe runs, why"
    awk -F , 'FNR > 1 && ($6 == "unsafe" || $6 == "lost") { n[$1 " " $3]++; why[$1 " " $3] = why[$1 " " $3] " " $7 }
        END { for (place in n) print place, n[place], why[place] }' "$out/$1".*.csv | sort -k3,3nr -k1 |
        awk '{ seen = ""; for (i = 4; i <= NF; i++) if (index(seen, $i) == 0) seen = seen " " $i; print "  " $1, $2, $3 seen }' | head -n 10
}

status=0
for board; do
    rm -f "$out/$board".*
    link_brake "$out" "$board" || exit 2
    for drive in "${drives[@]}"; do
        read -r name least at <<<"$drive"
        # shellcheck disable=SC2206  # a list of words
        at=($at)
        fly "$board" "$name" "$least" bits "${at[@]:0:instants}" || exit 1
        [ "$pcs" -eq 0 ] || fly "$board" "$name" "$least" pc "${at[@]:0:instants}" || exit 1
        [ "$code" -eq 0 ] || fly "$board" "$name" "$least" code "${at[@]:0:instants}" || exit 1
        [ "$instants" -lt 4 ] || fly "$board" "$name" "$least" stuck "${at[0]}" || exit 1
    done
    { echo "$board: what became of flipped bits"; summary "$board"; } | tee "$out/$board.txt"
    if ! grep -q 'WATCHDOG *:= *none' "firmware/boards/$board.mk" &&
        awk -F , '$6 == "unsafe" && $3 != "0x87" { found = 1 } END { exit !found }' "$out/$board".*.bits.csv; then
        echo "flips: error: on $board a flip of RAM or of a register is unsafe; see $out/$board.*.bits.csv" >&2
        status=1
    fi
done
exit $status
