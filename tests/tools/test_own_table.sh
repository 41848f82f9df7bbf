#!/bin/bash
# SPDX-License-Identifier: MIT
# Tables of a user's own: whatever the axes, the brake builds with them, drives, and brakes by the cell that
# fistab has for the row and the column that it reports; or make says what is wrong and which knob helps.
. tests/lib.sh

# fis FILE DISTANCES SPEEDS FORCES: nine rules over these three ranges, near and fast brakes hardest.
fis() {
    awk -v distances="$2" -v speeds="$3" -v forces="$4" '
    function variable(section, name, range,    ends, low, high, middle) {
        split(range, ends, " ")
        low = ends[1]; high = ends[2]; middle = (low + high) / 2
        printf "[%s]\nName=\047%s\047\nRange=[%s]\nNumMFs=3\n", section, name, range
        printf "MF1=\047low\047:\047trimf\047,[%.6f %.6f %.6f]\n", low, low, middle
        printf "MF2=\047middle\047:\047trimf\047,[%.6f %.6f %.6f]\n", low, middle, high
        printf "MF3=\047high\047:\047trimf\047,[%.6f %.6f %.6f]\n\n", middle, high, high
    }
    BEGIN {
        print "[System]\nName=\047own\047\nType=\047mamdani\047\nVersion=2.0\nNumInputs=2\nNumOutputs=1\nNumRules=9"
        print "AndMethod=\047min\047\nOrMethod=\047max\047\nImpMethod=\047min\047\nAggMethod=\047max\047\nDefuzzMethod=\047centroid\047\n"
        variable("Input1", "distance_m", distances)
        variable("Input2", "closing_mps", speeds)
        variable("Output1", "force", forces)
        print "[Rules]"
        for (near = 1; near <= 3; near++)
            for (fast = 1; fast <= 3; fast++) {
                force = 3 - near + fast
                if (force > 3) force = 3
                printf "%d %d, %d (1) : 1\n", near, fast, force
            }
    }' >"$1"
}

# own NAME BOARD DISTANCES SPEEDS FORCES GRID MORE SPEED GAP: builds and drives that table. MORE are further
# knobs of make, and after that fistab's words for them; the car drives at SPEED m/s, GAP m behind one that stands.
own() {
    local name=$1 board=$2 distances=$3 grid=$6 speed=$8 gap=$9 knob fault='' options=()
    local folder=$out/$name
    mkdir -p "$folder"
    fis "$folder/own.fis" "$3" "$4" "$5"
    for knob in $7; do
        case $knob in
        LEVELS=*) options+=("--levels=${knob#*=}") ;;
        REPAIR=*) options+=("--repair=${knob#*=}") ;;
        esac
    done
    # shellcheck disable=SC2086
    if ! make BOARD="$board" TABLE="$folder/own.fis" OUT="$folder" GRID="$grid" $7 "$folder/brake.hex" >"$folder/make.log" 2>&1; then
        say "$name builds" 1 "$(tail -n 3 "$folder/make.log")"
        return
    fi
    build/fistab table "$folder/own.fis" --grid="$grid" "${options[@]}" --csv="$folder/own.csv" 2>/dev/null
    printf '%s\n' '[scenario]' 'title = A table of ones own' 'duration_s = 6' '[ego]' "speed_mps = $speed" \
        '[lead]' "gap_m = $gap" 'speed_mps = 0' '[expect]' 'impact = none' 'never = FAULT' >"$folder/own.scn"
    timeout 300 build/drive run --brief --board="$board" --hex="$folder/brake.ihx" --scenario="$folder/own.scn" \
        --uart="$folder/uart" >"$folder/drive.log" 2>&1 || fault="drive: $(tail -n 2 "$folder/drive.log")"

    # Each line of the serial port that says CONTROL again, with a distance: its force is that of its cell, and its
    # row that of the distance, or one that the brake still holds.
    fault+=$(tr -d '\r' <"$folder/uart" | awk -F, -v grid="$grid" -v ends="$distances" -v slack="$slack" -v levels="$(sed -n 's/.*_LEVELS //p' "$folder/brake/lut_table.h")" '
        BEGIN { split(grid, cells, "x"); split(ends, end, " ") }
        NR == FNR { if (FNR > 1) force[FNR - 2] = $NF; next }
        NF == 9 && $8 == "CONTROL" && $9 == 0 && $3 != "" && was == "CONTROL" {
            pct = force[$5 * cells[2] + $6] * 100 / levels
            row = int(($3 / 1000 - end[1]) / (end[2] - end[1]) * cells[1] + 1e-6)
            if ($5 >= cells[1] || $6 >= cells[2]) fault = "outside the table: " $0
            if ($7 - pct > 0.75 || pct - $7 > 0.75) fault = "should be " pct " percent: " $0
            if (row - $5 < 0 || row - $5 > slack) fault = "should be in row " row ": " $0
            rows[$5] = 1
            lines++
        }
        { was = $8 }
        END {
            count = 0
            for (row in rows) count++
            if (fault == "" && (lines < 3 || count < 2)) fault = lines + 0 " lines of " count " rows are too few to tell"
            print fault
        }' "$folder/own.csv" -)
    faultless "$name drives by its cells" "$fault"
}
slack=$(awk '$2 == "SLACK_ROWS" && $3 + 0 > most { most = $3 + 0 } END { print most }' firmware/brake/law_fuzzy.c)
check "the brake says how many rows it holds" test "$slack" -ge 0

make BOARD=stc89c516rd build/fistab build/bound build/drive >"$out/make.log" 2>&1 || say "the tools build" 1 "$(tail -n 3 "$out/make.log")"
own from_0 stc89c516rd "0 3" "0 35" "0 100" 100x100 "" 1.5 5
own from_1_mm generic8052 "0.001 3" "0 35" "0 100" 100x100 "" 1.5 5
own packed at89s52 "0.1 3" "0 12" "0 100" 96x96 "" 1.5 5
own tiny_cells stc89c516rd "1.02 1.2" "0 2" "0 100" 250x100 "" 0.4 1.6
own negative_speeds at89s52 "0.5 4.5" "-5 10" "0 100" 60x75 "" 1.5 5.5
own few_rows stc89c516rd "0.5 4" "0 20" "0 100" 12x200 "" 2 5
own few_columns at89s52 "0.5 4" "0 20" "0 100" 200x12 "" 2 5
own most_cells stc89c516rd "0 4.096" "-3 12" "0 100" 256x200 "" 1.5 5
own repaired at89s52 "0.5 4" "0 20" "0 100" 90x90 "REPAIR=-1,+2" 2 5
own other_output stc89c516rd "0.5 4" "0 20" "-0.5 0.5" 70x70 "" 2 5
own few_levels at89s52 "0.2 4" "0 20" "0 8" 100x100 "LEVELS=7" 2 5
own half_levels stc89c516rd "1 5" "0 35" "0 100" 100x100 "LEVELS=50" 2 6
own long_axes generic8052 "0 65" "-30 35" "0 100" 250x100 "" 2 5

# refused NAME BOARD KNOBS MESSAGE DISTANCES [SPEEDS]: make stops with MESSAGE, and no image is left of the one before.
refused() {
    local folder=$out/refused
    mkdir -p "$folder"
    touch "$folder/brake.ihx" "$folder/brake.hex"
    fis "$folder/own.fis" "$5" "${6:-0 35}" "0 100"
    # shellcheck disable=SC2086
    refuses "$1" 2 "$4" make BOARD="$2" TABLE="$folder/own.fis" OUT="$folder" $3 "$folder/brake.hex"
    [ ! -e "$folder/brake.ihx" ] && [ ! -e "$folder/brake.hex" ]
    say "$1: no image is left" $? "there is one"
}
refused "a table in centimetres" stc89c516rd "" "an axis is too long: at most 65.535 m or m/s from end to end" "100 500"
refused "negative distances" at89s52 "" "the distance axis must lie within 0..65.534 m" "-1 3"
refused "half millimetres" at89s52 "" "an end of an axis is not in whole mm or mm/s" "0.0005 3"
refused "too many levels" at89s52 "LEVELS=150" "the table has more than 100 levels; the brake takes percent" "0 3"
refused "too much for the chip" at89s52 "GRID=250x250" "bytes of code are too many for board at89s52, which has 8192; GRID=80x80, LEVELS=50 or REPAIR=-1,+2 makes the table smaller" "0.1 3"
refused "a table that fistab refuses" at89s52 "" "range" "3 3"
finish
