#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints a line for each linked program: how much code and RAM of its chip it takes.
#     tools/memory.sh BOARD FOLDER APP...        after the link of FOLDER/APP.ihx
# The line ends with the RAM that is left for the stack and the most that the stack can take.
set -eu
[ $# -ge 3 ] || {
    echo "usage: memory.sh BOARD FOLDER APP..." >&2
    exit 2
}
board=$1 folder=$2 fragment=firmware/boards/$1.mk
shift 2
for app; do
    set -- "$@" "$folder/$app.bound" "$folder/$app.mem"
    shift
done
for file in "$fragment" "$@"; do
    [ -r "$file" ] || {
        echo "$file: error: not there; run: make BOARD=$board" >&2
        exit 1
    }
done
awk -v board="$board" '
$1 == "IRAM_BYTES" { iram = $3 }
$1 == "stack:" { taken = $4 }
/^Stack starts at/ { stack = $(NF - 2) }
$1 == "ROM/EPROM/FLASH" {
    app = FILENAME
    sub(/.*\//, "", app)
    sub(/[.]mem$/, "", app)
    printf "%-12s %-12s code %5d of %5d bytes, RAM %3d of %3d bytes, which leaves %3d for the stack, which takes at most %d\n",
        board, app, $(NF - 1), $NF, iram - stack, iram, stack, taken
    stack = taken = ""
}' "$fragment" "$@"
