#!/bin/bash
# SPDX-License-Identifier: MIT
# Drives the scenarios of the ultrasonic sensor with the image of another one, and prints a test line for
# each stated outcome. What tests/loop/IMAGE/otherwise.txt lists must not hold, and all else must.
#     tests/run_otherwise.sh BOARD IMAGE DIR|FILE.scn...
set -u
board=${1:?usage: tests/run_otherwise.sh BOARD IMAGE DIR|FILE.scn...}
image=$2
list=tests/loop/$image/otherwise.txt
shift 2

run_one() { # BOARD IMAGE LIST SCENARIO
    local name said
    name=${4#tests/loop/}
    name=${name%.scn}
    said=$(timeout 300 build/drive run --brief --engine=fast --hex "build/$1/$2.ihx" --board "$1" --scenario "$4" 2>&1)
    awk -v name="$name" -v place="$4" -v board="$1" '
        FNR == NR { if ($1 == name) { n = split($2, keys, ","); for (i = 1; i <= n; i++) listed[keys[i]] = 1 } next }
        / error: / { said = $0; if (listed["refused"]) { listed["refused"] = 2; ran = 1; print place ":0:" board " " name " is refused:PASS" } next }
        /:(PASS|FAIL)/ {
            ran = 1
            split($0, words, " ")
            key = words[3]
            if (!(key in listed)) { print; next }
            listed[key] = 2
            if (/:PASS$/) { sub(/:PASS$/, ":FAIL: it holds; take it off the list otherwise.txt") }
            else { sub(/:FAIL: .*/, " does not hold:PASS") }
            print
        }
        END {
            if (!ran) print place ":0:" board " " name ":FAIL: " (said ? said : "drive says nothing")
            for (key in listed) if (listed[key] != 2) print place ":0:" board " " name ":FAIL: it has no " key "; take it off the list otherwise.txt"
        }' "$3" - <<<"$said"
}

scenarios=()
for place; do
    if [ -d "$place" ]; then scenarios+=("$place"/*.scn); else scenarios+=("$place"); fi
done
grep -v '^#' "$list" | awk 'NF { print $1 }' | while read -r name; do
    [ -e "tests/loop/$name.scn" ] || echo "$list:0:$name:FAIL: there is no such drive; take it off the list"
done
for scenario in "${scenarios[@]}"; do run_one "$board" "$image" "$list" "$scenario"; done
