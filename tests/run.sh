#!/bin/bash
# Runs test suites and adds up what they print.
#     tests/run.sh COMMAND...         each COMMAND is one suite, a shell command line
# A suite prints one line a case, PLACE:LINE:NAME:PASS or PLACE:LINE:NAME:FAIL: why, and exits
# non-zero if any failed. A suite that fails without saying which case, or says nothing, counts as one
# failure. The last line is "N passed, N failed".
set -u
passed=0
failed=0
log=$(mktemp)
trap 'rm -f "$log"' EXIT

for suite in "$@"; do
    # stdin is an empty file: a suite never waits for a terminal.
    bash -c "$suite" >"$log" 2>&1 </dev/null
    status=$?
    good=$(grep -acE '^[^ ].*:[0-9]+:.*:PASS$' "$log")
    bad=$(grep -acE '^[^ ].*:[0-9]+:.*:FAIL' "$log")
    if [ "$bad" -eq 0 ] && { [ "$status" -ne 0 ] || [ "$good" -eq 0 ]; }; then
        bad=1
        echo "$suite:0:suite:FAIL: exit status $status after $good cases; its last lines:"
        tail -n 40 "$log"
    elif [ "$bad" -ne 0 ]; then
        grep -avE ':PASS$' "$log"
    fi
    passed=$((passed + good))
    failed=$((failed + bad))
    printf '%5d passed %3d failed  %s\n' "$good" "$bad" "$suite"
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
