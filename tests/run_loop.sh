#!/bin/bash
# Runs all scenarios of a folder on one board's brake firmware and prints a test line for each stated
# outcome, two runs at a time.
#     tests/run_loop.sh BOARD [DIR]        DIR: tests/loop
set -u
board=${1:?usage: tests/run_loop.sh BOARD [DIR]}
folder=${2:-tests/loop}
image=build/$board/${APP:-brake}.ihx

run_one() {
    log=$(mktemp)
    build/drive run --brief --hex "$1" --board "$2" --scenario "$3" 2>"$log"
    status=$?
    # A run that did not come to a verdict fails, whatever the reason.
    if [ $status -gt 1 ] || [ -s "$log" ]; then
        echo "$3:0:$2 $(basename "$3" .scn):FAIL: drive ended with $status: $(head -n 1 "$log")"
    fi
    rm -f "$log"
    return $status
}
export -f run_one

parallel -j "${JOBS:-2}" --will-cite --keep-order run_one "$image" "$board" ::: "$folder"/*.scn
