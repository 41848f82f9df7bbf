#!/bin/bash
# SPDX-License-Identifier: MIT
# How fast fistab makes the brake's table, beside Debian's fuzzylite at the same work; how many bytes
# the table takes, and how many cycles a look-up takes.
#     tests/bench/fistab.sh [ROUNDS]       after `make run-bench` has built what it needs
# Both programs take the same 10,000 points and 101 samples an output and write 10,000 results, process
# start and all. They take turns of five runs; of each the median of its rounds counts, in processor
# time, as what else runs on the machine shows in the time on the wall. Exits with 1 if a goal is
# missed.
set -eu
cd "$(dirname "$0")/../.."
rounds=${1:-9}
work=build/bench/fistab
mkdir -p "$work"
missed=0

goal() { # WHAT VALUE-OK
    if [ "$2" -eq 1 ]; then
        echo "    goal: $1: held"
    else
        echo "    goal: $1: MISSED"
        missed=1
    fi
}

# --- the same work for both ------------------------------------------------------------------------
command -v fuzzylite >/dev/null || {
    echo "fistab.sh: error: fuzzylite is not there; install the package fuzzylite (tools/deps.sh bench)" >&2
    exit 1
}
build/fistab table tables/brake.fis --csv="$work/cells.csv"
sed '1d; s/,[^,]*$//; s/,/ /g' "$work/cells.csv" >"$work/points.txt"
fuzzylite -i tables/brake.fis -if fis -o "$work/imported.fll" -of fll
# it reads "centroid" as one of 100 midpoints
sed 's/Centroid 100/Centroid 101/' "$work/imported.fll" >"$work/brake.fll"
grep -q 'Centroid 101' "$work/brake.fll"

run_table() { build/fistab table tables/brake.fis --csv="$work/cells.csv"; }
run_eval() { build/fistab eval tables/brake.fis <"$work/points.txt" >"$work/fistab.txt"; }
run_fuzzylite() {
    fuzzylite -i "$work/brake.fll" -if fll -d "$work/points.txt" -dheader false -dinputs false \
        -decimals 9 -o "$work/fuzzylite.txt" -of fld
}

# Five runs; appends their wall and processor time to the program's file.
TIMEFORMAT='%R %U %S'
time_runs() { # PROGRAM
    { time for _ in 1 2 3 4 5; do "run_$1"; done; } 2>"$work/time"
    awk '{ print $1 / 5 * 1e3, ($2 + $3) / 5 * 1e3 }' "$work/time" >>"$work/$1.ms"
}

rm -f "$work"/*.ms
for _ in $(seq "$rounds"); do
    for program in table eval fuzzylite; do
        time_runs "$program"
    done
done

# They did the same work: the results differ by no more than their rules of sampling do, MATLAB's by
# 0.510 from the integral and midpoints by 0.015.
paste "$work/fistab.txt" "$work/fuzzylite.txt" | awk '
    NF == 2 { d = $1 - $2; if (d < 0) d = -d; if (d > most) most = d; n++ }
    END { exit n != 10000 || most > 0.525 }' || {
    echo "fistab.sh: error: fistab and fuzzylite did not give the same 10,000 results within 0.525" >&2
    exit 1
}

median() { # PROGRAM COLUMN
    awk -v column="$2" '{ print $column }' "$work/$1.ms" | sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'
}
ratio() { awk -v a="$(median fuzzylite 2)" -v b="$(median "$1" 2)" 'BEGIN { printf "%.1f", a / b }'; }
line() { # NAME PROGRAM
    printf '    %-30s %7.2f ms of processor time (%.2f ms on the wall)' "$1" "$(median "$2" 2)" "$(median "$2" 1)"
}

echo "10,000 cells of tables/brake.fis at 101 samples:"
line "fuzzylite, points to results" fuzzylite
echo
line "fistab eval, points to results" eval
echo ": $(ratio eval) times as fast"
line "fistab table, system to CSV" table
echo ": $(ratio table) times as fast"
goal "at least 5 times as fast as fuzzylite" "$(awk -v a="$(ratio eval)" -v b="$(ratio table)" 'BEGIN { print (a >= 5 && b >= 5) }')"

# --- bytes and cycles ------------------------------------------------------------------------------
echo "The brake's table on the chip, every cell looked up in s51 by the code that ships:"
printf '    %-28s %6s %6s %12s %6s\n' encoding table code "look-up, mc" call
for case in plain packed plain-repaired packed-repaired; do
    # bytes N least N most N call N ...
    read -r _ bytes _ least _ most _ call _ < <(tests/lut/run.sh "build/lut/$case")
    code=$(awk '$1 == "A" && $2 == "CSEG" { print $4 }' "build/lut/$case/firmware/lib/lut.rel")
    printf '    %-28s %6d %6d %12s %6d\n' "$case" "$bytes" "$((16#$code))" "$least to $most" "$call"
    case $case in
    packed*) [ "$bytes" -le 2700 ] && [ "$most" -le 120 ] && [ $((most - least)) -le 20 ] || missed=1 ;;
    plain*) [ "$most" -le 24 ] || missed=1 ;;
    esac
done
goal "plain at most 24 mc; packed at most 2,700 bytes and 120 mc, the same for all within 20" $((1 - missed))
exit "$missed"
