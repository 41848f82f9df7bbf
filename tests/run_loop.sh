#!/bin/bash
# SPDX-License-Identifier: MIT
# Runs all scenarios of a folder on one board: the firmware of the app that each names, of $APP, or in the
# file $IMAGE, in the engine $ENGINE (s51); prints a test line for each stated outcome, two runs at a time.
#     tests/run_loop.sh BOARD [DIR]        DIR: tests/loop
set -u
board=${1:?usage: tests/run_loop.sh BOARD [DIR]}
folder=${2:-tests/loop}
file=${IMAGE:-${APP:+build/$board/$APP.ihx}}
image=${file:+--hex=$file}

run_one() {
    log=$(mktemp)
    build/drive run --brief ${image:+"$image"} --board "$1" --scenario "$2" 2>"$log"
    status=$?
    # A run that did not come to a verdict fails, whatever the reason.
    if [ $status -gt 1 ] || [ -s "$log" ]; then
        echo "$2:0:$1 $(basename "$2" .scn):FAIL: drive ended with $status: $(head -n 1 "$log")"
    fi
    rm -f "$log"
    return $status
}
export -f run_one
export image

parallel -j "${JOBS:-2}" --will-cite --keep-order run_one "$board" ::: "$folder"/*.scn
