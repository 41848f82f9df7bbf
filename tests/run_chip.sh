#!/bin/bash
# SPDX-License-Identifier: MIT
# Runs one unit test image of the chip, in s51 or with ENGINE=fast in our own simulator, and prints Unity's
# lines, one a case:
#     tests/run_chip.sh IMAGE.ihx
# Only Unity's own last line, OK, makes a success.
set -u
log=$(mktemp)
trap 'rm -f "$log"' EXIT
tests/run_image.sh "$@" >"$log" || exit

grep -aoE '[^ ]*tests/unit/[^:]*:[0-9]+:.*:(PASS|FAIL.*|IGNORE.*)$' "$log" | sed 's|^[^ ]*tests/unit/|chip:tests/unit/|'
if grep -aqx OK "$log"; then
    exit 0
fi
if ! grep -aqx FAIL "$log"; then
    echo "$1:0:end_line:FAIL: the image did not print its last line; it printed: $(tail -n 5 "$log" | tr '\n' ' ')"
fi
exit 1
