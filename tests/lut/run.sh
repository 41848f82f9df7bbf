#!/bin/bash
# SPDX-License-Identifier: MIT
# Runs one image of tests/lut/all_cells.c, as tests/run_image.sh does, and prints its last line, its measurements:
#     tests/lut/run.sh DIR     DIR: build/lut/NAME, as make builds it
# The cells that the image looked up are left in DIR/cells.bin.
set -u
dir=${1:?usage: tests/lut/run.sh DIR}
rm -f "$dir/cells.bin"
tests/run_image.sh "$dir/all_cells.ihx" "$dir/cells.bin" >"$dir/run.log" || exit
grep -aE '^bytes [0-9]+ .* end$' "$dir/run.log" || {
    echo "run.sh: error: $dir/all_cells.ihx did not print its last line; see $dir/run.log" >&2
    tail -n 5 "$dir/run.log" >&2
    exit 1
}
