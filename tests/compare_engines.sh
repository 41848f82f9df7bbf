#!/bin/bash
# SPDX-License-Identifier: MIT
# Runs all scenarios of a folder in both engines of drive; a scenario passes when every stated outcome holds
# in both. The image is chosen as in tests/run_loop.sh:
#     tests/compare_engines.sh BOARD [DIR]
set -u
s51=$(mktemp)
fast=$(mktemp)
trap 'rm -f "$s51" "$fast"' EXIT
ENGINE=s51 tests/run_loop.sh "$@" >"$s51"
ENGINE=fast tests/run_loop.sh "$@" >"$fast"
sed -E 's/:(PASS|FAIL)/ s51:\1/' "$s51"
sed -E 's/:(PASS|FAIL)/ fast:\1/' "$fast"
if [ ! -s "$s51" ] || ! diff -q <(sed 's/:FAIL:.*/:FAIL/' "$s51") <(sed 's/:FAIL:.*/:FAIL/' "$fast") >/dev/null; then
    echo "$0:0:$* the same in both engines:FAIL: $(diff "$s51" "$fast" | tr '\n' ' ')"
    exit 1
fi
echo "$0:0:$* the same in both engines:PASS"
! grep -q ':FAIL' "$s51"
