#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints in one line how much code and RAM of its chip a linked program takes:
#     tools/memory.sh BOARD APP [FOLDER]        after the link of APP.ihx in FOLDER, build/BOARD
# The line ends with the RAM that is left for the stack and the most that the stack can take.
set -eu
[ $# -eq 2 ] || [ $# -eq 3 ] || {
    echo "usage: memory.sh BOARD APP [FOLDER]" >&2
    exit 2
}
folder=${3:-build/$1}
mem=$folder/$2.mem
bound=$folder/$2.bound
fragment=firmware/boards/$1.mk
for file in "$mem" "$bound" "$fragment"; do
    [ -r "$file" ] || {
        echo "$file: error: not there; run: make BOARD=$1" >&2
        exit 1
    }
done
awk -v board="$1" -v app="$2" '
$1 == "IRAM_BYTES" { iram = $3 }
$1 == "stack:" { taken = $4 }
/^Stack starts at/ { stack = $(NF - 2) }
$1 == "ROM/EPROM/FLASH" { code = $(NF - 1); room = $NF }
END {
    printf "%-12s %-12s code %5d of %5d bytes, RAM %3d of %3d bytes, which leaves %3d for the stack, which takes at most %d\n",
        board, app, code, room, iram - stack, iram, stack, taken
}' "$fragment" "$bound" "$mem"
