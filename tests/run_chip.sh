#!/bin/bash
# Runs one unit test image of the chip in s51 and prints what Unity says:
#     tests/run_chip.sh IMAGE.ihx [CPU-SECONDS]
# s51 exits with 0 whatever happens, and quits early when its input is closed; so its input is an open
# pipe, its processor time is limited (so that a busy machine fails nothing), and only Unity's own last line makes a success.
set -u
[ $# -ge 1 ] && [ -r "$1" ] || {
    echo "run_chip.sh: error: no image '${1:-}'; use: tests/run_chip.sh IMAGE.ihx [CPU-SECONDS]" >&2
    exit 2
}
seconds=${2:-120}
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# The pipe closes when s51 is gone: `sleep` never writes, it only keeps it open that long.
coproc open_pipe { exec sleep "$((seconds * 20 + 5))"; }
timeout -k 1 "$((seconds * 20))" prlimit --cpu="$seconds" s51 -t C52 -q -b -R 1 -G -I "if=xram[0xffff]" "$1" <&"${open_pipe[0]}" >"$log" 2>&1
status=$?
kill "$open_pipe_PID" 2>/dev/null

grep -aoE '[^ ]*tests/unit/[^:]*:[0-9]+:.*:(PASS|FAIL.*|IGNORE.*)$' "$log" | sed 's|^[^ ]*tests/unit/|chip:tests/unit/|'
if grep -aqE '^OK$' "$log"; then
    exit 0
fi
if ! grep -aqE '^FAIL$' "$log"; then
    echo "$1:0:end_line:FAIL: no end line from the chip within $seconds s of processor time (s51 left with $status); its last lines:"
    tail -n 5 "$log"
fi
exit 1
