#!/bin/bash
# Runs one image of tests/lut/all_cells.c in s51 and prints its last line, what was measured:
#     tests/lut/run.sh DIR [SECONDS]     DIR as the Makefile makes it, build/lut/NAME
# The cells are left in DIR/cells.bin. s51 exits with 0 whatever happens and quits early when its
# input is closed; so its input is an open pipe, the time is limited, and only the image's own "end"
# makes a success.
set -u
dir=$1
seconds=${2:-60}
rm -f "$dir/cells.bin"
[ -r "$dir/all_cells.ihx" ] || {
    echo "run.sh: error: no image '$dir/all_cells.ihx'; run: make $dir/all_cells.ihx" >&2
    exit 2
}
coproc open_pipe { exec sleep "$((seconds + 5))"; }
timeout -k 1 "$seconds" s51 -t C52 -q -b -R 1 -G -I "if=xram[0xffff],out=$dir/cells.bin" \
    "$dir/all_cells.ihx" <&"${open_pipe[0]}" >"$dir/s51.log" 2>&1
status=$?
kill "$open_pipe_PID" 2>/dev/null
line=$(grep -aE '^bytes [0-9]+ .* end$' "$dir/s51.log") || {
    echo "no end line from the chip within $seconds s (s51 left with $status)" >&2
    tail -n 5 "$dir/s51.log" >&2
    exit 1
}
echo "$line"
