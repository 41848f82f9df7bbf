#!/bin/bash
# SPDX-License-Identifier: MIT
# Runs all scenarios of a folder on one board: the firmware of the app that each names, of $APP, or in the
# file $IMAGE, in the engine $ENGINE (s51); prints a test line for each stated outcome.
#     tests/run_loop.sh BOARD [DIR]        DIR: tests/loop
set -u
board=${1:?usage: tests/run_loop.sh BOARD [DIR]}
folder=${2:-tests/loop}
file=${IMAGE:-${APP:+build/$board/$APP.ihx}}
image=${file:+--hex=$file}

status=0
for scenario in "$folder"/*.scn; do
    # What it complains of goes to $said, all else to stdout.
    { said=$(build/drive run --brief ${image:+"$image"} --board "$board" --scenario "$scenario" 2>&1 >&3); } 3>&1
    ended=$?
    # A run that did not come to a verdict fails, whatever the reason.
    if [ $ended -gt 1 ] || [ -n "$said" ]; then
        echo "$scenario:0:$board $(basename "$scenario" .scn):FAIL: drive ended with $ended: ${said%%$'\n'*}"
    fi
    [ $ended -eq 0 ] || status=1
done
exit $status
