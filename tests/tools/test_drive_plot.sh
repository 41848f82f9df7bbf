#!/bin/bash
# SPDX-License-Identifier: MIT
# drive plot: a run's CSV and its JSON give the same figure, with a panel for each unit; what is no run, or no
# name for a figure, is refused with nothing written.
. tests/lib.sh
drive=build/drive

$drive run --board stc89c516rd --scenario tests/loop/standing_car_3mps.scn --csv "$out/run.csv" --json "$out/run.json" >/dev/null
$drive plot "$out/run.csv" -o "$out/csv.svg" >"$out/said" 2>&1
say "a figure of CSV" $? "$(cat "$out/said")"
[ ! -s "$out/said" ]
say "gnuplot has nothing to say" $? "$(cat "$out/said")"
$drive plot "$out/run.json" -o "$out/json.svg" && cmp -s "$out/csv.svg" "$out/json.svg"
say "the same figure of JSON" $? "they differ"
for text in gap_m dist_mm ego_mps accel_mps2 brake_pct '>m<' '>m/s<' '>m/s2<' '>%<' 'time, s'; do
    grep -qF -- "$text" "$out/csv.svg"
    say "the figure has $text" $? "it is not there"
done
$drive plot "$out/run.csv" -o "$out/run.png" && head -c 4 "$out/run.png" | grep -q PNG
say "a figure as PNG" $? "it is no PNG file"

refused() { # NAME STATUS MESSAGE command...: that status and message, and no figure
    name=$1 wanted=$2 message=$3
    shift 3
    "$@" >"$out/said" 2>&1
    status=$?
    [ $status -eq "$wanted" ] && grep -qF -- "$message" "$out/said" && [ ! -e "$out/no.svg" ]
    say "$name" $? "status $status: $(cat "$out/said")"
}
echo "a,b" >"$out/other.csv"
refused "another table" 1 "other.csv: error: is no run; give a file that drive run --csv or --json wrote" \
    $drive plot "$out/other.csv" -o "$out/no.svg"
refused "JSON of another kind" 1 "is no run" $drive plot <(echo '{"series": 3}') -o "$out/no.svg"
refused "a missing file" 1 "cannot be read: No such file" $drive plot nowhere.csv -o "$out/no.svg"
refused "another kind of figure" 1 "is neither .svg nor .png" $drive plot "$out/run.csv" -o "$out/no.gif"
refused "no folder for it" 1 "does the folder exist?" $drive plot "$out/run.csv" -o "$out/nowhere/no.svg"
mkdir -p "$out/empty"
refused "no gnuplot" 2 "gnuplot was not found in PATH; install gnuplot-nox" \
    env PATH="$out/empty" "$PWD/$drive" plot "$out/run.csv" -o "$out/no.svg"
finish
